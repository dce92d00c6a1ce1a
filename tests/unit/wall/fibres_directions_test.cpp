// Direction sets: weights, the published set of 256, moments, rotation, merging and degradation.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <numeric>

#include "fibres_reference.hpp"
#include "folders.hpp"
#include "tunica/wall/fibres/directions.hpp"

namespace tunica::wall {
namespace {

using test::isotropic;
using test::sum;

const Vec3<double> along_1{{1.0, 0.0, 0.0}}, along_3{{0.0, 0.0, 1.0}};

std::vector<Density> densities() {
  std::vector<Density> all;
  for (const double b : {0.0, 3.0, 300.0}) {
    all.push_back(VonMises{b, {{0.48, 0.6, 0.64}}});
    all.push_back(BivariateVonMises{2.0, b, 0.4});
  }
  all.push_back(BivariateVonMises{10.0, 0.0, 0.4});  // narrow about the pole
  return all;
}

TEST(FibreDirections, WeightsAreSharesOfUnitVectors) {
  for (const Density& d : densities()) {
    std::vector<DirectionSet> sets;
    for (const int count : {4, 64, 256}) {
      sets.push_back(octahedral(d, count));
      EXPECT_EQ(static_cast<int>(sets.back().weights.size()), count);
    }
    for (const auto& [across, around] : {std::array{1, 3}, {2, 6}, {3, 7}, {8, 16}, {48, 64}}) {
      sets.push_back(product_rule(d, across, around));
      EXPECT_EQ(static_cast<int>(sets.back().weights.size()), across * around);
    }
    for (const DirectionSet& set : sets) {
      ASSERT_EQ(set.directions.size(), set.weights.size());
      EXPECT_NEAR(sum(set), 1.0, 1e-10);
      for (const auto& N : set.directions) EXPECT_NEAR(norm(N), 1.0, 1e-14);
      for (const double w : set.weights) EXPECT_GE(w, 0.0);
    }
  }
}

TEST(FibreDirections, OctahedralSizes) {
  for (const int count : {4, 16, 64, 256, 1024, 65536}) EXPECT_TRUE(is_octahedral_size(count)) << count;
  for (const int count : {-4, 0, 1, 2, 8, 128, 255, 260}) EXPECT_FALSE(is_octahedral_size(count)) << count;
}

TEST(FibreDirections, OctahedralWeightsAreIntegrals) {
  // Four triangles make one of the coarser set; isotropic weights are solid angles.
  for (const Density& d : densities()) {
    const DirectionSet coarse = octahedral(d, 64), fine = octahedral(d, 256);
    for (std::size_t n = 0; n < 64; ++n) {
      const double parts =
          fine.weights[4 * n] + fine.weights[4 * n + 1] + fine.weights[4 * n + 2] + fine.weights[4 * n + 3];
      EXPECT_NEAR(coarse.weights[n], parts, 1e-12);
    }
  }
  const DirectionSet set = octahedral(isotropic(), 256), areas = test::midpoint_octahedral(isotropic(), 256, 0);
  for (std::size_t n = 0; n < 256; ++n) EXPECT_NEAR(set.weights[n], areas.weights[n], 1e-14);
}

TEST(FibreDirections, ReproducesThePublishedSet) {
  const auto table = test::read_table("dfd256_vonMises_b3_E3.csv");
  if (table.empty()) GTEST_SKIP() << "no reference data in " << TUNICA_SHARED_DATA;
  ASSERT_EQ(table.at("N1").size(), 256u);
  const Density d = VonMises{3.0, along_3};
  const DirectionSet set = octahedral(d, 256), midpoint = test::midpoint_octahedral(d, 256, 4);
  double largest = 0.0;
  for (std::size_t n = 0; n < 256; ++n) {
    const Vec3<double> N{{table.at("N1")[n], table.at("N2")[n], table.at("N3")[n]}};
    const double rho = table.at("rho_n")[n];
    EXPECT_LT(norm(set.directions[n] - N), 1e-14);
    // The table's densities are a sum over 256 smaller triangles, density in the middle times area: their sum is
    // 1 + 6.9e-6. The integrals differ by what that rule leaves.
    EXPECT_NEAR(midpoint.weights[n], rho, 1e-12 * rho);
    largest = std::max(largest, std::abs(set.weights[n] / rho - 1.0));
  }
  EXPECT_LT(largest, 2.5e-4);
  EXPECT_GT(largest, 2.0e-4);
}

TEST(FibreDirections, ProductRulesHaveTheStructureTensor) {
  for (const double b : {0.0, 3.0, 9.0, 40.0, 300.0}) {
    const VonMises v{b, {{0.48, 0.6, 0.64}}};
    const DirectionSet rings = product_rule(v, 3, 7);
    for (const double a : {0.0, 1.0, 20.0}) {
      const BivariateVonMises d{a, b, 0.7};
      for (const int across : {4, 5, 8})
        for (const int around : {6, 7, 20}) {
          const DirectionSet set = product_rule(d, across, around);
          const double A = 2.0 * kappa_out_of_plane(d) * kappa_in_plane(d);
          const double B = 2.0 * kappa_out_of_plane(d) * (1.0 - 2.0 * kappa_in_plane(d));
          const Vec3<double> M{{std::cos(0.7), std::sin(0.7), 0.0}};
          for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
              EXPECT_NEAR(test::second_moment(set, i, j),
                          (i == j ? A : 0.0) + B * M[i] * M[j] + (i == 2 && j == 2 ? 1.0 - 3.0 * A - B : 0.0),
                          around == 20 ? 1e-6 : 1e-11)
                  << a << ' ' << b << ' ' << across << ' ' << around;
        }
    }
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        EXPECT_NEAR(test::second_moment(rings, i, j),
                    (i == j ? kappa(v) : 0.0) + (1.0 - 3.0 * kappa(v)) * v.mean_direction[i] * v.mean_direction[j],
                    1e-11);
  }
}

TEST(FibreDirections, ProductRulesTurnWithTheMean) {
  const double angle = 0.9, c = std::cos(angle), s = std::sin(angle);
  const std::pair<Density, Density> pairs[] = {{BivariateVonMises{2.0, 12.0, 0.0}, BivariateVonMises{2.0, 12.0, angle}},
                                               {VonMises{3.0, along_1}, VonMises{3.0, {{c, s, 0.0}}}}};
  for (const auto& [first, second] : pairs) {
    const DirectionSet a = product_rule(first, 4, 16), b = product_rule(second, 4, 16);
    for (std::size_t n = 0; n < a.weights.size(); ++n) {
      const Vec3<double>& N = a.directions[n];
      const Vec3<double> turned{{c * N[0] - s * N[1], s * N[0] + c * N[1], N[2]}};
      EXPECT_LT(norm(b.directions[n] - turned), 1e-14);
      EXPECT_NEAR(a.weights[n], b.weights[n], 1e-15);
    }
    // So does the error, and thereby the choice.
    const RuleChoice x = choose_rule(first, 12.0, 0.005, true), y = choose_rule(second, 12.0, 0.005, true);
    EXPECT_EQ(x.name, y.name);
    EXPECT_NEAR(x.error, y.error, 1e-4 * x.error + 1e-6);
  }
}

TEST(FibreDirections, MergeAddsEqualDirections) {
  const Vec3<double> N{{0.6, 0.0, 0.8}}, other{{0.0, 0.6, 0.8}}, near{{0.6, 1e-9, 0.8}};
  const DirectionSet a{{N, other}, {0.25, 0.75}}, b{{-1.0 * N, near}, {0.5, 0.5}};
  const std::vector<DirectionSet> sets{a, b};
  const DirectionSet merged = merge(sets);
  ASSERT_EQ(merged.weights.size(), 3u);
  EXPECT_DOUBLE_EQ(merged.weights[0], 0.75);
  EXPECT_DOUBLE_EQ(merged.weights[1], 0.75);
  EXPECT_DOUBLE_EQ(merged.weights[2], 0.5);
  // Two families of one octahedral set share all directions.
  const std::vector<DirectionSet> families{octahedral(BivariateVonMises{2.0, 10.0, 0.6}, 256),
                                           octahedral(BivariateVonMises{2.0, 10.0, -0.6}, 256)};
  const DirectionSet both = merge(families);
  EXPECT_EQ(both.weights.size(), 256u);
  EXPECT_NEAR(sum(both), 2.0, 1e-10);
  EXPECT_TRUE(merge({}).weights.empty());
}

TEST(FibreDirections, DegradationWeakensItsRange) {
  const double degree = std::numbers::pi / 180.0;
  const auto at = [&](double angle) {
    return Vec3<double>{{std::sin(angle * degree), 0.0, -std::cos(angle * degree)}};
  };
  DirectionSet set{{at(0.0), at(20.0), at(50.0), at(90.0)}, {1.0, 1.0, 1.0, 1.0}};
  degrade(set, {{0.0, 30.0 * degree, 0.25}, {30.0 * degree, 60.0 * degree, 0.5}});
  EXPECT_EQ(set.weights, (std::vector<double>{0.25, 0.25, 0.5, 1.0}));
  degrade(set, {{60.0 * degree, 90.0 * degree, 0.0}});
  EXPECT_EQ(set.weights, (std::vector<double>{0.25, 0.25, 0.5, 0.0}));
  // A direction on the boundary of two ranges is weakened once.
  DirectionSet boundary{{{{0.8, 0.0, 0.6}}}, {1.0}};
  const double angle = std::atan2(std::hypot(0.8, 0.0), 0.6);
  degrade(boundary, {{0.0, angle, 0.5}, {angle, 90.0 * degree, 0.5}});
  EXPECT_EQ(boundary.weights[0], 0.5);
}

}  // namespace
}  // namespace tunica::wall
