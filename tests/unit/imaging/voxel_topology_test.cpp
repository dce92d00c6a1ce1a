// Handles of voxel sets against the genus of the surface between voxels, and distances against all pairs.
#include "tunica/imaging/voxel_topology.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "small_images.hpp"
#include "tunica/geometry/contour.hpp"
#include "tunica/imaging/distance.hpp"

namespace tunica::imaging {
namespace {

using namespace testing;

ImageFrame cube(std::int64_t side) { return {{side, side, side}, {{0, 0, 0}}, straight}; }

VoxelSet set_of(const ImageFrame& frame, const Label& label) {
  VoxelSet set;
  for (std::int64_t i = 0; i < frame.count(); ++i) set.push_back(label(frame.place(frame.voxel(i))) != 0);
  return set;
}

/// Sum over the parts of the surface of 2 - 2 genus.
std::int64_t euler(const ImageFrame& frame, const VoxelSet& set) {
  geometry::Grid grid{{{0, 0, 0}}, 1, frame.size, {}};
  for (const auto in : set) grid.values.push_back(in ? -1.0F : 1.0F);
  const auto surface = geometry::zero_surface(grid);
  return std::ssize(surface.points) - std::ssize(geometry::edges(surface)) + std::ssize(surface.triangles);
}

std::vector<float> depth_of(const ImageFrame& frame, const VoxelSet& set) {
  auto depth = signed_distance(frame, set);
  for (auto& d : depth) d = -d;
  return depth;
}

TEST(VoxelTopology, SimpleVoxelsAreThoseThatLeaveTheSurfaceAsItIs) {
  std::mt19937 random(1);
  const auto frame = cube(5);
  const auto middle = frame.index(2, 2, 2);
  int simple = 0;
  for (int n = 0; n < 400; ++n) {
    VoxelSet set(frame.count(), 0);
    for (std::int64_t i = 0; i < frame.count(); ++i) {
      const auto v = frame.voxel(i);
      bool inner = true;
      for (int d = 0; d < 3; ++d) inner &= v[d] >= 1 && v[d] <= 3;
      set[i] = inner && random() % 2;
    }
    auto with = set, without = set;
    with[middle] = 1;
    without[middle] = 0;
    const bool is = is_simple(frame, set, middle);
    simple += is;
    // A simple voxel keeps the Euler number; one that is not may keep it only by two changes at once.
    if (is) {
      EXPECT_EQ(euler(frame, with), euler(frame, without)) << n;
    }
  }
  EXPECT_GT(simple, 20);
  EXPECT_LT(simple, 380);
}

TEST(VoxelTopology, ARingIsOpenedWhereItIsThinnest) {
  const auto frame = cube(30);
  const Point middle{{10.15 * mm, 10.15 * mm, 10.15 * mm}};
  // A torus of radius 6 mm and 2 mm, 1 mm thin at x > 0, and a ball that hangs on it.
  auto set = set_of(frame, [&](const Point& p) {
    const auto x = p - middle;
    const double thickness = x[0] > 0 && std::abs(x[1]) < 2 * mm ? 1 * mm : 2 * mm;
    return std::hypot(std::hypot(x[0], x[1]) - 6 * mm, x[2]) < thickness ||
           norm(x - Vec3<double>{{-6 * mm, 0, 0}}) < 3 * mm;
  });
  ASSERT_EQ(euler(frame, set), 0);
  const auto before = set;
  const auto handles = remove_handles(frame, depth_of(frame, set), set);
  EXPECT_EQ(euler(frame, set), 2);
  ASSERT_EQ(handles.size(), 1U);
  for (const auto i : handles[0].voxels) {
    const auto x = frame.place(frame.voxel(i)) - middle;
    EXPECT_GT(x[0], 0);
    EXPECT_LT(std::abs(x[1]), 2.5 * mm);
  }
  EXPECT_GT(handles[0].way, 15 * mm);
  EXPECT_LT(handles[0].way, 45 * mm);
}

TEST(VoxelTopology, NoiseBecomesABall) {
  std::mt19937 random(2);
  const auto frame = cube(14);
  for (int n = 0; n < 5; ++n) {
    auto set = set_of(frame, [](const Point&) { return 0; });
    for (std::int64_t i = 0; i < frame.count(); ++i) {
      const auto v = frame.voxel(i);
      bool inner = true;
      for (int d = 0; d < 3; ++d) inner &= v[d] >= 1 && v[d] <= 12;
      set[i] = inner && random() % 10 < 6;
    }
    keep_largest_part(frame, set);
    const auto handles = remove_handles(frame, depth_of(frame, set), set);
    EXPECT_EQ(euler(frame, set), 2);
    EXPECT_FALSE(handles.empty());
  }
}

TEST(Distance, IsThatOfTheNearestVoxel) {
  const ImageFrame frame{{9, 7, 8}, {{0, 0, 0}}, oblique()};
  std::mt19937 random(3);
  VoxelSet set;
  for (std::int64_t i = 0; i < frame.count(); ++i) set.push_back(random() % 40 == 0);
  const auto distance = distance_to(frame, set);
  for (std::int64_t i = 0; i < frame.count(); ++i) {
    double least = 1;
    for (std::int64_t j = 0; j < frame.count(); ++j)
      if (set[j]) least = std::min(least, norm(frame.place(frame.voxel(i)) - frame.place(frame.voxel(j))));
    EXPECT_NEAR(distance[i], least, 1e-8);
  }
  const auto signed_one = signed_distance(frame, set);
  for (std::int64_t i = 0; i < frame.count(); ++i) EXPECT_EQ(signed_one[i] < 0, set[i] != 0);
  for (const float d : distance_to(frame, VoxelSet(frame.count(), 0))) EXPECT_TRUE(std::isinf(d));
}

TEST(VoxelTopology, ThinEndsAreTakenAndWhatJoinsStays) {
  const auto frame = cube(24);
  // Two balls, joined by a thread; on one of them a finger, on the other a lamella.
  VoxelSet set;
  for (std::int64_t i = 0; i < frame.count(); ++i) {
    const auto [x, y, z] = frame.voxel(i);
    const auto to_middle_of_ball = [&, x = x, y = y, z = z](double height) {
      return std::hypot(static_cast<double>(x) - 6, static_cast<double>(y) - 6, static_cast<double>(z) - height);
    };
    const bool ball = to_middle_of_ball(6) < 3.4 || to_middle_of_ball(17) < 3.4;
    const bool thread = x == 6 && y == 6 && z > 6 && z < 17;
    const bool finger = x > 6 && x < 16 && y == 6 && z == 6;
    const bool lamella = x > 6 && x < 16 && y > 3 && y < 9 && z == 17;
    set.push_back(ball || thread || finger || lamella);
  }
  const auto before = euler(frame, set);
  const auto all = std::count(set.begin(), set.end(), 1);
  const auto taken = take_thin_ends(frame, set);
  EXPECT_GT(taken, 6 + 6 * 5 - 3);  // less what the balls hold
  EXPECT_EQ(std::count(set.begin(), set.end(), 1), all - taken);
  EXPECT_EQ(euler(frame, set), before);
  for (std::int64_t z = 6; z <= 17; ++z) EXPECT_TRUE(set[frame.index(6, 6, z)]) << z;
  EXPECT_FALSE(set[frame.index(12, 6, 6)]);
  EXPECT_FALSE(set[frame.index(12, 6, 17)]);
}

TEST(VoxelTopology, ThinPitsAreFilledAndVesselsSideBySideStayApart) {
  const auto frame = cube(24);
  VoxelSet set;
  for (std::int64_t i = 0; i < frame.count(); ++i) {
    const auto [x, y, z] = frame.voxel(i);
    const bool block = x > 2 && x < 21 && y > 2 && y < 21 && z > 2 && z < 21;
    const bool pit = x == 6 && y == 6 && z > 17;
    const bool notch = x == 14 && z > 8;  // two vessels with a wall of a voxel between them
    set.push_back(block && !pit && !notch);
  }
  const auto before = euler(frame, set);
  const auto anywhere = [](std::int64_t) { return true; };
  EXPECT_EQ(fill_thin_pits(
                frame, [](std::int64_t) { return false; }, 2, set),
            0);
  EXPECT_GT(fill_thin_pits(frame, anywhere, 2, set), 2);
  EXPECT_EQ(euler(frame, set), before);
  EXPECT_TRUE(set[frame.index(6, 6, 18)]);
  EXPECT_TRUE(set[frame.index(14, 12, 9)]);
  EXPECT_FALSE(set[frame.index(14, 12, 13)]);
}

}  // namespace
}  // namespace tunica::imaging
