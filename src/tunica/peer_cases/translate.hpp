// From a peer's problem to a case file of tunica.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tunica/base/error.hpp"
#include "tunica/peer_cases/entry.hpp"
#include "tunica/peer_cases/unit_system.hpp"

namespace tunica::peer_cases {

/// What the case file says otherwise than the peer's file, key by key.
struct Remarks {
  std::vector<std::string> dropped;   ///< keys without a counterpart, by the reason
  std::vector<std::string> changed;   ///< taken over with another meaning or value
  std::vector<std::string> defaults;  ///< not written there: the peer's default, or that of tunica in its place
};

/// A prestress at the nodes of the wall, in a file of the peer; the case names a file of elements that is to be made of
/// it.
struct NodalPrestress {
  std::filesystem::path file;
  std::string elements_file;  ///< in the folder of the case
};

/// What a look at the meshes has shown.
struct Findings {
  /// Has the boundary of a mesh parts that none of its faces holds? They get natural conditions.
  bool lumen_rest = false, wall_rest = false;
  bool quadratic = false;                      ///< have the tetrahedra nodes on their edges?
  std::optional<double> fibre_angle = {};      ///< of FibreFiles [rad]
  std::map<std::string, double> periods = {};  ///< of NodalVelocities by their tables, where they vary in time [s]
};

/// Two families of fibres, whose directions stand in files and whose angle is to be looked up there.
struct FibreFiles {
  std::filesystem::path first, second;
  std::string where;  ///< of the second, as in messages
};

/// Velocities at the nodes of a face of the lumen, in a table [m, m/s] that is to be made of a file of the peer.
struct NodalVelocities {
  enum class Kind {
    bct,      ///< point arrays velocity_<time> of a .vtp file
    in_time,  ///< a text: components, times, nodes; the times; then each node with its values
    shape     ///< a text: node and size along the outward normal, on each line
  };
  Kind kind;
  std::filesystem::path file;
  std::string face, where;  ///< `where`: of the key, as in messages
  std::string table;        ///< in the folder of the case
  int first_node = 1;       ///< number of the first node of the mesh in that file
  bool zero_rim = false;    ///< shape: zero on the rim of the face
  bool unit_flow = false;   ///< shape: scaled to a flow of one
};

/// Fields of a mesh at the start, in files with the points of that mesh.
struct InitialFiles {
  std::optional<std::filesystem::path> velocity, pressure, displacement;
  bool any() const { return velocity || pressure || displacement; }
};

/// The state that a run starts from, in a file of tunica that is to be made of those of the peer.
struct InitialState {
  InitialFiles lumen, wall;
  std::string file;  ///< in the folder of the case
};

struct Translation {
  std::string yaml;  ///< with the remarks at its head and the place of every key behind it
  Remarks remarks;
  std::vector<std::string> warnings;  ///< files that are not there, values that look like slips
  std::optional<NodalPrestress> prestress = {};
  std::optional<InitialState> initial = {};
  std::optional<FibreFiles> fibres = {};
  std::vector<NodalVelocities> velocities = {};
};

/// The case file that poses the problem of `file`, for a file in `case_folder`: paths count from there. Files that it
/// names need not be there; where they are, what hangs on them is looked up.
/// Throws InputError with all that is wrong, unknown or beyond tunica, each with key and line.
Translation translate(PeerFile file, const UnitSystem& units, const std::filesystem::path& case_folder,
                      const Findings& findings = {});

}  // namespace tunica::peer_cases
