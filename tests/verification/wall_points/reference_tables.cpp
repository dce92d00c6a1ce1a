// The wall kernels against reference tables: neo-Hooke in uniaxial extension and shear, and general deformations with a
// sum over 256 fibre directions. The fibre law is written here through its energy alone, so that the tables check the
// isochoric split, the volumetric part and the derivation of stress and tangent.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "folders.hpp"
#include "tunica/wall/material.hpp"
#include "tunica/wall/output.hpp"

namespace tunica::wall {
namespace {

const std::filesystem::path tables = std::filesystem::path(TUNICA_SHARED_DATA) / "analytic";

/// Columns of a CSV file by the names in its first line that does not start with '#'.
std::vector<double> column(const std::filesystem::path& file, const std::string& name) {
  std::ifstream in(file);
  std::string line, cell;
  while (std::getline(in, line) && line.starts_with('#')) {
  }
  if (line.ends_with('\r')) line.pop_back();
  std::stringstream header(line);
  int wanted = -1;
  for (int n = 0; std::getline(header, cell, ','); ++n)
    if (cell == name) wanted = n;
  std::vector<double> values;
  while (wanted >= 0 && std::getline(in, line)) {
    std::stringstream row(line);
    for (int n = 0; n <= wanted; ++n) std::getline(row, cell, ',');
    values.push_back(std::stod(cell));
  }
  return values;
}

/// The element with unit reference gradients that is deformed by F.
ElementState<double> deformed_by(const Mat3<double>& F) {
  const Vec3<double> corner[4] = {{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}};
  ElementState<double> e{};
  e.reference = fe::gradients(corner);
  for (int a = 0; a < 4; ++a) e.displacement[a] = F * corner[a] - corner[a];
  return e;
}

TEST(WallReference, NeoHookeUniaxialIncompressible) {
  if (!std::filesystem::exists(tables / "uniaxial.csv")) GTEST_SKIP() << "reference tables are not here";
  const std::vector<double> lambda = column(tables / "uniaxial.csv", "lambda");
  const std::vector<double> expected = column(tables / "uniaxial.csv", "sigma_neoHooke_mu50");
  ASSERT_GT(lambda.size(), 10u);
  double worst = 0.0;
  for (std::size_t n = 0; n < lambda.size(); ++n) {
    const double l = lambda[n], w = 1.0 / std::sqrt(l);
    ElementState<double> e = deformed_by({{{l, 0, 0}, {0, w, 0}, {0, 0, w}}});
    const double p = mixed_cauchy_stress(e, NeoHooke{50.0})[1];  // the pressure that frees the sides
    for (double& nodal : e.pressure) nodal = p;
    const Symmetric<double> sigma = mixed_cauchy_stress(e, NeoHooke{50.0});
    EXPECT_NEAR(sigma[1], 0.0, 1e-12);
    EXPECT_NEAR(sigma[0], expected[n], 1e-8 * (1.0 + expected[n]));
    worst = std::max(worst, std::fabs(sigma[0] - expected[n]));
  }
  std::printf("uniaxial neo-Hooke: largest difference %.1e kPa over %zu stretches\n", worst, lambda.size());
}

TEST(WallReference, NeoHookeSimpleShear) {
  if (!std::filesystem::exists(tables / "shear.csv")) GTEST_SKIP() << "reference tables are not here";
  const std::vector<double> c = column(tables / "shear.csv", "c");
  const std::vector<double> expected = column(tables / "shear.csv", "sigma13_neoHooke");
  ASSERT_GT(c.size(), 10u);
  for (std::size_t n = 0; n < c.size(); ++n) {
    const ElementState<double> e = deformed_by({{{1, 0, c[n]}, {0, 1, 0}, {0, 0, 1}}});
    EXPECT_NEAR(mixed_cauchy_stress(e, NeoHooke{100.0})[5], expected[n], 1e-8);
  }
}

/// neo-Hooke with fibres in many directions, tension only, through its energy.
struct FibreSum {
  double mu, k1, k2;
  std::vector<std::array<double, 4>> directions;  // N1 N2 N3 and density
  double families;

