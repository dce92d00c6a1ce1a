#include "tunica/geometry/remesh.hpp"

#include <algorithm>
#include <cmath>

#include "small_surfaces.hpp"
#include "tunica/geometry/caps.hpp"
#include "tunica/geometry/self_intersections.hpp"
#include "tunica/geometry/size_field.hpp"

namespace tunica::geometry {
namespace {

using namespace test;

Remeshed remeshed(const TriangleSurface& surface, double size) {
  const Original original{TriangleTree(surface), find_creases(surface),
                          std::vector<double>(surface.points.size(), size)};
  return remesh({surface, original.creases}, original);
}

/// Volume of a tube along z, closed by discs: its ends are plane.
double tube_volume(const TriangleSurface& surface) {
  auto closed = surface;
  for (const auto& loop : boundary_loops(surface)) {
    std::vector<Point> rim;
    for (const auto p : loop) rim.push_back(surface.points[p]);
    append(closed, plane_cap(rim, {}, {{0, 0, rim[0][2] > 1e-3 ? 1.0 : -1.0}}));
  }
  return enclosed_volume(closed);
}

TEST(Remesh, EdgesGetTheWantedLength) {
  const auto surface = tube(5e-3, 20e-3, 120, 60);
  const auto mesh = remeshed(surface, 1e-3).surface;
  EXPECT_GT(smallest_angle_degrees(mesh), 25);
  double mean = 0;
  const auto all = edges(mesh);
  for (const auto& e : all) {
    const double length = norm(mesh.points[e.a] - mesh.points[e.b]);
    mean += length / static_cast<double>(all.size());
    EXPECT_LT(length, 1.6e-3);
    EXPECT_GT(length, 0.5e-3);
  }
  EXPECT_NEAR(mean, 1e-3, 0.15e-3);
}

TEST(Remesh, KeepsVolumeRimsAndTopology) {
  const auto surface = tube(5e-3, 20e-3, 120, 60);
  const auto mesh = remeshed(surface, 2e-3).surface;
  // Inscribed, the volume would be 2.6 % too small.
  EXPECT_NEAR(tube_volume(mesh) / (M_PI * 25e-6 * 20e-3), 1, 2e-3);
  const auto loops = boundary_loops(mesh);
  EXPECT_EQ(loops.size(), 2u);
  EXPECT_EQ(genus(mesh, 2), 0);
  for (const auto& loop : loops)
    for (const auto p : loop) EXPECT_NEAR(std::abs(mesh.points[p][2] - 10e-3), 10e-3, 1e-12);
}

TEST(Remesh, RimsStayPlaneBesideCreases) {
  // A ridge along the tube: its crest is a crease that runs into both rims at a slant.
  auto surface = tube(5e-3, 20e-3, 120, 60, 0);
  for (auto& p : surface.points) {
    const double angle = std::atan2(p[1], p[0]) - 40 * p[2];
    const double height = std::max(0.0, 1.5e-3 * (1 - std::abs(std::sin(0.5 * angle)) / 0.1));
    const double factor = 1 + height / std::hypot(p[0], p[1]);
    p[0] *= factor;
    p[1] *= factor;
  }
  ASSERT_GT(find_creases(surface).size(), 20u);
  for (const double size : {0.7e-3, 1.5e-3, 2.5e-3}) {
    const auto mesh = remeshed(surface, size).surface;
    for (const auto& loop : boundary_loops(mesh))
      for (const auto p : loop) EXPECT_NEAR(std::abs(mesh.points[p][2] - 10e-3), 10e-3, 1e-12) << size;
  }
}

TEST(Remesh, NoTriangleHasItsCornersOnARimAlone) {
  // Such a triangle lies in the plane of the opening.
  auto surface = tube(5e-3, 20e-3, 60, 30);
  surface.points.push_back({{5.2e-3, 0, 0}});
  surface.triangles.push_back({1, 0, std::ssize(surface.points) - 1});
  const auto mesh = remeshed(surface, 1.5e-3).surface;
  std::vector<bool> on_rim(mesh.points.size(), false);
  for (const auto& loop : boundary_loops(mesh))
    for (const auto p : loop) on_rim[p] = true;
  for (const auto& t : mesh.triangles) EXPECT_FALSE(on_rim[t[0]] && on_rim[t[1]] && on_rim[t[2]]);
}

TEST(Remesh, FollowsSizesThatVary) {
  const auto surface = tube(5e-3, 30e-3, 120, 90);
  std::vector<double> sizes;
  for (const auto& p : surface.points) sizes.push_back(0.5e-3 + p[2] / 20);
  const auto mesh = remesh({surface, {}}, {TriangleTree(surface), {}, sizes}).surface;
  EXPECT_GT(smallest_angle_degrees(mesh), 20);
  for (const auto& e : edges(mesh)) {
    const double wanted = 0.5e-3 + 0.5 * (mesh.points[e.a][2] + mesh.points[e.b][2]) / 20;
    EXPECT_LT(norm(mesh.points[e.a] - mesh.points[e.b]), 1.8 * wanted);
  }
}

TEST(Remesh, KeepsCreases) {
  auto square = tube(5e-3, 20e-3, 64, 32, 0);
  for (auto& p : square.points) {
    const double stretch = 5e-3 / std::max(std::abs(p[0]), std::abs(p[1]));
    p[0] *= stretch;
    p[1] *= stretch;
  }
  EXPECT_GT(find_creases(square).size(), 100u);
  for (const double size : {1.5e-3, 0.4e-3}) {  // coarser and finer than it is
    const auto mesh = remeshed(square, size);
    double length = 0;
    for (const auto& [a, b] : mesh.creases) {
      length += norm(mesh.surface.points[a] - mesh.surface.points[b]);
      for (const auto p : {a, b}) {
        EXPECT_NEAR(std::abs(mesh.surface.points[p][0]), 5e-3, 1e-9);
        EXPECT_NEAR(std::abs(mesh.surface.points[p][1]), 5e-3, 1e-9);
      }
    }
    EXPECT_NEAR(length, 4 * 20e-3, 1e-9);
    EXPECT_NEAR(tube_volume(mesh.surface), 1e-4 * 20e-3, 1e-9);
  }
}

// A hole with a sharp rim: a polygon on its circle would be up to 9 % too small.
TEST(Remesh, KeepsTheAreaOfSharpHoles) {
  constexpr double wide = 5e-3, hole = 2e-3, plate = 8e-3;  // m
  auto surface = tube(wide, 20e-3, 96, 80, 0);
  for (auto& p : surface.points) {
    const double along = p[2], radius = std::clamp(wide + plate - along, hole, wide);
    p = {{p[0] * radius / wide, p[1] * radius / wide, along < plate ? along : std::max(plate, along - wide + hole)}};
  }
  const auto mesh = remeshed(surface, 1.5e-3);
  double area = 0;
  int points = 0;
  for (const auto& [a, b] : mesh.creases) {
    const auto &p = mesh.surface.points[a], &q = mesh.surface.points[b];
    if (std::hypot(p[0], p[1]) > 0.5 * (wide + hole)) continue;
    area += 0.5 * std::abs(p[0] * q[1] - p[1] * q[0]);
    ++points;
  }
  EXPECT_LT(points, 16);
  EXPECT_NEAR(area / (M_PI * hole * hole), 1, 4e-3);
}

TEST(Remesh, EachSideOfAThinSheetStaysOnItsOwn) {
  // Two tubes 0.05 mm apart, the outer one turned inside out; edges of 1.5 mm leave them by as much.
  auto surface = tube(5e-3, 10e-3, 90, 40);
  auto outer = tube(5.05e-3, 10e-3, 90, 40);
  for (auto& triangle : outer.triangles) std::swap(triangle[0], triangle[1]);
  append(surface, outer);
  const auto mesh = remeshed(surface, 1.5e-3).surface;
  const auto part = components(mesh);
  for (const auto& [number, radius] : {std::pair{0, 5e-3}, std::pair{1, 5.05e-3}}) {
    TriangleSurface one{mesh.points, {}};
    for (std::size_t k = 0; k < part.size(); ++k)
      if (part[k] == number) one.triangles.push_back(mesh.triangles[k]);
    drop_unused_points(one);
    if (number == 1)
      for (auto& triangle : one.triangles) std::swap(triangle[0], triangle[1]);
    EXPECT_NEAR(tube_volume(one) / (M_PI * radius * radius * 10e-3), 1, 4e-3);  // a radius apart by 0.01 mm
  }
}

TEST(Remesh, BothSidesOfAThinFlapStayApart) {
  const auto surface = dissected_tube();
  ASSERT_EQ(genus(surface, 2), 1);
  const auto mesh = remeshed(surface, 3e-3).surface;  // coarser than the flap is thick
  EXPECT_EQ(genus(mesh, 2), 1);
  EXPECT_TRUE(crossing_triangles(mesh).empty());
  const TriangleTree tree(mesh);
  for (const auto& x : {Point{{2e-3, 0, 0}}, Point{{-2e-3, 0, 0}}}) EXPECT_NEAR(tree.nearest(x).distance, 1e-3, 0.2e-3);
}

TEST(CrossingTriangles, FoundAmongTouchingOnes) {
  EXPECT_TRUE(crossing_triangles(tube(1, 2, 16, 8)).empty());
  TriangleSurface two{{{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}, {{0.2, 0.2, -1}}, {{0.2, 0.2, 1}}, {{2, 2, 0}}},
                      {{0, 1, 2}, {3, 4, 5}}};
  EXPECT_EQ(crossing_triangles(two).size(), 1u);
  two.triangles[1] = {0, 3, 4};  // through a shared corner
  EXPECT_EQ(crossing_triangles(two).size(), 1u);
  for (auto& p : two.points) p = -1.0 * p;  // so that they are met in the other order
  EXPECT_EQ(crossing_triangles(two).size(), 1u);
  for (auto& p : two.points) p = -1.0 * p;
  two.triangles[1] = {0, 1, 3};
  EXPECT_TRUE(crossing_triangles(two).empty());
  two.points[3] = {{0.3, 0.3, 0}};  // folded onto the first
  EXPECT_EQ(crossing_triangles(two).size(), 1u);
}

}  // namespace
}  // namespace tunica::geometry
