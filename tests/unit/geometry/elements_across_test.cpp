#include "tunica/geometry/elements_across.hpp"

#include <numeric>

#include "small_surfaces.hpp"
#include "tunica/geometry/size_field.hpp"
#include "tunica/mesh/generate.hpp"

namespace tunica::geometry {
namespace {

using namespace test;

/// Of a tube of 10 mm: count and diameter at all nodes, in one part.
AcrossPart of_tube(const mesh::TubeSizes& sizes) {
  const auto tube = mesh::tube(sizes);
  std::vector<Triangle> wall;
  for (const auto& face : tube.faces)
    if (face.name == "lumen_wall") wall = face.triangles;
  const auto across = elements_across(tube.points, tube.tetrahedra, wall);
  EXPECT_NEAR(std::accumulate(across.volume.begin(), across.volume.end(), 0.0),
              0.5 * sizes.cells_around * std::sin(2 * M_PI / sizes.cells_around) * 25e-6 * sizes.length, 1e-12);
  for (std::size_t p = 0; p < tube.points.size(); ++p) EXPECT_NEAR(across.diameter[p], 10e-3, 0.5e-3);
  return *across_part("lumen", tube.points, across, [](std::int64_t) { return true; });
}

TEST(LumenDiameter, OfATubeWhateverItsTriangles) {
  for (const int around : {8, 16, 60})
    for (const double d : lumen_diameter(TriangleTree(tube(5e-3, 20e-3, around, around / 2)), 0.1).value)
      EXPECT_NEAR(d, 10e-3, around < 10 ? 0.8e-3 : 0.2e-3) << around;
  for (const double d : lumen_diameter(TriangleTree(tube(5e-3, 20e-3, 16, 8)), 8e-3).value) EXPECT_TRUE(std::isinf(d));
}

TEST(LumenDiameter, AcrossEachLumenOfADissection) {
  // The flap is 2 mm thick and stands in the middle of 20 mm.
  const TriangleTree lumen(dissected_tube());
  const auto diameter = lumen_diameter(lumen, 0.1).value;
  const auto& points = lumen.surface().points;
  int beside = 0, above = 0;
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (std::abs(points[p][2]) < 12e-3 && std::abs(points[p][0]) < 1.1e-3 && std::abs(points[p][1]) < 1e-3) {
      EXPECT_NEAR(diameter[p], 9e-3, 0.3e-3);
      ++beside;
    }
    if (std::abs(points[p][2]) > 27e-3 && std::abs(points[p][0]) > 5e-3) {
      EXPECT_NEAR(diameter[p], 20e-3, 1e-3);
      ++above;
    }
  }
  EXPECT_GT(beside, 20);
  EXPECT_GT(above, 20);
}

TEST(LumenDiameter, ACornerIsNoNarrowPlace) {
  // A square duct: nothing but the opposite wall counts, up to its edges.
  const double half = 5e-3;
  auto duct = contour({{7e-3, 7e-3, 12e-3}}, 0.7e-3, [&](const Point& x) {
    return std::max({std::abs(x[0]) - half, std::abs(x[1]) - half, std::abs(x[2]) - 10e-3});
  });
  const TriangleTree tree(duct);
  const auto diameter = lumen_diameter(tree, 0.1).value;
  for (std::size_t p = 0; p < duct.points.size(); ++p) EXPECT_GT(diameter[p], 9e-3);
}

TEST(ElementsAcross, OfATubeWithKnownCells) {
  // Four cells of the core and twice the radial ones; a cell in six tetrahedra counts 1.1 edges, as its volume would.
  const mesh::TubeSizes sizes{
      .radius = 5e-3, .length = 20e-3, .cells_around = 16, .cells_radial = 2, .cells_along = 16};
  const auto part = of_tube(sizes);
  EXPECT_NEAR(part.median, 8 / 1.11, 0.15 * 8);
  EXPECT_GT(part.least, 0.6 * part.median);
  EXPECT_LT(part.least, part.median);
  const auto twice =
      of_tube({.radius = 5e-3, .length = 20e-3, .cells_around = 32, .cells_radial = 4, .cells_along = 32});
  EXPECT_NEAR(twice.median / part.median, 2, 0.1);
  EXPECT_NEAR(twice.least / part.least, 2, 0.2);
  // How long elements are along the vessel does not matter.
  const auto longer =
      of_tube({.radius = 5e-3, .length = 60e-3, .cells_around = 16, .cells_radial = 2, .cells_along = 16});
  EXPECT_NEAR(longer.median / part.median, 1, 0.02);
}

TEST(ElementsAcross, TooFewAreNamedWithTheirPlace) {
  const std::vector<AcrossPart> parts = {{"lumen_inlet", 3.5, 4, 30e-3, {{0, 0, 0}}},
                                         {"tear_1", 1.9, 2.2, 6.8e-3, {{1e-3, 2e-3, 3e-3}}},
                                         {"true_lumen", 2.5, 4.4, 9e-3, {{0, 0, 0}}}};
  const auto text = too_few_across(parts, 4);
  ASSERT_TRUE(text);
  EXPECT_NE(text->find("than the 4 that flow needs: tear_1 1.9 (6.8 mm wide near (1.00, 2.00, 3.00) mm), true_lumen"),
            std::string::npos)
      << *text;
  EXPECT_EQ(text->find("lumen_inlet"), std::string::npos) << *text;
  EXPECT_FALSE(too_few_across({parts[0]}, 4));
  EXPECT_TRUE(too_few_across({parts[0]}, 10));
}

TEST(SurfaceSizes, ByTheDiameterOfATubeOfTwo) {
  // 16 mm wide, then a cone over 10 mm, then 5 mm.
  auto surface = tube(1e-3, 50e-3, 48, 80);
  for (auto& p : surface.points) {
    const double radius = 8e-3 - 5.5e-3 * std::clamp((p[2] - 20e-3) / 10e-3, 0.0, 1.0);
    p[0] *= radius / 1e-3, p[1] *= radius / 1e-3;
  }
  const TriangleTree tree(surface);
  const auto diameter = lumen_diameter(tree, 0.1).value;
  SizeSettings settings;
  settings.largest = 20e-3;
  settings.per_radius = 10;
  settings.across = 4;
  const auto on_surface = surface_sizes(surface, {}, diameter, settings),
             inside = lumen_sizes(surface, diameter, settings);
  for (std::size_t p = 0; p < surface.points.size(); ++p) {
    const double z = surface.points[p][2];
    EXPECT_NEAR(on_surface[p], inside[p], 1e-12);
    if (z < 8e-3) {
      EXPECT_NEAR(inside[p], 16e-3 / 5, 0.2e-3) << z;
    }
    if (z > 31e-3) {
      EXPECT_NEAR(inside[p], 5e-3 / 5, 0.07e-3) << z;
    }
  }
  for (const auto& e : edges(surface))
    EXPECT_LE(std::abs(inside[e.a] - inside[e.b]),
              settings.gradation * norm(surface.points[e.a] - surface.points[e.b]) + 1e-12);
  settings.smallest_across = 2e-3;
  settings.largest = 2.5e-3;
  const auto bounded = lumen_sizes(surface, diameter, settings);
  EXPECT_NEAR(*std::min_element(bounded.begin(), bounded.end()), 2e-3, 1e-9);
  EXPECT_NEAR(*std::max_element(bounded.begin(), bounded.end()), 2.5e-3, 1e-9);
}

}  // namespace
}  // namespace tunica::geometry
