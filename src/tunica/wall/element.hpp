// Wall kernels on the linear tetrahedron: displacement element and mixed displacement-pressure element.
//
// Gradients are constant, so one evaluation per element is exact. Unknown x: the velocity at t_{n+1} in dynamics, the
// displacement in statics; both residuals are functions of u, v_dot and p, and Coefficients carries du/dx and
// dv_dot/dx. One kernel therefore serves statics and dynamics.
//
// Displacement element:
//   r_a = (N_a, rho_0 v_dot) + (grad_X N_a, P),   P = F S,   S = J^(-2/3) Dev(S_bar) + J p_vol C^-1            (1.5)
//
// Mixed element, p positive in compression (sigma = sigma_iso - p I), U'(J) = K g(J):
//   r_a   = (N_a, rho_0 v_dot) + (grad_X N_a, P_iso - p J F^-T)
//   r_p,a = s [ (N_a, g(J) + p/K) + (grad_X N_a, tau_u grad_X p) ]
// The last term is the variational multiscale one. On linear elements the deviatoric stress has no divergence, so the
// momentum residual is grad p plus inertia; the displacement subscale u' = -tau_u grad p enters the constraint
// linearised about g'(1) = 1. Two choices in it:
// - Inertia is left out of the subscale. Kept, it makes the semi-discrete equations unstable: the linearised free
//   vibration of a block grew without bound at every c from 0.03 to 1, compressible or not, wherever the time step
//   resolved the waves. It would only matter by (h / shear wavelength)^2, and tau_u is of order h^2 anyhow.
// - The gradients are those of the reference. Then the pressure block s [(N_a, N_b)/K + tau_u (grad_X N_a, grad_X N_b)]
//   is constant, symmetric and positive, 1/K = 0 is allowed, and with the quadratic energy the equations derive from
//     Psi - p (J - 1) - p^2/(2 K) - tau_u/2 |grad_X p|^2,
//   so that the element neither makes nor loses energy.
//
// The constraint is algebraic. Liu & Marsden (2018) integrate it in rate form, J (beta p_dot + div v) = 0; then J is
// known only through its history, drifts over thousands of steps, and statics needs another kernel. The algebraic form
// ties p to J itself at every step.
//
// tau_u = c h^2 / mu_s, with mu_s the law's shear modulus in the present state (1.16) and h^2 = 6 / sum_a |grad_X
// N_a|^2: the squared edge of a regular tetrahedron, and close to the squared smallest height of a flat one.
//
// An inverted element (J <= 0) gives NaN, which Newton's method must take as a rejected step.
// Axes: grad_X in any frame, also the element's fibre frame (material_concept.hpp); x, u, v in global axes. F has
// global axes on its left and those of the frame on its right; ElementState::axes leads from one to the other.
#pragma once

#include "tunica/fe/tetrahedron.hpp"
#include "tunica/wall/material_concept.hpp"
#include "tunica/wall/volumetric.hpp"

namespace tunica::wall {

/// Default of the stabilisation constant c. On the inflated incompressible thick cylinder (inner radius + 15 %), two to
/// four isotropic elements through the wall, radius and hoop stress of neo-Hooke hardly depend on c from 0.03 to 1,
/// while the pressure scatters by 8 % of the load at 0.03. With dispersed fibres (a tube at 100 mmHg) and in the
/// manufactured solutions the errors at 0.1 are half of those at 0.3.
inline constexpr double default_stabilisation = 0.1;

/// What the element needs besides the law. In a batch, density and K may differ between the lanes (`Scalar`).
template <class Scalar>
struct BodyOf {
  Scalar density = 0.0;                          ///< rho_0, reference [kg/m^3]
  VolumetricOf<Scalar> volumetric;               ///< energy and K
  double stabilisation = default_stabilisation;  ///< c > 0, mixed element only [-]
  const double* bulk_moduli = nullptr;           ///< of quadratic elements [point][lane]; null: K at all points [Pa]

