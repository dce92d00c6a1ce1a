#include "tunica/case/table_ends.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace tunica::case_file {
namespace {

namespace fs = std::filesystem;

class TableEnds : public testing::Test {
 protected:
  TableEnds() : file_(fs::temp_directory_path() / ("tunica_table_ends_" + std::to_string(getpid()) + ".csv")) {}
  ~TableEnds() override { fs::remove(file_); }

  bc::WaveformInput table(const std::string& lines, bool periodic = false) const {
    std::ofstream(file_) << "t,v\n" << lines;
    return {.source = bc::TableSource{.file = {.path = file_}, .options = {.periodic = periodic}}};
  }
  static std::string found(const bc::Condition& condition, const AskedTime& asked) {
    std::string text;
    for (const auto& p : check_table_ends({{"inlet", condition}}, asked)) text += p.where + ": " + p.what + "\n";
    return text;
  }
  fs::path file_;
};

const AskedTime run{.begin = 0, .end = 1.2, .first = 0.05, .by = "the run (12 steps of 0.1 s)"};

TEST_F(TableEnds, BothEndsAreTold) {
  EXPECT_EQ(found(bc::Flow{table("0,1\n0.8,2\n")}, run),
            "boundary.inlet: the table " + file_.string() + " ends at 0.8 s, the run (12 steps of 0.1 s) at 1.2 s\n");
  EXPECT_EQ(found(bc::Flow{table("0,1\n1.2,2\n")}, run), "");
  EXPECT_EQ(found(bc::Flow{table("0.05,1\n1.2,2\n")}, run), "");
  EXPECT_NE(found(bc::Flow{table("0.06,1\n1.3,2\n")}, run).find("begins at 0.06 s"), std::string::npos);
}

TEST_F(TableEnds, EveryConditionWithATableIsLookedAt) {
  for (const bc::Condition& condition :
       {bc::Condition{bc::Flow{table("0,1\n0.8,2\n")}}, bc::Condition{bc::Pressure{table("0,1\n0.8,2\n")}},
        bc::Condition{bc::Velocity{{}, table("0,1\n0.8,2\n")}}, bc::Condition{bc::Traction{{}, table("0,1\n0.8,2\n")}}})
    EXPECT_NE(found(condition, run).find("ends at 0.8 s"), std::string::npos);
  EXPECT_EQ(found(bc::Flow{table("0,1\n0.8,1\n", true)}, run), "");
  EXPECT_EQ(found(bc::Flow{bc::WaveformInput{5.0}}, run), "");
  EXPECT_EQ(found(bc::Flow{bc::WaveformInput{bc::Step{.value = 1, .start = 0, .end = 0.1}}}, run), "");
  EXPECT_EQ(found(bc::NoSlip{}, run), "");
}

TEST_F(TableEnds, WhatARunAsksFor) {
  Case c;
  c.analysis = RigidFlow{};
  c.time.emplace();
  c.time->step = 0.1, c.time->steps = 12;
  EXPECT_DOUBLE_EQ(asked_by_run(c).end, 1.2);
  c.time->cycles = coupling::CycleSettings{.period = 0.8, .most = 3};
  EXPECT_DOUBLE_EQ(asked_by_run(c).end, 2.4);
  EXPECT_EQ(asked_by_run(c).by, "the run (3 cycles of 0.8 s)");
  c.analysis = StaticWall{.load_time = 0.3};
  EXPECT_DOUBLE_EQ(asked_by_run(c).end, 0.3);
  EXPECT_DOUBLE_EQ(asked_by_run(c).first, 0.3);
  c.prestress.emplace();
  c.prestress->load_time = 0.4;
  EXPECT_DOUBLE_EQ(asked_by_prestress(c).end, 0.4);
}

TEST_F(TableEnds, ConditionsOnFaces) {
  const std::vector<std::pair<std::string, bc::Condition>> all{
      {"lumen_a", bc::NoSlip{}}, {"wall_*", bc::Free{}}, {"outer", bc::Free{}}};
  const auto wall = conditions_on(all, {"wall_inlet", "outer"});
  ASSERT_EQ(wall.size(), 2u);
  EXPECT_EQ(wall[0].first, "wall_*");
  EXPECT_EQ(wall[1].first, "outer");
}

}  // namespace
}  // namespace tunica::case_file
