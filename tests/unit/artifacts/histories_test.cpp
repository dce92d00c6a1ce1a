#include "tunica/artifacts/histories.hpp"

#include <gtest/gtest.h>

#include "shared_folder.hpp"
#include "tunica/base/error.hpp"

namespace tunica::artifacts {
namespace {

using test::message_of;
using test::SharedFolder;
using test::slurp;

TEST(CsvTable, EveryLineIsOnDiskAtOnce) {
  const SharedFolder folder(MPI_COMM_SELF);
  const auto file = folder.path() / "t.csv";
  CsvTable table(file, {"time [s]", "flow [ml/s]"}, {});
  EXPECT_EQ(slurp(file), "step,time [s],flow [ml/s]\n");
  table.append(1, std::vector{0.1, -2.0 / 3.0});
  EXPECT_EQ(slurp(file), "step,time [s],flow [ml/s]\n1,0.1,-0.6666666667\n");
}

TEST(CsvTable, ContinuingDropsLaterAndTornLines) {
  const SharedFolder folder(MPI_COMM_SELF);
  const auto file = folder.write("t.csv", "step,a\n1,10\n2,20\n3,30\n4,4");
  CsvTable table(file, {"a"}, 2);
  EXPECT_EQ(slurp(file), "step,a\n1,10\n2,20\n");
  table.append(3, std::vector{31.0});
  EXPECT_EQ(slurp(file), "step,a\n1,10\n2,20\n3,31\n");

  folder.write("t.csv", "step,a\n1,10\n2,2");
  const CsvTable torn(file, {"a"}, 2);
  EXPECT_EQ(slurp(file), "step,a\n1,10\n");
}

TEST(CsvTable, RefusesToContinueAnotherTable) {
  const SharedFolder folder(MPI_COMM_SELF);
  const auto file = folder.write("t.csv", "step,a\n1,10\n");
  EXPECT_NE(message_of<InputError>([&] { CsvTable(file, {"b"}, 1); }).find("has the columns `step,a`"),
            std::string::npos);
  EXPECT_EQ(slurp(file), "step,a\n1,10\n");
  EXPECT_NE(message_of<InputError>([&] { CsvTable(folder.path() / "none.csv", {"b"}, 1); }).find("is missing"),
            std::string::npos);
}

TEST(CsvTable, SaysWhenALineCannotBeWritten) {
  const SharedFolder folder(MPI_COMM_SELF);
  const auto file = folder.path() / "t.csv";
  CsvTable table(file, {"a"}, {});
  std::filesystem::remove(file);
  EXPECT_NE(message_of<SolverError>([&] { table.append(1, std::vector{1.0}); }).find("t.csv"), std::string::npos);
}

}  // namespace
}  // namespace tunica::artifacts
