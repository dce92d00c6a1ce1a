// Newton's method on a small driven flow: the tangent has to make it converge fast.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "element.hpp"
#include "tunica/fluid/rbvms_tangent.hpp"

namespace tunica::fluid {
namespace {

constexpr int cells = 3, nodes_along = cells + 1, all_nodes = nodes_along * nodes_along * nodes_along,
              unknowns = 4 * all_nodes;
constexpr double edge = 3e-3;

int node(int i, int j, int k) { return (k * nodes_along + j) * nodes_along + i; }

/// A box of 3 x 3 x 3 cells of six tetrahedra. Velocity prescribed on its boundary, pressure at node 0; one step of
/// backward Euler, v. = (v - v_n) / dt.
class Box {
 public:
  explicit Box(double dt) : time_{.dt = dt, .acceleration = 1.0 / dt, .velocity = 1.0} {
    test::RandomElement random(4);
    for (int k = 0; k < nodes_along; ++k)
      for (int j = 0; j < nodes_along; ++j)
        for (int i = 0; i < nodes_along; ++i) {
          const bool boundary = i == 0 || j == 0 || k == 0 || i == cells || j == cells || k == cells;
          const double h = edge / cells;
          const Vec3<double> x{{h * i, h * j, h * k}};
          position_.push_back(boundary ? x : x + random.vector(0.1 * h));
          const double X = x[0] / edge - 0.5, Y = x[1] / edge - 0.5, Z = x[2] / edge - 0.5;
          const Vec3<double> divergence_free{{Y * Y + Z, X * Z - X, X * X - Y}};
          initial_.push_back(boundary ? divergence_free : divergence_free + random.vector(0.1));
          mesh_velocity_.push_back(random.vector(0.1));
          for (int c = 0; c < 3; ++c) fixed_.push_back(boundary);
          fixed_.push_back(node(i, j, k) == 0);
        }
    const int paths[6][2] = {{1, 2}, {1, 4}, {2, 1}, {2, 4}, {4, 1}, {4, 2}};
    for (int k = 0; k < cells; ++k)
      for (int j = 0; j < cells; ++j)
        for (int i = 0; i < cells; ++i)
          for (const int(&path)[2] : paths) {
            int e[4];
            const int corners[4] = {0, path[0], path[0] | path[1], 7};
            for (int a = 0; a < 4; ++a)
              e[a] = node(i + (corners[a] & 1), j + (corners[a] >> 1 & 1), k + (corners[a] >> 2 & 1));
            const Vec3<double> x[4] = {position_[e[0]], position_[e[1]], position_[e[2]], position_[e[3]]};
            if (fe::gradients(x).volume < 0) std::swap(e[1], e[2]);
            elements_.push_back({e[0], e[1], e[2], e[3]});
          }
  }

  std::vector<double> start() const {
    std::vector<double> x(unknowns, 0.0);
    for (int n = 0; n < all_nodes; ++n)
      for (int i = 0; i < 3; ++i) x[4 * n + i] = initial_[n][i];
    return x;
  }

  /// Norms of the residual in each iteration. With freeze, tau keeps its values at the start.
  template <class Law>
  std::vector<double> newton(const Law& law, bool freeze, int iterations) const {
    std::vector<double> x = start(), norms;
    std::vector<Tau<double>> tau;
    for (int it = 0; it <= iterations; ++it) {
      std::vector<double> r(unknowns, 0.0), k(unknowns * unknowns, 0.0);
      for (std::size_t e = 0; e < elements_.size(); ++e) {
        const Flow<double> f = evaluate(state(elements_[e], x), law);
        if (it == 0) tau.push_back({});
        if (it == 0 || !freeze) tau[e] = stabilisation(f, time_.dt, test::blood);
        fe::ElementVector<double> re;
        fe::ElementMatrix<double> ke;
        residual_with(f, tau[e], test::blood.density, re);
        tangent_with<Law>(f, tau[e], time_, test::blood.density, ke);
        scatter(elements_[e], re, ke, r, k);
      }
      double norm2 = 0;
      for (int i = 0; i < unknowns; ++i)
        if (!fixed_[i]) norm2 += r[i] * r[i] * (i % 4 == 3 ? 1e12 : 1.0);  // m^3/s against N
      norms.push_back(std::sqrt(norm2));
      solve(k, r);
      for (int i = 0; i < unknowns; ++i) x[i] -= r[i];
    }
    return norms;
  }

