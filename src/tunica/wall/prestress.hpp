// Prestress: what an imaged wall carries in the shape in which it was imaged (docs/theory.md, section 5).
//
// S0 and F0 belong to the points of quadrature: one in a linear element, four in a quadratic one, each of which is a
// linear element with a share of the volume (quadratic_element.hpp).
//
// Additive: the stress S + S0 in place of S (Hsu & Bazilevs 2011):
//   P = F (S + S0),   r_a += V F S0 grad_X N_a,   K_ab,ij += c_u V delta_ij grad_X N_a . S0 grad_X N_b            (5.1)
// The state at rest is u = 0 with p = 0: the pressure unknown of the mixed element counts from the imaged state.
//
// Multiplicative: the law sees F F0, F0 leading from the point's own stress-free state to the imaged one:
//   P = F F0 S(F F0) F0^T / det F0,   grad_0 N_a = F0^T grad_X N_a,   V_0 = V / det F0                           (5.2)
// An element state that is referred to the stress-free element is an element state like any other, so no kernel has to
// know of it.
#pragma once

#include "tunica/wall/element.hpp"

namespace tunica::wall {

enum class PrestressKind {
  none,
  stress,  ///< S0, symmetric, 6 numbers (Voigt 11 22 33 12 23 13) [Pa]
  stretch  ///< F0, 9 numbers, row by row [-]
};

/// Cell array in which prestress comes with the elements of a mesh, [point][6 or 9 components].
inline constexpr const char* prestress_array = "prestress";

/// Numbers for each point.
constexpr int components(PrestressKind kind) {
  return kind == PrestressKind::none ? 0 : kind == PrestressKind::stress ? voigt_size : 9;
}

/// Q^T S Q: global components to those in the axes that are the columns of Q.
template <class T>
TUNICA_INLINE Symmetric<T> in_axes(const Mat3<T>& Q, const Symmetric<T>& S) {
  return [&](const Mat3<T>& rotated) {
    Symmetric<T> result;
    for (int n = 0; n < voigt_size; ++n) result[n] = rotated(voigt_row[n], voigt_column[n]);
    return result;
  }(transpose(Q) * full(S) * Q);
}

/// Adds the force of S0 [Pa, axes of the gradients], (5.1).
template <class T>
TUNICA_INLINE void add_prestress_residual(const ElementState<T>& e, const Symmetric<T>& S0, fe::ElementVector<T>& r) {
  detail::add_unsplit_residual(e, deformation_gradient(e), S0, r);
}

/// Adds its geometric stiffness, (5.1).
template <class T>
TUNICA_INLINE void add_prestress_tangent(const ElementState<T>& e, const Symmetric<T>& S0, const Coefficients& c,
                                         fe::ElementMatrix<T>& m) {
  const T weight = T(c.displacement) * e.reference.volume;
#pragma GCC unroll 4
  for (int b = 0; b < fe::nodes; ++b) {
    const Vec3<T> s_b = weight * (S0 * e.reference.dN[b]);
#pragma GCC unroll 4
    for (int a = 0; a < fe::nodes; ++a) {
      const T stiffness = dot(e.reference.dN[a], s_b);
#pragma GCC unroll 3
      for (int i = 0; i < 3; ++i) m.k[a][b][i][i] += stiffness;
    }
  }
}

/// Energy of S0 for the motion from the imaged state [J]: V S0 : E, E = (C - I) / 2. Its derivative is (5.1).
template <class T>
TUNICA_INLINE T prestress_energy(const ElementState<T>& e, const Symmetric<T>& S0) {
  const Symmetric<T> C = right_cauchy_green(deformation_gradient(e));
  return T(0.5) * e.reference.volume * (double_dot(S0, C) - trace(S0));
}

/// Refers the element to its stress-free state, (5.2). F0: axes of the gradients on both sides.
template <class T>
TUNICA_INLINE void set_prestretch(ElementState<T>& e, const Mat3<T>& F0) {
  const Mat3<T> F0_transposed = transpose(F0);
#pragma GCC unroll 4
  for (int a = 0; a < fe::nodes; ++a) e.reference.dN[a] = F0_transposed * e.reference.dN[a];
  e.reference.volume = e.reference.volume / determinant(F0);
  e.axes = e.axes * F0;
}

}  // namespace tunica::wall
