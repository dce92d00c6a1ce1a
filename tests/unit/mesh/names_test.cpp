#include "tunica/mesh/names.hpp"

#include <gtest/gtest.h>

namespace tunica::mesh {
namespace {

TEST(Names, LettersDigitsAndSingleBlanks) {
  for (const char* good : {"inlet", "L iliac", "ModelFace_12", "A. renalis", "a.b", "7", "_x", "Arteria-renalis",
                           "Leistenarterie rechts äöü", "右腎"})
    EXPECT_EQ(objection_to_name(good), "") << good;
}

TEST(Names, WhatCannotBeAFileOrIsTakenForSomethingElse) {
  const std::pair<std::string, const char*> bad[] = {{"", "empty"},
                                                     {"L/R iliac", "'/'"},
                                                     {"../../up", "'/'"},
                                                     {"..", "begins with"},
                                                     {"out*", "'*'"},
                                                     {"out?", "'?'"},
                                                     {"[a]", "'['"},
                                                     {".hidden", "begins with"},
                                                     {"a.", "ends with"},
                                                     {"-x", "begins with"},
                                                     {" a", "begins with"},
                                                     {"a ", "ends with"},
                                                     {"a  b", "blanks"},
                                                     {"a..b", "points"},
                                                     {"a\\b", "'\\'"},
                                                     {"a,b", "','"},
                                                     {"a: b", "':'"},
                                                     {"<script>", "'<'"},
                                                     {"a\"b", "'\"'"},
                                                     {"a&b", "'&'"},
                                                     {"a\nb", "'\\x0a'"},
                                                     {"a#b", "'#'"},
                                                     {"M\xFCller", "not UTF-8"},
                                                     {"a\xC2\xA0"
                                                      "b",
                                                      "cannot be seen"},
                                                     {"a\xE2\x80\xAE"
                                                      "b",
                                                      "cannot be seen"},
                                                     {std::string(101, 'a'), "101 bytes"},
                                                     {std::string("a\0b", 3), "'\\x00'"}};
  for (const auto& [name, part] : bad)
    EXPECT_NE(objection_to_name(name).find(part), std::string::npos) << name << ": " << objection_to_name(name);
}

TEST(Names, AreUnlikeInMoreThanCase) {
  EXPECT_TRUE(check_names({{"a", "t.csv:2"}, {"b", "t.csv:3"}}, "opening").empty());
  const auto twice = check_names({{"a", "t.csv:2"}, {"a", "t.csv:5"}}, "opening");
  ASSERT_EQ(twice.size(), 1u);
  EXPECT_EQ(twice[0].where, "t.csv:5");
  EXPECT_NE(twice[0].what.find("is there already, at t.csv:2"), std::string::npos);
  EXPECT_NE(check_names({{"out", "t.csv:2"}, {"Out", "t.csv:3"}}, "opening").at(0).what.find("case of letters"),
            std::string::npos);
}

TEST(Names, OpeningsAreNotCalledAsOtherFaces) {
  for (const char* taken : {"wall", "inner", "outer", "Wall"}) {
    const auto problems = check_opening_names({{"inlet", "t.csv:2"}, {taken, "t.csv:3"}});
    ASSERT_EQ(problems.size(), 1u) << taken;
    EXPECT_EQ(problems[0].where, "t.csv:3");
  }
  EXPECT_EQ(check_opening_names({{"a/b", "t.csv:2"}, {"wall", "t.csv:3"}}).size(), 2u);
}

}  // namespace
}  // namespace tunica::mesh
