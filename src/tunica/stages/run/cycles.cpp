#include "tunica/stages/run/cycles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "tunica/artifacts/histories.hpp"
#include "tunica/artifacts/load_mesh.hpp"
#include "tunica/config/units.hpp"
#include "tunica/files/csv_file.hpp"

namespace tunica::stages {

namespace {

/// Openings whose flow is below this share of the largest one are closed, and their flow is noise.
constexpr double closed = 1e-6;

std::vector<std::string> columns(const case_file::OutputUnits& units, const std::vector<std::string>& openings) {
  std::vector<std::string> names{fmt::format("time [{}]", units.time), "cycle", "pressure change", "flow change"};
  for (const auto& face : openings)
    for (const auto& [what, unit] : {std::pair{"pressure", units.pressure}, std::pair{"flow", units.flow}})
      for (const char* value : {"mean", "max", "min"})
        names.push_back(fmt::format("{} {} {} [{}]", face, what, value, unit));
  return names;
}

}  // namespace

std::string describe(const CycleChange& change, const coupling::CycleSettings& settings) {
  std::string text = fmt::format("cycle {} of at most {}", change.cycle, settings.most);
  if (change.cycle == 1) return text;
  if (std::isinf(change.pressure)) return text + ": the histories do not hold the one before";
  text += fmt::format(": pressure changes by {:.3g} %, flow by {:.3g} %", 100 * change.pressure, 100 * change.flow);
  if (change.below(settings.tolerance)) return text + ": periodic";
  if (change.cycle < settings.most) return text;
  return text + fmt::format(", not yet periodic to {:.3g} %; to go on raise time.cycles.most, and use --restart",
                            100 * settings.tolerance);
}

std::vector<std::string> openings(const case_file::Case& c, const std::vector<std::string>& lumen_faces) {
  const auto pairs = case_file::interface_pairs(c.meshes);
  std::vector<std::string> open;
  for (const auto& face : lumen_faces) {
    const bool coupled = std::any_of(pairs.begin(), pairs.end(), [&](const auto& pair) { return pair.first == face; });
    const bool sticks = std::any_of(c.boundary.begin(), c.boundary.end(), [&](const auto& b) {
      return b.first == face &&
             (std::holds_alternative<bc::NoSlip>(b.second) || std::holds_alternative<bc::Symmetry>(b.second));
    });
    if (!coupled && !sticks) open.push_back(face);
  }
  return open;
}

double Cycles::Range::largest() const { return std::max(std::abs(high), std::abs(low)); }

Cycles::Cycles(const std::filesystem::path& folder, const case_file::Case& c, std::vector<std::string> openings,
               std::optional<std::int64_t> continue_from)
    : folder_(folder),
      openings_(std::move(openings)),
      units_(c.output.units),
      period_(c.time->cycles->period / config::unit_factor(units_.time, config::dimension::time)),
      table_(folder / "cycles.csv", columns(units_, openings_), continue_from) {}

std::vector<Cycles::Opening> Cycles::measure(int cycle) const {
  const files::CsvColumns faces = files::read_csv(folder_ / "faces.csv", artifacts::history_remedy),
                          steps = files::read_csv(folder_ / "steps.csv", artifacts::history_remedy);
  const auto &ends = steps.column(fmt::format("time [{}]", units_.time)),
             &sizes = steps.column(fmt::format("dt [{}]", units_.time));
  // Ends of steps, which fall on the end of a cycle but for the ten digits of the table.
  const double slack = 1e-7 * period_;
  const auto within = [&](std::size_t k) {
    return ends[k] > (cycle - 1) * period_ + slack && ends[k] <= cycle * period_ + slack;
  };
  double duration = 0;
  for (std::size_t k = 0; k < ends.size(); ++k)
    if (within(k)) duration += sizes[k];
  if (duration < (1 - 1e-6) * period_) return {};
  // A line may be lost in one of the tables, so lines go together by their step.
  std::map<double, std::size_t> line_of;
  for (std::size_t k = 0; k < faces.column("step").size(); ++k) line_of[faces.column("step")[k]] = k;
  for (std::size_t k = 0; k < ends.size(); ++k)
    if (within(k) && !line_of.contains(steps.column("step")[k])) return {};
  const auto range = [&](const std::vector<double>& values) {
    Range r{.mean = 0, .high = -HUGE_VAL, .low = HUGE_VAL};
    for (std::size_t k = 0; k < ends.size(); ++k) {
      if (!within(k)) continue;
      const double value = values[line_of.at(steps.column("step")[k])];
      r.mean += value * sizes[k] / duration;
      r.high = std::max(r.high, value);
      r.low = std::min(r.low, value);
    }
    return r;
  };
  std::vector<Opening> found;
  for (const auto& face : openings_)
    found.push_back({range(faces.column(fmt::format("{} pressure [{}]", face, units_.pressure))),
                     range(faces.column(fmt::format("{} flow [{}]", face, units_.flow)))});
  return found;
}

CycleChange Cycles::compare(int cycle, const std::vector<Opening>& present) const {
  CycleChange change{.cycle = cycle};
  if (cycle < 2) return change;
  const auto before = measure(cycle - 1);
  if (before.empty() || present.empty()) return {cycle, HUGE_VAL, HUGE_VAL};
  double largest_flow = 0;
  for (const auto& opening : present) largest_flow = std::max(largest_flow, opening.flow.largest());
  const auto relative = [](const Range& a, const Range& b, double scale) {
    const double d = std::max({std::abs(a.mean - b.mean), std::abs(a.high - b.high), std::abs(a.low - b.low)});
    return d > 0 ? d / scale : 0.0;
  };
  for (std::size_t i = 0; i < present.size(); ++i) {
    const auto &p = present[i].pressure, &q = present[i].flow;
    change.pressure = std::max(change.pressure, relative(p, before[i].pressure, p.largest()));
    change.flow = std::max(change.flow, relative(q, before[i].flow, std::max(q.largest(), closed * largest_flow)));
  }
  return change;
}

CycleChange Cycles::compare(int cycle) const { return compare(cycle, measure(cycle)); }

CycleChange Cycles::append(int cycle, std::int64_t step) {
  const auto present = measure(cycle);
  const CycleChange change = compare(cycle, present);
  std::vector<double> line{cycle * period_, static_cast<double>(cycle), change.pressure, change.flow};
  for (const auto& opening : present)
    for (const Range& r : {opening.pressure, opening.flow}) line.insert(line.end(), {r.mean, r.high, r.low});
  line.resize(4 + 6 * openings_.size(), std::nan(""));  // a cycle that the histories hold only in part
  table_.append(step, line);
  return change;
}

}  // namespace tunica::stages
