// The vessel of `tunica motion` and how it moves: what its outputs are made of.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tunica/analysis/vessel.hpp"
#include "tunica/flow_imaging/cross_section.hpp"
#include "tunica/motion_imaging/surface_motion.hpp"
#include "tunica/stages/motion/motion.hpp"
#include "tunica/stages/vessel_of_case.hpp"

namespace tunica::stages {

/// A place that the file names, and the node next to it.
struct TrackedPoint {
  std::string name{};
  std::int64_t node = 0;
  double distance = 0;  ///< m
};

struct MovingVessel {
  VesselOfCase vessel;  ///< corners alone
  analysis::Vessel anatomy;
  std::vector<flow_imaging::CrossSection> planes;
  std::vector<TrackedPoint> points;
  motion_imaging::WallSurface wall;  ///< what is laid onto the phases
  std::vector<std::int64_t> nodes;   ///< of the mesh, of each point of the surface
};

/// Throws InputError with all planes, points, ends and rings that the mesh does not have. Collective.
MovingVessel find_moving_vessel(const MotionCase& c, MPI_Comm comm);

/// A phase as it was read and found.
struct Phase {
  std::string file;
  double time = 0;                     ///< s
  motion_imaging::WallMotion motion;   ///< from the phase of the mesh on
  double residual = 0, seen = 0;       ///< of this phase alone: m, share
  std::vector<double> displacement{};  ///< of all nodes of the mesh [node][3]
};

/// Patterns of the names of all files of the stage.
std::vector<std::string> motion_files();

/// Writes them, in the place of those that are there.
void write_motion(const MotionCase& c, const MovingVessel& v, const std::vector<Phase>& phases, const files::Say& say);

}  // namespace tunica::stages
