#include <gtest/gtest.h>

#include <cmath>

#include "shared_folder.hpp"
#include "tunica/artifacts/load_mesh.hpp"
#include "tunica/artifacts/outlets_file.hpp"
#include "tunica/artifacts/plausible_faces.hpp"

namespace tunica::artifacts {
namespace {

std::vector<std::string> warnings(const std::string& radius, const std::string& inlet) {
  return load_mesh(case_file::parse_case("analysis: flow\nmeshes: {tube: {radius: " + radius +
                                             ", length: 3 cm, cells_around: 16, cells_radial: 4, cells_along: 6}}\n"
                                             "fluid: {}\nboundary: {lumen_inlet: " +
                                             inlet +
                                             ", lumen_outlet: {pressure: 0 Pa}, lumen_wall: no_slip}\n"
                                             "time: {step: 1 ms, steps: 1}\n",
                                         "case.yaml"))
      .warnings;
}

void expect_one(const std::vector<std::string>& found, const std::string& part) {
  ASSERT_EQ(found.size(), 1u) << part;
  EXPECT_NE(found[0].find(part), std::string::npos) << found[0];
}

TEST(Plausible, FlowInItsOpening) {
  EXPECT_TRUE(warnings("5 mm", "{flow: 50 ml/s}").empty());
  EXPECT_TRUE(warnings("5 mm", "{flow: 0 ml/s}").empty());
  expect_one(warnings("5 mm", "{flow: 900 ml/s}"), "m/s on average over it; 1e-05 m/s to 5 m/s is usual");
  expect_one(warnings("20 mm", "{flow: 0.005 ml/s}"), "is 3.98e-06");
}

TEST(Plausible, ElementsAcrossTheLumen) {
  const auto load = [](const std::string& cells, const std::string& elements) {
    return load_mesh(case_file::parse_case(
        "analysis: flow\nmeshes: {tube: {radius: 5 mm, length: 3 cm, " + cells + "}}\nelements: " + elements +
            "\nfluid: {}\nboundary: {lumen_inlet: {flow: 50 ml/s}, lumen_outlet: "
            "{pressure: 0 Pa}, \"lumen_*\": no_slip}\ntime: {step: 1 ms, steps: 1}\n",
        "case.yaml"));
  };
  // Two cells in the core and two beside it.
  const std::string few = "cells_around: 8, cells_radial: 1, cells_along: 12";
  const auto coarse = load(few, "linear");
  expect_one(coarse.warnings, "fewer elements across than the 10 that flow needs: l");
  expect_one(coarse.warnings, "`elements: quadratic`, which need 4, or more `cells_around` and `cells_radial`");
  ASSERT_EQ(coarse.across.size(), 3u);
  for (const auto& part : coarse.across) EXPECT_NEAR(part.median, 4, 0.8) << part.name;
  const std::string more = "cells_around: 8, cells_radial: 3, cells_along: 12";
  expect_one(load(more, "linear").warnings, "than the 10 that flow needs");
  EXPECT_TRUE(load(more, "quadratic").warnings.empty());
}

TEST(Plausible, VelocityOutOfAnInlet) {
  EXPECT_TRUE(warnings("5 mm", "{velocity: {value: \"[0, 0, 1] m/s\"}}").empty());
  expect_one(warnings("5 mm", "{velocity: {value: \"[0, 0, -1] m/s\"}}"), "ml/s out of the vessel on average");
}

TEST(Plausible, SizeOfTheMesh) {
  // Elements of so flat a tube are warned of besides; the flow in it is not.
  int of_size = 0;
  for (const auto& warning : warnings("20 cm", "{flow: 5 ml/s}")) {
    of_size += warning.starts_with("meshes: the lumen holds 3.");
    EXPECT_EQ(warning.find("boundary"), std::string::npos) << warning;
  }
  EXPECT_EQ(of_size, 1);
}

TEST(Plausible, ArraysOfSupports) {
  case_file::Case c;
  bc::Support support;
  support.stiffness = bc::FaceArray{"k", 1e9};
  c.boundary = {{"outer", support}};
  mesh::MeshData data;
  data.faces = {{"outer", 0, {}}};
  data.node_fields = {{mesh::face_array_name("outer", "k"), {std::nan(""), 0, 100}}};
  EXPECT_TRUE(implausible_on_faces(c, data).empty());
  data.node_fields[0].values[2] = 1e5;
  ASSERT_EQ(implausible_on_faces(c, data).size(), 1u);
  EXPECT_EQ(implausible_on_faces(c, data)[0].where, "boundary.outer.support.stiffness");
}

TEST(Plausible, TunedOutlets) {
  const test::SharedFolder folder(MPI_COMM_SELF);
  const auto file = folder.path() / "outlets.yaml";
  const case_file::Case c = case_file::parse_case(
      "analysis: flow\nmeshes: {tube: {radius: 5 mm, length: 3 cm}}\nfluid: {}\n"
      "boundary: {lumen_inlet: {flow: 50 ml/s}, lumen_wall: no_slip}\n"
      "outlets: {systolic: 120 mmHg, diastolic: 80 mmHg, fractions: {lumen_outlet: 1}, output: " +
          file.parent_path().string() + "}\ntime: {step: 1 ms, steps: 1}\n",
      "case.yaml");
  EXPECT_TRUE(unusual_outlets(c).empty());  // there are none yet
  const auto found = [&](double proximal, double capacitance, double distal) {
    write_outlets(file, *c.outlets, {{"lumen_outlet", bc::Rcr{proximal, capacitance, distal, 0, {}}}});
    return unusual_outlets(c);
  };
  EXPECT_TRUE(found(1e7, 1e-8, 1.5e8).empty());
  ASSERT_EQ(found(1e7, 1e-8, 1.5e13).size(), 1u);
  EXPECT_NE(found(1e7, 1e-8, 1.5e13)[0].what.find("is unusual"), std::string::npos);
  ASSERT_EQ(found(1e7, 1e-11, 1e11).size(), 1u);
  EXPECT_NE(found(1e7, 1e-11, 1e11)[0].what.find("needs a mean pressure"), std::string::npos);
}

}  // namespace
}  // namespace tunica::artifacts
