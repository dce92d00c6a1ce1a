#include "tunica/fluid/taylor_hood.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "element.hpp"

namespace tunica::fluid::taylor_hood {
namespace {

constexpr TimeCoefficients step{.acceleration = 1250.0, .velocity = 0.8, .speed = 1.0};

template <class T>
ElementState<T> convert(const ElementState<double>& s) {
  ElementState<T> r;
  for (int a = 0; a < 4; ++a) {
    r.position[a] = test::convert<T>(s.position[a]);
    r.mesh_velocity[a] = test::convert<T>(s.mesh_velocity[a]);
    r.pressure[a] = T(s.pressure[a]);
  }
  for (int a = 0; a < nodes; ++a) {
    r.velocity[a] = test::convert<T>(s.velocity[a]);
    r.acceleration[a] = test::convert<T>(s.acceleration[a]);
    r.stream[a] = test::convert<T>(s.stream[a]);
    r.rate_squared[a] = T(s.rate_squared[a]);
    r.convection[a] = test::convert<T>(s.convection[a]);
  }
  return r;
}

ElementState<double> random_state(unsigned seed) {
  test::RandomElement random(seed);
  const auto linear = random.state();
  ElementState<double> s;
  for (int a = 0; a < 4; ++a) {
    s.position[a] = linear.position[a];
    s.mesh_velocity[a] = linear.mesh_velocity[a];
    s.pressure[a] = linear.pressure[a];
  }
  for (int a = 0; a < nodes; ++a) {
    s.velocity[a] = random.vector(0.5);
    s.acceleration[a] = random.vector(10.0);
    s.stream[a] = random.vector(0.5);
    s.rate_squared[a] = 100.0;
    s.convection[a] = random.vector(50.0);
  }
  return s;
}

using D = Dual<double, 34>;

/// The residual with tau_M and tau_C of the state without derivatives: they are held fixed where corners move.
template <class Law>
void residual_at_fixed_tau(const ElementState<D>& s, const ElementState<double>& state, const Law& law,
                           ElementVector<D>& r) {
  set_zero(r);
  const Flow<D> f = evaluate(s, step, test::blood, law);
  PointFlows<D> flows;
  at_points(s, f, test::blood, law, flows);
  PointFlows<double> fixed;
  at_points(state, evaluate(state, step, test::blood, law), test::blood, law, fixed);
  flows.tau_m = D(fixed.tau_m);
  flows.tau_c = D(fixed.tau_c);
  for (int q = 0; q < points; ++q) add_residual(flows, q, test::blood.density, r);
}

/// Largest difference between the tangent and the derivative of the residual, relative within each kind of block.
template <class Law>
double tangent_error(const ElementState<double>& state, const Law& law, const double (&moves)[4] = {0, 0, 0, 0}) {
  constexpr MotionCoefficients motion{.position = 2e-4, .mesh_velocity = 0.8};
  ElementState<D> s = convert<D>(state);
  for (int b = 0; b < 4; ++b)
    for (int j = 0; j < 3; ++j) {
      s.position[b][j].d[3 * b + j] = motion.position * moves[b];
      s.mesh_velocity[b][j].d[3 * b + j] = motion.mesh_velocity * moves[b];
    }
  for (int b = 0; b < nodes; ++b)
    for (int j = 0; j < 3; ++j) {
      s.velocity[b][j].d[3 * b + j] = step.velocity;
      s.acceleration[b][j].d[3 * b + j] = step.acceleration;
    }
  for (int b = 0; b < 4; ++b) s.pressure[b].d[30 + b] = 1.0;
  ElementVector<D> expected;
  residual_at_fixed_tau(s, state, law, expected);
  ElementVector<double> r, r_alone;
  residual(state, step, test::blood, law, r_alone);
  double difference[3] = {}, size[3] = {};
  const auto compare = [&](int kind, double value, double derivative) {
    difference[kind] = std::max(difference[kind], std::fabs(value - derivative));
    size[kind] = std::max(size[kind], std::fabs(derivative));
  };
  tangent(state, step, test::blood, law, motion, &moves, r, [&](int a, const TangentRow<double>& row) {
    for (int i = 0; i < 3; ++i) {
      for (int b = 0; b < nodes; ++b)
        for (int j = 0; j < 3; ++j) compare(0, row.velocity[b](i, j), expected.momentum[a][i].d[3 * b + j]);
      for (int b = 0; b < 4; ++b) compare(1, row.pressure[b][i], expected.momentum[a][i].d[30 + b]);
    }
    for (int b = 0; b < nodes && a < 4; ++b)
      for (int j = 0; j < 3; ++j) compare(2, row.continuity[b][j], expected.continuity[a].d[3 * b + j]);
  });
  for (int a = 0; a < nodes; ++a)
    for (int i = 0; i < 3; ++i) EXPECT_DOUBLE_EQ(r.momentum[a][i], r_alone.momentum[a][i]);
  double error = 0;
  for (int k = 0; k < 3; ++k) error = std::max(error, difference[k] / size[k]);
  return error;
}

TEST(TaylorHood, TheTangentIsTheDerivativeOfTheResidual) {
  for (unsigned seed = 1; seed < 6; ++seed) EXPECT_LT(tangent_error(random_state(seed), Newtonian{}), 1e-12);
}

TEST(TaylorHood, TheTangentKnowsTheCornersThatFollowTheWall) {
  for (unsigned seed = 1; seed < 6; ++seed) {
    EXPECT_LT(tangent_error(random_state(seed), Newtonian{}, {1, 0, 1, 0}), 1e-12);
    EXPECT_LT(tangent_error(random_state(seed), Newtonian{}, {0, 1, 1, 1}), 1e-12);
  }
}

// Held fixed is the viscosity inside tau_M only.
TEST(TaylorHood, WithAVaryingViscosityTheTangentIsNearlyTheDerivative) {
  EXPECT_LT(tangent_error(random_state(1), CarreauYasuda{}), 1e-3);
  EXPECT_LT(tangent_error(random_state(1), Casson{}), 2e-3);
}

/// A state whose velocity is a polynomial of degree 2, with the pressure that balances its viscous force.
ElementState<double> of_field(const ElementState<double>& shape, const auto& velocity, const auto& pressure) {
  ElementState<double> s = shape;
  for (int a = 0; a < nodes; ++a) {
    const auto &x = shape.position[fe::gradient_of[a][0]], &y = shape.position[fe::gradient_of[a][1]];
    s.velocity[a] = velocity(0.5 * (x + y));
    s.acceleration[a] = {};
    s.stream[a] = s.velocity[a];
    s.convection[a] = {};  // that of a parallel flow
  }
  for (int a = 0; a < 4; ++a) {
    s.mesh_velocity[a] = {};
    s.pressure[a] = pressure(shape.position[a]);
  }
  return s;
}

// v = (C y^2, 0, 0), p = 2 mu C x solves the Navier-Stokes equations: r_M vanishes, and nothing is lost but by
// viscosity.
TEST(TaylorHood, ParallelShearFlowHasNoNumericalLoss) {
  const double c = 1e5, mu = 4e-3;
  const Parameters parameters{.density = 1060.0, .viscosity = Newtonian{.mu = mu}};
  const auto s = of_field(
      random_state(3),
      [&](const Vec3<double>& x) {
        return Vec3<double>{{c * x[1] * x[1], 0, 0}};
      },
      [&](const Vec3<double>& x) { return 2 * mu * c * x[0]; });
  const auto f = evaluate(s, step, parameters, Newtonian{.mu = mu});
  PointFlows<double> flows;
  at_points(s, f, parameters, Newtonian{.mu = mu}, flows);
  for (const auto& p : flows.at) EXPECT_NEAR(p.divergence, 0, 1e-9);
  const auto e = energy(s, step, parameters, Newtonian{.mu = mu});
  EXPECT_GT(e.viscous, 0);
  EXPECT_LT(std::fabs(e.numerical), 1e-12 * e.viscous);
}

TEST(TaylorHood, AUniformFlowOnAMeshThatMovesAlongHasNoForces) {
  auto s = random_state(4);
  for (auto& v : s.velocity) v = {{0.3, -0.2, 0.1}};
  for (auto& v : s.acceleration) v = {};
  for (auto& v : s.convection) v = {};
  for (auto& p : s.pressure) p = 0;
  ElementVector<double> r;
  residual(s, step, test::blood, Newtonian{}, r);
  for (const auto& m : r.momentum) EXPECT_LT(norm(m), 1e-18);
  for (const auto& c : r.continuity) EXPECT_LT(std::fabs(c), 1e-20);
}

// v = A x, b = B x: b.grad v = A B x is linear, so that the mesh resolves it, and with the pressure that balances it
// nothing holds the flow back.
TEST(TaylorHood, ResolvedConvectionIsNotStabilised) {
  auto s = random_state(5);
  Mat3<double> a{}, b{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) a(i, j) = 10.0 * std::sin(3 * i + j + 1.0), b(i, j) = 20.0 * std::cos(i + 2 * j + 1.0);
  for (int k = 0; k < nodes; ++k) {
    const auto &x = s.position[fe::gradient_of[k][0]], &y = s.position[fe::gradient_of[k][1]];
    const Vec3<double> middle = 0.5 * (x + y);
    s.velocity[k] = a * middle;
    s.stream[k] = b * middle;
    s.convection[k] = a * (b * middle);
  }
  const Newtonian law;
  PointFlows<double> flows;
  at_points(s, evaluate(s, step, test::blood, law), test::blood, law, flows);
  for (const auto& p : flows.at) EXPECT_LT(norm(p.subscale), 1e-12 * norm(p.along));
}

TEST(TaylorHood, TheRuleIntegratesDegreeFive) {
  // l0^i l1^j l2^k l3^m has the mean i! j! k! m! 3! / (i+j+k+m+3)! (Holand & Bell 1969).
  const auto factorial = [](int n) { return std::tgamma(n + 1.0); };
  for (int i = 0; i <= 5; ++i)
    for (int j = 0; i + j <= 5; ++j)
      for (int k = 0; i + j + k <= 5; ++k) {
        double sum = 0;
        for (const auto& p : fe::quadratic_fourteen_points)
          sum +=
              p.weight * std::pow(p.barycentric[0], i) * std::pow(p.barycentric[1], j) * std::pow(p.barycentric[2], k);
        EXPECT_NEAR(sum, factorial(i) * factorial(j) * factorial(k) * 6 / factorial(i + j + k + 3), 1e-15);
      }
}

}  // namespace
}  // namespace tunica::fluid::taylor_hood
