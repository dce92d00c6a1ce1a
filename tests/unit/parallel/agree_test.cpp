#include "tunica/parallel/agree.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tunica/base/error.hpp"

namespace tunica::parallel {
namespace {

const MPI_Comm world = MPI_COMM_WORLD;

TEST(Agree, ReturnsResultsWhenNobodyFails) {
  EXPECT_EQ(agree(world, [] { return rank(world); }), rank(world));
  int calls = 0;
  agree(world, [&] { ++calls; });
  EXPECT_EQ(calls, 1);
}

TEST(Agree, ThrowsTheInputErrorOfOneRankOnAll) {
  const int last = size(world) - 1;
  try {
    agree(world, [&] {
      if (rank(world) == last)
        throw InputError({{"case.yaml: wall.density", "1.06", "give kg/m^3"}, {"mesh", "inverted", "mend it"}});
    });
    FAIL() << "no error";
  } catch (const InputError& error) {
    ASSERT_EQ(error.problems().size(), 2u);
    EXPECT_EQ(error.problems()[0].where, "case.yaml: wall.density");
    EXPECT_EQ(error.problems()[1].remedy, "mend it");
  }
}

TEST(Agree, TakesTheLowestFailingRank) {
  const int lowest = size(world) > 1 ? 1 : 0;
  try {
    agree(world, [&] {
      if (rank(world) >= lowest) throw SolverError("rank " + std::to_string(rank(world)));
    });
    FAIL() << "no error";
  } catch (const SolverError& error) {
    EXPECT_EQ(error.what(), "rank " + std::to_string(lowest));
  }
}

TEST(Agree, CarriesOtherErrorsAsRuntimeErrors) {
  EXPECT_THROW(agree(world, [] { throw std::out_of_range("index"); }), std::runtime_error);
  EXPECT_THROW(agree(world, [] { throw 7; }), std::runtime_error);
}

TEST(Agree, RunsOnRankZeroOnlyAndSharesItsError) {
  int calls = 0;
  const int result = on_root(world, [&] {
    ++calls;
    return 5;
  });
  EXPECT_EQ(calls, rank(world) == 0 ? 1 : 0);
  EXPECT_EQ(result, rank(world) == 0 ? 5 : 0);
  EXPECT_THROW(on_root(world, [] { throw SolverError("on rank 0"); }), SolverError);
}

TEST(Broadcast, CopiesFromRankZero) {
  const bool root = rank(world) == 0;
  double number = root ? 2.5 : 0;
  std::string text = root ? "lumen inlet" : "something longer than that";
  std::vector<std::string> names = root ? std::vector<std::string>{"a", "", "inlet"} : std::vector<std::string>{"b"};
  std::vector<double> values = root ? std::vector<double>{1, 2, 3} : std::vector<double>{};
  broadcast(world, number);
  broadcast(world, text);
  broadcast(world, names);
  broadcast(world, values);
  EXPECT_EQ(number, 2.5);
  EXPECT_EQ(text, "lumen inlet");
  EXPECT_EQ(names, (std::vector<std::string>{"a", "", "inlet"}));
  EXPECT_EQ(values, (std::vector<double>{1, 2, 3}));
}

TEST(Global, AddsInRankOrder) {
  // Summed from rank 0 upwards, 1 is lost beside 1e16; any other order keeps it or loses something else.
  const int ranks = size(world), me = rank(world);
  const double mine = me == 0 ? 1e16 : me == ranks - 1 ? -1e16 : 1.0;
  double expected = 0;
  for (int r = 0; r < ranks; ++r) expected += r == 0 ? 1e16 : r == ranks - 1 ? -1e16 : 1.0;
  EXPECT_EQ(global_sum(world, mine), expected);
  EXPECT_EQ(global_sum(world, std::int64_t{me + 1}), ranks * (ranks + 1) / 2);
  std::vector<double> values{1.0, static_cast<double>(me)};
  global_sum(world, values);
  EXPECT_EQ(values[0], ranks);
  EXPECT_EQ(values[1], ranks * (ranks - 1) / 2);
}

TEST(Global, FindsExtremesAndNeverHidesNotANumber) {
  const double me = rank(world), last = size(world) - 1;
  EXPECT_EQ(global_max(world, me), last);
  EXPECT_EQ(global_min(world, -me), -last);
  EXPECT_EQ(global_max(world, std::int64_t{rank(world)}), size(world) - 1);
  EXPECT_EQ(global_min(world, std::int64_t{rank(world)}), 0);
  const double broken = me == last ? std::numeric_limits<double>::quiet_NaN() : me;
  EXPECT_TRUE(std::isnan(global_max(world, broken)));
  EXPECT_TRUE(std::isnan(global_min(world, broken)));
  EXPECT_TRUE(any(world, me == last));
  EXPECT_FALSE(any(world, false));
}

}  // namespace
}  // namespace tunica::parallel
