#include "tunica/mesh_io/simvascular.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "temporary_folder.hpp"
#include "text.hpp"
#include "tunica/base/error.hpp"
#include "tunica/mesh/generate.hpp"
#include "tunica/mesh/interface.hpp"
#include "tunica/mesh/lumen_fields.hpp"
#include "tunica/mesh/submesh.hpp"
#include "unit/mesh/check_mesh.hpp"

namespace tunica::mesh_io {

namespace {

using test::message_of;
using test::TemporaryFolder;
using tunica::test::contains;
namespace fs = std::filesystem;

/// How the written files deviate from a sound mesh.
struct Flaws {
  bool face_ids = true;  ///< write GlobalNodeID and GlobalElementID with the faces
  std::int64_t node_id_shift = 0, element_id_shift = 0;
  bool volume_ids = false;        ///< the volume has IDs too, in descending order
  bool turned_elements = false;   ///< all elements with the other node order
  bool turned_triangles = false;  ///< all triangles inward
  double face_shift = 0;          ///< in x, in file units
  std::string left_out{};         ///< a face without file
  bool face_twice = false;        ///< the first triangle of the first face twice
  int cell_type = 10;
  bool nan = false, empty = false, unused_node = false, inverted = false;
};

template <class Values>
std::string array(const std::string& type, const std::string& name, int components, const Values& values) {
  std::string text = fmt::format("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"ascii\">\n",
                                 type, name, components);
  for (const auto& value : values) text += fmt::format("{} ", value);
  return text + "\n</DataArray>\n";
}

std::string point_array(const std::vector<Vec3<double>>& points, double scale, double shift) {
  std::vector<double> x;
  for (const auto& p : points)
    for (int d = 0; d < 3; ++d) x.push_back(p[d] * scale + (d == 0 ? shift : 0));
  return "<Points>\n" + array("Float64", "Points", 3, x) + "</Points>\n";
}

template <std::size_t N>
std::string cell_arrays(const std::vector<std::array<std::int64_t, N>>& cells) {
  std::vector<std::int64_t> connectivity, offsets;
  for (const auto& c : cells) {
    connectivity.insert(connectivity.end(), c.begin(), c.end());
    offsets.push_back(std::ssize(connectivity));
  }
  return array("Int64", "connectivity", 1, connectivity) + array("Int64", "offsets", 1, offsets);
}

void write_volume(const fs::path& path, mesh::MeshData mesh, double scale, const Flaws& flaws) {
  if (flaws.turned_elements)
    for (auto& t : mesh.tetrahedra) std::swap(t[0], t[1]);
  if (flaws.inverted) std::swap(mesh.tetrahedra[5][0], mesh.tetrahedra[5][1]);
  if (flaws.empty) mesh.tetrahedra.clear();
  if (flaws.nan) mesh.points[7][1] = NAN;
  if (flaws.unused_node) mesh.points.push_back({{9, 9, 9}});
  std::vector<std::int64_t> node_ids, element_ids;
  for (std::int64_t n = std::ssize(mesh.points); n > 0; --n) node_ids.push_back(n);
  for (std::int64_t n = std::ssize(mesh.tetrahedra); n > 0; --n) element_ids.push_back(n);
  std::ofstream file(path);
  file << "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\"><UnstructuredGrid>"
       << fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">", mesh.points.size(), mesh.tetrahedra.size());
  if (flaws.volume_ids)
    file << "<PointData>" << array("Int32", "GlobalNodeID", 1, node_ids) << "</PointData><CellData>"
         << array("Int32", "GlobalElementID", 1, element_ids) << "</CellData>";
  file << point_array(mesh.points, scale, 0) << "<Cells>" << cell_arrays(mesh.tetrahedra)
       << array("UInt8", "types", 1, std::vector<int>(mesh.tetrahedra.size(), flaws.cell_type))
       << "</Cells></Piece></UnstructuredGrid></VTKFile>";
}

void write_face(const fs::path& path, const mesh::MeshData& mesh, const mesh::FaceData& face, double scale,
                const Flaws& flaws) {
  std::map<std::int64_t, std::int64_t> local;
  for (const auto& t : face.triangles)
    for (auto n : t) local.emplace(n, 0);
  std::vector<Vec3<double>> points;
  std::vector<std::int64_t> node_ids, element_ids;
  const std::int64_t nodes = std::ssize(mesh.points), elements = std::ssize(mesh.tetrahedra);
  for (auto& [node, number] : local) {
    number = std::ssize(points);
    points.push_back(mesh.points[node]);
    node_ids.push_back((flaws.volume_ids ? nodes - node : node + 1) + flaws.node_id_shift);
  }
  const mesh::Boundary boundary(mesh.tetrahedra, nodes, "test");
  std::vector<std::array<std::int64_t, 3>> triangles;
  for (auto t : face.triangles) {
    const auto element = boundary.triangles()[boundary.find(t)].element;
    element_ids.push_back((flaws.volume_ids ? elements - element : element + 1) + flaws.element_id_shift);
    if (flaws.turned_triangles) std::swap(t[0], t[1]);
    triangles.push_back({local[t[0]], local[t[1]], local[t[2]]});
  }
  if (flaws.face_twice && face.name == mesh.faces[0].name) {
    triangles.push_back(triangles[0]);
    element_ids.push_back(element_ids[0]);
  }
  std::ofstream file(path);
  file << "<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\"><PolyData>"
       << fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfPolys=\"{}\">", points.size(), triangles.size());
  if (flaws.face_ids)
    file << "<PointData>" << array("Int32", "GlobalNodeID", 1, node_ids) << "</PointData><CellData>"
         << array("Int32", "GlobalElementID", 1, element_ids) << "</CellData>";
  file << point_array(points, scale, flaws.face_shift) << "<Polys>" << cell_arrays(triangles)
       << "</Polys></Piece></PolyData></VTKFile>";
}

