#include "tunica/ale/mesh_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "tunica/base/dual.hpp"
#include "tunica/config/schema.hpp"

namespace tunica::ale {
namespace {

using Nodes = Vec3<double>[4];

void random_element(unsigned seed, Nodes& x) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> uniform(-0.2, 0.2);
  const Nodes corners = {{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}};
  for (int a = 0; a < 4; ++a)
    for (int i = 0; i < 3; ++i) x[a][i] = corners[a][i] + uniform(engine);
}

/// Elastic energy of the element for Young's modulus `young`, from Hooke's law in its textbook form.
template <class T>
T energy(const Nodes& x, const Vec3<T> (&u)[4], double young, double nu) {
  const fe::Gradients<double> shape = fe::gradients(x);
  Mat3<T> strain;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      strain(i, j) = T(0.0);
      for (int a = 0; a < 4; ++a) strain(i, j) += T(0.5) * (u[a][i] * T(shape.dN[a][j]) + u[a][j] * T(shape.dN[a][i]));
    }
  const double lambda = young * nu / ((1 + nu) * (1 - 2 * nu)), mu = young / (2 * (1 + nu));
  const T volume_change = trace(strain);
  return T(shape.volume) * (T(lambda / 2) * volume_change * volume_change + T(mu) * double_dot(strain, strain));
}

TEST(Stiffness, IsTheHessianOfTheElasticEnergy) {
  using D = Dual<Dual<double, 12>, 12>;
  const double mean_volume = 0.3;
  for (double chi : {0.0, 1.0, 1.7}) {
    const Parameters parameters{.poisson_ratio = 0.3, .stiffening_exponent = chi};
    Nodes x;
    random_element(7, x);
    const double young = std::pow(mean_volume / fe::gradients(x).volume, chi);
    Vec3<D> u[4];
    for (int a = 0; a < 4; ++a)
      for (int i = 0; i < 3; ++i)
        u[a][i] = D::variable(Dual<double, 12>::variable(0.1 * a - 0.05 * i, 3 * a + i), 3 * a + i);
    const D psi = energy(x, u, young, parameters.poisson_ratio);
    StiffnessMatrix<double> k;
    stiffness(x, mean_volume, parameters, k);
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < 4; ++b)
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j) EXPECT_NEAR(k.k[a][b](i, j), psi.d[3 * a + i].d[3 * b + j], 1e-13) << chi;
  }
}

TEST(Stiffness, RigidMotionsCostNothing) {
  Nodes x;
  random_element(3, x);
  StiffnessMatrix<double> k;
  stiffness(x, 1.0, {}, k);
  const Vec3<double> omega{{0.3, -0.7, 0.2}}, shift{{1.0, 2.0, -0.5}};
  for (int a = 0; a < 4; ++a) {
    Vec3<double> force{{0, 0, 0}};
    for (int b = 0; b < 4; ++b) force = force + k.k[a][b] * (shift + cross(omega, x[b]));
    EXPECT_LT(norm(force), 1e-13);
  }
}

TEST(Stiffness, ScalesWithTheVolumeRatioAndPacksAgree) {
  Nodes x, half;
  random_element(5, x);
  for (int a = 0; a < 4; ++a) half[a] = 0.5 * x[a];
  StiffnessMatrix<double> k, k_half;
  stiffness(x, 0.2, {}, k);
  stiffness(half, 0.2, {}, k_half);
  EXPECT_NEAR(k_half.k[1][2](0, 1), 4.0 * k.k[1][2](0, 1), 1e-13);  // size^(3 - 2) from Hooke, 8 from 1/J

  using P = Pack<4>;
  Vec3<P> packed[4];
  for (int a = 0; a < 4; ++a)
    for (int i = 0; i < 3; ++i)
      for (int l = 0; l < 4; ++l) packed[a][i].set(l, l % 2 ? half[a][i] : x[a][i]);
  StiffnessMatrix<P> k_pack;
  stiffness(packed, 0.2, {}, k_pack);
  for (int l = 0; l < 4; ++l) EXPECT_NEAR(k_pack.k[3][0](2, 1)[l], (l % 2 ? k_half : k).k[3][0](2, 1), 1e-13);
}

TEST(Quality, KnownTetrahedra) {
  const Nodes regular = {{{1, 1, 1}}, {{1, -1, -1}}, {{-1, 1, -1}}, {{-1, -1, 1}}};
  EXPECT_NEAR(std::fabs(scaled_jacobian(regular)), 1.0, 1e-15);
  const Nodes corner = {{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}};  // edges 1 and sqrt 2: largest product 2
  EXPECT_NEAR(scaled_jacobian(corner), std::sqrt(2.0) / 2.0, 1e-15);
  const Nodes inverted = {{{0, 0, 0}}, {{0, 1, 0}}, {{1, 0, 0}}, {{0, 0, 1}}};
  EXPECT_NEAR(scaled_jacobian(inverted), -std::sqrt(2.0) / 2.0, 1e-15);
}

TEST(Quality, DoesNotDependOnTheOrderOfTheNodes) {
  Nodes x;
  random_element(11, x);
  int order[4] = {0, 1, 2, 3};
  const double expected = std::fabs(scaled_jacobian(x));
  do {
    const Nodes y = {x[order[0]], x[order[1]], x[order[2]], x[order[3]]};
    EXPECT_NEAR(std::fabs(scaled_jacobian(y)), expected, 1e-14);
  } while (std::next_permutation(order, order + 4));
}

TEST(Quality, GuardNamesFlatInvertedAndLostElements) {
  const Nodes initial = {{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}};
  Nodes moved = {initial[0], initial[1], initial[2], initial[3]};
  EXPECT_NEAR(relative_quality(initial, moved), 1.0, 1e-15);
  const Parameters parameters{.minimum_quality = 0.1};
  EXPECT_FALSE(is_degenerate(relative_quality(initial, moved), parameters));
  moved[3][2] = 0.05;
  EXPECT_TRUE(is_degenerate(relative_quality(initial, moved), parameters));
  EXPECT_FALSE(is_degenerate(relative_quality(initial, moved), Parameters{.minimum_quality = 0.01}));
  moved[3][2] = -0.5;
  EXPECT_TRUE(is_degenerate(relative_quality(initial, moved), parameters));
  EXPECT_TRUE(is_degenerate(std::numeric_limits<double>::quiet_NaN(), parameters));

  Pack<2> quality;
  quality.set(0, 0.5);
  quality.set(1, std::numeric_limits<double>::quiet_NaN());
  const auto mask = is_degenerate(quality, parameters);
  EXPECT_FALSE(mask[0]);
  EXPECT_TRUE(mask[1]);
}

TEST(Schema, HasNoSlipsAndRefusesWhatMakesNoSense) {
  EXPECT_TRUE(config::audit(*Parameters::schema().description()).empty());
  const Parameters defaults = config::parse_text(Parameters::schema(), "{}").value;
  EXPECT_EQ(defaults.poisson_ratio, 0.3);
  EXPECT_EQ(defaults.stiffening_exponent, 1.0);
  EXPECT_THROW(config::parse_text(Parameters::schema(), "poisson_ratio: 0.5\n"), InputError);
}

}  // namespace
}  // namespace tunica::ale
