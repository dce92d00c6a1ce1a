#include "tunica/stages/imaging/computed_beat.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tunica/base/error.hpp"

namespace tunica::stages {

config::Schema<ImagedBeat> ImagedBeat::schema() {
  using B = ImagedBeat;
  return config::Schema<B>("beat", "A beat that was computed.")
      .file("case", &B::case_file,
            "Case file that was run; in a folder of `tunica run` that of its stage: run/case.yaml")
      .folder("results", &B::results, "Folder of its fields; that of the case when left out")
      .quantity("period", &B::period, config::dimension::time, config::above(0), "Of the heart beat that is imaged")
      .plausible("0.3 s", "2 s")
      .quantity("until", &B::until, config::dimension::time, config::above(0),
                "Where the beat ends; the last field when left out")
      .map("planes", &B::planes, case_file::MeasuredPlane::schema(),
           "Planes whose true flows or areas are written too, as in the files of `tunica measure` and `tunica motion`")
      .by_default();
}

ComputedBeat::ComputedBeat(analysis::FieldSeries& series, double from, double until,
                           const std::filesystem::path& results)
    : series_(series) {
  const auto& times = series.times();
  const double step = times.size() < 2 ? 0 : (times.back() - times.front()) / static_cast<double>(times.size() - 1);
  if (times.size() < 3 || from < times.front() - 1.5 * step || until > times.back() + 0.5 * step)
    throw InputError(results.string(),
                     fmt::format("holds fields from {:.6g} s to {:.6g} s, which do not cover the beat from {:.6g} s "
                                 "to {:.6g} s",
                                 times.front(), times.back(), from, until),
                     "run longer, or choose `period` and `until`");
}

ComputedBeat::State ComputedBeat::at(double t) {
  const auto& times = series_.times();
  t = std::clamp(t, times.front(), times.back());
  const auto after = std::min(
      times.size() - 1, static_cast<std::size_t>(std::upper_bound(times.begin(), times.end(), t) - times.begin()));
  const double share = (t - times[after - 1]) / (times[after] - times[after - 1]);
  const auto &a = frame(after - 1), &b = frame(after);
  State state;
  const auto blend = [&](const std::vector<double>& from, const std::vector<double>& to, std::vector<double>& result) {
    result.resize(from.size());
    for (std::size_t i = 0; i < from.size(); ++i) result[i] = (1 - share) * from[i] + share * to[i];
  };
  blend(a.velocity, b.velocity, state.velocity);
  blend(a.displacement, b.displacement, state.displacement);
  return state;
}

const analysis::FieldFrame& ComputedBeat::frame(std::size_t number) {
  std::erase_if(held_, [number](const auto& held) { return held.first + 1 < number || held.first > number + 1; });
  const auto found = held_.find(number);
  return found != held_.end() ? found->second : held_.emplace(number, series_.read(number)).first->second;
}

}  // namespace tunica::stages