  TUNICA_INLINE BodyOf at_point(int q) const {
    if (bulk_moduli == nullptr) return *this;
    BodyOf body = *this;
    if constexpr (lanes<Scalar> == 1)
      body.volumetric.bulk_modulus = bulk_moduli[q];
    else
      body.volumetric.bulk_modulus = Scalar::load(bulk_moduli + q * lanes<Scalar>);
    return body;
  }
};
using Body = BodyOf<double>;

/// Nodal values of one element, or of a batch of elements.
template <class T>
struct ElementState {
  fe::Gradients<T> reference;       ///< gradients with respect to X [1/m], volume [m^3]
  Mat3<T> axes = identity<T>();     ///< columns: axes of these gradients, global components; orthonormal, or times F0
  Vec3<T> displacement[fe::nodes];  ///< u at t_{n+alpha_f} [m]
  Vec3<T> acceleration[fe::nodes];  ///< v_dot at t_{n+alpha_m} [m/s^2]
  T pressure[fe::nodes];            ///< p at t_{n+alpha_f} [Pa], mixed element only
};

/// Gradients of the element with the corners X [m] in global axes.
template <class T>
TUNICA_INLINE void set_reference(ElementState<T>& e, const Vec3<T> (&X)[fe::nodes]) {
  e.reference = fe::gradients(X);
}

/// The same in the orthonormal frame e1, e2, e1 x e2.
template <class T>
TUNICA_INLINE void set_reference(ElementState<T>& e, const Vec3<T> (&X)[fe::nodes], const Vec3<T>& e1,
                                 const Vec3<T>& e2) {
  const Vec3<T> e3 = cross(e1, e2), zero{{T(0.0), T(0.0), T(0.0)}};
  Vec3<T> x[fe::nodes] = {zero, zero, zero, zero};
#pragma GCC unroll 4
  for (int a = 1; a < fe::nodes; ++a) {
    const Vec3<T> edge = X[a] - X[0];
    x[a] = {{dot(e1, edge), dot(e2, edge), dot(e3, edge)}};
  }
  e.reference = fe::gradients(x);
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i) e.axes(i, 0) = e1[i], e.axes(i, 1) = e2[i], e.axes(i, 2) = e3[i];
}

/// Derivatives with respect to the unknown, and the factor of the constraint rows.
struct Coefficients {
  double acceleration = 0.0;  ///< dv_dot/dx
  double displacement = 1.0;  ///< du/dx
  double constraint = 1.0;    ///< s, multiplies r_p
};

/// Kinematics at the single evaluation point.
template <class T>
struct Kinematics {
  Mat3<T> F;                ///< deformation gradient
  T J;                      ///< det F
  T scale;                  ///< J^(-2/3)
  Symmetric<T> C_bar;       ///< J^(-2/3) F^T F
  Vec3<T> dN_x[fe::nodes];  ///< grad_x N_a = F^-T grad_X N_a [1/m]
};

template <class T>
TUNICA_INLINE Mat3<T> deformation_gradient(const ElementState<T>& e) {
  Mat3<T> F = e.axes;
#pragma GCC unroll 4
  for (int a = 1; a < fe::nodes; ++a) {
    const Vec3<T> edge = e.displacement[a] - e.displacement[0];  // exact zero for a translation
#pragma GCC unroll 3
    for (int i = 0; i < 3; ++i)
#pragma GCC unroll 3
      for (int j = 0; j < 3; ++j) F(i, j) += edge[i] * e.reference.dN[a][j];
  }
  return F;
}

template <class T>
TUNICA_INLINE Kinematics<T> kinematics(const ElementState<T>& e) {
  Kinematics<T> k;
  k.F = deformation_gradient(e);
  const Mat3<T> adj = adjugate(k.F);
  k.J = k.F(0, 0) * adj(0, 0) + k.F(0, 1) * adj(1, 0) + k.F(0, 2) * adj(2, 0);
  k.scale = pow(k.J, -2.0 / 3.0);
  k.C_bar = k.scale * right_cauchy_green(k.F);
  const T inverse_J = T(1.0) / k.J;
#pragma GCC unroll 4
  for (int a = 1; a < fe::nodes; ++a) {
    const Vec3<T> dN = inverse_J * e.reference.dN[a];
#pragma GCC unroll 3
    for (int i = 0; i < 3; ++i) k.dN_x[a][i] = adj(0, i) * dN[0] + adj(1, i) * dN[1] + adj(2, i) * dN[2];
  }
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i) k.dN_x[0][i] = -(k.dN_x[1][i] + k.dN_x[2][i] + k.dN_x[3][i]);
  return k;
}

