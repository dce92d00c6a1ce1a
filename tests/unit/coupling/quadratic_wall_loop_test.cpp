// The loop over quadratic wall elements against sums over elements one by one.
#include <gtest/gtest.h>

#include <array>
#include <map>

#include "small_cases.hpp"
#include "tunica/assembly/block_matrix.hpp"
#include "tunica/coupling/element_loops.hpp"
#include "tunica/coupling/wall_element.hpp"
#include "tunica/mesh/edge_nodes.hpp"
#include "tunica/wall/parameters.hpp"

namespace tunica::coupling {
namespace {

namespace wq = wall::quadratic;
using test::at;

const wall::Coefficients coefficients{1500.0, 4e-4, 0.7 / 4e-4};

mesh::MeshData quadratic_tube() {
  auto tube = test::fsi_tube();
  mesh::add_edge_nodes(tube);
  return tube;
}

struct Sum {
  double value = 0, magnitude = 0;
  void add(double x) {
    value += x;
    magnitude += std::abs(x);
  }
};

// Motion acts on the host, pressure on the node.
struct NaiveQuadraticSystem {
  const distributed::DistributedMesh& mesh;
  std::vector<Sum> residual;
  std::map<std::pair<std::int32_t, std::int32_t>, std::array<Sum, 16>> blocks;  // row-major entries

  explicit NaiveQuadraticSystem(const distributed::DistributedMesh& m) : mesh(m), residual(at(m.nodes())) {}

  template <bool mixed>
  void add(const std::array<std::int32_t, 10>& nodes, const wq::ElementState<double>& state, const wall::Law& law,
           const wall::Body& body, const wq::PointPrestress<double>& prestress) {
    const auto place = [&](int a, int i) { return i < 3 ? mesh.host[nodes[a]] : nodes[a]; };
    wq::ElementVector<double> r;
    wq::tangent<mixed>(state, std::get<wall::NeoHooke>(law), body, coefficients, prestress, r,
                       [&](int a, const wq::TangentRow<double>& row) {
                         for (int b = 0; b < 10; ++b)
                           for (int i = 0; i < 4; ++i)
                             for (int j = 0; j < 4; ++j) {
                               if ((i == 3 && (a > 3 || !mixed)) || (j == 3 && (b > 3 || !mixed))) continue;
                               const double value = i < 3 && j < 3 ? row.motion[b](i, j)
                                                    : i < 3        ? row.pressure[b][i]
                                                    : j < 3        ? row.constraint[b][j]
                                                                   : row.compressibility[b];
                               blocks[{place(a, i), place(b, j)}][4 * i + j].add(value);
                             }
                       });
    for (int a = 0; a < 10; ++a) {
      for (int i = 0; i < 3; ++i) residual[at(place(a, i)) + i].add(r.momentum[a][i]);
      if (a < 4) residual[at(nodes[a]) + 3].add(r.constraint[a]);
    }
  }
};

using Prestressed = std::pair<wall::Element, wall::PrestressKind>;

struct QuadraticWallLoop : testing::TestWithParam<Prestressed> {
  distributed::DistributedMesh mesh = distributed::distribute(quadratic_tube(), MPI_COMM_WORLD);
  assembly::BlockPattern pattern = assembly::make_pattern(mesh);
  test::Fields fields = test::random_fields(mesh, {.displacement = 2e-5});
  wall::Parameters wall = test::soft_wall(GetParam().first);
  WallModel model;

  // The last element is left out, so that the last batches have spare lanes.
  QuadraticWallLoop() : model((shorten(), mesh), wall) {}
  void shorten() {
    for (auto& region : mesh.regions) region.elements.pop_back(), region.edges.pop_back();
  }

