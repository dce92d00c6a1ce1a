#include "tunica/files/outputs.hpp"

#include <gtest/gtest.h>

#include "temporary_folder.hpp"
#include "text.hpp"
#include "tunica/base/error.hpp"
#include "tunica/files/atomic_file.hpp"

namespace tunica::files {
namespace {

namespace fs = std::filesystem;

template <class Action>
std::vector<Problem> problems(const Action& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.problems();
  }
  return {};
}

TEST(Outputs, FolderThatIsAFileIsRefused) {
  const test::TemporaryFolder folder;
  write_atomically(folder.path() / "file", "");
  EXPECT_EQ(problems([&] { make_folder(folder.path() / "file"); }).size(), 1u);
  EXPECT_EQ(problems([&] { make_folder(folder.path() / "file/below"); }).size(), 1u);
  EXPECT_EQ(problems([&] { make_folder(folder.path() / std::string(300, 'n')); }).size(), 1u);
  EXPECT_TRUE(problems([&] { make_folder(folder.path() / "a/b"); }).empty());
  EXPECT_TRUE(problems([&] { make_folder(folder.path() / "a/b"); }).empty());
}

TEST(Outputs, ThoseOfAnEarlierCallAreRemovedAndNothingElse) {
  const test::TemporaryFolder folder;
  for (const char* name : {"labels_000.nrrd", "labels_001.nrrd", "labels.txt", "truth.csv", "truth.csv.old"})
    write_atomically(folder.path() / name, "");
  fs::create_directory(folder.path() / "labels_002.nrrd");
  remove_outputs(folder.path(), {"labels_*.nrrd", "truth.csv"});
  EXPECT_FALSE(fs::exists(folder.path() / "labels_000.nrrd"));
  EXPECT_FALSE(fs::exists(folder.path() / "labels_001.nrrd"));
  EXPECT_FALSE(fs::exists(folder.path() / "truth.csv"));
  for (const char* name : {"labels.txt", "truth.csv.old", "labels_002.nrrd"})
    EXPECT_TRUE(fs::exists(folder.path() / name)) << name;
  EXPECT_TRUE(fits("a*b", "ab"));
  EXPECT_FALSE(fits("ab*ba", "aba"));
}

TEST(Outputs, AllThatCannotBeWrittenIsNamed) {
  const test::TemporaryFolder folder;
  fs::create_directory(folder.path() / "taken.csv");
  write_atomically(folder.path() / "lumen", "a file");
  write_atomically(folder.path() / "there.csv", "kept");
  const auto found = problems([&] {
    try_outputs(folder.path(), {"fine.csv", "there.csv", "new/deep/fine.csv", "taken.csv", "lumen/face.vtp",
                                "new/" + std::string(251, 'n'), std::string(252, 'n')});
  });
  ASSERT_EQ(found.size(), 4u);
  EXPECT_EQ(found[0].where, (folder.path() / "taken.csv").string());
  EXPECT_EQ(found[1].where, (folder.path() / "lumen/face.vtp").string());
  EXPECT_NE(found[3].what.find("252 bytes, at most 250"), std::string::npos) << found[3].what;
  EXPECT_EQ(test::slurp(folder.path() / "there.csv"), "kept");
  EXPECT_FALSE(fs::exists(folder.path() / "fine.csv"));
  EXPECT_FALSE(fs::exists(folder.path() / "new"));
}

TEST(Outputs, FolderThatTakesNoFilesIsRefused) {
  if (!fs::exists("/proc/self/fd")) GTEST_SKIP() << "there is no /proc";
  EXPECT_EQ(problems([&] { try_outputs("/proc/self/fd", {"a.csv"}); }).size(), 1u);
}

TEST(Outputs, FolderOfASingleFileHasToBeThere) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(problems([&] { try_output(folder.path() / "none/a.svg"); }).size(), 1u);
  EXPECT_TRUE(problems([&] { try_output(folder.path() / "a.svg"); }).empty());
  EXPECT_TRUE(problems([&] { try_output("a.svg"); }).empty());
}

}  // namespace
}  // namespace tunica::files
