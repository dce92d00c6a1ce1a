#include "tunica/case/face_patterns.hpp"

#include <gtest/gtest.h>

namespace tunica::case_file {
namespace {

using Conditions = std::vector<std::pair<std::string, bc::Condition>>;
const std::vector<std::string> faces = {"lumen_inlet", "wall_inlet", "wall_left", "wall_outer"};

TEST(FacePatterns, ANameOfItsOwnComesBeforeAPattern) {
  std::vector<Problem> problems;
  const auto found = without_patterns({{"wall_*", bc::Fixed{}}, {"wall_outer", bc::Free{}}}, faces, problems);
  EXPECT_TRUE(problems.empty());
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].first, "wall_inlet");
  EXPECT_EQ(found[1].first, "wall_left");
  EXPECT_TRUE(std::holds_alternative<bc::Fixed>(found[1].second));
  EXPECT_EQ(found[2].first, "wall_outer");
  EXPECT_TRUE(std::holds_alternative<bc::Free>(found[2].second));
}

TEST(FacePatterns, NoFaceOrTwoPatternsForOneAreProblems) {
  std::vector<Problem> problems;
  without_patterns({{"lid_*", bc::Fixed{}}, {"wall_*", bc::Fixed{}}, {"*_left", bc::Free{}}}, faces, problems);
  ASSERT_EQ(problems.size(), 2u);
  EXPECT_EQ(problems[0].where, "boundary.lid_*");
  EXPECT_EQ(problems[1].where, "boundary.*_left");
  EXPECT_NE(problems[1].what.find("wall_left"), std::string::npos) << problems[1].what;
}

}  // namespace
}  // namespace tunica::case_file
