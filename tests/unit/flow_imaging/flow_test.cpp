#include <gtest/gtest.h>

#include "tube_flow.hpp"
#include "tunica/base/error.hpp"
#include "tunica/flow_imaging/inlet_profile.hpp"

namespace tunica::flow_imaging {
namespace {

struct Measured {
  VelocitySeries series;
  LumenVoxels lumen;
  Noise noise;
};

Measured measured(const TubeFlow& tube, const PhaseContrast& scan, double pulse = 1.2) {
  Measured m{.series = tube.imaged(scan, pulse), .lumen = {}, .noise = {}};
  m.lumen = lumen_voxels(m.series, tube.mesh, 0);
  unwrap(m.series, near_lumen(m.series.frame, m.lumen.shares, 1));
  const auto at_rest = static_tissue(m.series, near_lumen(m.series.frame, m.lumen.shares, 3));
  subtract(m.series, fit_offset(m.series, at_rest, 1));
  m.noise = measure_noise(m.series, at_rest);
  m.lumen = lumen_voxels(m.series, tube.mesh, m.noise.magnitude);
  return m;
}

double true_flow(const TubeFlow& tube, const CrossSection& section, double t, double pulse = 1.2) {
  const auto instant = tube.at(t, pulse);
  std::vector<double> velocity;
  for (const auto& v : instant.velocity) velocity.insert(velocity.end(), {v[0], v[1], v[2]});
  return state_of(section, {.velocity = velocity}).flow;
}

TEST(Flow, SectionOfTubeHasItsAreaAndRim) {
  const TubeFlow tube;
  const auto s = plane_section(tube.mesh, {{0, 0, 21e-3}}, {{0, 0, 2}}, "middle", "planes.middle");
  EXPECT_NEAR(s.area, M_PI * 1e-4, 0.02 * M_PI * 1e-4);
  EXPECT_NEAR(s.normal[2], 1, 1e-12);
  for (const auto& edge : s.rim)
    EXPECT_GT(
        std::hypot(s.points[static_cast<std::size_t>(edge[0])][0], s.points[static_cast<std::size_t>(edge[0])][1]),
        0.97 * tube.radius);
  EXPECT_GE(s.rim.size(), 32U);
  EXPECT_NEAR(true_flow(tube, s, 0), 0.5 * tube.axial(0) * M_PI * 1e-4, 0.02 * 0.5 * tube.axial(0) * M_PI * 1e-4);
}

TEST(Flow, PlaneOutsideTheLumenIsTold) {
  const TubeFlow tube;
  EXPECT_THROW(plane_section(tube.mesh, {{0, 0, 90e-3}}, {{0, 0, 1}}, "p", "planes.p"), InputError);
  EXPECT_THROW(plane_section(tube.mesh, {{60e-3, 0, 20e-3}}, {{0, 0, 1}}, "p", "planes.p"), InputError);
}

TEST(Flow, ComesBackFromNoisyWrappedImagesWithAnOffset) {
  const TubeFlow tube;
  PhaseContrast scan;
  scan.encoding = 0.4;  // the peak of 0.55 m/s wraps
  scan.background = 0.03;
  scan.tilt = 0.4;
  const auto m = measured(tube, scan);
  const double expected = std::sqrt(2.0) * scan.encoding / (M_PI * scan.signal_to_noise) / scan.tissue_signal;
  EXPECT_NEAR(m.noise.deviation, expected, 0.1 * expected);
  for (const double z : {15e-3, 25e-3, 35e-3}) {
    const auto section = plane_section(tube.mesh, {{0, 0, z}}, {{0, 0, 1}}, "plane", "planes.plane");
    const ProfileFit fit(m.series, m.lumen, section, m.noise, {});
    const auto curve = flow_curve(m.series, fit, section);
    double mean = 0, squares = 0, size = 0;
    for (std::size_t k = 0; k < curve.flow.size(); ++k) {
      const double truth = true_flow(tube, section, m.series.times[k]);
      mean += truth / static_cast<double>(curve.flow.size());
      squares += std::pow(curve.flow[k] - truth, 2);
      size += truth * truth;
    }
    EXPECT_NEAR(curve.mean(), mean, 0.02 * mean) << "at z = " << z;
    EXPECT_LT(std::sqrt(squares / size), 0.03) << "at z = " << z;
    // The stated deviation is that of the frames, but for what is the same in all of them.
    const double scatter = std::sqrt(squares / static_cast<double>(curve.flow.size()));
    EXPECT_LT(scatter, 3 * curve.deviation_by_noise() + 0.015 * mean);
    EXPECT_GT(scatter, curve.deviation_by_noise() / 3);
  }
}

TEST(Flow, WrappedVelocitiesAreUnwrapped) {
  const TubeFlow tube;
  PhaseContrast scan;
  scan.encoding = 0.3;
  scan.frames = 12;
  scan.signal_to_noise = 40;
  auto wrapped = tube.imaged(scan), clear = wrapped;
  scan.encoding = 1;
  clear = tube.imaged(scan);
  const auto lumen = lumen_voxels(wrapped, tube.mesh, 0);
  EXPECT_GT(unwrap(wrapped, near_lumen(wrapped.frame, lumen.shares, 0)), 1000);
  for (std::size_t v = 0; v < lumen.shares.size(); ++v)
    for (std::size_t k = 0; lumen.shares[v] > 0.95F && k < wrapped.frames(); ++k)
      EXPECT_NEAR(wrapped.velocity[k][2][v], clear.velocity[k][2][v], 0.15);
}

TEST(Flow, ProfileOfInletIsZeroOnTheRimCarriesTheFlowAndFollowsTheTruth) {
  const TubeFlow tube;
  PhaseContrast scan;
  scan.encoding = 0.7;
  scan.frames = 12;
  const auto m = measured(tube, scan);
  const auto& face = tube.mesh.faces.front();
  ASSERT_EQ(face.name, "lumen_inlet");
  const auto section = opening_section(tube.mesh, face);
  const ProfileFit fit(m.series, m.lumen, section, m.noise, {.length = tube.radius, .slab = 2, .at_end = true});
  const auto opening = opening_mesh(tube.mesh, face);
  std::vector<double> outflow;
  for (std::size_t k = 0; k < m.series.frames(); ++k) outflow.push_back(fit.flow()[k]);
  const auto course = profile_at_nodes(m.series, fit, opening, outflow);
  double squares = 0, size = 0;
  const auto rim = bc::rim_nodes(opening.face());
  for (std::size_t k = 0; k < course.times.size(); ++k) {
    EXPECT_NEAR(opening.outflow(course.values[k]), outflow[k], 1e-9 * std::abs(outflow[k]) + 1e-15);
    for (std::size_t n = 0; n < opening.points.size(); ++n) {
      const auto& x = opening.points[n];
      const double r = std::hypot(x[0], x[1]) / tube.radius;
      const Vec3<double> truth{{0, 0, tube.axial(course.times[k]) * std::max(0.0, 1 - r * r)}};
      squares += dot(course.values[k][n] - truth, course.values[k][n] - truth);
      size += dot(truth, truth);
      if (rim[n]) {
        EXPECT_EQ(norm(course.values[k][n]), 0);
      }
    }
  }
  EXPECT_LT(std::sqrt(squares / size), 0.04);
  const auto fine = resampled(course, 100);
  ASSERT_EQ(fine.times.size(), 100U);
  for (std::size_t n = 0; n < opening.points.size(); ++n)
    EXPECT_NEAR(fine.values[25][n][2], course.values[3][n][2], 1e-12);
}

TEST(Flow, MeansAreBalancedByTheirVariances) {
  std::vector<FlowCurve> curves(3);
  for (auto& c : curves) c.weights = {0.5, 0.5}, c.deviation_of_mean = 1;
  curves[0].flow = {10, 14}, curves[1].flow = {5, 7}, curves[2].flow = {2, 4};
  curves[2].deviation_of_mean = 2;
  const std::vector<int> signs{1, -1, -1};
  EXPECT_NEAR(balance_means(curves, signs), 3, 1e-12);
  EXPECT_NEAR(curves[0].mean() - curves[1].mean() - curves[2].mean(), 0, 1e-12);
  EXPECT_NEAR(curves[2].mean() - 3, 4 * (curves[1].mean() - 6), 1e-12);
}

TEST(Series, FramesOutOfOrderAndDoubledAreNamed) {
  const auto message = [](const auto& act) {
    try {
      act();
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(message([] {
              in_order_of_numbers({"v_2.nrrd", "v_02.nrrd"}, "velocity.x");
            }).find("are both frame 2"),
            std::string::npos);
  EXPECT_NE(message([] {
              in_order_of_numbers({"v_1.nrrd", "v_3.nrrd"}, "velocity.x");
            }).find("after frame 1"),
            std::string::npos);
  EXPECT_EQ(in_order_of_numbers({"v_10.nrrd", "v_9.nrrd"}, "x")[0], "v_9.nrrd");
  EXPECT_NE(message([] {
              frame_times({0, 0.2, 0.1}, 1, {"a", "b", "c"}, "times");
            }).find("frame c of 0.1 s stands behind"),
            std::string::npos);
  EXPECT_NE(message([] {
              frame_times({0, 0.2, 0.2}, 1, {"a", "b", "c"}, "times");
            }).find("frames b and c both"),
            std::string::npos);
  EXPECT_NE(message([] {
              frame_times({0, 0.2, 1.2}, 1, {"a", "b", "c"}, "times");
            }).find("within one period"),
            std::string::npos);
}

TEST(Series, UnitsThatMakeNoBloodVelocitiesAreTold) {
  const TubeFlow tube;
  PhaseContrast scan;
  scan.frames = 4;
  auto series = tube.imaged(scan);
  EXPECT_NO_THROW(check_plausible(series, "velocity.unit"));
  for (auto& of_frame : series.velocity)
    for (auto& component : of_frame)
      for (auto& v : component) v *= 100;  // cm/s that are taken for m/s
  EXPECT_THROW(check_plausible(series, "velocity.unit"), InputError);
}

}  // namespace
}  // namespace tunica::flow_imaging
