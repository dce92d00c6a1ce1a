// Error of the fibre stress: the octahedral set and the fitted rules against the continuous densities.
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

#include "fibres_reference.hpp"
#include "folders.hpp"
#include "tunica/wall/fibres/directions.hpp"

namespace tunica::wall {
namespace {

using test::fibre_stress;
using test::size;
using Table = std::map<std::string, std::vector<double>>;

/// Cauchy stress sigma_33 [kPa] of uniaxial extension along M = e3, incompressible, two families, mu = 50, k1 = 8, k2
/// = 12.
double uniaxial(const DirectionSet& set, double stretch, bool tension_only) {
  const double across = 1.0 / std::sqrt(stretch);
  const Mat3<double> F{{{across, 0.0, 0.0}, {0.0, across, 0.0}, {0.0, 0.0, stretch}}};
  const Mat3<double> S = fibre_stress(set, F, 12.0, tension_only);
  return 50.0 * (stretch * stretch - 1.0 / stretch) + 2.0 * 8.0 * (stretch * stretch * S(2, 2) - S(0, 0) / stretch);
}

/// sigma_13 [kPa] of simple shear c e1 x e3, two families, mu = 100, k1 = 80, k2 = 12.
double shear(const DirectionSet& set, double c, bool tension_only) {
  const Mat3<double> F{{{1.0, 0.0, c}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
  const Mat3<double> S = fibre_stress(set, F, 12.0, tension_only);
  return 100.0 * c + 2.0 * 80.0 * (F * S * transpose(F))(0, 2);
}

const double diagonal = std::sqrt(0.5);
const Density along_e3 = VonMises{3.0, {{0.0, 0.0, 1.0}}};
const Density compressed = VonMises{3.0, {{diagonal, 0.0, -diagonal}}};

/// Largest relative difference of a column from the stress of a set; the first row is unloaded.
template <class Stress>
double difference(const Table& table, const std::string& column, const std::string& path, const Stress& stress) {
  double largest = 0.0;
  for (std::size_t n = 1; n < table.at(path).size(); ++n)
    largest = std::max(largest, std::abs(stress(table.at(path)[n]) / table.at(column)[n] - 1.0));
  return largest;
}

TEST(FibreRules, TablesOfTheOctahedralSets) {
  const Table extension = test::read_table("uniaxial.csv"), simple = test::read_table("shear.csv");
  if (extension.empty() || simple.empty()) GTEST_SKIP() << "no reference data in " << TUNICA_SHARED_DATA;
  for (const int count : {64, 256, 1024}) {
    const std::string name = "DFD" + std::to_string(count);
    const DirectionSet table_e3 = test::midpoint_octahedral(along_e3, count, 4);
    const DirectionSet table_m = test::midpoint_octahedral(compressed, count, 4);
    const DirectionSet exact_e3 = octahedral(along_e3, count), exact_m = octahedral(compressed, count);
    const auto stretch = [&](const auto& set) {
      return difference(extension, name + "_mu50_2fam_switch", "lambda",
                        [&](double x) { return uniaxial(set, x, true); });
    };
    const auto sheared = [&](const auto& set) {
      return difference(simple, name + "_2fam_switch", "c", [&](double c) { return shear(set, c, true); });
    };
    std::printf("%-8s from the column: uniaxial %.1e (its densities %.1e), shear %.1e (%.1e)\n", name.c_str(),
                stretch(exact_e3), stretch(table_e3), sheared(exact_m), sheared(table_m));
    if (count == 256) {  // the splits of the other two columns are not stated
      EXPECT_LT(stretch(table_e3), 1e-6);
      EXPECT_LT(sheared(table_m), 1e-6);
    }
    EXPECT_LT(stretch(exact_e3), 1e-3);
    EXPECT_LT(sheared(exact_m), 1e-3);
  }
}

TEST(FibreRules, AgainstTheContinuousDensity) {
  const Table extension = test::read_table("uniaxial.csv"), simple = test::read_table("shear.csv");
  if (extension.empty() || simple.empty()) GTEST_SKIP() << "no reference data in " << TUNICA_SHARED_DATA;
  const auto check = [&](const std::string& name, const DirectionSet& e3, const DirectionSet& m, double bound,
                         double shear_bound) {
    for (const bool tension_only : {true, false}) {
      const std::string end = tension_only ? "switch" : "noswitch";
      const double u = difference(extension, "sigma_mu50_2fam_" + end, "lambda",
                                  [&](double x) { return uniaxial(e3, x, tension_only); });
      const double s =
          difference(simple, "sigma13_2fam_" + end, "c", [&](double c) { return shear(m, c, tension_only); });
      std::printf("%-20s %-8s uniaxial %.3f %%, shear %.3f %%\n", name.c_str(), end.c_str(), 100 * u, 100 * s);
      EXPECT_LT(u, bound) << name << end;
      EXPECT_LT(s, tension_only ? bound : shear_bound) << name << end;
    }
  };
  // Without exclusion the set of the tables itself is off by 0.617 % in the smallest shear.
  double own = 0.0;
  for (std::size_t n = 1; n < simple.at("c").size(); ++n)
    own = std::max(own, std::abs(simple.at("DFD256_2fam_noswitch")[n] / simple.at("sigma13_2fam_noswitch")[n] - 1.0));
  check("octahedral 256", octahedral(along_e3, 256), octahedral(compressed, 256), 0.006, own + 1e-4);
  check("product 8 x 16", product_rule(along_e3, 8, 16), product_rule(compressed, 8, 16), 0.005, 0.005);
  const RuleChoice a = choose_rule(along_e3, 12.0, 0.005, true), b = choose_rule(compressed, 12.0, 0.005, true);
  EXPECT_LE(a.set.weights.size(), 128u);
  check("auto: " + a.name, a.set, b.set, 0.005, 0.005);
  std::printf("octahedral 256 of the table, without exclusion: shear %.3f %%\n", 100 * own);
}

/// Fine product rule about e3 for densities that are no narrower than b = 40.
DirectionSet reference_set(const Density& d) {
  using Gauss = boost::math::quadrature::gauss<double, 60>;
  constexpr int around = 200;
  DirectionSet set;
  for (const double half : {-1.0, 1.0})
    for (std::size_t i = 0; i < Gauss::abscissa().size(); ++i)
      for (const double side : {-1.0, 1.0}) {
        const double s = 0.5 * (half + side * Gauss::abscissa()[i]), r = std::sqrt(1.0 - s * s);
        for (int j = 0; j < around; ++j) {
          const double phi = std::numbers::pi * (j + 0.3) / around;  // the half circle: N and -N are one fibre
          const Vec3<double> N{{r * std::cos(phi), r * std::sin(phi), s}};
          set.directions.push_back(N);
          set.weights.push_back(0.5 * Gauss::weights()[i] * density(d, N) / around);
        }
      }
  const double total = test::sum(set);
  for (double& w : set.weights) w /= total;
  return set;
}

/// States in the plane of the wall, in the axes of a mean direction at the angle alpha: uniaxial to 1.2 along, across
/// and between, equibiaxial to 1.15, simple shear of 0.5 along both ways and with the mean compressed. Then shear out
/// of the plane.
std::vector<Mat3<double>> wall_states(double alpha) {
  const double s = 1.0 / std::sqrt(1.2), t = 1.0 / (1.15 * 1.15), r = 0.5 * (1.2 + s), o = 0.5 * (1.2 - s);
  const std::vector<Mat3<double>> states{{{{1.2, 0.0, 0.0}, {0.0, s, 0.0}, {0.0, 0.0, s}}},
                                         {{{s, 0.0, 0.0}, {0.0, 1.2, 0.0}, {0.0, 0.0, s}}},
                                         {{{r, o, 0.0}, {o, r, 0.0}, {0.0, 0.0, s}}},
                                         {{{1.15, 0.0, 0.0}, {0.0, 1.15, 0.0}, {0.0, 0.0, t}}},
                                         {{{1.0, 0.5, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}},
                                         {{{1.0, -0.5, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}},
                                         {{{0.75, 0.25, 0.0}, {-0.25, 1.25, 0.0}, {0.0, 0.0, 1.0}}},
                                         {{{1.0, 0.0, 0.5}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}}};
  const double c = std::cos(alpha), d = std::sin(alpha);
  const Mat3<double> Q{{{c, -d, 0.0}, {d, c, 0.0}, {0.0, 0.0, 1.0}}};
  std::vector<Mat3<double>> turned;
  for (const Mat3<double>& F : states) turned.push_back(Q * F * transpose(Q));
  return turned;
}

/// |S - S_ref| over the larger of |S_ref| and the stress of linear isotropic fibres.
double relative_error(const DirectionSet& set, const DirectionSet& reference, const Mat3<double>& F, double k2,
                      bool tension_only) {
  static const DirectionSet same = reference_set(test::isotropic());
  const Mat3<double> S = fibre_stress(reference, F, k2, tension_only);
  const double scale = std::max(size(S), size(fibre_stress(same, F, 0.0, tension_only)));
  return size(fibre_stress(set, F, k2, tension_only) + (-1.0) * S) / scale;
}

TEST(FibreRules, SixtyFourDirectionsForNarrowBivariateDensities) {
  double in_plane = 0.0, out_of_plane = 0.0, octahedral_error = 0.0;
  for (const double a : {0.5, 2.0, 5.0})
    for (const double b : {10.0, 20.0, 40.0}) {
      const Density d = BivariateVonMises{a, b, 0.5};
      const DirectionSet set = product_rule(d, 4, 16), reference = reference_set(d), dfd = octahedral(d, 256);
      ASSERT_EQ(set.weights.size(), 64u);
      const auto states = wall_states(0.5);
      for (const bool tension_only : {true, false})
        for (std::size_t n = 0; n < states.size(); ++n) {
          const double error = relative_error(set, reference, states[n], 12.0, tension_only);
          if (n + 1 == states.size()) {  // little stress; 64 directions are too few, and the choice takes more
            out_of_plane = std::max(out_of_plane, error);
            continue;
          }
          in_plane = std::max(in_plane, error);
          octahedral_error = std::max(octahedral_error, relative_error(dfd, reference, states[n], 12.0, tension_only));
          EXPECT_LE(error, 0.005) << "a " << a << " b " << b << " state " << n << " tension only " << tension_only;
        }
    }
  for (const double b : {10.0, 20.0, 40.0}) {
    const RuleChoice choice = choose_rule(BivariateVonMises{2.0, b, 0.5}, 12.0, 0.005, true);
    std::printf("a = 2, b = %.0f: %s, %.3f %%\n", b, choice.name.c_str(), 100 * choice.error);
    EXPECT_LE(choice.error, 0.005);
    EXPECT_LE(choice.set.weights.size(), 128u);
  }
  std::printf("product 4 x 16: %.3f %% in the plane (octahedral 256: %.2f %%), %.2f %% in shear out of it\n",
              100 * in_plane, 100 * octahedral_error, 100 * out_of_plane);
}

TEST(FibreRules, HundredTwentyEightDirectionsForBroadDensities) {
  const double alpha = 0.5;
  const Density d = VonMises{3.0, {{std::cos(alpha), std::sin(alpha), 0.0}}};
  const DirectionSet set = product_rule(d, 8, 16), reference = reference_set(d), dfd = octahedral(d, 256);
  double largest = 0.0, octahedral_error = 0.0;
  for (const bool tension_only : {true, false})
    for (const Mat3<double>& F : wall_states(alpha)) {
      largest = std::max(largest, relative_error(set, reference, F, 12.0, tension_only));
      octahedral_error = std::max(octahedral_error, relative_error(dfd, reference, F, 12.0, tension_only));
    }
  std::printf("b = 3, product 8 x 16: %.3f %%, octahedral 256: %.2f %%\n", 100 * largest, 100 * octahedral_error);
  EXPECT_LE(largest, 0.005);
}

/// Isochoric states in random axes: stretches of up to 1.2 and down to 1/1.2, then a shear of up to 0.3.
Mat3<double> random_state(std::mt19937& random) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto direction = [&] {
    const Vec3<double> v{{normal(random), normal(random), normal(random)}};
    return (1.0 / norm(v)) * v;
  };
  const Vec3<double> a = direction(), x = direction(), b0 = x - dot(x, a) * a, b = (1.0 / norm(b0)) * b0,
                     c = cross(a, b);
  const double la = std::pow(1.2, uniform(random)), lb = std::pow(1.2, uniform(random)), shear = 0.3 * uniform(random);
  Mat3<double> F;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      F(i, j) = la * a[i] * a[j] + lb * b[i] * b[j] + c[i] * c[j] / (la * lb) + shear * a[i] * b[j];
  return F;
}

TEST(FibreRules, TheChoiceHoldsInRandomStates) {
  constexpr double tolerance = 0.005;
  std::mt19937 random(7);
  std::vector<Mat3<double>> states;
  for (int n = 0; n < 24; ++n) states.push_back(random_state(random));
  double worst = 0.0, total = 0.0;
  int kept = 0, count = 0;
  const Density cases[] = {VonMises{3.0, {{0.6, 0.8, 0.0}}},  VonMises{10.0, {{0.6, 0.0, 0.8}}},
                           BivariateVonMises{0.5, 3.0, 0.4},  BivariateVonMises{2.0, 10.0, 0.4},
                           BivariateVonMises{5.0, 25.0, 0.4}, BivariateVonMises{1.0, 40.0, 0.4}};
  for (const Density& d : cases) {
    const DirectionSet reference = reference_set(d);
    for (const double k2 : {0.0, 12.0}) {
      const RuleChoice choice = choose_rule(d, k2, tolerance, true);
      double largest = 0.0;
      for (const Mat3<double>& F : states) {
        const double error = relative_error(choice.set, reference, F, k2, true);
        largest = std::max(largest, error);
        total += error;
        kept += error <= tolerance;
        ++count;
      }
      std::printf("%-16s k2 %4.1f: said %.3f %%, largest of the random states %.3f %%\n", choice.name.c_str(), k2,
                  100 * choice.error, 100 * largest);
      worst = std::max(worst, largest);
    }
  }
  std::printf("%d of %d states within the tolerance, mean %.3f %%, largest %.3f %%\n", kept, count, 100 * total / count,
              100 * worst);
  // The states of the estimate are a sample: most others keep the tolerance, small strains and kinks in between may
  // not.
  EXPECT_LE(total / count, 0.5 * tolerance);
  EXPECT_GE(kept, 0.93 * count);
  EXPECT_LE(worst, 3.0 * tolerance);
}

TEST(FibreRules, TheBestIsReturnedWhenNoneKeepsTheTolerance) {
  const Density d = BivariateVonMises{2.0, 3.0, 0.0};
  const RuleChoice best = choose_rule(d, 12.0, 0.0, true);
  EXPECT_GT(best.error, 0.0);
  EXPECT_LT(best.error, 1e-3);
  const RuleChoice same = measured_rule(best.set, best.name, d, 12.0, true);
  EXPECT_EQ(same.error, best.error);
  EXPECT_EQ(same.name, best.name);
}

}  // namespace
}  // namespace tunica::wall
