// Things that are joined to sets, one pair after the other.
#pragma once

#include <cstdint>
#include <numeric>
#include <vector>

namespace tunica::base {

/// Union-find with halved paths. Things and sets are counted from 0; a set is known by one of its things.
class DisjointSets {
 public:
  /// So many things, each a set of its own.
  explicit DisjointSets(std::int64_t count = 0) : towards_(static_cast<std::size_t>(count)) {
    std::iota(towards_.begin(), towards_.end(), std::int64_t{0});
  }
  /// One more, a set of its own; returns its number.
  std::int64_t add() {
    towards_.push_back(static_cast<std::int64_t>(towards_.size()));
    return towards_.back();
  }
  /// The thing that stands for the set of another one.
  std::int64_t set_of(std::int64_t thing) {
    while (next(thing) != thing) thing = next(thing) = next(next(thing));
    return thing;
  }
  /// The set of `thing` becomes part of that of `other`, for which the same thing stands as before.
  void join(std::int64_t thing, std::int64_t other) { next(set_of(thing)) = set_of(other); }

 private:
  std::int64_t& next(std::int64_t thing) { return towards_[static_cast<std::size_t>(thing)]; }
  std::vector<std::int64_t> towards_;
};

}  // namespace tunica::base
