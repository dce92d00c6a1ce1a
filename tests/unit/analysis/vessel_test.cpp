// Openings, lumens, tears and stations of vessels of known shape.
#include "tunica/analysis/vessel.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "small_vessels.hpp"
#include "text.hpp"
#include "tunica/analysis/stations.hpp"
#include "tunica/base/error.hpp"
#include "tunica/mesh/lumen_fields.hpp"

namespace tunica::analysis {
namespace {

using namespace testing;
using test::message_of;

PostSettings every(double spacing) {
  PostSettings settings;
  settings.spacing = spacing;
  return settings;
}

/// As a command makes it of the mesh of a case.
Vessel vessel_of(const RunDescription& run, const PostSettings& settings, mesh::MeshData data) {
  tell_lumens_apart(run, settings, data, MPI_COMM_WORLD);
  return make_vessel(run, settings, data, MPI_COMM_WORLD);
}

/// Of both lumens of a station together.
SurfaceFigures section(const mesh::MeshData& data, const Station& station) {
  auto surface = station.sections[0];
  surface.insert(surface.end(), station.sections[1].begin(), station.sections[1].end());
  return evaluate(surface, {.points = &data.points});
}

TEST(Vessel, StationsOfAStraightTubeAreItsSectionsAtEqualDistances) {
  const auto data = tube();
  const auto vessel = vessel_of(flow_in_tube(), every(0.014), data);
  // A fourth one would be 4 mm from the end: that is less than half of the distance.
  ASSERT_EQ(vessel.stations.size(), 3U);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& station = vessel.stations[k];
    const double z = 0.014 * static_cast<double>(k + 1);
    EXPECT_NEAR(station.distance, z, 1e-12);
    EXPECT_NEAR(norm(station.centre - Vec3<double>{{0, 0, z}}), 0, 1e-7) << k;
    const auto found = section(data, station);
    EXPECT_NEAR(norm(found.area - Vec3<double>{{0, 0, polygon_area()}}), 0, 1e-6 * polygon_area()) << k;  // downstream
    EXPECT_NEAR(found.size, polygon_area(), 1e-6 * polygon_area());
    EXPECT_TRUE(station.sections[1].empty());
  }
}

TEST(Vessel, TurnsWithTheMesh) {
  auto data = tube();
  const auto straight = vessel_of(flow_in_tube(), every(0.01), data);
  const Vec3<double> axis{{2.0 / 3, -1.0 / 3, 2.0 / 3}}, shift{{0.3, -0.1, 0.2}};
  const auto move = [&](const Vec3<double>& x) { return turned(x, axis, 0.8) + shift; };
  for (auto& x : data.points) x = move(x);
  const auto moved = vessel_of(flow_in_tube(), every(0.01), data);
  ASSERT_EQ(moved.stations.size(), straight.stations.size());
  for (std::size_t k = 0; k < moved.stations.size(); ++k) {
    EXPECT_NEAR(norm(moved.stations[k].centre - move(straight.stations[k].centre)), 0, 1e-7);
    const auto area = section(data, moved.stations[k]).area;
    EXPECT_NEAR(norm(area - polygon_area() * turned({{0, 0, 1}}, axis, 0.8)), 0, 1e-6 * polygon_area());
  }
}

TEST(Vessel, FlowsFromTheOtherSideWhenTheInletIsNamed) {
  const auto data = tube();
  auto settings = every(0.02);
  settings.inlet = "lumen_outlet";
  const auto vessel = vessel_of(flow_in_tube(), settings, data);
  EXPECT_EQ(data.faces[vessel.end].name, "lumen_inlet");
  ASSERT_EQ(vessel.stations.size(), 2U);
  EXPECT_NEAR(vessel.stations[0].centre[2], tube_length - 0.02, 1e-7);
  EXPECT_LT(section(data, vessel.stations[0]).area[2], 0);
}

/// From either end: past the branch, pieces of two vessels have the same potential, in either order.
TEST(Vessel, StationsStayInTheAortaWhereABranchLeaves) {
  const auto data = channel_with_branch(2);
  for (const bool upwards : {true, false}) {
    auto settings = every(0.5);
    settings.inlet = upwards ? "inlet" : "end";
    settings.end = upwards ? "end" : "inlet";
    const auto vessel = vessel_of(flow_in_channel(), settings, data);
    ASSERT_GT(vessel.stations.size(), 8U);
    double last = 0;
    for (const auto& station : vessel.stations) {
      const double way = upwards ? station.centre[2] : 6 - station.centre[2];
      EXPECT_LT(station.centre[0], 1) << way;
      EXPECT_GT(way, last);
      last = way;
      // Before the branch and a diameter behind it the potential is that of a straight channel.
      if (std::abs(station.centre[2] - 2.5) < 1.5) continue;
      EXPECT_NEAR(section(data, station).size, 1, 0.01) << way;
      EXPECT_NEAR(norm(station.centre - Vec3<double>{{0.5, 0.5, station.centre[2]}}), 0, 0.02);
    }
    EXPECT_GT(last, 5);
  }
}

TEST(Vessel, TheAortaEndsAtTheFarthestOpeningUnlessAnotherIsNamed) {
  const auto data = channel_with_branch(5);  // 7 to the end of the branch, 6 along the channel
  const auto run = flow_in_channel();
  auto vessel = vessel_of(run, every(0.5), data);
  EXPECT_EQ(data.faces[vessel.end].name, "branch");
  EXPECT_GT(vessel.stations.back().centre[0], 5);
  EXPECT_EQ(farthest_opening(data, vessel), vessel.end);
  auto settings = every(0.5);
  settings.end = "end";
  vessel = vessel_of(run, settings, data);
  for (const auto& station : vessel.stations) EXPECT_LT(station.centre[0], 1);
  // Seen from the end of the branch, the end of the channel is the farther one of the two others.
  vessel.inlet = 2;
  EXPECT_EQ(data.faces[farthest_opening(data, vessel)].name, "end");
}

/// As those of another mesh of the vessel, whose line was longer here.
TEST(Vessel, TakesTheDistancesThatTheMeshBringsAlong) {
  auto data = tube();
  mesh::NodeField field{mesh::distance_along, {}};
  for (const auto& x : data.points) field.values.push_back(1.3 * x[2]);
  data.node_fields.push_back(field);
  const auto vessel = vessel_of(flow_in_tube(), every(0.01), data);
  EXPECT_EQ(vessel.stations.size(), static_cast<std::size_t>(std::floor(1.3 * tube_length / 0.01 - 0.5)));
  for (const auto& station : vessel.stations) EXPECT_NEAR(1.3 * station.centre[2], station.distance, 1e-9);

  for (const double factor : {1e3, 0.5, -1.0}) {
    data.node_fields.back() = field;
    for (auto& s : data.node_fields.back().values) s *= factor;
    try {
      vessel_of(flow_in_tube(), every(0.01), data);
      ADD_FAILURE() << factor;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("point array distance_along"), std::string::npos) << error.what();
    }
  }
}

