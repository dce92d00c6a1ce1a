// Angles between directions without sign, gathered over elements and ranks.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "tunica/base/tensor.hpp"
#include "tunica/parallel/agree.hpp"

namespace tunica::test {

/// Degrees, 0 .. 90; exact also for small angles.
inline double angle_between(const Vec3<double>& a, const Vec3<double>& b) {
  return std::atan2(norm(cross(a, b)), std::abs(dot(a, b))) * 180 / std::numbers::pi;
}

/// Of three axes.
class Angles {
 public:
  void add(const std::array<double, 3>& degrees) {
    ++sums_[0];
    for (std::size_t i = 0; i < 3; ++i) {
      sums_[1 + i] += degrees[i];
      sums_[4 + i] += degrees[i] > 30;
    }
  }
  /// Collective.
  void sum_over_ranks() { parallel::global_sum(MPI_COMM_WORLD, sums_); }

  double elements() const { return sums_[0]; }
  double mean(int axis) const { return sums_[1 + axis] / sums_[0]; }
  double share_above_30(int axis) const { return 100 * sums_[4 + axis] / sums_[0]; }  ///< percent

 private:
  std::array<double, 7> sums_{};
};

}  // namespace tunica::test
