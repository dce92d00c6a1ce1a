// Mesh motion: linear elasticity on the initial mesh, stiffened where elements are small (section 3 of the theory).
//
// The extension is linear and refers to the initial mesh, so the mesh is a function of the wall position alone: the
// matrix is assembled and factorised once, and a wall that returns brings the mesh back too. All functions are
// templated on T = double, Dual or Pack.
#pragma once

#include "tunica/ale/parameters.hpp"
#include "tunica/fe/tetrahedron.hpp"

namespace tunica::ale {

/// Stiffness of an element: [row node][column node], each a 3 x 3 block [row component][column component].
template <class T>
struct StiffnessMatrix {
  Mat3<T> k[fe::nodes][fe::nodes];
};

/// Element stiffness, K_ab = s vol [lambda grad N_a (x) grad N_b + mu (grad N_b (x) grad N_a + grad N_a.grad N_b I)],
/// with s = (mean_volume / volume)^chi (Stein, Tezduyar & Benney 2003; the Jacobian is six times the volume) and
/// Young's modulus 1 Pa, as only ratios matter [N/m]. `position`: initial nodes [m]; `mean_volume`: of the whole
/// initial mesh [m^3], so that s is of order one.
template <class T>
TUNICA_INLINE void stiffness(const Vec3<T> (&position)[fe::nodes], double mean_volume, const Parameters& parameters,
                             StiffnessMatrix<T>& matrix) {
  const fe::Gradients<T> shape = fe::gradients(position);
  const double nu = parameters.poisson_ratio, chi = parameters.stiffening_exponent;
  const T ratio = T(mean_volume) / shape.volume;
  const T scale = shape.volume * (chi == 0.0 ? T(1.0) : chi == 1.0 ? ratio : pow(ratio, chi));
  const T mu = scale * T(0.5 / (1.0 + nu)), lambda = scale * T(nu / ((1.0 + nu) * (1.0 - 2.0 * nu)));
  for (int a = 0; a < fe::nodes; ++a)
    for (int b = 0; b < fe::nodes; ++b) {
      const Vec3<T>&dNa = shape.dN[a], &dNb = shape.dN[b];
      const T diagonal = mu * dot(dNa, dNb);
      Mat3<T>& block = matrix.k[a][b];
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) block(i, j) = lambda * dNa[i] * dNb[j] + mu * dNb[i] * dNa[j];
      for (int i = 0; i < 3; ++i) block(i, i) += diagonal;
    }
}

/// Scaled Jacobian of a tetrahedron: sqrt(2) det over the largest product of the three edges that meet at a node
/// (Knupp 2000). 1 for the regular tetrahedron, 0 where it is flat, negative where it is inverted.
template <class T>
TUNICA_INLINE T scaled_jacobian(const Vec3<T> (&x)[fe::nodes]) {
  const auto squared_edge = [&x](int a, int b) {
    const Vec3<T> e = x[b] - x[a];
    return dot(e, e);
  };
  const T s01 = squared_edge(0, 1), s02 = squared_edge(0, 2), s03 = squared_edge(0, 3);
  const T s12 = squared_edge(1, 2), s13 = squared_edge(1, 3), s23 = squared_edge(2, 3);
  const T largest = max(max(s01 * s02 * s03, s01 * s12 * s13), max(s02 * s12 * s23, s03 * s13 * s23));
  const T det = dot(cross(x[1] - x[0], x[2] - x[0]), x[3] - x[0]);
  return T(1.4142135623730951) * det / sqrt(largest);
}

/// Scaled Jacobian of the moved element relative to that of the initial one.
template <class T>
TUNICA_INLINE T relative_quality(const Vec3<T> (&initial)[fe::nodes], const Vec3<T> (&current)[fe::nodes]) {
  return scaled_jacobian(current) / scaled_jacobian(initial);
}

/// True (for a pack: lane by lane) where the motion has spoilt an element beyond what the parameters admit; a NaN
/// counts. `quality`: see relative_quality.
template <class T>
TUNICA_INLINE auto is_degenerate(const T& quality, const Parameters& parameters) {
  return select(quality > T(parameters.minimum_quality), T(1.0), T(0.0)) < T(0.5);
}

}  // namespace tunica::ale