TEST(Vessel, LumensMeetInThePlaneBetweenTheirWalls) {
  const auto data = two_lumens();
  const auto vessel = vessel_of(flow_in_two_lumens(), every(0.5), data);
  EXPECT_TRUE(vessel.left_out.empty());
  const auto* lumen = lumen_region(data);
  double volume = 0;
  for (auto e = lumen->first_element; e < lumen->end_element; ++e) {
    const auto& nodes = data.tetrahedra[static_cast<std::size_t>(e)];
    for (const auto node : nodes)
      EXPECT_NEAR(vessel.side[static_cast<std::size_t>(node)], 2 * data.points[static_cast<std::size_t>(node)][1] - 1,
                  1e-6);
    volume += vessel.false_share[static_cast<std::size_t>(e)] * mesh::volume(data.points, nodes);
  }
  EXPECT_NEAR(volume, 4, 1e-5);
  ASSERT_EQ(vessel.tears.size(), 1U);
  const auto& tear = vessel.tears[0];
  EXPECT_EQ(tear.name, "tear_1");
  EXPECT_NEAR(tear.area, 8, 1e-5);
  EXPECT_NEAR(norm(tear.centre - Vec3<double>{{1, 0.5, 2}}), 0, 1e-5);
  EXPECT_NEAR(tear.distance, 2, 0.3);  // that of the station next to its centre
  EXPECT_NEAR(norm(evaluate(tear.surface, {.points = &data.points}).area - Vec3<double>{{0, -8, 0}}), 0, 1e-5);
  for (const auto& station : vessel.stations)
    for (const auto& part : station.sections)
      // Sections may bend along z; from ahead each is half of the channel.
      EXPECT_NEAR(evaluate(part, {.points = &data.points}).area[2], 1, 1e-5);
}

TEST(Vessel, SectionsAreSplitWithoutGapOrOverlapWhereverTheLumensMeet) {
  const auto data = two_lumens();
  auto vessel = vessel_of(flow_in_two_lumens(), every(0.5), data);
  const auto whole = make_stations(
      data,
      [&] {
        auto one = vessel;
        one.side.clear();
        return one;
      }(),
      0.5);
  vessel.side = nodal(data, [](const auto& x) { return x[1] - 0.3 - 0.1 * x[0]; });
  const auto split = make_stations(data, vessel, 0.5);
  ASSERT_EQ(split.size(), whole.size());
  for (std::size_t k = 0; k < whole.size(); ++k) {
    const auto all = evaluate(whole[k].sections[0], {.points = &data.points});
    const auto in_true = evaluate(split[k].sections[0], {.points = &data.points});
    const auto in_false = evaluate(split[k].sections[1], {.points = &data.points});
    EXPECT_NEAR(in_true.size + in_false.size, all.size, 1e-10);
    EXPECT_NEAR(norm(in_true.area + in_false.area - all.area), 0, 1e-10);
    EXPECT_NEAR(in_false.area[2], 0.8, 1e-10);  // integral of 0.3 + 0.1 x over x from 0 to 2
    EXPECT_NEAR(norm(split[k].centre - whole[k].centre), 0, 1e-10);
  }
  // A sliver of less than a hundredth of the section is no lumen.
  vessel.side = nodal(data, [](const auto& x) { return x[1] - 0.008; });
  for (const auto& station : make_stations(data, vessel, 0.5)) EXPECT_TRUE(station.sections[1].empty());
}

