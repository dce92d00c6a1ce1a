#include <gtest/gtest.h>
#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <span>

#include "tunica/base/error.hpp"
#include "tunica/distributed/distributed_mesh.hpp"
#include "tunica/mesh/generate.hpp"
#include "tunica/parallel/agree.hpp"

namespace tunica::distributed {
namespace {

constexpr double radius = 0.01, length = 0.04, thickness = 0.002;

/// The whole mesh on every rank, to compare with; `distribute` itself reads that of rank 0 only.
const mesh::MeshData& whole_tube() {
  static const mesh::MeshData data = mesh::tube({.radius = radius,
                                                 .length = length,
                                                 .wall_thickness = thickness,
                                                 .cells_around = 16,
                                                 .cells_radial = 2,
                                                 .cells_along = 12,
                                                 .cells_through_wall = 2});
  return data;
}

DistributedMesh distributed_tube() {
  return distribute(parallel::rank(MPI_COMM_WORLD) == 0 ? whole_tube() : mesh::MeshData{}, MPI_COMM_WORLD);
}

std::map<std::int64_t, std::int32_t> local_of_original(const DistributedMesh& mesh) {
  std::map<std::int64_t, std::int32_t> local;
  for (std::int32_t n = 0; n < mesh.nodes(); ++n) local[mesh.original_ids[n]] = n;
  return local;
}

double volume(std::span<const Vec3<double>> points, const auto& e) {
  const Vec3<double> a = points[e[1]] - points[e[0]], b = points[e[2]] - points[e[0]], c = points[e[3]] - points[e[0]];
  return dot(a, cross(b, c)) / 6;
}

TEST(Distribute, GivesEachNodeAndElementToOneRank) {
  const DistributedMesh mesh = distributed_tube();
  const mesh::MeshData& whole = whole_tube();
  ASSERT_EQ(mesh.regions.size(), 2u);
  EXPECT_EQ(mesh.global_nodes, static_cast<std::int64_t>(whole.points.size()));
  EXPECT_EQ(mesh.global_elements, static_cast<std::int64_t>(whole.tetrahedra.size()));
  EXPECT_GT(mesh.owned_nodes, 0);

  // Ones from the owners: every entry of the sum must be exactly 1.
  std::vector<double> node_count(whole.points.size(), 0), element_count(whole.tetrahedra.size(), 0);
  for (std::int32_t n = 0; n < mesh.owned_nodes; ++n) node_count[mesh.original_ids[n]] += 1;
  for (const auto& region : mesh.regions)
    for (std::int32_t e = 0; e < region.owned_elements; ++e) element_count[region.element_ids[e]] += 1;
  parallel::global_sum(MPI_COMM_WORLD, node_count);
  parallel::global_sum(MPI_COMM_WORLD, element_count);
  EXPECT_TRUE(std::all_of(node_count.begin(), node_count.end(), [](double c) { return c == 1; }));
  EXPECT_TRUE(std::all_of(element_count.begin(), element_count.end(), [](double c) { return c == 1; }));
}

TEST(Distribute, NumbersNodesContiguouslyPerRankAndGhostsAscending) {
  const DistributedMesh mesh = distributed_tube();
  for (std::int32_t n = 0; n < mesh.owned_nodes; ++n) ASSERT_EQ(mesh.global_ids[n], mesh.first_global + n);
  for (std::int32_t n = mesh.owned_nodes; n < mesh.nodes(); ++n) {
    const bool owned_here =
        mesh.global_ids[n] >= mesh.first_global && mesh.global_ids[n] < mesh.first_global + mesh.owned_nodes;
    ASSERT_FALSE(owned_here);
    ASSERT_LT(n == mesh.owned_nodes ? -1 : mesh.global_ids[n - 1], mesh.global_ids[n]);
  }
  const auto& whole = whole_tube();
  for (std::int32_t n = 0; n < mesh.nodes(); ++n)
    for (int i = 0; i < 3; ++i) ASSERT_EQ(mesh.points[n][i], whole.points[mesh.original_ids[n]][i]);
}

TEST(Distribute, KeepsVolumeAndOrientation) {
  const DistributedMesh mesh = distributed_tube();
  const auto& whole = whole_tube();
  for (std::size_t r = 0; r < mesh.regions.size(); ++r) {
    const auto& region = mesh.regions[r];
    double owned = 0;
    for (std::size_t e = 0; e < region.elements.size(); ++e) {
      const double v = volume(mesh.points, region.elements[e]);
      ASSERT_GT(v, 0);
      if (e < static_cast<std::size_t>(region.owned_elements)) owned += v;
      for (int a = 0; a < 4; ++a)
        ASSERT_EQ(mesh.original_ids[region.elements[e][a]], whole.tetrahedra[region.element_ids[e]][a]);
    }
    double expected = 0;
    for (std::int64_t e = whole.regions[r].first_element; e < whole.regions[r].end_element; ++e)
      expected += volume(whole.points, whole.tetrahedra[e]);
    EXPECT_EQ(region.name, whole.regions[r].name);
    EXPECT_NEAR(parallel::global_sum(MPI_COMM_WORLD, owned), expected, 1e-12 * expected);
  }
}

TEST(Distribute, HoldsExactlyTheElementsThatTouchAnOwnedNode) {
  const DistributedMesh mesh = distributed_tube();
  const auto& whole = whole_tube();
  const auto local = local_of_original(mesh);
  const auto owned = [&](std::int64_t original) {
    const auto found = local.find(original);
    return found != local.end() && found->second < mesh.owned_nodes;
  };
  std::vector<std::int64_t> host(whole.points.size());
  for (std::size_t n = 0; n < host.size(); ++n) host[n] = static_cast<std::int64_t>(n);
  for (const auto& [twin, of] : whole.twins) host[twin] = of;

  for (std::size_t r = 0; r < mesh.regions.size(); ++r) {
    std::set<std::int64_t> expected;
    for (std::int64_t e = whole.regions[r].first_element; e < whole.regions[r].end_element; ++e)
      for (const std::int64_t node : whole.tetrahedra[e])
        if (owned(node) || owned(host[node])) expected.insert(e);
    const auto& ids = mesh.regions[r].element_ids;
    EXPECT_EQ(std::set<std::int64_t>(ids.begin(), ids.end()), expected);
    EXPECT_EQ(ids.size(), expected.size());
  }
}

TEST(Distribute, KeepsTwinsNextToTheirHosts) {
  const DistributedMesh mesh = distributed_tube();
  const auto& whole = whole_tube();
  std::map<std::int64_t, std::int64_t> host_of(whole.twins.begin(), whole.twins.end());
  ASSERT_FALSE(host_of.empty());
  for (std::int32_t n = 0; n < mesh.nodes(); ++n) {
    const auto twin = host_of.find(mesh.original_ids[n]);
    const std::int32_t host = mesh.host[n];
    ASSERT_GE(host, 0);
    EXPECT_EQ(mesh.original_ids[host], twin == host_of.end() ? mesh.original_ids[n] : twin->second);
    EXPECT_EQ(host < mesh.owned_nodes, n < mesh.owned_nodes);
    EXPECT_EQ(mesh.global_ids[n] - mesh.global_ids[host], twin == host_of.end() ? 0 : 1);
  }
}

/// A bar along x: lumen of four cells, then a wall of `wall_cells`, with four twins where they meet. Cuts across it
/// leave ranks that see a twin but no lumen element.
mesh::MeshData bar(int wall_cells) {
  mesh::MeshData data = mesh::box(4, 1, 1, {{4, 1, 1}}, mesh::RegionKind::lumen);
  const mesh::MeshData wall =
      mesh::box(wall_cells, 1, 1, {{static_cast<double>(wall_cells), 1, 1}}, mesh::RegionKind::wall);
  const auto offset = static_cast<std::int64_t>(data.points.size());
  const auto first_wall = static_cast<std::int64_t>(data.tetrahedra.size());
  for (const auto& point : wall.points) data.points.push_back(point + Vec3<double>{{4, 0, 0}});
  for (auto element : wall.tetrahedra) {
    for (auto& node : element) node += offset;
    data.tetrahedra.push_back(element);
  }
  data.regions.push_back(
      {"wall", mesh::RegionKind::wall, first_wall, static_cast<std::int64_t>(data.tetrahedra.size())});
  data.faces.clear();
  for (std::int64_t host = 0; host < offset; ++host)
    for (auto twin = offset; twin < static_cast<std::int64_t>(data.points.size()); ++twin)
      if (norm(data.points[twin] - data.points[host]) < 1e-9) data.twins.push_back({twin, host});
  return data;
}

TEST(Distribute, BringsTheHostWithATwinThatNoLumenElementBrings) {
  std::int64_t hosts_without_element = 0;
  for (int wall_cells = 3; wall_cells <= 9; ++wall_cells) {
    const mesh::MeshData whole = bar(wall_cells);
    ASSERT_EQ(whole.twins.size(), 4u);
    const std::map<std::int64_t, std::int64_t> host_of(whole.twins.begin(), whole.twins.end());
    const DistributedMesh mesh = distribute(whole, MPI_COMM_WORLD);
    std::set<std::int32_t> touched;
    for (const auto& region : mesh.regions)
      for (const auto& element : region.elements) touched.insert(element.begin(), element.end());
    for (std::int32_t n = 0; n < mesh.nodes(); ++n) {
      const std::int64_t original = mesh.original_ids[n];
      EXPECT_EQ(mesh.host[n] < 0 ? -1 : mesh.original_ids[mesh.host[n]],
                host_of.contains(original) ? host_of.at(original) : original);
      hosts_without_element += touched.contains(n) ? 0 : 1;
    }
  }
  // The situation this test is about must have occurred.
  hosts_without_element = parallel::global_sum(MPI_COMM_WORLD, hosts_without_element);
  EXPECT_EQ(hosts_without_element > 0, parallel::size(MPI_COMM_WORLD) > 1);
}

/// Columns of a row: all nodes of the elements around the node or, at the interface, around its twins, and the hosts of
/// those nodes. The rank that owns the row must come to the same set as the whole mesh.
TEST(Distribute, SeesEveryColumnOfItsRows) {
  const DistributedMesh mesh = distributed_tube();
  const auto& whole = whole_tube();
  std::map<std::int64_t, std::int64_t> host_of(whole.twins.begin(), whole.twins.end());
  const auto host = [&](std::int64_t n) { return host_of.contains(n) ? host_of.at(n) : n; };

  std::map<std::int64_t, std::set<std::int64_t>> expected, found;
  for (const auto& element : whole.tetrahedra)
    for (const std::int64_t row : element)
      for (const std::int64_t column : element)
        for (const std::int64_t r : {row, host(row)}) expected[r].insert({column, host(column)});
  for (const auto& region : mesh.regions)
    for (const auto& element : region.elements)
      for (const std::int32_t row : element)
        for (const std::int32_t column : element)
          for (const std::int32_t r : {row, mesh.host[row]})
            found[mesh.original_ids[r]].insert({mesh.original_ids[column], mesh.original_ids[mesh.host[column]]});
  for (std::int32_t n = 0; n < mesh.owned_nodes; ++n)
    ASSERT_EQ(found[mesh.original_ids[n]], expected[mesh.original_ids[n]]) << "node " << mesh.original_ids[n];
}

TEST(Distribute, UpdatesGhostsOfALinearFunction) {
  const DistributedMesh mesh = distributed_tube();
  const auto value = [&](std::int32_t n, int c) {
    const auto& x = mesh.points[n];
    return 1 + c + 3 * x[0] - 2 * x[1] + 7 * (c + 1) * x[2];
  };
  for (const int components : {1, 4}) {
    std::vector<double> values(static_cast<std::size_t>(mesh.nodes() * components), -1e9);
    for (std::int32_t n = 0; n < mesh.owned_nodes; ++n)
      for (int c = 0; c < components; ++c) values[n * components + c] = value(n, c);
    mesh.halo.update(values, components);
    for (std::int32_t n = 0; n < mesh.nodes(); ++n)
      for (int c = 0; c < components; ++c) ASSERT_EQ(values[n * components + c], value(n, c));
  }
}

TEST(Distribute, SortsOwnedCellsFirstThenByLowestNode) {
  const DistributedMesh mesh = distributed_tube();
  const auto check = [](const auto& cells, std::int32_t owned) {
    for (std::int32_t c = 1; c < static_cast<std::int32_t>(cells.size()); ++c) {
      if (c == owned) continue;
      ASSERT_LE(*std::min_element(cells[c - 1].begin(), cells[c - 1].end()),
                *std::min_element(cells[c].begin(), cells[c].end()));
    }
  };
  for (const auto& region : mesh.regions) check(region.elements, region.owned_elements);
  for (const auto& face : mesh.faces) check(face.triangles, face.owned_triangles);
}

TEST(Distribute, GivesEachTriangleToOneRankAndKeepsItsOrientation) {
  const DistributedMesh mesh = distributed_tube();
  const auto& whole = whole_tube();
  ASSERT_EQ(mesh.faces.size(), whole.faces.size());
  const auto area = [](std::span<const Vec3<double>> points, const auto& t) {
    return 0.5 * cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]);
  };
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const Face& face = mesh.faces[f];
    EXPECT_EQ(&mesh.face(whole.faces[f].name), &face);
    EXPECT_EQ(face.region, whole.faces[f].region);
    EXPECT_EQ(face.global_triangles, static_cast<std::int64_t>(whole.faces[f].triangles.size()));
    EXPECT_EQ(parallel::global_sum(MPI_COMM_WORLD, std::int64_t{face.owned_triangles}), face.global_triangles);
    Vec3<double> sum{{0, 0, 0}}, expected{{0, 0, 0}};
    for (std::int32_t t = 0; t < face.owned_triangles; ++t) sum = sum + area(mesh.points, face.triangles[t]);
    for (const auto& t : whole.faces[f].triangles) expected = expected + area(whole.points, t);
    parallel::global_sum(MPI_COMM_WORLD, std::span<double>(sum.x, 3));
    EXPECT_LT(norm(sum - expected), 1e-15);
  }
}