 private:
  using Element = std::array<int, 4>;

  ElementState<double> state(const Element& e, const std::vector<double>& x) const {
    ElementState<double> s;
    for (int a = 0; a < 4; ++a) {
      s.position[a] = position_[e[a]];
      s.velocity[a] = {{x[4 * e[a]], x[4 * e[a] + 1], x[4 * e[a] + 2]}};
      s.acceleration[a] = time_.acceleration * (s.velocity[a] - initial_[e[a]]);
      s.mesh_velocity[a] = mesh_velocity_[e[a]];
      s.pressure[a] = x[4 * e[a] + 3];
    }
    return s;
  }

  void scatter(const Element& e, const fe::ElementVector<double>& re, const fe::ElementMatrix<double>& ke,
               std::vector<double>& r, std::vector<double>& k) const {
    for (int a = 0; a < 4; ++a)
      for (int i = 0; i < 4; ++i) {
        const int row = 4 * e[a] + i;
        if (fixed_[row]) {
          k[row * unknowns + row] = 1.0;
          continue;
        }
        r[row] += re.r[a][i];
        for (int b = 0; b < 4; ++b)
          for (int j = 0; j < 4; ++j) k[row * unknowns + 4 * e[b] + j] += ke.k[a][b][i][j];
      }
  }

  /// Gaussian elimination with row pivoting; the solution replaces r.
  static void solve(std::vector<double>& k, std::vector<double>& r) {
    const int n = unknowns;
    for (int c = 0; c < n; ++c) {
      int pivot = c;
      for (int i = c + 1; i < n; ++i)
        if (std::fabs(k[i * n + c]) > std::fabs(k[pivot * n + c])) pivot = i;
      for (int j = c; j < n; ++j) std::swap(k[c * n + j], k[pivot * n + j]);
      std::swap(r[c], r[pivot]);
      for (int i = c + 1; i < n; ++i) {
        const double factor = k[i * n + c] / k[c * n + c];
        if (factor == 0.0) continue;
        for (int j = c; j < n; ++j) k[i * n + j] -= factor * k[c * n + j];
        r[i] -= factor * r[c];
      }
    }
    for (int c = n - 1; c >= 0; --c) {
      for (int j = c + 1; j < n; ++j) r[c] -= k[c * n + j] * r[j];
      r[c] /= k[c * n + c];
    }
  }

  TimeCoefficients time_;
  std::vector<Vec3<double>> position_, initial_, mesh_velocity_;
  std::vector<bool> fixed_;
  std::vector<Element> elements_;
};

template <class Law>
class NewtonWith : public testing::Test {};
using Laws = testing::Types<Newtonian, CarreauYasuda, Casson>;
TYPED_TEST_SUITE(NewtonWith, Laws);

TYPED_TEST(NewtonWith, ConvergesQuadraticallyAtFrozenTau) {
  const std::vector<double> norms = Box(1e-2).newton(TypeParam{}, true, 6);  // steps of a Courant number of about five
  EXPECT_LT(norms[4] / norms[0], 10 * std::pow(norms[3] / norms[0], 2));
  EXPECT_LT(norms[5], 1e-12 * norms[0]);
}

TYPED_TEST(NewtonWith, ConvergesFastWhenTauFollowsTheFlow) {
  // What tau's derivatives would add is small at the step sizes of pulsatile flow, and felt at large ones. Without the
  // rate of the step in it tau_C follows the flow more closely (1.3e-5 and 1.2e-8 in place of less than 1e-5 and 1e-8).
  const std::vector<double> usual = Box(1e-3).newton(TypeParam{}, false, 5);
  EXPECT_LT(usual[3], 2e-5 * usual[0]);
  EXPECT_LT(usual[5], 2e-8 * usual[0]);
  const std::vector<double> large = Box(1e-2).newton(TypeParam{}, false, 5);
  EXPECT_LT(large[5], 1e-4 * large[0]);
}

}  // namespace
}  // namespace tunica::fluid
