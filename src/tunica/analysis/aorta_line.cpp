#include "tunica/analysis/aorta_line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tunica/base/error.hpp"

namespace tunica::analysis {

namespace {

Vec3<double> unit(const Vec3<double>& v) { return (1 / norm(v)) * v; }

/// The part of v across the unit vector t, of length one.
Vec3<double> across(const Vec3<double>& v, const Vec3<double>& t) { return unit(v - dot(v, t) * t); }

/// At `count` + 1 equal distances along the straight pieces between the places.
std::vector<Vec3<double>> resampled(const std::vector<Vec3<double>>& places, const std::vector<double>& length,
                                    std::size_t count) {
  std::vector<Vec3<double>> result;
  std::size_t k = 0;
  for (std::size_t i = 0; i <= count; ++i) {
    const double s = length.back() * static_cast<double>(i) / static_cast<double>(count);
    while (k + 2 < places.size() && length[k + 1] < s) ++k;
    const double piece = length[k + 1] - length[k], t = piece > 0 ? (s - length[k]) / piece : 0;
    result.push_back(places[k] + t * (places[k + 1] - places[k]));
  }
  return result;
}

std::vector<double> lengths_along(const std::vector<Vec3<double>>& places) {
  std::vector<double> length{0};
  for (std::size_t k = 1; k < places.size(); ++k) length.push_back(length.back() + norm(places[k] - places[k - 1]));
  return length;
}

/// Minimises sum |x - x0|^2 + weight sum |x_{i-1} - 2 x_i + x_{i+1}|^2: a symmetric matrix of five diagonals, factored
/// as L D L^T.
void smooth(std::vector<Vec3<double>>& x, double weight) {
  const std::size_t n = x.size();
  std::vector<double> diagonal(n, 1), first(n, 0), second(n, 0);  // entries (i, i), (i, i + 1), (i, i + 2)
  for (std::size_t i = 1; i + 1 < n; ++i) {
    diagonal[i - 1] += weight;
    diagonal[i] += 4 * weight;
    diagonal[i + 1] += weight;
    first[i - 1] -= 2 * weight;
    first[i] -= 2 * weight;
    second[i - 1] += weight;
  }
  std::vector<double> d(n), l1(n, 0), l2(n, 0);  // rows of L^T: 1 l1 l2
  for (std::size_t i = 0; i < n; ++i) {
    d[i] = diagonal[i];
    double upper = first[i];
    if (i >= 1) {
      d[i] -= d[i - 1] * l1[i - 1] * l1[i - 1];
      upper -= d[i - 1] * l1[i - 1] * l2[i - 1];
    }
    if (i >= 2) d[i] -= d[i - 2] * l2[i - 2] * l2[i - 2];
    l1[i] = upper / d[i];
    l2[i] = second[i] / d[i];
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (i >= 1) x[i] = x[i] - l1[i - 1] * x[i - 1];
    if (i >= 2) x[i] = x[i] - l2[i - 2] * x[i - 2];
  }
  for (std::size_t i = n; i-- > 0;) {
    x[i] = (1 / d[i]) * x[i];
    if (i + 1 < n) x[i] = x[i] - l1[i] * x[i + 1];
    if (i + 2 < n) x[i] = x[i] - l2[i] * x[i + 2];
  }
}

}  // namespace

AortaLine::AortaLine(const std::vector<Vec3<double>>& places, double spacing, double smoothing) {
  const auto raw = lengths_along(places);
  if (places.size() < 3 || raw.back() < 3 * spacing)
    throw InputError("spacing", fmt::format("is {:.3g} mm on a vessel of {:.3g} mm", 1e3 * spacing, 1e3 * raw.back()),
                     "take a smaller one");
  const auto count = static_cast<std::size_t>(std::lround(raw.back() / spacing));
  auto line = resampled(places, raw, count);
  // A wave of length `smoothing` is halved.
  smooth(line, std::pow(smoothing / (2 * M_PI) * static_cast<double>(count) / raw.back(), 4));
  const auto length = lengths_along(line);
  line = resampled(line, length, count);
  step_ = length.back() / static_cast<double>(count);
  for (std::size_t k = 0; k < line.size(); ++k) {
    const auto& before = line[k == 0 ? 0 : k - 1];
    const auto& after = line[std::min(k + 1, line.size() - 1)];
    frames_.push_back({line[k], unit(after - before), {}, {}});
  }
  carry_axes();
}

void AortaLine::carry_axes() {
  const auto& t = frames_[0].tangent;
  int least = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(t[i]) < std::abs(t[least])) least = i;
  Vec3<double> e1{{0, 0, 0}};
  e1[least] = 1;
  for (auto& f : frames_) {
    e1 = f.e1 = across(e1, f.tangent);
    f.e2 = cross(f.tangent, f.e1);
  }
}

LineFrame AortaLine::frame(double s) const {
  const double x = std::clamp(s / step_, 0.0, static_cast<double>(frames_.size() - 1));
  const auto k = std::min(static_cast<std::size_t>(x), frames_.size() - 2);
  const double t = x - static_cast<double>(k), past = s - step_ * x;
  const auto &a = frames_[k], &b = frames_[k + 1];
  LineFrame f;
  f.tangent = unit((1 - t) * a.tangent + t * b.tangent);
  f.origin = (1 - t) * a.origin + t * b.origin + past * f.tangent;
  f.e1 = across((1 - t) * a.e1 + t * b.e1, f.tangent);
  f.e2 = cross(f.tangent, f.e1);
  return f;
}

Vec3<double> AortaLine::point(const LineCoordinates& at) const {
  const auto f = frame(at.s);
  return f.origin + at.radius * (std::cos(at.angle) * f.e1 + std::sin(at.angle) * f.e2);
}

/// Arc length at which the plane across the line holds x, between two nodes of the line.
std::optional<double> AortaLine::place_in(std::size_t piece, const Vec3<double>& x) const {
  const auto &a = frames_[piece], &b = frames_[piece + 1];
  const auto ahead = [&](double t) {
    return dot(x - ((1 - t) * a.origin + t * b.origin), (1 - t) * a.tangent + t * b.tangent);
  };
  double low = 0, high = 1;
  const double at_low = ahead(0), at_high = ahead(1);
  if (at_low < 0 || at_high >= 0) return std::nullopt;
  for (int k = 0; k < 60 && high - low > 1e-13; ++k) {
    const double middle = 0.5 * (low + high);
    (ahead(middle) >= 0 ? low : high) = middle;
  }
  return step_ * (static_cast<double>(piece) + 0.5 * (low + high));
}

LineCoordinates AortaLine::coordinates(const Vec3<double>& x) const {
  std::vector<double> candidates;
  if (const double s = dot(x - frames_.front().origin, frames_.front().tangent); s < 0) candidates.push_back(s);
  if (const double s = dot(x - frames_.back().origin, frames_.back().tangent); s >= 0)
    candidates.push_back(length() + s);
  for (std::size_t k = 0; k + 1 < frames_.size(); ++k)
    if (const auto s = place_in(k, x)) candidates.push_back(*s);
  LineCoordinates best{.radius = std::numeric_limits<double>::infinity()};
  for (const double s : candidates) {
    const auto f = frame(s);
    const double x1 = dot(x - f.origin, f.e1), x2 = dot(x - f.origin, f.e2), radius = std::hypot(x1, x2);
    if (radius < best.radius) best = {s, std::atan2(x2, x1), radius};
  }
  return best;
}

}  // namespace tunica::analysis