TEST(Vessel, OpeningsBelongToTheLumenOfMostOfTheirNodes) {
  const auto data = two_lumens();
  auto run = flow_in_two_lumens();
  // Blood also leaves through the plates' faces of the lumen, as if branches began there.
  run.sticking_faces = {"lumen_x_min", "lumen_x_max"};
  const auto vessel = vessel_of(run, every(0.5), data);
  ASSERT_EQ(vessel.openings.size(), 4U);
  for (const auto& opening : vessel.openings) {
    if (opening.name == "lumen_y_min") {
      EXPECT_TRUE(opening.in_false_lumen);
    }
    if (opening.name == "lumen_y_max") {
      EXPECT_FALSE(opening.in_false_lumen);
    }
  }
  EXPECT_EQ(vessel.inside.size(), 2U * 4 * 6 * 2);
}

TEST(Vessel, SaysWhatItHasNothingFor) {
  const auto parts = [](const Vessel& vessel) {
    std::string text;
    for (const auto& [part, why] : vessel.left_out) text += part + ": " + why + "\n";
    return text;
  };
  auto run = flow_in_two_lumens();
  run.fluid = false;
  const auto data = two_lumens();
  const auto dry = vessel_of(run, {}, data);
  EXPECT_NE(parts(dry).find("stations: the analysis has no flow"), std::string::npos) << parts(dry);
  EXPECT_TRUE(dry.stations.empty() && dry.openings.empty());

  const auto pipe = vessel_of(flow_in_tube(), every(0.02), tube());
  EXPECT_NE(parts(pipe).find("tears: there is no wall"), std::string::npos) << parts(pipe);

  auto renamed = data;
  renamed.regions[1].name = "intima";
  const auto unknown = vessel_of(flow_in_two_lumens(), every(0.5), renamed);
  EXPECT_NE(parts(unknown).find("name those along the lumens in post.lumens"), std::string::npos) << parts(unknown);
  EXPECT_TRUE(unknown.side.empty() && unknown.tears.empty());
  auto settings = every(0.5);
  settings.lumens = frames::LumenWalls{{"intima"}, {"false_lumen_wall"}};
  EXPECT_TRUE(vessel_of(flow_in_two_lumens(), settings, renamed).left_out.empty());
}

TEST(Vessel, ErrorsNameEverythingThatIsWrongAndWhatThereIs) {
  const auto data = two_lumens();
  auto settings = every(0.5);
  settings.inlet = "ascending";
  settings.end = "iliac";
  settings.lumens = frames::LumenWalls{{"media"}, {"false_lumen_wall"}};
  const auto text = message_of<InputError>([&] { vessel_of(flow_in_two_lumens(), settings, data); });
  for (const char* part : {"post.inlet", "'ascending'", "post.end", "'iliac'", "lumen_z_min, lumen_z_max",
                           "post.lumens.true_lumen", "'media'", "true_lumen_wall, false_lumen_wall"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " in\n" << text;
}

TEST(Vessel, RefusesVesselsWithoutAWayThrough) {
  const auto data = tube();
  auto settings = every(0.01);
  settings.end = "lumen_inlet";
  EXPECT_NE(message_of<InputError>([&] { vessel_of(flow_in_tube(), settings, data); }).find("post.end: is the inlet"),
            std::string::npos);
  auto run = flow_in_tube();
  run.sticking_faces.push_back("lumen_outlet");
  EXPECT_NE(message_of<InputError>([&] { vessel_of(run, every(0.01), data); }).find("the lumen has no other opening"),
            std::string::npos);
  const auto text = message_of<InputError>([&] { vessel_of(flow_in_tube(), every(0.2), data); });
  EXPECT_NE(text.find("leaves no station on an aorta of 60 mm"), std::string::npos) << text;
}

TEST(Vessel, TheInletIsTheOneThatIsNamedOrTheOnlyOneWithAFlow) {
  RunDescription run;
  EXPECT_EQ(inlet_name(run, {}), "lumen_inlet");
  run.inflow_faces = {"ascending"};
  EXPECT_EQ(inlet_name(run, {}), "ascending");
  run.inflow_faces = {"ascending", "graft"};
  EXPECT_EQ(inlet_name(run, {}), "lumen_inlet");
  PostSettings settings;
  settings.inlet = "graft";
  EXPECT_EQ(inlet_name(run, settings), "graft");
}

}  // namespace
}  // namespace tunica::analysis
