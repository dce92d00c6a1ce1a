#include "tunica/stages/post/findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tunica/artifacts/histories.hpp"
#include "tunica/base/error.hpp"
#include "tunica/config/units.hpp"
#include "tunica/files/csv_file.hpp"

namespace tunica::stages::post {

namespace dimension = config::dimension;

Window choose_window(const std::vector<double>& times, const analysis::PostSettings& settings,
                     const std::string& results, std::vector<std::string>& warnings) {
  Window w{settings.from.value_or(times.front()), settings.until.value_or(times.back())};
  if (settings.period && settings.from) w.until = *settings.from + *settings.period;
  if (settings.period && !settings.from) w.from = w.until - *settings.period;
  const double step = times.size() < 2 ? 0 : (times.back() - times.front()) / static_cast<double>(times.size() - 1);
  const double margin = 1e-6 * step;
  if (w.from < times.front() - 0.5 * step || w.until > times.back() + 0.5 * step)
    throw InputError(
        results,
        fmt::format("holds fields from {:.6g} s to {:.6g} s, which do not cover the window from {:.6g} s to "
                    "{:.6g} s",
                    times.front(), times.back(), w.from, w.until),
        "run longer, or choose `period`, `from` and `until` in the section `post`");
  const auto first = std::lower_bound(times.begin(), times.end(), w.from - margin),
             last = std::upper_bound(times.begin(), times.end(), w.until + margin);
  w.first = static_cast<std::size_t>(first - times.begin());
  w.count = last > first ? static_cast<std::size_t>(last - first) : 0;
  if (w.count < 3)
    throw InputError(
        results,
        fmt::format("holds {} fields between {:.6g} s and {:.6g} s, at least 3 are needed", w.count, w.from, w.until),
        "write fields more often (`output.every`), or take a longer window");
  const double from = times[w.first], until = times[w.first + w.count - 1];
  if (from - w.from > margin || w.until - until > margin)
    warnings.push_back(
        fmt::format("no field was written at an end of the window from {:.6g} s to {:.6g} s; those from "
                    "{:.6g} s to {:.6g} s are taken",
                    w.from, w.until, from, until));
  w.from = from;
  w.until = until;
  return w;
}

namespace {

/// What the histories say of a window comes from all of its steps.
void require_all_steps(const files::CsvColumns& table, const std::vector<double>& times, const Window& window) {
  const auto refuse = [&](const std::string& what) {
    throw InputError(
        table.file.string(), what,
        "choose another window by post.from and post.until, or run the case again from a checkpoint before "
        "it: tunica run CASE --restart CHECKPOINT, or from its start: --overwrite");
  };
  for (const auto& b : artifacts::breaks_of(table))
    if (times[b.line] >= window.from && times[b.line - 1] <= window.until) refuse(b.what);
  if (times.size() < 2) return;  // too few for any window
  // A line belongs to an instant within its step, the window to ends of steps.
  const double first = 1.5 * (times[1] - times[0]), last = 1.5 * (times.back() - times[times.size() - 2]);
  if (table.column("step").front() > 1 && times.front() > window.from + first)
    refuse(fmt::format("begins at {:.6g} s only", times.front()));
  if (times.back() < window.until - last) refuse(fmt::format("ends at {:.6g} s already", times.back()));
}

}  // namespace

std::vector<OpeningHistory> read_openings(const std::filesystem::path& results, const case_file::Case& c,
                                          const analysis::Vessel& vessel, const Window& window) {
  if (!c.solves_fluid()) return {};
  const auto table = files::read_csv(results / "faces.csv", "run the case first: tunica run");
  const auto times = artifacts::si_column(table, "time", dimension::time);
  require_all_steps(table, times, window);
  std::vector<OpeningHistory> openings;
  for (const auto& opening : vessel.openings) {
    const auto flow = artifacts::si_column(table, opening.name + " flow", dimension::volume_flow),
               pressure = artifacts::si_column(table, opening.name + " pressure", dimension::pressure);
    OpeningHistory history{opening.name, {}, {}, {}};
    for (std::size_t k = 0; k < times.size(); ++k) {
      if (times[k] < window.from || times[k] > window.until) continue;
      history.times.push_back(times[k]);
      history.flow.push_back(flow[k]);
      history.pressure.push_back(pressure[k]);
    }
    if (history.times.size() < 3)
      throw InputError(
          table.file.string(),
          fmt::format("has {} lines between {:.6g} s and {:.6g} s", history.times.size(), window.from, window.until),
          "make the window of `post` longer (`from`, `until`, `period`), or, where the run wrote more, put back the "
          "history that belongs to the fields");
    openings.push_back(std::move(history));
  }
  return openings;
}

std::optional<artifacts::LumenSeries> read_lumens(const std::filesystem::path& results, const Window& window,
                                                  std::string& why) {
  auto series = artifacts::read_lumens(results);
  if (!series) {
    why = "the run has not written lumens.csv and lumens.json";
    return std::nullopt;
  }
  const auto& times = series->times;
  const bool later = times.size() < 2 || times.front() > window.from + 1.5 * (times[1] - times[0]);
  if (later && series->table.column("step").front() > 1) {
    why = fmt::format("the run began lumens.csv at {:.6g} s only", times.empty() ? window.until : times.front());
    return std::nullopt;
  }
  require_all_steps(series->table, times, window);
  return series;
}

std::size_t Findings::peak() const {
  std::vector<double> measure(times.size(), 0.0);
  if (!vessel.openings.empty()) {
    measure = figures.column(analysis::column::opening(data.faces[vessel.inlet].name, "pressure"));
  } else {
    for (const auto& region : data.regions) {
      double volume = 0;
      for (auto e = region.first_element; e < region.end_element; ++e)
        volume += frames.volumes()[static_cast<std::size_t>(e)];
      const auto mean = figures.column(analysis::column::stress(region.name, frames.stresses()[0], "mean"));
      for (std::size_t k = 0; k < measure.size(); ++k) measure[k] += volume * mean[k];
    }
  }
  return static_cast<std::size_t>(std::max_element(measure.begin(), measure.end()) - measure.begin());
}

std::vector<std::string> Findings::too_dissipative(const std::vector<std::string>& parts) const {
  if (!dissipation) return {};
  auto names = dissipation->parts_above_limit();
  std::erase_if(names, [&](const std::string& name) {
    return dissipation->parts.size() > 1 && !parts.empty() &&
           std::find(parts.begin(), parts.end(), name) == parts.end();
  });
  return names;
}

}  // namespace tunica::stages::post
