#include "tunica/parallel/progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>

namespace tunica::parallel {

namespace {
constexpr double redraw_interval = 0.1;  // s; faster than anyone reads, slower than a terminal chokes on
constexpr double line_interval = 60;     // s
constexpr double line_fraction = 0.1;
}  // namespace

std::string format_duration(std::optional<double> seconds) {
  if (!seconds || !std::isfinite(*seconds)) return "?";
  const auto total = static_cast<long long>(std::llround(std::max(0.0, *seconds)));
  const long long hours = total / 3600, minutes = total / 60 % 60;
  if (hours > 0) return fmt::format("{}:{:02}:{:02}", hours, minutes, total % 60);
  return fmt::format("{}:{:02}", minutes, total % 60);
}

std::string format_bar(std::string_view title, double fraction, std::optional<double> seconds_left,
                       std::string_view note, int columns) {
  fraction = std::clamp(fraction, 0.0, 1.0);
  const std::string after = fmt::format("] {:3.0f} % ETA {} {}", 100 * fraction, format_duration(seconds_left), note);
  const std::string before = fmt::format("{} [", title);
  const int room = columns - 1 - static_cast<int>(before.size() + after.size());
  const int width = std::clamp(room, 10, 40);
  const int done = static_cast<int>(fraction * width);
  std::string line = before + std::string(static_cast<std::size_t>(done), '#') +
                     std::string(static_cast<std::size_t>(width - done), '.') + after;
  line.resize(std::min(line.size(), static_cast<std::size_t>(std::max(columns - 1, 0))));
  return line.erase(line.find_last_not_of(' ') + 1);
}

Progress::Progress(Log& log, std::string title, double begin, double end, Clock clock)
    : log_(log),
      title_(std::move(title)),
      begin_(begin),
      end_(end),
      clock_(std::move(clock)),
      started_(clock_()),
      last_shown_(started_ - redraw_interval) {
  assert(end > begin);
}

Progress::~Progress() { log_.status(""); }

void Progress::update(double position, std::string_view note) {
  const double now = clock_();
  const double fraction = std::clamp((position - begin_) / (end_ - begin_), 0.0, 1.0);
  std::optional<double> left;
  if (fraction > 0) left = (now - started_) * (1 - fraction) / fraction;
  if (log_.on_terminal()) {
    if (now - last_shown_ < redraw_interval && fraction < 1) return;
    log_.status(format_bar(title_, fraction, left, note, log_.columns()));
  } else {
    // The tolerance keeps 10 steps of 0.1 from becoming 9 lines.
    const bool far = fraction - last_fraction_ > line_fraction - 1e-9 || (fraction >= 1 && last_fraction_ < 1);
    if (!far && now - last_shown_ < line_interval) return;
    log_.info(fmt::format("{} {:.0f} %, ETA {}{}{}", title_, 100 * fraction, format_duration(left),
                          note.empty() ? "" : ", ", note));
    last_fraction_ = fraction;
  }
  last_shown_ = now;
}

double Progress::steady_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace tunica::parallel