/// tau_u [m^2/Pa].
template <class T, class L, class U>
TUNICA_INLINE T subscale_compliance(const ElementState<T>& e, const L& law, const BodyOf<U>& body) {
  T sum(0.0);
#pragma GCC unroll 4
  for (int a = 0; a < fe::nodes; ++a) sum += dot(e.reference.dN[a], e.reference.dN[a]);
  return T(6.0 * body.stabilisation) / (T(stabilising_modulus(law)) * sum);
}

/// Shear modulus that scales the stabilisation [Pa], (1.16): that at rest and what the curvature of the energy adds in
/// the present state.
template <class T, class L>
TUNICA_INLINE T present_modulus(const ElementState<T>& e, const L& law) {
  const T rest(law.shear_modulus_at_rest());
  if constexpr (is_linear<L>) {
    return rest;
  } else {
    const Mat3<T> F = deformation_gradient(e);
    const Symmetric<T> C = right_cauchy_green(F), C_bar = pow(determinant(F), -2.0 / 3.0) * C;
    T squared = squared_norm(response(law, C_bar).tangent, C_bar);
    if constexpr (can_be_unsplit<L>)
      if (law.has_unsplit_part()) squared += squared_norm(law.unsplit_response(C).tangent, C);
    return rest + sqrt(T(1.0 / 45.0) * squared);
  }
}

/// grad_X p [Pa/m].
template <class T>
TUNICA_INLINE Vec3<T> pressure_gradient(const ElementState<T>& e) {
  Vec3<T> g;
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i)
    g[i] = e.reference.dN[1][i] * (e.pressure[1] - e.pressure[0]) +
           e.reference.dN[2][i] * (e.pressure[2] - e.pressure[0]) +
           e.reference.dN[3][i] * (e.pressure[3] - e.pressure[0]);
  return g;
}

namespace detail {

/// The stress at the evaluation point in the form that the kernels use: with S' = J^(-2/3) S_bar,
///   P grad_X N_a = q_a - (theta - pi) grad_x N_a,  s_a = S' grad_X N_a,  q_a = F s_a,  theta = S' : C / 3,
/// and pi = J p_vol or -p J. The deviator is thus never formed.
template <class T>
struct Stress {
  Vec3<T> s[fe::nodes];
  Vec3<T> q[fe::nodes];
  T theta;
  T pi;
};

template <class T>
TUNICA_INLINE Stress<T> project(const ElementState<T>& e, const Kinematics<T>& k, const Symmetric<T>& S_bar,
                                const T& pi) {
  Stress<T> s;
  const Symmetric<T> S = k.scale * S_bar;
#pragma GCC unroll 4
  for (int a = 1; a < fe::nodes; ++a) {
    s.s[a] = S * e.reference.dN[a];
    s.q[a] = k.F * s.s[a];
  }
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i) {
    s.s[0][i] = -(s.s[1][i] + s.s[2][i] + s.s[3][i]);
    s.q[0][i] = -(s.q[1][i] + s.q[2][i] + s.q[3][i]);
  }
  s.theta = T(1.0 / 3.0) * double_dot(S_bar, k.C_bar);
  s.pi = pi;
  return s;
}

/// Momentum rows: inertia with the consistent mass, V rho_0 (1 + delta_ab) / 20, and internal forces.
template <class T>
TUNICA_INLINE void momentum_residual(const ElementState<T>& e, const Kinematics<T>& k, const Stress<T>& s,
                                     const T& density, fe::ElementVector<T>& r) {
  const T V = e.reference.volume, m = T(1.0 / 20.0) * density * V, isotropic = s.pi - s.theta;
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i) {
    const T sum = e.acceleration[0][i] + e.acceleration[1][i] + e.acceleration[2][i] + e.acceleration[3][i];
#pragma GCC unroll 4
    for (int a = 0; a < fe::nodes; ++a)
      r.r[a][i] = m * (sum + e.acceleration[a][i]) + V * (s.q[a][i] + isotropic * k.dN_x[a][i]);
  }
}

