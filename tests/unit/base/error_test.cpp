#include "tunica/base/error.hpp"

#include <gtest/gtest.h>

namespace tunica {
namespace {

TEST(Errors, MessageNamesEveryPlaceFindingAndRemedy) {
  const InputError error({{"case.yaml: lumen.mesh", "file missing", "check the path"},
                          {"case.yaml: time.step", "-1 s is not above 0 s", "give a positive step"}});
  const std::string message = error.what();
  for (const Problem& problem : error.problems())
    for (const std::string& part : {problem.where, problem.what, problem.remedy})
      EXPECT_NE(message.find(part), std::string::npos) << part;
  EXPECT_EQ(error.problems().size(), 2u);
  EXPECT_EQ(InputError("here", "bad", "mend").problems().front().remedy, "mend");
}

TEST(Errors, QuotedBytesOfFilesGiveNoOrdersToATerminal) {
  const InputError error("a.pvd", std::string("is no number: \x1b[2J\0\r\xff ä", 24), "give\n\tanother");
  EXPECT_STREQ(
      error.what(),
      "1 problem in the input:\n  a.pvd: is no number: \\x1b[2J\\x00\\x0d\\xff ä\n    remedy: give\n\tanother");
}

TEST(Errors, KindsAreToldApart) {
  EXPECT_THROW(throw SolverError("stage flow, t = 1 s: norm 2"), std::runtime_error);
  EXPECT_THROW(throw InputError("a", "b", "c"), InputError);
}

}  // namespace
}  // namespace tunica
