#include "tunica/stages/beat_fibres.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tunica/mesh/generate.hpp"

namespace tunica::stages {
namespace {

constexpr double fibre_angle = 0.6;

mesh::MeshData tube() {
  mesh::TubeSizes sizes;
  sizes.radius = 0.01;
  sizes.length = 0.04;
  sizes.wall_thickness = 0.002;
  sizes.cells_around = 64;
  sizes.cells_radial = 2;
  sizes.cells_along = 32;
  sizes.cells_through_wall = 2;
  return mesh::tube(sizes);
}

wall::Parameters with_fibres() {
  return config::parse_text(
             wall::Parameters::schema(),
             "density: 1100 kg/m^3\n"
             "fibre_frame: {cylindrical: {origin: [0 mm, 0 mm, 0 mm], axis: [0, 0, 1]}}\n"
             "material: {hgo: {shear_modulus: 20 kPa, poisson_ratio: 0.49, families: [{mean_angle: 0.6 rad, "
             "k1: 10 kPa, k2: 1}, {mean_angle: -0.6 rad, k1: 10 kPa, k2: 1}]}}\n")
      .value;
}

TEST(BeatFibres, LieOnTheWallAtTheAngleOfTheLaw) {
  const auto lines = fibre_lines(with_fibres(), tube());
  ASSERT_EQ(lines.size(), 4U) << "two families, inside and outside";
  for (const auto& set : lines) {
    EXPECT_GT(set.places.size(), 300U);
    EXPECT_LT(set.places.size(), 3000U);
    EXPECT_GT(set.length, 1e-4);
    const double sign = set.name == "family 1" ? 1 : -1, radius = set.kind == "inner" ? 0.01 : 0.012;
    for (std::size_t i = 0; i < set.places.size(); ++i) {
      const auto &x = set.places[i], &d = set.directions[i];
      const double r = std::hypot(x[0], x[1]);
      EXPECT_NEAR(r, radius, 5e-5);
      EXPECT_NEAR(norm(d), 1, 1e-12);
      // The frame is that of the element, whose centroid is half a cell off.
      const double along = d[2], around = (x[0] * d[1] - x[1] * d[0]) / r;
      EXPECT_NEAR(std::abs(around), std::cos(fibre_angle), 2e-3);
      EXPECT_NEAR(along * around, sign * std::sin(fibre_angle) * std::cos(fibre_angle), 2e-3);
    }
  }
}

TEST(BeatFibres, AreNoneWithoutFamilies) {
  auto wall = with_fibres();
  wall.material =
      config::parse_text(wall::law_schema(), "neo_hooke: {young_modulus: 0.3 MPa, poisson_ratio: 0.3}").value;
  EXPECT_TRUE(fibre_lines(wall, tube()).empty());
}

}  // namespace
}  // namespace tunica::stages
