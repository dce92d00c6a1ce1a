#include "tunica/geometry/surface_mending.hpp"

#include "small_surfaces.hpp"

namespace tunica::geometry {
namespace {

using namespace test;

const TriangleSurface sound = tube(5e-3, 20e-3, 24, 16);

bool reports(const MendedSurface& mended, const std::string& part) {
  for (const auto& line : mended.report)
    if (says(line, part)) return true;
  return false;
}

std::string refusal(const TriangleSurface& surface, const MendOptions& options = {}) {
  return message_of<InputError>([&] { mend_surface(surface, options); });
}

TEST(MendSurface, LeavesASoundSurfaceAlone) {
  const auto mended = mend_surface(sound, {});
  EXPECT_EQ(mended.surface.triangles, sound.triangles);
  EXPECT_EQ(mended.openings, 2);
  EXPECT_EQ(mended.genus, 0);
  EXPECT_EQ(mended.slivers, 0);
  EXPECT_EQ(mended.report.size(), 1u);
}

TEST(MendSurface, MergesPointsThatEachTriangleRepeats) {
  TriangleSurface soup;
  for (const auto& t : sound.triangles) {
    const auto n = std::ssize(soup.points);
    for (const auto p : t) soup.points.push_back(sound.points[p]);
    soup.triangles.push_back({n, n + 1, n + 2});
  }
  const auto mended = mend_surface(soup, {});
  EXPECT_EQ(mended.surface.points.size(), sound.points.size());
  EXPECT_TRUE(reports(mended, "points merged"));
}

TEST(MendSurface, DropsDegenerateAndDoubleTriangles) {
  auto surface = sound;
  surface.triangles.push_back({3, 3, 4});
  surface.triangles.push_back(sound.triangles[10]);
  EXPECT_TRUE(reports(mend_surface(surface, {}), "2 degenerate or double triangles"));
}

TEST(MendSurface, TurnsTriangles) {
  auto surface = sound;
  for (std::size_t t = 100; t < 120; ++t) std::swap(surface.triangles[t][0], surface.triangles[t][1]);
  auto mended = mend_surface(surface, {});
  EXPECT_TRUE(reports(mended, "20 triangles turned"));
  for (auto& t : surface.triangles) std::swap(t[0], t[1]);
  mended = mend_surface(surface, {});
  const auto normals = point_normals(mended.surface);
  for (std::size_t p = 0; p < normals.size(); ++p)
    EXPECT_GT(normals[p][0] * sound.points[p][0] + normals[p][1] * sound.points[p][1], 0);
}

TEST(MendSurface, FillsSmallHolesOnly) {
  auto surface = sound;
  surface.triangles.erase(surface.triangles.begin() + 200);
  auto mended = mend_surface(surface, {.smallest_opening = 2e-3});
  EXPECT_EQ(mended.openings, 2);
  EXPECT_TRUE(reports(mended, "1 small holes filled"));
  EXPECT_EQ(mend_surface(surface, {.smallest_opening = 0.5e-3}).openings, 3);
}

TEST(MendSurface, DropsFragments) {
  auto surface = sound;
  append(surface, {{{{0, 0, 0}}, {{1e-4, 0, 0}}, {{0, 1e-4, 0}}}, {{0, 1, 2}}});
  const auto mended = mend_surface(surface, {});
  EXPECT_EQ(mended.surface.triangles.size(), sound.triangles.size());
  EXPECT_TRUE(reports(mended, "1 small fragments"));
}

TEST(MendSurface, RefusesWithPlaceAndFile) {
  auto surface = sound;
  const auto n = std::ssize(surface.points);
  surface.points.push_back({{0.02, 0, 0}});
  surface.triangles.push_back({surface.triangles[200][0], surface.triangles[200][1], n});
  const Folder folder;
  const auto text = refusal(surface, {.name = "lumen", .spots = folder.path / "spots.vtp"});
  EXPECT_TRUE(says(text, "lumen")) << text;
  EXPECT_TRUE(says(text, "1 edges belong to more than two triangles: (")) << text;
  EXPECT_TRUE(says(text, " mm")) << text;
  EXPECT_TRUE(std::filesystem::exists(folder.path / "spots.vtp"));
}

TEST(MendSurface, RefusesPointsThatAreNotFinite) {
  auto surface = sound;
  surface.points[40][1] = NAN;
  EXPECT_TRUE(says(refusal(surface), "not finite; the first is number 41"));
}

TEST(MendSurface, RefusesSurfacesThatTouchThemselvesAtAPoint) {
  auto surface = sound;
  // Two tips in one point, which lies on the rim of the other part.
  append(surface, tube(5e-3, 20e-3, 24, 16));
  for (std::size_t p = sound.points.size(); p < surface.points.size(); ++p) surface.points[p][0] += 30e-3;
  for (auto& t : surface.triangles)
    for (auto& p : t)
      if (p == std::ssize(sound.points)) p = 0;
  EXPECT_TRUE(says(refusal(surface, {.parts = 2}), "1 points where the surface touches itself"));
}

TEST(MendSurface, RefusesAOneSidedSurface) {
  TriangleSurface band;  // a Möbius band
  constexpr int n = 24;
  for (int i = 0; i < n; ++i)
    for (const double side : {-1.0, 1.0}) {
      const double a = 2 * M_PI * i / n, r = 1e-2 + 3e-3 * side * std::cos(a / 2);
      band.points.push_back({{r * std::cos(a), r * std::sin(a), 3e-3 * side * std::sin(a / 2)}});
    }
  for (std::int64_t i = 0; i < n; ++i) {
    std::int64_t a = 2 * i, b = 2 * i + 1, c = (2 * i + 2) % (2 * n), d = (2 * i + 3) % (2 * n);
    if (i == n - 1) std::swap(c, d);
    band.triangles.push_back({a, b, c});
    band.triangles.push_back({b, d, c});
  }
  EXPECT_TRUE(says(refusal(band), "one-sided"));
}

TEST(MendSurface, RefusesTooManyParts) {
  auto surface = sound;
  append(surface, sound);
  for (std::size_t p = sound.points.size(); p < surface.points.size(); ++p) surface.points[p][0] += 30e-3;
  EXPECT_TRUE(says(refusal(surface), "2 separate parts instead of 1"));
  EXPECT_EQ(mend_surface(surface, {.parts = 2}).openings, 4);
}

TEST(MendSurface, RefusesCrossingTriangles) {
  auto surface = sound;
  surface.points[200] = {{-8e-3, 1e-4, 10e-3}};  // pulled through the other side
  const auto text = refusal(surface);
  EXPECT_TRUE(says(text, "pairs of triangles cross")) << text;
}

TEST(CheckNesting, AcceptsAWallAround) { EXPECT_NO_THROW(check_nesting(sound, tube(6e-3, 20e-3, 24, 16), 0.1e-3, {})); }

TEST(CheckNesting, RefusesCrossingNearAndOutside) {
  const auto why = [&](const TriangleSurface& outer, double clearance) {
    return message_of<InputError>([&] { check_nesting(sound, outer, clearance, {}); });
  };
  EXPECT_TRUE(says(why(tube(6e-3, 20e-3, 24, 16), 1.5e-3), "within 1.5 mm of the outer surface"));
  EXPECT_TRUE(says(why(tube(4e-3, 20e-3, 24, 16), 0.1e-3), "lie outside the outer surface"));
  auto shifted = tube(6e-3, 20e-3, 24, 16);
  for (auto& p : shifted.points) p[0] += 2e-3;
  EXPECT_TRUE(says(why(shifted, 0.01e-3), "cross the outer surface"));
}

}  // namespace
}  // namespace tunica::geometry
