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

struct TearPlace {
  std::string name;                ///< tear_1, tear_2, ... downstream
  Vec3<double> centre{{0, 0, 0}};  ///< m
  double area = 0;                 ///< m^2
};

struct Lumens {
  distributed::LumenMap map;
  std::vector<TearPlace> tears;
};

/// A node belongs to the false lumen where the function of `post.lumens` (frames/tears.hpp), or without such walls the
/// field mesh::lumen_side, is not positive. The
/// elements with nodes of both lumens are the tears, one for each set that hangs together across faces; specks of less
/// than a thousandth of the largest area count to the tear next to them, so that the sets are complete. What lies
/// within the diameter of a tear is its part of the vessel, the rest belongs to the lumens.
///
/// None where there is no flow or nothing tells the lumens apart. Throws InputError for regions of the settings that
/// the mesh does not have. Collective.
std::optional<Lumens> find_lumens(const distributed::DistributedMesh& mesh, const RunDescription& run,
                                  const PostSettings& settings);

}  // namespace tunica::analysis
