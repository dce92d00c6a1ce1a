#include "tunica/bc/check.hpp"

#include <gtest/gtest.h>

namespace {

using namespace tunica::bc;

BoundaryCase sound() {
  return {
      .faces = {{"lumen_inlet", Field::lumen},
                {"lumen_outlet", Field::lumen},
                {"lumen_wall", Field::lumen},
                {"wall_inner", Field::wall},
                {"wall_outer", Field::wall},
                {"wall_ring", Field::wall}},
      .interfaces = {{"lumen_wall", "wall_inner"}},
      .conditions = {{"lumen_inlet", Flow{}}, {"lumen_outlet", Rcr{}}, {"wall_outer", Free{}}, {"wall_ring", Fixed{}}}};
}

bool has(const std::vector<tunica::Problem>& problems, const std::string& where, const std::string& what,
         const std::string& remedy = "") {
  for (const auto& p : problems)
    if (p.where == where && p.what.find(what) != std::string::npos && p.remedy.find(remedy) != std::string::npos &&
        !p.remedy.empty())
      return true;
  for (const auto& p : problems) ADD_FAILURE() << format(p);
  return false;
}

TEST(Check, SoundCaseHasNoProblems) {
  auto boundary = sound();
  EXPECT_TRUE(check_boundary(boundary).empty());
  boundary.rigid_wall = boundary.static_wall = true;
  EXPECT_TRUE(check_boundary(boundary).empty());
}

TEST(Check, EveryProblemIsReportedAtOnce) {
  auto boundary = sound();
  boundary.conditions = {{"lumen_inlt", Flow{}},
                         {"lumen_outlet", Rcr{}},
                         {"lumen_outlet", Pressure{}},
                         {"wall_outer", Resistance{}},
                         {"wall_inner", Free{}}};
  const auto problems = check_boundary(boundary);
  EXPECT_TRUE(has(problems, "boundary.lumen_inlt", "no such face", "did you mean 'lumen_inlet'"));
  EXPECT_TRUE(has(problems, "boundary.lumen_inlet", "no condition", "rcr"));
  EXPECT_TRUE(has(problems, "boundary.lumen_outlet", "2 conditions (rcr, pressure)"));
  EXPECT_TRUE(has(problems, "boundary.wall_outer", "resistance is not a condition for a wall face", "support"));
  EXPECT_TRUE(has(problems, "boundary.wall_inner", "interface", "remove"));
  EXPECT_TRUE(has(problems, "boundary.wall_ring", "no condition", "fixed"));
  EXPECT_EQ(problems.size(), 6u);
}

TEST(Check, InterfaceNames) {
  auto boundary = sound();
  boundary.interfaces = {{"wall_inner", "lumen_wal"}};
  boundary.conditions.push_back({"lumen_wall", NoSlip{}});
  const auto problems = check_boundary(boundary);
  EXPECT_TRUE(has(problems, "interface", "no face 'lumen_wal'", "did you mean 'lumen_wall'"));
  EXPECT_TRUE(has(problems, "interface", "'wall_inner' bounds the wall"));
}

TEST(Check, RigidFlowNeedsAPressure) {
  auto boundary = sound();
  boundary.faces.resize(3);
  boundary.interfaces.clear();
  boundary.rigid_wall = true;
  boundary.conditions = {{"lumen_inlet", Flow{}}, {"lumen_outlet", Velocity{}}, {"lumen_wall", NoSlip{}}};
  EXPECT_TRUE(has(check_boundary(boundary), "boundary", "pressure is undetermined"));
  boundary.conditions[1].second = Traction{};
  EXPECT_TRUE(check_boundary(boundary).empty());
  boundary.conditions[1].second = Velocity{};
  boundary.rigid_wall = false;
  EXPECT_TRUE(check_boundary(boundary).empty());
}

TEST(Check, StaticWallNeedsSupport) {
  auto boundary = sound();
  boundary.static_wall = true;
  auto& ring = boundary.conditions[3].second;
  ring = Free{};
  EXPECT_TRUE(has(check_boundary(boundary), "boundary", "along x, y, z"));
  ring = Fixed{{false, false, true, false, false}};
  EXPECT_TRUE(has(check_boundary(boundary), "boundary", "along x, y in"));
  boundary.conditions[2].second = Support{.stiffness = 1e7};
  EXPECT_TRUE(check_boundary(boundary).empty());
  boundary.conditions[2].second = Support{.damping = 1e7};
  EXPECT_EQ(check_boundary(boundary).size(), 1u);
  boundary.static_wall = false;
  EXPECT_TRUE(check_boundary(boundary).empty());
}

TEST(Conditions, HeldAxesAreThoseOfWhateverGivesTheDisplacement) {
  EXPECT_EQ(held_axes(Fixed{}), (Axes{true, true, true}));
  EXPECT_EQ(held_axes(Pressure{.pressure = {}, .fixed = {true, false, false}}), (Axes{true, false, false}));
  EXPECT_EQ(held_axes(Traction{.fixed = {false, true, false}}), (Axes{false, true, false}));
  EXPECT_EQ(held_axes(Displacement{.directions = {false, true, true}}), (Axes{false, true, true}));
  EXPECT_EQ(held_axes(Support{}), Axes{});
}

TEST(Conditions, NamesFollowTheVariant) {
  EXPECT_EQ(name(NoSlip{}), "no_slip");
  EXPECT_EQ(name(Velocity{}), "velocity");
  EXPECT_EQ(name(Flow{}), "flow");
  EXPECT_EQ(name(Pressure{}), "pressure");
  EXPECT_EQ(name(Traction{}), "traction");
  EXPECT_EQ(name(Resistance{}), "resistance");
  EXPECT_EQ(name(Rcr{}), "rcr");
  EXPECT_EQ(name(Fixed{}), "fixed");
  EXPECT_EQ(name(Free{}), "free");
  EXPECT_EQ(name(Support{}), "support");
  EXPECT_EQ(name(VelocityProfile{}), "profile");
  EXPECT_EQ(name(Displacement{}), "displacement");
  EXPECT_TRUE(fits_lumen(Pressure{}) && fits_wall(Pressure{}) && !fits_wall(Flow{}) && !fits_lumen(Support{}));
}

}  // namespace
