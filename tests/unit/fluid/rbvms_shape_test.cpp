#include "tunica/fluid/rbvms_shape.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "element.hpp"

namespace tunica::fluid {
namespace {

using D = Dual<double, 16>;  // derivatives with respect to the velocities of nodes that the wall takes along

constexpr MotionCoefficients motion{.position = 0.6, .mesh_velocity = 0.8};

/// The state as a function of v_{n+1}, position and mesh velocity of the nodes with moves = 1 included.
ElementState<D> with_derivatives(const ElementState<double>& state, const TimeCoefficients& time,
                                 const double (&moves)[4]) {
  ElementState<D> s = test::convert<D>(state);
  for (int b = 0; b < 4; ++b)
    for (int j = 0; j < 3; ++j) {
      s.velocity[b][j].d[4 * b + j] = time.velocity;
      s.acceleration[b][j].d[4 * b + j] = time.acceleration;
      s.position[b][j].d[4 * b + j] = moves[b] * motion.position;
      s.mesh_velocity[b][j].d[4 * b + j] = moves[b] * motion.mesh_velocity;
    }
  return s;
}

template <class Law>
class ShapeOfLaw : public testing::Test {};
using Laws = testing::Types<Newtonian, CarreauYasuda, Casson>;
TYPED_TEST_SUITE(ShapeOfLaw, Laws);

// Units in which all terms of an element compare.
TYPED_TEST(ShapeOfLaw, CompletesTheDerivativeOfTheResidualAtFrozenTau) {
  const Parameters parameters{.density = 1.0, .viscosity = TypeParam{}};
  const TimeCoefficients time{.dt = 1.0, .acceleration = 1.3, .velocity = 0.7};
  for (unsigned seed = 0; seed < 20; ++seed) {
    test::RandomElement random(seed);
    ElementState<double> state = random.state();
    for (int a = 0; a < 4; ++a) {
      state.position[a] = 1e3 * state.position[a];
      state.acceleration[a] = 0.1 * state.acceleration[a];
      state.pressure[a] = random(1.0);
    }
    const double moves[4] = {1.0, seed % 2 ? 1.0 : 0.0, 0.0, seed % 3 ? 1.0 : 0.0};
    const TypeParam law{};
    const Tau<double> tau = stabilisation(evaluate(state, law), time.dt, parameters);
    fe::ElementVector<D> expected;
    residual_with(evaluate(with_derivatives(state, time, moves), law), test::frozen<D>(tau), parameters.density,
                  expected);
    fe::ElementVector<double> r;
    fe::ElementMatrix<double> k;
    tangent_beside_wall(state, time, parameters, law, motion, moves, r, k);
    double difference[2] = {}, size[2] = {};
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < 4; ++b)
        for (int i = 0; i < 4; ++i)
          for (int j = 0; j < 3; ++j) {
            const double d = expected.r[a][i].d[4 * b + j];
            difference[i / 3] = std::max(difference[i / 3], std::fabs(k.k[a][b][i][j] - d));
            size[i / 3] = std::max(size[i / 3], std::fabs(d));
          }
    EXPECT_LT(difference[0] / size[0], 1e-12) << "seed " << seed;
    EXPECT_LT(difference[1] / size[1], 1e-12) << "seed " << seed;
  }
}

}  // namespace
}  // namespace tunica::fluid
