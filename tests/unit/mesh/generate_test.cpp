#include "tunica/mesh/generate.hpp"

#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "tunica/base/error.hpp"
#include "unit/mesh/check_mesh.hpp"

namespace tunica::mesh {

using std::numbers::pi;
using testing::area;
using testing::expect_sound;
using testing::volume;

TEST(Box, IsSoundAndHasExactVolumeAndAreas) {
  const auto mesh = box(3, 2, 4, {{0.3, 0.5, 0.2}}, RegionKind::wall);
  expect_sound(mesh);
  EXPECT_EQ(mesh.points.size(), 4u * 3 * 5);
  EXPECT_EQ(mesh.tetrahedra.size(), 6u * 3 * 2 * 4);
  EXPECT_EQ(mesh.faces.size(), 6u);
  EXPECT_EQ(mesh.regions.at(0).name, "wall");
  EXPECT_NEAR(volume(mesh, mesh.regions[0]), 0.03, 1e-15);
  EXPECT_NEAR(area(mesh, "x_min"), 0.1, 1e-15);
  EXPECT_NEAR(area(mesh, "y_max"), 0.06, 1e-15);
  EXPECT_NEAR(area(mesh, "z_max"), 0.15, 1e-15);
  for (const auto& t : testing::face(mesh, "y_max").triangles)
    for (auto n : t) EXPECT_DOUBLE_EQ(mesh.points[n][1], 0.5);
}

TEST(Box, RefusesBadSizes) {
  EXPECT_THROW(box(0, 1, 1, {{1, 1, 1}}, RegionKind::lumen), InputError);
  EXPECT_THROW(box(1, 1, 1, {{1, -1, 1}}, RegionKind::lumen), InputError);
}

TubeSizes sizes(int refinement) {
  return {.radius = 0.01,
          .length = 0.03,
          .wall_thickness = 0.002,
          .cells_around = 12 * refinement,
          .cells_radial = 2 * refinement,
          .cells_along = 3 * refinement,
          .cells_through_wall = refinement};
}

TEST(Tube, IsSound) {
  for (int r : {1, 2, 3}) expect_sound(tube(sizes(r)));
  auto without_wall = sizes(1);
  without_wall.wall_thickness = 0;
  const auto lumen = tube(without_wall);
  expect_sound(lumen);
  EXPECT_EQ(lumen.regions.size(), 1u);
  EXPECT_TRUE(lumen.twins.empty());
}

TEST(Tube, CountsWhoseProductIsTooLargeAreRefusedBeforeAnythingIsMade) {
  auto large = sizes(1);
  EXPECT_EQ(objection_to_counts(large), "");
  large.cells_around = large.cells_radial = 10000;
  large.cells_along = 4;
  EXPECT_NE(objection_to_counts(large).find("5.31e+08 nodes"), std::string::npos) << objection_to_counts(large);
  large.cells_along = 100000;
  large.cells_through_wall = 1000;
  EXPECT_NE(objection_to_counts(large).find("at most 5.37e+08"), std::string::npos) << objection_to_counts(large);
  EXPECT_THROW(tube(large), InputError);
  // As many nodes as are said.
  for (const double thickness : {0.0, 0.002}) {
    auto s = sizes(1);
    s.wall_thickness = thickness;
    EXPECT_EQ(tube(s).points.size(), thickness > 0 ? 4u * (16 + 24 + 24) : 4u * (16 + 24));
  }
}

TEST(Tube, VolumesAndAreasConvergeAtSecondOrder) {
  const double R = 0.01, L = 0.03, H = 0.002;
  const auto errors = [&](int r) {
    const auto m = tube(sizes(r));
    return std::array{volume(m, m.regions[0]) / (pi * R * R * L) - 1,
                      volume(m, m.regions[1]) / (pi * ((R + H) * (R + H) - R * R) * L) - 1,
                      area(m, "lumen_wall") / (2 * pi * R * L) - 1,
                      area(m, "wall_outer") / (2 * pi * (R + H) * L) - 1,
                      area(m, "lumen_inlet") / (pi * R * R) - 1,
                      area(m, "wall_outlet") / (pi * ((R + H) * (R + H) - R * R)) - 1};
  };
  const auto coarse = errors(2), fine = errors(4);
  for (std::size_t i = 0; i < coarse.size(); ++i) {
    EXPECT_LT(std::abs(fine[i]), 0.005);
    EXPECT_NEAR(std::log2(coarse[i] / fine[i]), 2.0, 0.05);
  }
}

TEST(Tube, TwinsPairCoincidingNodesAndTheirTrianglesMatch) {
  const auto mesh = tube(sizes(2));
  std::set<std::int64_t> wall_nodes, lumen_nodes;
  std::map<std::int64_t, std::int64_t> host;
  for (auto [wall, lumen] : mesh.twins) {
    EXPECT_EQ(norm(mesh.points[wall] - mesh.points[lumen]), 0.0);
    host[wall] = lumen;
  }
  std::set<std::set<std::int64_t>> on_lumen, on_wall;
  for (const auto& t : testing::face(mesh, "lumen_wall").triangles) on_lumen.insert({t[0], t[1], t[2]});
  for (const auto& t : testing::face(mesh, "wall_inner").triangles)
    on_wall.insert({host.at(t[0]), host.at(t[1]), host.at(t[2])});
  EXPECT_EQ(on_lumen, on_wall);
  EXPECT_EQ(mesh.twins.size(), 24u * 7);
}

TEST(ThickCylinder, FullAndQuarterAreSoundAndConverge) {
  const CylinderSizes coarse{.inner = 0.01, .outer = 0.02, .length = 0.01, .cells_radial = 3, .cells_around = 16};
  auto fine = coarse;
  fine.cells_around = 32;
  const double exact = pi * 3e-4 * 0.01;
  for (auto [sector, share] : {std::pair{Sector::full, 1.0}, std::pair{Sector::quarter, 0.25}}) {
    const auto a = thick_cylinder(coarse, sector), b = thick_cylinder(fine, sector);
    expect_sound(a);
    expect_sound(b);
    const double ea = volume(a, a.regions[0]) - share * exact, eb = volume(b, b.regions[0]) - share * exact;
    EXPECT_NEAR(std::log2(ea / eb), 2.0, 0.05);
  }
  const auto quarter = thick_cylinder(coarse, Sector::quarter);
  EXPECT_NEAR(area(quarter, "symmetry_x"), 1e-4, 1e-15);
  EXPECT_NEAR(area(quarter, "symmetry_y"), 1e-4, 1e-15);
  for (const auto& t : testing::face(quarter, "symmetry_x").triangles)
    for (auto n : t) EXPECT_EQ(quarter.points[n][0], 0.0);
  for (const auto& t : testing::face(quarter, "symmetry_y").triangles)
    for (auto n : t) EXPECT_EQ(quarter.points[n][1], 0.0);
}

}  // namespace tunica::mesh
