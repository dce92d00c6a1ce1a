#include "tunica/config/units.hpp"

#include <gtest/gtest.h>

#include "tunica/base/error.hpp"
#include "tunica/config/nearest.hpp"

namespace tunica::config {
namespace {

double si(const char* text, const Dimension& d) {
  const auto result = parse_quantity(text, d);
  if (const auto* error = std::get_if<UnitError>(&result)) {
    ADD_FAILURE() << text << ": " << error->what << "; " << error->remedy;
    return 0.0;
  }
  return std::get<double>(result);
}

UnitError refused(const char* text, const Dimension& d) {
  const auto result = parse_quantity(text, d);
  if (const auto* value = std::get_if<double>(&result)) {
    ADD_FAILURE() << text << " was read as " << *value;
    return {};
  }
  return std::get<UnitError>(result);
}

TEST(Units, ReadsTheUnitsOfTheField) {
  struct Case {
    const char* text;
    Dimension dimension;
    double value;
  };
  const Case cases[] = {
      {"0.04 dyn s/cm^2", dimension::dynamic_viscosity, 0.004},
      {"4 cP", dimension::dynamic_viscosity, 0.004},
      {"0.04 P", dimension::dynamic_viscosity, 0.004},
      {"4 mPa s", dimension::dynamic_viscosity, 0.004},
      {"4 mPa*s", dimension::dynamic_viscosity, 0.004},
      {"4 mPa.s", dimension::dynamic_viscosity, 0.004},
      {"4 mPa\u00b7s", dimension::dynamic_viscosity, 0.004},
      {"0.04 g/cm/s", dimension::dynamic_viscosity, 0.004},
      {"125 mmHg", dimension::pressure, 16665.298426875},
      {"1e7 dyn/cm^2", dimension::pressure, 1e6},
      {"8 kPa", dimension::pressure, 8e3},
      {"10 cmH2O", dimension::pressure, 980.665},
      {"1.06 g/cm^3", dimension::density, 1060.0},
      {"1.06 g/cm\u00b3", dimension::density, 1060.0},
      {"121 dyn s/cm^5", dimension::resistance, 1.21e7},
      {"1 mmHg s/ml", dimension::resistance, 133.322387415e6},
      {"1.5e-4 cm^5/dyn", dimension::compliance, 1.5e-9},
      {"10 L/min", dimension::volume_flow, 1e-2 / 60.0},
      {"5 ml/s", dimension::volume_flow, 5e-6},
      {"5 cm^3 s^-1", dimension::volume_flow, 5e-6},
      {"1e7 N/m^3", dimension::stiffness_per_area, 1e7},
      {"3 N s/m^3", dimension::damping_per_area, 3.0},
      {"0.2 ms", dimension::time, 2e-4},
      {"2 1/s", dimension::frequency, 2.0},
      {"2/s", dimension::frequency, 2.0},
      {"3 mm^3", dimension::volume, 3e-9},
      {"3 \u00b5m", dimension::length, 3e-6},
      {"1.5mm", dimension::length, 1.5e-3},
      {"+1 m", dimension::length, 1.0},
      {"-1 m", dimension::length, -1.0},
      {"0.5", dimension::none, 0.5},
      {"50 %", dimension::none, 0.5},
      {"180 deg", dimension::angle, 3.14159265358979},
  };
  for (const Case& c : cases) EXPECT_NEAR(si(c.text, c.dimension), c.value, 1e-12 * std::abs(c.value)) << c.text;
}

TEST(Units, AnglesAreNoNumbers) {
  EXPECT_EQ(refused("35", dimension::angle).what, "`35` has no unit; an angle is due");
  EXPECT_EQ(refused("35", dimension::angle).remedy, "use one of: rad, deg");
  EXPECT_EQ(refused("35 deg", dimension::none).what, "`deg` is the unit of an angle, not of a number");
  EXPECT_EQ(in_si(0.5, dimension::angle), "0.5 rad");
}

TEST(Units, RefusesABareNumberWithTheUsualUnits) {
  const UnitError error = refused("0.04", dimension::dynamic_viscosity);
  EXPECT_EQ(error.what, "`0.04` has no unit; a dynamic viscosity is due");
  EXPECT_EQ(error.remedy, "use one of: Pa s, mPa s, P, cP, dyn s/cm^2");
}

TEST(Units, NamesBothDimensionsWhenTheyDiffer) {
  EXPECT_EQ(refused("5 mm", dimension::pressure).what, "`mm` is the unit of a length, not of a pressure or stress");
  EXPECT_EQ(refused("5 mm", dimension::none).remedy, "write a number without unit");
}

TEST(Units, SuggestsTheUnitThatWasMeant) {
  EXPECT_EQ(refused("125 mmhg", dimension::pressure).remedy, "did you mean `mmHg`?");
  EXPECT_EQ(refused("3 cm2", dimension::area).remedy, "write powers with ^: `cm^2`");
}

TEST(Units, RefusesAmbiguousAndBrokenTexts) {
  EXPECT_NE(refused("1 kg/m s", dimension::dynamic_viscosity).what.find("ambiguous"), std::string::npos);
  for (const char* text : {"", "soft", "nan", "inf m", "1 m/", "1 m^x", "1 m^", "1 m*/s", "1..2 m", "1 m^99",
                           "1 m^-2147483648", "1 m^2147483648"})
    refused(text, dimension::length);
}

TEST(Units, RefusesWhatNoNumberHolds) {
  const auto tiny = refused("1e-320 s", dimension::time);
  EXPECT_EQ(tiny.what, "`1e-320 s` is too close to 0 for a number");
  EXPECT_EQ(tiny.remedy, "write a value between 1e-307 and 1e308 in SI units, or 0");
  EXPECT_EQ(refused("1e-306 mm", dimension::length).what, "`1e-306 mm` is too close to 0 for a number");
  EXPECT_EQ(refused("1e308 km", dimension::length).what, "`1e308 km` is too large for a number");
  EXPECT_EQ(refused("-4e-320", dimension::none).what, "`-4e-320` is too close to 0 for a number");
  EXPECT_EQ(si("0 s", dimension::time), 0.0);
}

TEST(Units, FactorOfAUnitThrowsInputError) {
  EXPECT_DOUBLE_EQ(unit_factor("mm", dimension::length), 1e-3);
  EXPECT_THROW(unit_factor("s", dimension::length), InputError);
}

TEST(Units, SiTextReadsBackToTheSameBits) {
  for (double value : {0.1, 1.0 / 3.0, 133.322387415, 1e-300})
    EXPECT_EQ(si(in_si(value, dimension::resistance).c_str(), dimension::resistance), value);
  EXPECT_EQ(in_si(1.0, Dimension{1, 2, -3}), "1 kg m^2 s^-3");
}

TEST(Units, FindsTheUnitThatMakesAValuePlausible) {
  EXPECT_EQ(likely_meant("1.06 kg/m^3", dimension::density, 900, 1300), "1.06 g/cm^3");
  EXPECT_EQ(likely_meant("5 kg/m^3", dimension::density, 900, 1300), "");
}

TEST(Nearest, FindsSlipsAndNothingElse) {
  const std::string names[] = {"young_modulus", "density", "poisson_ratio"};
  EXPECT_EQ(nearest("youngs_modulus", names), "young_modulus");
  EXPECT_EQ(nearest("denisty", names), "density");
  EXPECT_EQ(nearest("Density", names), "density");
  EXPECT_EQ(nearest("viscosity_at_rest", names), "");
}

}  // namespace
}  // namespace tunica::config
