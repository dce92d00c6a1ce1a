#include "tunica/fluid/rbvms.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "element.hpp"
#include "tunica/fluid/energy.hpp"

namespace tunica::fluid {
namespace {

/// Eq (2.4) written out: every point, every test function w = N_a e_i, full tensors, nothing summed in advance.
fe::ElementVector<double> textbook_residual(const ElementState<double>& s, const Tau<double>& tau, double rho,
                                            double mu) {
  const fe::Gradients<double> shape = fe::gradients(s.position);
  fe::ElementVector<double> r{};
  for (int q = 0; q < 4; ++q) {
    const double* N = fe::four_points[q].barycentric;
    const double w = fe::four_points[q].weight * shape.volume;
    double v[3] = {}, a[3] = {}, dv[3][3] = {}, rate[3] = {}, dp[3] = {}, p = 0;
    for (int b = 0; b < 4; ++b) {
      p += N[b] * s.pressure[b];
      for (int i = 0; i < 3; ++i) {
        v[i] += N[b] * s.velocity[b][i];
        a[i] += N[b] * (s.velocity[b][i] - s.mesh_velocity[b][i]);
        rate[i] += N[b] * s.acceleration[b][i];
        dp[i] += shape.dN[b][i] * s.pressure[b];
        for (int j = 0; j < 3; ++j) dv[i][j] += s.velocity[b][i] * shape.dN[b][j];
      }
    }
    const double div = dv[0][0] + dv[1][1] + dv[2][2], p_prime = -tau.c[q] * div;
    double u[3], A[3], u_dv[3] = {}, A_dv[3] = {};  // u = v'
    for (int i = 0; i < 3; ++i) {
      double a_dv = 0;
      for (int j = 0; j < 3; ++j) a_dv += a[j] * dv[i][j];
      u[i] = -tau.m[q] * (rho * (rate[i] + a_dv) + dp[i]);
      A[i] = a[i] + u[i];
    }
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        u_dv[i] += u[j] * dv[i][j];
        A_dv[i] += A[j] * dv[i][j];
      }
    for (int n = 0; n < 4; ++n) {
      for (int i = 0; i < 3; ++i) {
        r.r[n][i] += w * N[n] * rho * (rate[i] + A_dv[i]);
        for (int j = 0; j < 3; ++j) {
          const double stress =
              mu * (dv[i][j] + dv[j][i]) - rho * u[i] * A[j] + tau.b[q] * u_dv[i] * u[j] - (i == j ? p + p_prime : 0.0);
          r.r[n][i] += w * shape.dN[n][j] * stress;
        }
        r.r[n][3] -= w * shape.dN[n][i] * u[i];
      }
      r.r[n][3] += w * N[n] * div;
    }
  }
  return r;
}

double largest(const fe::ElementVector<double>& r, int first, int last) {
  double size = 0;
  for (int a = 0; a < 4; ++a)
    for (int i = first; i <= last; ++i) size = std::max(size, std::fabs(r.r[a][i]));
  return size;
}

TEST(Residual, EqualsTheEquationWrittenOut) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    test::RandomElement random(seed);
    const ElementState<double> state = random.state();
    const CarreauYasuda law;
    const Flow<double> f = evaluate(state, law);
    const Tau<double> tau = stabilisation(f, test::step.dt, test::blood);
    const fe::ElementVector<double> expected = textbook_residual(state, tau, test::blood.density, f.mu);
    fe::ElementVector<double> r;
    residual(state, test::step, test::blood, law, r);
    for (int a = 0; a < 4; ++a)
      for (int i = 0; i < 4; ++i)
        EXPECT_NEAR(r.r[a][i], expected.r[a][i], 1e-13 * (i < 3 ? largest(expected, 0, 2) : largest(expected, 3, 3)));
  }
}

