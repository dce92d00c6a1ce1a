// A clot in a wall: a block of tetrahedra around a tube, with a body that reaches into it on one side.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tunica/mesh/boundary.hpp"
#include "tunica/mesh/generate.hpp"
#include "tunica/meshing/wall_regions.hpp"
#include "unit/geometry/small_surfaces.hpp"

namespace tunica::meshing {
namespace {

using geometry::Point;

TEST(Thrombus, IsTheWallInsideTheBody) {
  // A tube with a wall of 4 mm; the body is the lumen, and 2.5 mm more where x is positive.
  const auto data = mesh::tube({.radius = 5e-3,
                                .length = 20e-3,
                                .wall_thickness = 4e-3,
                                .cells_around = 48,
                                .cells_radial = 3,
                                .cells_along = 20,
                                .cells_through_wall = 8});
  geometry::Tetrahedra mesh;
  mesh.points = data.points;
  for (const auto& region : data.regions)
    for (auto e = region.first_element; e < region.end_element; ++e) {
      mesh.elements.push_back(data.tetrahedra[static_cast<std::size_t>(e)]);
      mesh.labels.push_back(region.kind == mesh::RegionKind::lumen ? geometry::lumen_label : geometry::wall_label);
    }
  auto body = geometry::test::tube(5e-3, 20e-3, 96, 40);
  for (auto& p : body.points) {
    const double r = std::hypot(p[0], p[1]);
    const double grown = r + 2.5e-3 * std::max(0.0, p[0] / r);
    p[0] *= grown / r;
    p[1] *= grown / r;
  }
  WallRegions regions;
  regions.of_element.assign(mesh.elements.size(), WallRegion::true_lumen_wall);
  const double voxel = 0.3e-3, volume = mark_thrombus(mesh, body, voxel, regions);
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
  // Between the circles: the integral of r g + g^2 / 2 over the half circle, g = 2.5 mm cos phi.
  const double r = 5e-3, g = 2.5e-3, exact = 20e-3 * (2 * r * g + g * g * std::numbers::pi / 4);
  EXPECT_NEAR(volume, exact, 0.08 * exact);
}

}  // namespace
}  // namespace tunica::meshing
