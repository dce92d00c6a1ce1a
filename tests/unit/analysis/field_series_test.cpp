// Fields that a distributed run has written, read back in the order of the mesh.
#include "tunica/analysis/field_series.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "shared_folder.hpp"
#include "small_vessels.hpp"
#include "tunica/base/error.hpp"
#include "tunica/distributed/results_writer.hpp"
#include "tunica/field_io/series_index.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/mesh/edge_nodes.hpp"

namespace tunica::analysis {
namespace {

using namespace testing;
using test::message_of;

constexpr double mmHg = 133.322387415;

Vec3<double> velocity(const Vec3<double>& x) { return {{x[1] - 2 * x[2], 0.5 + x[0], x[2] * x[0]}}; }
Vec3<double> displacement(const Vec3<double>& x) { return {{0.1 * x[1], -0.2 * x[2], 0.3 * x[0] + 0.01}}; }
Vec3<double> shear(const Vec3<double>& x) { return {{x[2], 1 - x[0], x[1]}}; }
double pressure(const Vec3<double>& x) { return 13000 + 500 * x[2] - 40 * x[0]; }

/// The two plates and the lumen between them, with results on all ranks.
class FieldSeriesTest : public ::testing::Test {
 protected:
  FieldSeriesTest() : data_(two_lumens()), mesh_(distributed::distribute(data_, MPI_COMM_WORLD)) {}

  template <class F>
  std::vector<double> local(const F& function, double factor = 1) const {
    std::vector<double> values;
    for (const auto& x : mesh_.points) {
      const Vec3<double> v = function(x);
      for (int c = 0; c < 3; ++c) values.push_back(factor * v[c]);
    }
    return values;
  }

  /// Fields grow with time; the stress of an element is its number in MeshData [kPa in the file].
  void write(const std::vector<double>& times, const std::string& unit = "mm", double length = 1000) {
    const distributed::ResultsOptions options{.directory = folder_.path(), .length_factor = length};
    distributed::ResultsWriter writer(mesh_, options);
    for (std::size_t k = 0; k < times.size(); ++k) {
      const double t = times[k];
      const auto v = local(velocity, 1 + t), d = local(displacement, t), tau = local(shear, t);
      std::vector<double> p;
      for (const auto& x : mesh_.points) p.push_back(pressure(x) + t);
      const distributed::NodalArray nodal[] = {
          {.name = "velocity [cm s^-1]", .components = 3, .values = v, .stride = 3, .factor = 100, .region = 0},
          {.name = "pressure [mmHg]", .values = p, .factor = 1 / mmHg, .region = 0},
          {.name = "wall shear stress [Pa]", .components = 3, .values = tau, .stride = 3, .region = 0},
          {.name = "displacement [" + unit + "]", .components = 3, .values = d, .stride = 3, .factor = length}};
      std::vector<double> stress[2];
      for (std::size_t r = 1; r < 3; ++r) {
        const auto& region = mesh_.regions[r];
        for (std::int32_t e = 0; e < region.owned_elements; ++e)
          stress[r - 1].push_back(1000 * (static_cast<double>(region.element_ids[static_cast<std::size_t>(e)]) + t));
      }
      const distributed::CellArray cells[] = {
          {.name = "von Mises stress [kPa]", .region = 1, .values = stress[0], .factor = 1e-3},
          {.name = "von Mises stress [kPa]", .region = 2, .values = stress[1], .factor = 1e-3},
          {.name = "fibre stress [kPa]", .region = 2, .values = stress[1], .factor = 1e-3}};
      writer.write(static_cast<std::int64_t>(10 * k), t, nodal, cells);
    }
    MPI_Barrier(MPI_COMM_WORLD);
  }
  FieldSeries series(const RunDescription& run) const { return {run, data_, folder_.path()}; }
  std::string refusal(const RunDescription& run) const {
    return message_of<InputError>([&] {
      auto found = series(run);
      found.read(0);
    });
  }
  bool root() const { return parallel::rank(MPI_COMM_WORLD) == 0; }
  /// Something that rank 0 does to the files.
  template <class Action>
  void spoil(const Action& action) const {
    MPI_Barrier(MPI_COMM_WORLD);
    if (root()) action();
    MPI_Barrier(MPI_COMM_WORLD);
  }

