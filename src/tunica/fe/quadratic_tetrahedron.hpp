// The quadratic tetrahedron with straight edges: corners 0-3, then nodes in the middle of the edges 01 12 02 03 13 23,
// the order of VTK_QUADRATIC_TETRA. Velocity and displacement are quadratic, pressure is linear (Taylor & Hood 1973).
//
// With barycentric coordinates l_a and their constant gradients g_a,
//   corner a: N = l_a (2 l_a - 1), grad N = (4 l_a - 1) g_a;   edge ab: N = 4 l_a l_b, grad N = 4 (l_a g_b + l_b g_a).
#pragma once

#include <array>

#include "tunica/fe/tetrahedron.hpp"

namespace tunica::fe {

inline constexpr int quadratic_nodes = 10;
inline constexpr int edge_ends[6][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};

/// A point of a quadrature rule with what the shape functions have there that does not depend on the element.
struct QuadraticPoint {
  double barycentric[4];
  double weight;        ///< all weights sum to one
  double N[10];         ///< shape functions
  double slope[10][2];  ///< grad N_a = slope[a][0] g_first(a) + slope[a][1] g_second(a)
};

/// Barycentric coordinates whose gradients make up that of N_a: corners have one (named twice).
inline constexpr int gradient_of[10][2] = {{0, 0}, {1, 1}, {2, 2}, {3, 3}, {0, 1},
                                           {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};

constexpr QuadraticPoint quadratic_point(const std::array<double, 4>& l, double weight) {
  QuadraticPoint p{};
  p.weight = weight;
  for (int a = 0; a < 4; ++a) {
    p.barycentric[a] = l[a];
    p.N[a] = l[a] * (2 * l[a] - 1);
    p.slope[a][0] = 4 * l[a] - 1;
    p.slope[a][1] = 0;
  }
  for (int e = 0; e < 6; ++e) {
    const int a = edge_ends[e][0], b = edge_ends[e][1];
    p.N[4 + e] = 4 * l[a] * l[b];
    p.slope[4 + e][0] = 4 * l[b];
    p.slope[4 + e][1] = 4 * l[a];
  }
  return p;
}

/// Four points, exact for degree 2: stiffness of constant coefficients.
inline constexpr std::array<QuadraticPoint, 4> quadratic_four_points = [] {
  std::array<QuadraticPoint, 4> rule{};
  for (int q = 0; q < 4; ++q) {
    const auto& p = four_points[q].barycentric;
    rule[q] = quadratic_point({p[0], p[1], p[2], p[3]}, four_points[q].weight);
  }
  return rule;
}();

/// Fourteen points, exact for degree 5 (Walkington 2000): convection.
inline constexpr std::array<QuadraticPoint, 14> quadratic_fourteen_points = [] {
  std::array<QuadraticPoint, 14> rule{};
  int q = 0;
  const double corner[2][2] = {{0.31088591926330060980, 0.11268792571801585080},
                               {0.092735250310891226402, 0.073493043116361949544}};
  for (const auto& [a, w] : corner)
    for (int i = 0; i < 4; ++i) {
      std::array<double, 4> l{a, a, a, a};
      l[i] = 1 - 3 * a;
      rule[q++] = quadratic_point(l, w);
    }
  const double a = 0.045503704125649649492, w = 0.042546020777081466438;
  for (int i = 0; i < 4; ++i)
    for (int j = i + 1; j < 4; ++j) {
      std::array<double, 4> l{0.5 - a, 0.5 - a, 0.5 - a, 0.5 - a};
      l[i] = l[j] = a;
      rule[q++] = quadratic_point(l, w);
    }
  return rule;
}();

/// Gradient of the shape function a at a point.
template <class T>
TUNICA_INLINE Vec3<T> quadratic_gradient(const Vec3<T> (&g)[4], const QuadraticPoint& point, int a) {
  const Vec3<T>&first = g[gradient_of[a][0]], &second = g[gradient_of[a][1]];
  Vec3<T> result;
  for (int i = 0; i < 3; ++i)
    result[i] = T(point.slope[a][0]) * first[i] + (a < 4 ? T(0.0) : T(point.slope[a][1]) * second[i]);
  return result;
}

}  // namespace tunica::fe