/// Writes a mesh-complete folder in centimetres.
void write(const fs::path& folder, const mesh::MeshData& mesh, const Flaws& flaws) {
  fs::create_directories(folder / "mesh-surfaces");
  write_volume(folder / "mesh-complete.mesh.vtu", mesh, 100, flaws);
  for (const auto& face : mesh.faces)
    if (face.name != flaws.left_out)
      write_face(folder / "mesh-surfaces" / (face.name + ".vtp"), mesh, face, 100, flaws);
}

const mesh::MeshData& block() {
  static const mesh::MeshData mesh = mesh::box(3, 2, 2, {{0.03, 0.02, 0.02}}, mesh::RegionKind::lumen);
  return mesh;
}

mesh::LoadedMesh read_with(const Flaws& flaws) {
  const TemporaryFolder folder;
  write(folder.path(), block(), flaws);
  return read_simvascular(folder.path(), mesh::RegionKind::lumen, "blood", {.metres_per_unit = 0.01});
}

std::string refusal(const Flaws& flaws) {
  return message_of<InputError>([&] { read_with(flaws); });
}

void expect_same_as_block(const mesh::LoadedMesh& mesh) {
  mesh::testing::expect_sound(mesh.data);
  ASSERT_EQ(mesh.data.points.size(), block().points.size());
  for (std::size_t n = 0; n < block().points.size(); ++n)
    EXPECT_LT(norm(mesh.data.points[n] - block().points[n]), 1e-15);
  ASSERT_EQ(mesh.data.regions.size(), 1u);
  EXPECT_EQ(mesh.data.regions[0].name, "blood");
  ASSERT_EQ(mesh.data.faces.size(), 6u);
  for (const auto& f : block().faces)
    EXPECT_EQ(mesh::testing::face(mesh.data, f.name).triangles.size(), f.triangles.size());
  EXPECT_NEAR(mesh::testing::area(mesh.data, "x_max"), 4e-4, 1e-15);
}

}  // namespace

