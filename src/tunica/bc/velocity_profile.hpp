// Velocities on a face by formulas; velocities, loads and motions by a table of points.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "tunica/bc/conditions.hpp"

namespace tunica::bc {

/// Velocity [m/s] at a place [m] and a time [s] by the formulas of `profile`, without its time course. `outward`: unit
/// normal of the face, which `speed` goes against. Throws InputError for what is no formula.
std::function<Vec3<double>(const Vec3<double>&, double)> velocity_by_formula(const VelocityProfile& profile,
                                                                             const Vec3<double>& outward);

/// Names of the columns of values.
using PointColumns = std::vector<const char*>;
inline const PointColumns velocity_columns{"vx", "vy", "vz"}, traction_columns{"tx", "ty", "tz"},
    displacement_columns{"ux", "uy", "uz"}, factor_column{"factor"};

/// Measured or computed values at scattered points, at one time or at several.
class PointTable {
 public:
  /// Reads the table. Of `columns` there are one, whose values are the first components, or three. Throws InputError
  /// when it does not read, lacks a column or has no line, when its times do not increase from block to block or have
  /// other points, and for a period without times or shorter than these.
  PointTable(const OverFace& source, const PointColumns& columns);

  /// Of one time alone?
  bool steady() const { return times_.size() == 1; }

  /// Value [SI] at a place [m]: that of the nearest point; or a linear function fitted to the nearest twelve with
  /// weights 1 / distance^2 (moving least squares), which takes the values of the table at its points and is exact for
  /// linear fields. Where the points lie in a plane or on a line, the function is constant across it. Throws InputError
  /// for a place further from all points than these are from each other.
  Vec3<double> value(const Vec3<double>& place) const { return at(place, 0, 0, 0.0); }
  /// The same at time t [s], linear between the times of the table; repeated with its period, or else with the first
  /// and last values before and after.
  Vec3<double> value(const Vec3<double>& place, double t) const;

  /// The values at a place at all times of the table: what is looked up once.
  std::vector<Vec3<double>> history(const Vec3<double>& place) const;
  /// The value of a history at time t [s].
  Vec3<double> value(const std::vector<Vec3<double>>& history, double t) const;

 private:
  /// Two times of the table, and the share of the second.
  struct Moment {
    std::size_t from, to;
    double share;
  };
  Moment moment(double t) const;
  void add(const Vec3<double>& x, double t);
  /// Of the share `share` of the time `to` and the rest of `from`, numbers of times.
  Vec3<double> at(const Vec3<double>& place, std::size_t from, std::size_t to, double share) const;
  std::vector<std::size_t> nearest(const Vec3<double>& place) const;

  std::string file_;
  OverFace::Interpolation interpolation_;
  double extent_ = 0;                 ///< diagonal of the box around the points [m]
  std::vector<double> times_;         ///< s
  std::optional<double> period_;      ///< s
  std::vector<Vec3<double>> points_;  ///< m
  std::vector<Vec3<double>> values_;  ///< [time][point], SI
};

}  // namespace tunica::bc
