#include "tunica/artifacts/histories.hpp"

#include <gtest/gtest.h>

#include "shared_folder.hpp"
#include "tunica/base/error.hpp"

namespace tunica::artifacts {
namespace {

namespace fs = std::filesystem;
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

TEST(CsvTable, TellsLostDamagedAndRepeatedLines) {
  const SharedFolder folder(MPI_COMM_SELF);
  using Lines = CsvTable::Lines;
  const auto damage = [&](const std::string& lines, std::int64_t last, Lines kind = Lines::for_every_step) {
    const auto file = folder.write("t.csv", "step,a\n" + lines);
    std::string text;
    const CsvTable table(file, {"a"}, last, kind);
    for (const auto& line : table.damage()) text += line.substr(folder.path().string().size() + 1) + "\n";
    return text;
  };
  EXPECT_EQ(damage("1,1\n2,nan\n3,-inf\n", 3), "");
  EXPECT_EQ(damage("5,1\n6,2\n", 6), "");  // the steps before were taken in another folder
  EXPECT_EQ(damage("1,1\n2,2\n5,5\n", 5), "t.csv: the lines of steps 3 to 4 are missing\n");
  EXPECT_EQ(slurp(folder.path() / "t.csv"), "step,a\n1,1\n2,2\n5,5\n");
  EXPECT_EQ(damage("1,1\n2,2\n5,5\n", 2), "");
  EXPECT_EQ(damage("1,1\n5,5\n", 5, Lines::for_some_steps), "");
  EXPECT_EQ(damage("1,1\n?x\n3,3\n", 3),
            "t.csv: the line of step 2 is missing\nt.csv:3: is no line of 2 numbers, and is dropped\n");
  EXPECT_EQ(slurp(folder.path() / "t.csv"), "step,a\n1,1\n3,3\n");
  EXPECT_EQ(damage("1,1\n2,2,2\n2,2\n2,9\n3,3\n", 3),
            "t.csv:3: is no line of 2 numbers, and is dropped\nt.csv:5: repeats step 2, and is dropped\n");
  EXPECT_EQ(slurp(folder.path() / "t.csv"), "step,a\n1,1\n2,2\n3,3\n");
  EXPECT_EQ(damage("1,1\n2,2\n", 4), "t.csv: the lines of steps 3 to 4 are missing\n");
  EXPECT_EQ(damage("1,1\n2,2", 2), "t.csv: the line of step 2 is missing\n");
  EXPECT_EQ(damage("1,1\n2,2\n3,", 2), "");  // was being written
  EXPECT_EQ(damage("", 2), "t.csv: the lines of steps 1 to 2 are missing\n");
  EXPECT_NE(damage("1,1\n3,1\n5,1\n7,1\n9,1\n11,1\n13,1\n", 13).find("and so on in 2 more places"), std::string::npos);
}

TEST(Histories, BreaksAreFoundInATableThatIsRead) {
  files::CsvColumns table{"faces.csv", {"step"}, {{1, 2, 5, 6, 6, 8}}};
  const auto breaks = breaks_of(table);
  ASSERT_EQ(breaks.size(), 3u);
  EXPECT_EQ(breaks[0].line, 2u);
  EXPECT_EQ(breaks[0].what, "the lines of steps 3 to 4 are missing");
  EXPECT_EQ(breaks[1].what, "step 6 follows step 6");
  EXPECT_EQ(breaks[2].what, "the line of step 7 is missing");
}

TEST(CsvTable, ATableSavedWithOtherLineEndsIsContinued) {
  const SharedFolder folder(MPI_COMM_SELF);
  const auto file = folder.write("t.csv", "step,a\r\n1,10\r\n2,20\r\n3,30\r\n");
  const CsvTable table(file, {"a"}, 2);
  EXPECT_TRUE(table.damage().empty());
  EXPECT_EQ(slurp(file), "step,a\n1,10\n2,20\n");
}

TEST(CsvTable, RefusesToContinueAnotherTable) {
  const SharedFolder folder(MPI_COMM_SELF);
  const auto damaged = folder.write("d.csv", std::string("st\x1b[2Jep\0\xff,a\n1,10\n", 17));
  EXPECT_NE(message_of<InputError>([&] { CsvTable(damaged, {"a"}, 1); }).find("`st\\x1b[2Jep\\x00\\xff,a`"),
            std::string::npos);
  fs::create_directories(folder.path() / "f.csv");
  EXPECT_NE(message_of<InputError>([&] { CsvTable(folder.path() / "f.csv", {"a"}, 1); }).find("is a folder"),
            std::string::npos);
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
