#include "tunica/peer_cases/inputs.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "temporary_folder.hpp"

namespace tunica::peer_cases {

namespace {

TEST(Inputs, AreTheFileItselfAndThoseThatItNames) {
  const test::TemporaryFolder folder;
  std::ofstream(folder.path() / "solver.xml")
      << "<svMultiPhysicsFile><Add_mesh name=\"m\"><Mesh_file_path>m.vtu</Mesh_file_path></Add_mesh>"
         "</svMultiPhysicsFile>";
  for (const char* name : {"m.vtu", "other.yaml"}) std::ofstream(folder.path() / name) << "\n";
  const auto file = read_peer_file(folder.path());
  EXPECT_TRUE(is_input(file, folder.path() / "." / "solver.xml"));
  EXPECT_TRUE(is_input(file, folder.path() / "m.vtu"));
  EXPECT_FALSE(is_input(file, folder.path() / "other.yaml"));
  EXPECT_FALSE(is_input(file, folder.path() / "new.yaml"));
}

}  // namespace

}  // namespace tunica::peer_cases
