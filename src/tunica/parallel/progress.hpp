// How far a run has come, and when it will be done.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "tunica/parallel/log.hpp"

namespace tunica::parallel {

/// "0:07", "12:40", "3:04:05"; "?" when there is nothing to tell yet.
std::string format_duration(std::optional<double> seconds);

/// "title [#####.....]  50 % ETA 0:12 note", at most `columns` - 1 wide; the bar takes what the rest leaves (at least
/// 10 columns), the note is cut. `fraction` 0 .. 1.
std::string format_bar(std::string_view title, double fraction, std::optional<double> seconds_left,
                       std::string_view note, int columns);

/// A bar with the remaining time on a terminal; elsewhere a line in the log every tenth of the way or every minute,
/// whichever comes first. Ends with the object.
class Progress {
 public:
  using Clock = std::function<double()>;  ///< seconds, ascending

  /// `begin` is where this run starts, which is not 0 after a restart; `end` > `begin`: steps or a time.
  Progress(Log& log, std::string title, double begin, double end, Clock clock = steady_seconds);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void update(double position, std::string_view note = {});

  static double steady_seconds();

 private:
  Log& log_;
  std::string title_;
  double begin_, end_;
  Clock clock_;
  double started_, last_shown_;
  double last_fraction_ = 0;
};

}  // namespace tunica::parallel
