#include "tunica/base/boxed.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace tunica {
namespace {

struct Later;
/// Copied, moved and destroyed where Later is not known.
struct Holder {
  Boxed<Later> later;
};
Holder copy_of(const Holder& holder) { return holder; }

struct Later {
  int mark;
  std::vector<int> numbers;
  static inline int alive = 0;
  Later(int m = 0, std::vector<int> n = {}) : mark(m), numbers(std::move(n)) { ++alive; }
  Later(const Later& other) : mark(other.mark), numbers(other.numbers) { ++alive; }
  ~Later() { --alive; }
};

TEST(Boxed, CopiesItsValueAndEndsIt) {
  {
    Holder first{Later{1, {1, 2}}};
    Holder second = copy_of(first);
    second.later->mark = 2;
    EXPECT_EQ(first.later->mark, 1);
    EXPECT_EQ(second.later->numbers, (std::vector{1, 2}));
    EXPECT_EQ(Later::alive, 2);
    first = second;
    EXPECT_EQ(first.later->mark, 2);
    const Holder third = std::move(first);
    EXPECT_FALSE(first.later);
    EXPECT_EQ(third.later.value().mark, 2);
    second.later.reset();
    EXPECT_EQ(Later::alive, 1);
    second.later.emplace().mark = 3;
    EXPECT_EQ((*second.later).mark, 3);
  }
  EXPECT_EQ(Later::alive, 0);
}

TEST(Boxed, SaysThatItIsEmpty) {
  EXPECT_FALSE(copy_of({}).later.has_value());
  EXPECT_THROW(Boxed<int>(std::nullopt).value(), std::bad_optional_access);
}

}  // namespace
}  // namespace tunica
