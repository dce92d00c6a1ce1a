// Taubin's filter: on bodies whose points are eigenvectors of the mean over neighbours it multiplies by eq. (9.3), and
// elsewhere it takes noise and leaves volume.
#include "tunica/imaging/surface_smoothing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "tunica/geometry/self_intersections.hpp"

namespace tunica::imaging {
namespace {

using geometry::TriangleSurface;

const TriangleSurface tetrahedron{{{{1, 1, 1}}, {{1, -1, -1}}, {{-1, 1, -1}}, {{-1, -1, 1}}},
                                  {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}};

const TriangleSurface octahedron{
    {{{1, 0, 0}}, {{-1, 0, 0}}, {{0, 1, 0}}, {{0, -1, 0}}, {{0, 0, 1}}, {{0, 0, -1}}},
    {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};

/// Each triangle in four, all points on the unit sphere.
TriangleSurface refined(const TriangleSurface& from) {
  TriangleSurface to{from.points, {}};
  std::map<std::pair<std::int64_t, std::int64_t>, std::int64_t> middles;
  const auto middle = [&](std::int64_t a, std::int64_t b) {
    const auto [found, is_new] = middles.emplace(std::minmax(a, b), std::ssize(to.points));
    if (is_new) {
      const auto sum = to.points[static_cast<std::size_t>(a)] + to.points[static_cast<std::size_t>(b)];
      to.points.push_back((1 / norm(sum)) * sum);
    }
    return found->second;
  };
  for (const auto& [a, b, c] : from.triangles) {
    const auto ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const auto& t : {geometry::Triangle{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}})
      to.triangles.push_back(t);
  }
  return to;
}
TriangleSurface sphere(int times) {
  auto surface = octahedron;
  for (int k = 0; k < times; ++k) surface = refined(surface);
  return surface;
}

TEST(SurfaceSmoothing, MultipliesEachWaveByItsTransfer) {
  // 1 minus the mean over neighbours is 4/3 on the tetrahedron and 1 on the octahedron.
  for (const auto& [body, k] : {std::pair{tetrahedron, 4.0 / 3}, std::pair{octahedron, 1.0}}) {
    const double transfer = (1 - 0.5 * k) * (1 + 0.52 * k);
    for (const int sweeps : {1, 3}) {
      auto surface = body;
      smooth_surface(surface, sweeps);
      for (std::size_t p = 0; p < body.points.size(); ++p)
        EXPECT_NEAR(norm(surface.points[p] - std::pow(transfer, sweeps) * body.points[p]), 0, 1e-14);
    }
  }
}

/// On a torus of n by m points, each with six neighbours, waves around it are eigenvectors whatever the points are:
/// they are numbers on a graph to the filter.
TEST(SurfaceSmoothing, LongWavesPassAndShortOnesVanish) {
  constexpr std::int64_t n = 60, m = 48;
  TriangleSurface torus;
  for (std::int64_t i = 0; i < n; ++i)
    for (std::int64_t j = 0; j < m; ++j) {
      const auto node = [&](std::int64_t a, std::int64_t b) { return (a % n) * m + b % m; };
      torus.triangles.push_back({node(i, j), node(i + 1, j), node(i, j + 1)});
      torus.triangles.push_back({node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)});
    }
  for (const auto& [a, b] : {std::pair{1, 0}, {2, 1}, {0, 4}, {5, 5}, {12, 3}, {30, 0}, {20, 16}}) {
    const double u = 2 * std::numbers::pi * a / n, v = 2 * std::numbers::pi * b / m;
    torus.points.clear();
    for (std::int64_t i = 0; i < n; ++i)
      for (std::int64_t j = 0; j < m; ++j) {
        const double phase = u * static_cast<double>(i) + v * static_cast<double>(j);
        torus.points.push_back({{std::cos(phase), std::sin(phase), 5}});
      }
    auto surface = torus;
    smooth_surface(surface, 80);
    // Neighbours: (1, 0), (0, 1), (1, -1) and the opposite ones.
    const double k = 1 - (std::cos(u) + std::cos(v) + std::cos(u - v)) / 3;
    const double transfer = std::pow((1 - 0.5 * k) * (1 + 0.52 * k), 80);
    for (std::size_t p = 0; p < torus.points.size(); ++p) {
      const auto& x = torus.points[p];
      EXPECT_NEAR(norm(surface.points[p] - Vec3<double>{{transfer * x[0], transfer * x[1], 5}}), 0, 1e-11);
    }
    if (k < 0.077) {
      EXPECT_NEAR(transfer, 1, 0.035) << a << " " << b;
    }
    if (k > 0.5) {
      EXPECT_LT(std::abs(transfer), 0.01) << a << " " << b;
    }
  }
}

TEST(SurfaceSmoothing, TakesNoiseAndLeavesVolume) {
  auto surface = sphere(5);
  const double volume = geometry::enclosed_volume(surface);
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0, 0.01);
  for (auto& p : surface.points) p = (1 + noise(random)) * p;
  const auto roughness = [&] {  // of neighbours, against each other
    double square = 0;
    const auto all = geometry::edges(surface);
    for (const auto& e : all)
      square += std::pow(norm(surface.points[static_cast<std::size_t>(e.a)]) -
                             norm(surface.points[static_cast<std::size_t>(e.b)]),
                         2) /
                static_cast<double>(all.size());
    return std::sqrt(square);
  };
  const double before = roughness();
  smooth_surface(surface, 80);
  EXPECT_LT(roughness(), 0.2 * before);
  EXPECT_NEAR(geometry::enclosed_volume(surface) / volume, 1, 0.01);
}

