#include "tunica/fluid/boundary.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "element.hpp"

namespace tunica::fluid {
namespace {

using Triangle = Vec3<double>[3];

/// Outward faces of a positive tetrahedron, by local node.
constexpr int faces[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

TEST(Pressure, BalancesAConstantPressureInside) {
  test::RandomElement random(1);
  ElementState<double> s = random.state();
  for (int a = 0; a < 4; ++a) {
    s.pressure[a] = 1e4;
    s.velocity[a] = s.mesh_velocity[a] = s.acceleration[a] = {{0, 0, 0}};
  }
  fe::ElementVector<double> r;
  residual(s, test::step, test::blood, Newtonian{}, r);
  Vec3<double> total[4];
  for (int a = 0; a < 4; ++a) total[a] = {{r.r[a][0], r.r[a][1], r.r[a][2]}};
  for (const int(&face)[3] : faces) {
    const Triangle x = {s.position[face[0]], s.position[face[1]], s.position[face[2]]};
    TriangleVector<double> traction{};
    add_pressure(x, 1e4, traction);
    for (int a = 0; a < 3; ++a) total[face[a]] = total[face[a]] + traction.r[a];
  }
  for (int a = 0; a < 4; ++a) EXPECT_LT(norm(total[a]), 1e-12 * 1e4 * 1e-6);
}

TEST(Face, FlowThroughAClosedSurfaceIsTheIntegralOfTheDivergence) {
  test::RandomElement random(6);
  const ElementState<double> s = random.state();
  Vec3<double> relative[4];
  for (int a = 0; a < 4; ++a) relative[a] = s.velocity[a] - s.mesh_velocity[a];
  const fe::Gradients<double> shape = fe::gradients(s.position);
  double divergence = 0, out = 0, pressure = 0, total_area = 0;
  for (int a = 0; a < 4; ++a) divergence += dot(relative[a], shape.dN[a]) * shape.volume;
  for (const int(&face)[3] : faces) {
    const auto pick = [&face](const Vec3<double>(&field)[4], Triangle& result) {
      for (int a = 0; a < 3; ++a) result[a] = field[face[a]];
    };
    Triangle x, v, mesh_velocity;
    pick(s.position, x);
    pick(s.velocity, v);
    pick(s.mesh_velocity, mesh_velocity);
    out += flow(x, v, mesh_velocity);
    const double p[3] = {2.0, 3.0, 4.0};
    pressure += integrated_pressure(x, p);
    total_area += area(x);
  }
  EXPECT_NEAR(out, divergence, 1e-13 * 1e-6);
  EXPECT_NEAR(pressure / total_area, 3.0, 1e-13);
}

TEST(Backflow, CancelsTheEnergyThatFlowsInWithBetaOneHalf) {
  const Triangle x = {{{0, 0, 0}}, {{2, 0, 0}}, {{0, 1, 0}}};  // n = e3, area 1
  const Triangle inward = {{{0.3, 0.1, -2}}, {{0.3, 0.1, -2}}, {{0.3, 0.1, -2}}};
  const Triangle still = {{{0, 0, 0}}, {{0, 0, 0}}, {{0, 0, 0}}};
  const Parameters half{.density = 1000, .viscosity = Newtonian{}, .backflow = 0.5};
  TriangleVector<double> r{};
  add_backflow(x, inward, still, half, r);
  double power = 0;
  for (int a = 0; a < 3; ++a) power += dot(r.r[a], inward[a]);
  const double kinetic_inflow = 2.0 * 0.5 * 1000 * dot(inward[0], inward[0]);  // |a.n| A rho |v|^2 / 2
  EXPECT_NEAR(power, kinetic_inflow, 1e-11 * kinetic_inflow);

  // Nothing for outflow, and nothing where the face moves in faster than the flow.
  const Triangle outward = {{{1, 0, 1}}, {{0, 1, 2}}, {{0, 0, 3}}}, fast = {{{0, 0, -3}}, {{0, 0, -3}}, {{0, 0, -3}}};
  TriangleVector<double> none{};
  add_backflow(x, outward, still, half, none);
  add_backflow(x, inward, fast, half, none);
  for (int a = 0; a < 3; ++a) EXPECT_EQ(norm(none.r[a]), 0.0);
}

TEST(Backflow, NeverFeedsEnergyIntoTheFlow) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    test::RandomElement random(seed);
    Triangle x, v, mesh_velocity;
    for (int a = 0; a < 3; ++a) {
      x[a] = random.vector(1.0);
      v[a] = random.vector(1.0);
      mesh_velocity[a] = random.vector(1.0);
    }
    TriangleVector<double> r{};
    add_backflow(x, v, mesh_velocity, test::blood, r);
    double power = 0;
    for (int a = 0; a < 3; ++a) power += dot(r.r[a], v[a]);
    EXPECT_GE(power, 0.0);
  }
}

TEST(Backflow, TangentIsTheDerivativeOfTheResidual) {
  using D = Dual<double, 9>;
  const double c = 0.7;
  for (unsigned seed = 0; seed < 20; ++seed) {
    test::RandomElement random(seed);
    Triangle x, v, mesh_velocity;
    Vec3<D> x_dual[3], v_dual[3], mesh_dual[3];
    for (int a = 0; a < 3; ++a) {
      x[a] = random.vector(1.0);
      v[a] = random.vector(1.0);
      mesh_velocity[a] = random.vector(1.0);
      x_dual[a] = test::convert<D>(x[a]);
      mesh_dual[a] = test::convert<D>(mesh_velocity[a]);
      v_dual[a] = test::convert<D>(v[a]);
      for (int i = 0; i < 3; ++i) v_dual[a][i].d[3 * a + i] = c;
    }
    TriangleVector<D> expected{};
    add_backflow(x_dual, v_dual, mesh_dual, test::blood, expected);
    TriangleVector<double> r{};
    TriangleMatrix<double> k{};
    add_backflow(x, v, mesh_velocity, test::blood, r, &k, c);
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b)
        for (int i = 0; i < 3; ++i) {
          EXPECT_NEAR(r.r[a][i], expected.r[a][i].value, 1e-12);
          for (int j = 0; j < 3; ++j) EXPECT_NEAR(k.k[a][b](i, j), expected.r[a][i].d[3 * b + j], 1e-11);
        }
  }
}

