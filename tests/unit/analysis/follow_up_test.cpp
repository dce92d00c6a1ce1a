// The line of an aorta, its shape, and maps between scans, on vessels of known shape.
#include <gtest/gtest.h>

#include <cmath>

#include "small_vessels.hpp"
#include "text.hpp"
#include "tunica/analysis/anatomy.hpp"
#include "tunica/analysis/growth.hpp"
#include "tunica/analysis/scan_map.hpp"
#include "tunica/base/error.hpp"

namespace tunica::analysis {
namespace {

using namespace testing;
using test::message_of;

/// A quarter of a circle of radius 40 mm after a straight line of 30 mm.
std::vector<Vec3<double>> bent_places() {
  std::vector<Vec3<double>> places;
  for (int k = 0; k <= 30; ++k) places.push_back({{0, 0, 1e-3 * k}});
  for (int k = 1; k <= 60; ++k) {
    const double a = M_PI / 2 * k / 60;
    places.push_back({{0.04 * (1 - std::cos(a)), 0, 0.03 + 0.04 * std::sin(a)}});
  }
  return places;
}

TEST(AortaLine, FollowsItsPlacesAndCoordinatesAreTheInverseOfPoint) {
  const AortaLine line(bent_places(), 3e-3, 30e-3);
  EXPECT_NEAR(line.length(), 0.03 + 0.04 * M_PI / 2, 0.5e-3);
  for (double s = -4e-3; s < line.length() + 5e-3; s += 1.7e-3)
    for (double angle = -3; angle < 3.1; angle += 0.9)
      for (const double radius : {1e-3, 8e-3, 18e-3}) {
        const auto found = line.coordinates(line.point({s, angle, radius}));
        EXPECT_NEAR(found.s, s, 1e-9) << angle << " " << radius;
        EXPECT_NEAR(found.radius, radius, 1e-9);
        EXPECT_NEAR(std::remainder(found.angle - angle, 2 * M_PI), 0, 1e-6);
      }
  // Axes are carried along without turning: in a plane bend that across it stays.
  const auto first = line.frame(0), last = line.frame(line.length());
  EXPECT_NEAR(std::abs(dot(first.e1, {{0, 1, 0}})), std::abs(dot(last.e1, {{0, 1, 0}})), 1e-6);
}

TEST(AortaLine, TakesNoiseOutAndRefusesFewPlaces) {
  auto places = bent_places();
  for (std::size_t k = 0; k < places.size(); ++k) places[k][1] += k % 2 == 0 ? 0.4e-3 : -0.4e-3;
  const AortaLine line(places, 2e-3, 30e-3);
  for (double s = 5e-3; s < line.length() - 5e-3; s += 2e-3) EXPECT_LT(std::abs(line.frame(s).origin[1]), 0.1e-3);
  EXPECT_NE(message_of<InputError>([] {
              AortaLine({{{0, 0, 0}}, {{0, 0, 1e-3}}}, 1e-3, 1e-2);
            }).find("smaller"),
            std::string::npos);
}

Vessel vessel_of(const RunDescription& run, mesh::MeshData& data, double spacing) {
  PostSettings settings;
  settings.spacing = spacing;
  tell_lumens_apart(run, settings, data, MPI_COMM_WORLD);
  return make_vessel(run, settings, data, MPI_COMM_WORLD);
}

TEST(Anatomy, SectionsOfABoxHaveItsAreasAndVolumes) {
  auto data = two_lumens();
  for (auto& x : data.points) x = 0.02 * x;  // lumens of 40 x 20 mm together, 80 mm long
  const auto vessel = vessel_of(flow_in_two_lumens(), data, 2e-3);
  const auto anatomy = make_anatomy(data, vessel, 4e-3, "flap");
  EXPECT_TRUE(anatomy.two_lumens);
  EXPECT_TRUE(anatomy.landmarks.empty());
  const auto middle = anatomy.at(0.5 * anatomy.line.length());
  EXPECT_NEAR(middle.lumen_area[0], 400e-6, 4e-6);
  EXPECT_NEAR(middle.lumen_area[1], 400e-6, 4e-6);
  EXPECT_NEAR(middle.diameter, std::sqrt(4 * 800e-6 / M_PI), 0.3e-3);
  EXPECT_NEAR(middle.largest_diameter, std::hypot(40e-3, 20e-3), 0.8e-3);
  EXPECT_TRUE(std::isnan(middle.flap_position));
  const auto frame = anatomy.line.frame(0.04);
  for (const double way : {1.0, -1.0}) {  // the wall of the true lumen has 5 mm, that of the false one 10 mm
    const double angle = std::atan2(way * frame.e2[1], way * frame.e1[1]);
    EXPECT_NEAR(anatomy.outer_radius(0.04, angle) - anatomy.inner_radius(0.04, angle), way > 0 ? 5e-3 : 10e-3, 0.1e-3);
  }
  const auto volume = anatomy.volume(0.02, 0.05);
  EXPECT_NEAR(volume[0], 400e-6 * 0.03, 0.1e-6);
  EXPECT_NEAR(volume[1], 400e-6 * 0.03, 0.1e-6);
  EXPECT_NEAR(anatomy.inner_radius(0.04, 0) + anatomy.inner_radius(0.04, M_PI), 30e-3, 11e-3);
}

/// The channel with a branch, in centimetres, grown by a factor across and moved.
mesh::MeshData channel(double across, double along = 1, double turn = 0) {
  auto data = channel_with_branch(2);
  for (auto& x : data.points) {
    x = Vec3<double>{{0.01 * (0.5 + across * (x[0] - 0.5)), 0.01 * (0.5 + across * (x[1] - 0.5)), 0.01 * along * x[2]}};
    x = turned(x, {{0.6, 0, 0.8}}, turn) + turn * Vec3<double>{{0.1, -0.2, 0.05}};
  }
  return data;
}

struct Made {
  mesh::MeshData data;
  Anatomy anatomy;
};
Made make(mesh::MeshData data) {
  const auto vessel = vessel_of(flow_in_channel(), data, 0.5e-3);
  auto anatomy = make_anatomy(data, vessel, 2e-3, "flap");
  return {std::move(data), std::move(anatomy)};
}

TEST(Anatomy, FindsWhereABranchLeaves) {
  const auto scan = make(channel(1));
  ASSERT_EQ(scan.anatomy.landmarks.size(), 1U);
  const auto& branch = scan.anatomy.landmarks[0];
  EXPECT_EQ(branch.name, "branch");
  EXPECT_NEAR(branch.place[2], 25e-3, 2e-3);
  // The line begins at the first section, not at the inlet.
  const auto at = scan.anatomy.line.frame(branch.s);
  EXPECT_NEAR(at.origin[2], 25e-3, 3e-3);
  EXPECT_GT(std::cos(branch.angle) * at.e1[0] + std::sin(branch.angle) * at.e2[0], 0.95);
  // Of the branch, which is as wide as the channel and has 2 ml, what sections cut together with the channel is its
  // own.
  const auto volume = scan.anatomy.volume(scan.anatomy.line.length() * 0.05, scan.anatomy.line.length() * 0.95);
  const double channel_alone = 1e-4 * 0.9 * scan.anatomy.line.length();
  EXPECT_GT(volume[0], channel_alone);
  EXPECT_LT(volume[0], channel_alone + 0.35 * 2e-6);
}

TEST(ScanMap, OfAVesselThatWasMovedIsThatMotion) {
  const auto before = make(channel(1)), after = make(channel(1, 1, 0.7));
  const ScanMap map(before.anatomy, after.anatomy);
  EXPECT_TRUE(check_match(before.anatomy, after.anatomy, "scans.b", "a").empty());
  double largest = 0;
  for (std::size_t n = 0; n < before.data.points.size(); ++n) {
    const auto& at = before.anatomy.nodes[n];
    if (std::isinf(at.radius) || at.s < map.range()[0] || at.s > map.range()[1]) continue;
    largest = std::max(largest, norm(map.point(at) - after.data.points[n]));
  }
  EXPECT_LT(largest, 0.6e-3);  // at edges of the square, whose radius is kept in other directions
  const auto folds = count_folds(before.data, before.anatomy, map);
  EXPECT_GT(folds.elements, before.data.tetrahedra.size() / 2);
  EXPECT_EQ(folds.folded, 0U);
  EXPECT_NEAR(folds.least_jacobian, 1, 0.25);
}

TEST(Growth, OfAVesselThatGrewIsItsGrowth) {
  const auto before = make(channel(1)), after = make(channel(1.3, 1.1, 0.4));
  const std::vector<const Anatomy*> scans = {&before.anatomy, &after.anatomy};
  const auto growth = find_growth(scans);
  ASSERT_EQ(growth.segments.size(), 2U);
  EXPECT_EQ(growth.segments[0].to, "branch");
  const double side = std::sqrt(4 / M_PI) * 10e-3;  // diameter of the circle with the area of the channel
  for (std::size_t k = 2; k + 2 < growth.stations.size(); ++k) {
    if (growth.stations[k] > 15e-3 && growth.stations[k] < 35e-3) continue;  // across the mouth of the branch
    EXPECT_NEAR(growth.sections[1][k].diameter - growth.sections[0][k].diameter, 0.3 * side, 0.1 * side)
        << growth.stations[k];
  }
  EXPECT_TRUE(growth.tears.empty());
  const ScanMap map(before.anatomy, after.anatomy);
  EXPECT_EQ(count_folds(before.data, before.anatomy, map).folded, 0U);
  EXPECT_NEAR(map.back(map.arc(0.04)), 0.04, 1e-12);
  EXPECT_NEAR(radial_growth(growth, scans, 0, 1, {0.045, M_PI / 4, 0}), 0.3 * 5e-3 * 1.1, 1e-3);
}

TEST(ScanMap, TellsThatScansAreNotOfOneAorta) {
  const auto one = make(channel(1));
  auto other = one.anatomy;
  other.landmarks[0].name = "renal";
  const auto problems = check_match(one.anatomy, other, "scans.b", "a");
  ASSERT_EQ(problems.size(), 2U);
  EXPECT_EQ(problems[0].where, "scans.b");
  EXPECT_NE(problems[0].what.find("branch leaves the aorta in a and not in this scan"), std::string::npos);
  EXPECT_NE(message_of<InputError>([&] { ScanMap(one.anatomy, other); }).find("no branch"), std::string::npos);

  auto first = one.anatomy, second = one.anatomy;
  first.landmarks = {{"a", 0.01, 0, {{0, 0, 0}}}, {"b", 0.04, 1, {{0, 0, 0.03}}}};
  second.landmarks = {{"b", 0.01, 1, {{0, 0, 0}}}, {"a", 0.06, 0, {{0, 0, 0.05}}}};  // names swapped, and farther
  const auto swapped = check_match(first, second, "scans.c", "base");
  ASSERT_GE(swapped.size(), 2U);
  EXPECT_NE(swapped[0].what.find("50 mm apart, and 30 mm in base"), std::string::npos);
  EXPECT_NE(swapped[1].what.find("b leaves before a"), std::string::npos);
  second = first;
  second.landmarks[1].angle = -1.5;
  EXPECT_NE(check_match(first, second, "scans.c", "base").at(0).remedy.find("mirrored"), std::string::npos);
}

}  // namespace
}  // namespace tunica::analysis
