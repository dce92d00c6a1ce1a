#include "tunica/mesh/plausible_size.hpp"

#include <gtest/gtest.h>

#include "tunica/mesh/generate.hpp"

namespace tunica::mesh {
namespace {

MeshData vessel(double radius, double length) {
  return tube({.radius = radius, .length = length, .cells_around = 8, .cells_radial = 2, .cells_along = 4});
}

TEST(PlausibleSize, VesselsPass) {
  EXPECT_FALSE(implausible_size(vessel(12e-3, 0.5), 1e-3));
  EXPECT_FALSE(implausible_size(vessel(1e-3, 8e-3), {}));
}

TEST(PlausibleSize, WrongUnitsAreOneWarningEach) {
  const auto large = implausible_size(vessel(0.5, 3), 1.0);
  ASSERT_TRUE(large);
  EXPECT_NE(large->what.find("3000 mm long; 5 mm to 700 mm is usual"), std::string::npos) << large->what;
  EXPECT_NE(large->what.find("holds"), std::string::npos);
  EXPECT_NE(large->remedy.find("`length_unit: cm` it would be 30 mm"), std::string::npos) << large->remedy;
  const auto small = implausible_size(vessel(12e-6, 300e-6), 1e-6);
  ASSERT_TRUE(small);
  EXPECT_NE(small->what.find("0.3 mm long"), std::string::npos);
  EXPECT_NE(small->remedy.find("`length_unit: mm` it would be 300 mm"), std::string::npos) << small->remedy;
  EXPECT_TRUE(implausible_size(vessel(12e-3, 1.0), {}));
}

TEST(PlausibleSize, LitresOfLumen) {
  const auto wide = implausible_size(vessel(40e-3, 0.4), 1e-3);
  ASSERT_TRUE(wide);
  EXPECT_TRUE(wide->what.starts_with("the lumen holds")) << wide->what;
}

}  // namespace
}  // namespace tunica::mesh
