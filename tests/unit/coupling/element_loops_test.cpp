#include "tunica/coupling/element_loops.hpp"

#include <gtest/gtest.h>

#include <array>
#include <map>

#include "small_cases.hpp"
#include "tunica/assembly/block_matrix.hpp"
#include "tunica/coupling/lumen_groups.hpp"
#include "tunica/coupling/wall_model.hpp"
#include "tunica/fluid/rbvms_shape.hpp"
#include "tunica/wall/parameters.hpp"

namespace tunica::coupling {
namespace {

using test::at;

const fluid::TimeCoefficients fluid_time{1e-3, 1500.0, 0.7};
const fluid::MotionCoefficients motion_coefficients{4e-4, 0.7};
const wall::Coefficients wall_coefficients{1500.0, 4e-4, 0.7 / 4e-4};

// Sums over elements one by one, in double precision, with the sums of magnitudes as a measure of rounding.
struct NaiveLinearSystem {
  const distributed::DistributedMesh& mesh;
  struct Sum {
    double value = 0, magnitude = 0;
    void add(double x) {
      value += x;
      magnitude += std::abs(x);
    }
  };
  std::vector<Sum> residual;
  std::map<std::pair<std::int32_t, std::int32_t>, std::array<Sum, 16>> blocks;  // row-major entries

  explicit NaiveLinearSystem(const distributed::DistributedMesh& m) : mesh(m), residual(at(m.nodes())) {}

  // Motion acts on the host, pressure on the node.
  void add(const std::array<std::int32_t, 4>& nodes, const fe::ElementVector<double>& r,
           const fe::ElementMatrix<double>& k) {
    const auto place = [&](int a, int i) { return i < 3 ? mesh.host[nodes[a]] : nodes[a]; };
    for (int a = 0; a < 4; ++a)
      for (int i = 0; i < 4; ++i) {
        residual[at(place(a, i)) + i].add(r.r[a][i]);
        for (int b = 0; b < 4; ++b)
          for (int j = 0; j < 4; ++j) blocks[{place(a, i), place(b, j)}][4 * i + j].add(k.k[a][b][i][j]);
      }
  }
};

Vec3<double> vector_of(const std::vector<double>& field, std::int32_t node) {
  return {{field[at(node)], field[at(node) + 1], field[at(node) + 2]}};
}

void add_fluid(NaiveLinearSystem& system, const test::Fields& f, const std::array<std::int32_t, 4>& nodes,
               const std::vector<char>& follows_wall) {
  fluid::ElementState<double> state;
  double moves[4];
  for (int a = 0; a < 4; ++a) {
    state.position[a] = vector_of(f.position, nodes[a]);
    state.velocity[a] = vector_of(f.velocity_pressure, nodes[a]);
    state.acceleration[a] = vector_of(f.acceleration, nodes[a]);
    state.mesh_velocity[a] = vector_of(f.mesh_velocity, nodes[a]);
    state.pressure[a] = f.velocity_pressure[at(nodes[a]) + 3];
    moves[a] = follows_wall[static_cast<std::size_t>(nodes[a])];
  }
  fe::ElementVector<double> r;
  fe::ElementMatrix<double> k;
  fluid::tangent_beside_wall(state, fluid_time, test::blood(), fluid::Newtonian{4e-3}, motion_coefficients, moves, r,
                             k);
  system.add(nodes, r, k);
}

void add_wall(NaiveLinearSystem& system, const test::Fields& f, const std::array<std::int32_t, 4>& nodes,
              const wall::Parameters& parameters) {
  wall::ElementState<double> state;
  Vec3<double> X[4];
  for (int a = 0; a < 4; ++a) {
    X[a] = vector_of(f.reference, nodes[a]);
    state.displacement[a] = vector_of(f.displacement, nodes[a]);
    state.acceleration[a] = vector_of(f.acceleration, nodes[a]);
    state.pressure[a] = f.velocity_pressure[at(nodes[a]) + 3];
  }
  state.reference = fe::gradients(X);
  fe::ElementVector<double> r;
  fe::ElementMatrix<double> k;
  const auto law = std::get<wall::NeoHooke>(parameters.law());
  if (parameters.element == wall::Element::mixed)
    wall::mixed_tangent(state, law, parameters.body(), wall_coefficients, r, k);
  else
    wall::displacement_tangent(state, law, parameters.body(), wall_coefficients, r, k);
  system.add(nodes, r, k);
}

struct Loops : testing::TestWithParam<wall::Element> {
  distributed::DistributedMesh mesh = distributed::distribute(test::fsi_tube(), MPI_COMM_WORLD);
  assembly::BlockPattern pattern = assembly::make_pattern(mesh);
  test::Fields fields = test::random_fields(mesh);
  wall::Parameters wall = test::soft_wall(GetParam());
  WallModel model;
  std::vector<char> follows_wall;

