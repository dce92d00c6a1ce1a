#include "tunica/base/disjoint_sets.hpp"

#include <gtest/gtest.h>

namespace tunica::base {
namespace {

TEST(DisjointSets, AreWhatWasJoinedAndNothingElse) {
  DisjointSets sets(6);
  for (std::int64_t i = 0; i < 6; ++i) EXPECT_EQ(sets.set_of(i), i);
  sets.join(0, 1);
  sets.join(2, 3);
  sets.join(3, 1);
  EXPECT_EQ(sets.set_of(0), 1);
  EXPECT_EQ(sets.set_of(2), 1);
  EXPECT_EQ(sets.set_of(4), 4);
  EXPECT_EQ(sets.add(), 6);
  sets.join(6, 4);
  EXPECT_EQ(sets.set_of(6), sets.set_of(4));
  EXPECT_NE(sets.set_of(6), sets.set_of(5));
  sets.join(0, 2);  // of one set already
  EXPECT_EQ(sets.set_of(3), 1);
}

}  // namespace
}  // namespace tunica::base
