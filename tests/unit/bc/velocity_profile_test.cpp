#include "tunica/bc/velocity_profile.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "temporary_folder.hpp"
#include "tunica/base/error.hpp"
#include "tunica/bc/formula.hpp"

namespace tunica::bc {
namespace {

TEST(Formula, KnowsPlaceTimeAndPi) {
  const Formula f("1.5*y*(0.41-y)/0.205^2*(t < 2 ? (1-cos(pi*t/2))/2 : 1) + x - z");
  EXPECT_NEAR(f(0, 0.205, 0, 1), 0.75, 1e-14);
  EXPECT_NEAR(f(3, 0.205, 1, 5), 3.5, 1e-14);
}

TEST(Formula, RefusesOtherTexts) {
  for (const char* text : {"", "1 +", "w", "sin(", "x y", "1, 2", "x = 3 3"})
    EXPECT_THROW(Formula{text}, InputError) << text;
}

TEST(VelocityProfile, FormulasHaveUnits) {
  VelocityProfile profile;
  profile.unit = 0.01, profile.length_unit = 1e-3;
  profile.velocity = {"x", "2*y", "t"};
  const Vec3<double> place{{2e-3, 3e-3, 0}}, outward{{0, 0, -1}};
  const auto v = velocity_by_formula(profile, outward)(place, 4.0);
  EXPECT_LE(norm(v - Vec3<double>{{0.02, 0.06, 0.04}}), 1e-15);
  profile.velocity.clear();
  profile.speed.emplace("5");
  EXPECT_LE(norm(velocity_by_formula(profile, outward)(place, 0.0) - Vec3<double>{{0, 0, 0.05}}), 1e-15);
}

class ProfileTable : public ::testing::Test {
 protected:
  /// v = (1 + 2 x - y, 0, 3 y) at the points of a grid in the plane z = 0.5.
  ProfileTable() {
    std::ofstream out(file_);
    out << "x,y,z,vx,vy,vz\n";
    for (int i = 0; i <= 4; ++i)
      for (int j = 0; j <= 4; ++j) out << i << ',' << j << ",0.5," << 1 + 2 * i - j << ",0," << 3 * j << '\n';
    out.close();
    profile_.table = file_;
  }
  test::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "table.csv";
  PointTable table() const { return {profile_.over_face(), velocity_columns}; }
  VelocityProfile profile_;
};

TEST_F(ProfileTable, IsExactForLinearFieldsAndAtItsPoints) {
  const PointTable table = this->table();
  for (const auto& [x, y] : {std::pair{1.3, 2.6}, {0.0, 0.0}, {4.0, 3.0}, {2.5, 0.1}})
    EXPECT_LE(norm(table.value({{x, y, 0.5}}) - Vec3<double>{{1 + 2 * x - y, 0, 3 * y}}), 1e-6) << x << " " << y;
}

TEST_F(ProfileTable, NearestTakesOnePoint) {
  profile_.interpolation = VelocityProfile::Interpolation::nearest;
  EXPECT_LE(norm(table().value({{1.4, 2.4, 0.5}}) - Vec3<double>{{1, 0, 6}}), 1e-12);
}

class ProfileInTime : public ProfileTable {
 protected:
  /// Two points at x = 0 and 1; the velocity of the second is twice that of the first, `speeds` at `times`.
  void write(const std::vector<double>& times, const std::vector<double>& speeds, int last_points = 2) {
    std::ofstream out(file_);
    out << "t,x,y,z,vx,vy,vz\n";
    for (std::size_t k = 0; k < times.size(); ++k)
      for (int i = 0; i < (k + 1 == times.size() ? last_points : 2); ++i)
        out << times[k] << ',' << i << ",0,0," << (1 + i) * speeds[k] << ",0,0\n";
    out.close();
    profile_.interpolation = VelocityProfile::Interpolation::nearest;
  }
  double speed(double x, double t) const { return table().value(Vec3<double>{{x, 0, 0}}, t)[0]; }
};

TEST_F(ProfileInTime, IsLinearBetweenTimesAndHoldsItsEnds) {
  write({0, 0.2, 0.6}, {1, 3, 7});
  EXPECT_FALSE(table().steady());
  EXPECT_DOUBLE_EQ(speed(0.1, 0.1), 2);
  EXPECT_DOUBLE_EQ(speed(0.9, 0.5), 12);
  EXPECT_DOUBLE_EQ(speed(0, 0.6), 7);
  EXPECT_DOUBLE_EQ(speed(0, 9), 7);
  EXPECT_DOUBLE_EQ(speed(0, -1), 1);
}

TEST_F(ProfileInTime, RepeatsItselfWithAPeriod) {
  write({0, 0.2, 0.6}, {1, 3, 7});
  profile_.period = 0.6;
  EXPECT_NEAR(speed(0, 0.7), 2, 1e-12);
  EXPECT_NEAR(speed(0, 6.3), 4, 1e-12);
  profile_.period = 1.0;  // between the last time and the next period the velocity goes back to its start
  EXPECT_NEAR(speed(0, 0.8), 4, 1e-12);
  EXPECT_NEAR(speed(0, 1.1), 2, 1e-12);
  profile_.period = 0.5;
  EXPECT_THROW(table(), InputError);
}

TEST_F(ProfileInTime, RefusesOtherPointsAndTimesThatGoBack) {
  write({0, 0.2}, {1, 3}, 1);
  EXPECT_THROW(table(), InputError);
  write({0.2, 0.1}, {1, 3});
  EXPECT_THROW(table(), InputError);
  write({0, 0.2}, {1, 3}, 3);
  EXPECT_THROW(table(), InputError);
}

TEST_F(ProfileInTime, HistoriesSayTheSame) {
  write({0, 0.2, 0.6}, {1, 3, 7});
  profile_.period = 0.8;
  const PointTable points = table();
  const Vec3<double> place{{0.9, 0, 0}};
  const auto history = points.history(place);
  ASSERT_EQ(history.size(), 3u);
  for (const double t : {-0.3, 0.0, 0.1, 0.2, 0.5, 0.7, 3.3})
    EXPECT_LE(norm(points.value(history, t) - points.value(place, t)), 1e-14) << t;
}

TEST_F(ProfileTable, FactorsStandInTheFirstComponent) {
  std::ofstream(file_) << "x,y,z,factor\n0,0,0,2\n1,0,0,3\n0,1,0,4\n";
  const PointTable points({.table = file_, .unit = 10.0}, factor_column);
  EXPECT_LE(norm(points.value({{1, 0, 0}}) - Vec3<double>{{30, 0, 0}}), 1e-6);
  EXPECT_THROW(PointTable({.table = file_}, traction_columns), InputError);
}

TEST_F(ProfileTable, RefusesPlacesFarAway) {
  EXPECT_THROW(table().value({{100, 0, 0}}), InputError);
  profile_.length_unit = 1e-3;
  EXPECT_THROW(table().value({{1.3, 2.6, 0.5}}), InputError);
}

}  // namespace
}  // namespace tunica::bc
