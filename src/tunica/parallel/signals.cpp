#include "tunica/parallel/signals.hpp"

#include <time.h>

#include "tunica/parallel/agree.hpp"

namespace tunica::parallel {

namespace {

constexpr int handled[4] = {SIGINT, SIGTERM, SIGUSR1, SIGHUP};
constexpr long long same_request = 500;  // ms

// A handler reaches nothing but variables of static storage; these are the only ones of the program.
volatile std::sig_atomic_t installed = 0;  // how many objects live
volatile std::sig_atomic_t requested = 0;
timespec first_request;

long long milliseconds_since(const timespec& earlier) {
  timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (now.tv_sec - earlier.tv_sec) * 1000LL + (now.tv_nsec - earlier.tv_nsec) / 1000000;
}

extern "C" void request_stop(int signal) {
  if (requested == 0) {
    clock_gettime(CLOCK_MONOTONIC, &first_request);
    requested = signal;
  } else if (signal != SIGHUP && milliseconds_since(first_request) > same_request) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
}

}  // namespace

StopSignals::StopSignals() {
  installed = installed + 1;
  if (installed > 1) return;
  requested = 0;
  struct sigaction action {};
  action.sa_handler = request_stop;
  action.sa_flags = SA_RESTART;  // a stop request must not break a write halfway
  sigemptyset(&action.sa_mask);
  for (const int signal : handled) sigaddset(&action.sa_mask, signal);
  for (int i = 0; i < 4; ++i) {
    sigaction(handled[i], &action, &earlier_[i]);
    if (handled[i] == SIGHUP && earlier_[i].sa_handler == SIG_IGN) sigaction(SIGHUP, &earlier_[i], nullptr);
  }
}

StopSignals::~StopSignals() {
  installed = installed - 1;
  if (installed > 0) return;
  for (int i = 0; i < 4; ++i) sigaction(handled[i], &earlier_[i], nullptr);
  requested = 0;
}

int stop_requested(MPI_Comm comm) { return static_cast<int>(global_max(comm, std::int64_t{requested})); }

}  // namespace tunica::parallel