/// Noise that is smooth over some edges, as that of labels: the first filter leaves it.
TriangleSurface rough_sphere(double deviation, double& volume) {
  auto surface = sphere(6);
  volume = geometry::enclosed_volume(surface);
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  std::vector<double> height(surface.points.size());
  for (auto& h : height) h = normal(random);
  geometry::average_over_neighbours(surface, 6, height);
  double square = 0;
  for (const double h : height) square += h * h / static_cast<double>(height.size());
  for (std::size_t p = 0; p < height.size(); ++p)
    surface.points[p] = (1 + deviation * height[p] / std::sqrt(square)) * surface.points[p];
  return surface;
}

TEST(SurfaceSmoothing, TellsTheNoiseOfLabelsFromTheShapeOfVessels) {
  double volume = 0;
  EXPECT_LT(roughness(sphere(6)), 5e-4);
  auto surface = rough_sphere(0.01, volume);
  const double before = roughness(surface);
  EXPECT_GT(before, 0.004);
  EXPECT_LT(before, 0.011);
  smooth_rough_surface(surface, 3 * before);
  EXPECT_LT(roughness(surface), 0.35 * before);
  EXPECT_NEAR(geometry::enclosed_volume(surface) / volume, 1, 0.003);
}

TEST(SurfaceSmoothing, NoPointMovesFartherThanItMay) {
  double volume = 0;
  const auto rough = rough_sphere(0.01, volume);
  auto surface = rough;
  smooth_rough_surface(surface, 0.002);
  double farthest = 0;
  for (std::size_t p = 0; p < rough.points.size(); ++p)
    farthest = std::max(farthest, norm(surface.points[p] - rough.points[p]));
  EXPECT_NEAR(farthest, 0.002, 1e-9);
}

TEST(SurfaceSmoothing, PointsGoBackWhereTrianglesWouldCross) {
  // Two spheres apart, and the second one pushed into the first one on the near side.
  auto before = sphere(3), other = sphere(3);
  for (auto& p : other.points) p = p + Vec3<double>{{2.05, 0, 0}};
  geometry::append(before, other);
  auto surface = before;
  for (std::size_t p = surface.points.size() / 2; p < surface.points.size(); ++p)
    if (surface.points[p][0] < 1.5) surface.points[p][0] -= 0.08;
  ASSERT_FALSE(geometry::crossing_triangles(surface).empty());
  const auto moved = untangle(surface, before.points, 0.02);
  EXPECT_TRUE(geometry::crossing_triangles(surface).empty());
  EXPECT_GT(moved, 0);
  // A wall of 0.02 is left between them.
  double nearest = 1;
  const auto half = surface.points.size() / 2;
  for (std::size_t p = 0; p < half; ++p)
    for (std::size_t q = half; q < 2 * half; ++q)
      nearest = std::min(nearest, norm(surface.points[p] - surface.points[q]));
  EXPECT_GT(nearest, 0.015);
  EXPECT_LT(moved, std::ssize(surface.points) / 4);
}

TEST(SurfaceSmoothing, MovesWithTheSurface) {
  auto surface = sphere(2);
  for (auto& p : surface.points) p = (1 + 0.1 * std::sin(9 * p[0] + 4 * p[1])) * p;
  const double c = std::cos(0.7), s = std::sin(0.7);
  const auto move = [&](const Vec3<double>& p) {
    return Vec3<double>{{c * p[0] - s * p[2] + 3, p[1] - 8, s * p[0] + c * p[2] + 1}};
  };
  auto moved = surface;
  for (auto& p : moved.points) p = move(p);
  smooth_surface(surface, 10);
  smooth_surface(moved, 10);
  for (std::size_t p = 0; p < surface.points.size(); ++p)
    EXPECT_NEAR(norm(moved.points[p] - move(surface.points[p])), 0, 1e-12);
}

}  // namespace
}  // namespace tunica::imaging
