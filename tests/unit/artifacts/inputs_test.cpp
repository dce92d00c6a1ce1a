#include "tunica/artifacts/inputs.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "temporary_folder.hpp"
#include "tunica/base/error.hpp"

namespace tunica::artifacts {
namespace {

namespace fs = std::filesystem;

class InputsTest : public testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) const {
    fs::create_directories((path() / name).parent_path());
    std::ofstream(path() / name, std::ios::binary) << text;
  }
  const fs::path& path() const { return folder_.path(); }
  Inputs of(const std::string& name) const {
    Inputs inputs;
    Fingerprints().add(inputs, "key", path() / name);
    return inputs;
  }
  /// What is said when `change` happens to what `name` stands for.
  template <class Action>
  std::string said(const std::string& name, Action change) const {
    const Inputs then = of(name);
    change();
    const Inputs now = of(name);
    EXPECT_EQ(then == now, then.fingerprint() == now.fingerprint());
    return text_of(difference(then, now));
  }

 private:
  test::TemporaryFolder folder_;
};

TEST_F(InputsTest, AFileByItsContentsAndNoPath) {
  write("q.csv", "t,Q\n0,1\n");
  EXPECT_EQ(said("q.csv", [&] { write("q.csv", "t,Q\n0,2\n"); }), "q.csv (key)");
  write("elsewhere/other_name.csv", "t,Q\n0,2\n");
  EXPECT_EQ(of("q.csv"), of("elsewhere/other_name.csv"));
  EXPECT_EQ(said("q.csv", [&] { write("q.csv", std::string("t,Q\n0,2\n\0", 9)); }), "q.csv (key)") << "a zero more";
  EXPECT_EQ(said("q.csv", [&] { fs::remove(path() / "q.csv"); }), "q.csv (key)");
  EXPECT_EQ(said("q.csv", [] {}), "");
}

TEST_F(InputsTest, WhatAFileNames) {
  write("seg.nhdr", "NRRD0004\ndata file: voxels/seg.raw\n");
  write("voxels/seg.raw", "aaaa");
  EXPECT_EQ(said("seg.nhdr", [&] { write("voxels/seg.raw", "aaab"); }), "voxels/seg.raw (key)");
  write("series.pvd", "<DataSet file=\"a.pvtu\"/>");
  write("a.pvtu", "<Piece Source=\"a_0.vtu\"/><Piece Source=\"series.pvd\"/>");
  write("a_0.vtu", "1");
  EXPECT_EQ(said("series.pvd", [&] { write("a_0.vtu", "2"); }), "a_0.vtu (key)");
}

TEST_F(InputsTest, AMeshFolderWithLinksFollowedAndNothingElseThatLiesThere) {
  write("mesh/mesh-complete.mesh.vtu", "1");
  write("store/lumen_inlet.vtp", "1");
  write("file.vtp", "1");
  fs::create_directory_symlink(path() / "store", path() / "mesh/mesh-surfaces");
  fs::create_symlink(path() / "file.vtp", path() / "store/outlet.vtp");
  EXPECT_EQ(said("mesh", [&] { write("store/lumen_inlet.vtp", "2"); }), "mesh-surfaces/lumen_inlet.vtp (key)");
  EXPECT_EQ(said("mesh", [&] { write("file.vtp", "2"); }), "mesh-surfaces/outlet.vtp (key)");
  EXPECT_EQ(said("mesh", [&] { write("store/lumen_wall.vtp", "2"); }), "mesh-surfaces/lumen_wall.vtp (key)");
  EXPECT_EQ(said("mesh", [&] { write("mesh/mesh-complete.mesh.vtu", "2"); }), "mesh-complete.mesh.vtu (key)");
  EXPECT_EQ(said("mesh", [&] { write("mesh/results/faces.csv", "2"); }), "");
  const Inputs before = of("mesh");
  fs::rename(path() / "mesh", path() / "moved");
  EXPECT_EQ(before, of("moved"));
}

TEST_F(InputsTest, OfARunAreSettingsAndContents) {
  write("q.csv", "t,Q\n0,1\n1,1\n");
  const std::string yaml =
      "analysis: flow\nmeshes: {tube: {radius: 5 mm, length: 2 cm}}\nfluid: {}\n"
      "boundary: {lumen_inlet: {flow: {table: {file: q.csv, time_unit: s, unit: ml/s}}}, lumen_outlet: {pressure: 0 "
      "Pa}, "
      "lumen_wall: no_slip}\ntime: {step: 1 ms, steps: 2}\n";
  const Inputs then = run_inputs(yaml, path() / "case.yaml");
  const auto now = [&](const std::string& text) { return run_inputs(text, path() / "case.yaml"); };
  EXPECT_EQ(then, now("# a comment\ntitle: Another\noutput: {directory: elsewhere}\n" + yaml));
  std::string text = yaml;
  EXPECT_EQ(then, now(text.replace(text.find("5 mm"), 4, "0.5 cm")));
  text.replace(text.find("0.5 cm"), 6, "6 mm");
  EXPECT_EQ(text_of(difference(then, now(text))), "meshes.tube.radius");
  write("q.csv", "t,Q\n0,1\n1,2\n");
  EXPECT_EQ(text_of(difference(then, now(yaml))), "q.csv (boundary.lumen_inlet.flow.table.file)");
  EXPECT_EQ(now(yaml).settings.count("boundary.lumen_inlet.flow.table.file"), 0u) << "the path itself does not count";
}

TEST_F(InputsTest, GoThroughJson) {
  write("q.csv", "1");
  Inputs inputs = of("q.csv");
  inputs.settings["time.steps"] = "3";
  const Inputs read = inputs_from_json(nlohmann::ordered_json::parse(to_json(inputs).dump()));
  EXPECT_EQ(read, inputs);
  EXPECT_EQ(read.files.at("key").name, "q.csv");
  EXPECT_THROW(inputs_from_json(nlohmann::ordered_json::parse("{\"settings\": {}, \"files\": {\"a\": \"b\"}}")),
               nlohmann::json::exception);
}

}  // namespace
}  // namespace tunica::artifacts
