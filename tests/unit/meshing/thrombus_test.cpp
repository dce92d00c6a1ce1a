// A clot in a wall: a block of tetrahedra around a tube, with a body that reaches into it on one side.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "tunica/mesh/boundary.hpp"
#include "tunica/mesh/generate.hpp"
#include "tunica/meshing/wall_regions.hpp"
#include "unit/geometry/small_surfaces.hpp"

namespace tunica::meshing {
namespace {

using geometry::Point;

constexpr double voxel = 0.3e-3, radius = 5e-3, length = 20e-3, deep = 2.5e-3;

/// A tube with a wall of 4 mm.
geometry::Tetrahedra tube_with_wall(int cells_around, int cells_through_wall) {
  const auto data = mesh::tube({.radius = radius,
                                .length = length,
                                .wall_thickness = 4e-3,
                                .cells_around = cells_around,
                                .cells_radial = 3,
                                .cells_along = 20,
                                .cells_through_wall = cells_through_wall});
  // Regions of MeshData have nodes of their own: those of a pair become one.
  std::vector<geometry::Index> number(data.points.size());
  std::iota(number.begin(), number.end(), geometry::Index{0});
  for (const auto& [wall, lumen] : data.twins) number[static_cast<std::size_t>(wall)] = lumen;
  geometry::Tetrahedra mesh;
  std::vector<geometry::Index> place(data.points.size(), -1);
  for (std::size_t n = 0; n < data.points.size(); ++n)
    if (number[n] == static_cast<geometry::Index>(n)) {
      place[n] = std::ssize(mesh.points);
      mesh.points.push_back(data.points[n]);
      mesh.on_curve.push_back(false);
    }
  for (const auto& region : data.regions)
    for (auto e = region.first_element; e < region.end_element; ++e) {
      auto& nodes = mesh.elements.emplace_back();
      for (std::size_t a = 0; a < 4; ++a)
        nodes[a] = place[static_cast<std::size_t>(
            number[static_cast<std::size_t>(data.tetrahedra[static_cast<std::size_t>(e)][a])])];
      mesh.labels.push_back(region.kind == mesh::RegionKind::lumen ? geometry::lumen_label : geometry::wall_label);
    }
  return mesh;
}

/// The lumen, and 2.5 mm more where x is positive.
geometry::TriangleSurface lumen_and_clot() {
  auto body = geometry::test::tube(radius, length, 96, 40);
  for (auto& p : body.points) {
    const double r = std::hypot(p[0], p[1]);
    const double grown = r + deep * std::max(0.0, p[0] / r);
    p[0] *= grown / r;
    p[1] *= grown / r;
  }
  return body;
}

/// Between the circles: the integral of r g + g^2 / 2 over the half circle, g = 2.5 mm cos phi.
const double exact = length * (2 * radius * deep + deep * deep * std::numbers::pi / 4);

WallRegions all_true_lumen(const geometry::Tetrahedra& mesh, double side) {
  WallRegions regions;
  regions.of_element.assign(mesh.elements.size(), WallRegion::true_lumen_wall);
  regions.side.assign(mesh.points.size(), side);
  return regions;
}

TEST(Thrombus, IsTheWallInsideTheBody) {
  const auto mesh = tube_with_wall(48, 8);
  auto regions = all_true_lumen(mesh, 1);
  const double volume = mark_thrombus(mesh, thrombus_within(lumen_and_clot(), voxel), regions);
  double marked = 0;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    if (regions.of_element[e] != WallRegion::thrombus) continue;
    EXPECT_EQ(mesh.labels[e], geometry::wall_label);
    const Point c = mesh::centroid(mesh.points, mesh.elements[e]);
    EXPECT_GT(c[0], 0);
    EXPECT_LT(std::hypot(c[0], c[1]), 7.5e-3);
    marked += std::abs(mesh::volume(mesh.points, mesh.elements[e]));
  }
  EXPECT_NEAR(volume, marked, 1e-6 * marked);
  EXPECT_NEAR(volume, exact, 0.08 * exact);
}

// One element reaches from the lumen to the outside: without new nodes there is no clot, or no wall behind it.
TEST(Thrombus, IsPartedFromTheWallBehindIt) {
  auto mesh = tube_with_wall(32, 1);
  double before = 0;
  for (const auto& e : mesh.elements) before += mesh::volume(mesh.points, e);
  const auto thrombus = thrombus_within(lumen_and_clot(), voxel);
  const auto stay = [](Point&, const Point&, int, int, double) { return false; };
  EXPECT_GT(part_thrombus(mesh, thrombus, stay, [](const std::string&) {}), 100);
  double after = 0;
  for (const auto& e : mesh.elements) {
    EXPECT_GT(mesh::volume(mesh.points, e), 0);
    after += mesh::volume(mesh.points, e);
  }
  EXPECT_NEAR(after, before, 1e-9 * before);
  auto regions = all_true_lumen(mesh, -1);
  EXPECT_NEAR(mark_thrombus(mesh, thrombus, regions), exact, 0.06 * exact);
  std::size_t behind = 0;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    if (mesh.labels[e] != geometry::wall_label) continue;
    for (const auto n : mesh.elements[e]) {
      const auto& x = mesh.points[static_cast<std::size_t>(n)];
      const double r = std::hypot(x[0], x[1]);
      if (regions.of_element[e] == WallRegion::thrombus) {
        EXPECT_LT(r, radius + deep + voxel);
      }
    }
    behind += regions.of_element[e] == WallRegion::false_lumen_wall;
  }
  EXPECT_GT(behind, 100U) << "the wall behind the clot is that of the lumen that it lies in";
}

}  // namespace
}  // namespace tunica::meshing
