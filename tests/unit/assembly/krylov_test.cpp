#include "tunica/assembly/krylov.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tunica/parallel/agree.hpp"

namespace tunica::assembly {
namespace {

constexpr int owned = 25;

// diag(d) + left right^T over all ranks.
struct Operator {
  std::vector<double> diagonal, left, right;

  explicit Operator(bool symmetric) {
    const int first = owned * parallel::rank(MPI_COMM_WORLD);
    for (int i = 0; i < owned; ++i) {
      diagonal.push_back(1.0 + 0.37 * ((first + i) % 31));
      left.push_back(std::sin(1.0 + first + i));
      right.push_back(symmetric ? left.back() : std::cos(2.0 * (first + i)));
    }
  }
  void operator()(const double* in, double* out) const {
    double sum = 0;
    for (int i = 0; i < owned; ++i) sum += right[i] * in[i];
    sum = parallel::global_sum(MPI_COMM_WORLD, sum);
    for (int i = 0; i < owned; ++i) out[i] = diagonal[i] * in[i] + left[i] * sum;
  }
};

std::vector<double> exact_solution() {
  std::vector<double> x(owned);
  for (int i = 0; i < owned; ++i) x[i] = std::cos(0.7 * (i + owned * parallel::rank(MPI_COMM_WORLD))) + 0.2;
  return x;
}

double global_norm(const std::vector<double>& x) {
  double sum = 0;
  for (const double value : x) sum += value * value;
  return std::sqrt(parallel::global_sum(MPI_COMM_WORLD, sum));
}

// Scales badly on purpose, so that the norms before and after preconditioning differ.
void precondition(const double* r, double* z) {
  for (int i = 0; i < owned; ++i) z[i] = r[i] * (i % 2 == 0 ? 100.0 : 20.0);
}

class KrylovMethods : public testing::TestWithParam<KrylovSettings::Method> {
 protected:
  Operator matrix{GetParam() == KrylovSettings::Method::conjugate_gradients};
  std::vector<double> exact = exact_solution(), b = std::vector<double>(owned), x = std::vector<double>(owned, 5.0);

  void SetUp() override { matrix(exact.data(), b.data()); }
  Krylov solver(double tolerance, int max_iterations = 200) {
    return Krylov(MPI_COMM_WORLD, owned,
                  {.method = GetParam(), .tolerance = tolerance, .max_iterations = max_iterations, .restart = 200},
                  matrix, &precondition);
  }
  double true_residual() {
    std::vector<double> r(owned);
    matrix(x.data(), r.data());
    for (int i = 0; i < owned; ++i) r[i] = b[i] - r[i];
    return global_norm(r);
  }
};

TEST_P(KrylovMethods, FindTheSolutionFromAnyContentOfX) {
  const auto result = solver(1e-12).solve(b, x);
  EXPECT_TRUE(result.converged);
  EXPECT_GT(result.iterations, 3);
  EXPECT_LE(result.residual, 1e-12);
  for (int i = 0; i < owned; ++i) EXPECT_NEAR(x[i], exact[i], 1e-9);
}

TEST_P(KrylovMethods, TestTheTrueResidual) {
  const double tolerance = 1e-3;
  const auto result = solver(tolerance).solve(b, x);
  EXPECT_TRUE(result.converged);
  const double truth = true_residual() / global_norm(b);
  EXPECT_LE(truth, tolerance * (1 + 1e-10));
  EXPECT_NEAR(result.residual, truth, 1e-10);
  EXPECT_GT(truth, 1e-3 * tolerance) << "stopped later than asked";
}

TEST_P(KrylovMethods, StopAtTheAbsoluteTolerance) {
  const double size = global_norm(b);
  auto krylov = solver(1e-12);
  const auto early = krylov.solve(b, x, 0.05 * size);
  EXPECT_TRUE(early.converged);
  EXPECT_LE(true_residual(), 0.05 * size * (1 + 1e-10));
  EXPECT_GT(true_residual(), 1e-6 * size);
  const auto at_once = krylov.solve(b, x, 1.01 * size);
  EXPECT_TRUE(at_once.converged);
  EXPECT_EQ(at_once.iterations, 0);
  EXPECT_EQ(at_once.residual, 1.0);
  EXPECT_EQ(x, std::vector<double>(owned, 0.0));
}

TEST_P(KrylovMethods, ZeroRightHandSideGivesZero) {
  const std::vector<double> zero(owned, 0.0);
  const auto result = solver(1e-6).solve(zero, x);
  EXPECT_TRUE(result.converged);
  EXPECT_EQ(result.residual, 0.0);
  EXPECT_EQ(x, zero);
}

TEST_P(KrylovMethods, ReportThatTheyDidNotConverge) {
  const auto result = solver(1e-12, 2).solve(b, x);
  EXPECT_FALSE(result.converged);
  EXPECT_EQ(result.iterations, 2);
  EXPECT_NEAR(result.residual, true_residual() / global_norm(b), 1e-10);
}

TEST_P(KrylovMethods, RefuseARightHandSideThatIsNotFinite) {
  if (parallel::rank(MPI_COMM_WORLD) == 0) b[3] = NAN;
  const auto result = solver(1e-6).solve(b, x);
  EXPECT_FALSE(result.converged);
  EXPECT_EQ(x, std::vector<double>(owned, 0.0));
}

INSTANTIATE_TEST_SUITE_P(Methods, KrylovMethods,
                         testing::Values(KrylovSettings::Method::gmres, KrylovSettings::Method::conjugate_gradients),
                         [](const auto& method) {
                           return method.param == KrylovSettings::Method::gmres ? "Gmres" : "ConjugateGradients";
                         });

}  // namespace
}  // namespace tunica::assembly
