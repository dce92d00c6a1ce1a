#include "tunica/distributed/results_writer.hpp"

#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPUnstructuredGridReader.h>

#include <map>
#include <set>

#include "temporary_folder.hpp"
#include "tunica/base/error.hpp"
#include "tunica/files/series_file.hpp"
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
    mesh::MeshData data;
    if (rank_ == 0) {
      folder_ = std::make_unique<test::TemporaryFolder>();
      directory_ = folder_->path().string();
      data = mesh::tube({.radius = 0.01,
                         .length = 0.03,
                         .wall_thickness = 0.002,
                         .cells_around = 8,
                         .cells_radial = 1,
                         .cells_along = 4,
                         .cells_through_wall = 1});
    }
    parallel::broadcast(MPI_COMM_WORLD, directory_);
    mesh_ = distribute(data, MPI_COMM_WORLD);
    unknowns_.resize(4 * static_cast<std::size_t>(mesh_.nodes()));
    for (std::int32_t n = 0; n < mesh_.nodes(); ++n) {
      for (int d = 0; d < 3; ++d) unknowns_[4 * n + d] = 2 * mesh_.points[n][d];
      unknowns_[4 * n + 3] = 1000 + 5e4 * mesh_.points[n][2];
    }
    for (auto id : mesh_.regions[1].element_ids) ids_.push_back(static_cast<double>(id));
    ids_.resize(mesh_.regions[1].owned_elements);
  }
  ~ResultsWriterTest() override { MPI_Barrier(MPI_COMM_WORLD); }  // before rank 0 removes the folder

  ResultsWriter writer(std::optional<double> continue_from = {}, bool compress = false) {
    return {mesh_,
            {.directory = directory_, .length_factor = 1000, .compress = compress, .continue_from = continue_from}};
  }
  void write(ResultsWriter& to, std::int64_t step, double time) {
    const std::span all(unknowns_);
    const NodalArray nodal[] = {
        {.name = "velocity [cm/s]", .components = 3, .values = all, .stride = 4, .factor = 100},
        {.name = "pressure [mmHg]", .values = all.subspan(3), .stride = 4, .factor = 1 / 133.322, .region = 0}};
    const CellArray cells[] = {{.name = "element", .region = 1, .values = ids_}};
    to.write(step, time, nodal, cells);
  }
  vtkUnstructuredGrid* read(vtkXMLPUnstructuredGridReader* reader, const std::string& file) {
    reader->SetFileName((fs::path(directory_) / file).c_str());
    reader->Update();
    return reader->GetOutput();
  }
  std::vector<double> times(const std::string& region) {
    std::vector<double> result;
    for (const auto& e : files::read_pvd(fs::path(directory_) / (region + ".pvd"))) result.push_back(e.time);
    return result;
  }

  int rank_ = parallel::rank(MPI_COMM_WORLD);
  std::unique_ptr<test::TemporaryFolder> folder_;
  std::string directory_;
  DistributedMesh mesh_;
  std::vector<double> unknowns_, ids_;
};

}  // namespace

