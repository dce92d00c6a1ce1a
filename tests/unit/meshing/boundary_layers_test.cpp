#include "tunica/meshing/boundary_layers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "block_vessel.hpp"
#include "tunica/meshing/local_mesh.hpp"
#include "tunica/meshing/patient_complex.hpp"
#include "tunica/meshing/tetrahedralise.hpp"
#include "unit/geometry/small_surfaces.hpp"

namespace tunica::meshing {
namespace {

using namespace geometry::test;
using namespace test;

geometry::Tetrahedra tube_mesh() {
  ComplexOptions options;
  options.sizes.largest = 1.5e-3;
  const auto prepared = patient_complex(
      {tube(5e-3, 20e-3, 60, 30), tube(6e-3, 20e-3, 72, 30), {{"in", {{0, 0, 0}}}, {"out", {{0, 0, 20e-3}}}}}, options);
  return tetrahedralise(prepared.complex, prepared.sizes, {});
}

double area(const geometry::Tetrahedra& mesh, int neighbour) {
  double sum = 0;
  for (const auto& t : geometry::surface_triangles(mesh))
    if (t.label == geometry::lumen_label && t.neighbour_label == neighbour) {
      const geometry::Point& a = mesh.points[t.nodes[0]];
      sum += 0.5 * norm(cross(mesh.points[t.nodes[1]] - a, mesh.points[t.nodes[2]] - a));
    }
  return sum;
}

std::set<std::array<geometry::Index, 3>> interface_of(const geometry::Tetrahedra& mesh) {
  std::set<std::array<geometry::Index, 3>> triangles;
  for (auto t : geometry::surface_triangles(mesh)) {
    if (t.neighbour_label != geometry::wall_label) continue;
    std::sort(t.nodes.begin(), t.nodes.end());
    triangles.insert(t.nodes);
  }
  return triangles;
}

TEST(BoundaryLayers, LieAtTheWallAndChangeNothingElse) {
  auto mesh = tube_mesh();
  const auto before = mesh;
  const auto made = add_boundary_layers(mesh, {.layers = 3, .thickness = 0.3e-3, .growth = 1.5});
  EXPECT_NEAR(made.median, 0.3e-3, 1e-12);
  EXPECT_GT(made.smallest, 0.05e-3);
  const auto interface = interface_of(before);
  EXPECT_EQ(interface_of(mesh), interface);
  EXPECT_EQ(std::ssize(mesh.elements), std::ssize(before.elements) + 9 * std::ssize(interface));
  EXPECT_NEAR(test::volume(mesh, geometry::lumen_label) / test::volume(before, geometry::lumen_label), 1, 1e-12);
  EXPECT_NEAR(test::volume(mesh, geometry::wall_label) / test::volume(before, geometry::wall_label), 1, 1e-12);
  EXPECT_NEAR(area(mesh, geometry::outside_label) / area(before, geometry::outside_label), 1, 1e-12);  // caps
  for (const auto& t : mesh.elements)
    EXPECT_GT(worst_sine(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]], mesh.points[t[3]]), 0.005);
  // The first layer is 0.3 mm / (1 + 1.5 + 2.25) thick; its nodes are the first new ones.
  const auto first = std::ssize(before.points), each = (std::ssize(mesh.points) - first) / 3;
  int all = 0, there = 0;
  for (geometry::Index n = first; n < first + each; ++n) {
    const auto& p = mesh.points[n];
    if (p[2] < 5e-3 || p[2] > 15e-3) continue;
    ++all;
    there += std::abs(std::hypot(p[0], p[1]) - (5e-3 - 0.3e-3 / 4.75)) < 0.03e-3;
  }
  EXPECT_GT(all, 200);
  EXPECT_GT(there, 0.95 * all);
}

TEST(BoundaryLayers, AreThinnerWhereTheLumenIsNarrow) {
  auto mesh = tube_mesh();
  const auto made = add_boundary_layers(mesh, {.layers = 2, .thickness = 4e-3, .growth = 1});
  EXPECT_LT(made.largest, 1.2e-3);
  EXPECT_GT(made.median, 0.3e-3);
}

}  // namespace
}  // namespace tunica::meshing
