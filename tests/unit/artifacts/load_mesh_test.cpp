#include "tunica/artifacts/load_mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "shared_folder.hpp"
#include "tunica/mesh/boundary.hpp"

namespace tunica::artifacts {
namespace {

using test::message_of;

const std::string tube =
    "analysis: fsi\n"
    "meshes:\n"
    "  tube: {radius: 5 mm, length: 2 cm, wall_thickness: 1 mm, cells_around: 8, cells_along: 4}\n"
    "  interface: {lumen: lumen_wall, wall: wall_inner}\n"
    "fluid: {}\n"
    "wall: {density: 1.2 g/cm^3, material: {neo_hooke: {young_modulus: 300 kPa, poisson_ratio: 0.3}}}\n"
    "time: {step: 0.1 ms, steps: 1}\n";
const std::string sound =
    "boundary: {lumen_inlet: {pressure: 1 kPa}, lumen_outlet: {pressure: 0 Pa}, wall_inlet: fixed, wall_outlet: fixed, "
    "wall_outer: free}\n";

case_file::Case tube_case(const std::string& boundary) { return case_file::parse_case(tube + boundary, "case.yaml"); }

TEST(LoadMesh, ReportsRegionsAndTheirQuality) {
  const CheckedMesh mesh = load_mesh(tube_case(sound));
  EXPECT_EQ(mesh.data.regions.size(), 2u);
  EXPECT_EQ(mesh.data.faces.size(), 7u);
  EXPECT_FALSE(mesh.data.twins.empty());
  ASSERT_EQ(mesh.report.size(), 2u);
  EXPECT_TRUE(mesh.report[0].starts_with("lumen: ") && mesh.report[1].starts_with("wall: "));
}

double volume(const mesh::MeshData& data, const std::string& region) {
  double sum = 0;
  for (const auto& r : data.regions)
    for (auto e = r.first_element; e < r.end_element && r.name == region; ++e)
      sum += mesh::volume(data.points, data.tetrahedra[static_cast<std::size_t>(e)]);
  return sum;
}

// With 8, 12 and 16 cells around, 3, 4 and 6 lie across the lumen.
TEST(LoadMesh, ATubeHasTheVolumeOfTheRoundOne) {
  for (const char* cells :
       {"cells_around: 8, cells_radial: 1", "cells_around: 12, cells_radial: 1", "cells_around: 16, cells_radial: 1"}) {
    std::string text = tube + sound;
    text.replace(text.find("cells_around: 8"), 15, cells);
    const auto data = load_mesh(case_file::parse_case(text, "case.yaml")).data;
    EXPECT_NEAR(volume(data, "lumen") / (M_PI * 25e-6 * 0.02), 1, 1e-3) << cells;
    EXPECT_NEAR(volume(data, "wall") / (M_PI * 11e-6 * 0.02), 1, 1e-3) << cells;
  }
}

TEST(LoadMesh, ReportsAllWrongConditionsAtOnce) {
  const std::string message = message_of<InputError>([] {
    load_mesh(
        tube_case("boundary: {lumen_inlt: {pressure: 1 kPa}, lumen_outlet: fixed, wall_inlet: fixed, "
                  "wall_outlet: fixed, wall_outer: free, lumen_wall: no_slip}\n"));
  });
  for (const char* part : {"boundary.lumen_inlet", "did you mean 'lumen_inlet'",
                           "fixed is not a condition for a lumen face", "lumen_wall: the face is an interface"})
    EXPECT_NE(message.find(part), std::string::npos) << part << "\nnot in\n" << message;
}

TEST(LoadMesh, ReportsTheProblemsOfBothMeshes) {
  const test::SharedFolder folder(MPI_COMM_SELF);
  for (const char* name : {"a", "b"}) std::filesystem::create_directories(folder.path() / name);
  case_file::Case c = tube_case(sound);
  c.meshes = {.metres_per_unit = 1.0,
              .lumen = case_file::RegionMesh{folder.path() / "a"},
              .wall = case_file::WallMesh{folder.path() / "b", {}, {}},
              .gmsh = {},
              .tube = {},
              .interface = c.meshes.interface};
  const std::string message = message_of<InputError>([&] { load_mesh(c); });
  EXPECT_NE(message.find((folder.path() / "a").string()), std::string::npos) << message;
  EXPECT_NE(message.find((folder.path() / "b").string()), std::string::npos) << message;
}

TEST(LoadMesh, PairsCoverAllFacesOfBothSides) {
  case_file::MeshSettings m;
  EXPECT_TRUE(interface_pairs(m).empty());
  m.interface = case_file::InterfaceSettings{.lumen_faces = {"l"}, .wall_faces = {"w", "f"}};
  const std::vector<std::pair<std::string, std::string>> expected{{"l", "w"}, {"l", "f"}};
  EXPECT_EQ(interface_pairs(m), expected);
}

TEST(MeshHash, ChangesWithEveryPart) {
  const mesh::MeshData data = load_mesh(tube_case(sound)).data;
  const auto reference = mesh_hash(data);
  EXPECT_EQ(mesh_hash(load_mesh(tube_case(sound)).data), reference);
  const auto changed = [&](auto change) {
    mesh::MeshData copy = data;
    change(copy);
    return mesh_hash(copy);
  };
  EXPECT_NE(changed([](auto& d) { d.points[3][1] += 1e-18; }), reference);
  EXPECT_NE(changed([](auto& d) { std::swap(d.tetrahedra[0][1], d.tetrahedra[0][2]); }), reference);
  EXPECT_NE(changed([](auto& d) { d.faces[1].name = "other"; }), reference);
  EXPECT_NE(changed([](auto& d) { d.faces[1].triangles.pop_back(); }), reference);
  EXPECT_NE(changed([](auto& d) { std::swap(d.twins[0], d.twins[1]); }), reference);
}

}  // namespace
}  // namespace tunica::artifacts
