// Many points at a time are the same points one by one, whatever the instruction set and the count.
#include "tunica/wall/material_batch.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <vector>

#include "tunica/wall/material_point.hpp"
#include "tunica/wall/materials/aortic_tissue.hpp"

namespace tunica::wall {
namespace {

std::vector<int> widths() {
  std::vector<int> all{2};
#ifndef TUNICA_BASELINE_ISA
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) all.push_back(4);
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
    all.push_back(8);
#endif
  return all;
}

std::vector<Law> laws() { return {NeoHooke{3e4}, MooneyRivlin{2e4, 5e3}, make_law(aortic_tissue(AorticTissue::flap))}; }

std::vector<Mat3<double>> some_gradients(std::size_t count) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-0.1, 0.1);
  std::vector<Mat3<double>> all(count, identity<double>());
  for (auto& F : all)
    for (int n = 0; n < 9; ++n) F(n / 3, n % 3) += uniform(random);
  return all;
}

struct Results {
  std::vector<double> energy, stress, cauchy, tangent;
  explicit Results(std::size_t n) : energy(n), stress(9 * n), cauchy(9 * n), tangent(36 * n) {}
  MaterialBatchResults all() { return {energy.data(), stress.data(), cauchy.data(), tangent.data()}; }
};

void expect_point(const MaterialPoint<double>& point, const Results& results, std::size_t k) {
  double scale = 1.0;
  for (const double x : point.tangent.v) scale = std::max(scale, std::abs(x));
  for (int n = 0; n < 9; ++n) {
    const int at = voigt_index[n / 3][n % 3];
    EXPECT_NEAR(results.stress[9 * k + static_cast<std::size_t>(n)], point.stress[at], 1e-11 * scale);
    EXPECT_NEAR(results.cauchy[9 * k + static_cast<std::size_t>(n)], point.cauchy[at], 1e-11 * scale);
  }
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j)
      EXPECT_NEAR(results.tangent[36 * k + static_cast<std::size_t>(6 * i + j)], point.tangent(i, j), 1e-10 * scale);
}

TEST(MaterialBatch, IsThePointsOneByOne) {
  const Volumetric volumetric{VolumetricEnergy::miehe, 1e6};
  for (const int width : widths())
    for (const Law& law : laws())
      for (const std::size_t count : {1u, 7u, 8u, 19u}) {
        const auto F = some_gradients(count);
        Results results(count);
        material_batch(width)(law, volumetric, &F[0](0, 0), nullptr, count, results.all());
        for (std::size_t k = 0; k < count; ++k)
          std::visit(
              [&](const auto& l) {
                expect_point(material_point(F[k], l, volumetric), results, k);
                const double psi = elastic_energy(F[k], l) + 1e6 * volumetric.unit_energy(determinant(F[k]));
                EXPECT_NEAR(results.energy[k], psi, 1e-10 * (1.0 + std::abs(psi)));
              },
              law);
      }
}

TEST(MaterialBatch, TakesPressuresInPlaceOfTheVolumetricLaw) {
  const Volumetric incompressible{VolumetricEnergy::simo_taylor, std::numeric_limits<double>::infinity()};
  const auto F = some_gradients(11);
  std::vector<double> pressure(11);
  for (std::size_t k = 0; k < 11; ++k) pressure[k] = 1e3 * static_cast<double>(k);
  for (const int width : widths())
    for (const Law& law : laws()) {
      Results results(11);
      material_batch(width)(law, incompressible, &F[0](0, 0), pressure.data(), 11, results.all());
      for (std::size_t k = 0; k < 11; ++k)
        std::visit([&](const auto& l) { expect_point(material_point_at_pressure(F[k], l, pressure[k]), results, k); },
                   law);
    }
}

TEST(MaterialBatch, LeavesAloneWhatIsNotWanted) {
  const auto F = some_gradients(9);
  Results all(9), one(9);
  const Volumetric volumetric{VolumetricEnergy::simo_taylor, 1e6};
  material_batch(2)(NeoHooke{3e4}, volumetric, &F[0](0, 0), nullptr, 9, all.all());
  material_batch(2)(NeoHooke{3e4}, volumetric, &F[0](0, 0), nullptr, 9, {.cauchy = one.cauchy.data()});
  EXPECT_EQ(one.cauchy, all.cauchy);
}

}  // namespace
}  // namespace tunica::wall