  mesh::MeshData data_;
  distributed::DistributedMesh mesh_;
  test::SharedFolder folder_;
};

TEST_F(FieldSeriesTest, FieldsComeBackInTheOrderOfTheMeshWhateverRanksWroteThem) {
  write({0, 0.25});
  auto found = series(flow_in_two_lumens());
  ASSERT_EQ(found.times(), (std::vector<double>{0, 0.25}));
  const auto frame = found.read(1);
  EXPECT_EQ(frame.time, 0.25);
  const auto expected = [&](const auto& function, double factor) {
    return nodal_vectors(data_, [&](const auto& x) { return factor * function(x); });
  };
  const auto v = expected(velocity, 1.25), d = expected(displacement, 0.25), tau = expected(shear, 0.25);
  const auto lumen_nodes = static_cast<std::size_t>(4 * 5 * 7);  // they come first
  ASSERT_EQ(frame.velocity.size(), v.size());
  ASSERT_EQ(frame.displacement.size(), d.size());
  for (std::size_t i = 0; i < d.size(); ++i) {
    EXPECT_NEAR(frame.displacement[i], d[i], 1e-7);
    EXPECT_NEAR(frame.velocity[i], i < 3 * lumen_nodes ? v[i] : 0, 1e-6);
    EXPECT_NEAR(frame.wall_shear[i], i < 3 * lumen_nodes ? tau[i] : 0, 1e-6);
  }
  for (std::size_t n = 0; n < data_.points.size(); ++n)
    EXPECT_NEAR(frame.pressure[n], n < lumen_nodes ? pressure(data_.points[n]) + 0.25 : 0, 2e-3);
}

TEST_F(FieldSeriesTest, StressesBelongToTheElementsOfTheRegionsThatHaveThem) {
  write({0.5});
  auto found = series(flow_in_two_lumens());
  ASSERT_EQ(found.stresses(), (std::vector<std::string>{"von Mises stress", "fibre stress"}));
  const auto frame = found.read(0);
  for (std::size_t r = 0; r < 3; ++r)
    for (auto e = data_.regions[r].first_element; e < data_.regions[r].end_element; ++e) {
      const double both = frame.stress[0][static_cast<std::size_t>(e)],
                   fibre = frame.stress[1][static_cast<std::size_t>(e)];
      const double expected = 1000 * (static_cast<double>(e) + 0.5);
      if (r == 0) {
        EXPECT_TRUE(std::isnan(both));
      } else {
        EXPECT_NEAR(both, expected, 1e-6 * expected);
      }
      if (r < 2) {
        EXPECT_TRUE(std::isnan(fibre));
      } else {
        EXPECT_NEAR(fibre, expected, 1e-6 * expected);
      }
    }
}

TEST_F(FieldSeriesTest, LengthsMayBeInAnyUnit) {
  write({1.0}, "cm", 100);
  auto run = flow_in_two_lumens();
  run.length_unit = "cm";
  const auto frame = series(run).read(0);
  for (std::size_t n = 0; n < data_.points.size(); ++n)
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(frame.displacement[3 * n + static_cast<std::size_t>(c)], displacement(data_.points[n])[c], 1e-6);
  run.length_unit = "mm";  // as a case would say that was changed after its run
  const auto text = refusal(run);
  EXPECT_NE(text.find("where the mesh has none"), std::string::npos) << text;
  EXPECT_NE(text.find("`output.units.length` has changed since"), std::string::npos) << text;
}

TEST_F(FieldSeriesTest, QuadraticElementsAreReadAsTheyAreOrSubdivided) {
  write({0});
  const auto linear = data_;
  mesh::add_edge_nodes(data_);
  EXPECT_NE(refusal(flow_in_two_lumens()).find("has linear elements, the mesh has quadratic ones"), std::string::npos);
  MPI_Barrier(MPI_COMM_WORLD);
  mesh_ = distributed::distribute(data_, MPI_COMM_WORLD);
  write({0.5});
  const auto expected = nodal_vectors(data_, [](const auto& x) { return 0.5 * displacement(x); });
  for (const auto& mesh : {data_, mesh::subdivided(data_)}) {
    const auto frame = FieldSeries(flow_in_two_lumens(), mesh, folder_.path()).read(0);
    ASSERT_EQ(frame.displacement.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(frame.displacement[i], expected[i], 1e-7);
    for (auto e = mesh.regions[0].first_element; e < mesh.regions[0].end_element; ++e)
      for (const auto node : mesh.tetrahedra[static_cast<std::size_t>(e)])
        EXPECT_NEAR(frame.pressure[static_cast<std::size_t>(node)],
                    pressure(mesh.points[static_cast<std::size_t>(node)]) + 0.5, 2e-3);
    const auto parts = mesh.tetrahedra.size() / data_.tetrahedra.size();
    for (auto e = static_cast<std::size_t>(mesh.regions[1].first_element); e < mesh.tetrahedra.size(); ++e)
      EXPECT_NEAR(frame.stress[0][e], 1000 * (static_cast<double>(e / parts) + 0.5), 0.1);
  }
  data_ = linear;
  EXPECT_NE(refusal(flow_in_two_lumens()).find("where the mesh has none"), std::string::npos);
}

TEST_F(FieldSeriesTest, OnlyTimesThatAllRegionsHaveCount) {
  write({0, 0.1, 0.2});
  spoil([&] {
    const auto path = field_io::series_file(folder_.path(), "false_lumen_wall");
    auto entries = field_io::read_series(path);
    entries.erase(entries.begin() + 1);
    files::write_atomically(path, field_io::series_text(entries));
  });
  auto found = series(flow_in_two_lumens());
  EXPECT_EQ(found.times(), (std::vector<double>{0, 0.2}));
  EXPECT_EQ(found.read(1).time, 0.2);
  EXPECT_NEAR(found.read(1).stress[0].back(), 1000 * (static_cast<double>(data_.tetrahedra.size()) - 1 + 0.2), 0.1);
  spoil([&] {
    const auto path = field_io::series_file(folder_.path(), "lumen");
    auto entries = field_io::read_series(path);
    files::write_atomically(path, field_io::series_text({entries[1]}));
  });
  EXPECT_NE(refusal(flow_in_two_lumens()).find("no time that all regions have in common"), std::string::npos);
}

TEST_F(FieldSeriesTest, ResultsOfAnotherMeshAreRefused) {
  write({0});
  auto other = data_;
  other.points[5][1] += 1e-4;
  const auto text = message_of<InputError>([&] { FieldSeries(flow_in_two_lumens(), other, folder_.path()).read(0); });
  EXPECT_NE(text.find("belong to another mesh"), std::string::npos) << text;

  // The same points, but two elements share another diagonal.
  other = data_;
  std::swap(other.tetrahedra[0][3], other.tetrahedra[20][0]);
  EXPECT_NE(message_of<InputError>([&] {
              FieldSeries(flow_in_two_lumens(), other, folder_.path()).read(0);
            }).find("has an element that the mesh does not have"),
            std::string::npos);

  other = data_;  // one element more than was computed on
  other.tetrahedra.push_back(other.tetrahedra.back());
  std::swap(other.tetrahedra.back()[0], other.tetrahedra.back()[1]);
  other.regions[2].end_element += 1;
  EXPECT_NE(message_of<InputError>([&] {
              FieldSeries(flow_in_two_lumens(), other, folder_.path()).read(0);
            }).find("elements, the mesh has"),
            std::string::npos);
}

TEST_F(FieldSeriesTest, DamagedFilesAreRefused) {
  for (const char* name : {"lumen_000000.hdf", "lumen_mesh.hdf", "lumen.hdf.series"}) {
    write({0});
    spoil([&] {
      const auto path = folder_.path() / name;
      const auto text = test::slurp(path);
      std::ofstream(path, std::ios::binary) << text.substr(0, text.size() / 2);
    });
    const auto text = refusal(flow_in_two_lumens());
    EXPECT_NE(text.find(name[6] == 'm' ? "lumen_" : name), std::string::npos) << text;
  }
}

/// The fields of one region at the only instant, in place of what was written.
void replace_fields(const std::filesystem::path& folder, const std::vector<field_io::Array>& points) {
  files::write_atomically(folder / "lumen_000000.hdf", field_io::instant_bytes({0, points, {}}, "lumen_mesh.hdf"));
}

TEST_F(FieldSeriesTest, FieldsOfOtherSizesAndUnitsAreRefused) {
  write({0});
  const auto refused = [&](const std::string& velocity, int components, std::size_t tuples) {
    spoil([&] {
      const auto numbers = static_cast<std::size_t>(components) * tuples;
      replace_fields(folder_.path(), {{"displacement [mm]", 3, std::vector<float>(3 * 140, 0)},
                                      {velocity, components, std::vector<float>(numbers, 0)}});
    });
    return refusal(flow_in_two_lumens());
  };
  const auto expect = [&](const std::string& text, const char* what) {
    EXPECT_NE(text.find(what), std::string::npos) << text;
    EXPECT_NE(text.find("lumen_000000.hdf"), std::string::npos) << text;
  };
  expect(refused("velocity [cm s^-1]", 1, 140), "`velocity` does not have 3 components for each of 140 points");
  expect(refused("velocity [cm s^-1]", 3, 139), "`velocity` does not have 3 components for each of 140 points");
  expect(refused("velocity [mmHg]", 3, 140), "mmHg");
  expect(refused("speed [cm s^-1]", 3, 140), "has no field `velocity`, only: displacement, speed");
}

TEST_F(FieldSeriesTest, SaysWhatIsMissing) {
  EXPECT_NE(refusal(flow_in_two_lumens()).find("holds no results of the region lumen"), std::string::npos);
  write({0});
  spoil([&] { std::filesystem::remove(folder_.path() / "lumen_000000.hdf"); });
  const auto text = refusal(flow_in_two_lumens());
  EXPECT_NE(text.find("lumen_000000.hdf: is missing, though the series names it"), std::string::npos) << text;
  EXPECT_NE(text.find("run the case again"), std::string::npos) << text;
}

}  // namespace
}  // namespace tunica::analysis
