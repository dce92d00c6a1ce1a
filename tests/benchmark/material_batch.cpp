// Second Piola-Kirchhoff stress and tangent of a million deformation gradients, in C++ as in Python
// (tests/python/material_rate.py): into memory that is there, and into new memory.
#include "tunica/wall/material_batch.hpp"

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <random>
#include <vector>

#include "tunica/assembly/isa.hpp"
#include "tunica/wall/materials/aortic_tissue.hpp"

namespace {

using namespace tunica;

constexpr std::size_t points = 1000000;
constexpr int repetitions = 5;

std::vector<double> some_gradients() {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-0.05, 0.05);
  std::vector<double> F(9 * points);
  for (std::size_t k = 0; k < F.size(); ++k) F[k] = uniform(random) + (k % 9 % 4 == 0 ? 1.0 : 0.0);
  return F;
}

/// Time of the processor, the least of some repetitions [s]: others may have the machine at the same time.
template <class Action>
double seconds(const Action& action) {
  double best = 1e9;
  for (int r = 0; r < repetitions; ++r) {
    const std::clock_t start = std::clock();
    action();
    best = std::min(best, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  return best;
}

void measure(const char* name, const wall::Law& law, const std::vector<double>& F) {
  const wall::Volumetric volumetric{wall::VolumetricEnergy::simo_taylor, 1e6};
  const auto batch = wall::material_batch(static_cast<int>(assembly::choose_isa()));
  std::vector<double> S(9 * points), CC(36 * points);
  const double kept =
      seconds([&] { batch(law, volumetric, F.data(), nullptr, points, {.stress = S.data(), .tangent = CC.data()}); });
  const double anew = seconds([&] {
    std::vector<double> new_S(9 * points), new_CC(36 * points);
    batch(law, volumetric, F.data(), nullptr, points, {.stress = new_S.data(), .tangent = new_CC.data()});
  });
  std::printf("%-12s %8.2f million points/s, into new memory %8.2f\n", name, 1e-6 * points / kept,
              1e-6 * points / anew);
}

}  // namespace

int main() {
  const auto F = some_gradients();
  measure("neo_hooke", wall::NeoHooke{3e4}, F);
  measure("dfd", wall::make_law(wall::aortic_tissue(wall::AorticTissue::flap)), F);
}
