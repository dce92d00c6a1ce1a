// What local changes of a mesh must keep, whatever they do: volumes, surfaces, layers, and shapes that get no worse.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <set>

#include "block_vessel.hpp"
#include "tunica/mesh/boundary.hpp"
#include "tunica/meshing/improve.hpp"
#include "tunica/meshing/mesh_report.hpp"
#include "tunica/meshing/reconnect.hpp"

namespace tunica::meshing {
namespace {

using geometry::Point;
using Node = LocalMesh::Node;
using Cell = LocalMesh::Cell;

/// The block vessel with its nodes inside the regions shaken; surfaces stay where they are.
geometry::Tetrahedra shaken(unsigned seed) {
  auto mesh = test::block_vessel({.across = 11, .along = 12, .flap_at = 5, .from = 3, .to = 10, .hole = false});
  std::vector<bool> on_surface(mesh.points.size(), false);
  for (const auto& t : geometry::surface_triangles(mesh))
    for (const auto n : t.nodes) on_surface[static_cast<std::size_t>(n)] = true;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-0.3e-3, 0.3e-3);
  const auto home = mesh.points;
  for (std::size_t n = 0; n < mesh.points.size(); ++n) {
    if (on_surface[n]) continue;
    const Point d{{shift(random), shift(random), shift(random)}};
    mesh.points[n] = mesh.points[n] + d;
  }
  // Not so much that an element turns over.
  for (bool again = true; again;) {
    again = false;
    for (const auto& t : mesh.elements)
      if (mesh::volume(mesh.points, t) < 1e-13) {
        for (const auto n : t) mesh.points[static_cast<std::size_t>(n)] = home[static_cast<std::size_t>(n)];
        again = true;
      }
  }
  return mesh;
}

double worst(const LocalMesh& mesh) {
  double sine = 1;
  for (Cell c = 0; c < mesh.cells(); ++c)
    if (mesh.alive(c)) sine = std::min(sine, mesh.sine(c));
  return sine;
}

/// Area vectors of the surfaces between each two labels, summed up plane by plane: what is flat stays flat.
std::map<std::array<long, 5>, double> areas(const geometry::Tetrahedra& mesh) {
  std::map<std::array<long, 5>, double> result;
  for (const auto& t : geometry::surface_triangles(mesh)) {
    const auto area = mesh::area_vector(mesh.points, t.nodes);
    const double size = norm(area);
    std::array<long, 5> key = {t.label, t.neighbour_label, 0, 0, 0};
    double height = 0;
    for (int d = 0; d < 3; ++d) {
      const double n = area[d] / size;
      EXPECT_LT(std::min(std::abs(n), std::abs(std::abs(n) - 1)), 1e-9);  // along the axes
      if (std::abs(n) > 0.5) {
        key[2] = d;
        key[3] = std::lround(n);
        height = mesh.points[static_cast<std::size_t>(t.nodes[0])][d];
      }
    }
    key[4] = std::lround(height / 1e-6);
    result[key] += size;
  }
  return result;
}

void expect_same_body(const geometry::Tetrahedra& before, const geometry::Tetrahedra& after) {
  for (const int label : {geometry::lumen_label, geometry::wall_label})
    EXPECT_NEAR(test::volume(after, label) / test::volume(before, label), 1, 1e-12);
  const auto was = areas(before), is = areas(after);
  ASSERT_EQ(was.size(), is.size());
  for (const auto& [key, area] : was) EXPECT_NEAR(is.at(key), area, 1e-15);
  for (const auto& t : after.elements) EXPECT_GT(mesh::volume(after.points, t), 0);
}

TEST(Changes, LeaveTheBodyAndMakeNoShapeWorse) {
  for (const unsigned seed : {1U, 2U}) {
    const auto before = shaken(seed);
    LocalMesh local(before);
    int reconnected = 0, collapsed = 0;
    for (Cell c = 0; c < local.cells(); ++c) {
      if (!local.alive(c) || local.sine(c) > 0.3) continue;
      const double worst_before = local.sine(c);
      std::set<Cell> around;
      for (const Node n : local.corners(c)) around.insert(local.star(n).begin(), local.star(n).end());
      double neighbourhood = 1;
      for (const Cell other : around) neighbourhood = std::min(neighbourhood, local.sine(other));
      const auto corners = local.corners(c);
      const bool done = reconnect(local, c, {}) ? ++reconnected : collapse(local, c, {}) && ++collapsed;
      if (!done) continue;
      EXPECT_FALSE(local.alive(c) && local.corners(c) == corners && local.sine(c) == worst_before);
      for (const Node n : corners)
        for (const Cell other : local.star(n)) EXPECT_GE(local.sine(other), neighbourhood);
    }
    EXPECT_GT(reconnected, 30);
    EXPECT_GT(collapsed, 0);
    EXPECT_GE(worst(local), worst(LocalMesh(before)));
    expect_same_body(before, local.extract());
  }
}

TEST(Changes, AreReversedByMovingANodeBack) {
  const auto mesh = shaken(4);
  LocalMesh local(mesh);
  int moved = 0;
  for (Node n = 0; n < std::ssize(mesh.points); n += 11) {
    if (local.place(n) != LocalMesh::Place::inner) continue;
    const auto home = local.point(n);
    std::vector<double> sines;
    for (const Cell c : local.star(n)) sines.push_back(local.sine(c));
    const Point away = home + Point{{1e-5, -2e-5, 1.5e-5}};
    const double foreseen = local.star_sine(n, away, -1);
    local.move(n, away);
    double there = 1;
    for (const Cell c : local.star(n)) there = std::min(there, local.sine(c));
    EXPECT_NEAR(there, foreseen, 1e-6);
    // Early ends tell only that it is not good enough.
    EXPECT_LE(local.star_sine(n, away, foreseen + 0.1), foreseen + 0.1);
    local.move(n, home);
    for (std::size_t k = 0; k < sines.size(); ++k) EXPECT_EQ(local.sine(local.star(n)[k]), sines[k]);
    ++moved;
  }
  EXPECT_GT(moved, 20);
}

TEST(Changes, MergedNodesLeaveNoHole) {
  const auto before = shaken(5);
  LocalMesh local(before);
  int merged = 0;
  for (Node n = 0; n < std::ssize(before.points); n += 3)
    if (local.place(n) == LocalMesh::Place::inner && merge_into_neighbour(local, n, 0.1)) {
      EXPECT_TRUE(local.star(n).empty());
      ++merged;
    }
  EXPECT_GT(merged, 20);
  const auto after = local.extract();
  EXPECT_EQ(std::ssize(after.points), std::ssize(before.points) - merged);
  expect_same_body(before, after);
}

TEST(Improve, KeepsLabelsSurfacesAndTopology) {
  auto mesh = shaken(6);
  const auto before = mesh;
  const Projection nowhere = [](Point&, const Point&, int, int, double) { return false; };
  std::vector<std::string> lines;
  const auto done = improve(mesh, nowhere, {}, [&](const std::string& line) { lines.push_back(line); });
  EXPECT_GT(done.moves, 20);
  EXPECT_EQ(std::ssize(lines), done.passes + (done.passes < ImproveOptions{}.most_passes ? 1 : 0));
  EXPECT_GT(std::asin(worst(LocalMesh(mesh))) * 180 / M_PI, 12);
  expect_same_body(before, mesh);
  std::vector<std::array<geometry::Index, 3>> interface;
  for (const auto& t : geometry::surface_triangles(mesh))
    if (t.label == geometry::lumen_label) interface.push_back(t.nodes);
  const auto t = topology(interface);
  EXPECT_EQ(t.parts, 2);
  EXPECT_EQ(t.genus, 0);
  EXPECT_TRUE(t.manifold);
  // What is good is left alone.
  auto good = test::block_vessel({});
  const auto same = good;
  const auto nothing = improve(good, nowhere, {}, [](const std::string&) {});
  EXPECT_EQ(nothing.moves + nothing.reconnections + nothing.collapses, 0);
  EXPECT_EQ(good.elements, same.elements);
}

}  // namespace
}  // namespace tunica::meshing
