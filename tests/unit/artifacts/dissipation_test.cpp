#include "tunica/artifacts/dissipation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "shared_folder.hpp"

namespace tunica::artifacts {
namespace {

using case_file::Elements;
using test::SharedFolder;

constexpr const char* steps = "step,time [ms],dt [ms]\n1,100,100\n2,200,100\n3,250,50\n4,300,50\n";

TEST(Dissipation, IntegralsOfTheStepsOfACycle) {
  const SharedFolder folder(MPI_COMM_SELF);
  folder.write("steps.csv", steps);
  folder.write("dissipation.csv",
               "step,time [ms],true lumen viscous dissipation [W],true lumen numerical dissipation [W],tear_1 viscous "
               "dissipation [W],tear_1 numerical dissipation [W]\n"
               "1,60,9,9,9,9\n2,160,1,0.2,2,1\n3,230,2,0.4,4,5\n4,280,4,0.8,2,1\n");
  const auto d = read_dissipation(folder.path(), 0.1, 0.3, Elements::linear);
  ASSERT_TRUE(d);
  EXPECT_NEAR(d->from, 0.1, 1e-12);
  EXPECT_NEAR(d->until, 0.3, 1e-12);
  ASSERT_EQ(d->parts.size(), 2U);
  EXPECT_NEAR(d->parts[0].viscous, 0.1 * 1 + 0.05 * 2 + 0.05 * 4, 1e-12);
  EXPECT_NEAR(d->parts[0].ratio(), 0.2, 1e-12);
  EXPECT_NEAR(d->parts[1].ratio(), 0.4 / 0.5, 1e-12);
  EXPECT_EQ(d->parts_above_limit(), std::vector<std::string>{"tear_1"});
  const auto warning = warning_of(*d);
  ASSERT_TRUE(warning);
  EXPECT_NE(warning->find("0.8 times in: tear_1"), std::string::npos) << *warning;
  EXPECT_NE(warning->find("elements: quadratic"), std::string::npos);
  EXPECT_EQ(warning->find("true lumen"), std::string::npos);
  EXPECT_FALSE(read_dissipation(folder.path(), 0.3, 0.4, Elements::linear));

  auto quadratic = *d;
  quadratic.elements = Elements::quadratic;
  EXPECT_EQ(warning_of(quadratic)->find("elements: quadratic"), std::string::npos) << "they are used already";

  const auto again = dissipation_from_json(nlohmann::ordered_json::parse(to_json(*d).dump()));
  EXPECT_EQ(to_json(again), to_json(*d));
}

TEST(Dissipation, OfTheWholeLumenWhereNoPartsAreToldApart) {
  const SharedFolder folder(MPI_COMM_SELF);
  folder.write("steps.csv", steps);
  folder.write("balance.csv",
               "step,time [ms],viscous dissipation [W],numerical dissipation [W]\n1,60,4,1\n2,160,4,1\n4,280,4,-3\n");
  const auto d = read_dissipation(folder.path(), -HUGE_VAL, 0.2, Elements::linear);
  ASSERT_TRUE(d);
  ASSERT_EQ(d->parts.size(), 1U);
  EXPECT_EQ(d->parts[0].part, "lumen");
  EXPECT_NEAR(d->parts[0].ratio(), 0.25, 1e-12);
  EXPECT_FALSE(warning_of(*d));
  // A scheme that makes energy is no better than one that takes it; the lost line of step 3 counts for nothing.
  EXPECT_NEAR(read_dissipation(folder.path(), 0.2, 0.3, Elements::linear)->parts[0].ratio(), 0.75, 1e-12);
}

TEST(Dissipation, OfBloodAtRestAndOfBloodWithoutFriction) {
  EXPECT_EQ((PartDissipation{"lumen", 0, 0}).ratio(), 0);
  EXPECT_TRUE((PartDissipation{"lumen", 0, 1}).above_limit());
  const Dissipation d{0, 1, {{"lumen", 0, 1}}};
  EXPECT_TRUE(to_json(d)["parts"][0]["ratio"].is_null());
}

}  // namespace
}  // namespace tunica::artifacts
