// Patch test: a cube of 24 distorted tetrahedra around one free node, boundary moved by a homogeneous deformation.
// Both elements must give the homogeneous deformation and stress exactly, by Newton's method with a dense solve.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <vector>

#include "tunica/wall/output.hpp"
#include "unit/wall/test_laws.hpp"

namespace tunica::wall {
namespace {

struct Patch {
  std::vector<Vec3<double>> x;
  std::vector<std::array<int, 4>> elements;
};

/// Unit cube: 8 corners, 6 face nodes, 1 centre, each face fanned around its node; the centre and the face nodes
/// (within their face) are moved off their middle.
Patch distorted_cube() {
  Patch p;
  for (int n = 0; n < 8; ++n) p.x.push_back({{double(n & 1), double(n >> 1 & 1), double(n >> 2 & 1)}});
  p.x.push_back({{0.57, 0.44, 0.53}});
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3, face = static_cast<int>(p.x.size());
      Vec3<double> x{{0, 0, 0}};
      x[axis] = side, x[u] = 0.45 + 0.1 * side, x[v] = 0.6 - 0.05 * axis;
      p.x.push_back(x);
      const int loop[4] = {side << axis, side << axis | 1 << u, side << axis | 1 << u | 1 << v, side << axis | 1 << v};
      for (int k = 0; k < 4; ++k) {
        std::array<int, 4> e{8, face, loop[k], loop[(k + 1) % 4]};
        const Vec3<double> c[4] = {p.x[e[0]], p.x[e[1]], p.x[e[2]], p.x[e[3]]};
        if (fe::gradients(c).volume < 0) std::swap(e[2], e[3]);
        p.elements.push_back(e);
      }
    }
  return p;
}

void solve_dense(std::vector<double>& A, std::vector<double>& b) {
  const int n = static_cast<int>(b.size());
  for (int k = 0; k < n; ++k) {
    int pivot = k;
    for (int i = k + 1; i < n; ++i)
      if (std::fabs(A[i * n + k]) > std::fabs(A[pivot * n + k])) pivot = i;
    for (int j = 0; j < n; ++j) std::swap(A[k * n + j], A[pivot * n + j]);
    std::swap(b[k], b[pivot]);
    for (int i = k + 1; i < n; ++i) {
      const double f = A[i * n + k] / A[k * n + k];
      for (int j = k; j < n; ++j) A[i * n + j] -= f * A[k * n + j];
      b[i] -= f * b[k];
    }
  }
  for (int k = n - 1; k >= 0; --k) {
    for (int j = k + 1; j < n; ++j) b[k] -= A[k * n + j] * b[j];
    b[k] /= A[k * n + k];
  }
}

/// Newton's method; nodes below `fixed` and from `fixed` + 1 on have prescribed displacement, all pressures are free.
struct PatchProblem {
  Patch patch = distorted_cube();
  std::vector<double> u = std::vector<double>(4 * patch.x.size(), 0.0);  // u_x u_y u_z p
  bool mixed;
  Body body;

  bool is_free(int dof) const { return dof % 4 == 3 ? mixed : dof / 4 == 8; }

  template <class L>
  ElementState<double> state(const L&, const std::array<int, 4>& nodes) const {
    ElementState<double> e{};
    const Vec3<double> c[4] = {patch.x[nodes[0]], patch.x[nodes[1]], patch.x[nodes[2]], patch.x[nodes[3]]};
    e.reference = fe::gradients(c);
    for (int a = 0; a < 4; ++a) {
      for (int i = 0; i < 3; ++i) e.displacement[a][i] = u[4 * nodes[a] + i];
      e.pressure[a] = u[4 * nodes[a] + 3];
    }
    return e;
  }

  /// One Newton step; returns the norm of the residual before it.
  template <class L>
  double step(const L& law) {
    const int n = static_cast<int>(u.size());
    std::vector<double> A(n * n, 0.0), b(n, 0.0);
    for (const auto& nodes : patch.elements) {
      const ElementState<double> e = state(law, nodes);
      fe::ElementVector<double> r;
      fe::ElementMatrix<double> k;
      if (mixed)
        mixed_tangent(e, law, body, {}, r, k);
      else
        displacement_tangent(e, law, body, {}, r, k);
      for (int p = 0; p < 16; ++p) {
        b[4 * nodes[p / 4] + p % 4] -= r.r[p / 4][p % 4];
        for (int q = 0; q < 16; ++q)
          A[(4 * nodes[p / 4] + p % 4) * n + 4 * nodes[q / 4] + q % 4] += k.k[p / 4][q / 4][p % 4][q % 4];
      }
    }
    double norm = 0.0;
    for (int p = 0; p < n; ++p) {
      if (!is_free(p)) {
        for (int q = 0; q < n; ++q) A[p * n + q] = p == q ? 1.0 : 0.0;
        b[p] = 0.0;
      }
      norm += b[p] * b[p];
    }
    solve_dense(A, b);
    for (int p = 0; p < n; ++p) u[p] += b[p];
    return std::sqrt(norm);
  }
};

template <class L>
void check_patch(const L& law, bool mixed, double bulk, const Mat3<double>& F) {
  PatchProblem problem{.mixed = mixed, .body = {.density = 1.0, .volumetric = {VolumetricEnergy::miehe, bulk}}};
  for (std::size_t n = 0; n < problem.patch.x.size(); ++n)
    for (int i = 0; i < 3; ++i)
      problem.u[4 * n + i] = (F * problem.patch.x[n] - problem.patch.x[n])[i] + (n == 8 ? 0.03 * (i - 1) : 0.0);
  double norm = 1.0;
  for (int iteration = 0; iteration < 12 && norm > 1e-12; ++iteration) norm = problem.step(law);
  ASSERT_LE(norm, 1e-12) << "Newton's method must converge within 12 steps";
  const double J = determinant(F), p = -bulk * (1.0 - 1.0 / J);
  const Vec3<double> centre = F * problem.patch.x[8] - problem.patch.x[8];
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(problem.u[4 * 8 + i], centre[i], 1e-12);
  Symmetric<double> first;
  for (const auto& nodes : problem.patch.elements) {
    const ElementState<double> e = problem.state(law, nodes);
    const Symmetric<double> sigma =
        mixed ? mixed_cauchy_stress(e, law) : displacement_cauchy_stress(e, law, problem.body);
    if (&nodes == &problem.patch.elements[0]) first = sigma;
    for (int n = 0; n < 6; ++n) EXPECT_NEAR(sigma[n], first[n], 1e-10);
    EXPECT_NEAR(trace(sigma) / 3.0, -p, 1e-10);
    for (double value : e.pressure) EXPECT_NEAR(value, mixed ? p : 0.0, 1e-10);
  }
}

const Mat3<double> stretch_and_shear{{{1.1, 0.15, -0.05}, {0.02, 0.93, 0.08}, {-0.06, 0.04, 1.04}}};

TEST(WallPatch, DisplacementElement) {
  check_patch(NeoHooke{2.0}, false, 20.0, stretch_and_shear);
  check_patch(test::ExponentialFibre{}, false, 20.0, stretch_and_shear);
}

TEST(WallPatch, MixedElement) {
  check_patch(NeoHooke{2.0}, true, 20.0, stretch_and_shear);
  check_patch(NeoHooke{2.0}, true, 1e4, stretch_and_shear);
  check_patch(test::ExponentialFibre{}, true, 20.0, stretch_and_shear);
}

}  // namespace
}  // namespace tunica::wall
