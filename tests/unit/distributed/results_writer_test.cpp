#include "tunica/distributed/results_writer.hpp"

#include <fmt/format.h>

#include <map>
#include <set>

#include "temporary_folder.hpp"
#include "tunica/base/error.hpp"
#include "tunica/field_io/series_index.hpp"
#include "tunica/mesh/generate.hpp"
#include "tunica/parallel/agree.hpp"
#include "unit/mesh/check_mesh.hpp"

namespace tunica::distributed {

namespace {

namespace fs = std::filesystem;
using test::message_of;

/// A small tube on all ranks, a folder that they share, and fields that are linear in the coordinates.
class ResultsWriterTest : public ::testing::Test {
 protected:
  ResultsWriterTest() {
    if (rank_ == 0) {
      folder_ = std::make_unique<test::TemporaryFolder>();
      directory_ = folder_->path().string();
      data_ = mesh::tube({.radius = 0.01,
                          .length = 0.03,
                          .wall_thickness = 0.002,
                          .cells_around = 8,
                          .cells_radial = 1,
                          .cells_along = 4,
                          .cells_through_wall = 1});
    }
    parallel::broadcast(MPI_COMM_WORLD, directory_);
    mesh_ = distribute(data_, MPI_COMM_WORLD);
    unknowns_.resize(4 * static_cast<std::size_t>(mesh_.nodes()));
    for (std::int32_t n = 0; n < mesh_.nodes(); ++n) {
      for (int d = 0; d < 3; ++d) unknowns_[4 * n + d] = 2 * mesh_.points[n][d];
      unknowns_[4 * n + 3] = 1000 + 5e4 * mesh_.points[n][2];
    }
    for (auto id : mesh_.regions[1].element_ids) ids_.push_back(static_cast<double>(id));
    ids_.resize(mesh_.regions[1].owned_elements);
  }
  ~ResultsWriterTest() override { MPI_Barrier(MPI_COMM_WORLD); }  // before rank 0 removes the folder

  ResultsWriter writer(std::optional<double> continue_from = {}) {
    return {mesh_, {.directory = directory_, .length_factor = 1000, .continue_from = continue_from}};
  }
  void write(ResultsWriter& to, std::int64_t step, double time) {
    const std::span all(unknowns_);
    const NodalArray nodal[] = {
        {.name = "velocity [cm s^-1]", .components = 3, .values = all, .stride = 4, .factor = 100},
        {.name = "pressure [mmHg]", .values = all.subspan(3), .stride = 4, .factor = 1 / 133.322, .region = 0}};
    const CellArray cells[] = {{.name = "element", .region = 1, .values = ids_}};
    to.write(step, time, nodal, cells);
  }
  field_io::FieldFile read(const std::string& file) const { return field_io::FieldFile(fs::path(directory_) / file); }
  std::vector<double> times(const std::string& region) {
    std::vector<double> result;
    for (const auto& e : field_io::read_series(field_io::series_file(directory_, region))) result.push_back(e.time);
    return result;
  }

