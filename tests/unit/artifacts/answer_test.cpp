#include "tunica/artifacts/answer.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "shared_folder.hpp"

namespace tunica::artifacts {
namespace {

TEST(Answer, RangesOfTheOpeningsOverTheLastCycle) {
  const test::SharedFolder folder(MPI_COMM_SELF);
  const auto file = folder.write("faces.csv",
                                 "step,time [s],inlet flow [ml/s],inlet pressure [mmHg],side flow [ml/s],side pressure "
                                 "[mmHg]\n1,0.5,999,999,0,0\n2,1,10,80,1,2\n3,1.5,-4,120,1,2\n");
  const auto lines = answer_lines(file, {"inlet", "side", "nowhere"}, 0.5);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0], "  inlet         80      100      120 mmHg        -4        3       10 ml/s");
  EXPECT_LT(lines[1].size(), 80u);
  EXPECT_NE(answer_lines(file, {"inlet"}, -HUGE_VAL)[0].find("999"), std::string::npos);
  EXPECT_TRUE(answer_lines(file, {"inlet"}, 2).empty());
}

}  // namespace
}  // namespace tunica::artifacts
