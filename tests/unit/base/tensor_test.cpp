#include "tunica/base/tensor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tunica/base/dual.hpp"

namespace tunica {
namespace {

class Tensors : public testing::Test {
 protected:
  Mat3<double> matrix() {
    Mat3<double> m;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) m(i, j) = uniform_(engine_);
    return m;
  }
  Vec3<double> vector() { return {{uniform_(engine_), uniform_(engine_), uniform_(engine_)}}; }

 private:
  std::mt19937 engine_{17};
  std::uniform_real_distribution<double> uniform_{-1.0, 1.0};
};

void expect_equal(const Mat3<double>& a, const Mat3<double>& b, double tolerance) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(a(i, j), b(i, j), tolerance) << i << j;
}

TEST_F(Tensors, VectorAlgebra) {
  const Vec3<double> a{{1, 2, 3}}, b{{-2, 0.5, 4}};
  EXPECT_EQ((a + b)[2], 7.0);
  EXPECT_EQ((a - b)[0], 3.0);
  EXPECT_EQ((2.0 * a)[1], 4.0);
  EXPECT_EQ(dot(a, b), 11.0);
  EXPECT_DOUBLE_EQ(norm(b), std::sqrt(20.25));
  const Vec3<double> c = cross(a, b);
  EXPECT_EQ(c[0], 2 * 4 - 3 * 0.5);
  EXPECT_EQ(c[1], 3 * -2 - 1 * 4.0);
  EXPECT_EQ(c[2], 1 * 0.5 - 2 * -2.0);
}

TEST_F(Tensors, ProductsAreRowByColumn) {
  const Mat3<double> a = matrix(), b = matrix(), c = a * b;
  const Vec3<double> v = vector(), w = a * v;
  for (int i = 0; i < 3; ++i) {
    double sum = 0;
    for (int j = 0; j < 3; ++j) {
      sum += a(i, j) * v[j];
      double entry = 0;
      for (int k = 0; k < 3; ++k) entry += a(i, k) * b(k, j);
      EXPECT_NEAR(c(i, j), entry, 1e-15);
      EXPECT_EQ(transpose(a)(i, j), a(j, i));
      EXPECT_EQ((a + b)(i, j), a(i, j) + b(i, j));
      EXPECT_EQ((3.0 * a)(i, j), 3.0 * a(i, j));
    }
    EXPECT_NEAR(w[i], sum, 1e-15);
  }
  EXPECT_NEAR(double_dot(a, b), trace(transpose(a) * b), 1e-15);
  EXPECT_EQ(a.m[1][2], a(1, 2));
  expect_equal(identity<double>() * a, a, 0.0);
}

TEST_F(Tensors, InverseAndDeterminant) {
  for (int i = 0; i < 20; ++i) {
    const Mat3<double> a = matrix(), b = matrix();
    expect_equal(a * inverse(a), identity<double>(), 1e-12 / std::fabs(determinant(a)));
    expect_equal(a * adjugate(a), determinant(a) * identity<double>(), 1e-14);
    EXPECT_NEAR(determinant(a * b), determinant(a) * determinant(b), 1e-14);
    EXPECT_NEAR(determinant(transpose(a)), determinant(a), 1e-15);
  }
  Mat3<double> permutation{};
  permutation(0, 1) = permutation(1, 0) = permutation(2, 2) = 1.0;
  EXPECT_EQ(determinant(permutation), -1.0);
}

TEST_F(Tensors, DerivativeOfTheDeterminantIsTheCofactor) {
  using D = Dual<double, 9>;
  const Mat3<double> a = matrix();
  Mat3<D> dual;
  for (int k = 0; k < 9; ++k) dual(k / 3, k % 3) = D::variable(a(k / 3, k % 3), k);
  const D det = determinant(dual);
  for (int k = 0; k < 9; ++k) EXPECT_NEAR(det.d[k], adjugate(a)(k % 3, k / 3), 1e-15);
}

TEST_F(Tensors, PacksAgreeLaneByLane) {
  using P = Pack<4>;
  const Mat3<double> lanes_of[4] = {matrix(), matrix(), matrix(), matrix()};
  Mat3<P> a;
  for (int k = 0; k < 9; ++k)
    for (int l = 0; l < 4; ++l) a(k / 3, k % 3).set(l, lanes_of[l](k / 3, k % 3));
  const Mat3<P> inv = inverse(a);
  for (int l = 0; l < 4; ++l) {
    const Mat3<double> expected = inverse(lanes_of[l]);
    for (int k = 0; k < 9; ++k)
      EXPECT_NEAR(inv(k / 3, k % 3)[l], expected(k / 3, k % 3), 1e-13 / std::fabs(determinant(lanes_of[l])));
  }
}

}  // namespace
}  // namespace tunica
