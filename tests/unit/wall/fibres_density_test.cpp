// Orientation densities: normalisation by independent quadrature, limits, structure tensors.
#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <numbers>

#include "tunica/wall/fibres/density.hpp"

namespace tunica::wall {
namespace {

using std::numbers::pi;

/// Mean over the sphere of rho(N) g(N), by nested adaptive quadrature in elevation and azimuth about e3.
template <class G>
double mean(const Density& d, const G& g) {
  using Rule = boost::math::quadrature::gauss_kronrod<double, 31>;
  const auto row = [&](double elevation) {
    const double s = std::sin(elevation), c = std::cos(elevation);
    const auto point = [&](double phi) {
      const Vec3<double> N{{c * std::cos(phi), c * std::sin(phi), s}};
      return density(d, N) * g(N);
    };
    return c * (Rule::integrate(point, -0.5 * pi, 0.5 * pi, 6, 1e-10) +
                Rule::integrate(point, 0.5 * pi, 1.5 * pi, 6, 1e-10));
  };
  return (Rule::integrate(row, -0.5 * pi, 0.0, 6, 1e-10) + Rule::integrate(row, 0.0, 0.5 * pi, 6, 1e-10)) / (4.0 * pi);
}

const auto evenly = [](const Vec3<double>&) { return 1.0; };

TEST(FibreDensity, VonMisesHasMeanOne) {
  const Vec3<double> e3{{0.0, 0.0, 1.0}}, oblique{{0.48, 0.6, 0.64}};
  for (const double b : {0.0, 1e-9, 1e-3, 1.0, 3.0, 9.0, 19.999, 20.001, 60.0, 400.0})
    EXPECT_NEAR(mean(VonMises{b, e3}, evenly), 1.0, 1e-11) << b;
  for (const double b : {0.5, 3.0, 30.0}) EXPECT_NEAR(mean(VonMises{b, oblique}, evenly), 1.0, 1e-8) << b;
}

TEST(FibreDensity, BivariateHasMeanOne) {
  for (const double a : {0.0, 1e-9, 2.0, 49.9, 50.1, 300.0})
    for (const double b : {0.0, 1e-9, 3.0, 40.0, 500.0})
      EXPECT_NEAR(mean(BivariateVonMises{a, b, 0.6}, evenly), 1.0, 1e-9) << a << ' ' << b;
}

TEST(FibreDensity, FollowsTheExponentials) {
  const Vec3<double> M{{0.6, 0.8, 0.0}}, across{{-0.8, 0.6, 0.0}}, e3{{0.0, 0.0, 1.0}};
  const Vec3<double> raised{{0.8 * 0.6, 0.8 * 0.8, 0.6}};
  EXPECT_NEAR(density(VonMises{3.0, M}, M) / density(VonMises{3.0, M}, e3), std::exp(6.0), 1e-10 * std::exp(6.0));
  const Density d = BivariateVonMises{2.0, 5.0, std::atan2(0.8, 0.6)};
  EXPECT_NEAR(density(d, M) / density(d, across), std::exp(4.0), 1e-12 * std::exp(4.0));
  EXPECT_NEAR(density(d, M) / density(d, raised), std::exp(10.0 * 0.36), 1e-12 * std::exp(3.6));
  EXPECT_EQ(density(d, raised), density(d, -1.0 * raised));
}

TEST(FibreDensity, HasItsLimits) {
  const Vec3<double> M{{1.0, 0.0, 0.0}}, e3{{0.0, 0.0, 1.0}}, N{{0.48, 0.6, 0.64}};
  EXPECT_EQ(density(VonMises{0.0, M}, N), 1.0);
  EXPECT_EQ(density(BivariateVonMises{}, N), 1.0);
  EXPECT_NEAR(density(VonMises{1e-12, M}, N), 1.0, 1e-11);
  EXPECT_NEAR(density(BivariateVonMises{1e-12, 1e-12, 0.3}, N), 1.0, 1e-11);
  EXPECT_NEAR(density(BivariateVonMises{5.0, 2.0, 0.3}, e3), density(BivariateVonMises{0.0, 2.0, 0.3}, e3), 1e-15);
  for (const double large : {800.0, 1e5}) {
    EXPECT_NEAR(density(VonMises{large, M}, M), 4.0 * large, 3.0);  // 2 y (1 - 1/(2y)) with y = 2 b
    EXPECT_TRUE(std::isfinite(density(BivariateVonMises{large, large, 0.0}, M)));
    EXPECT_EQ(density(BivariateVonMises{large, large, 0.0}, e3), 0.0);
  }
}

TEST(FibreDensity, StructureTensors) {
  const Vec3<double> M{{0.0, 0.0, 1.0}};
  for (const double b : {0.0, 0.1, 2.49, 2.51, 3.0, 25.0}) {
    EXPECT_NEAR(kappa(VonMises{b, M}), 0.5 * (1.0 - mean(VonMises{b, M}, [](const auto& N) { return N[2] * N[2]; })),
                1e-11)
        << b;
    for (const double a : {0.0, 2.0, 60.0}) {
      const BivariateVonMises d{a, b, 0.0};
      const double kop = kappa_out_of_plane(d), kip = kappa_in_plane(d);
      const auto square = [&](int i) { return mean(d, [i](const auto& N) { return N[i] * N[i]; }); };
      EXPECT_NEAR(2.0 * kop * (1.0 - kip), square(0), 1e-9) << a << ' ' << b;
      EXPECT_NEAR(2.0 * kop * kip, square(1), 1e-9) << a << ' ' << b;
      EXPECT_NEAR(1.0 - 2.0 * kop, square(2), 1e-9) << a << ' ' << b;
    }
  }
  EXPECT_NEAR(kappa(VonMises{0.0, M}), 1.0 / 3.0, 1e-15);
  EXPECT_NEAR(kappa_out_of_plane({0.0, 0.0, 0.0}), 1.0 / 3.0, 1e-15);
  EXPECT_NEAR(kappa_out_of_plane({0.0, 1e6, 0.0}), 0.5, 1e-6);
  EXPECT_EQ(kappa_in_plane({0.0, 1.0, 0.0}), 0.5);
  EXPECT_NEAR(kappa_in_plane({1e5, 1.0, 0.0}), 0.25e-5, 1e-9);
}

}  // namespace
}  // namespace tunica::wall