TEST_F(ResultsWriterTest, PiecesTogetherHoldEachElementOnceAndTheFieldsInTheirUnits) {
  for (bool compress : {false, true}) {
    auto results = writer({}, compress);
    write(results, 7, 0.25);
    if (rank_ != 0) continue;
    vtkNew<vtkXMLPUnstructuredGridReader> reader;
    auto* lumen = read(reader, "lumen_000007.pvtu");
    auto* velocity = lumen->GetPointData()->GetArray("velocity [cm/s]");
    auto* pressure = lumen->GetPointData()->GetArray("pressure [mmHg]");
    ASSERT_TRUE(velocity && pressure);
    EXPECT_EQ(lumen->GetPointData()->GetNumberOfArrays(), 2);
    EXPECT_EQ(lumen->GetCellData()->GetNumberOfArrays(), 0);
    for (vtkIdType n = 0; n < lumen->GetNumberOfPoints(); ++n) {
      double x[3];
      lumen->GetPoint(n, x);  // mm
      for (int d = 0; d < 3; ++d) EXPECT_NEAR(velocity->GetComponent(n, d), 2 * x[d] / 10, 1e-5);
      EXPECT_NEAR(pressure->GetComponent(n, 0), (1000 + 50 * x[2]) / 133.322, 1e-4);
    }
    double volume = 0;
    for (vtkIdType c = 0; c < lumen->GetNumberOfCells(); ++c) {
      ASSERT_EQ(lumen->GetCellType(c), VTK_TETRA);
      Vec3<double> x[4];
      for (int a = 0; a < 4; ++a) lumen->GetPoint(lumen->GetCell(c)->GetPointId(a), x[a].x);
      volume += fe::gradients(x).volume;
    }
    EXPECT_NEAR(volume, 4 * std::sqrt(2.0) / 2 * 100 * 2 * 30 / 2, 1);  // octagon of radius 10 mm times 30 mm
  }
}

TEST_F(ResultsWriterTest, CellArraysAndRegionsAreKeptApart) {
  auto results = writer();
  write(results, 0, 0);
  if (rank_ != 0) return;
  vtkNew<vtkXMLPUnstructuredGridReader> reader;
  auto* wall = read(reader, "wall_000000.pvtu");
  auto* element = wall->GetCellData()->GetArray("element");
  ASSERT_TRUE(element);
  EXPECT_FALSE(wall->GetPointData()->GetArray("pressure [mmHg]"));
  std::set<double> ids;
  for (vtkIdType c = 0; c < wall->GetNumberOfCells(); ++c) ids.insert(element->GetComponent(c, 0));
  const std::int64_t elements = 8 * 4 * 6;
  EXPECT_EQ(wall->GetNumberOfCells(), elements);
  EXPECT_EQ(std::ssize(ids), elements);
  EXPECT_EQ(*ids.rbegin() - *ids.begin(), elements - 1.0);
}

TEST_F(ResultsWriterTest, SeriesGrowsAndRestartDropsLaterTimes) {
  {
    auto results = writer();
    for (int step : {0, 10, 20, 30}) write(results, step, 0.1 * step);
  }
  if (rank_ == 0) {
    EXPECT_EQ(times("lumen"), (std::vector<double>{0, 1, 2, 0.1 * 30}));
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
    EXPECT_EQ(files::read_pvd(fs::path(directory_) / "wall.pvd").back().file, "wall_000025.pvtu");
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
  // The device accepts no byte, like a full disk. Only the last rank meets it.
  const int last = parallel::size(MPI_COMM_WORLD) - 1;
  const auto bad = fs::path(directory_) / fmt::format("lumen_000002_{}.vtu", last);
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
  if (rank_ == 0) std::ofstream(fs::path(directory_) / "wall.pvd") << "<VTKFile>\n<DataSet timestep=\"x\" file=\"a\"/>";
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_NE(message_of<InputError>([&] { writer(1.0); }).find("is not a series that can be continued"),
            std::string::npos);
  EXPECT_NO_THROW(writer());
}

TEST(SeriesFile, TimesAndNamesSurviveARoundTrip) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "a.pvd";
  EXPECT_TRUE(files::read_pvd(path).empty());
  files::write_atomically(path, files::pvd_text({{0.1, "a_1.pvtu"}, {1.0 / 3, "a_2.pvtu"}}));
  const auto series = files::read_pvd(path);
  ASSERT_EQ(series.size(), 2u);
  EXPECT_EQ(series[0].time, 0.1);
  EXPECT_EQ(series[1].time, 1.0 / 3);
  EXPECT_EQ(series[1].file, "a_2.pvtu");
  files::write_atomically(path, files::pvd_text(series).substr(0, 120));
  EXPECT_THROW(files::read_pvd(path), InputError);
}

}  // namespace tunica::distributed
