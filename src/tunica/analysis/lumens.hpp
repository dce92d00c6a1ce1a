// True and false lumen and the tears between them on the mesh of a run, for flows and dissipation by part of the vessel
// (docs/theory.md, eqs 10.8, 10.9).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tunica/analysis/description.hpp"
#include "tunica/analysis/settings.hpp"
#include "tunica/distributed/distributed_mesh.hpp"
#include "tunica/distributed/lumen_map.hpp"

namespace tunica::analysis {

/// Node field of a mesh that tells the lumens apart where no wall does: > 0 in the true lumen.
inline constexpr const char* lumen_side_field = "lumen_side";

struct TearPlace {
  std::string name;                ///< tear_1, tear_2, ... downstream
  Vec3<double> centre{{0, 0, 0}};  ///< m
  double area = 0;                 ///< m^2
};

struct Lumens {
  distributed::LumenMap map;
  std::vector<TearPlace> tears;
};

/// A node belongs to the false lumen where the function of `post.lumens` (frames/tears.hpp) is not positive. The
/// elements with nodes of both lumens are the tears, one for each set that hangs together across faces; specks of less
/// than a thousandth of the largest area count to the tear next to them, so that the sets are complete. What lies
/// within the diameter of a tear is its part of the vessel, the rest belongs to the lumens.
///
/// None where there is no flow or nothing tells the lumens apart. Throws InputError for regions of the settings that
/// the mesh does not have. Collective.
std::optional<Lumens> find_lumens(const distributed::DistributedMesh& mesh, const RunDescription& run,
                                  const PostSettings& settings);

}  // namespace tunica::analysis
