// Areas, volumes, edges and cuts of bodies that are known exactly.
#include "tunica/geometry/triangle_surface.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>
#include <set>

#include "small_surfaces.hpp"
#include "tunica/geometry/contour.hpp"
#include "tunica/geometry/plane_cut.hpp"
#include "tunica/geometry/tetrahedra.hpp"
#include "tunica/mesh/boundary.hpp"
#include "tunica/mesh/generate.hpp"

namespace tunica::geometry {
namespace {

using test::contour;
using test::tube;

/// The surface of a box [0, lengths] from a mesh of it.
TriangleSurface box_surface(const Vec3<double>& lengths) {
  const auto box = mesh::box(3, 4, 2, lengths, mesh::RegionKind::wall);
  TriangleSurface surface{box.points, {}};
  for (const auto& face : box.faces)
    surface.triangles.insert(surface.triangles.end(), face.triangles.begin(), face.triangles.end());
  drop_unused_points(surface);
  return surface;
}

TriangleSurface moved(TriangleSurface surface, double angle, const Vec3<double>& shift) {
  const double c = std::cos(angle), s = std::sin(angle);
  for (auto& p : surface.points) p = Point{{c * p[0] - s * p[1], s * p[0] + c * p[1], p[2]}} + shift;
  return surface;
}

TEST(TriangleSurface, AreaAndVolumeOfABoxAnywhere) {
  const auto box = box_surface({{0.2, 0.3, 0.5}});
  EXPECT_EQ(std::ssize(box.points), 4 * 5 * 3 - 2 * 3 * 1);  // those inside are dropped
  for (const auto& shift : {Vec3<double>{{0, 0, 0}}, Vec3<double>{{1000, -2000, 500}}}) {
    const auto there = moved(box, 0.7, shift);
    EXPECT_NEAR(area(there), 2 * (0.06 + 0.1 + 0.15), 1e-11);
    EXPECT_NEAR(enclosed_volume(there), 0.03, 1e-11);
  }
  auto turned = box;
  for (auto& t : turned.triangles) std::swap(t[0], t[1]);
  EXPECT_NEAR(enclosed_volume(turned), -0.03, 1e-15);
  // Area vectors of a closed surface add up to nothing.
  Vec3<double> sum{{0, 0, 0}};
  for (const auto& t : box.triangles) sum = sum + area_vector(box, t);
  EXPECT_NEAR(norm(sum), 0, 1e-15);
}

TEST(TriangleSurface, AnglesAndNormals) {
  const TriangleSurface one{{{{0, 0, 0}}, {{2, 0, 0}}, {{0, 2 * std::sqrt(3.0), 0}}, {{2, 0, 0}}, {{5, 5, 5}}},
                            {{0, 1, 2}, {1, 3, 2}}};
  EXPECT_NEAR(smallest_angle(one, one.triangles[0]), M_PI / 6, 1e-14);
  EXPECT_EQ(smallest_angle(one, one.triangles[1]), 0);  // two corners in one place
  const auto normals = point_normals(one);
  EXPECT_NEAR(norm(normals[0] - Vec3<double>{{0, 0, 1}}), 0, 1e-15);
  EXPECT_EQ(norm(normals[4]), 0);
  // Of a round tube they point away from its axis.
  const auto round = tube(5e-3, 20e-3, 30, 12);
  const auto outward = point_normals(round);
  for (std::size_t p = 30; p + 30 < round.points.size(); ++p) {
    const auto& x = round.points[p];
    EXPECT_NEAR(norm(outward[p] - (1 / 5e-3) * Vec3<double>{{x[0], x[1], 0}}), 0, 1e-12);
  }
}

TEST(TriangleSurface, EdgesLoopsPartsAndGenus) {
  auto surface = tube(5e-3, 20e-3, 12, 6);
  const auto all = edges(surface);
  std::int64_t open = 0;
  for (const auto& e : all) {
    EXPECT_LT(e.a, e.b);
    open += e.triangles.size() == 1;
  }
  EXPECT_EQ(open, 2 * 12);
  EXPECT_EQ(2 * std::ssize(all) - open, 3 * std::ssize(surface.triangles));
  const auto loops = boundary_loops(surface);
  ASSERT_EQ(loops.size(), 2U);
  for (const auto& loop : loops) {
    EXPECT_EQ(loop.size(), 12U);
    // In the order of the triangles beside it: against the clock seen from outside at the lower end.
    const auto &a = surface.points[static_cast<std::size_t>(loop[0])],
               &b = surface.points[static_cast<std::size_t>(loop[1])];
    EXPECT_GT((a[0] * b[1] - a[1] * b[0]) * (a[2] < 10e-3 ? 1 : -1), 0);
  }
  EXPECT_EQ(genus(surface, 2), 0);
  EXPECT_EQ(genus(test::dissected_tube(), 2), 1);
  append(surface, moved(surface, 0, {{1, 0, 0}}));
  append(surface, moved(box_surface({{1, 1, 1}}), 0, {{5, 0, 0}}));
  const auto part = components(surface);
  EXPECT_EQ(std::set<std::int64_t>(part.begin(), part.end()), (std::set<std::int64_t>{0, 1, 2}));
  EXPECT_EQ(part.front(), 0);
  EXPECT_EQ(part.back(), 2);
  EXPECT_EQ(boundary_loops(surface).size(), 4U);
}

TEST(TriangleSurface, AveragesKeepConstantsAndSpreadTheRest) {
  const auto surface = tube(5e-3, 20e-3, 24, 40);
  std::vector<double> values(surface.points.size(), 3.5);
  average_over_neighbours(surface, 5, values);
  for (const double v : values) EXPECT_NEAR(v, 3.5, 1e-12);
  // A wave around the tube, far from its ends, stays what it is but for one factor.
  for (std::size_t p = 0; p < values.size(); ++p)
    values[p] = std::cos(3 * std::atan2(surface.points[p][1], surface.points[p][0]));
  const auto before = values;
  average_over_neighbours(surface, 1, values);
  // Itself, two neighbours in its row a step away and four half a step away.
  const double step = 3 * 2 * M_PI / 24, factor = (1 + 2 * std::cos(step) + 4 * std::cos(step / 2)) / 7;
  for (std::size_t p = 24; p + 24 < values.size(); ++p) EXPECT_NEAR(values[p], factor * before[p], 1e-12);
}

TEST(Contour, ConvergesWithTheSecondPowerOfTheSpacing) {
  const double radius = 5e-3, exact = 4.0 / 3 * M_PI * std::pow(radius, 3);
  double errors[2];
  for (int k = 0; k < 2; ++k) {
    const auto ball =
        contour({{6e-3, 6e-3, 6e-3}}, 1e-3 / (1 + k) * 0.97, [&](const Point& x) { return norm(x) - radius; });
    errors[k] = 1 - enclosed_volume(ball) / exact;
    EXPECT_EQ(genus(ball, 0), 0);
    EXPECT_TRUE(boundary_loops(ball).empty());
  }
  EXPECT_GT(errors[1], 0);  // its points lie on the ball, chords within
  EXPECT_NEAR(errors[0] / errors[1], 4, 0.8);
}

TEST(CutEnd, TakesOffJustWhatLiesBeyondThePlane) {
  constexpr double radius = 5e-3;
  const auto surface = tube(radius, 30e-3, 48, 40, 0);
  for (const double slope : {0.0, 0.4, -0.8}) {
    const Vec3<double> normal = (1 / std::hypot(1, slope)) * Vec3<double>{{slope, 0, 1}};
    const auto cut = cut_end(surface, {{{0, 0, 24e-3}}, normal, 2 * radius});
    const auto loops = boundary_loops(cut);
    ASSERT_EQ(loops.size(), 2U);
    // The mantle below a sloping plane is that below the plane across, by symmetry.
    EXPECT_NEAR(area(cut) / area(surface), 24.0 / 30, 1e-3);
    for (const auto& p : cut.points) {
      EXPECT_LT(dot(p - Point{{0, 0, 24e-3}}, normal), 1e-15);
      // New points lie where the edges pass the plane: on the mantle of the prism.
      EXPECT_LT(std::hypot(p[0], p[1]), radius + 1e-12);
      EXPECT_GT(std::hypot(p[0], p[1]), radius * std::cos(M_PI / 48) - 1e-12);
    }
    std::size_t in_plane = 0;
    for (const auto& p : cut.points) in_plane += std::abs(dot(p - Point{{0, 0, 24e-3}}, normal)) < 1e-15;
    EXPECT_GE(in_plane, 48U);
  }
}

TEST(LabelledTriangles, SeparateTheLabelsAndAreSeenFromTheFirst) {
  const auto box = mesh::box(4, 3, 3, {{4, 3, 3}}, mesh::RegionKind::wall);
  Tetrahedra mesh{box.points, box.tetrahedra, {}, std::vector<bool>(box.points.size(), false)};
  for (const auto& t : mesh.elements)
    mesh.labels.push_back(mesh::centroid(mesh.points, t)[0] < 2 ? lumen_label : wall_label);
  double between = 0, outside[3] = {0, 0, 0};
  for (const auto& t : surface_triangles(mesh)) {
    const auto normal = mesh::area_vector(mesh.points, t.nodes);
    const auto middle = mesh::centroid(mesh.points, t.nodes);
    EXPECT_GT(dot(normal, middle - mesh::centroid(mesh.points, mesh.elements[static_cast<std::size_t>(t.element)])), 0);
    if (t.neighbour_label == outside_label) {
      EXPECT_EQ(t.neighbour, -1);
      outside[t.label] += norm(normal);
    } else {
      EXPECT_EQ(t.label, lumen_label);
      EXPECT_EQ(middle[0], 2);
      between += norm(normal);
    }
  }
  EXPECT_NEAR(between, 9, 1e-12);
  EXPECT_NEAR(outside[lumen_label], 9 + 4 * 2 * 3, 1e-12);
  EXPECT_NEAR(outside[wall_label], 9 + 4 * 2 * 3, 1e-12);
  // Neighbours know each other across the same nodes.
  const auto across = neighbours(mesh);
  for (Index e = 0; e < std::ssize(mesh.elements); ++e)
    for (int f = 0; f < 4; ++f) {
      const Index other = across[static_cast<std::size_t>(e)][static_cast<std::size_t>(f)];
      if (other < 0) continue;
      const auto& back = across[static_cast<std::size_t>(other)];
      const auto face = std::find(back.begin(), back.end(), e);
      ASSERT_NE(face, back.end());
      auto mine = face_nodes(mesh, e, f), theirs = face_nodes(mesh, other, static_cast<int>(face - back.begin()));
      std::sort(mine.begin(), mine.end());
      std::sort(theirs.begin(), theirs.end());
      EXPECT_EQ(mine, theirs);
    }
}

}  // namespace
}  // namespace tunica::geometry
