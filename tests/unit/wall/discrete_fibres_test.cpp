// Groups of directions that mirror each other: the sums are those over single directions, whatever images there are.
#include "tunica/wall/materials/discrete_fibres.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tunica/base/dual.hpp"
#include "tunica/wall/material_concept.hpp"

namespace tunica::wall {
namespace {

using Directions = std::vector<Vec3<double>>;

/// Groups with every combination of images of an oblique direction, in different order and sign, directions in the
/// planes and along the axes.
Directions all_kinds() {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0.1, 1.0);
  Directions set;
  for (int present = 1; present < 16; ++present) {
    Vec3<double> N{{uniform(random), uniform(random), uniform(random)}};
    N = (1.0 / norm(N)) * N;
    for (int image = 3; image >= 0; --image)
      if ((present >> image) % 2 == 1) {
        const double sign = uniform(random) < 0.5 ? -1.0 : 1.0;
        set.push_back(sign * Vec3<double>{{N[0], image > 1 ? -N[1] : N[1], image % 2 == 1 ? -N[2] : N[2]}});
      }
  }
  for (const double s : {0.6, -0.6}) {
    set.push_back({{0.8, s, 0.0}});
    set.push_back({{0.0, s, 0.8}});
    set.push_back({{s, 0.0, 0.8}});
  }
  for (int i = 0; i < 3; ++i) set.push_back({{i == 0 ? 1.0 : 0.0, i == 1 ? 1.0 : 0.0, i == 2 ? 1.0 : 0.0}});
  return set;
}

struct Sample {
  Directions directions = all_kinds();
  std::vector<double> densities;
  FibreEnergy energy{3.0, 6.0};
  DiscreteFibres fibres;

  explicit Sample(bool tension_only) {
    for (std::size_t n = 0; n < directions.size(); ++n) densities.push_back(0.1 + 0.01 * static_cast<double>(n));
    fibres.bundles.push_back(FibreBundle::make(energy, directions, densities));
    fibres.tension_only = tension_only;
  }

  /// The sum over the directions as they are.
  template <class T>
  T energy_at(const Symmetric<T>& C) const {
    T psi(0.0);
    for (std::size_t n = 0; n < directions.size(); ++n) {
      T E(-1.0);
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) E += T(directions[n][i] * directions[n][j]) * C[voigt_index[i][j]];
      psi += T(densities[n]) * energy.value(admitted(E, fibres.tension_only));
    }
    return psi;
  }
};

Symmetric<double> strain(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-0.15, 0.15);
  Symmetric<double> C;
  for (int n = 0; n < voigt_size; ++n) C[n] = (n < 3 ? 1.0 : 0.0) + uniform(random);
  return C;
}

TEST(DiscreteFibres, HoldEveryDirectionOnce) {
  const Sample sample(true);
  const FibreBundle& bundle = sample.fibres.bundles[0];
  EXPECT_EQ(bundle.directions, sample.directions.size());
  std::vector<double> found;
  bundle.visit_groups([&](const auto& group) {
    for (const double density : group.density)
      if (density > 0.0) found.push_back(density);
  });
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found, sample.densities);
  // Three or four images, or two that differ in N2: a four. One image or two that differ in N3 only: a pair.
  EXPECT_EQ(bundle.fours.size(), 9u + 1u);
  EXPECT_EQ(bundle.pairs.size(), 6u + 2u + 3u);
}

TEST(DiscreteFibres, SumsAreThoseOfSingleDirections) {
  std::mt19937 random(11);
  for (const bool tension_only : {true, false}) {
    const Sample sample(tension_only);
    for (int k = 0; k < 10; ++k) {
      const Symmetric<double> C = strain(random);
      const auto exact = derived_response([&](const auto& x) { return sample.energy_at(x); }, C);
      const Response<double> r = sample.fibres.response(C);
      const Symmetric<double> S = sample.fibres.stress(C);
      EXPECT_NEAR(sample.fibres.energy(C), sample.energy_at(C), 1e-13);
      for (int n = 0; n < voigt_size; ++n) {
        EXPECT_NEAR(r.stress[n], exact.stress[n], 1e-12);
        EXPECT_NEAR(S[n], exact.stress[n], 1e-12);
      }
      for (int n = 0; n < 21; ++n) EXPECT_NEAR(r.tangent.v[n], exact.tangent.v[n], 1e-11) << n;
    }
  }
}

TEST(DiscreteFibres, LanesThatPullDoNotWakeOthers) {
  const Sample sample(true);
  std::mt19937 random(13);
  for (int k = 0; k < 10; ++k) {
    const Symmetric<double> pulled = strain(random), pressed{{0.7, 0.8, 0.6, 0.01, 0.0, 0.02}};
    Symmetric<Pack<4>> C;
    for (int n = 0; n < voigt_size; ++n)
      for (int l = 0; l < 4; ++l) C[n].set(l, l == 2 ? pulled[n] : pressed[n]);
    const auto r = sample.fibres.response(C);
    const Response<double> exact = sample.fibres.response(pulled);
    for (int n = 0; n < voigt_size; ++n) {
      EXPECT_NEAR(r.stress[n][2], exact.stress[n], 1e-11);
      EXPECT_EQ(r.stress[n][1], 0.0);
    }
    for (int n = 0; n < 21; ++n) {
      EXPECT_NEAR(r.tangent.v[n][2], exact.tangent.v[n], 1e-10);
      EXPECT_EQ(r.tangent.v[n][3], 0.0);
    }
  }
}

}  // namespace
}  // namespace tunica::wall