TEST(Residual, IsTheSameForEveryScalarType) {
  using P = Pack<4>;
  ElementState<double> states[4];
  ElementState<P> packed;
  for (int l = 0; l < 4; ++l) {
    test::RandomElement random(40 + l);
    states[l] = random.state();
    for (int a = 0; a < 4; ++a) {
      packed.pressure[a].set(l, states[l].pressure[a]);
      for (int i = 0; i < 3; ++i) {
        packed.position[a][i].set(l, states[l].position[a][i]);
        packed.velocity[a][i].set(l, states[l].velocity[a][i]);
        packed.acceleration[a][i].set(l, states[l].acceleration[a][i]);
        packed.mesh_velocity[a][i].set(l, states[l].mesh_velocity[a][i]);
      }
    }
  }
  fe::ElementVector<P> r_packed;
  residual(packed, test::step, test::blood, Casson{}, r_packed);
  for (int l = 0; l < 4; ++l) {
    fe::ElementVector<double> r;
    residual(states[l], test::step, test::blood, Casson{}, r);
    for (int a = 0; a < 4; ++a)
      for (int i = 0; i < 4; ++i)
        EXPECT_NEAR(r_packed.r[a][i][l], r.r[a][i], 1e-12 * (i < 3 ? largest(r, 0, 2) : largest(r, 3, 3)));
  }
}

TEST(Residual, DoesNotChangeWhenFlowAndMeshAreCarriedAlong) {
  test::RandomElement random(2);
  ElementState<double> state = random.state();
  fe::ElementVector<double> r, r_moving;
  residual(state, test::step, test::blood, Newtonian{}, r);
  for (int a = 0; a < 4; ++a) {
    const Vec3<double> speed{{3.0, -1.0, 2.0}};
    state.velocity[a] = state.velocity[a] + speed;
    state.mesh_velocity[a] = state.mesh_velocity[a] + speed;
  }
  residual(state, test::step, test::blood, Newtonian{}, r_moving);
  for (int a = 0; a < 4; ++a)
    for (int i = 0; i < 4; ++i)
      EXPECT_NEAR(r.r[a][i], r_moving.r[a][i], 1e-12 * largest(r, i < 3 ? 0 : 3, i < 3 ? 2 : 3));
}

// --- exact solutions on a patch: a cube whose centre is its only inner node
// -------------------------------------------

/// The twelve tetrahedra between the centre (node 8, displaced) and the two halves of each face.
struct Patch {
  Vec3<double> x[9];
  int element[12][4];

  explicit Patch(test::RandomElement& random) {
    for (int n = 0; n < 8; ++n)
      for (int i = 0; i < 3; ++i) x[n][i] = 1e-3 * ((n >> i & 1) + random(0.1));
    for (int i = 0; i < 3; ++i) x[8][i] = 1e-3 * (0.5 + random(0.1));
    int count = 0;
    for (int axis = 0; axis < 3; ++axis)
      for (int side = 0; side < 2; ++side) {
        const int u = 1 << (axis + 1) % 3, v = 1 << (axis + 2) % 3, base = side << axis;
        const int corner[4] = {base, base + u, base + u + v, base + v};
        for (int half = 0; half < 2; ++half) {
          int* e = element[count++];
          e[0] = 8;
          e[1] = corner[0];
          e[2] = corner[1 + half];
          e[3] = corner[2 + half];
          const Vec3<double> nodes[4] = {x[e[0]], x[e[1]], x[e[2]], x[e[3]]};
          if (fe::gradients(nodes).volume < 0.0) std::swap(e[2], e[3]);
        }
      }
  }
};

