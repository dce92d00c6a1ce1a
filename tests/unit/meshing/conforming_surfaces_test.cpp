#include "tunica/meshing/conforming_surfaces.hpp"

#include "tunica/geometry/self_intersections.hpp"
#include "unit/geometry/small_surfaces.hpp"

namespace tunica::meshing {
namespace {

using namespace geometry::test;
using geometry::crossing_triangles;

TEST(RemeshTogether, RefinesUntilSurfacesAreNearAndDoNotCross) {
  // A gap of 0.2 mm, edges of 3 mm: the coarse meshes would cross.
  std::vector<Sheet> sheets;
  for (const auto& surface : {tube(5e-3, 10e-3, 90, 30), tube(5.2e-3, 10e-3, 90, 30)})
    sheets.push_back({{geometry::TriangleTree(surface), {}, std::vector<double>(surface.points.size(), 4e-3)}, {}, {}});
  std::vector<std::string> lines;
  remesh_together(sheets, {}, 0.3, [&](const std::string& line) { lines.push_back(line); });
  EXPECT_GT(lines.size(), 1u);
  geometry::TriangleSurface all = sheets[0].mesh.surface;
  geometry::append(all, sheets[1].mesh.surface);
  EXPECT_TRUE(crossing_triangles(all).empty());
  for (const auto& sheet : sheets) EXPECT_LE(sheet.distance, 0.5e-3);
}

TEST(RemeshTogether, SaysWhereItFails) {
  std::vector<Sheet> sheets;
  const auto surface = tube(5e-3, 10e-3, 90, 30);
  for (int i = 0; i < 2; ++i)  // twice the same place
    sheets.push_back({{geometry::TriangleTree(surface), {}, std::vector<double>(surface.points.size(), 2e-3)}, {}, {}});
  Accuracy accuracy;
  accuracy.rounds = 1;
  const auto text = message_of<SolverError>([&] { remesh_together(sheets, accuracy, 0.3, [](const std::string&) {}); });
  EXPECT_TRUE(says(text, "pairs of triangles cross, near (")) << text;
}

TEST(RemeshTogether, AFewPlacesMayStayTooFarWithAWarning) {
  const auto surface = tube(5e-3, 10e-3, 90, 30);
  Accuracy accuracy;
  accuracy.rounds = 1;
  accuracy.absolute = 1e-7;  // no mesh is so near
  std::string last;
  const auto make = [&] {
    std::vector<Sheet> sheets;
    sheets.push_back({{geometry::TriangleTree(surface), {}, std::vector<double>(surface.points.size(), 2e-3)}, {}, {}});
    remesh_together(sheets, accuracy, 0.3, [&](const std::string& line) { last = line; });
  };
  EXPECT_TRUE(says(message_of<SolverError>(make), "places are too far from the original surface"));
  accuracy.few = 1000000;
  make();
  EXPECT_TRUE(says(last, "warning: ")) << last;
  accuracy.farthest = 1e-6;
  EXPECT_TRUE(says(message_of<SolverError>(make), "places are too far from the original surface"));
}

TEST(RemeshTogether, PlacesThatLieTogetherAreOne) {
  // A spike of 1 mm on a tube: many edges, triangles and points there are beyond 0.1 mm.
  auto surface = tube(5e-3, 10e-3, 90, 60);
  for (auto& p : surface.points) {
    const double away = norm(p - geometry::Point{{5e-3, 0, 5e-3}});
    const double height = std::max(0.0, 1e-3 * (1 - away / 1.2e-3));
    const double radius = std::hypot(p[0], p[1]);
    p[0] *= 1 + height / radius;
    p[1] *= 1 + height / radius;
  }
  Accuracy accuracy;
  accuracy.rounds = 1;
  accuracy.few = 5;
  accuracy.absolute = 0.1e-3;
  accuracy.per_edge = 10;
  std::string last;
  std::vector<Sheet> sheets;
  sheets.push_back({{geometry::TriangleTree(surface), {}, std::vector<double>(surface.points.size(), 1.5e-3)}, {}, {}});
  remesh_together(sheets, accuracy, 0.3, [&](const std::string& line) { last = line; });
  EXPECT_TRUE(says(last, "warning: 1 places stay up to 0.")) << last;
}

}  // namespace
}  // namespace tunica::meshing
