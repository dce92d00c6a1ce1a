// The projection of the convection against fields that it reproduces, on one rank and on several.
#include "tunica/coupling/convection.hpp"

#include <gtest/gtest.h>

#include "tunica/coupling/nodal.hpp"
#include "unit/coupling/small_cases.hpp"

namespace tunica::coupling {
namespace {

State state_of(const distributed::DistributedMesh& mesh, const VectorField& velocity) {
  State state;
  for (auto* field : {&state.velocity_pressure, &state.displacement}) field->assign(at(mesh.nodes()), 0.0);
  for (std::int32_t i = 0; i < mesh.nodes(); ++i)
    for (int c = 0; c < 3; ++c) state.velocity_pressure[at(i) + c] = velocity(mesh.points[i], 0.0)[c];
  return state;
}

// v = (x y, y^2, 0) and b = (1, 2, 0) make b.grad v = (y + 2 x, 4 y, 0): the mesh resolves all of it.
TEST(Convection, WhatTheMeshResolvesIsItself) {
  const auto mesh = distributed::distribute(test::turned_box(true), MPI_COMM_WORLD);
  const State state = state_of(mesh, [](const Vec3<double>& x, double) {
    return Vec3<double>{{x[0] * x[1], x[1] * x[1], 0}};
  });
  std::vector<double> stream(at(mesh.nodes()), 0.0);
  for (std::int32_t i = 0; i < mesh.nodes(); ++i) stream[at(i)] = 1.0, stream[at(i) + 1] = 2.0;
  const auto projected = resolved_convection(mesh, state, stream);
  for (std::int32_t i = 0; i < mesh.nodes(); ++i) {
    const auto& x = mesh.points[i];
    EXPECT_NEAR(projected[at(i)], x[1] + 2 * x[0], 1e-8);
    EXPECT_NEAR(projected[at(i) + 1], 4 * x[1], 1e-8);
    EXPECT_NEAR(projected[at(i) + 2], 0.0, 1e-8);
  }
}

// On the mesh as it has moved: stretched by two along all axes, gradients are half as large.
TEST(Convection, TakesTheMeshWhereItIs) {
  const auto mesh = distributed::distribute(test::turned_box(true), MPI_COMM_WORLD);
  State state = state_of(mesh, [](const Vec3<double>& x, double) { return Vec3<double>{{x[0], 0, x[2]}}; });
  for (std::int32_t i = 0; i < mesh.nodes(); ++i)
    for (int c = 0; c < 3; ++c) state.displacement[at(i) + c] = mesh.points[i][c];
  const std::vector<double> stream(at(mesh.nodes()), 1.0);
  const auto projected = resolved_convection(mesh, state, stream);
  for (std::int32_t i = 0; i < mesh.nodes(); ++i) EXPECT_NEAR(projected[at(i)], 0.5, 1e-7);
}

TEST(Convection, IsZeroInTheWallAndTheSameOnAnyNumberOfRanks) {
  const auto mesh = distributed::distribute(test::fsi_tube(true), MPI_COMM_WORLD);
  const auto whole = distributed::distribute(test::fsi_tube(true), MPI_COMM_SELF);
  const auto project = [](const distributed::DistributedMesh& m) {
    State state;
    const auto fields = test::random_fields(m);
    state.velocity_pressure = fields.velocity_pressure;
    state.displacement = fields.displacement;
    return resolved_convection(m, state, fields.velocity_pressure);
  };
  const auto projected = project(mesh);
  EXPECT_LT(test::difference(mesh, projected, whole, project(whole), 0, 3), 1e-6);
  for (const auto& region : mesh.regions)
    if (region.kind == mesh::RegionKind::wall)
      distributed::for_each_node(region, [&](std::int32_t node) {
        for (int c = 0; c < 3; ++c) EXPECT_EQ(projected[at(node) + c], 0.0);
      });
}

}  // namespace
}  // namespace tunica::coupling
