#include "tunica/mesh/interface.hpp"

#include <algorithm>

#include "temporary_folder.hpp"
#include "text.hpp"
#include "tunica/base/error.hpp"
#include "tunica/mesh/generate.hpp"
#include "unit/mesh/check_mesh.hpp"

namespace tunica::mesh {

namespace {

using test::message_of;
using tunica::test::contains;

/// Two boxes that touch at x = 1: the lumen fills [0, 1] and the wall [1, 1.5].
struct Boxes {
  LoadedMesh lumen, wall;
};
Boxes boxes(int wall_cells_y = 2) {
  Boxes b{{box(2, 2, 2, {{1, 1, 1}}, RegionKind::lumen), {}},
          {box(1, wall_cells_y, 2, {{0.5, 1, 1}}, RegionKind::wall), {}}};
  for (auto& p : b.wall.data.points) p[0] += 1;
  for (auto& f : b.lumen.data.faces) f.name = "lumen_" + f.name;
  for (auto& f : b.wall.data.faces) f.name = "wall_" + f.name;
  return b;
}

LoadedMesh join_boxes(const Boxes& b, double tolerance = 1e-3, const std::string& wall_face = "wall_x_min") {
  const LoadedMesh parts[] = {b.lumen, b.wall};
  const Interface interfaces[] = {{{"lumen_x_max"}, {wall_face}}};
  return join(parts, interfaces, {.tolerance = tolerance});
}

std::string refusal(const Boxes& b, double tolerance = 1e-3, const std::string& wall_face = "wall_x_min") {
  return message_of<InputError>([&] { join_boxes(b, tolerance, wall_face); });
}

}  // namespace

TEST(Join, PairsCoincidingNodesAndGivesThemTheSameCoordinates) {
  auto b = boxes();
  for (auto& p : b.wall.data.points) p[1] += 4e-4;  // edges are 0.5 long: within 1e-3 of them
  const auto mesh = join_boxes(b);
  testing::expect_sound(mesh.data);
  EXPECT_EQ(mesh.data.twins.size(), 9u);
  for (auto [wall, lumen] : mesh.data.twins) {
    EXPECT_GE(wall, 27);
    EXPECT_LT(lumen, 27);
    for (int d = 0; d < 3; ++d) EXPECT_EQ(mesh.data.points[wall][d], mesh.data.points[lumen][d]);
  }
  EXPECT_EQ(mesh.data.regions[1].first_element, 48);
  EXPECT_EQ(mesh.data.faces.size(), 12u);
  EXPECT_EQ(testing::face(mesh.data, "wall_x_max").region, 1);
  EXPECT_TRUE(contains(mesh.report.back(), "9 node pairs, 8 triangles, largest distance 0.0004 m"));
}

TEST(Join, RefusesNodesWithoutPartner) {
  auto b = boxes();
  for (auto& p : b.wall.data.points) p[1] += 6e-4;
  EXPECT_TRUE(contains(refusal(b), "9 of 9 wall nodes have no lumen node")) << refusal(b);
  EXPECT_TRUE(refusal(b, 2e-3).empty());
  const auto finer = refusal(boxes(4));
  EXPECT_TRUE(contains(finer, "6 of 15 wall nodes have no lumen node: (1, 0.25, 0) m")) << finer;
  const auto coarser = refusal(boxes(1));
  EXPECT_TRUE(contains(coarser, "3 of 9 lumen nodes have no wall node: (1, 0.5, 0) m")) << coarser;
}

TEST(Join, RefusesDifferentTriangles) {
  auto b = boxes();
  // Mirroring y keeps the nodes of the interface but turns the diagonals of its squares.
  for (auto& p : b.wall.data.points) p[1] = 1 - p[1];
  for (auto& t : b.wall.data.tetrahedra) std::swap(t[0], t[1]);
  for (auto& f : b.wall.data.faces)
    for (auto& t : f.triangles) std::swap(t[0], t[1]);
  testing::expect_sound(b.wall.data);
  EXPECT_TRUE(contains(refusal(b), "8 of 8 lumen triangles are not wall triangles")) << refusal(b);
}

TEST(Join, RefusesWrongNames) {
  EXPECT_TRUE(contains(refusal(boxes(), 1e-3, "lumen_x_max"), "there is no wall face called lumen_x_max"));
  auto b = boxes();
  b.wall.data.faces[0].name = "lumen_x_max";
  EXPECT_TRUE(contains(refusal(b), "face lumen_x_max: the name appears twice"));
  b.wall.data.faces[0].name = "Lumen_x_Max";
  EXPECT_TRUE(contains(refusal(b), "face Lumen_x_Max: the name differs from lumen_x_max in the case of letters only"));
  b = boxes();
  b.wall.data.regions[0].name = "Lumen";
  EXPECT_TRUE(contains(refusal(b), "region Lumen: the name differs from lumen in the case of letters only"));
  b = boxes();
  b.wall.data.regions[0].kind = RegionKind::lumen;
  EXPECT_TRUE(contains(refusal(b), "2 lumen regions, at most 1 is possible"));
  EXPECT_TRUE(contains(refusal(boxes(), 0.7), "outside (0, 0.5)"));
}

}  // namespace tunica::mesh