/// Fills the block K of nodes 0 from the others: rows and columns of an internal force sum to zero.
template <class T>
TUNICA_INLINE void complete_by_translation(fe::ElementMatrix<T>& m) {
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i)
#pragma GCC unroll 3
    for (int j = 0; j < 3; ++j) {
#pragma GCC unroll 4
      for (int b = 1; b < fe::nodes; ++b) {
        m.k[0][b][i][j] = -(m.k[1][b][i][j] + m.k[2][b][i][j] + m.k[3][b][i][j]);
        m.k[b][0][j][i] = m.k[0][b][i][j];
      }
    }
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i)
#pragma GCC unroll 3
    for (int j = 0; j < 3; ++j) m.k[0][0][i][j] = -(m.k[1][0][i][j] + m.k[2][0][i][j] + m.k[3][0][i][j]);
}

/// w (CC' + CC_u), CC' = J^(-4/3) CC_bar. Either of the two may be null.
template <class T>
TUNICA_INLINE SymmetricTangent<T> material_tangent(const Kinematics<T>& k, const SymmetricTangent<T>* CC_bar,
                                                   const Response<T>* unsplit, const T& weight) {
  SymmetricTangent<T> CC;
  const T pull = weight * k.scale * k.scale;
#pragma GCC unroll 21
  for (int n = 0; n < 21; ++n) {
    CC.v[n] = CC_bar != nullptr ? pull * CC_bar->v[n] : T(0.0);
    if (unsplit != nullptr) CC.v[n] += weight * unsplit->tangent.v[n];
  }
  return CC;
}

/// Adds B_a,i : CC : B_b,j with the variations of the strain, B_a,i = sym(grad_X N_a (x) F_i), as
/// F_iI (grad_X N_a,J CC_IJKL grad_X N_b,L) F_jK; for nodes 1..3, upper triangle of node blocks.
template <class T>
TUNICA_INLINE void add_material_tangent(const ElementState<T>& e, const Mat3<T>& F, const SymmetricTangent<T>& CC,
                                        fe::ElementMatrix<T>& m) {
#pragma GCC unroll 3
  for (int b = 1; b < fe::nodes; ++b) {
    const Vec3<T>& dN_b = e.reference.dN[b];
    T column[voigt_size][3];  // CC_IJKL grad_X N_b,L, [IJ][K]
#pragma GCC unroll 6
    for (int n = 0; n < voigt_size; ++n)
#pragma GCC unroll 3
      for (int i = 0; i < 3; ++i)
        column[n][i] = CC(n, voigt_index[i][0]) * dN_b[0] + CC(n, voigt_index[i][1]) * dN_b[1] +
                       CC(n, voigt_index[i][2]) * dN_b[2];
#pragma GCC unroll 3
    for (int a = 1; a <= b; ++a) {
      const Vec3<T>& dN_a = e.reference.dN[a];
      Mat3<T> G;
#pragma GCC unroll 3
      for (int i = 0; i < 3; ++i)
#pragma GCC unroll 3
        for (int j = a == b ? i : 0; j < 3; ++j) {
          G(i, j) = dN_a[0] * column[voigt_index[i][0]][j] + dN_a[1] * column[voigt_index[i][1]][j] +
                    dN_a[2] * column[voigt_index[i][2]][j];
          if (a == b) G(j, i) = G(i, j);
        }
      const Mat3<T> FG = F * G;
#pragma GCC unroll 3
      for (int i = 0; i < 3; ++i)
#pragma GCC unroll 3
        for (int j = a == b ? i : 0; j < 3; ++j) {
          const T sum = FG(i, 0) * F(j, 0) + FG(i, 1) * F(j, 1) + FG(i, 2) * F(j, 2);
          m.k[a][b][i][j] += sum;
          if (a == b && i != j) m.k[a][b][j][i] += sum;
        }
    }
  }
}