TEST(Backflow, PacksAgreeLaneByLane) {
  using P = Pack<2>;
  Triangle x[2], v[2], still[2];
  Vec3<P> x_pack[3], v_pack[3], still_pack[3];
  for (int l = 0; l < 2; ++l) {
    test::RandomElement random(l);
    for (int a = 0; a < 3; ++a) {
      x[l][a] = random.vector(1.0);
      v[l][a] = random.vector(1.0);
      still[l][a] = {{0, 0, 0}};
      for (int i = 0; i < 3; ++i) {
        x_pack[a][i].set(l, x[l][a][i]);
        v_pack[a][i].set(l, v[l][a][i]);
        still_pack[a][i] = P(0.0);
      }
    }
  }
  TriangleVector<P> r_pack;
  TriangleMatrix<P> k_pack;
  for (int a = 0; a < 3; ++a) {
    r_pack.r[a] = {{P(0.0), P(0.0), P(0.0)}};
    for (int b = 0; b < 3; ++b) k_pack.k[a][b] = P(0.0) * identity<P>();
  }
  add_backflow(x_pack, v_pack, still_pack, test::blood, r_pack, &k_pack, 1.0);
  for (int l = 0; l < 2; ++l) {
    TriangleVector<double> r{};
    TriangleMatrix<double> k{};
    add_backflow(x[l], v[l], still[l], test::blood, r, &k, 1.0);
    for (int a = 0; a < 3; ++a)
      for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(r_pack.r[a][i][l], r.r[a][i], 1e-12);
        EXPECT_NEAR(k_pack.k[a][1](i, 2)[l], k.k[a][1](i, 2), 1e-12);
      }
  }
}

TEST(WallShear, OfPoiseuilleFlowPointsAgainstTheFlow) {
  // v_z = U (1 - r^2 / R^2) at the wall point (R, 0, 0): the shear stress is 2 mu U / R.
  const double U = 0.4, R = 0.01, mu = 4e-3;
  Mat3<double> gradient{};
  gradient(2, 0) = -2 * U / R;
  gradient(0, 0) = 5.0;  // a normal stress, which is no shear
  const Vec3<double> t = wall_shear_traction(gradient, mu, Vec3<double>{{1, 0, 0}});
  EXPECT_NEAR(t[0], 0.0, 1e-15);
  EXPECT_NEAR(t[2], -2 * mu * U / R, 1e-14);
}

}  // namespace
}  // namespace tunica::fluid
