#include "tunica/analysis/sampling.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace tunica::analysis {
namespace {

/// Is there exactly one point in each of the equal slices of a dimension?
bool one_in_each_slice(const UnitPoints& points, std::size_t dimension) {
  std::set<int> slices;
  for (const auto& point : points)
    slices.insert(static_cast<int>(point[dimension] * static_cast<double>(points.size())));
  return slices.size() == points.size() && *slices.begin() == 0 &&
         *slices.rbegin() + 1 == static_cast<int>(points.size());
}

TEST(Sampling, LatinHypercubeHasOnePointInEachSlice) {
  const auto points = latin_hypercube(17, 4, 3);
  for (std::size_t d = 0; d < 4; ++d) EXPECT_TRUE(one_in_each_slice(points, d)) << d;
  EXPECT_EQ(points, latin_hypercube(17, 4, 3));
  EXPECT_NE(points, latin_hypercube(17, 4, 4));
}

// The first points of new-joe-kuo-6.21201, as sobol.cc of the authors prints them.
TEST(Sampling, SobolIsThatOfJoeAndKuo) {
  const UnitPoints first = {{0, 0, 0},
                            {0.5, 0.5, 0.5},
                            {0.75, 0.25, 0.25},
                            {0.25, 0.75, 0.75},
                            {0.375, 0.375, 0.625},
                            {0.875, 0.875, 0.125},
                            {0.625, 0.125, 0.875},
                            {0.125, 0.625, 0.375}};
  EXPECT_EQ(sobol_sequence(8, 3), first);
}

TEST(Sampling, ShiftKeepsTheNet) {
  const auto points = shifted_sobol_sequence(64, 6, 5);
  for (std::size_t d = 0; d < 6; ++d) EXPECT_TRUE(one_in_each_slice(points, d)) << d;
  for (const double x : points[0]) EXPECT_GT(x, 0);
  EXPECT_NE(points, shifted_sobol_sequence(64, 6, 6));
}

TEST(Sampling, SaltelliBlocksDifferInOneColumn) {
  const std::size_t rows = 8, dimensions = 3;
  const auto points = saltelli_points(rows, dimensions, 1);
  ASSERT_EQ(points.size(), rows * (dimensions + 2));
  for (std::size_t d = 0; d < dimensions; ++d)
    for (std::size_t k = 0; k < rows; ++k)
      for (std::size_t e = 0; e < dimensions; ++e)
        EXPECT_EQ(points[(d + 2) * rows + k][e], points[(d == e ? rows : 0) + k][e]);
}

}  // namespace
}  // namespace tunica::analysis
