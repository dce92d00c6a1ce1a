// Curves of a beat as pages draw them.
#include <gtest/gtest.h>

#include <algorithm>

#include "shared_folder.hpp"
#include "tunica/stages/beat.hpp"

namespace tunica::stages {
namespace {

/// Without figures of the cycle the histories alone tell where blood comes in, and that none passes the wall.
TEST(BeatPlots, FlowIsPositiveTheWayThatBloodGoes) {
  const test::SharedFolder folder(MPI_COMM_SELF);
  folder.write(
      "faces.csv",
      "step,time [ms],lumen_branch flow [ml/s],lumen_branch pressure [mmHg],lumen_inlet flow [ml/s],lumen_inlet "
      "pressure [mmHg],lumen_wall flow [ml/s],lumen_wall pressure [mmHg]\n"
      "1,5,40,79,-50,80,1e-12,80\n2,10,42,80,-40,81,0,80\n3,15,41,81,-41,82,-1e-12,80\n");
  const auto plots = collect_plots({.case_file = {}, .results = folder.path(), .post = nullptr}, {});
  ASSERT_EQ(plots.size(), 2U);
  for (const auto& plot : plots) {
    ASSERT_EQ(plot.curves.size(), 2U) << "of the wall there is no curve";
    EXPECT_EQ(plot.curves[0].name, "branch");
    EXPECT_EQ(plot.curves[1].name, "inlet");
    for (const auto& curve : plot.curves)
      for (const double y : curve.y) EXPECT_GT(y, 0) << curve.name;
  }
  EXPECT_NEAR(plots[1].curves[1].y[0], 50, 1e-9);
}

}  // namespace
}  // namespace tunica::stages
