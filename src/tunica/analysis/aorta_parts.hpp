// Which elements of a mesh belong to the aorta, and which to the branches that leave it.
#pragma once

#include <string>
#include <vector>

#include "tunica/analysis/vessel.hpp"

namespace tunica::analysis {

/// The number of a node or an element as a place in an array.
inline std::size_t at(std::int64_t number) { return static_cast<std::size_t>(number); }

/// A branch where it leaves the aorta.
struct BranchOrigin {
  std::string opening;             ///< face of the lumen at its end
  double distance = 0;             ///< along the centroids of the sections, from the inlet [m]
  Vec3<double> centre{{0, 0, 0}};  ///< of the surface between its lumen and that of the aorta [m]
};

struct AortaParts {
  /// Of each element of the mesh, walls included: is it of the aorta?
  std::vector<std::uint8_t> in_aorta;
  std::vector<BranchOrigin> origins;  ///< downstream
  std::vector<Vec3<double>> centres;  ///< of the aorta's lumen from the inlet to the end [m]
};

/// Elements of the lumen that the sections of `vessel` cut are of the aorta, as are those between them; what hangs
/// together without these and ends at another opening is a branch. An element of the wall belongs to the lumen that is
/// fewest elements away. A branch leaves where the potential towards the end of the aorta has the value that it has in
/// the branch. `vessel` needs stations closer than the elements are wide. Not collective.
AortaParts aorta_parts(const mesh::MeshData& data, const Vessel& vessel);

}  // namespace tunica::analysis