TEST(SimVascular, UsesRightIds) {
  for (bool volume_ids : {false, true}) {
    const auto mesh = read_with({.volume_ids = volume_ids});
    expect_same_as_block(mesh);
    ASSERT_EQ(mesh.report.size(), 7u);
    EXPECT_TRUE(contains(mesh.report[1],
                         "face x_max: 8 triangles; nodes by GlobalNodeID, all 9 right; "
                         "GlobalElementID right for 8 of 8"))
        << mesh.report[1];
  }
}

TEST(SimVascular, FallsBackToCoordinatesWhenIdsAreWrongOrAbsent) {
  const auto shifted = read_with({.node_id_shift = 1, .element_id_shift = -1});
  expect_same_as_block(shifted);
  EXPECT_TRUE(contains(shifted.report[1], "nodes by coordinates, since GlobalNodeID is right for 0 of 9 only"))
      << shifted.report[1];
  EXPECT_TRUE(contains(shifted.report[1], "one too low for 8")) << shifted.report[1];
  const auto absent = read_with({.face_ids = false});
  expect_same_as_block(absent);
  EXPECT_TRUE(contains(absent.report[1], "there is no GlobalNodeID; no GlobalElementID")) << absent.report[1];
  expect_same_as_block(read_with({.node_id_shift = 100000}));
}

TEST(MeshFiles, HaveNamesOfTheirOwnAndARest) {
  const TemporaryFolder folder;
  write(folder.path(), block(), {});
  MeshFiles files{folder.path() / "mesh-complete.mesh.vtu", {}, {}};
  for (const char* face : {"x_max", "y_min"})
    files.faces.emplace_back("my_" + std::string(face), folder.path() / "mesh-surfaces" / (std::string(face) + ".vtp"));
  const auto read = [&] {
    return read_mesh_files(files, mesh::RegionKind::lumen, "blood", {.metres_per_unit = 0.01}).data;
  };
  EXPECT_TRUE(contains(message_of<InputError>(read), "boundary triangles lie in no named face"));
  files.rest = "rest";
  const auto data = read();
  ASSERT_EQ(data.faces.size(), 3u);
  EXPECT_EQ(mesh::testing::face(data, "my_x_max").triangles.size(), 8u);
  EXPECT_EQ(mesh::testing::face(data, "rest").triangles.size(), 64u - 8u - 12u);
}

TEST(MeshFiles, TakeArraysFromOtherFiles) {
  auto data = mesh::box(3, 2, 2, {{0.03, 0.02, 0.02}}, mesh::RegionKind::wall);
  const TemporaryFolder folder;
  write_simvascular(folder.path() / "plain", data, mesh::RegionKind::wall, 0.01);
  mesh::ElementField fibres{"FIB_DIR", 3, {}}, domains{"DOMAIN_ID", 1, {}};
  for (std::size_t e = 0; e < data.tetrahedra.size(); ++e) {
    fibres.values.insert(fibres.values.end(), {1.0 * static_cast<double>(e), 2, 3});
    domains.values.push_back(e < 30 ? 1 : 2);
  }
  data.fields = {fibres, domains};
  write_simvascular(folder.path() / "other", data, mesh::RegionKind::wall, 0.01);
  const auto other = folder.path() / "other/mesh-complete.mesh.vtu";
  SimVascularOptions options{.metres_per_unit = 0.01, .fields = {"fibre_1"}};
  options.regions = NamedRegions{"region_id", {{1, "one"}, {2, "two"}}};
  options.other_files = {{"fibre_1", other, "FIB_DIR"}, {"region_id", other, "DOMAIN_ID"}};
  const auto read = read_simvascular(folder.path() / "plain", mesh::RegionKind::wall, "wall", options).data;
  ASSERT_EQ(read.regions.size(), 2u);
  EXPECT_EQ(read.regions[1].first_element, 30);
  ASSERT_EQ(read.fields.size(), 1u);
  EXPECT_EQ(read.fields[0].name, "fibre_1");
  EXPECT_EQ(read.fields[0].values, fibres.values);

  const auto small = mesh::box(2, 2, 2, {{0.03, 0.02, 0.02}}, mesh::RegionKind::wall);
  write_simvascular(folder.path() / "small", small, mesh::RegionKind::wall, 0.01);
  EXPECT_TRUE(contains(message_of<InputError>(
                           [&] { read_simvascular(folder.path() / "small", mesh::RegionKind::wall, "wall", options); }),
                       "has 72 cells, the volume 48"));
}

