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
  std::vector<double> fibre_angles = {};       ///< of FibreFiles, in classes [rad]
  double fibre_deviation = 0.0;                ///< largest one of an element from its class [rad]
  std::map<std::string, double> periods = {};  ///< of NodalValues by their tables, where these repeat themselves [s]
};

/// Two families of fibres, whose directions stand in files and whose angle is to be looked up there.
struct FibreFiles {
  std::filesystem::path first, second;
  std::string where;  ///< of the second, as in messages
};

/// Regions of the wall with materials of their own, in a file that is to be made: the cell array REGION.
struct WallRegions {
  std::filesystem::path domains;  ///< a .vtu file with DOMAIN_ID, or a list of numbers; empty: one domain
  std::vector<int> known;         ///< domains that the equation has
  std::string where;              ///< of the key, as in messages
  std::string file;               ///< in the folder of the case
};
/// Number of the region of a domain and of a class of fibre angles.
constexpr int region_number(int domain, std::size_t fibre_class) {
  return 1000 * domain + static_cast<int>(fibre_class);
}

/// Velocities, displacements or loads at the nodes of a face, in a table [m, SI] that is to be made of a file of the
/// peer, or of the shape of the face.
struct NodalValues {
  enum class Kind {
    bct,        ///< point arrays velocity_<time> of a .vtp file
    in_time,    ///< a text: components, times, nodes; the times; then each node with its values
    user,       ///< a text: node and size, on each line
    flat,       ///< 1
    parabolic,  ///< 1 - (r/R)^2, of the distances of a node and of the rim from the centre in the same direction
    pressure,   ///< the point array Pressure of a .vtp file
    traction,   ///< the point array Traction of a .vtp file
    course      ///< the same on the whole face; a text: time and three components on each line, or coefficients
  };
  enum class Quantity { velocity, displacement, traction, factor };
  Kind kind;
  Quantity quantity = Quantity::velocity;
  bool wall = false;  ///< of a face of the wall?
  std::filesystem::path file = {};
  std::string face = {}, where = {};  ///< `where`: of the key, as in messages
  std::string table = {};             ///< in the folder of the case
  int first_node = 1;                 ///< number of the first node of the mesh in that file
  bool zero_rim = false;              ///< user, flat, parabolic: zero at nodes that other faces have, too
  bool unit_flow = false;             ///< the same kinds: scaled so that the integral over the face is one
  /// Along these axes, each the same; none: the same kinds along the outward normals of the nodes. Of `in_time` the
  /// axes of its components, all when there are none.
  std::vector<int> axes = {};
  double scale = 1.0;  ///< of all values
  // Of a course:
  bool coefficients = false;  ///< of Fourier series, of each component
  bool ramp = false;          ///< one straight line from the first value to the last
  double step = 0.0;          ///< times of the table [s]
  std::size_t steps = 0;
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
  std::vector<NodalValues> nodal = {};
  std::optional<WallRegions> regions = {};
};

/// The case file that poses the problem of `file`, for a file in `case_folder`: paths count from there. Files that it
/// names need not be there; where they are, what hangs on them is looked up.
/// Throws InputError with all that is wrong, unknown or beyond tunica, each with key and line.
Translation translate(PeerFile file, const UnitSystem& units, const std::filesystem::path& case_folder,
                      const Findings& findings = {});

}  // namespace tunica::peer_cases
