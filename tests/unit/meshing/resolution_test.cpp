// Meshes that are asked for elements across, measured.
#include "tunica/meshing/resolution.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "block_vessel.hpp"
#include "tunica/meshing/patient_complex.hpp"
#include "tunica/meshing/tetrahedralise.hpp"
#include "tunica/meshing/vessel_roles.hpp"
#include "unit/geometry/small_surfaces.hpp"

namespace tunica::meshing {
namespace {

using geometry::Point;

/// 12 mm wide, then a cone over 10 mm, then 5 mm; a wall of 1.5 mm around it.
geometry::TriangleSurface two_diameters(double outwards) {
  auto surface = geometry::test::tube(1e-3, 40e-3, 32, 40);
  for (auto& p : surface.points) {
    const double radius = 6e-3 - 3.5e-3 * std::clamp((p[2] - 15e-3) / 10e-3, 0.0, 1.0) + outwards;
    p[0] *= radius / 1e-3, p[1] *= radius / 1e-3;
  }
  return surface;
}

const geometry::AcrossPart& part(const std::vector<geometry::AcrossPart>& parts, const std::string& name) {
  for (const auto& p : parts)
    if (p.name == name) return p;
  throw std::runtime_error("no part " + name);
}

TEST(Resolution, AsManyElementsAcrossAsAskedForInBothDiameters) {
  double last = 0;
  for (const double asked : {3.0, 5.0}) {
    ComplexOptions options;
    options.sizes.largest = 10e-3;
    options.sizes.per_radius = 2 / asked;
    options.sizes.per_thickness = 2;
    options.sizes.across = asked;
    options.sizes.smallest_across = 0.3e-3;
    const auto prepared = patient_complex(
        {two_diameters(0), two_diameters(1.5e-3), {{"inlet", {{0, 0, 0}}}, {"outlet", {{0, 0, 40e-3}}}}}, options);
    const auto mesh =
        tetrahedralise(prepared.complex, prepared.sizes, {.in_lumen = 1, .in_wall = 2, .lumen_size = *prepared.inside});
    const auto faces = sort_surface(mesh, prepared.openings);
    WallRegions regions;
    regions.of_element.assign(mesh.elements.size(), WallRegion::true_lumen_wall);
    regions.side.assign(mesh.points.size(), 1.0);
    const auto parts = resolution(mesh, prepared.openings, faces, regions, {});
    ASSERT_EQ(parts.size(), 3U);
    for (const char* name : {"lumen_inlet", "lumen_outlet", "lumen"}) {
      EXPECT_GT(part(parts, name).median, 0.9 * asked) << name;
      EXPECT_LT(part(parts, name).median, 1.6 * asked) << name;
      EXPECT_GT(part(parts, name).least, 0.75 * asked) << name;
    }
    EXPECT_NEAR(part(parts, "lumen_inlet").diameter, 12e-3, 0.5e-3);
    EXPECT_NEAR(part(parts, "lumen_outlet").diameter, 5e-3, 0.3e-3);
    EXPECT_FALSE(geometry::too_few_across(parts, asked));
    EXPECT_TRUE(geometry::too_few_across(parts, 2 * asked));
    EXPECT_GT(part(parts, "lumen").median, last);
    last = part(parts, "lumen").median;
  }
}

TEST(Resolution, OfTheLumensAndTheTearOfABlock) {
  // Cells of 1 mm: the true lumen is three wide, the hole in the flap two by two.
  const test::BlockVessel vessel;
  const auto mesh = test::block_vessel(vessel);
  const auto openings = test::block_openings(vessel);
  const auto faces = sort_surface(mesh, openings);
  WallRegions regions;
  regions.of_element.assign(mesh.elements.size(), WallRegion::flap);
  for (const auto& p : mesh.points) {
    const bool level = p[2] > (vessel.from + 1) * 1e-3 - 1e-9 && p[2] < (vessel.to - 1) * 1e-3 + 1e-9;
    regions.side.push_back(level ? 4.5e-3 - p[0] : 1e-3);
  }
  const auto tears = find_tears(mesh, regions.side);
  ASSERT_EQ(tears.size(), 1U);
  EXPECT_EQ(tears[0].elements.size(), 24U);  // the four cells of the hole
  const auto parts = resolution(mesh, openings, faces, regions, tears);
  ASSERT_EQ(parts.size(), 5U);
  // All nodes of the hole lie on its sharp rims, where normals are those of an edge: its diagonal is seen.
  EXPECT_GT(part(parts, "tear_1").median, 2 / 1.11 - 0.2);
  EXPECT_LT(part(parts, "tear_1").median, std::sqrt(2) * 2 / 1.11 + 0.2);
  EXPECT_GT(part(parts, "tear_1").diameter, 1.9e-3);
  EXPECT_LT(part(parts, "tear_1").diameter, 2.9e-3);
  EXPECT_NEAR(part(parts, "true_lumen").least, 3 / 1.11, 0.6);
  EXPECT_NEAR(part(parts, "true_lumen").median, 7 / 1.11, 1);  // most of it is where there is no flap
  EXPECT_NEAR(part(parts, "lumen_inlet").median, 7 / 1.11, 1.2);
  EXPECT_GT(part(parts, "false_lumen").median, 2);
}

}  // namespace
}  // namespace tunica::meshing
