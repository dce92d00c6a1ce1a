// The orthotropic law of heart muscle against its published form.
#include "tunica/wall/materials/holzapfel_ogden.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace tunica::wall {
namespace {

/// Fitted to shear tests of Dokos et al. (2002): Holzapfel & Ogden (2009), table 1.
HolzapfelOgdenParameters published() {
  HolzapfelOgdenParameters p;
  p.a = 59, p.b = 8.023;
  p.a_f = 18472, p.b_f = 16.026;
  p.a_s = 2481, p.b_s = 11.120;
  p.a_fs = 216, p.b_fs = 11.436;
  p.compressibility.poisson_ratio = 0.5;
  return p;
}

/// Cauchy stress of the plane of a simple shear: the axis `along` moves towards `towards` by `amount`.
double shear_stress(const HolzapfelOgden& law, int along, int towards, double amount) {
  Mat3<double> F = identity<double>();
  F(towards, along) = amount;
  const Symmetric<double> C = right_cauchy_green(F);
  Symmetric<double> S = stress(law, C);
  if (law.unsplit) {
    const auto fibres = law.unsplit_stress(C);
    for (int n = 0; n < voigt_size; ++n) S[n] += fibres[n];
  }
  double sigma = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) sigma += F(along, i) * S[voigt_index[i][j]] * F(towards, j);
  return sigma;
}

// Holzapfel & Ogden (2009), section 5: the six modes of simple shear, in closed form.
TEST(WallHolzapfelOgden, SimpleShearInTheSixModes) {
  auto p = published();
  const double g = 0.5, g3 = g * g * g;
  const double matrix = p.a * g * std::exp(p.b * g * g), fibres = 2 * p.a_f * g3 * std::exp(p.b_f * g3 * g),
               sheets = 2 * p.a_s * g3 * std::exp(p.b_s * g3 * g), between = p.a_fs * g * std::exp(p.b_fs * g * g);
  const double expected[3][3] = {{0, matrix + fibres + between, matrix + fibres},
                                 {matrix + sheets + between, 0, matrix + sheets},
                                 {matrix, matrix, 0}};
  for (const bool unsplit : {false, true})
    for (int along = 0; along < 3; ++along)
      for (int towards = 0; towards < 3; ++towards) {
        if (along == towards) continue;
        p.options.unsplit = unsplit;
        EXPECT_NEAR(shear_stress(p.law(), along, towards, g), expected[along][towards], 1e-9 * fibres);
      }
}

TEST(WallHolzapfelOgden, FibresPullOnlyUnlessAskedOtherwise) {
  auto p = published();
  const Symmetric<double> shorter{{0.8, 1.2, 1.0, 0.0, 0.0, 0.0}};
  const double matrix = p.a * 1.0;
  EXPECT_NEAR(p.law().stress(shorter)[0], matrix, 1e-12);
  p.options.tension_only = false;
  EXPECT_NEAR(p.law().stress(shorter)[0], matrix - 2 * p.a_f * 0.2 * std::exp(p.b_f * 0.04), 1e-9 * p.a_f);
}

}  // namespace
}  // namespace tunica::wall
