#include "tunica/parallel/halo.hpp"

#include <gtest/gtest.h>

#include "tunica/parallel/message.hpp"

namespace tunica::parallel {
namespace {

/// A ring of ranks with five nodes each; every rank sees the last two nodes of all the others.
struct Ring {
  static constexpr std::int32_t owned = 5;
  std::vector<std::int64_t> ids;
  std::int64_t first;

  Ring() : first(std::int64_t{owned} * rank(MPI_COMM_WORLD)) {
    for (std::int32_t n = 0; n < owned; ++n) ids.push_back(first + n);
    for (int other = 0; other < size(MPI_COMM_WORLD); ++other)
      if (other != rank(MPI_COMM_WORLD))
        for (std::int64_t n = 3; n < owned; ++n) ids.push_back(std::int64_t{owned} * other + n);
  }
  Halo halo() const { return {MPI_COMM_WORLD, ids, owned, first}; }
};

TEST(Halo, FillsGhostsFromTheirOwners) {
  const Ring ring;
  const Halo halo = ring.halo();
  for (const int components : {1, 3, 4}) {
    std::vector<double> values(ring.ids.size() * static_cast<std::size_t>(components), -1);
    for (std::size_t i = 0; i < static_cast<std::size_t>(Ring::owned * components); ++i)
      values[i] = static_cast<double>(ring.first * components) + static_cast<double>(i);
    halo.update(values, components);
    for (std::size_t n = 0; n < ring.ids.size(); ++n)
      for (int c = 0; c < components; ++c)
        ASSERT_EQ(values[n * components + c], static_cast<double>(ring.ids[n] * components + c));
  }
}

TEST(Halo, LeavesTimeBetweenBeginAndEnd) {
  const Ring ring;
  const Halo halo = ring.halo();
  std::vector<double> values(ring.ids.size(), 0);
  for (std::int32_t n = 0; n < Ring::owned; ++n) values[n] = static_cast<double>(ring.ids[n]);
  halo.begin(values, 1);
  // What is sent was copied at `begin`, so owned values may change at once.
  for (std::int32_t n = 0; n < Ring::owned; ++n) values[n] = -7;
  halo.end();
  for (std::size_t n = Ring::owned; n < ring.ids.size(); ++n) EXPECT_EQ(values[n], static_cast<double>(ring.ids[n]));
  for (std::int32_t n = 0; n < Ring::owned; ++n) EXPECT_EQ(values[n], -7);
}

TEST(Halo, ListsNeighboursBothWays) {
  const Ring ring;
  const Halo halo = ring.halo();
  EXPECT_EQ(halo.neighbours().size(), static_cast<std::size_t>(size(MPI_COMM_WORLD) - 1));
  for (const auto& neighbour : halo.neighbours()) {
    EXPECT_EQ(neighbour.send, (std::vector<std::int32_t>{3, 4}));
    EXPECT_EQ(neighbour.receive_count, 2);
  }
}

/// Rank 0 needs a node of the last rank, which needs nothing in return.
TEST(Halo, ServesOneSidedNeeds) {
  const int me = rank(MPI_COMM_WORLD), last = size(MPI_COMM_WORLD) - 1;
  std::vector<std::int64_t> ids{me};
  if (me == 0 && last > 0) ids.push_back(last);
  const Halo halo(MPI_COMM_WORLD, ids, 1, me);
  std::vector<double> values(ids.size(), 0);
  values[0] = 10.0 + me;
  halo.update(values, 1);
  EXPECT_EQ(values.back(), me == 0 ? 10.0 + last : 10.0 + me);
}

}  // namespace
}  // namespace tunica::parallel
