// Flows of the tears over a window, from the histories of a run.
#include "tunica/stages/post/lumen_flows.hpp"

#include <gtest/gtest.h>

#include "shared_folder.hpp"
#include "tunica/base/error.hpp"
#include "tunica/stages/post/findings.hpp"

namespace tunica::stages::post {
namespace {

using test::SharedFolder;

constexpr const char *json = R"({"tears": [{"name": "tear_1", "centre_mm": [0, 0, 10], "area_mm2": 30},
                                           {"name": "tear_2", "centre_mm": [0, 0, 90], "area_mm2": 20}]})",
                     *header =
                         "step,time [ms],tear_1 flow [ml/s],tear_2 flow [ml/s],false lumen outflow [ml/s],false "
                         "lumen wall leakage [ml/s],false lumen dV/dt [ml/s],false lumen volume [ml],true lumen "
                         "volume [ml],false lumen residual [ml/s],relative residual\n";

void write(const SharedFolder& folder, const std::string& lines) {
  folder.write("lumens.json", json);
  folder.write("lumens.csv", header + lines);
}

TEST(LumenFlows, OfARunReachFromEndToEndOfTheWindow) {
  const SharedFolder folder(MPI_COMM_SELF);
  write(folder, "1,50,2,-1,0,0.5,0.5,10,20,0,0\n2,150,4,-2,0,1,1,11,19,0,0\n3,250,6,-3,0,1.5,1.5,12,18,0,0\n");
  std::string why;
  const auto series = read_lumens(folder.path(), {.from = 0.1, .until = 0.3}, why);
  ASSERT_TRUE(series) << why;
  const auto flows = flows_of_run(*series, {}, 0.1, 0.3);
  ASSERT_EQ(flows.times.size(), 4u);
  ASSERT_EQ(flows.tears.size(), 2u);
  const double expected[] = {3e-6, 4e-6, 6e-6, 7e-6};  // between two lines, on them, beyond the last
  for (int k = 0; k < 4; ++k) {
    EXPECT_NEAR(flows.tears[0].flow[k], expected[k], 1e-15);
    EXPECT_NEAR(flows.residual()[k], 0, 1e-15);
  }
  EXPECT_NEAR(flows.volume[1], 11e-6, 1e-15);
  EXPECT_EQ(flows.tears[0].place.name, "tear_1");
  EXPECT_NEAR(flows.tears[1].place.centre[2], 0.09, 1e-12);
  EXPECT_EQ(flows.entry(), 0u);
}

TEST(LumenFlows, OfResultsThatLackThemAreTold) {
  const SharedFolder folder(MPI_COMM_SELF);
  std::string why;
  EXPECT_FALSE(read_lumens(folder.path(), {.from = 0, .until = 0.3}, why));
  EXPECT_NE(why.find("has not written lumens.csv"), std::string::npos);
  write(folder, "5,450,2,-1,0,0,1,10,20,0,0\n6,550,4,-2,0,0,2,11,19,0,0\n");
  EXPECT_FALSE(read_lumens(folder.path(), {.from = 0, .until = 0.6}, why));
  EXPECT_NE(why.find("began lumens.csv at 0.45 s"), std::string::npos) << why;
  EXPECT_TRUE(read_lumens(folder.path(), {.from = 0.4, .until = 0.6}, why));
  write(folder, "1,50,2,-1,0,0,1,10,20,0,0\n2,150,4,-2,0,0,2,11,19,0,0\n4,350,4,-2,0,0,2,11,19,0,0\n");
  EXPECT_THROW(read_lumens(folder.path(), {.from = 0, .until = 0.4}, why), InputError);
}

TEST(LumenFlows, TearsOfTheFieldsTakeTheNamesOfTheRun) {
  analysis::Vessel vessel;
  vessel.tears = {{.name = "tear_1", .surface = {}, .centre = {{0, 0, 0.09}}},
                  {.name = "tear_2", .surface = {}, .centre = {{0, 0, 0.01}}}};
  const std::vector<analysis::TearPlace> of_run{{"tear_1", {{0, 0, 0.011}}, 1}, {"tear_2", {{0, 0, 0.088}}, 1}};
  EXPECT_TRUE(name_as_in_run(of_run, vessel));
  EXPECT_EQ(vessel.tears[0].name, "tear_1");
  EXPECT_EQ(vessel.tears[0].centre[2], 0.01);
  vessel.tears[1].centre = {{0, 0, 0.02}};
  EXPECT_FALSE(name_as_in_run(of_run, vessel));
  vessel.tears.pop_back();
  EXPECT_FALSE(name_as_in_run(of_run, vessel));
}

}  // namespace
}  // namespace tunica::stages::post
