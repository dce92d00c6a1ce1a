#include <fmt/format.h>

#include <algorithm>

#include "tunica/coupling/settings.hpp"

namespace tunica::coupling {

using config::Problems;
using config::Schema;
namespace dimension = config::dimension;

namespace {

constexpr double round_off = 1e-9;  ///< of a period that is a multiple of the step

void check_time(const TimeSettings& time, Problems& problems) {
  if ((time.steps > 0) == time.cycles.has_value())
    problems.add(time.cycles ? "cycles" : "steps", time.cycles ? "is given beside `steps`" : "is missing",
                 "give `steps: 100`, or `cycles: {period: 0.8 s}` for a run until it is periodic");
  if (time.cycles) {
    const double period = time.cycles->period;
    const auto n = time.steps_per_cycle();
    if (n < 2 || std::abs(static_cast<double>(n) * time.step - period) > round_off * period)
      problems.add("cycles.period",
                   fmt::format("of {:.9g} s is no multiple of the step of {:.9g} s", period, time.step),
                   fmt::format("give a step of {:.9g} s", period / static_cast<double>(std::max<std::int64_t>(n, 2))));
  }
  if (time.adaptive && time.adaptive->smallest > time.step)
    problems.add("adaptive.smallest", "is larger than `step`, which is the largest",
                 "give at most the step, such as an eighth of it");
}

}  // namespace

Schema<TimeSettings> TimeSettings::schema() {
  return Schema<TimeSettings>("time", "Time stepping: a number of steps, or cycles until they repeat themselves.")
      .quantity("step", &TimeSettings::step, dimension::time, config::above(0),
                "Step size; with `adaptive` the largest")
      .plausible("0.001 ms", "20 ms")
      .integer("steps", &TimeSettings::steps, config::range(1, 1e9), "Number of steps of that size")
      .optional()
      .section("cycles", &TimeSettings::cycles, CycleSettings::schema(),
               "In place of `steps`: cycles until they repeat themselves")
      .section("adaptive", &TimeSettings::adaptive, AdaptiveSettings::schema(),
               "Steps whose size follows the error; all of the same size when left out")
      .number("rho_infinity", &TimeSettings::rho_infinity, config::range(0, 1),
              "Spectral radius of the generalised-alpha scheme at infinite frequency: 1 no damping, 0 most")
      .by_default()
      .choice(
          "loads", &TimeSettings::loads, {{"balance", LoadInstant::balance}, {"end", LoadInstant::end}},
          "Instant of a step whose pressures and tractions act: that at which momentum is balanced, of second order "
          "in time, or the end of the step, as svFSI and svMultiPhysics take them, of first order. Outlets follow "
          "their own equations in both")
      .by_default()
      .integer("max_halvings", &TimeSettings::max_halvings, config::range(0, 30),
               "How often a rejected step may be halved before the run stops")
      .by_default()
      .check(check_time);
}

}  // namespace tunica::coupling
