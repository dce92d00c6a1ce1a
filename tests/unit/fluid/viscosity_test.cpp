#include "tunica/fluid/viscosity.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace tunica::fluid {
namespace {

template <class Law>
class EveryLaw : public testing::Test {};
using Laws = testing::Types<Newtonian, CarreauYasuda, Casson>;
TYPED_TEST_SUITE(EveryLaw, Laws);

TYPED_TEST(EveryLaw, SlopeIsTheDerivativeOfTheViscosity) {
  using D = Dual<double, 1>;
  const TypeParam law;
  for (double gamma = 1e-8; gamma < 1e5; gamma *= 3.7) {
    const double expected = law.viscosity(D::variable(gamma, 0)).d[0];
    EXPECT_NEAR(law.slope(gamma), expected, 1e-12 * std::fabs(expected)) << gamma;
  }
}

TYPED_TEST(EveryLaw, ThinsMonotonicallyAndStaysPositive) {
  const TypeParam law;
  double previous = law.viscosity(1e-10);
  for (double gamma = 1e-9; gamma < 1e6; gamma *= 2.0) {
    const double mu = law.viscosity(gamma);
    EXPECT_GT(mu, 0.0);
    EXPECT_LE(mu, previous);
    previous = mu;
  }
}

TYPED_TEST(EveryLaw, PacksAgreeWithScalars) {
  using P = Pack<4>;
  const TypeParam law;
  for (double gamma = 1e-10; gamma < 1e5; gamma *= 5.1) {
    P rates;
    for (int l = 0; l < 4; ++l) rates.set(l, gamma * (1 + l));
    const P mu = law.viscosity(rates), slope = law.slope(rates);
    for (int l = 0; l < 4; ++l) {
      EXPECT_NEAR(mu[l], law.viscosity(rates[l]), 1e-14 * mu[l]);
      EXPECT_NEAR(slope[l], law.slope(rates[l]), 1e-13 * std::fabs(slope[l]));
    }
  }
}

TEST(CarreauYasudaLaw, ReachesItsPlateausAndItsPowerLaw) {
  const CarreauYasuda law;
  EXPECT_NEAR(law.viscosity(1e-8), law.mu_zero, 1e-10);
  EXPECT_NEAR(law.viscosity(1e9), law.mu_infinity, 1e-8);
  // In between, mu - mu_inf falls as gamma^(n - 1).
  const double ratio = (law.viscosity(2e5) - law.mu_infinity) / (law.viscosity(1e5) - law.mu_infinity);
  EXPECT_NEAR(ratio, std::pow(2.0, law.n - 1.0), 1e-5);
  // a = 2 is the Carreau law in its usual form.
  const CarreauYasuda carreau{.lambda = 3.313, .a = 2.0, .n = 0.3568};
  const double expected = 3.45e-3 + (56e-3 - 3.45e-3) * std::pow(1 + std::pow(3.313 * 10.0, 2), (0.3568 - 1) / 2);
  EXPECT_NEAR(carreau.viscosity(10.0), expected, 1e-15);
}

TEST(CassonLaw, IsCassonsAwayFromRestAndFiniteAtRest) {
  const Casson law;
  const double gamma = 1e3, stress = law.viscosity(gamma) * gamma;
  EXPECT_NEAR(std::sqrt(stress), std::sqrt(law.yield_stress) + std::sqrt(law.mu_infinity * gamma), 1e-8);
  const double at_rest = std::pow(std::sqrt(law.mu_infinity) + std::sqrt(law.yield_stress / 0.1), 2);
  EXPECT_NEAR(law.viscosity(0.0), at_rest, 1e-15);
  EXPECT_EQ(law.slope(0.0), 0.0);
}

}  // namespace
}  // namespace tunica::fluid
