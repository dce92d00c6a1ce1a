// The parts of `tunica verify`; the whole runs in the regression tests of the commands.
#include "tunica/stages/material/verify.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "folders.hpp"
#include "tunica/fe/tetrahedron.hpp"
#include "tunica/files/csv_file.hpp"

namespace tunica::stages {
namespace {

TEST(Verify, CubeOfThirtyTwoTetrahedra) {
  const mesh::MeshData cube = cube_of_32();
  ASSERT_EQ(cube.tetrahedra.size(), 32u);
  ASSERT_EQ(cube.points.size(), 19u);
  double volume = 0.0;
  for (const auto& t : cube.tetrahedra) {
    Vec3<double> X[4];
    for (int a = 0; a < 4; ++a) X[a] = cube.points[static_cast<std::size_t>(t[a])];
    const double V = fe::gradients(X).volume;
    EXPECT_GT(V, 0.0);
    volume += V;
  }
  EXPECT_NEAR(volume, 1e-9, 1e-21);
  std::size_t triangles = 0;
  for (const auto& face : cube.faces) triangles += face.triangles.size();
  EXPECT_EQ(triangles, 32u);
  EXPECT_EQ(std::count_if(cube.points.begin(), cube.points.end(),
                          [](const auto& x) { return x[2] > 1e-9 && x[2] < 1e-3 - 1e-9; }),
            1)
      << "nodes that are neither at the bottom nor at the top";
}

/// The curves against tables that were integrated elsewhere.
TEST(Verify, AnalyticCurvesEqualTheTables) {
  const std::filesystem::path folder = std::filesystem::path(TUNICA_SHARED_DATA) / "analytic";
  if (!std::filesystem::exists(folder / "shear.csv")) GTEST_SKIP() << "no reference data in " << TUNICA_SHARED_DATA;
  for (const CubeCase& c : cube_cases()) {
    const bool extension = c.loading == CubeLoading::extension;
    const files::CsvColumns table = files::read_csv(folder / (extension ? "uniaxial.csv" : "shear.csv"), "reference");
    const std::string family = c.material.tension_only ? "2fam_switch" : "2fam_noswitch";
    const std::string name =
        extension ? (c.material.shear_modulus < 75e3 ? "sigma_mu50_" : "sigma_mu100_") + family : "sigma13_" + family;
    const auto &loads = table.column(extension ? "lambda" : "c"), &expected = table.column(name);
    double worst = 0.0;
    for (std::size_t n = 1; n < loads.size(); ++n)
      worst = std::max(worst, std::abs(1e-3 * analytic_stress(c, loads[n]) / expected[n] - 1.0));
    std::printf("%s: largest relative difference %.1e\n", name.c_str(), worst);
    EXPECT_LT(worst, 1e-6) << name;
  }
}

TEST(Verify, ElementsMeetTheMaterialPoint) {
  for (const CubeCase& c : {cube_cases().front(), cube_cases().back()}) {
    const VerifiedCase v = verify_case(c);
    for (const Comparison& comparison : compare(v))
      EXPECT_TRUE(comparison.passed()) << comparison.test << " " << comparison.what << " " << comparison.difference;
    EXPECT_LE(v.mixed.newton_iterations, 5 * static_cast<int>(v.loads.size()));
    EXPECT_LE(v.displacement.newton_iterations, 5 * static_cast<int>(v.loads.size()));
  }
}

TEST(Verify, DifferencesAboveTheirBoundsFail) {
  const CubeCase c = cube_cases().front();
  VerifiedCase sound{c, c.loads(), c.loads(), c.loads(), c.loads(), {c.loads()}, {c.loads()}};
  const auto failures = [](const VerifiedCase& v) {
    std::string names;
    for (const Comparison& comparison : compare(v))
      if (!comparison.passed()) names += comparison.what + "; ";
    return names;
  };
  EXPECT_EQ(failures(sound), "");
  VerifiedCase off = sound;
  off.mixed.stresses[3] *= 1.0 + 2e-4;
  EXPECT_EQ(failures(off), "mixed element - 256 directions, same K, any element; ");
  off = sound;
  off.displacement.scatter = 2e-4;
  EXPECT_EQ(failures(off), "displacement element - 256 directions, same K, any element; ");
  off = sound;
  off.sum.back() *= 1.01;
  EXPECT_EQ(failures(off), "256 directions - analytic, of the largest stress; 256 directions - analytic, pointwise; ");
  off = sound;
  off.mixed.stresses[3] = std::nan("");
  EXPECT_NE(failures(off), "");
}

}  // namespace
}  // namespace tunica::stages
