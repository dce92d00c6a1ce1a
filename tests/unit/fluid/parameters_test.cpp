#include "tunica/fluid/parameters.hpp"

#include <gtest/gtest.h>

#include "tunica/config/schema.hpp"

namespace tunica::fluid {
namespace {

TEST(Schema, HasNoSlips) { EXPECT_TRUE(config::audit(*Parameters::schema().description()).empty()); }

TEST(Schema, ReadsEveryLawWithUnits) {
  const auto read = [](const std::string& yaml) { return config::parse_text(Parameters::schema(), yaml).value; };
  const Parameters defaults = read("density: 1060 kg/m^3\n");
  EXPECT_EQ(std::get<Newtonian>(defaults.viscosity).mu, 4e-3);
  EXPECT_EQ(defaults.backflow, 0.2);
  const Parameters given = read("density: 1.06 g/cm^3\nviscosity: {newtonian: {viscosity: 0.04 dyn s/cm^2}}\n");
  EXPECT_NEAR(given.density, 1060.0, 1e-10);
  EXPECT_NEAR(std::get<Newtonian>(given.viscosity).mu, 4e-3, 1e-17);
  EXPECT_EQ(std::get<CarreauYasuda>(read("viscosity: carreau_yasuda\n").viscosity).n, 0.22);
  EXPECT_NEAR(std::get<Casson>(read("viscosity: {casson: {yield_stress: 4 mPa}}\n").viscosity).yield_stress, 4e-3,
              1e-17);
}

TEST(Schema, RefusesWhatMakesNoSense) {
  EXPECT_THROW(config::parse_text(Parameters::schema(), "density: -1 kg/m^3\n"), InputError);
  EXPECT_THROW(config::parse_text(Parameters::schema(), "viscosity: {newtonian: {viscosity: 0 Pa s}}\n"), InputError);
  EXPECT_THROW(config::parse_text(Parameters::schema(), "backflow_stabilisation: 1.5\n"), InputError);
  // A density that was meant in g/cm^3 gives a warning.
  EXPECT_EQ(config::parse_text(Parameters::schema(), "density: 1.06 kg/m^3\n").warnings.size(), 1u);
}

}  // namespace
}  // namespace tunica::fluid
