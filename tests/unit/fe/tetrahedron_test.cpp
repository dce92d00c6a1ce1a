#include "tunica/fe/tetrahedron.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tunica/base/dual.hpp"

namespace tunica::fe {
namespace {

using Nodes = Vec3<double>[nodes];

void random_element(unsigned seed, Nodes& x) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> uniform(-0.2, 0.2);
  const Nodes corners = {{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}};
  for (int a = 0; a < nodes; ++a)
    for (int i = 0; i < 3; ++i) x[a][i] = corners[a][i] + uniform(engine);
}

double factorial(int n) { return n < 2 ? 1.0 : n * factorial(n - 1); }

TEST(Gradients, ReproduceLinearFieldsAndSumToZero) {
  const Vec3<double> g{{0.3, -2.0, 1.7}};
  for (unsigned seed = 0; seed < 10; ++seed) {
    Nodes x;
    random_element(seed, x);
    const Gradients<double> shape = gradients(x);
    Vec3<double> sum{{0, 0, 0}}, gradient{{0, 0, 0}};
    for (int a = 0; a < nodes; ++a) {
      sum = sum + shape.dN[a];
      gradient = gradient + (5.0 + dot(g, x[a])) * shape.dN[a];
    }
    EXPECT_LT(norm(sum), 1e-14);
    EXPECT_LT(norm(gradient - g), 1e-13);
    // N_a is 1 at node a and 0 at the others.
    for (int a = 0; a < nodes; ++a)
      for (int b = 0; b < nodes; ++b) EXPECT_NEAR(dot(shape.dN[a], x[b] - x[(a + 1) % 4]), a == b ? 1.0 : 0.0, 1e-13);
  }
}

TEST(Gradients, VolumeIsPositiveForTheOrderOfVtk) {
  const Nodes x = {{{0, 0, 0}}, {{2, 0, 0}}, {{0, 3, 0}}, {{0, 0, 4}}};
  EXPECT_DOUBLE_EQ(gradients(x).volume, 4.0);
  const Nodes swapped = {x[1], x[0], x[2], x[3]};
  EXPECT_DOUBLE_EQ(gradients(swapped).volume, -4.0);
}

TEST(Gradients, AreTheDerivativesOfTheVolume) {
  using D = Dual<double, 12>;  // d volume / d x_a = volume grad N_a
  Nodes x;
  random_element(4, x);
  Vec3<D> dual[nodes];
  for (int a = 0; a < nodes; ++a)
    for (int i = 0; i < 3; ++i) dual[a][i] = D::variable(x[a][i], 3 * a + i);
  const D volume = gradients(dual).volume;
  const Gradients<double> shape = gradients(x);
  for (int a = 0; a < nodes; ++a)
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(volume.d[3 * a + i], shape.volume * shape.dN[a][i], 1e-14);
}

TEST(Gradients, PacksAgreeLaneByLane) {
  using P = Pack<8>;
  Nodes x[8];
  Vec3<P> packed[nodes];
  for (int l = 0; l < 8; ++l) {
    random_element(l, x[l]);
    for (int a = 0; a < nodes; ++a)
      for (int i = 0; i < 3; ++i) packed[a][i].set(l, x[l][a][i]);
  }
  const Gradients<P> shape = gradients(packed);
  for (int l = 0; l < 8; ++l) {
    const Gradients<double> expected = gradients(x[l]);
    EXPECT_NEAR(shape.volume[l], expected.volume, 1e-15);
    for (int a = 0; a < nodes; ++a)
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(shape.dN[a][i][l], expected.dN[a][i], 1e-13);
  }
}

// Mean of prod_a N_a^(k_a) over a simplex of dimension d: d! prod k_a! / (d + sum k_a)!

TEST(Quadrature, FourPointsAreExactForDegreeTwoAndNoMore) {
  const auto error = [](const int(&k)[4]) {
    double sum = 0, exact = 6.0;
    int degree = 0;
    for (const QuadraturePoint& q : four_points) {
      double value = q.weight;
      for (int a = 0; a < 4; ++a) value *= std::pow(q.barycentric[a], k[a]);
      sum += value;
    }
    for (int a = 0; a < 4; ++a) {
      exact *= factorial(k[a]);
      degree += k[a];
    }
    return std::fabs(sum - exact / factorial(3 + degree));
  };
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b) {
      int k[4] = {};
      EXPECT_LT(error(k), 1e-15);
      ++k[a];
      EXPECT_LT(error(k), 1e-15);
      ++k[b];
      EXPECT_LT(error(k), 1e-15);
    }
  EXPECT_GT(error({3, 0, 0, 0}), 1e-3);
}

TEST(Quadrature, ThreePointsAreExactForDegreeTwoAndNoMore) {
  const auto error = [](const int(&k)[3]) {
    double sum = 0, exact = 2.0;
    int degree = 0;
    for (const TrianglePoint& q : three_points) {
      double value = q.weight;
      for (int a = 0; a < 3; ++a) value *= std::pow(q.barycentric[a], k[a]);
      sum += value;
    }
    for (int a = 0; a < 3; ++a) {
      exact *= factorial(k[a]);
      degree += k[a];
    }
    return std::fabs(sum - exact / factorial(2 + degree));
  };
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) {
      int k[3] = {};
      EXPECT_LT(error(k), 1e-15);
      ++k[a];
      EXPECT_LT(error(k), 1e-15);
      ++k[b];
      EXPECT_LT(error(k), 1e-15);
    }
  EXPECT_GT(error({3, 0, 0}), 1e-3);
}

TEST(Quadrature, PointsLieInsideWithBarycentricCoordinatesOfSumOne) {
  for (const QuadraturePoint& q : four_points) {
    double sum = 0;
    for (double b : q.barycentric) {
      EXPECT_GT(b, 0.0);
      sum += b;
    }
    EXPECT_DOUBLE_EQ(sum, 1.0);
  }
  for (const TrianglePoint& q : three_points) {
    double sum = 0;
    for (double b : q.barycentric) {
      EXPECT_GT(b, 0.0);
      sum += b;
    }
    EXPECT_DOUBLE_EQ(sum, 1.0);
  }
}

}  // namespace
}  // namespace tunica::fe
