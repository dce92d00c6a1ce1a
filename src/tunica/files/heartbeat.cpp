#include "tunica/files/heartbeat.hpp"

#include <fmt/format.h>

namespace tunica::files {

Heartbeat::Heartbeat(Say say, std::chrono::milliseconds interval)
    : say_(std::move(say)), interval_(interval), thread_([this] { watch(); }) {}

Heartbeat::~Heartbeat() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void Heartbeat::tell(const std::string& line) {
  {
    const std::lock_guard lock(mutex_);
    say_(line);
    ++lines_;
    last_ = line.substr(0, line.find('\n'));
    told_ = Clock::now();
  }
  changed_.notify_all();
}

void Heartbeat::watch() {
  std::unique_lock lock(mutex_);
  while (!ended_) {
    const std::size_t seen = lines_;
    const bool news = changed_.wait_for(lock, interval_, [&] { return ended_ || lines_ != seen; });
    if (news || lines_ == 0) continue;
    const auto seconds = std::chrono::duration<double>(Clock::now() - told_).count();
    say_(fmt::format("           ... for {:.0f} s: {}", seconds, last_));
  }
}

}  // namespace tunica::files
