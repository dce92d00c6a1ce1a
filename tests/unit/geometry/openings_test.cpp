#include "tunica/geometry/openings.hpp"

#include <fstream>

#include "small_surfaces.hpp"

namespace tunica::geometry {
namespace {

using namespace test;

const TriangleSurface lumen_tube = tube(5e-3, 20e-3, 24, 16), wall_tube = tube(6e-3, 20e-3, 30, 16);

/// Moves the points of the upper rim by `height` of their place.
template <class Height>
TriangleSurface with_rim(TriangleSurface surface, const Height& height) {
  for (auto& p : surface.points)
    if (p[2] > 20e-3 - 1e-9) p[2] += height(p);
  return surface;
}

TEST(Openings, FoundInPairsWithPlanes) {
  const auto openings =
      find_openings(lumen_tube, &wall_tube, {{"top", {{0, 1e-3, 20e-3}}}, {"bottom", {{0, 0, -1e-3}}}});
  ASSERT_EQ(openings.size(), 2u);
  EXPECT_EQ(openings[0].name, "top");
  EXPECT_NEAR(openings[0].normal[2], 1, 1e-12);
  EXPECT_NEAR(openings[1].normal[2], -1, 1e-12);
  EXPECT_EQ(openings[0].lumen.size(), 24u);
  EXPECT_EQ(openings[0].wall.size(), 30u);
  EXPECT_NEAR(openings[0].area, 12 * 25e-6 * std::sin(2 * M_PI / 24), 1e-12);
}

TEST(Openings, NamedByAreaWithoutNames) {
  auto cone = lumen_tube;
  for (auto& p : cone.points)
    for (int d = 0; d < 2; ++d) p[d] *= 1 + 10 * p[2];
  const auto openings = find_openings(cone, nullptr, {});
  EXPECT_EQ(openings[0].name, "inlet");
  EXPECT_GT(openings[0].centre[2], 0.01);
  EXPECT_EQ(openings[1].name, "outlet_1");
}

TEST(Openings, RefusesWhatDoesNotMatch) {
  const auto why = [](const TriangleSurface& inner, const TriangleSurface& outer,
                      const std::vector<NamedPlace>& names = {}) {
    return message_of<InputError>([&] { find_openings(inner, &outer, names); });
  };
  auto far = wall_tube;
  for (auto& p : far.points) p[2] += p[2] > 0.01 ? 10e-3 : 0;
  EXPECT_TRUE(says(why(lumen_tube, far), "has no lumen rim inside it"));
  EXPECT_TRUE(says(why(lumen_tube, far), "has no rim of the outer surface around it"));
  auto twice = wall_tube;
  append(twice, tube(6.5e-3, 20e-3, 30, 16));
  EXPECT_TRUE(says(why(lumen_tube, twice), "has no lumen rim inside it"));
  auto shifted = wall_tube;
  for (auto& p : shifted.points) p[0] += 1.5e-3;
  EXPECT_TRUE(says(why(lumen_tube, shifted), "reaches beyond the rim"));
  const auto ragged =
      with_rim(lumen_tube, [](const Point& p) { return 1.6e-3 * std::cos(2 * std::atan2(p[1], p[0])); });
  EXPECT_TRUE(says(why(ragged, wall_tube), "leave their common plane by 1.6"));
  EXPECT_TRUE(says(why(lumen_tube, wall_tube, {{"top", {{0, 0, 20e-3}}}}), "has no name"));
  EXPECT_TRUE(says(why(lumen_tube, wall_tube, {{"side", {{20e-3, 0, 10e-3}}}}), "there is no opening of its own"));
}

TEST(Openings, RefusesDiametersThatSpeakOfAnotherUnit) {
  for (const double factor : {0.1, 25.4}) {
    auto scaled = lumen_tube;
    for (auto& p : scaled.points) p = factor * p;
    const auto text = message_of<InputError>([&] { find_openings(scaled, nullptr, {}); });
    EXPECT_TRUE(says(text, factor < 1 ? "its largest opening is 0.994 mm wide" : "its largest opening is 253 mm wide"))
        << text;
    EXPECT_TRUE(says(text, "correct length_unit")) << text;
  }
}

TEST(Openings, RefusesAClosedSurface) {
  const auto ball = contour({{2e-3, 2e-3, 2e-3}}, 0.3e-3, [](const Point& x) { return norm(x) - 1e-3; });
  EXPECT_TRUE(says(message_of<InputError>([&] { find_openings(ball, nullptr, {}); }), "has no openings; its size is "));
}

TEST(Openings, RimsAreFlattenedWithoutFolds) {
  auto surface = tube(5e-3, 20e-3, 24, 64);  // rows closer to each other than the rim moves
  for (auto& p : surface.points) p[2] += 0.5e-3 * std::cos(2 * std::atan2(p[1], p[0])) * p[2] / 20e-3;
  const auto openings = find_openings(surface, nullptr, {});
  const auto before = surface;
  flatten_rims(surface, openings, &Opening::lumen);
  for (const auto& opening : openings)
    for (const auto p : opening.lumen) EXPECT_NEAR(dot(surface.points[p] - opening.centre, opening.normal), 0, 1e-15);
  for (const auto& t : surface.triangles) EXPECT_GT(dot(area_vector(surface, t), area_vector(before, t)), 0);
  for (std::size_t p = 0; p < surface.points.size(); ++p) {
    EXPECT_LT(norm(surface.points[p] - before.points[p]), 0.51e-3);
    if (before.points[p][2] < 15e-3) {
      EXPECT_EQ(norm(surface.points[p] - before.points[p]), 0);
    }
  }
}

TEST(OpeningNames, ReadFromTable) {
  const Folder folder;
  const auto read = [&](const std::string& text) {
    std::ofstream(folder.path / "a.csv") << text;
    return read_opening_names(folder.path / "a.csv", 1e-3);
  };
  const auto names = read("# comment\nname,area,centre_x,centre_y,centre_z\na,1,1,2,3\nb,2,4,5,-6\r\n");
  ASSERT_EQ(names.size(), 2u);
  EXPECT_EQ(names[1].name, "b");
  EXPECT_NEAR(names[1].place[2], -6e-3, 1e-15);
  const auto why = [&](const std::string& text) { return message_of<InputError>([&] { read(text); }); };
  EXPECT_TRUE(says(why("name,centre_x,centre_y\na,1,2\n"), "no column is called 'centre_z'"));
  EXPECT_TRUE(says(why("name,centre_x,centre_y,centre_z\na,1,2,x\n"), "a.csv:2: 'x' under 'centre_z' is not a number"));
  EXPECT_TRUE(
      says(why("name,centre_x,centre_y,centre_z\na,1,2,3\na,1,2,3\n"), "a.csv:3: the name 'a' is there already"));
  EXPECT_TRUE(says(why("name,centre_x,centre_y,centre_z\n"), "names no opening"));
  EXPECT_TRUE(says(message_of<InputError>([&] { read_opening_names(folder.path / "none.csv", 1); }), "cannot be read"));
  EXPECT_TRUE(says(message_of<InputError>([&] { read_opening_names(folder.path, 1); }), "is a folder"));
  EXPECT_TRUE(says(why(std::string(20000, 'x')), "no column is called 'name'"));
  EXPECT_TRUE(says(why(std::string("name\0", 5)), "line 1, column 5: holds the control character 0x00"));
}

TEST(OpeningNames, WhatExcelMakesOfTheTableReadsAlike) {
  const Folder folder;
  for (const char* text : {"\xEF\xBB\xBFname,centre_x,centre_y,centre_z\r\nL iliac,+1,2,-3\r\n\r\n",
                           "\"name\";\"centre_x\";\"centre_y\";\"centre_z\"\n\"L iliac\"; 1; 2; -3\n;;;\n",
                           "Name, Centre_X, Centre_Y, Centre_Z\rL iliac,1,2,-3\r"}) {
    std::ofstream(folder.path / "a.csv", std::ios::binary) << text;
    const auto names = read_opening_names(folder.path / "a.csv", 1e-3);
    ASSERT_EQ(names.size(), 1u) << text;
    EXPECT_EQ(names[0].name, "L iliac");
    EXPECT_NEAR(names[0].place[2], -3e-3, 1e-15);
  }
}

TEST(OpeningNames, CheckedAllAtOnceWhereTheyAreRead) {
  const Folder folder;
  std::ofstream(folder.path / "a.csv") << "name,centre_x,centre_y,centre_z\nL/R iliac,0,0,0\nwall,0,0,9\nout*,0,0,9\n"
                                          "in,0,0,9\nIN,0,0,9\n";
  const auto why = message_of<InputError>([&] { read_opening_names(folder.path / "a.csv", 1); });
  for (const char* part : {"a.csv:2: the name 'L/R iliac'", "a.csv:3: an opening cannot be called 'wall'",
                           "a.csv:4: the name 'out*'", "a.csv:6: the name 'IN' differs from 'in'"})
    EXPECT_TRUE(says(why, part)) << why;
}

}  // namespace
}  // namespace tunica::geometry