  int rank_ = parallel::rank(MPI_COMM_WORLD);
  std::unique_ptr<test::TemporaryFolder> folder_;
  std::string directory_;
  mesh::MeshData data_;  // on rank 0
  DistributedMesh mesh_;
  std::vector<double> unknowns_, ids_;
};

TEST_F(ResultsWriterTest, FilesHoldEachElementOnceAndTheFieldsInTheirUnits) {
  auto results = writer();
  write(results, 7, 0.25);
  if (rank_ != 0) return;
  const auto file = read("lumen_000007.hdf");
  EXPECT_EQ(file.time(), 0.25);
  ASSERT_EQ(file.point_arrays(), (std::vector<field_io::ArrayHead>{{"pressure [mmHg]", 1}, {"velocity [cm s^-1]", 3}}));
  EXPECT_TRUE(file.cell_arrays().empty());
  const auto mesh = file.read_mesh();  // in mm
  const auto velocity = file.read_points("velocity [cm s^-1]"), pressure = file.read_points("pressure [mmHg]");
  ASSERT_EQ(pressure.size(), mesh.nodes());
  ASSERT_EQ(velocity.size(), 3 * mesh.nodes());
  for (std::size_t n = 0; n < mesh.nodes(); ++n) {
    for (std::size_t d = 0; d < 3; ++d) EXPECT_NEAR(velocity[3 * n + d], 2 * mesh.points[3 * n + d] / 10, 1e-5);
    EXPECT_NEAR(pressure[n], (1000 + 50 * mesh.points[3 * n + 2]) / 133.322, 1e-4);
  }
  double volume = 0;
  ASSERT_EQ(mesh.nodes_of_cell, 4);
  for (std::size_t c = 0; c < mesh.elements(); ++c) {
    Vec3<double> x[4];
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t d = 0; d < 3; ++d)
        x[a][static_cast<int>(d)] = mesh.points[3 * static_cast<std::size_t>(mesh.cells[4 * c + a]) + d];
    volume += fe::gradients(x).volume;
  }
  EXPECT_NEAR(volume, 4 * std::sqrt(2.0) / 2 * 100 * 2 * 30 / 2, 1);  // octagon of radius 10 mm times 30 mm
}

TEST_F(ResultsWriterTest, TheOrderIsThatOfTheMeshWhateverNumberOfRanks) {
  auto results = writer();
  write(results, 0, 0);
  if (rank_ != 0) return;
  const auto mesh = read("wall_000000.hdf").read_mesh();
  EXPECT_TRUE(mesh.node_ids.empty());  // they stand in the file of the mesh
  const auto own = read("wall_mesh.hdf").read_mesh();
  EXPECT_EQ(own.cells, mesh.cells);
  for (std::size_t n = 0; n < own.nodes(); ++n) {
    const auto& x = data_.points[static_cast<std::size_t>(own.node_ids[n])];
    for (int d = 0; d < 3; ++d)
      EXPECT_EQ(own.points[3 * n + static_cast<std::size_t>(d)], static_cast<float>((1000.0 * x)[d]));
  }
  const auto& region = data_.regions[1];
  ASSERT_EQ(std::ssize(own.element_ids), region.end_element - region.first_element);
  for (std::size_t e = 0; e < own.elements(); ++e) {
    ASSERT_EQ(own.element_ids[e], region.first_element + static_cast<std::int64_t>(e));
    for (std::size_t a = 0; a < 4; ++a)
      EXPECT_EQ(own.node_ids[static_cast<std::size_t>(own.cells[4 * e + a])],
                data_.tetrahedra[static_cast<std::size_t>(own.element_ids[e])][a]);
  }
}

TEST_F(ResultsWriterTest, CellArraysAndRegionsAreKeptApart) {
  auto results = writer();
  write(results, 0, 0);
  if (rank_ != 0) return;
  const auto wall = read("wall_000000.hdf");
  ASSERT_EQ(wall.cell_arrays(), (std::vector<field_io::ArrayHead>{{"element", 1}}));
  ASSERT_EQ(wall.point_arrays(), (std::vector<field_io::ArrayHead>{{"velocity [cm s^-1]", 3}}));
  const auto ids = wall.read_cells("element");
  ASSERT_EQ(ids.size(), 8u * 4 * 6);
  for (std::size_t e = 0; e < ids.size(); ++e)
    EXPECT_EQ(ids[e], static_cast<float>(data_.regions[1].first_element + static_cast<std::int64_t>(e)));
}

TEST_F(ResultsWriterTest, TheOverviewNamesWhatThereIs) {
  auto results = writer();
  write(results, 0, 0);
  write(results, 1, 3 * 0.1);
  if (rank_ != 0) return;
  EXPECT_EQ(times("lumen"), (std::vector<double>{0, 0.3}));  // and not 0.30000000000000004
  const auto text = test::slurp(fs::path(directory_) / "results.xdmf");
  EXPECT_NE(text.find("<Time Value=\"0.3\"/>"), std::string::npos) << text;
  std::set<std::string> named;
  for (auto at = text.find(":/VTKHDF/"); at != std::string::npos; at = text.find(":/VTKHDF/", at + 1)) {
    const auto begin = text.rfind('>', at) + 1;
    named.insert(text.substr(begin, at - begin));
  }
  EXPECT_EQ(named, (std::set<std::string>{"lumen_000000.hdf", "lumen_000001.hdf", "lumen_mesh.hdf", "wall_000000.hdf",
                                          "wall_000001.hdf", "wall_mesh.hdf"}));
  for (const auto& file : named) EXPECT_TRUE(fs::exists(fs::path(directory_) / file)) << file;
}

TEST_F(ResultsWriterTest, EarlierInstantsKeepTheirMesh) {
  {
    auto results = writer();
    write(results, 0, 0);
  }
  const auto of_another_unit = [&] {
    ResultsWriter(mesh_, {.directory = directory_, .length_factor = 100, .continue_from = 0.0});
  };
  EXPECT_NE(message_of<InputError>(of_another_unit).find("is not the mesh that the run goes on with"),
            std::string::npos);
}

TEST_F(ResultsWriterTest, SeriesGrowsAndRestartDropsLaterTimes) {
  {
    auto results = writer();
    for (int step : {0, 10, 20, 30}) write(results, step, 0.1 * step);
  }
  if (rank_ == 0) {
    EXPECT_EQ(times("lumen"), (std::vector<double>{0, 1, 2, 3}));
  }
  MPI_Barrier(MPI_COMM_WORLD);
  {
    auto results = writer(2.0);
    if (rank_ == 0) {
      EXPECT_EQ(times("wall").size(), 4u);
    }  // nothing is lost before the first new step
    MPI_Barrier(MPI_COMM_WORLD);
    write(results, 25, 2.5);
  }
  if (rank_ == 0) {
    EXPECT_EQ(times("lumen"), (std::vector<double>{0, 1, 2, 2.5}));
    EXPECT_EQ(times("wall"), (std::vector<double>{0, 1, 2, 2.5}));
    EXPECT_EQ(field_io::read_series(field_io::series_file(directory_, "wall")).back().file, "wall_000025.hdf");
  }
  MPI_Barrier(MPI_COMM_WORLD);
  auto anew = writer();
  write(anew, 0, 0);
  if (rank_ == 0) {
    EXPECT_EQ(times("lumen"), (std::vector<double>{0}));
    for (const auto& entry : fs::directory_iterator(directory_)) EXPECT_NE(entry.path().extension(), ".part");
  }
}

TEST_F(ResultsWriterTest, FullDiskFailsOnAllRanksAndKeepsTheSeries) {
  auto results = writer();
  write(results, 1, 0.1);
  // The device accepts no byte, like a full disk. Only one rank meets it.
  const auto bad = fs::path(directory_) / "wall_000002.hdf";
  if (rank_ == 0) fs::create_symlink("/dev/full", bad);
  MPI_Barrier(MPI_COMM_WORLD);
  const auto message = message_of<SolverError>([&] { write(results, 2, 0.2); });
  EXPECT_NE(message.find("results of step 2 (t = 0.2 s): cannot write " + bad.string()), std::string::npos) << message;
  if (rank_ == 0) {
    EXPECT_EQ(times("lumen"), (std::vector<double>{0.1}));
  }
  MPI_Barrier(MPI_COMM_WORLD);
  if (rank_ == 0) fs::remove(bad);
  MPI_Barrier(MPI_COMM_WORLD);
  write(results, 2, 0.2);
  if (rank_ == 0) {
    EXPECT_EQ(times("wall"), (std::vector<double>{0.1, 0.2}));
  }
}

TEST_F(ResultsWriterTest, RefusesBadDirectoriesAndSeriesOnAllRanks) {
  const auto file = fs::path(directory_) / "file";
  if (rank_ == 0) std::ofstream(file) << "no directory";
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_NE(message_of<InputError>([&] {
              ResultsWriter(mesh_, {.directory = file / "results"});
            }).find("the folder cannot be made"),
            std::string::npos);
  if (rank_ == 0) std::ofstream(field_io::series_file(directory_, "wall")) << "{\"files\": [{\"name\": \"a\"}]}";
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_NE(message_of<InputError>([&] { writer(1.0); }).find("is not a series of results"), std::string::npos);
  EXPECT_NO_THROW(writer());
}

}  // namespace
}  // namespace tunica::distributed
