#include "tunica/assembly/rank_one.hpp"

#include <gtest/gtest.h>

namespace tunica::assembly {
namespace {

// B = 2 on every rank, two outlets over all of them.
TEST(RankOneInverse, InvertsTheSum) {
  const std::size_t size = 12;  // three nodes of every rank
  const std::vector<RankOne> outlets{{3.0, {0, 1}, {{1, 0, 2}, {0, 1, 0}}}, {0.5, {1, 2}, {{1, 1, 0}, {0, 0, 4}}}};
  const RankOneInverse inverse(MPI_COMM_WORLD, outlets, size, [](std::span<double> z) {
    for (double& v : z) v *= 0.5;
  });
  std::vector<double> r(size), z(size), product(size);
  for (std::size_t k = 0; k < size; ++k) r[k] = k % 4 == 3 ? 0.0 : 1.0 + 0.3 * static_cast<double>(k * k % 7);
  for (std::size_t k = 0; k < size; ++k) z[k] = 0.5 * r[k];
  inverse.correct(z);
  for (std::size_t k = 0; k < size; ++k) product[k] = 2.0 * z[k];
  const auto q = flows(MPI_COMM_WORLD, outlets, z);
  for (std::size_t k = 0; k < q.size(); ++k) add_scaled(outlets[k], outlets[k].coefficient * q[k], product);
  for (std::size_t k = 0; k < size; ++k) EXPECT_NEAR(product[k], r[k], 1e-12);
}

TEST(RankOneInverse, WithoutOutletsChangesNothing) {
  std::vector<double> z{1, 2, 3, 4};
  RankOneInverse{}.correct(z);
  EXPECT_EQ(z, (std::vector<double>{1, 2, 3, 4}));
}

}  // namespace
}  // namespace tunica::assembly