TEST(MeshFiles, TakeFaceArraysFromOtherFiles) {
  const TemporaryFolder folder;
  write(folder.path(), block(), {});
  const auto surface = folder.path() / "mesh-surfaces/x_max.vtp", other = folder.path() / "support.vtp";
  auto text = test::slurp(surface);
  text.insert(text.find("<PointData>") + 11, array("Float64", "Stiffness", 1, std::vector<double>(9, 7.5)));
  std::ofstream(other) << text;
  SimVascularOptions options{.metres_per_unit = 0.01};
  options.other_face_files["x_max"] = {{"k", other, "Stiffness"}};
  const auto read = read_simvascular(folder.path(), mesh::RegionKind::wall, "wall", options).data;
  ASSERT_EQ(read.node_fields.size(), 1u);
  EXPECT_EQ(read.node_fields[0].name, mesh::face_array_name("x_max", "k"));
  EXPECT_EQ(std::count(read.node_fields[0].values.begin(), read.node_fields[0].values.end(), 7.5), 9);
}

TEST(SimVascular, TurnsTrianglesOutwardAndElementsPositive) {
  expect_same_as_block(read_with({.turned_triangles = true}));
  const auto turned = read_with({.turned_elements = true});
  expect_same_as_block(turned);
  EXPECT_TRUE(contains(turned.report[1], "all 72 elements have the opposite node order")) << turned.report[1];
}

TEST(SimVascular, ToleratesSmallOffsetsOfFaceNodes) {
  expect_same_as_block(read_with({.face_shift = 1e-5}));
  EXPECT_TRUE(contains(refusal({.face_shift = 0.01}), "are no boundary nodes of the volume mesh"));
}

TEST(SimVascular, RefusesBadMeshes) {
  EXPECT_TRUE(contains(refusal({.left_out = "y_min"}), "12 of 64 boundary triangles lie in no named face"))
      << refusal({.left_out = "y_min"});
  EXPECT_TRUE(contains(refusal({.face_twice = true}), "1 triangles already belong to face"));
  EXPECT_TRUE(contains(refusal({.cell_type = 9}), "72 of 72 cells are not linear tetrahedra (VTK cell type 9)"));
  EXPECT_TRUE(contains(refusal({.nan = true}), "coordinates that are not finite; the first is node 8"));
  EXPECT_TRUE(contains(refusal({.empty = true}), "holds no cells"));
  EXPECT_TRUE(contains(refusal({.unused_node = true}), "1 of 37 nodes belong to no tetrahedron"));
  EXPECT_TRUE(contains(refusal({.inverted = true}), "1 of 72 elements are inverted or flat"));
}

TEST(SimVascular, RefusesNamesOfFacesThatServeNowhereElse) {
  for (const auto& [name, part] : {std::pair{"out*", "'out*' of a face has the character '*'"},
                                   {"M\xFCller", "'M\\xfcller' of a face is not UTF-8"},
                                   {"X_MAX", "the name 'x_max' differs from 'X_MAX'"},
                                   {"a,b", "has the character ','"}}) {
    const TemporaryFolder folder;
    write(folder.path(), block(), {});
    const auto surfaces = folder.path() / "mesh-surfaces";
    fs::copy_file(surfaces / "x_max.vtp", surfaces / (std::string(name) + ".vtp"));
    const auto why = message_of<InputError>(
        [&] { read_simvascular(folder.path(), mesh::RegionKind::lumen, "x", {.metres_per_unit = 0.01}); });
    EXPECT_TRUE(contains(why, part)) << why;
  }
}

