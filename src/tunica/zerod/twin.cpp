#include "tunica/zerod/twin.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numeric>
#include <optional>

#include "tunica/base/error.hpp"
#include "tunica/base/units.hpp"

namespace tunica::zerod {

namespace {

constexpr int steps_per_period = 1000, most_cycles = 1000;
constexpr double periodic_tolerance = 1e-9;
/// Bounds of R_T C_T, in periods: beyond them the pulse no longer depends on the compliance.
constexpr double shortest_decay = 0.02, longest_decay = 50;

double average(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Value at the last two times: what second-order backward differences need, (7.3).
struct Past {
  double last = 0, before = 0;
  bool two = false;
  void push(double value) { *this = {value, last, true}; }
  /// dx/dt = slope * x_new - known
  double slope(double dt) const { return (two ? 1.5 : 1.0) / dt; }
  double known(double dt) const { return (two ? 2.0 * last - 0.5 * before : last) / dt; }
};

/// The twin under way.
class March {
 public:
  March(const Vessel& vessel, const std::vector<bc::Rcr>& outlets, const bc::Waveform& inflow, const TwinState& start)
      : vessel_(vessel), inflow_(inflow), time_(start.time) {
    pressure_.last = start.pressure;
    for (std::size_t i = 0; i < outlets.size(); ++i) {
      auto& outlet = outlets_.emplace_back("outlet", outlets[i]);
      outlet.restore(std::array{start.flows[i], start.stored[i]});
      flows_.push_back({start.flows[i], 0, false});
    }
  }

  /// (7.2): each flow is affine in the pressure at the inlet, and the pressure follows from the balance of volume.
  void step(double dt) {
    time_ += dt;
    double conductance = vessel_.compliance * pressure_.slope(dt);
    double supply = inflow_.value(time_) + vessel_.compliance * pressure_.known(dt);
    std::vector<std::pair<double, double>> lines;  // Q = first * P - second
    for (std::size_t i = 0; i < outlets_.size(); ++i) {
      const auto& [resistance, inertance] = vessel_.paths[i];
      const auto rest = outlets_[i].evaluate(dt, 1.0, 0.0);
      const double per_pressure = 1 / (inertance * flows_[i].slope(dt) + resistance + rest.per_end_flow);
      lines.emplace_back(per_pressure, per_pressure * (rest.pressure - inertance * flows_[i].known(dt)));
      conductance += lines.back().first;
      supply += lines.back().second;
    }
    pressure_.push(supply / conductance);
    for (std::size_t i = 0; i < outlets_.size(); ++i) {
      flows_[i].push(lines[i].first * pressure_.last - lines[i].second);
      outlets_[i].commit(dt, flows_[i].last);
    }
  }

  /// From the present time to the end of the period, where time begins anew.
  TwinCycle cycle(double period) {
    TwinCycle c;
    c.flows.resize(outlets_.size());
    const double begin = time_;
    const int steps = std::max(static_cast<int>(std::lround(steps_per_period * (1 - begin / period))), 1);
    const double dt = (period - begin) / steps;
    for (int k = 1; k <= steps; ++k) {
      step(dt);
      time_ = begin + k * dt;
      c.times.push_back(time_);
      c.pressure.push_back(pressure_.last);
      for (std::size_t i = 0; i < flows_.size(); ++i) c.flows[i].push_back(flows_[i].last);
    }
    time_ = 0;
    c.end = state();
    return c;
  }

  TwinState state() const {
    TwinState s{time_, pressure_.last, {}, {}};
    for (const auto& flow : flows_) s.flows.push_back(flow.last);
    for (const auto& outlet : outlets_) s.stored.push_back(outlet.stored_pressure());
    return s;
  }
  void shift_stored(const std::vector<double>& by) {
    for (std::size_t i = 0; i < outlets_.size(); ++i)
      outlets_[i].restore(std::array{flows_[i].last, outlets_[i].stored_pressure() + by[i]});
  }

 private:
  const Vessel& vessel_;
  const bc::Waveform& inflow_;
  double time_;
  std::vector<bc::Outlet> outlets_;
  Past pressure_;
  std::vector<Past> flows_;
};

double largest_change(const TwinState& a, const TwinState& b) {
  double change = std::abs(a.pressure - b.pressure) / std::max(std::abs(b.pressure), 1.0);
  for (std::size_t i = 0; i < a.stored.size(); ++i)
    change = std::max(change, std::abs(a.stored[i] - b.stored[i]) / std::max(std::abs(b.stored[i]), 1.0));
  return change;
}

/// Where the slowest mode leads, from the ends of three cycles (Aitken).
std::vector<double> extrapolation(const std::array<TwinState, 3>& ends) {
  double top = 0, bottom = 0;
  for (std::size_t i = 0; i < ends[0].stored.size(); ++i) {
    const double first = ends[1].stored[i] - ends[0].stored[i], second = ends[2].stored[i] - ends[1].stored[i];
    top += first * second;
    bottom += first * first;
  }
  const double ratio = bottom > 0 ? std::clamp(top / bottom, 0.0, 0.999) : 0.0;
  std::vector<double> by;
  for (std::size_t i = 0; i < ends[0].stored.size(); ++i)
    by.push_back(ratio / (1 - ratio) * (ends[2].stored[i] - ends[1].stored[i]));
  return by;
}

}  // namespace

std::vector<bc::Rcr> share_out(const FlowSplit& split, const Totals& totals) {
  std::vector<bc::Rcr> shared;
  for (const double share : split.fractions) {
    const double resistance = totals.resistance / share;
    shared.push_back({.proximal = (1 - split.distal_share) * resistance,
                      .capacitance = totals.compliance * share,
                      .distal = split.distal_share * resistance,
                      .distal_pressure = split.distal_pressure});
  }
  return shared;
}

Pressures pressures(const TwinCycle& cycle) {
  const auto [low, high] = std::minmax_element(cycle.pressure.begin(), cycle.pressure.end());
  return {*high, *low, average(cycle.pressure)};
}

Pressures first_pressures(const std::vector<double>& times, const std::vector<double>& pressure, double mean,
                          double settled) {
  const auto begin = std::lower_bound(times.begin(), times.end(), settled) - times.begin();
  const auto high = std::max_element(pressure.begin() + begin, pressure.end());
  return {*high, *std::min_element(high, pressure.end()), mean};
}

Pressures first_pressures(const TwinCycle& cycle, double settled) {
  return first_pressures(cycle.times, cycle.pressure, average(cycle.pressure), settled);
}

std::vector<double> mean_flows(const TwinCycle& cycle) {
  std::vector<double> means;
  for (const auto& flow : cycle.flows) means.push_back(average(flow));
  return means;
}

Twin::Twin(Vessel vessel, std::vector<bc::Rcr> outlets, bc::Waveform inflow, double period)
    : vessel_(std::move(vessel)), outlets_(std::move(outlets)), inflow_(std::move(inflow)), period_(period) {
  assert(vessel_.paths.size() == outlets_.size() && period > 0);
}

TwinCycle Twin::first_cycle(const TwinState& start) const {
  return March(vessel_, outlets_, inflow_, start).cycle(period_);
}

TwinCycle Twin::periodic_cycle() const {
  TwinState start;
  const double mean = inflow_.mean();
  double conductance = 0;
  for (const auto& o : outlets_) conductance += 1 / (o.proximal + o.distal);
  for (const auto& o : outlets_) {
    start.flows.push_back(mean / (o.proximal + o.distal) / conductance);
    start.stored.push_back(o.distal_pressure + o.distal * start.flows.back());
  }
  start.pressure = outlets_[0].distal_pressure + mean / conductance;
  March march(vessel_, outlets_, inflow_, start);
  std::array<TwinState, 3> ends;
  for (int k = 0; k < most_cycles; ++k) {
    const TwinCycle cycle = march.cycle(period_);
    std::rotate(ends.begin(), ends.begin() + 1, ends.end());
    ends[2] = cycle.end;
    if (k > 0 && largest_change(ends[2], ends[1]) < periodic_tolerance) return cycle;
    // The cycle after an extrapolation carries fast modes that it has stirred, so two more go before the next.
    if (k % 4 == 3) march.shift_stored(extrapolation(ends));
  }
  throw SolverError(fmt::format("the 0D model of the outlets is not periodic after {} cycles", most_cycles));
}

namespace {

/// Newton's method for the logarithms of the totals.
class TotalsSearch {
 public:
  TotalsSearch(const FlowSplit& split, const Vessel& vessel, const bc::Waveform& inflow, double period, double systolic,
               double diastolic)
      : split_(split), vessel_(vessel), inflow_(inflow), period_(period), systolic_(systolic), diastolic_(diastolic) {}

