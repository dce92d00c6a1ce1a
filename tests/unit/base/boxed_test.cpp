#include "tunica/base/boxed.hpp"

#include <gtest/gtest.h>

#include <string>
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
  std::string text;
  std::vector<int> numbers;
  static inline int alive = 0;
  Later(std::string t = {}, std::vector<int> n = {}) : text(std::move(t)), numbers(std::move(n)) { ++alive; }
  Later(const Later& other) : text(other.text), numbers(other.numbers) { ++alive; }
  ~Later() { --alive; }
};

TEST(Boxed, CopiesItsValueAndEndsIt) {
  {
    Holder first{Later{"a", {1, 2}}};
    Holder second = copy_of(first);
    second.later->text = "b";
    EXPECT_EQ(first.later->text, "a");
    EXPECT_EQ(second.later->numbers, (std::vector{1, 2}));
    EXPECT_EQ(Later::alive, 2);
    first = second;
    EXPECT_EQ(first.later->text, "b");
    const Holder third = std::move(first);
    EXPECT_FALSE(first.later);
    EXPECT_EQ(third.later.value().text, "b");
    second.later.reset();
    EXPECT_EQ(Later::alive, 1);
    second.later.emplace().text = "c";
    second = second;
    EXPECT_EQ((*second.later).text, "c");
  }
  EXPECT_EQ(Later::alive, 0);
}

TEST(Boxed, SaysThatItIsEmpty) {
  EXPECT_FALSE(copy_of({}).later.has_value());
  EXPECT_THROW(Boxed<int>(std::nullopt).value(), std::bad_optional_access);
}

}  // namespace
}  // namespace tunica