  void add_naively(NaiveQuadraticSystem& naive) const {
    for (std::size_t r = 0; r < mesh.regions.size(); ++r) {
      const auto& region = mesh.regions[r];
      if (region.kind != mesh::RegionKind::wall) continue;
      for (std::size_t e = 0; e < region.elements.size(); ++e) {
        const auto index = static_cast<std::int32_t>(e);
        std::array<std::int32_t, 10> nodes{};
        std::copy(region.elements[e].begin(), region.elements[e].end(), nodes.begin());
        std::copy(region.edges[e].begin(), region.edges[e].end(), nodes.begin() + 4);
        const auto state = quadratic_wall_element(mesh, model, fields.view(), r, index);
        const auto prestress = model.point_prestress(r, index);
        if (GetParam().first == wall::Element::mixed)
          naive.add<true>(nodes, state, wall.law(), wall.body(), prestress);
        else
          naive.add<false>(nodes, state, wall.law(), wall.body(), prestress);
      }
    }
  }
};

TEST_P(QuadraticWallLoop, AddsUpToTheSumOverElementsForEveryInstructionSet) {
  std::vector<WallModel::Group> none;
  WallPrestress prestress{.kind = GetParam().second};
  const auto n = static_cast<std::size_t>(wall::components(prestress.kind));
  for (const auto& region : mesh.regions) {
    auto& values = prestress.values.emplace_back();
    if (region.kind == mesh::RegionKind::wall)
      for (std::size_t k = 0; k < 4 * n * region.elements.size(); ++k) {
        const double value = test::noise(static_cast<std::int64_t>(k), 1);
        values.push_back(n == 6 ? 1e3 * value : 0.1 * value + (k % 9 % 4 == 0 ? 1.0 : 0.0));
      }
  }
  model.set_prestress(prestress, none);
  NaiveQuadraticSystem naive(mesh);
  add_naively(naive);
  std::int64_t split = 0;
  for (const auto isa : test::available_isas()) {
    SCOPED_TRACE(assembly::name(isa));
    const int width = static_cast<int>(isa);
    assembly::BlockMatrix matrix(pattern);
    std::vector<double> with_tangent(at(mesh.nodes()), 0.0), alone(at(mesh.nodes()), 0.0);
    for (std::size_t r = 0; r < mesh.regions.size(); ++r) {
      if (mesh.regions[r].kind != mesh::RegionKind::wall) continue;
      for (const auto& group : model.groups(mesh, r, pattern, width)) {
        split += group.batches.split ? group.batches.elements : 0;
        const auto loop = element_loops(isa).wall.assemble;
        loop(group.view(), fields.view(), model.element_settings(), coefficients,
             {with_tangent.data(), matrix.blocks.data()->a});
        loop(group.view(), fields.view(), model.element_settings(), coefficients, {alone.data(), nullptr});
      }
    }
    double error = 0, matrix_error = 0;
    for (std::size_t k = 0; k < at(mesh.owned_nodes); ++k)
      for (const double value : {with_tangent[k], alone[k]})
        error = std::max(error, std::abs(value - naive.residual[k].value) / (naive.residual[k].magnitude + 1e-25));
    for (std::int32_t row = 0; row < pattern.rows; ++row)
      for (auto b = pattern.row_begin[row]; b < pattern.row_begin[row + 1]; ++b) {
        const auto found = naive.blocks.find({row, pattern.columns[b]});
        double size = 1e-25;  // entries that vanish by symmetry carry the rounding of the others
        for (int k = 0; k < 12 && found != naive.blocks.end(); ++k) size = std::max(size, found->second[k].magnitude);
        for (int i = 0; i < 4; ++i)
          for (int j = 0; j < 4; ++j) {
            const auto expected = found == naive.blocks.end() ? Sum{} : found->second[4 * i + j];
            const double scale = i < 3 && j < 3 ? size : expected.magnitude + 1e-25;
            matrix_error = std::max(matrix_error, std::abs(matrix.blocks[b].a[4 * j + i] - expected.value) / scale);
          }
      }
    EXPECT_LT(error, 1e-11);
    EXPECT_LT(matrix_error, 1e-6);
  }
  EXPECT_GT(parallel::global_sum(MPI_COMM_WORLD, split), 0);
}

INSTANTIATE_TEST_SUITE_P(Walls, QuadraticWallLoop,
                         testing::Values(Prestressed{wall::Element::mixed, wall::PrestressKind::stress},
                                         Prestressed{wall::Element::mixed, wall::PrestressKind::stretch},
                                         Prestressed{wall::Element::displacement, wall::PrestressKind::stress},
                                         Prestressed{wall::Element::displacement, wall::PrestressKind::stretch}),
                         [](const auto& prestressed) {
                           return std::string(prestressed.param.first == wall::Element::mixed ? "Mixed"
                                                                                              : "Displacement") +
                                  (prestressed.param.second == wall::PrestressKind::stress ? "Stress" : "Stretch");
                         });

}  // namespace
}  // namespace tunica::coupling
