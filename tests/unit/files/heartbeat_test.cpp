#include "tunica/files/heartbeat.hpp"

#include <gtest/gtest.h>

namespace tunica::files {
namespace {

using std::chrono::milliseconds;

TEST(Heartbeat, SpeaksWhereNobodyElseDoes) {
  std::vector<std::string> lines;
  {
    Heartbeat heartbeat([&](const std::string& line) { lines.push_back(line); }, milliseconds(50));
    heartbeat.tell("remeshing\nin two lines");
    std::this_thread::sleep_for(milliseconds(400));
  }
  ASSERT_GE(lines.size(), 2u);
  EXPECT_EQ(lines[0], "remeshing\nin two lines");
  EXPECT_NE(lines[1].find("... for 0 s: remeshing"), std::string::npos) << lines[1];
  EXPECT_EQ(lines[1].find('\n'), std::string::npos);
}

TEST(Heartbeat, IsSilentBesideLinesAndBeforeTheFirst) {
  std::vector<std::string> lines;
  {
    Heartbeat heartbeat([&](const std::string& line) { lines.push_back(line); }, milliseconds(2000));
    for (int k = 0; k < 20; ++k) heartbeat.tell("line");
  }
  EXPECT_EQ(lines.size(), 20u);
  lines.clear();
  {
    Heartbeat heartbeat([&](const std::string& line) { lines.push_back(line); }, milliseconds(10));
    std::this_thread::sleep_for(milliseconds(80));
  }
  EXPECT_TRUE(lines.empty());
}

}  // namespace
}  // namespace tunica::files
