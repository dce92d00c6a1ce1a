#include "tunica/artifacts/manifest.hpp"

#include <gtest/gtest.h>

#include "shared_folder.hpp"
#include "tunica/base/error.hpp"
#include "tunica/parallel/agree.hpp"

namespace tunica::artifacts {
namespace {

using test::message_of;
using test::SharedFolder;

std::string manifest(const std::string& runs, const std::string& region = "lumen") {
  return R"({"case": {"file": "case.yaml", "hash": "0b"}, "mesh": {"hash": "2a", "regions": [{"name": ")" + region +
         R"("}]}, "runs": )" + runs + "}";
}

const std::string run = R"([{"status": "completed", "last_step": 3}])";

TEST(Manifest, TellsWhatIsThere) {
  const SharedFolder folder;
  folder.write("manifest.json", manifest(run));
  const auto found = find_results(folder.path());
  EXPECT_EQ(found->last_step, 3);
  EXPECT_EQ(found->regions, std::vector<std::string>{"lumen"});
}

TEST(Manifest, RefusesAnythingElse) {
  const SharedFolder folder;
  const auto refusal = [&](const std::string& text, const auto& read) {
    MPI_Barrier(MPI_COMM_WORLD);  // until all have read the one before
    folder.write("manifest.json", text);
    return message_of<InputError>(read);
  };
  const auto find = [&] { find_results(folder.path()); };
  const auto go_on = [&] { Manifest(folder.path(), {}, true); };
  const std::string expected = "is no manifest that tunica wrote";
  const std::string cut_off = manifest(run).substr(0, 60);
  EXPECT_NE(refusal(cut_off, find).find(expected), std::string::npos);
  EXPECT_EQ(refusal(cut_off, go_on), "") << "a run that is continued survives it";
  for (const auto& text : {manifest("[]"), manifest("3"), manifest("null"), manifest("{}"), std::string("[1]"),
                           std::string("3"), std::string("{}")}) {
    EXPECT_NE(refusal(text, find).find(expected), std::string::npos) << text;
    EXPECT_NE(refusal(text, go_on).find(expected), std::string::npos) << text;
  }
  EXPECT_NE(refusal(manifest(R"([{"status": 1}])"), find).find(expected), std::string::npos);
  // Files are removed by these names.
  for (const char* name : {"", "../../other", "/tmp/other"})
    EXPECT_NE(refusal(manifest(run, name), find).find(expected), std::string::npos) << name;
}

}  // namespace
}  // namespace tunica::artifacts