/// The isochoric projection of CC_bar, as an addition to q_a and to the factor of g_a,i g_b,j:
///   (B_a,i - g_a,i C/3) : CC' : (B_b,j - g_b,j C/3) = B_a,i : CC' : B_b,j - (g_a,i h_b,j + h_a,i g_b,j)/3
///                                                    + g_a,i g_b,j (C : CC' : C)/9,   h_a = F (CC' : C) grad_X N_a.
template <class T>
TUNICA_INLINE void add_isochoric_projection(const ElementState<T>& e, const Kinematics<T>& k,
                                            const SymmetricTangent<T>& CC_bar, const T& weight, T& rank_one,
                                            Vec3<T> (&q)[fe::nodes]) {
  Symmetric<T> row;
#pragma GCC unroll 6
  for (int n = 0; n < voigt_size; ++n)
    row[n] = CC_bar(n, 0) * k.C_bar[0] + CC_bar(n, 1) * k.C_bar[1] + CC_bar(n, 2) * k.C_bar[2] +
             T(2.0) * (CC_bar(n, 3) * k.C_bar[3] + CC_bar(n, 4) * k.C_bar[4] + CC_bar(n, 5) * k.C_bar[5]);
  rank_one += T(1.0 / 9.0) * weight * double_dot(row, k.C_bar);
  row = T(0.5) * k.scale * row;
#pragma GCC unroll 3
  for (int a = 1; a < fe::nodes; ++a) q[a] = q[a] + k.F * (row * e.reference.dN[a]);
}

/// Adds the force V F S_u grad_X N_a of a stress outside the isochoric split.
template <class T>
TUNICA_INLINE void add_unsplit_residual(const ElementState<T>& e, const Mat3<T>& F, const Symmetric<T>& S,
                                        fe::ElementVector<T>& r) {
#pragma GCC unroll 4
  for (int a = 1; a < fe::nodes; ++a) {
    const Vec3<T> force = e.reference.volume * (F * (S * e.reference.dN[a]));
#pragma GCC unroll 3
    for (int i = 0; i < 3; ++i) {
      r.r[a][i] += force[i];
      r.r[0][i] -= force[i];
    }
  }
}

/// Velocity block of the tangent: c_u V d(P grad_X N_a)_i / du_b,j plus the mass. With kappa = J dpi/dJ,
///   k_ab,ij = delta_ij s_b.grad_X N_a + (theta - pi) g_a,j g_b,i + (2/3 theta + kappa) g_a,i g_b,j
///             - 2/3 (g_a,i q_b,j + q_a,i g_b,j) + B'_a,i : CC' : B'_b,j,
/// g_a = grad_x N_a and B'_a,i = sym(grad_X N_a (x) F_i) - g_a,i C/3.
/// It is the standard isochoric split (Holzapfel 2000, eq. 6.168) contracted by hand: the geometric stiffness of the
/// isotropic stress cancels against the C^-1 (.) C^-1 terms. A part outside the split adds
///   delta_ij grad_X N_b . S_u grad_X N_a + B_a,i : CC_u : B_b,j  without the projection.
/// `CC_bar` and `unsplit` may be null.
template <class T>
TUNICA_INLINE void momentum_tangent(const ElementState<T>& e, const Kinematics<T>& k, const Stress<T>& s,
                                    const SymmetricTangent<T>* CC_bar, const Response<T>* unsplit, const T& kappa,
                                    const T& density, const Coefficients& c, fe::ElementMatrix<T>& m) {
  const T weight = T(c.displacement) * e.reference.volume;
  const T swap = weight * (s.theta - s.pi), cross_weight = weight * T(-2.0 / 3.0);
  T rank_one = weight * (T(2.0 / 3.0) * s.theta + kappa);
  Vec3<T> q[fe::nodes] = {s.q[0], s.q[1], s.q[2], s.q[3]};
  if (CC_bar != nullptr) add_isochoric_projection(e, k, *CC_bar, weight, rank_one, q);
#pragma GCC unroll 3
  for (int b = 1; b < fe::nodes; ++b) {
    const Vec3<T>& g_b = k.dN_x[b];
    const Vec3<T> cross_b = cross_weight * g_b, swap_b = swap * g_b;
    const Vec3<T> first = rank_one * g_b + cross_weight * q[b];
    Vec3<T> s_b = s.s[b];
    if (unsplit != nullptr) s_b = s_b + unsplit->stress * e.reference.dN[b];
#pragma GCC unroll 3
    for (int a = 1; a <= b; ++a) {
      const Vec3<T>& g_a = k.dN_x[a];
      const T diagonal = weight * dot(e.reference.dN[a], s_b);
#pragma GCC unroll 3
      for (int i = 0; i < 3; ++i)
#pragma GCC unroll 3
        for (int j = 0; j < 3; ++j) {
          T sum = g_a[i] * first[j] + q[a][i] * cross_b[j] + g_a[j] * swap_b[i];
          if (i == j) sum += diagonal;
          m.k[a][b][i][j] = sum;
        }
    }
  }
  if (CC_bar != nullptr || unsplit != nullptr)
    add_material_tangent(e, k.F, material_tangent(k, CC_bar, unsplit, weight), m);
#pragma GCC unroll 3
  for (int b = 1; b < fe::nodes; ++b)
#pragma GCC unroll 3
    for (int a = 1; a < b; ++a)
#pragma GCC unroll 3
      for (int i = 0; i < 3; ++i)
#pragma GCC unroll 3
        for (int j = 0; j < 3; ++j) m.k[b][a][j][i] = m.k[a][b][i][j];
  complete_by_translation(m);
  const T mass = T(c.acceleration / 20.0) * density * e.reference.volume;
#pragma GCC unroll 4
  for (int a = 0; a < fe::nodes; ++a)
#pragma GCC unroll 4
    for (int b = 0; b < fe::nodes; ++b)
#pragma GCC unroll 3
      for (int i = 0; i < 3; ++i) m.k[a][b][i][i] += a == b ? mass + mass : mass;
}

