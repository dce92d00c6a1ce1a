#include "tunica/artifacts/run_folder.hpp"

#include <gtest/gtest.h>

#include "shared_folder.hpp"
#include "tunica/artifacts/manifest.hpp"
#include "tunica/base/error.hpp"
#include "tunica/field_io/series_index.hpp"

namespace tunica::artifacts {
namespace {

namespace fs = std::filesystem;
using test::message_of;
using test::SharedFolder;
using test::slurp;

const std::string manifest_text =
    R"({"case": {"hash": "1f", "file": "case.yaml"}, "mesh": {"hash": "2", "regions": [{"name": "lumen"}]},
        "runs": [{"status": "completed", "last_step": 3}, {"status": "running", "last_step": 5}]})";

TEST(RunFolder, MissingFieldsAreNamed) {
  const SharedFolder folder(MPI_COMM_SELF);
  folder.write("lumen.hdf.series",
               field_io::series_text({{0, "lumen_000000.hdf"}, {1, "lumen_000001.hdf"}, {2, "later.hdf"}}));
  for (const char* file : {"lumen_mesh.hdf", "lumen_000000.hdf", "lumen_000001.hdf"}) folder.write(file, "");
  EXPECT_TRUE(missing_fields(folder.path(), {"lumen"}, 1).empty());
  fs::remove(folder.path() / "lumen_000000.hdf");
  fs::remove(folder.path() / "lumen_mesh.hdf");
  const auto missing = missing_fields(folder.path(), {"lumen", "wall"}, 1);
  ASSERT_EQ(missing.size(), 3u);
  EXPECT_EQ(missing[0].substr(0, 14), "lumen_mesh.hdf");
  EXPECT_EQ(missing[1].substr(0, 16), "lumen_000000.hdf");
  EXPECT_NE(missing[2].find("wall.hdf.series is missing"), std::string::npos);
}

TEST(RunFolder, SeriesOfEarlierVersionsAreRefusedAndRemoved) {
  const SharedFolder folder(MPI_COMM_SELF);
  for (const char* file : {"lumen.pvd", "lumen_000000.pvtu", "lumen_000000_0.vtu", "lumen_000000.hdf", "lumen_mesh.hdf",
                           "lumen.hdf.series", "results.xdmf", "lumen_notes.hdf"})
    folder.write(file, "");
  fs::remove(folder.path() / "lumen.hdf.series");
  EXPECT_NE(message_of<InputError>([&] { missing_fields(folder.path(), {"lumen"}, 1); }).find("earlier version"),
            std::string::npos);
  EarlierResults results;
  results.regions = {"lumen"};
  remove_results(folder.path(), results);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1);
  EXPECT_TRUE(fs::exists(folder.path() / "lumen_notes.hdf"));
}

TEST(RunFolder, NothingGoesOnWithoutAWholeCheckpointAndHistories) {
  const SharedFolder folder(MPI_COMM_SELF);
  EXPECT_FALSE(find_continuation(folder.path()).possible);
  EXPECT_TRUE(find_continuation(folder.path()).warnings.empty());
  fs::create_directory(folder.path() / "checkpoints");
  folder.write("checkpoints/step_00000005.checkpoint", "cut off");
  const auto found = find_continuation(folder.path());
  EXPECT_FALSE(found.possible);
  ASSERT_EQ(found.warnings.size(), 1u);
  EXPECT_NE(found.warnings[0].find("step_00000005.checkpoint: "), std::string::npos);
}

TEST(Manifest, TracesOfARunAreResults) {
  const SharedFolder folder(MPI_COMM_SELF);
  EXPECT_FALSE(find_results(folder.path()));
  const auto file = folder.write("manifest.json", "{\"name\": \"of a web page\"}");
  EXPECT_NE(message_of<InputError>([&] { find_results(folder.path()); }).find("is no manifest"), std::string::npos);
  folder.write("manifest.json", "{\"case\":");
  EXPECT_NE(message_of<InputError>([&] { find_results(folder.path()); }).find("is no manifest"), std::string::npos);
  folder.write("steps.csv", ""), folder.write("balance.csv", ""), folder.write("lumen.hdf.series", "");
  EXPECT_EQ(find_results(folder.path())->damage, "is cut off or altered");
  EXPECT_EQ(find_results(folder.path())->regions, std::vector<std::string>{"lumen"});
  fs::remove(file);
  EXPECT_EQ(find_results(folder.path())->damage, "is missing");
  remove_results(folder.path(), *find_results(folder.path()));
  EXPECT_TRUE(fs::is_empty(folder.path()));
  folder.write("manifest.json", manifest_text);
  EXPECT_EQ(find_results(folder.path())->damage, "");
  EXPECT_EQ(find_results(folder.path())->last_step, 5);
}

TEST(Manifest, AnEndIsRecordedOnlyWhereARunIsUnderWay) {
  const SharedFolder folder(MPI_COMM_SELF);
  record_end(folder.path(), "failed", "no memory");
  EXPECT_FALSE(fs::exists(folder.path() / "manifest.json"));
  folder.write("manifest.json", manifest_text);
  record_end(folder.path(), "failed", "no memory");
  EXPECT_EQ(find_results(folder.path())->status, "failed");
  EXPECT_NE(slurp(folder.path() / "manifest.json").find("no memory"), std::string::npos);
  EXPECT_NE(slurp(folder.path() / "manifest.json").find("completed"), std::string::npos);
  const std::string before = slurp(folder.path() / "manifest.json");
  record_end(folder.path(), "failed", "again");
  EXPECT_EQ(slurp(folder.path() / "manifest.json"), before);
}

}  // namespace
}  // namespace tunica::artifacts
