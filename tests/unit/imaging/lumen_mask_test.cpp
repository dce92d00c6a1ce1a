// Which voxels are lumen, and where the lumens touch.
#include "tunica/imaging/lumen_mask.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "small_images.hpp"
#include "text.hpp"
#include "tunica/base/error.hpp"

namespace tunica::imaging {
namespace {

using namespace testing;

bool in_box(const Point& p, double x, double y, double z) {
  return std::abs(p[0]) < x * mm && std::abs(p[1]) < y * mm && std::abs(p[2]) < z * mm;
}

TEST(LumenMask, LumenStaysWhereItIsInTheImage) {
  const auto label = [](const Point& p) { return norm(p - Point{{2 * mm, 1 * mm, -3 * mm}}) < 4 * mm ? 7 : 3; };
  const auto image = image_of(label, {32, 30, 28}, oblique());
  const auto mask = lumen_mask(image, {.true_lumen = 7, .false_lumen = {}, .tissue = {3}}, 3, silent);
  std::int64_t inside = 0;
  for (std::int64_t i = 0; i < mask.frame.count(); ++i) {
    EXPECT_EQ(mask.is_lumen(i), label(mask.frame.place(mask.frame.voxel(i))) == 7);
    inside += mask.is_lumen(i);
  }
  EXPECT_EQ(inside, std::count(image.labels.begin(), image.labels.end(), 7));
  EXPECT_NEAR(norm(mask.frame.place(mask.image_low) - image.frame.origin), 0, 1e-15);
  EXPECT_NEAR(norm(mask.frame.place(mask.image_high) - image.frame.place(Size3{31, 29, 27})), 0, 1e-15);
}

TEST(LumenMask, KnowsTheVoxelsAtTheBorderOfTheImage) {
  // A rod along z through the whole image: its ends lie at the border, its sides do not.
  const auto image = image_of([](const Point& p) { return in_box(p, 1.5, 1.5, 100); }, {12, 12, 9}, straight);
  const auto mask = lumen_mask(image, {}, 2, silent);
  EXPECT_EQ(mask.frame.size[2], 9 + 4);
  for (std::int64_t i = 0; i < mask.frame.count(); ++i) {
    const auto k = mask.frame.voxel(i)[2];
    if (mask.is_lumen(i)) {
      EXPECT_EQ(mask.at_image_border(i), k == 2 || k == 10);
    }
  }
}

TEST(LumenMask, VoxelsThatMeetAtEdgesAloneDoNotHangTogether) {
  // Two blocks, the smaller of which touches the other one along an edge.
  const auto label = [](const Point& p) {
    if (p[0] < 0 && p[1] < 0 && in_box(p, 5, 5, 5)) return 1;
    return p[0] > 0 && p[1] > 0 && in_box(p, 3, 3, 3) ? 1 : 0;
  };
  std::string log;
  const auto mask =
      lumen_mask(image_of(label, {20, 20, 20}, straight), {}, 1, [&](const std::string& line) { log += line; });
  EXPECT_NE(log.find("1 separate pieces of lumen dropped"), std::string::npos) << log;
  for (std::int64_t i = 0; i < mask.frame.count(); ++i)
    if (mask.is_lumen(i)) {
      EXPECT_LT(mask.frame.place(mask.frame.voxel(i))[0], 0);
    }
}

TEST(LumenMask, HolesAreFilledWithTheLumenThatHasMostOfTheirSurface) {
  const auto hole = [](const Point& p, double x) { return norm(p - Point{{x * mm, 0, 0}}) < 1.6 * mm; };
  const auto label = [&](const Point& p) {
    if (!in_box(p, 8, 4, 4) || hole(p, 1) || hole(p, -5)) return 0;
    return p[0] > 0 ? 1 : 2;
  };
  const auto mask = lumen_mask(image_of(label, {26, 16, 16}, straight), {1, 2}, 2, silent);
  for (std::int64_t i = 0; i < mask.frame.count(); ++i) {
    const auto p = mask.frame.place(mask.frame.voxel(i));
    if (hole(p, 1)) {  // but for a cap of it
      EXPECT_EQ(mask.kinds[i], Kind::true_lumen);
    }
    if (hole(p, -5)) {  // all around
      EXPECT_EQ(mask.kinds[i], Kind::false_lumen);
    }
  }
}

TEST(LumenMask, ContactsHaveTheAreaOfThePlaneNotOfTheStairs) {
  for (const double slope : {0.0, 0.5, 1.0}) {
    const auto label = [&](const Point& p) {
      if (!in_box(p, 9, 5, 4)) return 0;
      return p[0] > slope * p[1] ? 1 : 2;
    };
    const auto image = image_of(label, {60, 40, 30}, {{{{0.4 * mm, 0, 0}}, {{0, 0.4 * mm, 0}}, {{0, 0, 0.4 * mm}}}});
    const auto contacts = find_contacts(lumen_mask(image, {1, 2}, 2, silent), 1e-6);
    ASSERT_EQ(contacts.size(), 1U);
    // 24 voxels of 0.4 mm lie within 5 mm on both sides, 20 within 4 mm; steps along x end half a voxel too early.
    const double width = 24 * 0.4, height = 20 * 0.4;
    EXPECT_NEAR(contacts[0].area * 1e6, width * height * std::hypot(1, slope), 0.04 * width * height * slope + 1e-9);
    EXPECT_LT(norm(contacts[0].centre), 0.6 * mm);  // of the voxels of the false lumen
  }
}

TEST(LumenMask, ABentContactCountsAsSeenFromStraightAhead) {
  const auto label = [](const Point& p) {
    if (!in_box(p, 9, 5, 4)) return 0;
    return p[0] > std::abs(p[1]) - 2 * mm ? 1 : 2;
  };
  const auto image = image_of(label, {60, 40, 30}, {{{{0.4 * mm, 0, 0}}, {{0, 0.4 * mm, 0}}, {{0, 0, 0.4 * mm}}}});
  const auto contacts = find_contacts(lumen_mask(image, {1, 2}, 2, silent), 1e-6);
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_NEAR(contacts[0].area * 1e6, 24 * 0.4 * 20 * 0.4, 1e-9);  // to and fro along y cancels
}

TEST(LumenMask, ContactsAreSortedAndSpecksLeftOut) {
  // Two slabs with bridges of 4, 2 and 0.5 mm radius between them.
  constexpr double places[] = {-9, 1, 9}, radii[] = {2, 4, 0.5};
  const auto label = [&](const Point& p) {
    if (!in_box(p, 4, 5.5, 13)) return 0;
    bool bridge = std::abs(p[0]) > 0.8 * mm;
    for (int k = 0; k < 3; ++k) bridge |= std::hypot(p[1], p[2] - places[k] * mm) < radii[k] * mm;
    return bridge ? (p[0] < 0 ? 1 : 2) : 0;
  };
  const auto mask = lumen_mask(
      image_of(label, {24, 24, 54}, {{{{0.5 * mm, 0, 0}}, {{0, 0.5 * mm, 0}}, {{0, 0, 0.5 * mm}}}}), {1, 2}, 2, silent);
  const auto contacts = find_contacts(mask, 2e-6);
  ASSERT_EQ(contacts.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) {
    const double radius = k == 0 ? 4 : 2;
    EXPECT_NEAR(contacts[k].area * 1e6, std::numbers::pi * radius * radius, 0.05 * std::numbers::pi * radius * radius);
    EXPECT_NEAR(contacts[k].centre[2] / mm, k == 0 ? 1 : -9, 0.1);
  }
  EXPECT_EQ(find_contacts(mask, 0).size(), 3U);
}

}  // namespace
}  // namespace tunica::imaging