TEST(Residual, VanishesForExactSolutionsOnAnArbitrarilyMovingMesh) {
  // v = v0 + L x with tr L = 0 and p = p0 + g.x solve the Navier-Stokes equations when dv/dt = - L v - g / rho at fixed
  // x, which at a node that moves with v^ is - L (v - v^) - g / rho. Constant states are the case L = 0, g = 0.
  for (const double size : {0.0, 1.0})
    for (unsigned seed = 0; seed < 5; ++seed) {
      test::RandomElement random(seed);
      const Patch patch(random);
      Mat3<double> L;
      for (int i = 0; i < 3; ++i)
        L.m[i][0] = random(size * 300), L.m[i][1] = random(size * 300), L.m[i][2] = random(size * 300);
      L(2, 2) = -L(0, 0) - L(1, 1);
      const Vec3<double> v0 = random.vector(0.5), g = random.vector(size * 1e4);
      const Parameters parameters{.density = 1060, .viscosity = CarreauYasuda{}};
      double centre[4] = {}, magnitude[4] = {};
      Vec3<double> v[9], mesh_velocity[9], rate[9];
      double p[9];
      for (int n = 0; n < 9; ++n) {
        v[n] = v0 + L * patch.x[n];
        p[n] = 1e4 + dot(g, patch.x[n]);
        mesh_velocity[n] = random.vector(0.3);
        rate[n] = -1.0 * (L * (v[n] - mesh_velocity[n]) + (1.0 / parameters.density) * g);
      }
      for (const int(&e)[4] : patch.element) {
        ElementState<double> s;
        for (int a = 0; a < 4; ++a) {
          s.position[a] = patch.x[e[a]];
          s.velocity[a] = v[e[a]];
          s.acceleration[a] = rate[e[a]];
          s.mesh_velocity[a] = mesh_velocity[e[a]];
          s.pressure[a] = p[e[a]];
        }
        fe::ElementVector<double> r;
        residual(s, test::step, parameters, CarreauYasuda{}, r);
        for (int i = 0; i < 4; ++i) {
          centre[i] += r.r[0][i];
          magnitude[i] += std::fabs(r.r[0][i]);
        }
      }
      for (int i = 0; i < 3; ++i) EXPECT_LT(std::fabs(centre[i]), 1e-12 * magnitude[i]);
      // Continuity holds element by element, so it is compared with the volume flow through one.
      EXPECT_LT(std::fabs(centre[3]), 1e-12 * 0.5 * 1e-6);
    }
}

// --- energy
// -----------------------------------------------------------------------------------------------------------

double power_of(const fe::ElementVector<double>& r, const ElementState<double>& s) {
  double power = 0;
  for (int a = 0; a < 4; ++a) {
    for (int i = 0; i < 3; ++i) power += r.r[a][i] * s.velocity[a][i];
    power += r.r[a][3] * s.pressure[a];
  }
  return power;
}

TEST(Energy, NumericalDissipationIsThePowerOfTheUnresolvedTerms) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    test::RandomElement random(seed);
    const ElementState<double> s = random.state();
    const Flow<double> f = evaluate(s, Newtonian{});
    const Tau<double> tau = stabilisation(f, test::step.dt, test::blood), none{};
    fe::ElementVector<double> r, r_galerkin;
    residual_with(f, tau, test::blood.density, r);
    residual_with(f, none, test::blood.density, r_galerkin);
    const double expected = power_of(r, s) - power_of(r_galerkin, s);
    EXPECT_NEAR(numerical_dissipation(f, tau, s.velocity, test::blood.density), expected,
                1e-11 * (std::fabs(power_of(r, s)) + std::fabs(expected)));
  }
}

TEST(Energy, StabilisationDissipatesAlongTheFlow) {
  // A mesh that moves through nearly still fluid, so that a is large and v small (v. = 0). To second order in v and p
  // the power of the stabilisation is then the integral of tau_M |r_M|^2 + tau_C (div v)^2. With the transposed order
  // of the indices in v' (x) A it has neither that value nor, in general, that sign.
  const double small = 1e-6, rho = test::blood.density;
  for (unsigned seed = 0; seed < 10; ++seed) {
    test::RandomElement random(seed);
    ElementState<double> s = random.state();
    const Vec3<double> wind = random.vector(1.0);
    for (int a = 0; a < 4; ++a) {
      s.velocity[a] = small * s.velocity[a];
      s.mesh_velocity[a] = wind;
      s.acceleration[a] = {{0, 0, 0}};
      s.pressure[a] = small * random(1e3);
    }
    const Flow<double> f = evaluate(s, Newtonian{});
    const Tau<double> tau = stabilisation(f, 1e-2, test::blood);
    double expected = 0;
    for (int q = 0; q < 4; ++q) {
      const Vec3<double> r_m = momentum_residual(f, rho, q);
      expected += 0.25 * f.shape.volume * (tau.m[q] * dot(r_m, r_m) + tau.c[q] * f.divergence * f.divergence);
    }
    EXPECT_NEAR(numerical_dissipation(f, tau, s.velocity, rho), expected, 1e-4 * expected);
  }
}

