#include "tunica/frames/tears.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <iterator>

#include "tunica/base/error.hpp"
#include "tunica/distributed/element_shape.hpp"
#include "tunica/parallel/agree.hpp"

namespace tunica::frames {

namespace {

enum Touch : unsigned char { true_wall = 1, false_wall = 2, other_wall = 4 };

/// What each region of the mesh is.
std::vector<Touch> kinds_of_regions(const distributed::DistributedMesh& mesh, const LumenWalls& walls) {
  std::vector<Touch> kinds(mesh.regions.size(), other_wall);
  const auto mark = [&](const std::vector<std::string>& names, Touch kind) {
    for (const auto& name : names) {
      const auto region = std::find_if(mesh.regions.begin(), mesh.regions.end(), [&](const auto& r) {
        return r.name == name && r.kind == mesh::RegionKind::wall;
      });
      if (region == mesh.regions.end())
        throw InputError("tears", fmt::format("the wall has no region '{}'", name),
                         "name regions of the wall that lie along the true and the false lumen");
      kinds[region - mesh.regions.begin()] = kind;
    }
  };
  mark(walls.true_lumen, true_wall);
  mark(walls.false_lumen, false_wall);
  return kinds;
}

/// Values of the interface nodes that touch one kind of wall only.
LaplaceConditions conditions_of(const distributed::DistributedMesh& mesh, const std::vector<Touch>& kinds) {
  std::vector<unsigned char> touched(static_cast<std::size_t>(mesh.nodes()), 0);
  for (std::size_t r = 0; r < mesh.regions.size(); ++r)
    if (mesh.regions[r].kind == mesh::RegionKind::wall)
      for (const auto& element : mesh.regions[r].elements)
        for (const auto node : element) touched[node] |= kinds[r];
  LaplaceConditions conditions(mesh);
  std::int64_t count[2] = {0, 0};
  for (std::int32_t i = 0; i < mesh.owned_nodes; ++i) {
    if (mesh.host[i] == i || (touched[i] != true_wall && touched[i] != false_wall)) continue;
    conditions.value[mesh.host[i]] = touched[i] == true_wall ? 1 : -1;
    ++count[touched[i] == true_wall ? 0 : 1];
  }
  for (int k = 0; k < 2; ++k)
    if (parallel::global_sum(mesh.comm, count[k]) == 0)
      throw InputError("tears",
                       fmt::format("no region of `{}` touches the lumen", k == 0 ? "true_lumen" : "false_lumen"),
                       "name the regions of the wall along that lumen, and give the interface");
  return conditions;
}

}  // namespace

LaplaceSolution lumen_sides(const distributed::DistributedMesh& mesh, const LumenWalls& walls) {
  const auto kinds = parallel::agree(mesh.comm, [&] { return kinds_of_regions(mesh, walls); });
  return solve_laplace(mesh, Domain::lumen, conditions_of(mesh, kinds), "Search for the tears");
}

std::vector<Vec3<double>> tear_points(const distributed::DistributedMesh& mesh, const LumenWalls& walls) {
  const auto solution = lumen_sides(mesh, walls);
  std::vector<Vec3<double>> mine;
  for (const auto& region : mesh.regions)
    if (region.kind == mesh::RegionKind::lumen)
      for (std::int32_t e = 0; e < region.owned_elements; ++e) {
        const auto& element = region.elements[e];
        const auto [low, high] = std::minmax(
            {solution.phi[element[0]], solution.phi[element[1]], solution.phi[element[2]], solution.phi[element[3]]});
        if (low < 0 && high > 0) mine.push_back(distributed::centroid(mesh, element));
      }
  std::vector<int> counts(static_cast<std::size_t>(parallel::size(mesh.comm))), begins(counts.size(), 0);
  const int count = static_cast<int>(3 * mine.size());
  MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, mesh.comm);
  for (std::size_t r = 1; r < counts.size(); ++r) begins[r] = begins[r - 1] + counts[r - 1];
  std::vector<Vec3<double>> all(static_cast<std::size_t>(begins.back() + counts.back()) / 3);
  MPI_Allgatherv(mine.data(), count, MPI_DOUBLE, all.data(), counts.data(), begins.data(), MPI_DOUBLE, mesh.comm);
  if (all.empty())
    throw InputError("tears", "true and false lumen do not communicate",
                     "leave the section out for a vessel without tears");
  return all;
}

std::vector<double> distances(const ElementGraph& graph, const std::vector<Vec3<double>>& points) {
  namespace bg = boost::geometry;
  using Point = bg::model::point<double, 3, bg::cs::cartesian>;
  std::vector<Point> targets;
  for (const auto& p : points) targets.emplace_back(p[0], p[1], p[2]);
  const bg::index::rtree<Point, bg::index::quadratic<16>> tree(targets);
  std::vector<double> result;
  for (std::int32_t e = 0; e < graph.owned(); ++e) {
    const auto c = distributed::centroid(graph.mesh(), graph.nodes(e));
    const Point from(c[0], c[1], c[2]);
    Point nearest;
    tree.query(bg::index::nearest(from, 1), &nearest);
    result.push_back(bg::distance(from, nearest));
  }
  return result;
}

}  // namespace tunica::frames