TEST(SimVascular, RefusesMissingAndDamagedFiles) {
  const TemporaryFolder folder;
  const auto read = [&] { read_simvascular(folder.path(), mesh::RegionKind::lumen, "x", {.metres_per_unit = 1}); };
  EXPECT_TRUE(contains(message_of<InputError>(read), "mesh-surfaces"));
  write(folder.path(), block(), {});
  const auto volume = folder.path() / "mesh-complete.mesh.vtu";
  fs::resize_file(volume, fs::file_size(volume) / 2);
  EXPECT_TRUE(contains(message_of<InputError>(read), "mesh-complete.mesh.vtu:")) << message_of<InputError>(read);
  EXPECT_TRUE(contains(message_of<InputError>(read), "cannot be read: the file ends before </DataArray>"))
      << message_of<InputError>(read);
  fs::remove(volume);
  EXPECT_TRUE(contains(message_of<InputError>(read), "there is no such file"));
  EXPECT_THROW(read_simvascular(folder.path(), mesh::RegionKind::lumen, "x", {.metres_per_unit = 0}), InputError);
}

TEST(SimVascular, WritesElementFieldsThatReadBackToTheSameBits) {
  auto data =
      mesh::tube({.radius = 0.01, .length = 0.02, .wall_thickness = 0.002, .cells_around = 8, .cells_along = 2});
  mesh::ElementField field{"e1", 3, {}};
  for (std::size_t i = 0; i < 3 * data.tetrahedra.size(); ++i)
    field.values.push_back(std::sin(static_cast<double>(i) + 1.0 / 3));
  data.fields = {field};
  const TemporaryFolder folder;
  write_simvascular(folder.path(), data, mesh::RegionKind::wall, 1e-3);
  const auto read =
      read_simvascular(folder.path(), mesh::RegionKind::wall, "wall", {.metres_per_unit = 1e-3, .fields = {"e1"}});
  ASSERT_EQ(read.data.fields.size(), 1u);
  const auto first = field.values.begin() + 3 * data.regions[1].first_element;
  EXPECT_EQ(read.data.fields[0].values, std::vector(first, field.values.end()));
}

TEST(SimVascular, KeepsTheSideOfTheNodesOfALumen) {
  auto data =
      mesh::tube({.radius = 0.01, .length = 0.02, .wall_thickness = 0.002, .cells_around = 8, .cells_along = 2});
  std::vector<double> side(data.points.size(), std::nan(""));
  const auto& lumen = data.regions[0];
  for (auto e = lumen.first_element; e < lumen.end_element; ++e)
    for (const auto n : data.tetrahedra[static_cast<std::size_t>(e)])
      side[static_cast<std::size_t>(n)] = data.points[static_cast<std::size_t>(n)][2] - 0.01 / 3;
  data.node_fields = {{mesh::lumen_side, side}, {"wall_outer.k", side}};
  const TemporaryFolder folder;
  const auto read = [&](mesh::RegionKind kind) {
    write_simvascular(folder.path(), data, kind, 1e-3);
    return read_simvascular(folder.path(), kind, "part", {.metres_per_unit = 1e-3}).data;
  };
  const auto blood = read(mesh::RegionKind::lumen);
  ASSERT_EQ(blood.node_fields.size(), 1u);
  EXPECT_EQ(blood.node_fields[0].name, mesh::lumen_side);
  for (std::size_t n = 0; n < blood.points.size(); ++n)
    EXPECT_NEAR(blood.node_fields[0].values[n], blood.points[n][2] - 0.01 / 3, 1e-12);
  EXPECT_TRUE(read(mesh::RegionKind::wall).node_fields.empty());
}