TEST(Energy, KineticEnergyAndViscousDissipation) {
  test::RandomElement random(5);
  ElementState<double> s = random.state();
  const fe::Gradients<double> shape = fe::gradients(s.position);
  double expected = 0;  // by quadrature, exact for the square of a linear field
  for (const fe::QuadraturePoint& q : fe::four_points) {
    Vec3<double> v{{0, 0, 0}};
    for (int a = 0; a < 4; ++a) v = v + q.barycentric[a] * s.velocity[a];
    expected += 0.5 * 1060 * q.weight * shape.volume * dot(v, v);
  }
  EXPECT_NEAR(kinetic_energy(shape.volume, s.velocity, 1060.0), expected, 1e-14 * expected);

  for (int a = 0; a < 4; ++a) s.velocity[a] = {{250.0 * s.position[a][1], 0, 0}};  // shear of 250 1/s
  const Flow<double> f = evaluate(s, Newtonian{.mu = 4e-3});
  EXPECT_NEAR(shear_rate(f.gradient), 250.0, 1e-10);
  EXPECT_NEAR(viscous_dissipation(f), 4e-3 * 250.0 * 250.0 * shape.volume, 1e-20);
}

TEST(StabilisationParameters, LimitsAndScaling) {
  test::RandomElement random(8);
  ElementState<double> s = random.state();
  const double rho = test::blood.density;
  // Small steps: tau_M = dt / (2 rho). tau_M tau_C tr G = 1 always in the classic form, else without the step.
  const Flow<double> f = evaluate(s, Newtonian{});
  Parameters classic = test::blood;
  classic.stabilisation = Stabilisation::vms_classic;
  const Tau<double> tau = stabilisation(f, 1e-9, classic), bounded = stabilisation(f, 1e-9, test::blood);
  const Tau<double> steady = stabilisation(f, std::numeric_limits<double>::infinity(), test::blood);
  double trace_g = 0;
  for (int k = 0; k < 3; ++k) trace_g += dot(f.shape.dN[k], f.shape.dN[k]);
  for (int q = 0; q < 4; ++q) {
    EXPECT_NEAR(tau.m[q], 1e-9 / (2 * rho), 1e-15 / rho);
    EXPECT_NEAR(tau.c[q] * tau.m[q] * trace_g, 1.0, 1e-13);
    EXPECT_NEAR(bounded.m[q], tau.m[q], 1e-9 * tau.m[q]);
    EXPECT_EQ(bounded.c[q], steady.c[q]);
  }
  // Steady creeping flow: tau_M = 1 / (sqrt(c_I G:G) mu), quadratic in the size of the element.
  for (int a = 0; a < 4; ++a) s.velocity[a] = s.mesh_velocity[a] = {{0, 0, 0}};
  const double dt = std::numeric_limits<double>::infinity();
  const Tau<double> coarse = stabilisation(evaluate(s, Newtonian{}), dt, test::blood);
  for (int a = 0; a < 4; ++a) s.position[a] = 0.5 * s.position[a];
  const Tau<double> fine = stabilisation(evaluate(s, Newtonian{}), dt, test::blood);
  EXPECT_NEAR(coarse.m[0] / fine.m[0], 4.0, 1e-12);
  // On the parent element itself G = I: tau_M = 1 / (sqrt(36 * 3) mu).
  const Vec3<double> parent[4] = {{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}};
  for (int a = 0; a < 4; ++a) s.position[a] = parent[a];
  EXPECT_NEAR(stabilisation(evaluate(s, Newtonian{.mu = 2.0}), dt, test::blood).m[2], 1 / (std::sqrt(108.0) * 2.0),
              1e-14);
}

}  // namespace
}  // namespace tunica::fluid
