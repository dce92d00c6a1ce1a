// A tube whose lumen is closed by a plug, and opened again.
#include "tunica/mesh/reassign.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "text.hpp"
#include "tunica/base/error.hpp"
#include "tunica/mesh/boundary.hpp"
#include "tunica/mesh/generate.hpp"
#include "tunica/mesh/submesh.hpp"

namespace tunica::mesh {
namespace {

using test::message_of;

MeshData some_tube(double wall) {
  auto data = tube({.radius = 5e-3,
                    .length = 20e-3,
                    .wall_thickness = wall,
                    .cells_around = 8,
                    .cells_radial = 1,
                    .cells_along = 8});
  data.fields.push_back({"number", 1, {}});
  for (std::size_t e = 0; e < data.tetrahedra.size(); ++e) data.fields[0].values.push_back(static_cast<double>(e));
  data.node_fields.push_back({"z", {}});
  for (const auto& x : data.points) data.node_fields[0].values.push_back(x[2]);
  return data;
}

/// Regions as they are, and those of the lumen between two z become `region`.
Reassignment plugged(const MeshData& data, double low, double high, const std::string& region) {
  Reassignment to{.regions = {}, .of_element = {}, .lumen_face = "lumen_wall", .wall_face = "wall_inner"};
  for (const auto& r : data.regions) {
    to.of_element.insert(to.of_element.end(), static_cast<std::size_t>(r.end_element - r.first_element),
                         static_cast<std::int32_t>(to.regions.size()));
    to.regions.emplace_back(r.name, r.kind);
  }
  if (!region.empty()) to.regions.emplace_back(region, RegionKind::wall);
  for (std::size_t e = 0; e < data.tetrahedra.size(); ++e) {
    const double z = centroid(data.points, data.tetrahedra[e])[2];
    if (to.regions[static_cast<std::size_t>(to.of_element[e])].second == RegionKind::lumen && z > low && z < high)
      to.of_element[e] = region.empty() ? -1 : static_cast<std::int32_t>(to.regions.size()) - 1;
  }
  return to;
}

double total_volume(const MeshData& data) {
  double sum = 0;
  for (const auto& t : data.tetrahedra) sum += volume(data.points, t);
  return sum;
}

/// Faces cover lumen and wall once each and look outwards, twins lie over each other on both sides of the interface.
void expect_whole(const MeshData& data) {
  for (const auto kind : {RegionKind::lumen, RegionKind::wall}) {
    auto part = submesh(data, kind).data;
    if (part.tetrahedra.empty()) continue;
    const auto before = part.faces;
    EXPECT_NO_THROW(orient_and_check_faces(part, Boundary(part.tetrahedra, std::ssize(part.points), "part"), "part"));
    for (std::size_t f = 0; f < before.size(); ++f)
      for (std::size_t t = 0; t < before[f].triangles.size(); ++t)
        EXPECT_GT(
            dot(area_vector(part.points, before[f].triangles[t]), area_vector(part.points, part.faces[f].triangles[t])),
            0);
  }
  std::set<std::int64_t> nodes;
  for (const auto& [wall, lumen] : data.twins) {
    EXPECT_EQ(norm(data.points[static_cast<std::size_t>(wall)] - data.points[static_cast<std::size_t>(lumen)]), 0);
    nodes.insert(wall);
    nodes.insert(lumen);
  }
  EXPECT_EQ(nodes.size(), 2 * data.twins.size());
  std::vector<std::uint8_t> used(data.points.size(), 0);
  for (const auto& t : data.tetrahedra)
    for (const auto n : t) used[static_cast<std::size_t>(n)] = 1;
  EXPECT_EQ(std::count(used.begin(), used.end(), 0), 0);
}

std::size_t triangles_of(const MeshData& data, const std::string& name) {
  const auto found = std::find_if(data.faces.begin(), data.faces.end(), [&](const auto& f) { return f.name == name; });
  return found == data.faces.end() ? 0 : found->triangles.size();
}

TEST(Reassign, APlugClosesTheLumenAndTakenOutOpensIt) {
  const auto before = some_tube(1e-3);
  const auto closed = reassign(before, plugged(before, 7.5e-3, 12.5e-3, "plug"));
  expect_whole(closed);
  ASSERT_EQ(closed.regions.size(), 3U);
  EXPECT_NEAR(total_volume(closed), total_volume(before), 1e-12 * total_volume(before));
  EXPECT_GT(closed.twins.size(), before.twins.size());  // those within the two ends of the plug are new
  EXPECT_EQ(triangles_of(closed, "lumen_inlet"), triangles_of(before, "lumen_inlet"));
  EXPECT_EQ(triangles_of(closed, "wall_outer"), triangles_of(before, "wall_outer"));
  EXPECT_EQ(triangles_of(closed, "lumen_wall"), triangles_of(closed, "wall_inner"));
  const auto parts = lumen_parts(closed);
  EXPECT_EQ(*std::max_element(parts.begin(), parts.end()), 1);
  for (std::size_t e = 0; e < closed.tetrahedra.size(); ++e) {  // values stay with their elements
    const auto old = static_cast<std::size_t>(closed.fields[0].values[e]);
    EXPECT_NEAR(norm(centroid(closed.points, closed.tetrahedra[e]) - centroid(before.points, before.tetrahedra[old])),
                0, 1e-15);
  }
  for (std::size_t n = 0; n < closed.points.size(); ++n)
    EXPECT_EQ(closed.node_fields[0].values[n], closed.points[n][2]);

  Reassignment back = plugged(closed, 1, 1, "");
  const auto plug =
      std::find_if(back.regions.begin(), back.regions.end(), [](const auto& r) { return r.first == "plug"; });
  for (auto& r : back.of_element)
    if (r == plug - back.regions.begin()) r = 0;
  const auto opened = reassign(closed, back);
  expect_whole(opened);
  EXPECT_EQ(opened.points.size(), before.points.size());
  EXPECT_EQ(opened.twins.size(), before.twins.size());
  EXPECT_EQ(triangles_of(opened, "lumen_wall"), triangles_of(before, "lumen_wall"));
  const auto one = lumen_parts(opened);
  EXPECT_EQ(*std::max_element(one.begin(), one.end()), 0);
}

TEST(Reassign, WithoutAWallElementsAreTakenAway) {
  const auto before = some_tube(0);
  const auto closed = reassign(before, plugged(before, 7.5e-3, 12.5e-3, ""));
  expect_whole(closed);
  EXPECT_LT(total_volume(closed), total_volume(before));
  EXPECT_TRUE(closed.twins.empty());
  const auto parts = lumen_parts(closed);
  EXPECT_EQ(*std::max_element(parts.begin(), parts.end()), 1);
}

TEST(Reassign, RefusesToReachAnOpening) {
  const auto before = some_tube(1e-3);
  const auto message = message_of<InputError>([&] { reassign(before, plugged(before, 0, 5e-3, "plug")); });
  EXPECT_NE(message.find("lumen_inlet"), std::string::npos) << message;
  EXPECT_NE(message.find("farther away"), std::string::npos);
}

}  // namespace
}  // namespace tunica::mesh
