#include "tunica/coupling/region_blending.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "tunica/base/error.hpp"
#include "tunica/coupling/fibre_frames.hpp"
#include "tunica/mesh/generate.hpp"

namespace tunica::coupling {
namespace {

/// A bar along x from 0 to 1 with one region on either side of x = 1/2; each element brings its number and its double.
mesh::MeshData two_regions(int cells) {
  auto data = mesh::box(cells, cells / 8, cells / 8, {{1.0, 0.1, 0.1}}, mesh::RegionKind::wall);
  const auto middle = std::stable_partition(data.tetrahedra.begin(), data.tetrahedra.end(), [&](const auto& t) {
    double x = 0;
    for (const auto n : t) x += 0.25 * data.points[n][0];
    return x < 0.5;
  });
  const std::int64_t split = middle - data.tetrahedra.begin(), end = std::ssize(data.tetrahedra);
  data.regions = {{"left", mesh::RegionKind::wall, 0, split}, {"right", mesh::RegionKind::wall, split, end}};
  mesh::ElementField numbers{"numbers", 2, {}};
  for (std::int64_t e = 0; e < end; ++e)
    numbers.values.insert(numbers.values.end(), {static_cast<double>(e), 2.0 * static_cast<double>(e)});
  data.fields = {numbers};
  return data;
}

constexpr double length = 0.4;

struct Error {
  double largest, rms;
};

/// Difference from the solution of the filter on a bar of half length H:
/// 1 - cosh((H - x) / l) / (2 cosh(H / l)) at the distance x into the region; on a long bar 1 - exp(-x / l) / 2.
Error error_of(int cells) {
  const auto m = distributed::distribute(two_regions(cells), MPI_COMM_WORLD);
  const auto w = blend_regions(m, {0, 1}, 2, length);
  const double l = length / (2.0 * std::sqrt(3.0));
  double largest = 0.0, sums[2] = {0.0, 0.0};  // of squares, and of ones: the elements are of one size
  for (std::size_t r = 0; r < 2; ++r)
    for (std::size_t e = 0; e < m.regions[r].elements.size(); ++e) {
      double x = 0;
      for (const auto n : m.regions[r].elements[e]) x += 0.25 * m.points[n][0];
      const double own = 1.0 - std::cosh((0.5 - std::abs(x - 0.5)) / l) / (2.0 * std::cosh(0.5 / l));
      const double error = std::abs(w[r][2 * e + r] - own);
      largest = std::max(largest, error);
      sums[0] += error * error;
      sums[1] += 1.0;
      EXPECT_NEAR(w[r][2 * e] + w[r][2 * e + 1], 1.0, 1e-12);
    }
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  return {largest, std::sqrt(sums[0] / sums[1])};
}

TEST(RegionBlending, FollowsTheFilterOnABarWithSecondOrder) {
  const Error coarse = error_of(32), fine = error_of(64);
  RecordProperty("largest_64", std::to_string(fine.largest));
  RecordProperty("order_rms", std::to_string(std::log2(coarse.rms / fine.rms)));
  EXPECT_LT(fine.largest, 2.5e-3);
  EXPECT_GT(std::log2(coarse.rms / fine.rms), 1.8);
}

TEST(RegionBlending, DoesNotDependOnTheRanks) {
  const auto data = two_regions(16);
  const auto whole = distributed::distribute(data, MPI_COMM_SELF), part = distributed::distribute(data, MPI_COMM_WORLD);
  const auto expected = blend_regions(whole, {0, 1}, 2, length), w = blend_regions(part, {0, 1}, 2, length);
  for (std::size_t r = 0; r < 2; ++r) {
    std::map<std::int64_t, double> first;
    for (std::size_t e = 0; e < whole.regions[r].elements.size(); ++e)
      first[whole.regions[r].element_ids[e]] = expected[r][2 * e];
    for (std::size_t e = 0; e < part.regions[r].elements.size(); ++e)
      EXPECT_NEAR(w[r][2 * e], first.at(part.regions[r].element_ids[e]), 1e-8);
  }
}

TEST(RegionBlending, LengthZeroIsSharp) {
  const auto m = distributed::distribute(two_regions(8), MPI_COMM_WORLD);
  const auto w = blend_regions(m, {1, 0}, 2, 0.0);
  for (std::size_t r = 0; r < 2; ++r)
    for (std::size_t e = 0; e < m.regions[r].elements.size(); ++e) {
      EXPECT_EQ(w[r][2 * e + (1 - r)], 1.0);
      EXPECT_EQ(w[r][2 * e + r], 0.0);
    }
}

TEST(ElementFields, GoWithTheirElements) {
  const auto m = distributed::distribute(two_regions(8), MPI_COMM_WORLD);
  for (const auto& region : m.regions) {
    const auto& field = region.field("numbers");
    ASSERT_EQ(field.values.size(), 2 * region.elements.size());
    for (std::size_t e = 0; e < region.elements.size(); ++e) {
      EXPECT_EQ(field.values[2 * e], static_cast<double>(region.element_ids[e]));
      EXPECT_EQ(field.values[2 * e + 1], 2.0 * static_cast<double>(region.element_ids[e]));
    }
    EXPECT_THROW(region.field("absent"), InputError);
    if (!region.elements.empty()) {
      EXPECT_THROW(fibre_frames(m, region, wall::MeshFrame{"numbers", "numbers"}), InputError);
    }
  }
}

}  // namespace
}  // namespace tunica::coupling
