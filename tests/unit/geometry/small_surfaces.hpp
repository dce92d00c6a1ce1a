// Surfaces of a few thousand triangles for the tests of the meshing stage.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include "text.hpp"
#include "tunica/base/error.hpp"
#include "tunica/geometry/contour.hpp"
#include "tunica/geometry/plane_cut.hpp"
#include "tunica/geometry/triangle_surface.hpp"

namespace tunica::geometry::test {

using tunica::test::message_of;

/// An open tube along z with outward normals, its corners on the circle; every other row is turned by `shift` of a
/// step.
inline TriangleSurface tube(double radius, double length, int around, int along, double shift = 0.5) {
  TriangleSurface surface;
  for (int k = 0; k <= along; ++k)
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * M_PI * (i + shift * (k % 2)) / around;
      surface.points.push_back({{radius * std::cos(angle), radius * std::sin(angle), length * k / along}});
    }
  for (int k = 0; k < along; ++k)
    for (int i = 0; i < around; ++i) {
      const std::int64_t a = k * around + i, b = k * around + (i + 1) % around, c = a + around, d = b + around;
      if (k % 2 == 0) {
        surface.triangles.push_back({a, b, c});
        surface.triangles.push_back({b, d, c});
      } else {
        surface.triangles.push_back({a, d, c});
        surface.triangles.push_back({a, b, d});
      }
    }
  return surface;
}

/// Contour of value 0 of `value` in the box around the origin with half sizes `half`.
template <class Function>
TriangleSurface contour(const Vec3<double>& half, double spacing, const Function& value) {
  Grid grid{-1.0 * half, spacing, {}, {}};
  for (int d = 0; d < 3; ++d) grid.size[d] = static_cast<std::int64_t>(2 * half[d] / spacing) + 1;
  for (std::int64_t k = 0; k < grid.size[2]; ++k)
    for (std::int64_t j = 0; j < grid.size[1]; ++j)
      for (std::int64_t i = 0; i < grid.size[0]; ++i)
        grid.values.push_back(static_cast<float>(value(grid.place(i, j, k))));
  return zero_surface(grid);
}

/// A tube of 10 mm radius and 60 mm length, open at both ends, that a flap of 2 mm with round rims parts over its
/// middle 30 mm: two lumens that communicate above and below, genus 1.
inline TriangleSurface dissected_tube() {
  auto surface = contour({{13e-3, 13e-3, 38e-3}}, 0.93e-3, [](const Point& x) {
    const double vessel = std::max(std::hypot(x[0], x[1]) - 10e-3, std::abs(x[2]) - 34e-3);
    const double flap = std::hypot(x[0], std::max(std::abs(x[2]) - 14e-3, 0.0)) - 1e-3;
    return std::max(vessel, -flap);
  });
  surface = cut_end(surface, {{{0, 0, 30e-3}}, {{0, 0, 1}}, 14e-3});
  return cut_end(surface, {{{0, 0, -30e-3}}, {{0, 0, -1}}, 14e-3});
}

/// True and false lumen as two surfaces: an open tube and a closed lumen beside it, both of radius 4 mm, 2 mm apart.
inline TriangleSurface two_lumens() {
  auto lumen = tube(4e-3, 24e-3, 40, 26);
  for (auto& p : lumen.points) p = p - Vec3<double>{{5e-3, 0, 12e-3}};
  auto closed = contour({{5e-3, 5e-3, 12e-3}}, 0.7e-3, [](const Point& x) {
    return std::hypot(x[0], x[1], std::max(std::abs(x[2]) - 6e-3, 0.0)) - 4e-3;
  });
  for (auto& p : closed.points) p[0] += 5e-3;
  append(lumen, closed);
  return lumen;
}

inline double smallest_angle_degrees(const TriangleSurface& surface) {
  double smallest = M_PI;
  for (const auto& t : surface.triangles) smallest = std::min(smallest, smallest_angle(surface, t));
  return smallest * 180 / M_PI;
}

inline bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// A folder of this test, removed at its end.
class Folder {
 public:
  Folder() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    path = std::filesystem::temp_directory_path() /
           ("tunica_" + std::to_string(getpid()) + "_" + test->test_suite_name() + "_" + test->name());
    std::filesystem::create_directories(path);
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::filesystem::path path;
};

}  // namespace tunica::geometry::test
