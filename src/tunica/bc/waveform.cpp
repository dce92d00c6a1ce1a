#include "tunica/bc/waveform.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tunica/base/error.hpp"

namespace tunica::bc {

namespace {

constexpr double closing_tolerance = 1e-3;  // of the range of values
constexpr double time_tolerance = 1e-9;     // relative

/// Second derivatives of the spline at the points; tridiagonal system by elimination. With `periodic`, the last point
/// repeats the first and the system is cyclic (Sherman-Morrison for the two corners).
class Spline {
 public:
  Spline(const std::vector<double>& t, const std::vector<double>& v) : t_(t), v_(v) {}

  std::vector<double> natural() const {
    const std::size_t n = t_.size();
    std::vector<double> diagonal(n, 1.0), right(n, 0.0), lower(n, 0.0), upper(n, 0.0);
    for (std::size_t i = 1; i + 1 < n; ++i) row(i, i - 1, i + 1, lower[i], diagonal[i], upper[i], right[i]);
    return eliminate(lower, diagonal, upper, right);
  }

  std::vector<double> periodic() const {
    const std::size_t n = t_.size() - 1;  // distinct points
    std::vector<double> diagonal(n), right(n), lower(n), upper(n);
    for (std::size_t i = 0; i < n; ++i) row(i, (i + n - 1) % n, i + 1, lower[i], diagonal[i], upper[i], right[i]);
    // Corners lower[0] in column n-1 and upper[n-1] in column 0: A = T + u w^T with u = (g, .., upper[n-1]),
    // w = (1, .., lower[0]/g).
    const double g = -diagonal[0], first = lower[0], last = upper[n - 1];
    diagonal[0] -= g;
    diagonal[n - 1] -= first * last / g;
    std::vector<double> u(n, 0.0);
    u[0] = g;
    u[n - 1] = last;
    const auto x = eliminate(lower, diagonal, upper, right);
    const auto z = eliminate(lower, diagonal, upper, u);
    const double factor = (x[0] + first / g * x[n - 1]) / (1.0 + z[0] + first / g * z[n - 1]);
    std::vector<double> m(n + 1);
    for (std::size_t i = 0; i < n; ++i) m[i] = x[i] - factor * z[i];
    m[n] = m[0];
    return m;
  }

 private:
  /// Continuity of the first derivative at point i, with the interval before it ending at `before` + 1.
  void row(std::size_t i, std::size_t before, std::size_t after, double& low, double& mid, double& up,
           double& rhs) const {
    const double h0 = t_[before + 1] - t_[before], h1 = t_[after] - t_[i];
    const double s0 = (v_[before + 1] - v_[before]) / h0, s1 = (v_[after] - v_[i]) / h1;
    low = h0;
    mid = 2.0 * (h0 + h1);
    up = h1;
    rhs = 6.0 * (s1 - s0);
  }

  static std::vector<double> eliminate(const std::vector<double>& lower, std::vector<double> diagonal,
                                       const std::vector<double>& upper, std::vector<double> x) {
    const std::size_t n = x.size();
    for (std::size_t i = 1; i < n; ++i) {
      const double factor = lower[i] / diagonal[i - 1];
      diagonal[i] -= factor * upper[i - 1];
      x[i] -= factor * x[i - 1];
    }
    x[n - 1] /= diagonal[n - 1];
    for (std::size_t i = n - 1; i-- > 0;) x[i] = (x[i] - upper[i] * x[i + 1]) / diagonal[i];
    return x;
  }

