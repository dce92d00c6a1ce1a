// Shape of the tetrahedra: what cannot be computed on is refused, what computes badly is reported.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "tunica/mesh/mesh_data.hpp"

namespace tunica::mesh {

/// Shape measures of one tetrahedron. All but the volume are independent of size; 1 (or 70.53 degrees) is the regular
/// tetrahedron, 0 a flat one.
struct ElementQuality {
  double volume;             ///< m^3, negative when inverted
  double scaled_jacobian;    ///< smallest over the corners of sqrt(2) 6 V / (product of the three edge lengths)
  double smallest_dihedral;  ///< degrees
  double radius_ratio;       ///< 3 inradius / circumradius
};
ElementQuality quality(const std::array<Vec3<double>, 4>& x);

/// Gives every element positive orientation where the file uses the other node order throughout, and returns a line
/// that says so (empty when nothing was done). Throws InputError when some elements are flat or oriented against the
/// rest, which means that they are inverted; `where` names the mesh in the message.
std::string orient_elements(MeshData& data, const std::string& where);

struct QualityLimits {
  double sliver_dihedral = 5.0;  ///< elements with a smaller angle are counted as slivers [degrees]
};

struct QualityReport {
  std::int64_t elements = 0, slivers = 0;
  double smallest_volume = 0, smallest_scaled_jacobian = 0, smallest_dihedral = 0, smallest_radius_ratio = 0;
  std::vector<std::string> warnings;  ///< slivers: number and places of the worst ones
  std::string summary;                ///< text table: extremes and a histogram of the smallest dihedral angles
};

/// Measures all elements of one region (or of the whole mesh when `region` is -1). Throws InputError when any volume
/// is not positive, naming number and places. `where` names the mesh in the messages.
QualityReport check_quality(const MeshData& data, std::int32_t region, const QualityLimits& limits,
                            const std::string& where);

}  // namespace tunica::mesh
