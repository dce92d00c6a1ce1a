// The engine on bodies whose volumes and topology are known.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "block_vessel.hpp"
#include "tunica/base/error.hpp"
#include "tunica/stages/meshing/improve.hpp"
#include "tunica/stages/meshing/mesh_report.hpp"
#include "tunica/stages/meshing/tetrahedralise.hpp"

namespace tunica::stages::meshing {
namespace {

constexpr double pi = std::numbers::pi;

LabelDomain body(std::function<int(const Point&)> label, double reach, double size) {
  LabelDomain domain;
  domain.label = std::move(label);
  domain.box = {{{-reach, -reach, -reach}}, {{reach, reach, reach}}};
  domain.surface_size = [size](const Point&) { return size; };
  domain.volume_size = [size](const Point&, int) { return 1.5 * size; };
  domain.surface_distance = [size](const Point&) { return 0.06 * size; };
  return domain;
}

std::vector<std::array<Index, 3>> boundary_of(const Tetrahedra& mesh, int label) {
  std::vector<std::array<Index, 3>> triangles;
  for (const auto& t : surface_triangles(mesh))
    if (t.label == label || t.neighbour_label == label) triangles.push_back(t.nodes);
  return triangles;
}

TEST(Tetrahedralise, TorusInAShell) {
  // A torus of lumen (radii 10 and 3 mm) with a wall of 1.5 mm around it.
  const double R = 10e-3, r = 3e-3, wall = 1.5e-3;
  const auto domain = body(
      [=](const Point& p) {
        const double d = std::hypot(std::hypot(p[0], p[1]) - R, p[2]);
        return d < r ? lumen_label : d < r + wall ? wall_label : outside;
      },
      16e-3, 1.6e-3);
  auto mesh = tetrahedralise(domain, [](const std::string&, const std::string&) {});
  improve(mesh, projection(domain), {}, [](const std::string&) {});
  const double lumen = 2 * pi * pi * R * r * r, all = 2 * pi * pi * R * (r + wall) * (r + wall);
  EXPECT_NEAR(test::volume(mesh, lumen_label) / lumen, 1, 0.03);
  EXPECT_NEAR(test::volume(mesh, wall_label) / (all - lumen), 1, 0.03);
  for (const int label : {lumen_label, wall_label}) {
    const auto t = topology(boundary_of(mesh, label));
    EXPECT_TRUE(t.manifold);
    EXPECT_EQ(t.parts, label == lumen_label ? 1 : 2);
    EXPECT_EQ(t.genus, label == lumen_label ? 1 : 2);
  }
  const mesh::MeshData data{mesh.points, mesh.elements, {}, {}, {}, {}};
  EXPECT_GT(shapes(data, 0, std::ssize(mesh.elements)).smallest_dihedral, 8);
}

TEST(Tetrahedralise, RimsOfACutTubeAreKept) {
  // A cylinder between two planes; its rims are curves.
  const double r = 4e-3, half = 5e-3;
  auto domain =
      body([=](const Point& p) { return std::hypot(p[0], p[1]) < r && std::abs(p[2]) < half ? lumen_label : outside; },
           7e-3, 1.5e-3);
  for (const double z : {-half, half}) {
    auto& rim = domain.curves.emplace_back();
    for (int k = 0; k <= 100; ++k)
      rim.push_back({{r * std::cos(2 * pi * (k % 100) / 100), r * std::sin(2 * pi * (k % 100) / 100), z}});
  }
  const auto mesh = tetrahedralise(domain, [](const std::string&, const std::string&) {});
  double cap = 0;
  Index on_rim = 0;
  for (std::size_t n = 0; n < mesh.points.size(); ++n) {
    const Point& p = mesh.points[n];
    if (!mesh.on_curve[n]) continue;
    ++on_rim;
    EXPECT_NEAR(std::abs(p[2]), half, 1e-9);
    EXPECT_NEAR(std::hypot(p[0], p[1]), r, 1e-5);
  }
  EXPECT_GT(on_rim, 20);
  for (const auto& t : surface_triangles(mesh)) {
    const auto& [a, b, c] = t.nodes;
    const auto &x = mesh.points[a], &y = mesh.points[b], &z = mesh.points[c];
    if (std::min({x[2], y[2], z[2]}) > half - 1e-6) cap += 0.5 * norm(cross(y - x, z - x));
  }
  EXPECT_NEAR(cap / (pi * r * r), 1, 0.03);
}

TEST(Tetrahedralise, NothingToMeshIsAnError) {
  const auto domain = body([](const Point&) { return outside; }, 5e-3, 1e-3);
  EXPECT_THROW(tetrahedralise(domain, [](const std::string&, const std::string&) {}), SolverError);
}

}  // namespace
}  // namespace tunica::stages::meshing
