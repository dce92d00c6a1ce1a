#include "tunica/stages/post/lumen_flows.hpp"

#include <algorithm>
#include <utility>

#include "tunica/analysis/cycle.hpp"
#include "tunica/analysis/frame_figures.hpp"

namespace tunica::stages::post {

namespace {

/// Lines of a history within a window, and straight lines to the ends of it.
class Clip {
 public:
  Clip(const std::vector<double>& times, double from, double until) : all_(times) {
    times_.push_back(from);
    for (const double t : times)
      if (t > from && t < until) times_.push_back(t);
    times_.push_back(until);
  }
  const std::vector<double>& times() const { return times_; }

  std::vector<double> values(const std::vector<double>& all) const {
    std::vector<double> clipped;
    for (const double t : times_) {
      const auto after = std::lower_bound(all_.begin(), all_.end(), t) - all_.begin();
      const auto b = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(after, 1, std::ssize(all_) - 1));
      const double share = (t - all_[b - 1]) / (all_[b] - all_[b - 1]);
      clipped.push_back(all[b - 1] + share * (all[b] - all[b - 1]));
    }
    return clipped;
  }

 private:
  const std::vector<double>& all_;
  std::vector<double> times_;
};

}  // namespace

std::size_t LumenFlows::entry() const {
  std::size_t entry = 0;
  double most = -1;
  for (std::size_t k = 0; k < tears.size(); ++k)
    if (const auto c = analysis::course(times, tears[k].flow); c.forward > most) {
      most = c.forward;
      entry = k;
    }
  return entry;
}

std::vector<double> LumenFlows::residual() const {
  std::vector<double> rest(times.size(), 0.0);
  for (std::size_t k = 0; k < rest.size(); ++k) {
    for (const auto& tear : tears) rest[k] += tear.flow[k];
    rest[k] -= outflow[k] + leakage[k] + volume_rate[k];
  }
  return rest;
}

LumenFlows flows_of_run(const artifacts::LumenSeries& series, const analysis::Vessel& vessel, double from,
                        double until) {
  const Clip clip(series.times, from, until);
  LumenFlows flows{.source = LumenFlows::Source::run,
                   .times = clip.times(),
                   .tears = {},
                   .outflow = clip.values(series.outflow),
                   .leakage = clip.values(series.leakage),
                   .volume_rate = clip.values(series.volume_rate),
                   .volume = clip.values(series.volume),
                   .true_volume = clip.values(series.true_volume)};
  for (std::size_t k = 0; k < series.tears.size(); ++k)
    flows.tears.push_back(
        {series.tears[k], analysis::distance_along(vessel, series.tears[k].centre), clip.values(series.tear_flows[k])});
  return flows;
}

LumenFlows flows_of_cuts(const analysis::FigureTable& figures, const analysis::Vessel& vessel,
                         const std::vector<double>& times) {
  LumenFlows flows{.source = LumenFlows::Source::cuts,
                   .times = times,
                   .tears = {},
                   .outflow = std::vector<double>(times.size(), 0.0),
                   .leakage = std::vector<double>(times.size(), 0.0),
                   .volume_rate = figures.column(analysis::column::false_volume_rate),
                   .volume = figures.column(analysis::column::false_volume),
                   .true_volume = figures.column(analysis::column::true_volume)};
  for (const auto& tear : vessel.tears)
    flows.tears.push_back({{tear.name, tear.centre, tear.area},
                           tear.distance,
                           figures.column(analysis::column::tear(tear.name, "flow"))});
  for (const auto& opening : vessel.openings) {
    if (!opening.in_false_lumen) continue;
    const auto flow = figures.column(analysis::column::opening(opening.name, "flow"));
    for (std::size_t k = 0; k < flow.size(); ++k) flows.outflow[k] += flow[k];
  }
  return flows;
}

bool name_as_in_run(const std::vector<analysis::TearPlace>& tears, analysis::Vessel& vessel) {
  if (tears.size() != vessel.tears.size()) return false;
  std::vector<std::size_t> of_run(tears.size(), tears.size());  // number in the vessel
  for (std::size_t v = 0; v < vessel.tears.size(); ++v) {
    const auto nearest = static_cast<std::size_t>(std::min_element(tears.begin(), tears.end(),
                                                                   [&](const auto& a, const auto& b) {
                                                                     return norm(a.centre - vessel.tears[v].centre) <
                                                                            norm(b.centre - vessel.tears[v].centre);
                                                                   }) -
                                                  tears.begin());
    if (of_run[nearest] != tears.size()) return false;
    of_run[nearest] = v;
  }
  std::vector<analysis::Tear> ordered;
  for (std::size_t k = 0; k < tears.size(); ++k) {
    ordered.push_back(std::move(vessel.tears[of_run[k]]));
    ordered.back().name = tears[k].name;
  }
  vessel.tears = std::move(ordered);
  return true;
}

}  // namespace tunica::stages::post
