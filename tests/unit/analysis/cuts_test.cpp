// Surfaces cut through meshes: areas, flows, volumes against closed forms.
#include "tunica/analysis/cuts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "small_vessels.hpp"
#include "tunica/mesh/boundary.hpp"
#include "tunica/mesh/generate.hpp"

namespace tunica::analysis {
namespace {

mesh::MeshData box() { return mesh::box(4, 3, 5, {{1, 2, 3}}, mesh::RegionKind::lumen); }

using testing::nodal;
using testing::nodal_vectors;

std::vector<CutTriangle> cut(const mesh::MeshData& data, const std::vector<double>& f, double level) {
  std::vector<CutTriangle> surface;
  for (const auto& t : data.tetrahedra)
    append_triangles(cut_element(values_at(f, t), level), t, values_at(f, t), data.points, surface);
  return surface;
}

TEST(Cuts, AnObliquePlaneThroughABox) {
  const auto data = box();
  // z + x / 2 = 1.7: its slope makes the area sqrt(1 + 1/4) times that of the base.
  const auto f = nodal(data, [](const auto& x) { return x[2] + 0.5 * x[0]; });
  const auto surface = cut(data, f, 1.7);
  const auto velocity = nodal_vectors(data, [](const auto& x) { return Vec3<double>{{x[1], 0, 3 + x[0]}}; });
  const auto moves = nodal_vectors(data, [](const auto&) { return Vec3<double>{{0, 0, 1}}; });
  const auto pressure = nodal(data, [](const auto& x) { return 10 + x[1]; });
  const auto found = evaluate(surface, {&data.points, {}, velocity, moves, pressure});
  EXPECT_NEAR(found.size, 2 * std::sqrt(1.25), 1e-12);
  EXPECT_NEAR(norm(found.area - Vec3<double>{{1, 0, 2}}), 0, 1e-12);  // towards where f rises
  EXPECT_NEAR(found.mean_pressure, 11, 1e-12);
  EXPECT_NEAR(norm(found.centre - Vec3<double>{{0.5, 1, 1.45}}), 0, 1e-12);
  // Integral of x1 over the shadow in the y-z plane, and of (2 + x0) over that in the x-y plane.
  EXPECT_NEAR(found.flow, 1 + 5, 1e-12);
}

TEST(Cuts, SurfacesMoveWithTheMesh) {
  const auto data = box();
  const auto f = nodal(data, [](const auto& x) { return x[2]; });
  const auto surface = cut(data, f, 1.0);
  const auto twice = nodal_vectors(data, [](const auto& x) { return Vec3<double>{{x[0], x[1], 0}}; });
  EXPECT_NEAR(evaluate(surface, {&data.points, {}, {}, {}, {}}).size, 2, 1e-12);
  EXPECT_NEAR(evaluate(surface, {&data.points, twice, {}, {}, {}}).size, 8, 1e-12);
}

TEST(Cuts, ClippedPartsAddUpAndLieOnTheirSides) {
  const auto data = box();
  const auto f = nodal(data, [](const auto& x) { return x[2] + 0.2 * x[0]; });
  const auto g = nodal(data, [](const auto& x) { return x[1] - 0.55; });
  std::vector<CutTriangle> parts[2];
  for (const auto& t : data.tetrahedra)
    for (int k = 0; k < 2; ++k)
      append_triangles(clip(cut_element(values_at(f, t), 1.3), values_at(g, t), k == 0), t, values_at(f, t),
                       data.points, parts[k]);
  const double slope = std::sqrt(1.04);
  EXPECT_NEAR(evaluate(parts[0], {.points = &data.points}).size, 1.45 * slope, 1e-12);
  EXPECT_NEAR(evaluate(parts[1], {.points = &data.points}).size, 0.55 * slope, 1e-12);
}

TEST(Cuts, VolumesBelowAPlane) {
  const auto data = box();
  const auto below = [&](const auto& function) {
    const auto f = nodal(data, function);
    double sum = 0;
    for (const auto& t : data.tetrahedra) sum += mesh::volume(data.points, t) * negative_share(values_at(f, t));
    return sum;
  };
  EXPECT_NEAR(below([](const auto& x) { return x[2] - 1.234; }), 2 * 1.234, 1e-12);
  EXPECT_NEAR(below([](const auto& x) { return x[0] + x[1] + x[2] - 0.6; }), 0.216 / 6, 1e-12);
  EXPECT_NEAR(below([](const auto& x) { return 0.3 - x[1]; }), 1.7 * 3, 1e-12);
}

TEST(Cuts, SharesOfSplitElementsAddUp) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int k = 0; k < 1000; ++k) {
    const std::array<double, 4> f = {any(random), any(random), any(random), any(random)};
    EXPECT_NEAR(negative_share(f) + negative_share({-f[0], -f[1], -f[2], -f[3]}), 1, 1e-12);
  }
  // Two corners against two, in the middle: half.
  EXPECT_NEAR(negative_share({-1, -1, 1, 1}), 0.5, 1e-14);
  EXPECT_NEAR(negative_share({-1, 3, 3, 3}), 1.0 / 64, 1e-14);
}

TEST(Cuts, PiecesThatDoNotTouchAreGroups) {
  // A sphere around each of two corners of the box.
  const auto data = mesh::box(8, 8, 8, {{1, 1, 1}}, mesh::RegionKind::lumen);
  const auto f = nodal(data, [](const auto& x) { return std::min(norm(x), norm(x - Vec3<double>{{1, 1, 1}})) - 0.4; });
  std::vector<Element> cut_elements;
  for (const auto& t : data.tetrahedra)
    if (!cut_element(values_at(f, t), 0).empty()) cut_elements.push_back(t);
  const auto groups = connected_groups(cut_elements);
  EXPECT_EQ(*std::max_element(groups.begin(), groups.end()), 1);
  EXPECT_EQ(groups[0], 0);
}

}  // namespace
}  // namespace tunica::analysis
