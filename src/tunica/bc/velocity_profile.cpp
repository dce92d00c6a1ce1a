#include "tunica/bc/velocity_profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "tunica/base/error.hpp"
#include "tunica/bc/formula.hpp"
#include "tunica/files/csv_file.hpp"

namespace tunica::bc {

namespace {

constexpr std::size_t fitted_points = 12;

}  // namespace

std::function<Vec3<double>(const Vec3<double>&, double)> velocity_by_formula(const VelocityProfile& profile,
                                                                             const Vec3<double>& outward) {
  const double unit = profile.unit, per_length = 1.0 / profile.length_unit;
  const auto value = [per_length](const Formula& f, const Vec3<double>& x, double t) {
    return f(per_length * x[0], per_length * x[1], per_length * x[2], t);
  };
  if (profile.speed)
    return [=, speed = Formula(*profile.speed)](const Vec3<double>& x, double t) {
      return (-unit * value(speed, x, t)) * outward;
    };
  std::vector<Formula> components;
  for (const auto& text : profile.velocity) components.emplace_back(text);
  return [=](const Vec3<double>& x, double t) {
    Vec3<double> v;
    for (int i = 0; i < 3; ++i) v[i] = unit * value(components[static_cast<std::size_t>(i)], x, t);
    return v;
  };
}

PointTable::PointTable(const OverFace& source, const PointColumns& columns_of_values)
    : file_(source.table.string()), interpolation_(source.interpolation), period_(source.period) {
  std::vector<const char*> names{"x", "y", "z"};
  names.insert(names.end(), columns_of_values.begin(), columns_of_values.end());
  std::string listed;
  for (const char* name : names) listed += (listed.empty() ? "" : ", ") + std::string(name);
  const auto table = files::read_csv(source.table, "give a table with the columns " + listed);
  std::vector<const std::vector<double>*> columns;
  for (const char* name : names) columns.push_back(&table.column(name));
  if (columns[0]->empty()) throw InputError(file_, "has no line of numbers", "give a line for each point");
  const bool varies = std::find(table.headers.begin(), table.headers.end(), "t") != table.headers.end();
  const std::vector<double>* t = varies ? &table.column("t") : nullptr;
  Vec3<double> low{}, high{};
  for (std::size_t k = 0; k < columns[0]->size(); ++k) {
    Vec3<double> x{};
    auto& v = values_.emplace_back();
    for (std::size_t c = 0; c < 3; ++c) {
      const int i = static_cast<int>(c);
      x[i] = source.length_unit * (*columns[c])[k];
      if (c + 3 < columns.size()) v[i] = source.unit * (*columns[c + 3])[k];
      low[i] = k == 0 ? x[i] : std::min(low[i], x[i]);
      high[i] = k == 0 ? x[i] : std::max(high[i], x[i]);
    }
    add(x, t != nullptr ? (*t)[k] : 0.0);
  }
  extent_ = norm(high - low);
  if (values_.size() != times_.size() * points_.size())
    throw InputError(file_, fmt::format("has fewer points at the time {:.9g} s than at the first one", times_.back()),
                     "give the same points in the same order at every time");
  if (period_ && (steady() || times_.front() < 0 || times_.back() > *period_ * (1 + 1e-9)))
    throw InputError(file_, fmt::format("does not lie within one period of {:.9g} s, from 0 on", *period_),
                     "give a column t with times of one period, or remove `period`");
}

/// Takes the next line: a new time, or the next point of the present one.
void PointTable::add(const Vec3<double>& x, double t) {
  if (times_.empty() || t > times_.back()) {
    if (times_.size() > 1 && (values_.size() - 1) % points_.size() != 0)
      throw InputError(file_, fmt::format("has another number of points at the time {:.9g} s", times_.back()),
                       "give the same points in the same order at every time");
    times_.push_back(t);
  } else if (t < times_.back()) {
    throw InputError(file_, fmt::format("has the time {:.9g} s behind {:.9g} s", t, times_.back()),
                     "order the lines by time");
  }
  if (times_.size() == 1) {
    points_.push_back(x);
    return;
  }
  const std::size_t k = values_.size() - 1 - (times_.size() - 1) * points_.size();
  if (k >= points_.size() || norm(x - points_[k]) > 1e-9 * norm(points_[k]))
    throw InputError(file_, fmt::format("has other points at the time {:.9g} s than at the first one", t),
                     "give the same points in the same order at every time");
}

PointTable::Moment PointTable::moment(double t) const {
  if (period_) t -= *period_ * std::floor(t / *period_);
  const auto after = static_cast<std::size_t>(std::upper_bound(times_.begin(), times_.end(), t) - times_.begin());
  // Between the last time of a period and the first of the next one.
  const bool wraps = period_ && (after == 0 || after == times_.size());
  if (!wraps && after == 0) return {0, 0, 0.0};
  if (!wraps && after == times_.size()) return {after - 1, after - 1, 0.0};
  const std::size_t from = after == 0 ? times_.size() - 1 : after - 1, to = wraps ? 0 : after;
  const double begin = times_[from] - (wraps && after == 0 ? *period_ : 0.0),
               end = times_[to] + (wraps && after != 0 ? *period_ : 0.0);
  return {from, to, end > begin ? (t - begin) / (end - begin) : 0.0};
}

Vec3<double> PointTable::value(const Vec3<double>& place, double t) const {
  const Moment m = moment(t);
  return at(place, m.from, m.to, m.share);
}

std::vector<Vec3<double>> PointTable::history(const Vec3<double>& place) const {
  std::vector<Vec3<double>> values;
  for (std::size_t k = 0; k < times_.size(); ++k) values.push_back(at(place, k, k, 0.0));
  return values;
}

Vec3<double> PointTable::value(const std::vector<Vec3<double>>& history, double t) const {
  const Moment m = moment(t);
  return (1 - m.share) * history[m.from] + m.share * history[m.to];
}

std::vector<std::size_t> PointTable::nearest(const Vec3<double>& place) const {
  std::vector<std::size_t> order(points_.size());
  std::iota(order.begin(), order.end(), 0);
  const auto count = std::min(order.size(), fitted_points);
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end(),
                    [&](std::size_t a, std::size_t b) {
                      const double da = norm(points_[a] - place), db = norm(points_[b] - place);
                      return da != db ? da < db : a < b;
                    });
  order.resize(count);
  return order;
}

