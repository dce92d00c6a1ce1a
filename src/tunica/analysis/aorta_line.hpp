// A smooth line through an aorta with axes carried along it: where along it, at which angle about it and how far from
// it a point lies. What sections, growth and maps between scans are told in.
#pragma once

#include <optional>
#include <vector>

#include "tunica/base/tensor.hpp"

namespace tunica::analysis {

/// Axes across the line, carried along it without turning about it.
struct LineFrame {
  Vec3<double> origin, tangent, e1, e2;  ///< origin in m, the others orthonormal
};

/// A point seen from the line.
struct LineCoordinates {
  double s = 0;       ///< arc length; below 0 and beyond the length on the straight lines past the ends [m]
  double angle = 0;   ///< from e1 towards e2 [rad], in (-pi, pi]
  double radius = 0;  ///< distance from the line in the plane across it [m]
};

class AortaLine {
 public:
  /// Through at least three places [m] in order, resampled at equal distances of about `spacing` [m]; what bends on
  /// lengths below `smoothing` [m] is taken out (least squares with a penalty on second differences: Whittaker,
  /// Proc. Edinburgh Math. Soc. 41, 1923). Throws InputError for fewer places, or a line shorter than three spacings.
  AortaLine(const std::vector<Vec3<double>>& places, double spacing, double smoothing);

  double length() const { return step_ * static_cast<double>(frames_.size() - 1); }
  /// Between nodes of the line the place is linear and the axes turn evenly; straight on past the ends.
  LineFrame frame(double s) const;
  Vec3<double> point(const LineCoordinates& at) const;
  /// The inverse of point(): in the nearest of the planes across the line that hold `x`. Planes cross one another
  /// beyond the centre of a bend, where it is not the inverse.
  LineCoordinates coordinates(const Vec3<double>& x) const;

 private:
  void carry_axes();
  std::optional<double> place_in(std::size_t piece, const Vec3<double>& x) const;

  double step_ = 0;
  std::vector<LineFrame> frames_;
};

}  // namespace tunica::analysis
