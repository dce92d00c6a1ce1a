#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <set>

#include "temporary_folder.hpp"
#include "tunica/geometry/surface_file.hpp"
#include "tunica/stages/validate/benchmark.hpp"
#include "tunica/stages/validate/revolved.hpp"
#include "tunica/stages/validate/validation_page.hpp"

namespace tunica::stages::validate {

TEST(Validate, BenchmarksHaveNamesOfTheirOwnAndPoseBothVariants) {
  std::set<std::string> names;
  for (const auto& b : benchmarks()) {
    EXPECT_TRUE(names.insert(b.name).second) << b.name;
    EXPECT_FALSE(b.source.empty()) << b.name;
    EXPECT_FALSE(b.references.empty()) << b.name;
    for (const auto& r : b.references) EXPECT_LE(r.full, r.quick) << b.name << ", " << r.name;
    if (b.long_run) continue;  // meshes of many elements
    for (const bool full : {false, true})
      EXPECT_NE(b.pose({.full = full}).case_text.find("elements: quadratic"), std::string::npos) << b.name;
  }
}

// The first of the orifice's figures and its likes: a value between what was computed and what was measured agrees.
TEST(Validate, NothingDeviatesBetweenReferenceAndMeasurement) {
  Finding finding;
  finding.benchmark.references = {{"a", "m", 2.0, 0, 0.1, 0.1, 3.0}, {"b", "m", 2.0, 0, 0.1, 0.1}};
  for (const auto& [value, band, single] : {std::array{2.5, 0.0, 0.25}, std::array{3.1, 0.05, 0.55},
                                            std::array{1.8, -0.1, -0.1}, std::array{2.0, 0.0, 0.0}}) {
    finding.values = {value, value};
    EXPECT_NEAR(finding.deviation(0), band, 1e-12) << value;
    EXPECT_NEAR(finding.deviation(1), single, 1e-12) << value;
  }
}

TEST(Validate, BesselFunctions) {
  EXPECT_NEAR(bessel(0, 1.0).real(), 0.7651976865579666, 1e-14);
  EXPECT_NEAR(bessel(1, 1.0).real(), 0.4400505857449335, 1e-14);
  // J_0'(z) = -J_1(z), where the argument is that of a wave in an aorta.
  const std::complex<double> z = 28.8 * std::pow(std::complex<double>(0, 1), 1.5), h(1e-4, 0);
  const auto slope = (bessel(0, z + h) - bessel(0, z - h)) / (2.0 * h);
  EXPECT_LT(std::abs(slope + bessel(1, z)) / std::abs(bessel(1, z)), 1e-7);
}

// Of the last period alone: what a start leaves in the first one does not count.
TEST(Validate, HarmonicOfTheLastPeriod) {
  std::vector<double> time, value;
  for (int k = 1; k <= 60; ++k) {
    time.push_back(0.01 * k);
    value.push_back(1.5 + 0.3 * std::cos(2 * std::numbers::pi * time.back() / 0.2 + 0.7) + (k <= 40 ? 5.0 * k : 0.0));
  }
  const auto amplitude = harmonic(time, value, 0.2);
  EXPECT_NEAR(std::abs(amplitude), 0.3, 1e-12);
  EXPECT_NEAR(std::arg(amplitude), 0.7, 1e-12);
}

TEST(Validate, RevolvedVesselHasTheAreaOfItsCircles) {
  const test::TemporaryFolder folder;
  const RevolvedVessel vessel{
      .profile = {{0, 10e-3}, {20e-3, 10e-3}, {20e-3, 4e-3}, {50e-3, 4e-3}}, .spacing = 0.5e-3, .around = 24};
  for (const auto& [name, content] : mesh_files(vessel)) std::ofstream(folder.path() / name) << content;
  const auto lumen = geometry::read_surface(folder.path() / "lumen.obj", 1e-3);
  const auto loops = geometry::boundary_loops(lumen);
  ASSERT_EQ(loops.size(), 2u);
  // Gauss's theorem with the vector (x, y, 0)/2: the caps add nothing.
  double volume = 0;
  for (const auto& t : lumen.triangles) {
    const auto normal = geometry::area_vector(lumen, t);
    for (int d = 0; d < 2; ++d)
      volume += normal[d] * (lumen.points[t[0]][d] + lumen.points[t[1]][d] + lumen.points[t[2]][d]) / 6;
  }
  const double exact = std::numbers::pi * (20e-3 * 100e-6 + 30e-3 * 16e-6);
  EXPECT_NEAR(volume, exact, 1e-6 * exact);  // outward, too
}

}  // namespace tunica::stages::validate
