// Lumen surfaces from small images of bodies that are known exactly.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "small_images.hpp"
#include "text.hpp"
#include "tunica/base/error.hpp"
#include "tunica/imaging/label_surface.hpp"
#include "tunica/imaging/smooth_field.hpp"

namespace tunica::imaging {
namespace {

using namespace testing;

/// Log of `surface_of`, or the message of its error.
std::string outcome(const LabelImage& image, const SurfaceSettings& settings) {
  std::string text;
  try {
    surface_of(image, settings, [&](const std::string& line) { text += line + "\n"; });
  } catch (const InputError& error) {
    return error.what();
  }
  return text;
}

/// A tube about the z-axis of 20 mm between planes at z = -10 and 10 mm, the upper one inclined.
int tube(const Point& p, double radius) {
  return std::hypot(p[0], p[1]) < radius && p[2] > -10 * mm && p[2] + 0.3 * p[0] < 10 * mm;
}

TEST(SmoothField, MovesACurvedSurfaceByHalfAsMuchAsAGaussian) {
  const double radius = 6 * mm, sigma = 1;
  const auto image = image_of([&](const Point& p) { return norm(p) < radius; }, {32, 32, 32}, straight);
  const auto surface = boundary(smooth_field(lumen_mask(image, {}, 5, silent), sigma));
  const double voxels = static_cast<double>(std::count(image.labels.begin(), image.labels.end(), 1));
  const double before = std::cbrt(voxels * image.frame.voxel_volume() * 3 / (4 * std::numbers::pi));
  double after = 0;
  for (const auto& p : surface.points) after += norm(p) / static_cast<double>(surface.points.size());
  // A Gaussian alone moves it by sigma^2 / radius; (9.2) leaves 0.453 of that.
  const double one = std::pow(sigma * 0.7 * mm, 2) / radius;
  EXPECT_NEAR((before - after) / one, 0.453, 0.15);
}

TEST(SmoothField, HasOutwardNormalsOnLeftHandedAxes) {
  const auto image = image_of([](const Point& p) { return norm(p) < 5 * mm; }, {26, 26, 26}, oblique());
  EXPECT_GT(geometry::enclosed_volume(boundary(smooth_field(lumen_mask(image, {}, 5, silent), 0.85))), 0);
}

TEST(LumenMask, KeepsTheLargestPieceAndFillsHoles) {
  const auto image = image_of(
      [](const Point& p) {
        if (norm(p - Point{{0, 0, 9 * mm}}) < 1 * mm) return 1;
        return norm(p) < 5 * mm && norm(p) > 1.2 * mm ? 1 : 0;
      },
      {30, 30, 30}, straight);
  std::string log;
  const auto mask = lumen_mask(image, {}, 2, [&](const std::string& line) { log += line + "\n"; });
  EXPECT_NE(log.find("1 separate pieces"), std::string::npos) << log;
  EXPECT_NE(log.find("1 holes"), std::string::npos) << log;
  EXPECT_EQ(mask.frame.size, (Size3{18, 18, 25}));  // the box is that of all lumen, and two voxels around
  for (std::int64_t i = 0; i < mask.frame.count(); ++i)
    EXPECT_EQ(mask.is_lumen(i), norm(mask.frame.place(mask.frame.voxel(i))) < 5 * mm);
}

TEST(LumenMask, FindsWhereLumensTouch) {
  // Two slabs side by side, 1.4 mm apart but for a bridge.
  const auto label = [](const Point& p) {
    if (std::abs(p[1]) > 8 * mm || std::abs(p[2]) > 8 * mm || std::abs(p[0]) > 5 * mm) return 0;
    if (std::abs(p[0]) < 0.7 * mm && std::hypot(p[1], p[2]) > 3 * mm) return 0;
    return p[0] < 0 ? 1 : 2;
  };
  const auto contacts = find_contacts(lumen_mask(image_of(label, {40, 40, 40}, oblique()), {1, 2}, 2, silent), 1e-6);
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_NEAR(contacts[0].area * 1e6, std::numbers::pi * 9, 1.5);
  EXPECT_LT(norm(contacts[0].centre), 0.7 * mm);
}

TEST(LabelSurface, IsAnOpenTubeWithItsPlanes) {
  const double radius = 4 * mm, exact = std::numbers::pi * radius * radius * 20 * mm;
  const auto image = image_of([&](const Point& p) { return tube(p, radius); }, {30, 30, 40}, oblique());
  const auto result = surface_of(image, {}, silent);
  ASSERT_EQ(result.ends.size(), 2U);
  for (const auto& end : result.ends) {
    const bool upper = end.centre[2] > 0;
    const Vec3<double> normal = upper ? (1 / std::hypot(1, 0.3)) * Vec3<double>{{0.3, 0, 1}} : Vec3<double>{{0, 0, -1}};
    EXPECT_LT(norm(end.centre - Point{{0, 0, upper ? 10 * mm : -10 * mm}}), 0.35 * mm);
    EXPECT_GT(dot(end.normal, normal), std::cos(6 * M_PI / 180));
  }
  const auto loops = geometry::boundary_loops(result.lumen);
  ASSERT_EQ(loops.size(), 2U);
  auto closed = result.lumen;
  for (const auto& loop : loops) {
    // Rims lie in the planes.
    for (const auto p : loop)
      EXPECT_LT(std::min(std::abs(dot(result.lumen.points[p] - result.ends[0].centre, result.ends[0].normal)),
                         std::abs(dot(result.lumen.points[p] - result.ends[1].centre, result.ends[1].normal))),
                1e-9);
    Point centre{{0, 0, 0}};
    for (const auto p : loop) centre = centre + (1.0 / static_cast<double>(loop.size())) * result.lumen.points[p];
    closed.points.push_back(centre);
    for (std::size_t i = 0; i < loop.size(); ++i)
      closed.triangles.push_back({loop[(i + 1) % loop.size()], loop[i], std::ssize(closed.points) - 1});
  }
  EXPECT_NEAR(geometry::enclosed_volume(closed) / exact, 1, 0.02);
}

TEST(LabelSurface, EndsAtTheBorderOfTheImageAndWhereItIsCut) {
  // The tube runs out of the image at both sides; the upper opening cuts it at an angle.
  const auto image = image_of([](const Point& p) { return std::hypot(p[0], p[1]) < 4 * mm; }, {30, 30, 40}, straight);
  SurfaceSettings settings;
  settings.openings = {{"inlet", {{{0, 0, -14 * mm}}, {}}},
                       {"outlet", {{{0.4 * mm, 0, 5 * mm}}, Vec3<double>{{0, 1, 2}}}}};
  const auto result = surface_of(image, settings, silent);
  ASSERT_EQ(result.ends.size(), 2U);
  EXPECT_NEAR(result.ends[0].centre[2] / mm, -14, 0.15);  // half a voxel beyond the last one
  EXPECT_NEAR(norm(result.ends[1].centre - Point{{0, 0, 5 * mm}}) / mm, 0, 0.25);
  double highest = -1;
  for (const auto& p : result.lumen.points)
    highest = std::max(highest, dot(p - Point{{0, 0, 5 * mm}}, result.ends[1].normal));
  EXPECT_LT(highest, 1e-6);
}

TEST(LabelSurface, SaysWhatIsWrong) {
  const auto open = image_of([](const Point& p) { return 3 * tube(p, 4 * mm); }, {30, 30, 40}, straight);
  EXPECT_NE(outcome(open, {}).find("no voxel has the label 1; the image has 0, 3"), std::string::npos);
  EXPECT_NE(outcome(open, {.labels = {3, 3}}).find("label of the true lumen"), std::string::npos);

  const auto apart =
      image_of([](const Point& p) { return tube(p, 6 * mm) && std::abs(p[0]) > 0.8 * mm ? (p[0] < 0 ? 1 : 2) : 0; },
               {30, 30, 40}, straight);
  EXPECT_NE(outcome(apart, {.labels = {1, 2}}).find("no tear is open"), std::string::npos);

  const auto ball = image_of([](const Point& p) { return norm(p) < 6 * mm; }, {30, 30, 30}, straight);
  EXPECT_NE(outcome(ball, {}).find("no vessel end is found"), std::string::npos);

  const auto vessel = image_of([](const Point& p) { return tube(p, 4 * mm); }, {30, 30, 40}, straight);
  SurfaceSettings elsewhere;
  elsewhere.openings = {{"inlet", {{{0, 0, 0}}, {}}}};
  EXPECT_NE(outcome(vessel, elsewhere).find("ends are at"), std::string::npos);
  elsewhere.openings = {{"inlet", {{{0, 9 * mm, 0}}, Vec3<double>{{0, 0, 1}}}}};
  EXPECT_NE(outcome(vessel, elsewhere).find("no cross-section"), std::string::npos);
  elsewhere.openings = {{"inlet", {{{0, 0, -10 * mm}}, {}}}};
  EXPECT_NE(outcome(vessel, elsewhere).find("stays closed: no opening names it"), std::string::npos);
  elsewhere.openings = {{"a", {{{0, 0, -10 * mm}}, {}}}, {"b", {{{0, 0, -11 * mm}}, {}}}};
  EXPECT_NE(outcome(vessel, elsewhere).find("is at the same end as a"), std::string::npos);

  // The inlet, the lower end, holds the label of the false lumen.
  const auto swapped =
      image_of([](const Point& p) { return tube(p, 4 * mm) * (p[2] < 0 ? 2 : 1); }, {30, 30, 40}, straight);
  elsewhere.openings = {{"inlet", {{{0, 0, -10 * mm}}, {}}}, {"outlet", {{{0, 0, 10 * mm}}, {}}}};
  elsewhere.labels = {1, 2};
  EXPECT_NE(outcome(swapped, elsewhere).find("there is no true lumen"), std::string::npos);
}

TEST(LabelSurface, RefusesVesselsThatRunOutOfTheImageSideways) {
  const auto image = image_of(
      [](const Point& p) {
        return tube(p - Point{{10 * mm, 0, 0}}, 4 * mm);
      },
      {30, 30, 40}, straight);
  EXPECT_NE(outcome(image, {}).find("runs out of the image"), std::string::npos) << outcome(image, {});
}

TEST(LabelSurface, NamesOfOpeningsAreCheckedAsTheyAreRead) {
  config::Schema<SurfaceSettings> schema("surface", "Labels and vessel ends.");
  SurfaceSettings::add_to(schema);
  const auto why = test::message_of<InputError>([&] {
    config::parse_text(schema,
                       "openings:\n  inlet: {centre: [0 m, 0 m, 0 m]}\n  \"out*\": {centre: [0 m, 0 m, 1 m]}\n"
                       "  Wall: {centre: [0 m, 0 m, 1 m]}\n");
  });
  for (const char* part : {"openings.out* (case.yaml:3): the name 'out*' of an opening has the character '*'",
                           "an opening cannot be called 'Wall'"})
    EXPECT_NE(why.find(part), std::string::npos) << why;
}

}  // namespace
}  // namespace tunica::imaging