/// Momentum rows of either element for a given pi.
template <class T, class L>
TUNICA_INLINE void add_momentum(const ElementState<T>& e, const Kinematics<T>& k, const L& law, const T& pi,
                                const T& density, fe::ElementVector<T>& r) {
  momentum_residual(e, k, project(e, k, stress(law, k.C_bar), pi), density, r);
  if constexpr (can_be_unsplit<L>)
    if (law.has_unsplit_part()) add_unsplit_residual(e, k.F, law.unsplit_stress(right_cauchy_green(k.F)), r);
}

/// The same with the tangent of the motion; kappa = J dpi/dJ.
template <class T, class L>
TUNICA_INLINE void add_momentum(const ElementState<T>& e, const Kinematics<T>& k, const L& law, const T& pi,
                                const T& kappa, const T& density, const Coefficients& c, fe::ElementVector<T>& r,
                                fe::ElementMatrix<T>& m) {
  Response<T> unsplit;
  const Response<T>* extra = nullptr;
  if constexpr (can_be_unsplit<L>)
    if (law.has_unsplit_part()) {
      unsplit = law.unsplit_response(right_cauchy_green(k.F));
      extra = &unsplit;
    }
  if constexpr (is_linear<L>) {
    const Stress<T> s = project(e, k, stress(law, k.C_bar), pi);
    momentum_residual(e, k, s, density, r);
    momentum_tangent<T>(e, k, s, nullptr, extra, kappa, density, c, m);
  } else {
    const Response<T> both = response(law, k.C_bar);
    const Stress<T> s = project(e, k, both.stress, pi);
    momentum_residual(e, k, s, density, r);
    momentum_tangent<T>(e, k, s, &both.tangent, extra, kappa, density, c, m);
  }
  if (extra != nullptr) add_unsplit_residual(e, k.F, extra->stress, r);
}

template <class T>
TUNICA_INLINE T mean_pressure(const ElementState<T>& e) {
  return T(0.25) * (e.pressure[0] + e.pressure[1] + e.pressure[2] + e.pressure[3]);
}

template <class T, class U>
TUNICA_INLINE void constraint_residual(const ElementState<T>& e, const Kinematics<T>& k, const T& tau,
                                       const BodyOf<U>& body, double factor, fe::ElementVector<T>& r) {
  const T V = T(factor) * e.reference.volume;
  const T g = T(0.25) * body.volumetric.unit_pressure(k.J);
  const T compressibility(T(body.volumetric.compressibility()) * T(1.0 / 20.0));
  const T sum = e.pressure[0] + e.pressure[1] + e.pressure[2] + e.pressure[3];
  Vec3<T> flux = pressure_gradient(e);
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i) flux[i] *= tau;
#pragma GCC unroll 4
  for (int a = 0; a < fe::nodes; ++a)
    r.r[a][3] = V * (g + compressibility * (sum + e.pressure[a]) + dot(e.reference.dN[a], flux));
}

