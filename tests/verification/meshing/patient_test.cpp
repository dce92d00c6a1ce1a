// The surfaces of a real type-B dissection: what was asked and what comes out, printed and asserted.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>

#include "tunica/stages/meshing/grown_wall.hpp"
#include "tunica/stages/meshing/surface_file.hpp"
#include "tunica/stages/meshing/surface_mending.hpp"

namespace tunica::stages::meshing {
namespace {

const std::filesystem::path folder = std::filesystem::path(TUNICA_SHARED_DATA) / "tbad_patient";

class Patient : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no patient data in " << folder;
  }
};

PatientSurfaces read() {
  return {read_surface(folder / "lumen_surface.vtp", 1e-3), read_surface(folder / "outer_wall_surface.vtp", 1e-3),
          read_opening_names(folder / "openings.csv", 1e-3)};
}

/// Largest distance of the points and triangle centres of `from` to `to`.
double distance(const TriangleSurface& from, const TriangleSurface& to) {
  const TriangleTree tree(to);
  double largest = 0;
  for (const auto& p : from.points) largest = std::max(largest, tree.nearest(p).distance);
  for (const auto& t : from.triangles)
    largest = std::max(largest,
                       tree.nearest((1.0 / 3) * (from.points[t[0]] + from.points[t[1]] + from.points[t[2]])).distance);
  return largest;
}

double hausdorff(const TriangleSurface& a, const TriangleSurface& b) {
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

TEST_F(Patient, ComplexKeepsVolumesShapeAndTopology) {
  const auto surfaces = read();
  const auto start = std::chrono::steady_clock::now();
  ComplexOptions options;
  options.sizes.largest = 2.5e-3;
  options.log = [](const std::string& line) { fmt::print("{}\n", line); };
  const auto prepared = patient_complex(surfaces, options);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;

  const auto& complex = prepared.complex;
  const auto lumen = surface_of(complex, PatchKind::interface), outer = surface_of(complex, PatchKind::outer_wall);
  // Against the files, so that the flattening of the rims counts, too.
  const double lumen_distance = hausdorff(lumen, surfaces.lumen), outer_distance = hausdorff(outer, *surfaces.outer);
  double angle = M_PI;
  const TriangleSurface all{complex.points, complex.triangles};
  for (const auto& t : all.triangles) angle = std::min(angle, smallest_angle(all, t));
  std::vector<double> flap, wall;
  for (std::size_t p = 0; p < prepared.thickness.value.size(); ++p)
    if (std::isfinite(prepared.thickness.value[p]))
      (prepared.thickness.flap[p] ? flap : wall).push_back(prepared.thickness.value[p]);
  fmt::print(
      "{} triangles in {:.1f} s\nlumen {:.2f} ml (348.4), wall {:.2f} ml (180.9)\ndistance to the files: lumen {:.2f} "
      "mm, outer {:.2f} mm (0.5)\ngenus of the lumen {} (4), smallest angle {:.1f} degrees\nthickness in mm, 5 / 50 / "
      "95 "
      "%: flap {}, wall {}\n",
      complex.triangles.size(), seconds.count(), 1e6 * volume(complex, Label::lumen),
      1e6 * volume(complex, Label::wall), 1e3 * lumen_distance, 1e3 * outer_distance, genus(lumen, 12),
      angle * 180 / M_PI, spread(flap), spread(wall));

  EXPECT_NO_THROW(verify(complex));
  EXPECT_NEAR(1e6 * volume(complex, Label::lumen), 348.4, 0.005 * 348.4);
  EXPECT_NEAR(1e6 * volume(complex, Label::wall), 180.9, 0.005 * 180.9);
  EXPECT_LT(lumen_distance, 0.5e-3);
  EXPECT_LT(outer_distance, 0.5e-3);
  EXPECT_EQ(genus(lumen, 12), 4);
  EXPECT_EQ(genus(outer, 12), 0);
  EXPECT_GT(angle * 180 / M_PI, 5);
  EXPECT_EQ(complex.patches.size(), 26u);
  EXPECT_EQ(prepared.openings[0].name, "ascending_aorta");
}

TEST_F(Patient, GrownWallIsNearTheGivenOne) {
  const auto surfaces = read();
  const auto start = std::chrono::steady_clock::now();
  GrowthSettings growth;
  growth.thinnest = growth.thickest = 2e-3;  // the given wall is 2 mm thick nearly everywhere
  growth.spacing = 0.8e-3;
  ComplexOptions options;
  options.sizes.largest = 3e-3;
  options.log = [](const std::string& line) { fmt::print("{}\n", line); };
  const auto grown = with_grown_wall(surfaces.lumen, surfaces.names, growth, {}, options);
  const auto prepared = patient_complex(grown, options);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;

  const TriangleTree outer(*grown.outer);
  std::vector<double> distances;
  for (const auto& p : surfaces.outer->points) distances.push_back(outer.nearest(p).distance);
  std::vector<double> wall;
  for (std::size_t p = 0; p < prepared.thickness.value.size(); ++p)
    if (!prepared.thickness.flap[p] && std::isfinite(prepared.thickness.value[p]))
      wall.push_back(prepared.thickness.value[p]);
  fmt::print("{:.1f} s; distance of the given outer surface, 5 / 50 / 95 %: {} mm; thickness of the grown wall {} mm\n",
             seconds.count(), spread(distances), spread(wall));

  EXPECT_NO_THROW(verify(prepared.complex));
  EXPECT_NEAR(1e6 * volume(prepared.complex, Label::lumen), 348.4, 0.005 * 348.4);
  std::nth_element(distances.begin(), distances.begin() + std::ssize(distances) / 2, distances.end());
  EXPECT_LT(distances[distances.size() / 2], 0.1e-3);
  std::nth_element(wall.begin(), wall.begin() + std::ssize(wall) / 2, wall.end());
  EXPECT_NEAR(wall[wall.size() / 2], 2e-3, 0.05e-3);
}

}  // namespace
}  // namespace tunica::stages::meshing
