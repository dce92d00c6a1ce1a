#include "tunica/fluid/rbvms_tangent.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "element.hpp"

namespace tunica::fluid {
namespace {

using InUnknowns = Dual<double, 16>;  // derivatives with respect to the 16 unknowns of an element

/// The state as a function of the unknowns: velocity = ... + c x, acceleration = ... + m x, pressure = x.
ElementState<InUnknowns> with_derivatives(const ElementState<double>& state, const TimeCoefficients& time) {
  ElementState<InUnknowns> s = test::convert<InUnknowns>(state);
  for (int b = 0; b < 4; ++b) {
    for (int j = 0; j < 3; ++j) {
      s.velocity[b][j].d[4 * b + j] = time.velocity;
      s.acceleration[b][j].d[4 * b + j] = time.acceleration;
    }
    s.pressure[b].d[4 * b + 3] = 1.0;
  }
  return s;
}

/// Largest difference between the tangent and the derivative of the residual, relative within each kind of block
/// (velocity-velocity, velocity-pressure, pressure-velocity, pressure-pressure).
template <class Law>
double tangent_error(const ElementState<double>& state, const TimeCoefficients& time, const Parameters& parameters,
                     const Law& law) {
  const Tau<double> tau = stabilisation(evaluate(state, law), time.dt, parameters);
  fe::ElementVector<InUnknowns> expected;
  residual_with(evaluate(with_derivatives(state, time), law), test::frozen<InUnknowns>(tau), parameters.density,
                expected);
  fe::ElementVector<double> r;
  fe::ElementMatrix<double> k;
  tangent(state, time, parameters, law, r, k);
  double difference[2][2] = {}, size[2][2] = {};
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b)
      for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) {
          const double d = expected.r[a][i].d[4 * b + j];
          double& worst = difference[i / 3][j / 3];
          worst = std::max(worst, std::fabs(k.k[a][b][i][j] - d));
          size[i / 3][j / 3] = std::max(size[i / 3][j / 3], std::fabs(d));
        }
  double error = 0.0;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) error = std::max(error, difference[i][j] / size[i][j]);
  return error;
}

template <class Law>
class TangentOfLaw : public testing::Test {};
using Laws = testing::Types<Newtonian, CarreauYasuda, Casson>;
TYPED_TEST_SUITE(TangentOfLaw, Laws);

TYPED_TEST(TangentOfLaw, IsTheDerivativeOfTheResidualAtFrozenTau) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    test::RandomElement random(seed);
    const ElementState<double> state = random.state();
    EXPECT_LT(tangent_error(state, test::step, test::blood, TypeParam{}), 1e-11) << "seed " << seed;
  }
}

TYPED_TEST(TangentOfLaw, HoldsForUnitSizedStatesWhereAllTermsCompare) {
  Parameters parameters{.density = 1.0, .viscosity = TypeParam{}};
  for (unsigned seed = 0; seed < 20; ++seed) {
    test::RandomElement random(seed);
    ElementState<double> state = random.state();
    for (int a = 0; a < 4; ++a) {
      state.position[a] = 1e3 * state.position[a];
      state.velocity[a] = 2.0 * state.velocity[a];
      state.acceleration[a] = 0.1 * state.acceleration[a];
      state.pressure[a] = random(1.0);
    }
    const TimeCoefficients time{.dt = 1.0, .acceleration = 1.3, .velocity = 0.7};
    EXPECT_LT(tangent_error(state, time, parameters, TypeParam{}), 1e-11) << "seed " << seed;
  }
}

TEST(Tangent, ReturnsTheSameResidual) {
  test::RandomElement random(3);
  const ElementState<double> state = random.state();
  fe::ElementVector<double> r, r_only;
  fe::ElementMatrix<double> k;
  tangent(state, test::step, test::blood, Newtonian{}, r, k);
  residual(state, test::step, test::blood, Newtonian{}, r_only);
  for (int a = 0; a < 4; ++a)
    for (int i = 0; i < 4; ++i) EXPECT_DOUBLE_EQ(r.r[a][i], r_only.r[a][i]);
}

}  // namespace
}  // namespace tunica::fluid