// svMultiPhysics takes other types of integers for absent.
TEST(SimVascular, WritesIdsAsInt32) {
  const TemporaryFolder folder;
  write_simvascular(folder.path(), block(), mesh::RegionKind::lumen, 0.01);
  for (const char* file : {"mesh-complete.mesh.vtu", "mesh-complete.exterior.vtp", "mesh-surfaces/x_max.vtp"}) {
    const auto text = test::slurp(folder.path() / file);
    for (const std::string name : {"GlobalNodeID", "GlobalElementID"})
      EXPECT_TRUE(contains(text, "<DataArray type=\"Int32\" Name=\"" + name + "\"")) << file << " " << name;
  }
  EXPECT_TRUE(contains(test::slurp(folder.path() / "mesh-surfaces/x_max.vtp"), "type=\"Int32\" Name=\"ModelFaceID\""));
  const auto read = read_simvascular(folder.path(), mesh::RegionKind::lumen, "blood", {.metres_per_unit = 0.01});
  EXPECT_TRUE(contains(read.report[1], "all 9 right; GlobalElementID right for 8 of 8")) << read.report[1];
}

TEST(SimVascular, IgnoresHiddenFilesAndTheCaseOfExtensions) {
  const TemporaryFolder folder;
  write(folder.path(), block(), {});
  const auto surfaces = folder.path() / "mesh-surfaces";
  std::ofstream(surfaces / "._x_max.vtp", std::ios::binary) << std::string("\0\5\26\7", 4);
  fs::rename(surfaces / "x_max.vtp", surfaces / "x_max.VTP");
  fs::rename(folder.path() / "mesh-complete.mesh.vtu", folder.path() / "mesh-complete.mesh.VTU");
  const auto read = [&] {
    return read_simvascular(folder.path(), mesh::RegionKind::lumen, "blood", {.metres_per_unit = 0.01});
  };
  const auto mesh = read();
  EXPECT_EQ(mesh::testing::face(mesh.data, "x_max").triangles.size(), 8u);
  EXPECT_TRUE(contains(mesh.report[1], "._x_max.vtp: hidden file, ignored")) << mesh.report[1];
  fs::copy(surfaces / "x_max.VTP", surfaces / "x_max.vtp");
  EXPECT_TRUE(contains(message_of<InputError>(read), "has the name of another face, x_max.VTP"));
  for (const auto& face : block().faces) fs::remove(surfaces / (face.name + ".vtp"));
  fs::remove(surfaces / "x_max.VTP");
  EXPECT_TRUE(contains(message_of<InputError>(read), "holds no .vtp file but hidden ones"));
}

TEST(SimVascular, SaysThatNodesCoincideWhereAMeshIsInTwoParts) {
  auto halves = mesh::box(2, 1, 1, {{0.02, 0.01, 0.01}}, mesh::RegionKind::lumen);
  // The elements beyond the middle get nodes of their own there.
  std::map<std::int64_t, std::int64_t> copies;
  for (auto& t : halves.tetrahedra) {
    if (mesh::centroid(halves.points, t)[0] < 0.01) continue;
    for (auto& n : t) {
      if (std::abs(halves.points[n][0] - 0.01) > 1e-9) continue;
      const auto [copy, added] = copies.emplace(n, std::ssize(halves.points));
      if (added) halves.points.push_back(Vec3<double>(halves.points[n]));
      n = copy->second;
    }
  }
  ASSERT_EQ(copies.size(), 4u);
  const TemporaryFolder folder;
  fs::create_directories(folder.path() / "mesh-surfaces");
  write_volume(folder.path() / "mesh-complete.mesh.vtu", halves, 100, {});
  const auto whole = mesh::box(2, 1, 1, {{0.02, 0.01, 0.01}}, mesh::RegionKind::lumen);
  for (const auto& face : whole.faces)
    write_face(folder.path() / "mesh-surfaces" / (face.name + ".vtp"), whole, face, 100, {.face_ids = false});
  const auto why = message_of<InputError>(
      [&] { read_simvascular(folder.path(), mesh::RegionKind::lumen, "blood", {.metres_per_unit = 0.01}); });
  EXPECT_TRUE(contains(why, "coincide with another node")) << why;
  EXPECT_TRUE(contains(why, "merge the duplicate nodes")) << why;
}

