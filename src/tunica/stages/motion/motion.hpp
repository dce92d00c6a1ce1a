// `tunica motion`: how wall, flap and lumens move over the beat, from labels or surfaces at several phases.
#pragma once

#include <mpi.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tunica/case/measured_settings.hpp"
#include "tunica/config/schema.hpp"
#include "tunica/files/phases.hpp"
#include "tunica/motion_imaging/surface_motion.hpp"

namespace tunica::stages {

/// Images or surfaces of the phases of a beat.
struct PhaseFiles {
  std::optional<std::filesystem::path> labels, surfaces;  ///< one of them: a name with * for one file a phase
  motion_imaging::LumenLabels lumens;                     ///< of `labels`
  double length_unit = 1e-3;                              ///< of the coordinates of `surfaces` [m]
  double period = 0;                                      ///< s
  std::vector<double> times;                              ///< s; empty: equal parts of the period

  static config::Schema<PhaseFiles> schema();
};

/// A place whose motion is told.
struct MotionPoint {
  Vec3<double> place{};  ///< in the mesh [m]
};

/// The file of `tunica motion`.
struct MotionCase {
  std::filesystem::path case_file;
  PhaseFiles phases;
  std::optional<double> mesh_at;  ///< phase whose shape the mesh has [s]; none: the first one
  motion_imaging::MotionSettings tracking;
  std::vector<std::string> ends;  ///< openings whose end is seen in the images
  std::vector<std::pair<std::string, case_file::MeasuredPlane>> planes;
  std::vector<std::pair<std::string, MotionPoint>> points;
  std::vector<std::string> rings;  ///< faces of the wall
  std::filesystem::path output;

  static config::Schema<MotionCase> schema();
};

/// Throws InputError with all problems.
config::Parsed<MotionCase> read_motion_case(const std::filesystem::path& file);

/// Lays the wall of the lumens of the case's mesh onto each phase (surface_motion.hpp), and writes into the folder of
/// the output: curves.csv (areas of planes, volumes, tears, flap, points), stations.csv (areas along the aorta),
/// motion_<phase>.vtp with motion.pvd, ring_<face>.csv, motion.json, curves.svg. What was found, and the lines of a
/// case that read it, go to `say`. Planes, points, faces and the numbers of the files are looked at before an image is
/// read. Throws InputError for them, for images that do not read and phases in which the wall is not where the mesh has
/// it; SolverError. Collective: the lumens are told apart by all ranks, the rest is done by rank 0.
void motion(const MotionCase& c, bool overwrite, MPI_Comm comm, const files::Say& say);

}  // namespace tunica::stages
