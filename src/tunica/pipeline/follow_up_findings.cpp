#include "tunica/pipeline/follow_up_findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tunica::pipeline {

namespace {

/// Stations in a mean diameter: what lies closer does not grow by itself.
std::size_t block_of(const analysis::Growth& growth) {
  double sum = 0;
  for (const auto& section : growth.sections[0]) sum += section.diameter;
  const double diameter = sum / static_cast<double>(growth.stations.size());
  const double step = growth.stations[1] - growth.stations[0];
  return static_cast<std::size_t>(std::max(1L, std::lround(diameter / step)));
}

Interval make_interval(const FollowUpFindings& f, std::size_t k) {
  Interval i{.from = k, .to = k + 1};
  i.years = f.plan.scans[i.to].years - f.plan.scans[i.from].years;
  i.name = fmt::format("{} to {}", f.plan.scans[i.from].name, f.plan.scans[i.to].name);
  const auto &before = f.growth.sections[i.from], &after = f.growth.sections[i.to];
  for (std::size_t s = 0; s < f.growth.stations.size(); ++s) {
    i.diameter.push_back(after[s].diameter - before[s].diameter);
    for (std::size_t lumen = 0; lumen < 2; ++lumen)
      i.area[lumen].push_back(after[s].lumen_area[lumen] - before[s].lumen_area[lumen]);
  }
  const analysis::ScanMap map(f.scans[i.from]->anatomy, f.scans[i.to]->anatomy);
  i.folds = analysis::count_folds(f.scans[i.from]->data, f.scans[i.from]->anatomy, map);
  return i;
}

std::vector<double> rate(std::vector<double> values, double years) {
  for (double& v : values) v /= years;
  return values;
}

void append(std::vector<double>& to, const std::vector<double>& values) {
  to.insert(to.end(), values.begin(), values.end());
}

void correlate(FollowUpFindings& f) {
  struct Load {
    const char* name;
    std::vector<double> StationLoads::*values;
  };
  const Load loads[] = {{"wall stress", &StationLoads::stress},
                        {"TAWSS", &StationLoads::tawss},
                        {"true less false lumen pressure", &StationLoads::pressure_difference}};
  const auto growths = [](const Interval& i) {
    std::vector<std::pair<const char*, std::vector<double>>> all{{"diameter", rate(i.diameter, i.years)}};
    all.emplace_back("false lumen area", rate(i.area[1], i.years));
    return all;
  };
  const auto add = [&](const std::string& interval, const char* growth, const char* load, const auto& x,
                       const auto& y) {
    f.correlations.push_back({interval, growth, load, analysis::rank_correlation_interval(x, y, f.block)});
  };
  for (const auto& load : loads)
    for (std::size_t g = 0; g < 2; ++g) {
      std::vector<double> all_loads, all_growths;
      const char* name = "";
      std::size_t count = 0;
      for (const auto& i : f.intervals) {
        if (!f.loads[i.from]) continue;
        const auto growth = growths(i)[g];
        name = growth.first;
        add(i.name, name, load.name, *f.loads[i.from].*load.values, growth.second);
        append(all_loads, *f.loads[i.from].*load.values);
        append(all_growths, growth.second);
        ++count;
      }
      if (count > 1) add("all intervals", name, load.name, all_loads, all_growths);
    }
}

}  // namespace

std::vector<const analysis::Anatomy*> FollowUpFindings::anatomies() const {
  std::vector<const analysis::Anatomy*> all;
  for (const auto* scan : scans) all.push_back(&scan->anatomy);
  return all;
}

FollowUpFindings find_follow_up(const FollowUpPlan& plan, const std::vector<const ScanAnatomy*>& scans,
                                const std::vector<Chain>& chains, bool with_loads) {
  FollowUpFindings f{.plan = plan, .scans = scans, .growth = {}, .intervals = {}, .loads = {}, .correlations = {}};
  f.growth = analysis::find_growth(f.anatomies());
  f.block = block_of(f.growth);
  for (std::size_t k = 0; k + 1 < scans.size(); ++k) f.intervals.push_back(make_interval(f, k));
  for (std::size_t k = 0; k < scans.size(); ++k) {
    auto& loads = f.loads.emplace_back();
    if (!with_loads) continue;
    std::vector<double> places;
    for (const double s : f.growth.stations) places.push_back(f.growth.maps[k].arc(s));
    loads = station_loads(chains[k], *scans[k], places);
  }
  correlate(f);
  return f;
}

}  // namespace tunica::pipeline
