// One table for many meshes, and the preview of one.
#include "tunica/stages/meshing/mesh_batch.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "temporary_folder.hpp"
#include "tunica/base/error.hpp"

namespace tunica::stages {
namespace {

TEST(MeshBatch, GoesOnAfterErrorsAndTellsOfAll) {
  const auto outcomes = attempt_all({"a.yaml", "b, c.yaml", "d.yaml"}, [](const std::string& file) -> std::string {
    if (file == "a.yaml") throw InputError({{"image", "is \"empty\"", "give another"}, {"x", "y", "z"}});
    if (file == "d.yaml") throw SolverError("12 pairs\ncross");
    return "5 tetrahedra";
  });
  ASSERT_EQ(outcomes.size(), 3U);
  EXPECT_EQ(outcomes[0].exit_code, 2);
  EXPECT_NE(outcomes[0].message.find("and 1 more problems"), std::string::npos);
  EXPECT_EQ(outcomes[1].exit_code, 0);
  EXPECT_EQ(outcomes[2].exit_code, 3);
  EXPECT_EQ(outcomes[2].message, "12 pairs cross");
  EXPECT_EQ(worst_of(outcomes), 3);
  EXPECT_EQ(worst_of({}), 0);
  EXPECT_NE(outcome_text(outcomes).find("1 of 3 done"), std::string::npos);
}

TEST(MeshBatch, TheTableHoldsWhateverStandsInNamesAndMessages) {
  const test::TemporaryFolder folder;
  const auto path = (folder.path() / "all.csv").string();
  write_outcomes({{"b, c.yaml", 2, 1.25, "is \"empty\""}}, path);
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  EXPECT_EQ(text.str(), "file,exit_code,seconds,outcome\n\"b, c.yaml\",2,1.2,\"is \"\"empty\"\"\"\n");
}

}  // namespace
}  // namespace tunica::stages
