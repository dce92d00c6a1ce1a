// The case file: everything that a run is told. Composed of the parameter structs of the other folders, each of which
// declares its own keys; `tunica schema` prints them all.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "tunica/ale/parameters.hpp"
#include "tunica/analysis/description.hpp"
#include "tunica/analysis/settings.hpp"
#include "tunica/base/boxed.hpp"
#include "tunica/bc/conditions.hpp"
#include "tunica/case/fibre_settings.hpp"
#include "tunica/case/measured_settings.hpp"
#include "tunica/case/prestress_settings.hpp"
#include "tunica/case/report_settings.hpp"
#include "tunica/case/tuning_settings.hpp"
#include "tunica/config/document.hpp"
#include "tunica/config/schema.hpp"
#include "tunica/coupling/settings.hpp"
#include "tunica/fluid/parameters.hpp"
#include "tunica/mesh/generate.hpp"
#include "tunica/mesh/mesh_data.hpp"
#include "tunica/quantities/names.hpp"

namespace tunica::wall {
struct Parameters;  // wall/parameters.hpp
}

namespace tunica::case_file {

struct MeshCase;     // mesh_settings.hpp
struct ComparedLaw;  // compared_law.hpp

// --- what is computed ---------------------------------------------------------------------------------------------

struct FluidStructure {};  ///< blood and wall, coupled
struct RigidFlow {};       ///< blood in a rigid wall
struct DynamicWall {};     ///< wall alone, with inertia
/// Wall alone, in equilibrium with the loads of one time, which are applied in equal steps.
struct StaticWall {
  int load_steps = 10;
  double load_time = 0.0;  ///< s
};
using Analysis = std::variant<FluidStructure, RigidFlow, DynamicWall, StaticWall>;

// --- meshes -------------------------------------------------------------------------------------------------------

/// Where the files of a mesh lie when they are no `mesh-complete` folder.
struct NamedFiles {
  std::filesystem::path volume;                        ///< .vtu; empty: the folder is given
  std::map<std::string, std::filesystem::path> faces;  ///< .vtp, by the name of the face
  std::optional<std::string> rest;                     ///< face of the boundary that no file holds
};

/// A region whose mesh was exported by SimVascular: a folder, or files.
struct RegionMesh {
  std::filesystem::path simvascular;  ///< the mesh-complete folder
  NamedFiles files{};
};

/// A cell array in a file of its own.
struct ArrayFile {
  std::filesystem::path file;
  std::optional<std::string> array;  ///< its name there; none: the name that it gets
};

/// A wall whose volume may hold several regions.
struct WallMesh {
  std::filesystem::path simvascular;  ///< the mesh-complete folder
  std::optional<std::string> region_array;
  std::map<std::string, int> regions;  ///< number in that array, by the name of the region
  NamedFiles files{};
  std::map<std::string, ArrayFile> arrays{};  ///< cell arrays that do not stand in the volume, by name
};

/// Several regions in one Gmsh file.
struct GmshMesh {
  std::filesystem::path file;
  std::map<std::string, mesh::RegionKind> regions;  ///< by the name of the physical volume
};

/// The surface that lumen and wall have in common.
struct InterfaceSettings {
  std::vector<std::string> lumen_faces, wall_faces;
  double tolerance = 1e-3;  ///< distance of two nodes of a pair, as a share of the shortest edge there
};

/// Exactly one of `lumen` and/or `wall`, `gmsh`, `tube` is given.
struct MeshSettings {
  std::optional<double> metres_per_unit;  ///< of the coordinates in files; present when there are files
  std::optional<RegionMesh> lumen;
  std::optional<WallMesh> wall;
  std::optional<GmshMesh> gmsh;
  std::optional<mesh::TubeSizes> tube;
  std::optional<InterfaceSettings> interface;  ///< present for fluid-structure interaction
  double scale = 1.0;                          ///< factor on the coordinates in files, besides their unit