  Totals find() {
    const double mean = (systolic_ + 2 * diastolic_) / 3 - split_.distal_pressure;
    Point x{std::log(mean / inflow_.mean()), 0};
    x[1] = std::log(period_) - x[0];
    for (int k = 0; k < 60; ++k) {
      const Point r = residual(x);
      if (std::max(std::abs(r[0]), std::abs(r[1])) < 1e-6) return {std::exp(x[0]), std::exp(x[1])};
      const Point dx = newton(x, r);
      for (int i = 0; i < 2; ++i) x[i] += std::clamp(dx[i], -0.7, 0.7);
      keep_in_bounds(x);
    }
    throw SolverError(failure());
  }

 private:
  using Point = std::array<double, 2>;

  Pressures at(const Point& x) const {
    const auto outlets = share_out(split_, {std::exp(x[0]), std::exp(x[1])});
    return pressures(Twin(vessel_, outlets, inflow_, period_).periodic_cycle());
  }
  /// Of the middle, which follows the resistance, and of the pulse, which follows the compliance.
  Point residual(const Point& x) {
    const Pressures p = at(x);
    reached_ = p;
    return {(p.systolic + p.diastolic) / (systolic_ + diastolic_) - 1,
            (p.systolic - p.diastolic) / (systolic_ - diastolic_) - 1};
  }
  Point newton(const Point& x, const Point& r) {
    constexpr double h = 1e-4;
    const Pressures reached = reached_;
    const Point a = residual({x[0] + h, x[1]}), b = residual({x[0], x[1] + h});
    reached_ = reached;
    const double j00 = (a[0] - r[0]) / h, j10 = (a[1] - r[1]) / h, j01 = (b[0] - r[0]) / h, j11 = (b[1] - r[1]) / h;
    const double det = j00 * j11 - j01 * j10;
    return {-(r[0] * j11 - r[1] * j01) / det, -(j00 * r[1] - j10 * r[0]) / det};
  }
  /// Bounds of R_T C_T; a search that stays at one of them has no solution.
  void keep_in_bounds(Point& x) {
    const double low = std::log(shortest_decay * period_), high = std::log(longest_decay * period_);
    x[1] = std::clamp(x[0] + x[1], low, high) - x[0];
  }
  std::string failure() const {
    return fmt::format(
        "no resistance and compliance of the outlets give {:.4g}/{:.4g} mmHg at the inlet: the 0D model comes to "
        "{:.4g}/{:.4g} mmHg\n  a pulse that is too large even with much compliance comes from proximal resistance "
        "({:.3g} of the whole) and from the vessel, between rigid walls from the inertia of the blood: raise "
        "`distal_share` or the pulse asked for;\n  one that is too "
        "small even without compliance in the outlets comes from the vessel's own: ask for less",
        systolic_ / unit::mmHg, diastolic_ / unit::mmHg, reached_.systolic / unit::mmHg,
        reached_.diastolic / unit::mmHg, 1 - split_.distal_share);
  }

  const FlowSplit& split_;
  const Vessel& vessel_;
  const bc::Waveform& inflow_;
  double period_, systolic_, diastolic_;
  Pressures reached_;
};

}  // namespace

Totals find_totals(const FlowSplit& split, const Vessel& vessel, const bc::Waveform& inflow, double period,
                   double systolic, double diastolic) {
  return TotalsSearch(split, vessel, inflow, period, systolic, diastolic).find();
}

}  // namespace tunica::zerod