Vec3<double> PointTable::at(const Vec3<double>& place, std::size_t from, std::size_t to, double share) const {
  const auto value = [&](std::size_t k) {
    const auto &v0 = values_[from * points_.size() + k], &v1 = values_[to * points_.size() + k];
    return (1 - share) * v0 + share * v1;
  };
  const auto near = nearest(place);
  const double closest = norm(points_[near[0]] - place);
  if (points_.size() > 1 && closest > extent_)
    throw InputError(file_,
                     fmt::format("the node at ({:.6g}, {:.6g}, {:.6g}) m is {:.3g} m away from the nearest point, all "
                                 "points are within {:.3g} m",
                                 place[0], place[1], place[2], closest, extent_),
                     "check `length_unit` and the coordinates of the table");
  if (interpolation_ == OverFace::Interpolation::nearest || near.size() < 3) return value(near[0]);
  // Weighted means first: what is left to fit is a slope, from three by three equations.
  const double radius = norm(points_[near.back()] - place), least = 1e-12 * radius * radius;
  double weights = 0;
  Vec3<double> centre{}, mean{};
  std::vector<double> w;
  for (const auto k : near) {
    const Vec3<double> d = points_[k] - place;
    w.push_back(1.0 / (dot(d, d) + least));
    weights += w.back();
    centre = centre + w.back() * d;
    mean = mean + w.back() * value(k);
  }
  centre = (1.0 / weights) * centre;
  mean = (1.0 / weights) * mean;
  Mat3<double> moments{}, products{};
  for (std::size_t i = 0; i < near.size(); ++i) {
    const Vec3<double> d = points_[near[i]] - place - centre, v = value(near[i]) - mean;
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) moments(r, c) += w[i] * d[r] * d[c], products(r, c) += w[i] * v[r] * d[c];
  }
  const double ridge = 1e-10 * trace(moments);  // no slope across a plane or a line of points
  if (!(ridge > 0)) return mean;
  for (int i = 0; i < 3; ++i) moments(i, i) += ridge;
  return mean - (products * inverse(moments)) * centre;
}

}  // namespace tunica::bc
