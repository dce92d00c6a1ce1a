// A sign of life while something takes long.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include "tunica/files/phases.hpp"

namespace tunica::files {

/// Hands lines on, and where none came for `interval`, says every `interval` what the last one was and how long it has
/// lasted. From a thread of its own; lines never come at the same time.
class Heartbeat {
 public:
  explicit Heartbeat(Say say, std::chrono::milliseconds interval = std::chrono::seconds(10));
  ~Heartbeat();
  Heartbeat(const Heartbeat&) = delete;
  Heartbeat& operator=(const Heartbeat&) = delete;

  void tell(const std::string& line);

 private:
  using Clock = std::chrono::steady_clock;
  void watch();

  Say say_;
  std::chrono::milliseconds interval_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool ended_ = false;
  std::size_t lines_ = 0;
  std::string last_;
  Clock::time_point told_ = Clock::now();
  std::thread thread_;
};

}  // namespace tunica::files
