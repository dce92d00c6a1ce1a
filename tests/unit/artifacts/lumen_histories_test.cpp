#include "tunica/artifacts/lumen_histories.hpp"

#include <gtest/gtest.h>

#include "shared_folder.hpp"
#include "tunica/base/error.hpp"

namespace tunica::artifacts {
namespace {

using test::SharedFolder;
using test::slurp;

analysis::Lumens one_tear() {
  analysis::Lumens lumens;
  lumens.map.tears = {"tear_1"};
  lumens.map.in_false = {1};
  lumens.map.parts = {"true lumen", "tear_1"};
  lumens.tears = {{"tear_1", {{0.001, 0, 0.02}}, 3e-6}};
  return lumens;
}

coupling::LumenRecord record() {
  return {.tear_flows = {2e-6},
          .in_false = {.volume = 3e-6, .volume_rate = 0.5e-6, .outflow = 1.0e-6, .leakage = 0.25e-6},
          .true_volume = 4e-6,
          .residual = 0.25e-6,
          .largest_flow = 2e-6,
          .viscous = {1, 2},
          .numerical = {3, 4}};
}

TEST(LumenHistories, LinesInTheUnitsOfTheCase) {
  const SharedFolder folder(MPI_COMM_SELF);
  LumenHistories histories(folder.path(), {}, one_tear(), {});
  histories.append(1, 0.1, record());
  EXPECT_EQ(slurp(folder.path() / "lumens.csv"),
            "step,time [s],tear_1 flow [ml/s],false lumen outflow [ml/s],false lumen wall leakage [ml/s],false lumen "
            "dV/dt [ml/s],false lumen volume "
            "[mm^3],true lumen volume [mm^3],false lumen residual [ml/s],relative residual\n"
            "1,0.1,2,1,0.25,0.5,3000,4000,0.25,0.125\n");
  EXPECT_EQ(slurp(folder.path() / "dissipation.csv"),
            "step,time [s],true lumen viscous dissipation [W],true lumen numerical dissipation [W],tear_1 viscous "
            "dissipation [W],tear_1 numerical dissipation [W]\n1,0.1,1,3,2,4\n");
  EXPECT_NE(slurp(folder.path() / "lumens.json").find("tear_1"), std::string::npos);
}

TEST(LumenHistories, AreContinuedAndBeginWhereAnOlderVersionWroteNone) {
  const SharedFolder folder(MPI_COMM_SELF);
  {
    LumenHistories begun(folder.path(), {}, one_tear(), 7);
    ASSERT_EQ(begun.damage().size(), 2U);
    EXPECT_NE(begun.damage()[0].find("lumens.csv: is missing in the run to be continued, and begins after step 7"),
              std::string::npos);
    for (const int step : {8, 9}) begun.append(step, 0.1 * step, record());
  }
  const std::string before = slurp(folder.path() / "lumens.csv");
  LumenHistories continued(folder.path(), {}, one_tear(), 8);
  EXPECT_TRUE(continued.damage().empty());
  continued.append(9, 0.9, record());
  EXPECT_EQ(slurp(folder.path() / "lumens.csv"), before);
  EXPECT_EQ(LumenHistories(folder.path(), {}, one_tear(), 11).damage().size(), 2U);

  auto other = one_tear();
  other.map.tears[0] = "tear_2";
  EXPECT_THROW(LumenHistories(folder.path(), {}, other, 9), InputError);
}

}  // namespace
}  // namespace tunica::artifacts
