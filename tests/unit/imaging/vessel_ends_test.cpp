// Ends of vessels whose axes and planes are known.
#include "tunica/imaging/vessel_ends.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "small_images.hpp"

namespace tunica::imaging {
namespace {

using namespace testing;

struct Segmented {
  LumenMask mask;
  SmoothField field;
  Segmented(const LabelImage& image, double sigma = 0.85)
      : mask(lumen_mask(image, {}, 12, silent)), field(smooth_field(mask, sigma)) {}
};

bool in_tube(const Point& p, const Point& from, const Vec3<double>& axis, double length, double radius) {
  const double along = dot(p - from, axis);
  return along > 0 && along < length && norm(p - from - along * axis) < radius;
}

/// A trunk along z from -18 to 20 mm, radius 3.5 mm, and a long branch of 3 mm that leaves it at 50 degrees from its
/// axis.
const Vec3<double> branch_axis{{std::sin(50 * M_PI / 180), 0, std::cos(50 * M_PI / 180)}};
int branched(const Point& p) {
  return in_tube(p, {{0, 0, -18 * mm}}, {{0, 0, 1}}, 38 * mm, 3.5 * mm) ||
         in_tube(p, {{0, 0, -6 * mm}}, branch_axis, 28 * mm, 3 * mm);
}

TEST(VesselEnds, OfATrunkWithABranch) {
  const Segmented vessel(image_of(branched, {74, 20, 64}, straight));
  const auto ends = find_ends(vessel.mask, vessel.field).flat;
  ASSERT_EQ(ends.size(), 3U);
  const VesselEnd expected[] = {{{{0, 0, -18 * mm}}, {{0, 0, -1}}, 3.5 * mm},
                                {{{0, 0, 20 * mm}}, {{0, 0, 1}}, 3.5 * mm},
                                {Point{{0, 0, -6 * mm}} + 28 * mm * branch_axis, branch_axis, 3 * mm}};
  for (const auto& wanted : expected) {
    const auto found = std::min_element(ends.begin(), ends.end(), [&](const auto& a, const auto& b) {
      return norm(a.centre - wanted.centre) < norm(b.centre - wanted.centre);
    });
    EXPECT_LT(norm(found->centre - wanted.centre), 0.7 * mm);  // one voxel
    EXPECT_GT(dot(found->normal, wanted.normal), std::cos(8 * M_PI / 180));
    EXPECT_NEAR(norm(found->normal), 1, 1e-12);
    EXPECT_NEAR(found->radius / wanted.radius, 1, 0.2);
  }
}

TEST(VesselEnds, OfAShortStubLieInAPlaneAboutThePlaceGiven) {
  // A branch that reaches 3 mm out of its trunk, cut along no axis of the image.
  const Vec3<double> axis{{0.8, 0.6 * 0.96, 0.6 * 0.28}};
  const Point end = 9 * mm * axis;
  const Segmented vessel(image_of(
      [&](const Point& p) {
        return in_tube(p, {{0, 0, -18 * mm}}, {{0, 0, 1}}, 36 * mm, 5 * mm) || in_tube(p, {}, axis, 9 * mm, 3.5 * mm);
      },
      {44, 44, 60}, straight));
  const auto found = end_near(vessel.field, end + Vec3<double>{{0.8 * mm, -0.5 * mm, 0.4 * mm}});
  ASSERT_TRUE(found.has_value());
  EXPECT_LT(norm(found->centre - end), 0.7 * mm);
  EXPECT_GT(dot(found->normal, axis), std::cos(8 * M_PI / 180));
  EXPECT_NEAR(found->radius / (3.5 * mm), 1, 0.2);
  // On the side of the trunk nothing ends.
  EXPECT_FALSE(end_near(vessel.field, {{-5 * mm, 0, 0}}).has_value());
}

TEST(VesselEnds, RoundAndEndlessVesselsHaveNone) {
  const Segmented ring(
      image_of([](const Point& p) { return std::hypot(std::hypot(p[0], p[1]) - 8 * mm, p[2]) < 2.5 * mm; },
               {34, 34, 12}, straight));
  EXPECT_TRUE(find_ends(ring.mask, ring.field).flat.empty());
  // One end flat, the other a half-sphere.
  const Segmented stump(image_of(
      [](const Point& p) {
        return in_tube(p, {{0, 0, -10 * mm}}, {{0, 0, 1}}, 18 * mm, 3.5 * mm) ||
               norm(p - Point{{0, 0, 8 * mm}}) < 3.5 * mm;
      },
      {20, 20, 40}, straight));
  const auto ends = find_ends(stump.mask, stump.field).flat;
  ASSERT_EQ(ends.size(), 1U);
  EXPECT_NEAR(ends[0].centre[2] / mm, -10, 0.35);
}

TEST(VesselEnds, ACutAcrossATubeIsAnEllipseAboutItsAxis) {
  const Segmented vessel(image_of(
      [](const Point& p) {
        return in_tube(p, {{0, 0, -15 * mm}}, {{0, 0, 1}}, 30 * mm, 4 * mm);
      },
      {30, 30, 50}, oblique()));
  for (const double angle : {0.0, 0.5, 0.9}) {
    const Vec3<double> normal{{0, std::sin(angle), std::cos(angle)}};
    // Asked for beside the axis.
    const auto end = end_at(vessel.field, {{1 * mm, 0, 2 * mm}}, normal);
    ASSERT_TRUE(end);
    EXPECT_LT(norm(end->centre - Point{{0, 0, 2 * mm}}), 0.2 * mm);
    EXPECT_NEAR(end->radius / mm, 4 / std::cos(angle), 0.7);
    EXPECT_EQ(norm(end->normal - normal), 0);
  }
  EXPECT_FALSE(end_at(vessel.field, {{9 * mm, 0, 0}}, {{0, 0, 1}}));   // in the tissue
  EXPECT_TRUE(end_at(vessel.field, {{4.6 * mm, 0, 0}}, {{0, 0, 1}}));  // just outside of the lumen
}

TEST(VesselEnds, AreCarriedOnAndNothingElseIs) {
  // The first tube ends at z = 2 mm; another one goes on beside it.
  const auto label = [](const Point& p) {
    return in_tube(p, {{-5 * mm, 0, -10 * mm}}, {{0, 0, 1}}, 12 * mm, 3 * mm) ||
           in_tube(p, {{6 * mm, 0, -10 * mm}}, {{0, 0, 1}}, 20 * mm, 2.5 * mm) ||
           (std::abs(p[1]) < 1 * mm && std::abs(p[0]) < 6 * mm && p[2] > -10 * mm && p[2] < -8 * mm);
  };
  Segmented vessel(image_of(label, {40, 20, 40}, straight));
  const auto before = vessel.mask.kinds;
  const double reach = 4 * mm;
  continue_beyond({{{-5 * mm, 0, 2 * mm}}, {{0, 0, 1}}, 3 * mm}, reach, vessel.mask);
  double added = 0;
  for (std::int64_t i = 0; i < vessel.mask.frame.count(); ++i) {
    const auto p = vessel.mask.frame.place(vessel.mask.frame.voxel(i));
    const bool beyond = in_tube(p, {{-5 * mm, 0, 2 * mm}}, {{0, 0, 1}}, reach, 3 * mm);
    const bool was = before[static_cast<std::size_t>(i)] != Kind::tissue, is = vessel.mask.is_lumen(i);
    EXPECT_EQ(is, was || beyond) << p[0] / mm << " " << p[1] / mm << " " << p[2] / mm;
    added += is && !was ? vessel.mask.frame.voxel_volume() : 0;
  }
  EXPECT_NEAR(added * 1e9, std::numbers::pi * 9 * 4, 0.12 * std::numbers::pi * 9 * 4);
}

TEST(VesselEnds, GoOnAsTheirMirrorImage) {
  // A tube that ends at z = 2 mm; its lower part is false lumen.
  const auto label = [](const Point& p) {
    return in_tube(p, {{0, 0, -10 * mm}}, {{0, 0, 1}}, 12 * mm, 3 * mm) ? (p[2] < -1 * mm ? 2 : 1) : 0;
  };
  auto mask = lumen_mask(image_of(label, {16, 16, 40}, straight), {1, 2}, 12, silent);
  continue_beyond({{{0, 0, 2 * mm}}, {{0, 0, 1}}, 3 * mm}, 6 * mm, mask);
  // The mirror stands one and a half voxels of 0.7 mm before the end.
  const double mirror = (2 - 1.5 * 0.7) * mm, border = 2 * mirror + 1 * mm;
  int in_true = 0, in_false = 0;
  for (std::int64_t i = 0; i < mask.frame.count(); ++i) {
    const auto p = mask.frame.place(mask.frame.voxel(i));
    if (std::hypot(p[0], p[1]) > 2 * mm || p[2] < 2 * mm || p[2] > 7.5 * mm || std::abs(p[2] - border) < 0.4 * mm)
      continue;
    EXPECT_EQ(mask.kinds[static_cast<std::size_t>(i)], p[2] < border ? Kind::true_lumen : Kind::false_lumen) << p[2];
    (p[2] < border ? in_true : in_false) += 1;
  }
  EXPECT_GT(in_true, 10);
  EXPECT_GT(in_false, 50);
}

}  // namespace
}  // namespace tunica::imaging
