// The surfaces of a real type-B dissection: what was asked and what comes out, printed and asserted.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "folders.hpp"
#include "tunica/geometry/surface_file.hpp"
#include "tunica/geometry/surface_mending.hpp"
#include "tunica/meshing/geometry.hpp"
#include "tunica/meshing/grown_wall.hpp"
#include "tunica/stages/meshing/mesh_case.hpp"

namespace tunica::stages {
namespace {

const std::filesystem::path folder = std::filesystem::path(TUNICA_SHARED_DATA) / "tbad_patient";

class Patient : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no patient data in " << folder;
  }
};

meshing::PatientSurfaces read() {
  return {geometry::read_surface(folder / "lumen_surface.vtp", 1e-3),
          geometry::read_surface(folder / "outer_wall_surface.vtp", 1e-3),
          geometry::read_opening_names(folder / "openings.csv", 1e-3)};
}

/// Largest distance of the points and triangle centres of `from` to `to`.
double distance(const geometry::TriangleSurface& from, const geometry::TriangleSurface& to) {
  const geometry::TriangleTree tree(to);
  double largest = 0;
  for (const auto& p : from.points) largest = std::max(largest, tree.nearest(p).distance);
  for (const auto& t : from.triangles)
    largest = std::max(largest,
                       tree.nearest((1.0 / 3) * (from.points[t[0]] + from.points[t[1]] + from.points[t[2]])).distance);
  return largest;
}

double hausdorff(const geometry::TriangleSurface& a, const geometry::TriangleSurface& b) {
  return std::max(distance(a, b), distance(b, a));
}

/// "1.23 / 2.00 / 3.10": 5th, 50th and 95th percentile in mm.
std::string spread(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto at = [&](double share) {
    return 1e3 * values[static_cast<std::size_t>(share * (std::ssize(values) - 1))];
  };
  return fmt::format("{:.2f} / {:.2f} / {:.2f}", at(0.05), at(0.5), at(0.95));
}

/// Of the files themselves, so that what mending and flattening do counts, too.
geometry::TriangleSurface face(const mesh::MeshData& data, const std::string& name) {
  for (const auto& f : data.faces)
    if (f.name == name) {
      geometry::TriangleSurface surface{data.points, {f.triangles.begin(), f.triangles.end()}};
      geometry::drop_unused_points(surface);
      return surface;
    }
  throw std::runtime_error("no face " + name);
}

TEST_F(Patient, MeshKeepsVolumesShapeAndTopology) {
  case_file::MeshCase mesh_case;
  mesh_case.geometry = meshing::Geometry(meshing::SurfaceFiles{.lumen = folder / "lumen_surface.vtp",
                                                               .false_lumen = {},
                                                               .outer_wall = folder / "outer_wall_surface.vtp",
                                                               .openings = folder / "openings.csv",
                                                               .metres_per_unit = 1e-3,
                                                               .roles = {},
                                                               .wall = {}});
  mesh_case.size = 3.2e-3;
  const auto made = make_mesh(mesh_case, [](const std::string& line) { fmt::print("{}\n", line); });
  fmt::print("{}\n", made.report_text);
  const auto report = nlohmann::json::parse(made.report_json);
  double lumen = 0, wall = 0;
  for (const auto& region : report["regions"])
    (region["name"] == "lumen" ? lumen : wall) += region["volume_ml"].get<double>();
  const auto files = read();
  const double lumen_distance = hausdorff(face(made.data, "lumen_wall"), files.lumen),
               outer_distance = hausdorff(face(made.data, "wall_outer"), *files.outer);
  fmt::print("lumen {:.2f} ml (348.4), wall {:.2f} ml (180.9); distance to the files: {:.2f} and {:.2f} mm (0.5)\n",
             lumen, wall, 1e3 * lumen_distance, 1e3 * outer_distance);

  EXPECT_NEAR(lumen / 348.4, 1, 0.005);
  EXPECT_NEAR(wall / 180.9, 1, 0.005);
  EXPECT_LT(lumen_distance, 0.5e-3);
  EXPECT_LT(outer_distance, 0.5e-3);
  EXPECT_LT(report["fidelity"]["lumen_distance_per_edge"].get<double>(), 0.3);
  EXPECT_LT(report["fidelity"]["outer_distance_per_edge"].get<double>(), 0.3);
  EXPECT_EQ(report["lumen_boundary"]["genus"], 4);
  EXPECT_EQ(report["lumen_boundary"]["parts"], 1);
  EXPECT_EQ(report["lumen_boundary"]["manifold"], true);
  EXPECT_EQ(report["wall_boundary"]["manifold"], true);
  EXPECT_GE(report["shapes"]["smallest_dihedral_deg"].get<double>(), 3);
  EXPECT_GE(report["shapes"]["dihedral_of_worst_0.01_percent_deg"].get<double>(), 8);
  EXPECT_NEAR(made.data.tetrahedra.size(), 0.33e6, 0.03e6);
  EXPECT_EQ(made.data.regions.size(), 5U);
  EXPECT_EQ(made.data.faces.size(), 2U * 12 + 3);
  EXPECT_NE(made.report_page.find("data:image/png"), std::string::npos);
}

TEST_F(Patient, GrownWallIsNearTheGivenOne) {
  const auto surfaces = read();
  const auto start = std::chrono::steady_clock::now();
  meshing::GrowthSettings growth;
  growth.thinnest = growth.thickest = 2e-3;  // the given wall is 2 mm thick nearly everywhere
  growth.spacing = 0.8e-3;
  meshing::ComplexOptions options;
  options.sizes.largest = 3e-3;
  options.log = [](const std::string& line) { fmt::print("{}\n", line); };
  const auto grown = meshing::with_grown_wall(surfaces.lumen, surfaces.names, growth, {}, options);
  const auto prepared = meshing::patient_complex(grown, options);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;

  const geometry::TriangleTree outer(*grown.outer);
  std::vector<double> distances;
  for (const auto& p : surfaces.outer->points) distances.push_back(outer.nearest(p).distance);
  std::vector<double> wall;
  for (std::size_t p = 0; p < prepared.thickness.value.size(); ++p)
    if (!prepared.thickness.flap[p] && std::isfinite(prepared.thickness.value[p]))
      wall.push_back(prepared.thickness.value[p]);
  fmt::print("{:.1f} s; distance of the given outer surface, 5 / 50 / 95 %: {} mm; thickness of the grown wall {} mm\n",
             seconds.count(), spread(distances), spread(wall));

  EXPECT_NO_THROW(meshing::verify(prepared.complex));
  EXPECT_NEAR(1e6 * meshing::volume(prepared.complex, meshing::Label::lumen), 348.4, 0.005 * 348.4);
  std::nth_element(distances.begin(), distances.begin() + std::ssize(distances) / 2, distances.end());
  EXPECT_LT(distances[distances.size() / 2], 0.1e-3);
  std::nth_element(wall.begin(), wall.begin() + std::ssize(wall) / 2, wall.end());
  EXPECT_NEAR(wall[wall.size() / 2], 2e-3, 0.05e-3);
}

}  // namespace
}  // namespace tunica::stages
