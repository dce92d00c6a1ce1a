#include "tunica/peer_cases/values.hpp"

#include <gtest/gtest.h>

#include "tunica/base/error.hpp"
#include "tunica/peer_cases/unit_system.hpp"

namespace tunica::peer_cases {

namespace {

TEST(ReadNumber, TakesAWholeNumberOrNothing) {
  for (const auto dialect : {Dialect::xml, Dialect::inp}) {
    EXPECT_EQ(read_number("1.5e-5", dialect).value, 1.5e-5);
    EXPECT_EQ(read_number("+1212", dialect).value, 1212);
    for (const char* text : {"", "1.5 cm", "1,5", "1e", "nan", "inf", "--1", "0x10"})
      EXPECT_TRUE(read_number(text, dialect).error) << text;
  }
}

TEST(ReadNumber, TakesFortransExponentFromFortransFilesOnly) {
  EXPECT_EQ(read_number("1.5D-4", Dialect::inp).value, 1.5e-4);
  const auto trap = read_number("1.5D-4", Dialect::xml).error;
  ASSERT_TRUE(trap);
  EXPECT_NE(trap->what.find("is read as 1.5 by svMultiPhysics"), std::string::npos) << trap->what;
  EXPECT_NE(trap->remedy.find("1.5e-4"), std::string::npos) << trap->remedy;
}

TEST(ReadInteger, TakesDigitsAlone) {
  for (const auto dialect : {Dialect::xml, Dialect::inp, Dialect::svsolver}) {
    EXPECT_EQ(read_integer("1600", dialect).value, 1600);
    EXPECT_EQ(read_integer("+3", dialect).value, 3);
    EXPECT_EQ(read_integer("-3", dialect).value, -3);
    for (const char* text : {"", "1e3", "1000.0", "1.5", "1600 100", "3000000000", "e3"})
      EXPECT_TRUE(read_integer(text, dialect).error) << text;
  }
  const auto trap = read_integer("1e3", Dialect::xml).error;
  ASSERT_TRUE(trap);
  EXPECT_EQ(trap->what, "`1e3` is no whole number in digits; svMultiPhysics reads 1, stopping in front of the e");
  EXPECT_EQ(trap->remedy, "write 1000 for what it seems to mean");
}

TEST(ReadVector, TakesBracketsCommasAndBlanks) {
  const std::vector<double> expected{0, -0.5, 1};
  for (const char* text : {"(0, -0.5, 1 )", "0 -0.5 1", "{0,-0.5,1}", " ( 0.0,-.5,1.0)"})
    EXPECT_EQ(read_vector(text, Dialect::inp).values, expected) << text;
  EXPECT_TRUE(read_vector("(0, a, 1)", Dialect::xml).error);
  EXPECT_TRUE(read_vector("()", Dialect::xml).error);
}

TEST(ReadFlag, TakesWhatThePeersTake) {
  for (const char* text : {"true", "1"}) EXPECT_TRUE(read_flag(text, Dialect::xml).value) << text;
  for (const char* text : {"t", "True", "T", "1", "true"}) EXPECT_TRUE(read_flag(text, Dialect::inp).value) << text;
  for (const char* text : {"f", "False", "0"}) {
    EXPECT_FALSE(read_flag(text, Dialect::inp).value) << text;
    EXPECT_FALSE(read_flag(text, Dialect::inp).error) << text;
  }
  for (const char* text : {"t", "yes", "2", ""}) EXPECT_TRUE(read_flag(text, Dialect::xml).error) << text;
}

TEST(UnitSystem, IsAskedFor) {
  EXPECT_THROW(unit_system(""), InputError);
  EXPECT_THROW(unit_system("mks"), InputError);
  EXPECT_STREQ(unit_system("cgs").pressure, "dyn/cm^2");
}

TEST(UnitSystem, NamesScaledLengths) {
  EXPECT_EQ(scaled_length_unit(unit_system("cgs"), 0.1), "mm");
  EXPECT_EQ(scaled_length_unit(unit_system("cgs"), 100), "m");
  EXPECT_EQ(scaled_length_unit(unit_system("si"), 0.001), "mm");
  EXPECT_FALSE(scaled_length_unit(unit_system("cgs"), 10));
}

TEST(UnitSystem, FindsTheWrongOneByTheDensityOfBlood) {
  const auto wrong = [](const char* system, double density) {
    std::vector<Problem> problems;
    check_blood_density(unit_system(system), density, "Density", problems);
    return problems.size();
  };
  EXPECT_EQ(wrong("cgs", 1.06), 0u);
  EXPECT_EQ(wrong("si", 1060), 0u);
  EXPECT_EQ(wrong("mmgs", 1.06e-3), 0u);
  EXPECT_EQ(wrong("si", 1.06), 1u);
  EXPECT_EQ(wrong("cgs", 1.06e-3), 1u);
  EXPECT_EQ(wrong("mmgs", 1060), 1u);
  EXPECT_EQ(wrong("cgs", 0), 0u);  // the case file has no such density
}

}  // namespace

}  // namespace tunica::peer_cases
