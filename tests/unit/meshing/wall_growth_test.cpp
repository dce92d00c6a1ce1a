#include "tunica/meshing/wall_growth.hpp"

#include "tunica/geometry/surface_file.hpp"
#include "tunica/geometry/triangle_tree.hpp"
#include "unit/geometry/small_surfaces.hpp"

namespace tunica::meshing {
namespace {

using namespace geometry::test;

GrowthSettings settings() {
  GrowthSettings s;
  s.spacing = 0.8e-3;
  return s;
}

TEST(WallGrowth, UniformAroundATube) {
  const auto lumen = tube(5e-3, 15e-3, 48, 20);
  const auto openings = geometry::find_openings(lumen, nullptr, {});
  const auto outer = grow_wall(lumen, std::vector<double>(lumen.points.size(), 1.5e-3), openings, settings());
  EXPECT_EQ(geometry::genus(outer, 2), 0);
  const auto loops = geometry::boundary_loops(outer);
  ASSERT_EQ(loops.size(), 2u);
  for (const auto& loop : loops)
    for (const auto p : loop) EXPECT_NEAR(std::abs(outer.points[p][2] - 7.5e-3), 7.5e-3, 1e-12);
  for (const auto& p : outer.points) EXPECT_NEAR(std::hypot(p[0], p[1]), 6.5e-3, 0.08e-3);
  const auto normals = geometry::point_normals(outer);
  for (std::size_t p = 0; p < normals.size(); ++p) EXPECT_GT(dot(normals[p], outer.points[p]), 0);
}

TEST(WallGrowth, ThicknessFollowsItsField) {
  const auto lumen = tube(5e-3, 20e-3, 48, 24);
  std::vector<double> thickness;
  for (const auto& p : lumen.points) thickness.push_back(1.2e-3 + 0.05 * p[2]);
  const auto outer = grow_wall(lumen, thickness, geometry::find_openings(lumen, nullptr, {}), settings());
  for (const auto& p : outer.points) EXPECT_NEAR(std::hypot(p[0], p[1]), 6.2e-3 + 0.05 * p[2], 0.12e-3);
}

TEST(WallGrowth, BetweenTwoLumensTheWallIsSolid) {
  // A tube and a closed lumen beside it, 2 mm apart, with walls of 1.5 mm: one outer surface, round in the notch.
  const auto lumen = two_lumens();
  const std::vector<double> thickness(lumen.points.size(), 1.5e-3);
  const auto outer = grow_wall(lumen, thickness, geometry::find_openings(lumen, nullptr, {}), settings());
  EXPECT_EQ(geometry::genus(outer, 2), 0);
  const auto part = geometry::components(outer);
  EXPECT_EQ(*std::max_element(part.begin(), part.end()), 0);
  // The notch at x = 0: without fillet the surface would be at y = sqrt(5.5^2 - 5^2) = 2.29 mm.
  double notch = 1;
  for (const auto& p : outer.points)
    if (std::abs(p[0]) < 1e-3 && std::abs(p[2]) < 4e-3) notch = std::min(notch, std::abs(p[1]));
  const double centre = std::sqrt(6.5 * 6.5 - 5 * 5) - 1;  // of the fillet circle, less its radius
  EXPECT_GT(notch, 1e-3 * centre - 0.05e-3);
  EXPECT_LT(notch, 1e-3 * centre + 0.6 * settings().spacing);  // the contour fills the bottom of a notch a little
}

TEST(WallGrowth, ThicknessByRadius) {
  const auto lumen = tube(8e-3, 40e-3, 48, 40);
  GrowthSettings s = settings();
  s.per_radius = 0.2;
  s.thinnest = 1e-3;
  s.thickest = 2e-3;
  for (const auto t : thickness_by_radius(lumen, geometry::find_openings(lumen, nullptr, {}), s))
    EXPECT_NEAR(t, 1.6e-3, 0.1e-3);
  s.thinnest = s.thickest;
  for (const auto t : thickness_by_radius(lumen, geometry::find_openings(lumen, nullptr, {}), s)) EXPECT_EQ(t, 2e-3);
}

// Painted on the upper half of a tube in another unit, nan below.
TEST(WallGrowth, ThicknessAsGiven) {
  const Folder folder;
  const auto lumen = tube(5e-3, 20e-3, 48, 24);
  auto painted = lumen;
  std::vector<double> values;
  for (auto& p : painted.points) {
    values.push_back(p[2] > 10e-3 ? 100 * (1e-3 + 0.1 * (p[2] - 10e-3)) : std::nan(""));  // cm
    p = 1e3 * p;
  }
  ThicknessField field{
      .file = folder.path / "painted.vtp", .array = "thickness", .metres_per_unit = 1e-3, .metres_per_value = 1e-2};
  geometry::write_surface(painted, field.file, {{"thickness", values}});
  std::vector<double> thickness(lumen.points.size(), 1.5e-3);
  const auto taken = take_thickness(field, lumen.points, thickness);
  std::size_t above = 0;
  for (std::size_t p = 0; p < thickness.size(); ++p) {
    const double z = lumen.points[p][2];
    EXPECT_NEAR(thickness[p], z > 10e-3 ? 1e-3 + 0.1 * (z - 10e-3) : 1.5e-3, 1e-8);
    above += z > 10e-3 ? 1 : 0;
  }
  EXPECT_EQ(taken, above);

  const auto refused = [&](const ThicknessField& wrong) {
    return message_of<InputError>([&] { take_thickness(wrong, lumen.points, thickness); });
  };
  auto wrong = field;
  wrong.metres_per_value = 1.0;
  EXPECT_TRUE(says(refused(wrong), "no thickness of a wall")) << refused(wrong);
  wrong = field;
  wrong.array = "dicke";
  EXPECT_TRUE(says(refused(wrong), "dicke"));
  wrong = field;
  wrong.reach = 1e-3;
  for (auto& p : painted.points) p = p + geometry::Point{{50, 0, 0}};
  geometry::write_surface(painted, field.file, {{"thickness", values}});
  EXPECT_TRUE(says(refused(wrong), "no point of the lumen is within 1 mm")) << refused(wrong);
  geometry::write_surface(painted, field.file, {}, {{"thickness", std::vector<double>(painted.triangles.size(), 0.1)}});
  EXPECT_TRUE(says(refused(field), "thickness")) << "an array of triangles is none of points: " << refused(field);
}

TEST(CutEnd, LeavesAPlaneRim) {
  const auto surface =
      geometry::cut_end(tube(5e-3, 20e-3, 40, 21), {{{0, 0, 10e-3}}, {{0, 0.1, std::sqrt(0.99)}}, 6e-3});
  EXPECT_EQ(geometry::genus(surface, 2), 0);
  for (const auto& p : surface.points) EXPECT_LT(0.1 * p[1] + std::sqrt(0.99) * (p[2] - 10e-3), 1e-9);
}

TEST(CutEnd, RefusesMoreThanAnEnd) {
  const auto text = message_of<SolverError>([] {
    geometry::cut_end(tube(5e-3, 20e-3, 40, 21), {{{5e-3, 0, 10e-3}}, {{1, 0, 0}}, 2e-3});
  });
  EXPECT_TRUE(text.empty()) << text;  // a plane that touches only
  const auto other = message_of<SolverError>([] {
    geometry::cut_end(tube(5e-3, 20e-3, 40, 21), {{{0, 0, 10e-3}}, {{1, 0, 0}}, 6e-3});
  });
  EXPECT_TRUE(says(other, "touches another vessel")) << other;
}

}  // namespace
}  // namespace tunica::meshing
