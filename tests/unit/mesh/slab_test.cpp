#include "tunica/mesh/slab.hpp"

#include <cmath>
#include <numbers>
#include <set>

#include "tunica/base/error.hpp"
#include "tunica/mesh/blocks.hpp"
#include "tunica/mesh/quality.hpp"
#include "unit/mesh/check_mesh.hpp"

namespace tunica::mesh {

using testing::area;
using testing::expect_sound;
using testing::face;
using testing::volume;

TEST(Graded, EndsAndGrowth) {
  const auto x = section::graded(1.0, 3.0, 5, 4.0);
  ASSERT_EQ(x.size(), 6u);
  EXPECT_EQ(x.front(), 1.0);
  EXPECT_EQ(x.back(), 3.0);
  EXPECT_NEAR((x[5] - x[4]) / (x[1] - x[0]), 4.0, 1e-12);
}

TEST(FlagBehindCylinder, IsSoundAndFillsItsDomain) {
  for (const int refinement : {1, 2}) {
    const auto mesh = flag_behind_cylinder({.refinement = refinement, .layers = refinement});
    expect_sound(mesh);
    const double half = 0.01, r = 0.05, segment = std::asin(half / r) * r * r - half * std::sqrt(r * r - half * half),
                 root = std::sqrt(r * r - half * half), flag = 0.02 * (0.4 - root) - segment,
                 lumen = 2.5 * 0.41 - std::numbers::pi * r * r - flag;
    EXPECT_NEAR(volume(mesh, mesh.regions[0]) / 0.02, lumen, 2e-4 / refinement);
    EXPECT_NEAR(volume(mesh, mesh.regions[1]) / 0.02, flag, 1e-5);
    EXPECT_NEAR(area(mesh, "inlet"), 0.41 * 0.02, 1e-12);
    EXPECT_NEAR(area(mesh, "channel"), 2 * 2.5 * 0.02, 1e-12);
    EXPECT_NEAR(area(mesh, "flag_wall"), area(mesh, "flag_lumen"), 1e-12);
    EXPECT_NEAR(area(mesh, "flag_wall") / 0.02, 2 * (0.4 - root) + 0.02, 1e-12);
    EXPECT_NO_THROW(check_quality(mesh, 0, {}, "lumen"));
    EXPECT_NO_THROW(check_quality(mesh, 1, {}, "flag"));
  }
}

// Twins coincide, and the triangles of both sides of the interface are the same.
TEST(FlagBehindCylinder, BothSidesOfTheInterfaceConform) {
  const auto mesh = flag_behind_cylinder({.refinement = 2});
  std::map<std::int64_t, std::int64_t> host(mesh.twins.begin(), mesh.twins.end());
  for (const auto& [wall, lumen] : mesh.twins) EXPECT_EQ(norm(mesh.points[wall] - mesh.points[lumen]), 0.0);
  std::set<std::set<std::int64_t>> lumen;
  for (const auto& t : face(mesh, "flag_lumen").triangles) lumen.insert({t[0], t[1], t[2]});
  const auto& wall = face(mesh, "flag_wall").triangles;
  EXPECT_EQ(lumen.size(), wall.size());
  for (const auto& t : wall) EXPECT_TRUE(lumen.contains({host.at(t[0]), host.at(t[1]), host.at(t[2])}));
}

// In a channel that is its own mirror image about the flag's axis, so is the mesh, element by element.
TEST(FlagBehindCylinder, IsItsOwnMirrorImage) {
  for (const int refinement : {1, 2}) {
    const auto mesh = flag_behind_cylinder({.height = 0.4, .refinement = refinement});
    const auto key = [](const Vec3<double>& p) {
      return std::array{std::llround(1e9 * p[0]), std::llround(1e9 * p[1]), std::llround(1e9 * p[2])};
    };
    using Corners = std::multiset<std::array<long long, 3>>;
    std::set<Corners> elements;
    const auto corners = [&](const auto& element, bool mirrored) {
      Corners result;
      for (const auto n : element) {
        auto p = mesh.points[n];
        if (mirrored) p[1] = 0.4 - p[1];
        result.insert(key(p));
      }
      return result;
    };
    for (const auto& e : mesh.tetrahedra) elements.insert(corners(e, false));
    int missing = 0;
    for (const auto& e : mesh.tetrahedra) missing += !elements.contains(corners(e, true));
    EXPECT_EQ(missing, 0) << "of " << mesh.tetrahedra.size();
  }
}

TEST(FlagBehindCylinder, RefusesWhatDoesNotFit) {
  EXPECT_THROW(flag_behind_cylinder({.refinement = 0}), InputError);
  EXPECT_THROW(flag_behind_cylinder({.tip = 3.0}), InputError);
  EXPECT_THROW(flag_behind_cylinder({.flag_thickness = 0.2}), InputError);
}

TEST(BackwardStep, IsSoundAndHasItsFaces) {
  const auto mesh = backward_step({.length = 10, .cells_across = 8, .cells_along = 20});
  expect_sound(mesh);
  EXPECT_NEAR(volume(mesh, mesh.regions[0]), 10 * 0.1, 1e-12);
  EXPECT_NEAR(area(mesh, "inlet"), 0.05, 1e-12);
  EXPECT_NEAR(area(mesh, "wall_low"), 1.05, 1e-12);
  EXPECT_NEAR(area(mesh, "wall_high"), 1.0, 1e-12);
  for (const auto& t : face(mesh, "inlet").triangles)
    for (const auto n : t) EXPECT_GE(mesh.points[n][1], 0.0);
}

}  // namespace tunica::mesh