/// Pressure column and constraint row, with dJ = J (grad_x N_b)_j du_b,j.
template <class T, class U>
TUNICA_INLINE void constraint_tangent(const ElementState<T>& e, const Kinematics<T>& k, const T& tau,
                                      const BodyOf<U>& body, const Coefficients& c, fe::ElementMatrix<T>& m) {
  const T quarter = T(0.25) * e.reference.volume * k.J, row = T(c.constraint) * e.reference.volume;
  const T volume_change = T(c.constraint * c.displacement) * quarter * body.volumetric.unit_stiffness(k.J);
  const T mass = T(body.volumetric.compressibility()) * T(1.0 / 20.0) * row, laplace = row * tau;
#pragma GCC unroll 4
  for (int a = 0; a < fe::nodes; ++a) {
    const Vec3<T> column = -quarter * k.dN_x[a], dilation = volume_change * k.dN_x[a];
    const Vec3<T> flux = laplace * e.reference.dN[a];
#pragma GCC unroll 4
    for (int b = 0; b < fe::nodes; ++b) {
#pragma GCC unroll 3
      for (int j = 0; j < 3; ++j) {
        m.k[a][b][j][3] = column[j];
        m.k[b][a][3][j] = dilation[j];
      }
      m.k[a][b][3][3] = (a == b ? mass + mass : mass) + dot(flux, e.reference.dN[b]);
    }
  }
}

}  // namespace detail

/// Displacement element, residual [N]; pressure rows zero. K must be finite.
template <class T, class L, class U>
TUNICA_INLINE void displacement_residual(const ElementState<T>& e, const L& law, const BodyOf<U>& body,
                                         fe::ElementVector<T>& r) {
  const Kinematics<T> k = kinematics(e);
  const T pi = T(body.volumetric.bulk_modulus) * k.J * body.volumetric.unit_pressure(k.J);
  detail::add_momentum(e, k, law, pi, T(body.density), r);
#pragma GCC unroll 4
  for (int a = 0; a < fe::nodes; ++a) r.r[a][3] = T(0.0);
}

/// Displacement element, residual [N] and tangent; pressure rows and columns zero. K must be finite.
template <class T, class L, class U>
TUNICA_INLINE void displacement_tangent(const ElementState<T>& e, const L& law, const BodyOf<U>& body,
                                        const Coefficients& c, fe::ElementVector<T>& r, fe::ElementMatrix<T>& m) {
  const Kinematics<T> k = kinematics(e);
  const T bulk(body.volumetric.bulk_modulus), p = bulk * body.volumetric.unit_pressure(k.J), pi = k.J * p;
  const T kappa = pi + k.J * k.J * bulk * body.volumetric.unit_stiffness(k.J);
  detail::add_momentum(e, k, law, pi, kappa, T(body.density), c, r, m);
#pragma GCC unroll 4
  for (int a = 0; a < fe::nodes; ++a) {
    r.r[a][3] = T(0.0);
#pragma GCC unroll 4
    for (int b = 0; b < fe::nodes; ++b) {
#pragma GCC unroll 3
      for (int i = 0; i < 3; ++i) m.k[a][b][i][3] = m.k[a][b][3][i] = T(0.0);
      m.k[a][b][3][3] = T(0.0);
    }
  }
}

/// Mixed element, residual: momentum [N], constraint s [m^3].
template <class T, class L, class U>
TUNICA_INLINE void mixed_residual(const ElementState<T>& e, const L& law, const BodyOf<U>& body, const Coefficients& c,
                                  fe::ElementVector<T>& r) {
  const Kinematics<T> k = kinematics(e);
  const T pi = -k.J * detail::mean_pressure(e);
  detail::add_momentum(e, k, law, pi, T(body.density), r);
  detail::constraint_residual(e, k, subscale_compliance(e, law, body), body, c.constraint, r);
}

/// Mixed element, residual and tangent.
template <class T, class L, class U>
TUNICA_INLINE void mixed_tangent(const ElementState<T>& e, const L& law, const BodyOf<U>& body, const Coefficients& c,
                                 fe::ElementVector<T>& r, fe::ElementMatrix<T>& m) {
  const Kinematics<T> k = kinematics(e);
  const T pi = -k.J * detail::mean_pressure(e);  // at fixed p, J dpi/dJ = pi
  detail::add_momentum(e, k, law, pi, pi, T(body.density), c, r, m);
  const T tau = subscale_compliance(e, law, body);
  detail::constraint_residual(e, k, tau, body, c.constraint, r);
  detail::constraint_tangent(e, k, tau, body, c, m);
}

}  // namespace tunica::wall
