// Figures of single instants on vessels and with fields for which they are known exactly.
#include "tunica/analysis/frame_figures.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "small_vessels.hpp"
#include "tunica/analysis/cycle.hpp"
#include "tunica/parallel/agree.hpp"

namespace tunica::analysis {
namespace {

using namespace testing;
using Named = std::map<std::string, double>;

Named named(const FigureTable::Row& row) { return {row.begin(), row.end()}; }

/// Everything that FrameFigures refers to.
struct Scene {
  RunDescription run;
  PostSettings settings;
  mesh::MeshData data;
  Vessel vessel;

  Scene(RunDescription r, mesh::MeshData d, double spacing) : run(std::move(r)), data(std::move(d)) {
    settings.spacing = spacing;
    settings.percentiles = {50, 95};
    settings.flap = "true_lumen_wall";
    tell_lumens_apart(run, settings, data, MPI_COMM_WORLD);
    vessel = make_vessel(run, settings, data, MPI_COMM_WORLD);
  }
  FrameFigures figures(std::vector<std::string> stresses = {}, std::vector<double> start = {}) const {
    return {run, settings, data, vessel, std::move(stresses), std::move(start)};
  }
  FieldFrame no_fields() const {
    FieldFrame frame;
    frame.velocity.assign(3 * data.points.size(), 0);
    frame.pressure.assign(data.points.size(), 0);
    return frame;
  }
};

TEST(FrameFigures, LinearPressureAndUniformFlowInATube) {
  const Scene tube_scene(flow_in_tube(), tube(), 0.01);
  auto frame = tube_scene.no_fields();
  frame.pressure = nodal(tube_scene.data, [](const auto& x) { return 12000 - 3e4 * x[2] + 1e3 * x[0]; });
  frame.velocity = nodal_vectors(tube_scene.data, [](const auto& x) { return Vec3<double>{{x[1], -x[0], 0.4}}; });
  const auto found = named(tube_scene.figures().evaluate(frame, {}));
  ASSERT_EQ(tube_scene.vessel.stations.size(), 5U);
  for (std::size_t s = 0; s < 5; ++s) {
    EXPECT_NEAR(found.at(column::station(s, 0, "area")), polygon_area(), 1e-6 * polygon_area());
    EXPECT_NEAR(found.at(column::station(s, 0, "flow")), 0.4 * polygon_area(), 1e-6 * polygon_area());
    EXPECT_NEAR(found.at(column::station(s, 0, "pressure")), 12000 - 300 * static_cast<double>(s + 1), 0.01);
  }
  EXPECT_NEAR(found.at(column::opening("lumen_inlet", "flow")), -0.4 * polygon_area(), 1e-15);
  EXPECT_NEAR(found.at(column::opening("lumen_outlet", "flow")), 0.4 * polygon_area(), 1e-15);
  EXPECT_NEAR(found.at(column::opening("lumen_outlet", "pressure")), 10200, 1e-8);
}

/// Linear elements see Poiseuille's parabola by its values at the nodes: the flow through the sections misses that of
/// the circle by the second power of the mesh size, and is the same at each.
TEST(FrameFigures, PoiseuilleFlowConvergesWithTheSecondPower) {
  double errors[2];
  for (int k = 0; k < 2; ++k) {
    const int n = 1 << k;
    const Scene scene(
        flow_in_tube(),
        mesh::tube(
            {.radius = tube_radius, .length = tube_length, .cells_around = 8 * n, .cells_radial = n, .cells_along = 3}),
        0.02);
    auto frame = scene.no_fields();
    frame.velocity = nodal_vectors(scene.data, [](const auto& x) {
      return Vec3<double>{{0, 0, 1 - (x[0] * x[0] + x[1] * x[1]) / (tube_radius * tube_radius)}};
    });
    const auto found = named(scene.figures().evaluate(frame, {}));
    const double exact = 0.5 * M_PI * tube_radius * tube_radius;
    errors[k] = 1 - found.at(column::station(0, 0, "flow")) / exact;
    EXPECT_NEAR(found.at(column::station(1, 0, "flow")), found.at(column::station(0, 0, "flow")), 1e-6 * exact);
    EXPECT_NEAR(found.at(column::opening("lumen_outlet", "flow")), found.at(column::station(0, 0, "flow")),
                1e-6 * exact);
  }
  EXPECT_GT(errors[1], 0);  // chords lie within
  EXPECT_NEAR(errors[0] / errors[1], 4, 0.4);
}

TEST(FrameFigures, RigidMotionChangesNoFigure) {
  const Scene scene(flow_in_two_lumens(), two_lumens(), 0.5);
  auto frame = scene.no_fields();
  frame.displacement.assign(3 * scene.data.points.size(), 0);
  frame.velocity = nodal_vectors(scene.data, [](const auto& x) { return Vec3<double>{{x[2], x[0] * x[0], 2 - x[1]}}; });
  frame.pressure = nodal(scene.data, [](const auto& x) { return x[0] + 3 * x[2]; });
  const auto still = named(scene.figures().evaluate(frame, {}));
  const Vec3<double> axis{{0.6, 0, 0.8}}, shift{{1, 2, -3}};
  const auto turn = [&](const Vec3<double>& x) { return turned(x, axis, 1.1); };
  frame.displacement = nodal_vectors(scene.data, [&](const auto& x) { return turn(x) + shift - x; });
  for (std::size_t n = 0; n < scene.data.points.size(); ++n) {
    double* v = frame.velocity.data() + 3 * n;
    const auto t = turn({{v[0], v[1], v[2]}});
    std::copy(t.x, t.x + 3, v);
  }
  // The frame itself moves and turns with a speed that blood and mesh have in common.
  const auto common = nodal_vectors(scene.data, [&](const auto& x) {
    const auto here = turn(x) + shift;
    return Vec3<double>{{5 + here[1], -here[0], 7}};
  });
  for (std::size_t i = 0; i < common.size(); ++i) frame.velocity[i] += common[i];
  auto moved = named(scene.figures().evaluate(frame, common));
  EXPECT_NEAR(moved.at(column::flap_largest), norm(turn({{2, 1.25, 4}}) + shift - Vec3<double>{{2, 1.25, 4}}), 1.0);
  for (const auto& [name, value] : still)
    if (name.find("flap") == std::string::npos) {
      EXPECT_NEAR(moved.at(name), value, 1e-9) << name;
    }
}

TEST(FrameFigures, EachLumenHasItsFlowAndTheTearWhatCrosses) {
  const Scene scene(flow_in_two_lumens(), two_lumens(), 0.5);
  auto frame = scene.no_fields();
  // Free of divergence, along z faster in the true lumen, and across the plane between them.
  frame.velocity = nodal_vectors(scene.data, [](const auto& x) { return Vec3<double>{{0, -0.5 - x[0], 3 * x[1]}}; });
  const auto found = named(scene.figures().evaluate(frame, {}));
  for (std::size_t s = 0; s < scene.vessel.stations.size(); ++s) {
    // As much passes any section that spans the channel as passes a flat one, but for what crosses the bend of it.
    const double both = found.at(column::station(s, 0, "flow")) + found.at(column::station(s, 1, "flow"));
    EXPECT_NEAR(both, 3, 0.15);
    EXPECT_GT(found.at(column::station(s, 0, "flow")), 2 * found.at(column::station(s, 1, "flow")));
  }
  EXPECT_NEAR(found.at("tear_1 flow"), 1.5 * 8, 1e-5);  // into the false lumen
  EXPECT_NEAR(found.at("tear_1 area"), 8, 1e-5);
}

TEST(FrameFigures, VolumesGrowAtTheRateThatIsReported) {
  const Scene scene(flow_in_two_lumens(), two_lumens(), 1);
  const auto figures = scene.figures();
  const auto w = nodal_vectors(scene.data, [](const auto& x) {
    return Vec3<double>{{0.3 * x[0] * x[1], 0.2 * x[1] + 0.1 * x[2] * x[2], -0.1 * x[2] * x[0]}};
  });
  const auto at = [&](double t, const char* what) {
    auto frame = scene.no_fields();
    frame.displacement = w;
    for (auto& d : frame.displacement) d *= t;
    return named(figures.evaluate(frame, w)).at(what);
  };
  EXPECT_NEAR(at(0, column::true_volume) + at(0, column::false_volume), 8, 1e-10);
  // Volumes are cubic in t: this difference is exact.
  constexpr double h = 0.1;
  for (const double t : {0.0, 0.7}) {
    const auto difference = [&](double step) {
      return at(t + step, column::false_volume) - at(t - step, column::false_volume);
    };
    EXPECT_NEAR(at(t, column::false_volume_rate), (8 * difference(h) - difference(2 * h)) / (12 * h), 1e-10) << t;
  }
}

/// The mesh moves within the resting blood, arbitrarily but for the boundary of the lumen: the false lumen grows by
/// just what passes the surface of the tear, element by element.
TEST(FrameFigures, MassOfTheFalseLumenIsBalancedExactly) {
  Scene scene(flow_in_two_lumens(), two_lumens(), 1);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  const auto w = nodal_vectors(scene.data, [&](const auto& x) {
    const bool inside = x[0] > 0.1 && x[0] < 1.9 && x[1] > 0.1 && x[1] < 0.9 && x[2] > 0.1 && x[2] < 3.9;
    return inside ? Vec3<double>{{any(random), any(random), any(random)}} : Vec3<double>{{0, 0, 0}};
  });
  auto frame = scene.no_fields();
  frame.displacement = w;
  for (auto& d : frame.displacement) d *= 0.05;
  const auto found = named(scene.figures().evaluate(frame, w));
  EXPECT_GT(std::abs(found.at(column::false_volume_rate)), 1e-3);
  EXPECT_NEAR(found.at(column::false_volume_rate), found.at("tear_1 flow"), 1e-12);
}

TEST(FrameFigures, TheFlapMovesFromWhereTheWindowBegan) {
  const Scene scene(flow_in_two_lumens(), two_lumens(), 1);
  const auto start = nodal_vectors(scene.data, [](const auto& x) { return Vec3<double>{{x[2], 7, x[0]}}; });
  auto frame = scene.no_fields();
  frame.displacement = start;
  // By 0.01 (1 + z) in one direction: the mean over the volume is that at its middle, z = 2.
  for (std::size_t n = 0; n < scene.data.points.size(); ++n) {
    frame.displacement[3 * n] += 0.006 * (1 + scene.data.points[n][2]);
    frame.displacement[3 * n + 1] -= 0.008 * (1 + scene.data.points[n][2]);
  }
  const auto found = named(scene.figures({}, start).evaluate(frame, {}));
  EXPECT_NEAR(found.at(column::flap_mean), 0.03, 1e-12);
  EXPECT_NEAR(found.at(column::flap_largest), 0.05, 1e-12);
}

TEST(FrameFigures, StressesAreWeighedByVolume) {
  const Scene scene(flow_in_two_lumens(), two_lumens(), 1);
  auto frame = scene.no_fields();
  frame.displacement.assign(3 * scene.data.points.size(), 0);
  frame.stress.assign(1, std::vector<double>(scene.data.tetrahedra.size(), std::nan("")));
  // Below z = 2 twice that of above; where the false lumen's plate has none it does not count.
  const auto set = [&](const mesh::RegionData& region, double low, double high) {
    for (auto e = region.first_element; e < region.end_element; ++e)
      frame.stress[0][static_cast<std::size_t>(e)] =
          mesh::centroid(scene.data.points, scene.data.tetrahedra[static_cast<std::size_t>(e)])[2] < 2 ? low : high;
  };
  set(scene.data.regions[1], 200, 100);
  set(scene.data.regions[2], std::nan(""), 40);
  const auto found = named(scene.figures({"von Mises stress"}).evaluate(frame, {}));
  EXPECT_NEAR(found.at("true_lumen_wall: von Mises stress: mean"), 150, 1e-10);
  EXPECT_EQ(found.at("true_lumen_wall: von Mises stress: 95"), 200);
  EXPECT_NEAR(found.at("false_lumen_wall: von Mises stress: mean"), 40, 1e-12);
  EXPECT_EQ(found.at("false_lumen_wall: von Mises stress: 50"), 40);
  EXPECT_FALSE(found.contains("lumen: von Mises stress: mean"));
}

/// Frames are looked at by whichever rank they belong to, and the sums are those of one rank.
TEST(CycleFields, ShearThatTurnsRoundOverTheRanks) {
  const Scene scene(flow_in_tube(), tube(), 0.02);
  const auto figures = scene.figures();
  constexpr int frames = 12;
  std::vector<double> times;
  for (int k = 0; k <= frames; ++k) times.push_back(0.8 * k / frames);
  const auto weights = trapezoid_weights(times);
  const int rank = parallel::rank(MPI_COMM_WORLD), ranks = parallel::size(MPI_COMM_WORLD);
  auto fields = figures.no_fields();
  for (std::size_t k = 0; k < times.size(); ++k) {
    if (static_cast<int>(k) % ranks != rank) continue;
    FieldFrame frame;
    // One period of a cosine along z beside a steady stress around the tube; the latter is three times the former.
    const double swing = std::cos(2 * M_PI * static_cast<double>(k) / frames);
    frame.wall_shear = nodal_vectors(scene.data, [&](const auto& x) {
      return x[2] < 0.5 * tube_length ? Vec3<double>{{0, 0, 2 * swing}} : Vec3<double>{{0, 3, 4}};
    });
    figures.add(frame, weights[k], fields);
  }
  gather(MPI_COMM_WORLD, fields);
  if (rank != 0) return;
  std::vector<bool> wall(scene.data.points.size(), false);
  for (const auto& t : scene.vessel.inside)
    for (const auto node : t) wall[static_cast<std::size_t>(node)] = true;
  // |cos| by the trapezoidal rule with twelve intervals: (2 + 4 cos 30 + 4 cos 60) / 12.
  const double mean = 2 * (2 + 4 * std::cos(M_PI / 6) + 2) / 12;
  for (std::size_t n = 0; n < wall.size(); ++n) {
    const double* sums = fields.shear.data() + 4 * n;
    if (!wall[n]) {
      EXPECT_EQ(sums[0], 0);
      continue;
    }
    const auto found = shear_figures(sums[0], {{sums[1], sums[2], sums[3]}}, 0.8);
    const bool swings = scene.data.points[n][2] < 0.5 * tube_length;
    EXPECT_NEAR(found.tawss, swings ? mean : 5, 1e-12);
    EXPECT_NEAR(found.osi, swings ? 0.5 : 0, 1e-12);
  }
}

TEST(CycleFields, TheLargestStressOfAnyInstantAndRank) {
  const Scene scene(flow_in_two_lumens(), two_lumens(), 1);
  const auto figures = scene.figures({"von Mises stress"});
  const int rank = parallel::rank(MPI_COMM_WORLD);
  auto fields = figures.no_fields();
  FieldFrame frame;
  frame.wall_shear.assign(3 * scene.data.points.size(), 0);
  for (const double swing : {1.0, -1.0}) {
    frame.stress.assign(1, std::vector<double>(scene.data.tetrahedra.size(), std::nan("")));
    // Compression alone in the second element, nothing in the third, and one rank has nothing of the fourth.
    frame.stress[0][0] = 10 * rank + swing;
    frame.stress[0][1] = -5 - rank + swing;
    if (rank == 0) frame.stress[0][3] = -2;
    figures.add(frame, 1, fields);
  }
  gather(MPI_COMM_WORLD, fields);
  if (rank != 0) return;
  const auto& most = fields.max_stress[0];
  EXPECT_EQ(most[0], 10 * (parallel::size(MPI_COMM_WORLD) - 1) + 1);
  EXPECT_EQ(most[1], -4);
  EXPECT_TRUE(std::isnan(most[2]));
  EXPECT_EQ(most[3], -2);
}

TEST(FigureTable, BringsTheRowsOfAllRanksIntoTheOrderOfTheFrames) {
  const int rank = parallel::rank(MPI_COMM_WORLD), ranks = parallel::size(MPI_COMM_WORLD);
  FigureTable table(11);
  for (int k = 0; k < 11; ++k)
    if ((k * 5 + ranks) % ranks == rank) table.set(static_cast<std::size_t>(k), {{"z", 3.0 * k}, {"a", -k * k}});
  table.gather(MPI_COMM_WORLD);
  if (rank != 0) return;
  EXPECT_TRUE(table.has("a") && table.has("z"));
  EXPECT_FALSE(table.has("b"));
  for (int k = 0; k < 11; ++k) {
    EXPECT_EQ(table.column("z")[static_cast<std::size_t>(k)], 3 * k);
    EXPECT_EQ(table.column("a")[static_cast<std::size_t>(k)], -k * k);
  }
}

}  // namespace
}  // namespace tunica::analysis