  // The last element is left out, so that the last batches have spare lanes.
  Loops() : model((shorten(), mesh), wall), follows_wall(static_cast<std::size_t>(mesh.nodes())) {
    for (std::int32_t i = 0; i < mesh.nodes(); ++i)
      if (mesh.host[i] != i) follows_wall[static_cast<std::size_t>(mesh.host[i])] = 1;
  }

  void shorten() {
    for (auto& region : mesh.regions) region.elements.pop_back();
  }

  void run(assembly::Isa isa, std::vector<double>& residual, assembly::BlockMatrix* matrix, int& spare, int& split,
           int& beside_wall) const {
    const LoopTarget target{residual.data(), matrix == nullptr ? nullptr : matrix->blocks.data()->a};
    const int width = static_cast<int>(isa);
    for (std::size_t r = 0; r < mesh.regions.size(); ++r) {
      if (mesh.regions[r].kind == mesh::RegionKind::lumen) {
        for (const auto& group : lumen_groups(mesh, mesh.regions[r], follows_wall, pattern, width)) {
          element_loops(isa).fluid(group.view(), fields.view(), test::blood(), fluid_time, motion_coefficients, target);
          beside_wall += group.moves.empty() ? 0 : group.batches.elements;
        }
        continue;
      }
      for (const auto& group : model.groups(mesh, r, pattern, width)) {
        spare += width - group.batches.lanes_used(group.batches.batches() - 1);
        split += group.batches.split ? group.batches.elements : 0;
        element_loops(isa).wall.assemble(group.view(), fields.view(), model.element_settings(), wall_coefficients,
                                         target);
      }
    }
  }
};

TEST_P(Loops, AddUpToTheSumOverElementsForEveryInstructionSet) {
  NaiveLinearSystem naive(mesh);
  for (const auto& region : mesh.regions)
    for (const auto& element : region.elements) {
      if (region.kind == mesh::RegionKind::lumen)
        add_fluid(naive, fields, element, follows_wall);
      else
        add_wall(naive, fields, element, wall);
    }
  int all_spare = 0, all_split = 0, all_beside = 0;
  for (const auto isa : test::available_isas()) {
    SCOPED_TRACE(assembly::name(isa));
    assembly::BlockMatrix matrix(pattern);
    std::vector<double> with_tangent(at(mesh.nodes()), 0.0), alone(at(mesh.nodes()), 0.0);
    run(isa, with_tangent, &matrix, all_spare, all_split, all_beside);
    run(isa, alone, nullptr, all_spare, all_split, all_beside);
    for (std::size_t k = 0; k < at(mesh.owned_nodes); ++k) {
      EXPECT_NEAR(with_tangent[k], naive.residual[k].value, 1e-12 * naive.residual[k].magnitude);
      EXPECT_NEAR(alone[k], naive.residual[k].value, 1e-12 * naive.residual[k].magnitude);
    }
    for (std::int32_t row = 0; row < pattern.rows; ++row)
      for (auto b = pattern.row_begin[row]; b < pattern.row_begin[row + 1]; ++b) {
        const auto found = naive.blocks.find({row, pattern.columns[b]});
        for (int i = 0; i < 4; ++i)
          for (int j = 0; j < 4; ++j) {
            const auto expected = found == naive.blocks.end() ? NaiveLinearSystem::Sum{} : found->second[4 * i + j];
            // Entries that vanish by symmetry within an element carry the rounding of that element's block.
            EXPECT_NEAR(matrix.blocks[b].a[4 * j + i], expected.value, 1e-6 * expected.magnitude + 1e-25)
                << "nodes " << row << ", " << pattern.columns[b] << " entry " << i << ", " << j;
          }
      }
    for (const auto& [place, block] : naive.blocks)
      if (place.first < pattern.rows) pattern.slot(place.first, place.second);  // asserts that it is there
  }
  EXPECT_GT(parallel::global_sum(MPI_COMM_WORLD, std::int64_t{all_spare}), 0) << "no batch had spare lanes";
  EXPECT_GT(parallel::global_sum(MPI_COMM_WORLD, std::int64_t{all_split}), 0);
  EXPECT_GT(parallel::global_sum(MPI_COMM_WORLD, std::int64_t{all_beside}), 0);
}

INSTANTIATE_TEST_SUITE_P(Walls, Loops, testing::Values(wall::Element::mixed, wall::Element::displacement),
                         [](const auto& element) {
                           return element.param == wall::Element::mixed ? "Mixed" : "Displacement";
                         });

}  // namespace
}  // namespace tunica::coupling
