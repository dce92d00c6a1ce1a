// Names and times the phases of a stage.
#pragma once

#include <fmt/format.h>

#include <chrono>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace tunica::files {

/// One line for the terminal: what is going on.
using Say = std::function<void(const std::string& line)>;

class Phases {
 public:
  explicit Phases(const Say& say) : say_(say) {}
  void begin(const std::string& phase) {
    end();
    phase_ = phase;
    started_ = Clock::now();
    tell("");
  }
  void tell(const std::string& state) {
    say_(fmt::format("{:7.1f} s  {}{}{}", since(first_), phase_, state.empty() ? "" : ": ", state));
  }
  void end() {
    if (!phase_.empty()) seconds.emplace_back(phase_, since(started_));
    phase_.clear();
  }
  const std::string& phase() const { return phase_; }
  std::vector<std::pair<std::string, double>> seconds;

 private:
  using Clock = std::chrono::steady_clock;
  static double since(Clock::time_point t) { return std::chrono::duration<double>(Clock::now() - t).count(); }
  Say say_;
  std::string phase_;
  Clock::time_point first_ = Clock::now(), started_;
};

}  // namespace tunica::files
