// Discrete fibre dispersion at the material point against reference tables: energy, stress and tangent in general
// deformations, and uniaxial tests with a finite bulk modulus and in compression.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "folders.hpp"
#include "tunica/wall/material_paths.hpp"
#include "unit/wall/fibres_reference.hpp"

namespace tunica::wall {
namespace {

const std::filesystem::path points_file =
    std::filesystem::path(TUNICA_SHARED_DATA) / "analytic" / "material_points.json";

/// Two families in the units of the tables, kPa.
DfdParameters parameters(double mu, double K, double k1, double k2) {
  DfdParameters p;
  p.elastic.shear_modulus = mu;
  p.elastic.bulk_modulus = K;
  p.rule = dfd::Octahedral{256};
  p.families.resize(2);
  for (auto& family : p.families) family.energy = {k1, k2};
  return p;
}

DfdParameters parameters(const nlohmann::json& point) {
  DfdParameters p = parameters(point["mu"], point["K"], point["k1"], point["k2"]);
  const std::string name = point["case"];
  const double half = std::sqrt(0.5), angle = 35.0 * std::numbers::pi / 180.0;
  for (int i = 0; i < 2; ++i) {
    dfd::Orientation& orientation = p.families[static_cast<std::size_t>(i)].orientation;
    if (name.starts_with(
            "bivariate_35deg"))  // a and b are not stated; these are of Holzapfel et al. (2015), adventitia
      orientation = dfd::Bivariate{2.54, 19.44, i == 0 ? angle : -angle};
    else if (name.starts_with("vonMises_E3"))
      orientation = dfd::Symmetric{3.0, {}, Vec3<double>{{0.0, 0.0, 1.0}}};
    else
      orientation = dfd::Symmetric{3.0, {}, Vec3<double>{{half, 0.0, -half}}};
  }
  return p;
}

/// The law with the densities of the tables, which are sums over the middles of small triangles.
Law with_densities_of_the_tables(const DfdParameters& p) {
  DiscreteFibreLaw law = p.law();
  std::vector<DirectionSet> sets;
  for (const auto& family : p.families) sets.push_back(test::midpoint_octahedral(family.density(), 256, 4));
  const DirectionSet merged = merge(sets);
  law.fibres.bundles = {FibreBundle::make(p.families[0].energy, merged.directions, merged.weights)};
  return law;
}

struct Differences {
  double energy = 0.0, stress = 0.0, tangent = 0.0;  ///< relative to the largest entry
};

Differences differences(const PathPoint& point, const nlohmann::json& reference) {
  const double psi = reference["psi"];
  double stress_size = 0.0, tangent_size = 0.0;
  Differences d{std::abs(point.energy / psi - 1.0), 0.0, 0.0};
  for (int n = 0; n < 6; ++n) {
    const double S = reference["S_voigt_11_22_33_12_23_13"][n];
    d.stress = std::max(d.stress, std::abs(point.state.stress[n] - S));
    stress_size = std::max(stress_size, std::abs(S));
    for (int m = 0; m < 6; ++m) {
      const double CC = reference["CC_voigt"][n][m];
      d.tangent = std::max(d.tangent, std::abs(point.state.tangent(n, m) - CC));
      tangent_size = std::max(tangent_size, std::abs(CC));
    }
  }
  d.stress /= stress_size;
  d.tangent /= tangent_size;
  return d;
}

TEST(DispersedFibres, EnergyStressAndTangentInGeneralDeformations) {
  if (!std::filesystem::exists(points_file)) GTEST_SKIP() << "no reference data in " << TUNICA_SHARED_DATA;
  std::ifstream in(points_file);
  const auto points = nlohmann::json::parse(in);
  ASSERT_EQ(points.size(), 6u);
  for (const auto& point : points) {
    Mat3<double> F;
    for (int n = 0; n < 9; ++n) F(n / 3, n % 3) = point["F"][n / 3][n % 3];
    DfdParameters p = parameters(point);
    const Volumetric volumetric{.bulk_modulus = point["K"]};
    const auto sum = differences(deformed(with_densities_of_the_tables(p), volumetric, F), point["DFD256"]);
    const auto exact = differences(deformed(p.law(), volumetric, F), point["DFD256"]);
    p.rule = dfd::Product{48, 256};
    const auto fine = differences(deformed(p.law(), volumetric, F), point["continuous"]);
    std::printf("%-33s sum Psi %.1e S %.1e CC %.1e; exact densities %.1e %.1e %.1e; continuous %.1e %.1e %.1e\n",
                std::string(point["case"]).c_str(), sum.energy, sum.stress, sum.tangent, exact.energy, exact.stress,
                exact.tangent, fine.energy, fine.stress, fine.tangent);
    for (const double difference : {sum.energy, sum.stress, sum.tangent}) EXPECT_LT(difference, 1e-8) << point["case"];
    for (const double difference : {exact.energy, exact.stress, exact.tangent})
      EXPECT_LT(difference, 1e-4) << point["case"];
    EXPECT_LT(fine.energy, 1e-5) << point["case"];
    EXPECT_LT(fine.stress, 1e-5) << point["case"];
    EXPECT_LT(fine.tangent, 1e-4) << point["case"];  // the tangent jumps where fibres begin to pull
  }
}

/// Largest difference of sigma_33 from a column, relative to its largest entry; the same of J where there is one.
double along_e3(const std::map<std::string, std::vector<double>>& table, const std::string& column, const Law& law,
                double K, const std::string& volume_column = "") {
  const FibreFrame axes = specimen_axes({{0.0, 0.0, 1.0}});
  const Volumetric volumetric{.bulk_modulus = K};
  PathPoint at = deformed(law, volumetric, identity<double>());
  double largest = 0.0, size = 0.0;
  for (std::size_t n = 0; n < table.at(column).size(); ++n) {
    at = stretched(law, volumetric, axes, {table.at("lambda")[n], {}}, at);
    largest = std::max(largest, std::abs(at.state.cauchy[2] - table.at(column)[n]));
    size = std::max(size, std::abs(table.at(column)[n]));
    if (!volume_column.empty()) {
      EXPECT_NEAR(at.state.J, table.at(volume_column)[n], 1e-7 + 1e-3 * std::abs(at.state.J - 1.0));
    }
  }
  return largest / size;
}

TEST(DispersedFibres, UniaxialTestsWithFiniteBulkModulusAndInCompression) {
  const auto finite = test::read_table("uniaxial_finite_K.csv"),
             compression = test::read_table("uniaxial_compression.csv");
  if (finite.empty() || compression.empty()) GTEST_SKIP() << "no reference data in " << TUNICA_SHARED_DATA;
  const auto law = [](double mu, bool tension_only, dfd::Rule rule) {
    DfdParameters p = parameters(mu, 1.0e3, 8.0, 12.0);
    p.options.tension_only = tension_only;
    p.rule = rule;
    for (auto& family : p.families) family.orientation = dfd::Symmetric{3.0, {}, Vec3<double>{{0.0, 0.0, 1.0}}};
    return p;
  };
  const double infinite = std::numeric_limits<double>::infinity();
  const dfd::Rule fine = dfd::Product{24, 8};
  const struct {
    const char* column;
    double difference, bound;
  } checks[] = {
      {"mu50_K2.5e5kPa_DFD256",
       along_e3(finite, "sigma_mu50_K2.5e5kPa_DFD256",
                with_densities_of_the_tables(law(50, true, dfd::Octahedral{256})), 2.5e5),
       1e-7},
      {"mu50_K2.5e5kPa_cont", along_e3(finite, "sigma_mu50_K2.5e5kPa_cont", law(50, true, fine).law(), 2.5e5, "J"),
       1e-4},
      {"mu100_K2.5e5kPa_cont", along_e3(finite, "sigma_mu100_K2.5e5kPa_cont", law(100, true, fine).law(), 2.5e5), 1e-4},
      {"mu50_K250kPa_cont", along_e3(finite, "sigma_mu50_K250kPa_cont", law(50, true, fine).law(), 250.0, "J_K250kPa"),
       1e-4},
      {"compression, switch", along_e3(compression, "sigma_mu50_2fam_switch", law(50, true, fine).law(), infinite),
       1e-4},
      {"compression, no switch",
       along_e3(compression, "sigma_mu50_2fam_noswitch", law(50, false, fine).law(), infinite), 1e-7},
  };
  for (const auto& c : checks) {
    std::printf("uniaxial, %-23s largest difference %.1e of the largest stress\n", c.column, c.difference);
    EXPECT_LT(c.difference, c.bound) << c.column;
  }
}

}  // namespace
}  // namespace tunica::wall
