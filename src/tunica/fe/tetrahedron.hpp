// The linear tetrahedron: constant shape-function gradients, and the arrays that element kernels exchange.
#pragma once

#include "tunica/base/tensor.hpp"

namespace tunica::fe {

inline constexpr int nodes = 4;       ///< nodes of a linear tetrahedron
inline constexpr int components = 4;  ///< unknowns per node: v_x, v_y, v_z, p

/// Residual of an element: [node][component].
template <class T>
struct ElementVector {
  T r[nodes][components];
};

/// Tangent of an element: [row node][column node][row component][column component], so that each 4 x 4 node block is
/// contiguous.
template <class T>
struct ElementMatrix {
  T k[nodes][nodes][components][components];
};

/// Gradients of the four shape functions and the volume.
template <class T>
struct Gradients {
  Vec3<T> dN[nodes];  ///< 1/m
  T volume;           ///< m^3, negative where the element is inverted
};

/// Shape-function gradients from node positions [m]. The element is positive when (x1-x0, x2-x0, x3-x0) is
/// right-handed, as in VTK.
template <class T>
TUNICA_INLINE Gradients<T> gradients(const Vec3<T> (&x)[nodes]) {
  Mat3<T> jacobian;  // columns: edges from node 0
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) jacobian(i, j) = x[j + 1][i] - x[0][i];
  const T det = determinant(jacobian);
  const Mat3<T> inv = (T(1.0) / det) * adjugate(jacobian);
  Gradients<T> g;
  for (int a = 0; a < 3; ++a)
    for (int i = 0; i < 3; ++i) g.dN[a + 1][i] = inv(a, i);
  for (int i = 0; i < 3; ++i) g.dN[0][i] = -(g.dN[1][i] + g.dN[2][i] + g.dN[3][i]);
  g.volume = det * T(1.0 / 6.0);
  return g;
}

/// Quadrature on the tetrahedron: barycentric coordinates and weights that sum to one.
struct QuadraturePoint {
  double barycentric[nodes];
  double weight;
};

/// Four points, exact for polynomials of degree 2 (Hammer & Stroud 1956).
inline constexpr QuadraturePoint four_points[4] = {
    {{0.5854101966249685, 0.1381966011250105, 0.1381966011250105, 0.1381966011250105}, 0.25},
    {{0.1381966011250105, 0.5854101966249685, 0.1381966011250105, 0.1381966011250105}, 0.25},
    {{0.1381966011250105, 0.1381966011250105, 0.5854101966249685, 0.1381966011250105}, 0.25},
    {{0.1381966011250105, 0.1381966011250105, 0.1381966011250105, 0.5854101966249685}, 0.25}};

/// Quadrature on the triangle, exact for degree 2: edge-interior points.
struct TrianglePoint {
  double barycentric[3];
  double weight;
};
inline constexpr TrianglePoint three_points[3] = {{{2.0 / 3, 1.0 / 6, 1.0 / 6}, 1.0 / 3},
                                                  {{1.0 / 6, 2.0 / 3, 1.0 / 6}, 1.0 / 3},
                                                  {{1.0 / 6, 1.0 / 6, 2.0 / 3}, 1.0 / 3}};

}  // namespace tunica::fe