  /// Metres of one unit of the coordinates in files.
  double metres() const { return metres_per_unit.value() * scale; }
  bool given() const { return lumen || wall || gmsh || tube; }
  bool has_lumen() const;
  bool has_wall() const;
  static config::Schema<MeshSettings> schema();
};

// --- output -------------------------------------------------------------------------------------------------------

/// Names of units that results are written in, for headers and labels; config::unit_factor gives their SI values.
struct OutputUnits {
  std::string length = "mm", time = "s", velocity = "m/s", pressure = "mmHg", stress = "kPa", flow = "ml/s";
  static config::Schema<OutputUnits> schema();
};

/// A place whose values are recorded in every step.
struct ProbePoint {
  Vec3<double> place{};                    ///< in the initial mesh [m]
  std::optional<mesh::RegionKind> region;  ///< none: the lumen, or the wall where there is no lumen
};

/// Which instant of a step of generalised-alpha results show. Velocity and displacement are those of its end anyway.
enum class Instant {
  balance,  ///< t_{n+alpha_f}, where the equations are met
  end,      ///< t_{n+1}
};

struct OutputSettings {
  std::filesystem::path directory;      ///< created when it does not exist
  std::int64_t every = 1;               ///< steps between two fields of the time series
  std::int64_t checkpoint_every = 100;  ///< steps between two checkpoints
  OutputUnits units;
  std::vector<std::pair<std::string, ProbePoint>> points;  ///< name, place
  bool forces = false;                                     ///< of the blood on the walls
  std::vector<bool> fields = quantities::standard();       ///< which of quantities::registry() the series have
  Instant instant = Instant::balance;                      ///< of pressures, and of the flows through faces
  static config::Schema<OutputSettings> schema();
};

// --- discretisation -----------------------------------------------------------------------------------------------

/// Of velocity and displacement; pressure is linear in any case.
enum class Elements { linear, quadratic };

// --- the whole ----------------------------------------------------------------------------------------------------

/// Which of the optional parts are present follows from the analysis; the schema checks it.
struct Case {
  std::string title;
  Analysis analysis;
  Boxed<MeshCase> mesh;  ///< what is meshed first, in place of `meshes`
  MeshSettings meshes;
  Elements elements = Elements::quadratic;
  std::optional<FibreSettings> fibres;  ///< directions that are made first
  std::optional<fluid::Parameters> fluid;
  Boxed<wall::Parameters> wall;
  std::optional<ale::Parameters> mesh_motion;  ///< for fluid-structure interaction; always present there
  /// Face name, condition, as in the file; then the provisional outlets of the section `outlets`, which a run replaces.
  std::vector<std::pair<std::string, bc::Condition>> boundary;
  std::optional<coupling::TimeSettings> time;  ///< all but static walls
  std::optional<std::filesystem::path> start;  ///< state to start from; else at rest
  std::optional<PrestressCase> prestress;      ///< what `tunica prestress` shall do
  std::optional<TuningCase> outlets;           ///< what `tunica tune` shall find, and a run takes; with flow
  std::optional<analysis::PostSettings> post;  ///< what `tunica post` shall make of the results
  std::optional<MeasuredCase> measured;        ///< what `tunica post` holds the results against
  std::optional<ReportSettings> report;        ///< the page that is written last
  std::vector<std::pair<std::string, Boxed<ComparedLaw>>> compare;  ///< laws that `tunica compare` puts in the wall
  coupling::NewtonSettings newton;
  coupling::LinearSettings linear;
  OutputSettings output;
  std::optional<coupling::PressurePoint> pressure_point;  ///< for an enclosed flow

  /// Is there a prestress to be found? Not where `wall.prestress` names what was found.
  bool finds_prestress() const;
  bool solves_fluid() const;
  bool solves_wall() const;
  bool wall_has_pressure() const;                               ///< as an unknown
  std::vector<std::string> wall_arrays() const;                 ///< cell arrays that its `wall` section names
  std::optional<std::filesystem::path> prestress_file() const;  ///< of the wall
  static config::Schema<Case> schema();
};

/// The text of a case file, with what follows from other sections: a wall that is given fibres has their frame.
config::Document case_document(const std::string& yaml, const std::filesystem::path& file);

/// Reads and validates a case file without its meshes; tables of waveforms are read and checked, too. Throws
/// InputError with all problems. Not collective: call it on one rank, and `parse_case` on the others.
config::Parsed<Case> read_case(const std::filesystem::path& file);

/// The same from the text of a case file that one rank has read; looks at no files.
Case parse_case(const std::string& yaml, const std::filesystem::path& file);

/// (lumen face, wall face) pairs of the interface, in which every face of either side occurs.
std::vector<std::pair<std::string, std::string>> interface_pairs(const MeshSettings& meshes);

/// Faces among `lumen_faces` that the blood sticks to, in that order: with no_slip, or of the interface.
std::vector<std::string> sticking_faces(const Case& c, const std::vector<std::string>& lumen_faces);

/// What the analysis of the results needs to know of the case that made them.
analysis::RunDescription describe(const Case& c);

}  // namespace tunica::case_file
