// Consistent masses of the quadratic tetrahedron and triangle with straight edges, as means of N_a N_b over the
// element.
#pragma once

#include "tunica/fe/quadratic_tetrahedron.hpp"
#include "tunica/fe/quadratic_triangle.hpp"

namespace tunica::fe {

namespace detail {

/// How many corners two nodes have in common; a corner is the end of itself.
constexpr int shared_ends(const int (&a)[2], bool a_is_edge, const int (&b)[2], bool b_is_edge) {
  int n = 0;
  for (int i = 0; i < (a_is_edge ? 2 : 1); ++i)
    for (int j = 0; j < (b_is_edge ? 2 : 1); ++j) n += a[i] == b[j] ? 1 : 0;
  return n;
}

}  // namespace detail

/// Of the tetrahedron. All entries add up to one.
inline constexpr std::array<std::array<double, 10>, 10> quadratic_mass = [] {
  const double corners[2] = {1, 6}, mixed[2] = {-6, -4}, edges[3] = {8, 16, 32};  // by the number of common ends
  std::array<std::array<double, 10>, 10> m{};
  for (int a = 0; a < 10; ++a)
    for (int b = 0; b < 10; ++b) {
      const int n = detail::shared_ends(gradient_of[a], a >= 4, gradient_of[b], b >= 4);
      m[a][b] = (a < 4 && b < 4 ? corners[n] : a < 4 || b < 4 ? mixed[n] : edges[n]) / 420.0;
    }
  return m;
}();

/// Of the triangle, corners first, then the edges 01 12 20. All entries add up to one.
inline constexpr std::array<std::array<double, 6>, 6> quadratic_triangle_mass = [] {
  constexpr int ends[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};
  const double corners[2] = {-1, 6}, mixed[2] = {-4, 0}, edges[3] = {0, 16, 32};
  std::array<std::array<double, 6>, 6> m{};
  for (int a = 0; a < 6; ++a)
    for (int b = 0; b < 6; ++b) {
      const int n = detail::shared_ends(ends[a], a >= 3, ends[b], b >= 3);
      m[a][b] = (a < 3 && b < 3 ? corners[n] : a < 3 || b < 3 ? mixed[n] : edges[n]) / 180.0;
    }
  return m;
}();

}  // namespace tunica::fe
