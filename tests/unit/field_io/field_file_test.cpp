#include "tunica/field_io/field_file.hpp"

#include <gtest/gtest.h>

#include "temporary_folder.hpp"
#include "tunica/base/error.hpp"
#include "tunica/field_io/array_name.hpp"
#include "tunica/field_io/series_index.hpp"
#include "tunica/files/atomic_file.hpp"

namespace tunica::field_io {
namespace {

namespace fs = std::filesystem;
using test::message_of;
using test::TemporaryFolder;

/// A strip of tetrahedra: enough numbers to be packed in several pieces.
RegionMesh strip(int nodes) {
  RegionMesh mesh;
  for (int n = 0; n < nodes; ++n) {
    for (const float x : {0.1F * static_cast<float>(n), 1.0F * static_cast<float>(n % 2), 0.5F})
      mesh.points.push_back(x);
    mesh.node_ids.push_back(10 + n);
  }
  for (int c = 0; c + 3 < nodes; ++c) {
    for (int a = 0; a < 4; ++a) mesh.cells.push_back(c + a);
    mesh.element_ids.push_back(std::int64_t{1} << 40 | c);
  }
  return mesh;
}

Instant fields(const RegionMesh& mesh) {
  Instant instant{0.25, {{"velocity [m s^-1]", 3, {}}, {"pressure [mmHg]", 1, {}}}, {{"stress [kPa]", 1, {}}}};
  for (std::size_t n = 0; n < mesh.nodes(); ++n) {
    for (int c = 0; c < 3; ++c)
      instant.points[0].values.push_back(static_cast<float>(n) + 0.25F * static_cast<float>(c));
    instant.points[1].values.push_back(100 + 1e-3F * static_cast<float>(n));
  }
  for (std::size_t e = 0; e < mesh.elements(); ++e) instant.cells[0].values.push_back(-static_cast<float>(e));
  return instant;
}

class FieldFileTest : public ::testing::Test {
 protected:
  void write(int nodes) {
    mesh_ = strip(nodes);
    instant_ = fields(mesh_);
    files::write_atomically(folder_.path() / "lumen_mesh.hdf", mesh_bytes(mesh_));
    files::write_atomically(file_, instant_bytes(instant_, "lumen_mesh.hdf"));
  }
  std::string refusal() const {
    return message_of<InputError>([&] {
      const FieldFile file(file_);
      file.read_mesh();
      file.read_points("velocity [m s^-1]");
      file.read_points("pressure [mmHg]");
      file.read_cells("stress [kPa]");
    });
  }
  TemporaryFolder folder_;
  fs::path file_ = folder_.path() / "lumen_000001.hdf";
  RegionMesh mesh_;
  Instant instant_;
};

TEST_F(FieldFileTest, NumbersComeBackAsTheyAre) {
  for (const int nodes : {4, 100, 70000}) {
    write(nodes);
    const FieldFile file(file_);
    EXPECT_EQ(file.time(), 0.25);
    EXPECT_EQ(file.point_arrays(), (std::vector<ArrayHead>{{"pressure [mmHg]", 1}, {"velocity [m s^-1]", 3}}));
    EXPECT_EQ(file.cell_arrays(), (std::vector<ArrayHead>{{"stress [kPa]", 1}}));
    EXPECT_EQ(file.read_points("velocity [m s^-1]"), instant_.points[0].values);
    EXPECT_EQ(file.read_points("pressure [mmHg]"), instant_.points[1].values);
    EXPECT_EQ(file.read_cells("stress [kPa]"), instant_.cells[0].values);
    EXPECT_EQ(file.read_mesh().points, mesh_.points);
    EXPECT_EQ(file.read_mesh().cells, mesh_.cells);
    const RegionMesh own = FieldFile(folder_.path() / "lumen_mesh.hdf").read_mesh();
    EXPECT_EQ(own.node_ids, mesh_.node_ids);
    EXPECT_EQ(own.element_ids, mesh_.element_ids);
  }
}

TEST_F(FieldFileTest, TheMeshIsNotInTheFileOfAnInstant) {
  write(20000);
  EXPECT_LT(fs::file_size(file_), 4 * 5 * 20000u);  // five floats a node as they are; its mesh alone would be more
  fs::remove(folder_.path() / "lumen_mesh.hdf");
  EXPECT_NO_THROW(FieldFile(file_).read_points("pressure [mmHg]"));
  EXPECT_NE(refusal().find("`NumberOfPoints` cannot be read"), std::string::npos) << refusal();
}

TEST_F(FieldFileTest, TheSameFieldsMakeTheSameBytes) {
  write(1000);
  EXPECT_EQ(instant_bytes(instant_, "lumen_mesh.hdf"), test::slurp(file_));
  EXPECT_EQ(mesh_bytes(mesh_), test::slurp(folder_.path() / "lumen_mesh.hdf"));
}

TEST_F(FieldFileTest, WhatIsCutOffOrIsNoSuchFileIsRefused) {
  EXPECT_NE(refusal().find("is missing"), std::string::npos);
  write(5000);
  const std::string whole = test::slurp(file_);
  for (const double part : {0.0, 0.001, 0.1, 0.5, 0.9, 0.999}) {
    const auto size = static_cast<std::size_t>(part * static_cast<double>(whole.size()));
    std::ofstream(file_, std::ios::binary) << whole.substr(0, size);
    EXPECT_NE(refusal().find("lumen_000001.hdf"), std::string::npos) << part;
    EXPECT_NE(refusal().find("run the case again"), std::string::npos) << part;
  }
  std::ofstream(file_, std::ios::binary) << "<VTKFile/>                            ";
  EXPECT_NE(refusal().find("is no file of results"), std::string::npos);
}

// Packed numbers have a checksum. Heads of HDF5 have none, and half of so small a file is space that nothing reads.
TEST_F(FieldFileTest, NoDamageEndsTheProgram) {
  write(3000);
  const std::string whole = test::slurp(file_);
  int refused = 0, altered = 0;
  for (std::size_t at = 0; at < whole.size(); at += 97) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x5a);
    std::ofstream(file_, std::ios::binary) << damaged;
    try {
      const FieldFile file(file_);
      for (const auto& array : file.point_arrays()) {
        const auto values = file.read_points(array.name);
        altered += array.name[0] == 'v' && values.size() == instant_.points[0].values.size() &&
                   values != instant_.points[0].values;
      }
      for (const auto& array : file.cell_arrays()) file.read_cells(array.name);
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 40);
  EXPECT_EQ(altered, 0);
}

TEST_F(FieldFileTest, CellsWithNodesThatAreNotThereAreRefused) {
  write(100);
  mesh_.cells[7] = 100;
  files::write_atomically(folder_.path() / "lumen_mesh.hdf", mesh_bytes(mesh_));
  EXPECT_NE(refusal().find("a cell names node 100, but there are nodes 0 to 99"), std::string::npos) << refusal();
  mesh_.cells.pop_back();
  files::write_atomically(folder_.path() / "lumen_mesh.hdf", mesh_bytes(mesh_));
  EXPECT_NE(refusal(), "");
}

TEST(ArrayName, UnitsHaveNoSlash) {
  EXPECT_EQ(array_name("velocity", "m/s"), "velocity [m s^-1]");
  EXPECT_EQ(array_name("pressure", "dyn/cm^2"), "pressure [dyn cm^-2]");
  EXPECT_EQ(array_name("x", "kg/m/s^2"), "x [kg m^-1 s^-2]");
  EXPECT_EQ(array_name("x", "m / s^-1"), "x [m  s^1]");
  EXPECT_EQ(array_name("pressure", "mmHg"), "pressure [mmHg]");
  EXPECT_EQ(name_and_unit("velocity [m s^-1]"), (std::pair<std::string, std::string>{"velocity", "m s^-1"}));
  EXPECT_EQ(name_and_unit("region"), (std::pair<std::string, std::string>{"region", ""}));
}

TEST(SeriesIndex, TimesAndNamesSurviveARoundTrip) {
  const TemporaryFolder folder;
  const auto path = series_file(folder.path(), "lumen");
  EXPECT_EQ(path.filename(), "lumen.hdf.series");
  EXPECT_TRUE(read_series(path).empty());
  for (const auto& entries :
       {std::vector<SeriesEntry>{}, {{0.1, "a_1.hdf"}}, {{0.1, "a_1.hdf"}, {1.0 / 3, "a_2.hdf"}}}) {
    files::write_atomically(path, series_text(entries));
    const auto series = read_series(path);
    ASSERT_EQ(series.size(), entries.size());
    for (std::size_t k = 0; k < series.size(); ++k) {
      EXPECT_EQ(series[k].time, entries[k].time);
      EXPECT_EQ(series[k].file, entries[k].file);
    }
  }
  files::write_atomically(path, test::slurp(path).substr(0, 60));
  EXPECT_NE(message_of<InputError>([&] { read_series(path); }).find("is cut off or altered"), std::string::npos);
  files::write_atomically(path, "{\"files\": [{\"name\": \"../a.hdf\", \"time\": 0}]}");
  EXPECT_THROW(read_series(path), InputError);
}

TEST(SeriesIndex, SeriesOfEarlierVersionsAreNamed) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "lumen.pvd") << "<VTKFile/>";
  EXPECT_NE(message_of<InputError>([&] {
              read_series(series_file(folder.path(), "lumen"));
            }).find("lumen.pvd: is a series of an earlier version of tunica"),
            std::string::npos);
}

TEST(SeriesIndex, TheOverviewHasABlockForEachRegionAtEachTime) {
  const std::vector<ArrayHead> velocity{{"velocity [m s^-1]", 3}};
  const RegionIndex lumen{"lumen", 9, 2, 10, {{0, "lumen_000000.hdf", velocity}, {0.5, "b.hdf", velocity}}};
  const RegionIndex wall{"wall", 5, 3, 4, {{0, "wall_000000.hdf", {}, {{"stress [kPa]", 1}}}}};
  const auto text = overview_text({lumen, wall});
  for (const char* part :
       {"<Time Value=\"0.5\"/>", "TopologyType=\"Tetrahedron_10\" NumberOfElements=\"2\"", "Dimensions=\"20\"",
        "lumen_mesh.hdf:/VTKHDF/Connectivity", "Dimensions=\"9 3\">b.hdf:/VTKHDF/PointData/velocity [m s^-1]<",
        "Center=\"Cell\"", "wall_000000.hdf:/VTKHDF/CellData/stress [kPa]"})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
}

}  // namespace
}  // namespace tunica::field_io