TEST(SimVascular, SaysWhenTheLengthUnitMustBeWrong) {
  const TemporaryFolder folder;
  write(folder.path(), block(), {});
  for (const double unit : {1e-5, 1e2})
    EXPECT_TRUE(contains(message_of<InputError>([&] {
                           read_simvascular(folder.path(), mesh::RegionKind::lumen, "x", {.metres_per_unit = unit});
                         }),
                         "correct length_unit, it may be cm (41.23 mm)"))
        << unit;
}

TEST(SimVascular, RefusesRegionNumbersThatAreNone) {
  auto data = mesh::box(1, 1, 1, {{0.01, 0.01, 0.01}}, mesh::RegionKind::wall);
  for (const double number : {0.5, 1e300, -3e9}) {
    data.fields = {{"part", 1, std::vector<double>(data.tetrahedra.size(), number)}};
    const TemporaryFolder folder;
    write_simvascular(folder.path(), data, mesh::RegionKind::wall, 1e-2);
    SimVascularOptions options{.metres_per_unit = 1e-2};
    options.regions = {"part", {{1, "media"}}};
    EXPECT_TRUE(
        contains(message_of<InputError>([&] { read_simvascular(folder.path(), mesh::RegionKind::wall, "x", options); }),
                 "no number of a region"))
        << number;
  }
}

// The same surface in two files, one with coarser coordinates: join() must find the pairs of the original tube.
TEST(SimVascular, LumenAndWallFoldersJoin) {
  const auto whole = mesh::tube({.radius = 0.01,
                                 .length = 0.02,
                                 .wall_thickness = 0.002,
                                 .cells_around = 8,
                                 .cells_radial = 1,
                                 .cells_along = 2,
                                 .cells_through_wall = 1});
  std::vector<mesh::LoadedMesh> parts;
  for (const auto& region : whole.regions) {
    const auto part = mesh::submesh(whole, region.kind).data;
    const TemporaryFolder folder;
    write(folder.path(), part, {});
    parts.push_back(read_simvascular(folder.path(), region.kind, region.name, {.metres_per_unit = 0.01}));
  }
  const mesh::Interface interface[] = {{{"lumen_wall"}, {"wall_inner"}}};
  const auto joined = mesh::join(parts, interface, {});
  mesh::testing::expect_sound(joined.data);
  auto expected = whole.twins;
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(joined.data.twins, expected);
}

// Node numbers serve as values that the test knows.
TEST(SimVascular, KeepsPointArraysOfFaces) {
  const TemporaryFolder folder;
  write(folder.path(), block(), {});
  SimVascularOptions options{.metres_per_unit = 0.01};
  options.face_arrays = {{"x_min", {"GlobalNodeID"}}};
  const auto data = read_simvascular(folder.path(), mesh::RegionKind::lumen, "lumen", options).data;
  ASSERT_EQ(data.node_fields.size(), 1u);
  EXPECT_EQ(data.node_fields[0].name, "x_min.GlobalNodeID");
  for (std::size_t n = 0; n < data.points.size(); ++n) {
    const double value = data.node_fields[0].values[n];
    if (data.points[n][0] < 1e-9)
      EXPECT_EQ(value, static_cast<double>(n + 1));
    else
      EXPECT_TRUE(std::isnan(value)) << n;
  }
  options.face_arrays = {{"x_min", {"stiffness"}}};
  const auto refused =
      message_of<InputError>([&] { read_simvascular(folder.path(), mesh::RegionKind::lumen, "lumen", options); });
  EXPECT_NE(refused.find("no numeric point array called stiffness"), std::string::npos) << refused;
}

}  // namespace tunica::mesh_io
