#include "tunica/artifacts/step_grid.hpp"

#include <gtest/gtest.h>

namespace tunica::artifacts {
namespace {

TEST(StepGrid, HalvedStepsGrowAgainAndLandOnTheGrid) {
  StepGrid grid(0.1, 3);
  grid.accept();
  EXPECT_EQ(grid.steps_done(), 1);
  ASSERT_TRUE(grid.halve());
  ASSERT_TRUE(grid.halve());
  EXPECT_DOUBLE_EQ(grid.next_step(), 0.025);
  grid.accept();  // 1.25: a half would not fit from here
  EXPECT_DOUBLE_EQ(grid.next_step(), 0.025);
  EXPECT_FALSE(grid.on_grid());
  grid.accept();  // 1.5
  EXPECT_DOUBLE_EQ(grid.next_step(), 0.05);
  EXPECT_DOUBLE_EQ(grid.time(), 0.15);
  grid.accept();
  EXPECT_TRUE(grid.on_grid());
  EXPECT_EQ(grid.steps_done(), 2);
  EXPECT_EQ(grid.time(), 0.1 * 2);
  EXPECT_EQ(grid.next_step(), 0.1);
}

TEST(StepGrid, HalvingsAreLimited) {
  StepGrid grid(1.0, 2);
  EXPECT_TRUE(grid.halve());
  EXPECT_TRUE(grid.halve());
  EXPECT_FALSE(grid.halve());
  EXPECT_EQ(grid.next_step(), 0.25);
  EXPECT_FALSE(StepGrid(1.0, 0).halve());
}

TEST(StepGrid, GoesOnFromAPosition) {
  StepGrid grid(0.1, 4);
  for (int k = 0; k < 7; ++k) grid.accept();
  grid.halve();
  grid.accept();
  const StepGrid same(0.1, 4, grid.position());
  EXPECT_EQ(same.time(), grid.time());
  EXPECT_EQ(same.next_step(), grid.next_step());
  EXPECT_FALSE(same.on_grid());

  StepGrid finer(0.02, 4, grid.position());  // another step size: a new grid begins here
  EXPECT_TRUE(finer.on_grid());
  EXPECT_DOUBLE_EQ(finer.time(), 0.75);
  EXPECT_EQ(finer.steps_done(), 7);
  finer.accept();
  EXPECT_DOUBLE_EQ(finer.time(), 0.77);
}

TEST(StepGrid, WantedLevelIsTakenAtOnceOrAsSoonAsPartsFill) {
  StepGrid grid(1.0, 5);
  grid.accept(2);
  EXPECT_EQ(grid.level(), 2);
  EXPECT_EQ(grid.time(), 1.0);
  grid.accept(0);  // a quarter does not fill a half
  EXPECT_EQ(grid.level(), 2);
  grid.accept(0);
  EXPECT_EQ(grid.level(), 1);
  grid.accept(1);
  EXPECT_EQ(grid.level(), 1);
  EXPECT_EQ(grid.time(), 2.0);
  grid.accept(9);
  EXPECT_EQ(grid.level(), 5);
}

}  // namespace
}  // namespace tunica::artifacts