TEST(Distribute, IsTheSameEveryTime) {
  const DistributedMesh a = distributed_tube(), b = distributed_tube();
  EXPECT_EQ(a.original_ids, b.original_ids);
  for (std::size_t r = 0; r < a.regions.size(); ++r) EXPECT_EQ(a.regions[r].element_ids, b.regions[r].element_ids);
}

TEST(Distribute, NamesTheFacesThatExist) {
  const DistributedMesh mesh = distributed_tube();
  try {
    mesh.face("outflow");
    FAIL() << "no error for an unknown face";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("outflow"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("lumen_outlet"), std::string::npos);
  }
}

TEST(Distribute, RefusesOnAllRanksWhatCannotBeSpread) {
  EXPECT_THROW(distribute(mesh::MeshData{}, MPI_COMM_WORLD), InputError);
  mesh::MeshData one;
  one.points = {{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}};
  one.tetrahedra = {{0, 1, 2, 3}};
  one.regions = {{"lumen", mesh::RegionKind::lumen, 0, 1}};
  one.twins = {{1, 0}, {2, 0}, {3, 0}};  // a single group, so at most one rank can own it
  if (parallel::size(MPI_COMM_WORLD) > 1) {
    EXPECT_THROW(distribute(one, MPI_COMM_WORLD), InputError);
  } else {
    EXPECT_EQ(distribute(one, MPI_COMM_WORLD).owned_nodes, 4);
  }
}

}  // namespace
}  // namespace tunica::distributed
