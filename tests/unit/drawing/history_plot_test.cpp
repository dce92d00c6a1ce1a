#include "tunica/drawing/history_plot.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "tunica/base/error.hpp"

namespace tunica::drawing {
namespace {

struct HistoryPlot : testing::Test {
  std::filesystem::path folder = testing::TempDir(), file = folder / "faces.csv", svg = folder / "plot.svg";

  void write(const std::string& text) const { std::ofstream(file) << text; }
  HistoryPlotOptions options(std::vector<std::string> columns) const {
    return {.history = file, .columns = std::move(columns), .output = svg};
  }
  std::string message(const HistoryPlotOptions& o) const {
    try {
      plot_history(o);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }
};

constexpr const char* faces =
    "step,time [s],in flow [ml/s],in pressure [mmHg],out flow [ml/s]\n"
    "1,0.1,-5,80,4\n2,0.2,-6,81.5,5.5\n";

TEST_F(HistoryPlot, DrawsAllColumnsThatContainTheName) {
  write(faces);
  EXPECT_EQ(plot_history(options({"flow"})), (std::vector<std::string>{"in flow [ml/s]", "out flow [ml/s]"}));
  std::stringstream text;
  text << std::ifstream(svg).rdbuf();
  for (const char* part : {"<svg", "in flow [ml/s]", "out flow [ml/s]", "time [s]"})
    EXPECT_NE(text.str().find(part), std::string::npos) << part;
  EXPECT_EQ(plot_history(options({"out", "flow"})).size(), 2U) << "each column once";
}

TEST_F(HistoryPlot, SaysWhatIsWrong) {
  write(faces);
  EXPECT_NE(message(options({"area"})).find("in pressure [mmHg]"), std::string::npos) << "lists what exists";
  EXPECT_NE(message(options({"in "})).find("different units"), std::string::npos);
  write("time [s],a\n0,1\n1,x\n");
  EXPECT_NE(message(options({"a"})).find("faces.csv:3"), std::string::npos);
  write("time [s],a\n0\n");
  EXPECT_NE(message(options({"a"})).find("has 1 columns"), std::string::npos);
  EXPECT_NE(message({.history = folder / "none.csv", .columns = {"a"}, .output = svg}).find("cannot be read"),
            std::string::npos);
}

}  // namespace
}  // namespace tunica::drawing
