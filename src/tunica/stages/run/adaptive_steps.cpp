#include "tunica/stages/run/adaptive_steps.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "tunica/assembly/time_scheme.hpp"
#include "tunica/coupling/nodal.hpp"
#include "tunica/parallel/agree.hpp"

namespace tunica::stages {

namespace {

/// Share of the step that the error allows (Hairer, Norsett & Wanner 1993, section II.4).
constexpr double safety = 0.9;

}  // namespace

StepError step_error(const distributed::DistributedMesh& mesh, const coupling::State& before,
                     const coupling::State& after) {
  std::array<double, 2> sums{};
  for (std::int32_t i = 0; i < mesh.owned_nodes; ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t k = coupling::at(i) + c;
      const double v = after.velocity_pressure[k],
                   d = v - before.velocity_pressure[k] - after.dt * before.acceleration[k];
      sums[0] += d * d;
      sums[1] += v * v;
    }
  parallel::global_sum(mesh.comm, sums);
  const double reference = std::max(before.velocity_reference, std::sqrt(sums[1]));
  return {reference > 0 ? std::sqrt(sums[0]) / reference : 0.0, reference};
}

int finest_level(const coupling::TimeSettings& time) {
  return static_cast<int>(std::floor(std::log2(time.step / time.adaptive.value().smallest) + 1e-9));
}

int wanted_level(const coupling::TimeSettings& time, int level, const StepError& error) {
  // The difference grows with the square of the step.
  const double tolerance = time.adaptive.value().tolerance;
  const double growth = error.relative > 0 ? safety * std::sqrt(tolerance / error.relative) : 2.0;
  int wanted = level;
  if (growth >= 2) wanted = level - 1;
  if (error.relative > tolerance) wanted = level + static_cast<int>(std::ceil(-std::log2(growth)));
  return std::clamp(wanted, 0, std::max(level, finest_level(time)));
}

}  // namespace tunica::stages