  template <class T>
  T energy(const Symmetric<T>& C) const {
    T psi = T(0.5 * mu) * (trace(C) - T(3.0));
    for (const auto& [x, y, z, density] : directions) {
      const T I = T(x * x) * C[0] + T(y * y) * C[1] + T(z * z) * C[2] +
                  T(2.0) * (T(x * y) * C[3] + T(y * z) * C[4] + T(x * z) * C[5]);
      const T strain = max(I - T(1.0), T(0.0));
      psi += T(families * density * k1 / (2.0 * k2)) * (exp(T(k2) * strain * strain) - T(1.0));
    }
    return psi;
  }
  double shear_modulus_at_rest() const { return mu; }
};

/// Tangent dS/dE from the element: k_ab with the geometric part removed, pulled back by F.
double tangent_entry(const ElementState<double>& e, const fe::ElementMatrix<double>& k, const Symmetric<double>& S,
                     int n, int o) {
  // On the unit element node 1 + A carries the gradient e_A, so k / V is dP_iA / dF_jB.
  const Mat3<double> F = deformation_gradient(e), F_inverse = inverse(F);
  const int A = voigt_row[n], B = voigt_column[n], C = voigt_row[o], D = voigt_column[o];
  double sum = 0.0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const double geometric = i == j ? S[voigt_index[B][D]] : 0.0;
      sum += F_inverse(A, i) * (k.k[1 + B][1 + D][i][j] / e.reference.volume - geometric) * F_inverse(C, j);
    }
  return sum;
}

TEST(WallReference, GeneralDeformationsWithFibres) {
  if (!std::filesystem::exists(tables / "material_points.json")) GTEST_SKIP() << "reference tables are not here";
  std::ifstream in(tables / "material_points.json");
  const nlohmann::json points = nlohmann::json::parse(in);
  std::vector<std::array<double, 4>> directions;
  const auto file = tables / "dfd256_vonMises_b3_E3.csv";
  const std::vector<double> x = column(file, "N1"), y = column(file, "N2"), z = column(file, "N3"),
                            density = column(file, "rho_n");
  ASSERT_EQ(density.size(), x.size());
  for (std::size_t n = 0; n < x.size(); ++n) directions.push_back({x[n], y[n], z[n], density[n]});
  ASSERT_EQ(directions.size(), 256u);
  int checked = 0;
  double worst_stress = 0.0, worst_tangent = 0.0;
  for (const auto& point : points) {
    if (point["case"] != "vonMises_E3_mu50_k8_12_b3_x2") continue;  // the one set of directions in the tables
    const FibreSum law{point["mu"], point["k1"], point["k2"], directions, 2.0};
    Mat3<double> F;
    for (int n = 0; n < 9; ++n) F(n / 3, n % 3) = point["F"][n / 3][n % 3];
    const Body body{.density = 1.0, .volumetric = {VolumetricEnergy::simo_taylor, point["K"]}};
    const ElementState<double> e = deformed_by(F);
    fe::ElementVector<double> r;
    fe::ElementMatrix<double> k;
    displacement_tangent(e, law, body, {}, r, k);
    const auto& reference = point["DFD256"];
    const double psi = reference["psi"];
    EXPECT_NEAR(displacement_strain_energy(e, law, body) / e.reference.volume, psi, 1e-8 * psi);
    const Mat3<double> F_inverse = inverse(F);
    Symmetric<double> S;
    double size = 0.0;
    for (int n = 0; n < 6; ++n) {
      S[n] = 0.0;  // S = F^-1 P, and r of node 1 + B is V P e_B
      for (int i = 0; i < 3; ++i) S[n] += F_inverse(voigt_row[n], i) * r.r[1 + voigt_column[n]][i] / e.reference.volume;
      size = std::max(size, std::fabs(double(reference["CC_voigt"][n][n])));
    }
    for (int n = 0; n < 6; ++n) {
      const double expected = reference["S_voigt_11_22_33_12_23_13"][n];
      EXPECT_NEAR(S[n], expected, 1e-8 * size);
      worst_stress = std::max(worst_stress, std::fabs(S[n] - expected) / size);
      for (int o = 0; o < 6; ++o) {
        const double entry = reference["CC_voigt"][n][o], found = tangent_entry(e, k, S, n, o);
        EXPECT_NEAR(found, entry, 1e-8 * size) << n << " " << o;
        worst_tangent = std::max(worst_tangent, std::fabs(found - entry) / size);
      }
    }
    ++checked;
  }
  EXPECT_EQ(checked, 2);
  std::printf("general deformations: largest relative difference, stress %.1e, tangent %.1e\n", worst_stress,
              worst_tangent);
}

}  // namespace
}  // namespace tunica::wall
