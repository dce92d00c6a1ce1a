// What is what in a vessel with a branch: openings, roles, regions of the wall, surfaces between the lumens.
#include <gtest/gtest.h>

#include <cmath>

#include "block_vessel.hpp"
#include "tunica/mesh/boundary.hpp"
#include "tunica/meshing/element_cut.hpp"
#include "tunica/meshing/tears.hpp"
#include "tunica/meshing/vessel_roles.hpp"
#include "unit/geometry/small_surfaces.hpp"

namespace tunica::meshing {
namespace {

using geometry::Point;

/// An aorta of 8 x 8 cells of 1 mm along z, 20 long, and a branch of 4 x 4 cells (a lumen of 2 x 2) towards x at half
/// of its length, 10 long.
geometry::Tetrahedra branched() {
  const auto box = mesh::box(18, 8, 20, {{18e-3, 8e-3, 20e-3}}, mesh::RegionKind::wall);
  geometry::Tetrahedra mesh;
  mesh.points = box.points;
  for (const auto& t : box.tetrahedra) {
    const Point c = 1e3 * mesh::centroid(box.points, t);
    const bool in_aorta = c[0]<8, in_branch = c[0]> 7 && std::abs(c[1] - 4) < 2 && std::abs(c[2] - 10) < 2;
    if (!in_aorta && !in_branch) continue;
    const bool lumen = (c[0] > 1 && c[0] < 7 && c[1] > 1 && c[1] < 7) ||
                       (c[0] > 4 && std::abs(c[1] - 4) < 1 && std::abs(c[2] - 10) < 1);
    mesh.elements.push_back(t);
    mesh.labels.push_back(lumen ? geometry::lumen_label : geometry::wall_label);
  }
  mesh.on_curve.assign(mesh.points.size(), false);
  return mesh;
}
std::vector<geometry::Opening> openings() {
  return {{"branch", {{18e-3, 4e-3, 10e-3}}, {{1, 0, 0}}, 0, 3e-3, {}, {}, 0},
          {"outlet", {{4e-3, 4e-3, 20e-3}}, {{0, 0, 1}}, 0, 6e-3, {}, {}, 0},
          {"inlet", {{4e-3, 4e-3, 0}}, {{0, 0, -1}}, 0, 6e-3, {}, {}, 0}};
}

double area(const geometry::Tetrahedra& mesh, const std::vector<std::array<geometry::Index, 3>>& triangles) {
  double sum = 0;
  for (const auto& t : triangles) sum += norm(mesh::area_vector(mesh.points, t));
  return sum;
}

TEST(VesselRoles, TheInletComesFirstAndTheOthersKeepTheirOrder) {
  const auto names = [](const std::vector<geometry::Opening>& list) {
    std::string text;
    for (const auto& o : list) text += o.name + " ";
    return text;
  };
  VesselRoles roles;
  EXPECT_EQ(names(with_inlet_first(openings(), roles)), "branch outlet inlet ");
  roles.inlet = "inlet";
  EXPECT_EQ(names(with_inlet_first(openings(), roles)), "inlet branch outlet ");
  roles.inlet = "ascending";
  roles.aorta_ends = {"outlet", "iliac"};
  const auto text = geometry::test::message_of<InputError>([&] { with_inlet_first(openings(), roles); });
  for (const char* part : {"inlet: there is no opening 'ascending'", "aorta_ends: there is no opening 'iliac'",
                           "take one of branch, outlet, inlet"})
    EXPECT_TRUE(geometry::test::says(text, part)) << part << " in\n" << text;
}

TEST(SortSurface, GivesEachOpeningItsCapAndRing) {
  const auto mesh = branched();
  const auto faces = sort_surface(mesh, openings());
  const double mm2 = 1e-6;
  EXPECT_NEAR(area(mesh, faces.caps[0]) / mm2, 4, 1e-9);
  EXPECT_NEAR(area(mesh, faces.rings[0]) / mm2, 12, 1e-9);
  for (const int o : {1, 2}) {
    EXPECT_NEAR(area(mesh, faces.caps[static_cast<std::size_t>(o)]) / mm2, 36, 1e-9);
    EXPECT_NEAR(area(mesh, faces.rings[static_cast<std::size_t>(o)]) / mm2, 28, 1e-9);
  }
  // Sides of the aorta and the branch, less or more where they meet.
  EXPECT_NEAR(area(mesh, faces.outer) / mm2, 4 * 8 * 20 - 16 + 4 * 4 * 10, 1e-9);
  EXPECT_NEAR(area(mesh, faces.interface) / mm2, 4 * 6 * 20 - 4 + 4 * 2 * 11, 1e-9);
  auto closed = openings();
  closed[1].centre[2] = 15e-3;  // there is none
  EXPECT_TRUE(geometry::test::says(geometry::test::message_of<SolverError>([&] { sort_surface(mesh, closed); }),
                                   "lie on the outside, where there is no opening"));
}

TEST(WallRegions, ABranchBeginsWhereItsLumenWidens) {
  const auto mesh = branched();
  VesselRoles roles;
  roles.inlet = "inlet";
  roles.aorta_ends = {"outlet"};
  const auto ordered = with_inlet_first(openings(), roles);
  const auto faces = sort_surface(mesh, ordered);
  const auto regions = wall_regions(mesh, faces, ordered, roles);
  int far = 0;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    if (mesh.labels[e] != geometry::wall_label) continue;
    const Point c = 1e3 * mesh::centroid(mesh.points, mesh.elements[e]);
    // Beside the lumen of the branch: what lies at its corners no shortest way through the wall meets.
    if (c[0] > 9.5 && std::min(std::abs(c[1] - 4), std::abs(c[2] - 10)) < 1) {
      EXPECT_EQ(regions.of_element[e], WallRegion::branches) << c[0] << " " << c[1] << " " << c[2];
      ++far;
    }
    if (c[0] < 6 || std::abs(c[2] - 10) > 5) {
      EXPECT_EQ(regions.of_element[e], WallRegion::true_lumen_wall) << c[0] << " " << c[1] << " " << c[2];
    }
  }
  EXPECT_GT(far, 200);
  // There is no dissection: all blood is on one side.
  for (std::size_t n = 0; n < mesh.points.size(); ++n) EXPECT_GE(regions.side[n], 0);
  // An aorta that ends in three places has no branch.
  roles.aorta_ends = {"outlet", "branch"};
  for (const auto region : wall_regions(mesh, faces, ordered, roles).of_element)
    EXPECT_EQ(region, WallRegion::true_lumen_wall);
}

/// A lumen of 4 x 6 x 6, and where a linear function is zero in it.
TEST(FindTears, SurfacesOfOneFunctionArePlanes) {
  const auto box = mesh::box(4, 6, 6, {{4, 6, 6}}, mesh::RegionKind::lumen);
  const geometry::Tetrahedra mesh{box.points, box.tetrahedra,
                                  std::vector<int>(box.tetrahedra.size(), geometry::lumen_label),
                                  std::vector<bool>(box.points.size(), false)};
  const auto find = [&](const auto& function) {
    std::vector<double> side;
    for (const auto& x : mesh.points) side.push_back(function(x));
    return find_tears(mesh, side);
  };
  // Sloping across y, z: area times sqrt(1 + 1/4 + 1/9).
  auto tears = find([](const Point& x) { return x[0] - 0.7 - x[1] / 3 + x[2] / 6; });
  ASSERT_EQ(tears.size(), 1U);
  const double slope = std::sqrt(1 + 1.0 / 9 + 1.0 / 36);
  EXPECT_NEAR(tears[0].area, 36 * slope, 2.5);  // but for two corners that the box cuts off
  EXPECT_NEAR(norm(tears[0].normal - (1 / slope) * Point{{1, -1.0 / 3, 1.0 / 6}}), 0, 1e-12);
  tears = find([](const Point& x) { return x[0] - 1.35 - x[1] / 6; });
  EXPECT_NEAR(tears[0].area, 36 * std::sqrt(1 + 1.0 / 36), 1e-12);
  EXPECT_NEAR(norm(tears[0].centre - Point{{1.85, 3, 3}}), 0, 0.02);  // pieces count by the mean of their corners
  // Two at once, the larger one first, both facing where the function is positive.
  tears = find([](const Point& x) { return std::abs(x[0] - 2.2 + 0.1 * x[1]) - 1.1; });
  ASSERT_EQ(tears.size(), 2U);
  for (const auto& tear : tears) EXPECT_NEAR(std::abs(tear.normal[0]), 1, 0.1);
  EXPECT_LT(dot(tears[0].normal, tears[1].normal), -0.9);
  EXPECT_GE(tears[0].area, tears[1].area);
}

TEST(ZeroPolygon, PartsOfAMeshMakeUpThePlaneSection) {
  const auto box = mesh::box(3, 4, 5, {{1, 2, 3}}, mesh::RegionKind::lumen);
  const Vec3<double> normal{{0.5, 0.1, 1}};
  double sum = 0;
  for (const auto& t : box.tetrahedra) {
    std::array<Point, 4> corners;
    std::array<double, 4> values;
    for (int k = 0; k < 4; ++k) {
      corners[k] = box.points[static_cast<std::size_t>(t[k])];
      values[k] = dot(normal, corners[k]) - 1.7;
    }
    const auto polygon = zero_polygon(corners, values);
    for (const auto& p : polygon) EXPECT_NEAR(dot(normal, p), 1.7, 1e-14);
    Vec3<double> area{{0, 0, 0}};
    for (std::size_t k = 2; k < polygon.size(); ++k)
      area = area + 0.5 * cross(polygon[k - 1] - polygon[0], polygon[k] - polygon[0]);
    sum += norm(area);
  }
  EXPECT_NEAR(sum, 2 * norm(normal), 1e-12);  // seen from above it is the whole base
}

}  // namespace
}  // namespace tunica::meshing