  const std::vector<double>& t_;
  const std::vector<double>& v_;
};

/// Four coefficients per interval, of powers of the time since its start.
std::vector<double> linear_coefficients(const std::vector<double>& t, const std::vector<double>& v) {
  std::vector<double> c;
  for (std::size_t i = 0; i + 1 < t.size(); ++i)
    c.insert(c.end(), {v[i], (v[i + 1] - v[i]) / (t[i + 1] - t[i]), 0.0, 0.0});
  return c;
}

std::vector<double> spline_coefficients(const std::vector<double>& t, const std::vector<double>& v, bool periodic) {
  const Spline spline(t, v);
  const auto m = periodic ? spline.periodic() : spline.natural();
  std::vector<double> c;
  for (std::size_t i = 0; i + 1 < t.size(); ++i) {
    const double h = t[i + 1] - t[i];
    c.insert(c.end(), {v[i], (v[i + 1] - v[i]) / h - h * (2.0 * m[i] + m[i + 1]) / 6.0, 0.5 * m[i],
                       (m[i + 1] - m[i]) / (6.0 * h)});
  }
  return c;
}

void check_points(const Table& table, const std::string& where) {
  if (table.times.size() != table.values.size() || table.times.size() < 2)
    throw InputError(where, fmt::format("{} points, at least 2 are needed", table.times.size()),
                     "give the waveform at two times or more, or a constant");
  for (std::size_t i = 0; i < table.times.size(); ++i) {
    if (!std::isfinite(table.times[i]) || !std::isfinite(table.values[i]))
      throw InputError(where, fmt::format("point {} is not finite", i + 1), "give finite numbers");
    if (i > 0 && table.times[i] <= table.times[i - 1])
      throw InputError(
          where,
          fmt::format("time does not increase at point {}: {} after {} s", i + 1, table.times[i], table.times[i - 1]),
          "sort the table by time and remove repeated times");
  }
}

/// Makes the last point repeat the first one at the end of the period.
void close_period(std::vector<double>& t, std::vector<double>& v, const std::optional<double>& wanted,
                  const std::string& where) {
  const double span = t.back() - t.front(), period = wanted.value_or(span);
  if (!(period >= span * (1.0 - time_tolerance)))
    throw InputError(where, fmt::format("the period {} s is shorter than the table, {} s", period, span),
                     "give the period of the waveform, or a table of one period");
  if (period > span * (1.0 + time_tolerance)) {
    t.push_back(t.front() + period);
    v.push_back(v.front());
    return;
  }
  const auto [low, high] = std::minmax_element(v.begin(), v.end());
  if (std::abs(v.back() - v.front()) > closing_tolerance * (*high - *low))
    throw InputError(where,
                     fmt::format("the period does not close: {} at {} s, {} at {} s (SI, tolerance 0.1 % of the range)",
                                 v.front(), t.front(), v.back(), t.back()),
                     "repeat the first value at the end of the period, give `period` when the table stops before its "
                     "end, or set `periodic: false`");
  v.back() = v.front();
}

/// What `automatic` means for this table: .flow files name their modes, and what reads them takes the straight line
/// from the first to the last value off (Fourier series of related codes).
TableOptions resolved(TableOptions options, const Table& table) {
  if (options.interpolation != Interpolation::automatic) return options;
  const bool series = options.periodic && (table.modes > 0 || options.modes > 0 || options.trend);
  options.interpolation = series ? Interpolation::fourier : Interpolation::linear;
  options.trend = options.trend || (series && !options.period);
  return options;
}

double ramp_factor(double t, double ramp_time) {
  if (ramp_time == 0.0 || t >= ramp_time) return 1.0;
  return t <= 0.0 ? 0.0 : 0.5 * (1.0 - std::cos(std::numbers::pi * t / ramp_time));
}

double step_value(const Step& step, double t) {
  const auto after = [t](double limit) { return t > limit + time_tolerance * std::abs(limit); };
  return after(step.start) && !(step.end && after(*step.end)) ? step.value : 0.0;
}

/// Time since the start of the period that t lies in.
double wrapped(double t, double start, double period) {
  const double h = std::fmod(t - start, period);
  return h < 0.0 ? h + period : h;
}

}  // namespace

Waveform Waveform::constant(double value) { return Waveform(Constant{value}, "constant"); }

Waveform Waveform::step(const Step& step) {
  if (step.end && *step.end <= step.start)
    throw InputError("step", fmt::format("end {} s is not after start {} s", *step.end, step.start),
                     "give an end after the start, or none");
  return Waveform(step, "step");
}

Waveform Waveform::table(const Table& table, const TableOptions& given, const std::string& where) {
  check_points(table, where);
  const TableOptions options = resolved(given, table);
  auto t = table.times;
  auto v = table.values;
  if (options.interpolation == Interpolation::ramp)
    return Waveform(Polynomial{{t.front(), t.back()},
                               linear_coefficients({t.front(), t.back()}, {v.front(), v.back()}),
                               false,
                               true,
                               true},
                    where);
  FourierSeries line{t.front(), t.back() - t.front(), {}, {}};
  if (options.trend) {
    line.value = v.front();
    line.slope = (v.back() - v.front()) / line.period;
    for (std::size_t i = 0; i < t.size(); ++i) v[i] -= line.value + line.slope * (t[i] - line.start);
    v.back() = v.front();
  }
  if (options.periodic)
    close_period(t, v, options.period, where);
  else if (options.period)
    throw InputError(where, "a period is given for a waveform that is not periodic",
                     "remove `period` or set `periodic: true`");
  if (options.periodic && options.hold)
    throw InputError(where, "the last value is to hold after a waveform that is periodic",
                     "remove `hold` or set `periodic: false`");
  switch (options.interpolation) {
    case Interpolation::linear: {
      auto c = linear_coefficients(t, v);
      return Waveform(Polynomial{std::move(t), std::move(c), options.periodic, false, options.hold}, where);
    }
    case Interpolation::spline: {
      if (t.size() < 4)
        throw InputError(where, fmt::format("a spline needs 4 points (closing one included), there are {}", t.size()),
                         "give more points or `interpolation: linear`");
      auto c = spline_coefficients(t, v, options.periodic);
      return Waveform(Polynomial{std::move(t), std::move(c), options.periodic, false, options.hold}, where);
    }
    case Interpolation::automatic:
    case Interpolation::fourier:
    case Interpolation::ramp:
      break;
  }
  // The exact coefficients of straight lines know no highest mode; one beyond the points is taken for a slip of the
  // key.
  const int modes = options.modes > 0 ? options.modes : table.modes;
  if (!options.periodic)
    throw InputError(where, "a Fourier series needs a periodic waveform",
                     "set `periodic: true` or another interpolation");
  if (modes < 1 || options.modes > static_cast<int>(t.size()))
    throw InputError(where, fmt::format("{} Fourier modes; the allowed range is 1 .. {}", modes, t.size()),
                     "give `modes`, or name them in the first line of a .flow file");
  FourierSeries series = fourier(t, v, modes);
  series.value = line.value;
  series.slope = line.slope;
  return Waveform(std::move(series), where);
}

Waveform Waveform::fourier_series(FourierSeries series, const std::string& where) {
  const auto finite = [](const std::vector<double>& numbers) {
    return std::all_of(numbers.begin(), numbers.end(), [](double v) { return std::isfinite(v); });
  };
  if (!(series.period > 0) || !std::isfinite(series.period) || !std::isfinite(series.start))
    throw InputError(where, fmt::format("the period is {} s", series.period), "give a period above zero");
  if (series.cosine.empty() || series.cosine.size() != series.sine.size() || !finite(series.cosine) ||
      !finite(series.sine) || !finite({series.value, series.slope}))
    throw InputError(where, "the series has no modes, or coefficients that are not finite", "give at least the mean");
  return Waveform(std::move(series), where);
}

/// Coefficients of the series of the straight-line interpolant, integrated exactly, as SimVascular's solvers do:
/// `modes` counts the mean, so the highest harmonic is modes - 1.
FourierSeries Waveform::fourier(const std::vector<double>& t, const std::vector<double>& v, int modes) {
  FourierSeries series{t.front(), t.back() - t.front(), std::vector<double>(modes, 0.0),
                       std::vector<double>(modes, 0.0)};
  for (std::size_t i = 0; i + 1 < t.size(); ++i)
    series.cosine[0] += 0.5 * (v[i] + v[i + 1]) * (t[i + 1] - t[i]) / series.period;
  for (int k = 1; k < modes; ++k) {
    const double omega = 2.0 * std::numbers::pi * k / series.period;
    const double factor = 2.0 / (series.period * omega * omega);
    for (std::size_t i = 0; i + 1 < t.size(); ++i) {
      const double slope = (v[i + 1] - v[i]) / (t[i + 1] - t[i]);
      const double a = omega * (t[i] - t.front()), b = omega * (t[i + 1] - t.front());
      series.cosine[k] += factor * slope * (std::cos(b) - std::cos(a));
      series.sine[k] += factor * slope * (std::sin(b) - std::sin(a));
    }
  }
  return series;
}

Waveform Waveform::scaled(double factor) const {
  Waveform result = *this;
  result.scale_ *= factor;
  return result;
}

Waveform Waveform::ramped(double ramp_time) const {
  if (!(ramp_time >= 0.0) || !std::isfinite(ramp_time))
    throw InputError(where_, fmt::format("ramp time {} s is not >= 0", ramp_time), "give a ramp time of 0 or more");
  Waveform result = *this;
  result.ramp_time_ = ramp_time;
  return result;
}

double Waveform::evaluate(const Polynomial& p, double t) const {
  const double start = p.times.front(), end = p.times.back(), slack = time_tolerance * (end - start);
  const bool covered = (p.holds_before || t >= start - slack) && (p.holds_after || t <= end + slack);
  if (!p.periodic && !covered)
    throw InputError(where_, fmt::format("t = {} s lies outside the table, {} .. {} s", t, start, end),
                     "give a table that spans the simulated time, or set `periodic: true` or `hold: true`");
  t = p.periodic ? start + wrapped(t, start, end - start) : std::clamp(t, start, end);
  const auto next = std::upper_bound(p.times.begin() + 1, p.times.end() - 1, t);
  const auto i = static_cast<std::size_t>(next - p.times.begin()) - 1;
  const double h = t - p.times[i], *c = &p.coefficients[4 * i];
  return c[0] + h * (c[1] + h * (c[2] + h * c[3]));
}

double Waveform::value(double t) const {
  double result = 0.0;
  if (const auto* constant = std::get_if<Constant>(&shape_)) {
    result = constant->value;
  } else if (const auto* step = std::get_if<Step>(&shape_)) {
    result = step_value(*step, t);
  } else if (const auto* polynomial = std::get_if<Polynomial>(&shape_)) {
    result = evaluate(*polynomial, t);
  } else {
    const auto& f = std::get<FourierSeries>(shape_);
    const double h = wrapped(t, f.start, f.period), angle = 2.0 * std::numbers::pi * h / f.period;
    result = f.value + f.slope * h;
    for (std::size_t k = 0; k < f.cosine.size(); ++k)
      result +=
          f.cosine[k] * std::cos(static_cast<double>(k) * angle) + f.sine[k] * std::sin(static_cast<double>(k) * angle);
  }
  return scale_ * ramp_factor(t, ramp_time_) * result;
}

double Waveform::mean() const {
  if (const auto* constant = std::get_if<Constant>(&shape_)) return scale_ * constant->value;
  if (const auto* step = std::get_if<Step>(&shape_)) return scale_ * step->value;
  if (const auto* series = std::get_if<FourierSeries>(&shape_))
    return scale_ * (series->value + 0.5 * series->slope * series->period + series->cosine[0]);
  const auto& p = std::get<Polynomial>(shape_);
  double integral = 0.0;
  for (std::size_t i = 0; i + 1 < p.times.size(); ++i) {
    const double h = p.times[i + 1] - p.times[i], *c = &p.coefficients[4 * i];
    integral += h * (c[0] + h * (c[1] / 2 + h * (c[2] / 3 + h * c[3] / 4)));
  }
  return scale_ * integral / (p.times.back() - p.times.front());
}

std::optional<FourierSeries> Waveform::series() const {
  const auto* own = std::get_if<FourierSeries>(&shape_);
  if (own == nullptr || ramp_time_ != 0.0) return std::nullopt;
  FourierSeries series = *own;
  for (auto* numbers : {&series.cosine, &series.sine})
    for (double& number : *numbers) number *= scale_;
  series.value *= scale_;
  series.slope *= scale_;
  return series;
}

std::optional<double> Waveform::period() const {
  if (const auto* series = std::get_if<FourierSeries>(&shape_)) return series->period;
  const auto* polynomial = std::get_if<Polynomial>(&shape_);
  if (polynomial && polynomial->periodic) return polynomial->times.back() - polynomial->times.front();
  return std::nullopt;
}

Waveform make_waveform(const WaveformInput& input) {
  const auto plain = [&input] {
    if (const auto* constant = std::get_if<double>(&input.source)) return Waveform::constant(*constant);
    if (const auto* step = std::get_if<Step>(&input.source)) return Waveform::step(*step);
    const auto& source = std::get<TableSource>(input.source);
    if (is_fourier_series(source.file))
      return Waveform::fourier_series(read_fourier_series(source.file)[0], source.file.path.string());
    return Waveform::table(read_table(source.file), source.options, source.file.path.string());
  };
  return plain().scaled(input.scale).ramped(input.ramp_time);
}

}  // namespace tunica::bc
