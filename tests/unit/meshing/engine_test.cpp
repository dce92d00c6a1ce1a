// The engine on a tube with a wall, whose volumes are known.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "block_vessel.hpp"
#include "tunica/meshing/improve.hpp"
#include "tunica/meshing/mesh_report.hpp"
#include "tunica/meshing/projection.hpp"
#include "tunica/meshing/tetrahedralise.hpp"
#include "unit/geometry/small_surfaces.hpp"

namespace tunica::meshing {
namespace {

using namespace geometry::test;
using namespace test;

constexpr double pi = M_PI;

PreparedSurfaces tube_with_wall() {
  ComplexOptions options;
  options.sizes.largest = 1.5e-3;
  return patient_complex(
      {tube(5e-3, 20e-3, 60, 30), tube(6e-3, 20e-3, 72, 30), {{"in", {{0, 0, 0}}}, {"out", {{0, 0, 20e-3}}}}}, options);
}

std::set<std::array<geometry::Index, 3>> sorted(const std::vector<geometry::Triangle>& triangles) {
  std::set<std::array<geometry::Index, 3>> result;
  for (auto t : triangles) {
    std::sort(t.begin(), t.end());
    result.insert(t);
  }
  return result;
}

TEST(Tetrahedralise, KeepsEveryTriangleAndVolume) {
  const auto prepared = tube_with_wall();
  const auto mesh = tetrahedralise(prepared.complex, prepared.sizes, {});
  EXPECT_NEAR(test::volume(mesh, geometry::lumen_label) / volume(prepared.complex, Label::lumen), 1, 1e-9);
  EXPECT_NEAR(test::volume(mesh, geometry::wall_label) / volume(prepared.complex, Label::wall), 1, 1e-9);
  std::vector<geometry::Triangle> faces;
  for (const auto& t : geometry::surface_triangles(mesh)) faces.push_back(t.nodes);
  EXPECT_EQ(sorted(faces), sorted(prepared.complex.triangles));
  geometry::Index on_curve = 0, on_rim = 0;
  for (const bool on : mesh.on_curve) on_curve += on;
  for (const auto& rim : prepared.complex.rims) on_rim += std::ssize(rim.points);
  EXPECT_EQ(on_curve, on_rim);
}

TEST(Tetrahedralise, InsideIsAsFineAsAsked) {
  const auto prepared = tube_with_wall();
  const auto count = [&](double in_lumen) {
    return std::ssize(tetrahedralise(prepared.complex, prepared.sizes, {.in_lumen = in_lumen, .in_wall = 2}).elements);
  };
  EXPECT_GT(count(0.7), 1.5 * static_cast<double>(count(1.4)));
}

TEST(Tetrahedralise, ShapesAreGoodAfterImprovement) {
  const auto prepared = tube_with_wall();
  auto mesh = tetrahedralise(prepared.complex, prepared.sizes, {});
  improve(mesh, projection(prepared), {}, [](const std::string&) {});
  const mesh::MeshData data{mesh.points, mesh.elements, {}, {}, {}, {}, {}};
  EXPECT_GT(shapes(data, 0, std::ssize(mesh.elements)).smallest_dihedral, 10);
  EXPECT_NEAR(test::volume(mesh, geometry::lumen_label) / (pi * 25e-6 * 20e-3), 1, 5e-3);
  EXPECT_NEAR(test::volume(mesh, geometry::wall_label) / (pi * 11e-6 * 20e-3), 1, 5e-3);
}

TEST(Tetrahedralise, AnOpenComplexIsAnError) {
  auto complex = tube_with_wall().complex;
  complex.triangles.resize(complex.triangles.size() - 40);
  complex.patch_of.resize(complex.triangles.size());
  EXPECT_TRUE(
      says(message_of<SolverError>([&] { tetrahedralise(complex, [](const geometry::Point&) { return 1e-3; }, {}); }),
           "not closed"));
}

TEST(Projection, FindsTheSurfaceThatFacesTheSameWay) {
  const auto prepared = tube_with_wall();
  const auto project = projection(prepared);
  const geometry::Point normal{{1, 0, 0}};
  geometry::Point p{{5.2e-3, 0, 10e-3}};
  ASSERT_TRUE(project(p, normal, geometry::lumen_label, geometry::wall_label, 0.5e-3));
  EXPECT_NEAR(p[0], 5e-3, 1e-5);
  p = {{5.6e-3, 0, 10e-3}};
  ASSERT_TRUE(project(p, normal, geometry::wall_label, geometry::outside_label, 0.5e-3));
  EXPECT_NEAR(p[0], 6e-3, 1e-5);
  EXPECT_FALSE(project(p, normal, geometry::lumen_label, geometry::wall_label, 0.5e-3));           // out of reach
  EXPECT_FALSE(project(p, -1.0 * normal, geometry::wall_label, geometry::outside_label, 0.5e-3));  // the other way
  p = {{1e-3, 1e-3, 1e-6}};
  ASSERT_TRUE(project(p, {{0, 0, -1}}, geometry::lumen_label, geometry::outside_label, 0.5e-3));
  EXPECT_EQ(p[2], 0);
}

}  // namespace
}  // namespace tunica::meshing
