#include "tunica/viewer/surface.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tunica/mesh/edge_nodes.hpp"
#include "tunica/mesh/generate.hpp"
#include "tunica/viewer/simplify.hpp"

namespace tunica::viewer {
namespace {

const FaceRoles with_wall = {{"lumen_wall"}, {"wall_inner"}, {}};

mesh::MeshData tube_of(double thickness) {
  mesh::TubeSizes sizes;
  sizes.radius = 0.01;
  sizes.length = 0.04;
  sizes.wall_thickness = thickness;
  sizes.cells_around = 16;
  sizes.cells_radial = 2;
  sizes.cells_along = 8;
  sizes.cells_through_wall = 2;
  return mesh::tube(sizes);
}

double area(const Body& body, const std::string& kind) {
  double sum = 0;
  for (const auto& g : body.groups)
    for (std::size_t t = g.first; g.kind == kind && t < g.first + g.count; ++t) {
      const auto& n = body.triangles[t];
      sum += 0.5 * norm(cross(body.points[n[1]] - body.points[n[0]], body.points[n[2]] - body.points[n[0]]));
    }
  return sum;
}

std::size_t count(const Body& body, const std::string& kind) {
  std::size_t sum = 0;
  for (const auto& g : body.groups) sum += g.kind == kind ? g.count : 0;
  return sum;
}

TEST(Surface, OfBloodAndWallIsThereOnce) {
  const auto data = tube_of(0.002);
  const auto s = surface_of(data, with_wall);
  EXPECT_EQ(count(s.body, "inner"), 2U * 16 * 8);
  EXPECT_EQ(count(s.body, "outer"), 2U * 16 * 8);
  EXPECT_EQ(count(s.body, "end"), 2U * 2 * 2 * 16);
  EXPECT_GT(count(s.body, "opening"), 0U);
  // Rings of 16 points, 9 along: of the outside with the one within each end, of the inside.
  EXPECT_EQ(s.blood_first, 16U * 9 + 2 * 16);
  EXPECT_EQ(s.inside_end - s.blood_first, 16U * 9);
  EXPECT_EQ(s.wall_end, s.inside_end);
  EXPECT_EQ(s.blood_end, s.body.points.size());
  EXPECT_EQ(s.wall.size(), s.wall_end);
  for (std::size_t i = 0; i < s.wall.size(); ++i)
    EXPECT_LT(norm(data.points[static_cast<std::size_t>(s.wall[i].a)] - s.body.points[i]), 1e-9);
}

TEST(Surface, OfARigidVesselHasAnInsideOfItsOwn) {
  auto data = tube_of(0);
  FaceRoles roles;
  roles.sticking = {"lumen_wall"};
  const auto s = surface_of(data, roles);
  EXPECT_EQ(count(s.body, "inner"), 2U * 16 * 8);
  EXPECT_EQ(count(s.body, "outer"), 0U);
  EXPECT_EQ(s.wall_end, 0U);
  EXPECT_EQ(s.inside_end, 16U * 9);
}

TEST(Sections, FillThePlane) {
  const auto data = tube_of(0.002);
  const auto s = sections_of(
      data, {{"half way", {{0, 0, 0.0201}}, {{0, 0, 1}}, 0}, {"inclined", {{0, 0, 0.02}}, {{0, 0.6, 0.8}}, 0}});
  ASSERT_EQ(s.body.groups.size(), 4U);
  const auto outer = surface_of(data, with_wall);
  // The polygon of the lumen at any height is that of its ends.
  const double lumen = area(outer.body, "opening") / 2, ring = area(outer.body, "end") / 2;
  EXPECT_NEAR(area(s.body, "section"), lumen * (1 + 1 / 0.8), 1e-9 * lumen + 1e-12);
  EXPECT_NEAR(area(s.body, "wall section"), ring * (1 + 1 / 0.8), 1e-9 * ring + 1e-12);
  // A linear function is met exactly.
  for (std::size_t i = 0; i < s.blood.size(); ++i) {
    const auto& p = s.blood[i];
    const auto x =
        (1 - p.t) * data.points[static_cast<std::size_t>(p.a)] + p.t * data.points[static_cast<std::size_t>(p.b)];
    EXPECT_LT(norm(x - s.body.points[s.blood_first + i]), 1e-12);
  }
}

TEST(Sections, StayNearTheirCentre) {
  const auto data = tube_of(0.002);
  const auto s = sections_of(data, {{"near", {{0.01, 0, 0.02}}, {{0, 1, 0}}, 0.006}});
  for (const auto& x : s.body.points) EXPECT_LT(norm(x - Vec3<double>{{0.01, 0, 0.02}}), 0.015);
  EXPECT_GT(s.body.points.size(), 0U);
}

/// A tube whose points are told apart by a quantity that is linear along it.
Body fine_tube() {
  Body body;
  body.name = "surface";
  const int around = 160, along = 100;
  Quantity q{"height", "mm", "wall", 1, 0, 0, {{}}};
  for (int k = 0; k <= along; ++k)
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * M_PI * i / around;
      body.points.push_back({{0.01 * std::cos(angle), 0.01 * std::sin(angle), 0.0004 * k}});
      q.frames[0].push_back(static_cast<float>(0.4 * k));
    }
  q.count = body.points.size();
  body.quantities.push_back(q);
  for (int k = 0; k < along; ++k)
    for (int i = 0; i < around; ++i) {
      const auto at = [&](int a, int b) { return static_cast<std::uint32_t>((k + b) * around + (i + a) % around); };
      body.triangles.push_back({at(0, 0), at(1, 0), at(1, 1)});
      body.triangles.push_back({at(0, 0), at(1, 1), at(0, 1)});
    }
  body.groups = {{"outer", "wall", 0, body.triangles.size()}};
  return body;
}

TEST(Simplify, KeepsTheDistanceAndMeasuresIt) {
  for (const double distance : {2e-5, 1e-4}) {
    Body body = fine_tube();
    const auto result = simplify(body, 2000, distance);
    EXPECT_LT(result.triangles, result.triangles_before / 2);
    EXPECT_EQ(result.triangles, body.triangles.size());
    EXPECT_GT(result.distance, 0.0);
    EXPECT_LT(result.distance, 1.5 * distance);  // the tool's measure is that of planes
    EXPECT_LT(result.deviations[0].most, 0.01);  // a linear function
  }
}

// Surfaces of quadratic elements: the triangles of the mesh come back, and what is between their corners is measured.
TEST(Simplify, PutsTrianglesInPlaceOfTheirParts) {
  auto data = tube_of(0.0);
  const auto corners = std::ssize(data.points);
  const auto as_meshed = surface_of(data, {});
  mesh::add_edge_nodes(data);
  auto surface = surface_of(mesh::subdivided(data), {});
  surface.body.joined = joined_triangles(surface, corners);
  ASSERT_EQ(surface.body.joined.size(), as_meshed.body.triangles.size());
  auto& body = surface.body;
  Quantity q{"square of z", "", "blood", 1, surface.blood_first, surface.blood_end - surface.blood_first, {{}}};
  for (std::size_t i = q.first; i < q.first + q.count; ++i)
    q.frames[0].push_back(static_cast<float>(1e4 * body.points[i][2] * body.points[i][2]));
  body.quantities = {q};
  const auto result = simplify(body, 1000000, 1e-4);
  EXPECT_EQ(4 * result.triangles, result.triangles_before);
  EXPECT_EQ(result.distance, 0.0);
  // (h/2)^2 of a range of L^2, h = L/8.
  EXPECT_NEAR(result.deviations.at(0).largest, 1.0 / 256, 1e-4);
  double area = 0, before = 0;
  const auto add = [](const Body& b, double& sum) {
    for (const auto& t : b.triangles)
      sum += 0.5 * norm(cross(b.points[t[1]] - b.points[t[0]], b.points[t[2]] - b.points[t[0]]));
  };
  add(body, area);
  add(as_meshed.body, before);
  EXPECT_NEAR(area, before, 1e-12);
  for (std::size_t g = 0; g < body.groups.size(); ++g) {
    EXPECT_EQ(body.groups[g].name, as_meshed.body.groups[g].name);
    EXPECT_EQ(body.groups[g].count, as_meshed.body.groups[g].count);
  }
}

TEST(Simplify, LeavesSmallSurfacesAlone) {
  Body body = fine_tube();
  const auto result = simplify(body, 100000, 1e-4);
  EXPECT_EQ(result.triangles, result.triangles_before);
  EXPECT_EQ(result.distance, 0.0);
}

TEST(Order, KeepsPointsWithTheirValues) {
  Body body = fine_tube();
  simplify(body, 5000, 1e-4);
  order(body);
  const auto& q = body.quantities[0];
  ASSERT_EQ(q.count, body.points.size());
  for (std::size_t i = 0; i < q.count; ++i) EXPECT_NEAR(q.frames[0][i], 1e3 * body.points[i][2], 1e-5);
  // Neighbours follow each other.
  double steps = 0;
  for (const auto& t : body.triangles) steps += std::abs(static_cast<double>(t[1]) - static_cast<double>(t[0]));
  EXPECT_LT(steps / static_cast<double>(body.triangles.size()), 200);
}

}  // namespace
}  // namespace tunica::viewer
