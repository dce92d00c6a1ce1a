// The lumen surface from a labelled image with noise against the body that was imaged.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <random>

#include "tunica/geometry/dissection_model.hpp"
#include "tunica/geometry/triangle_tree.hpp"
#include "tunica/imaging/label_surface.hpp"
#include "tunica/imaging/synthetic_scan.hpp"
#include "tunica/meshing/geometry.hpp"
#include "tunica/stages/meshing/mesh_case.hpp"

namespace tunica::stages {
namespace {

using geometry::DissectionModel;
using geometry::TriangleSurface;
using geometry::TriangleTree;

/// Volume after each rim is closed by triangles to its centre [m^3].
double closed_volume(TriangleSurface surface) {
  for (const auto& loop : geometry::boundary_loops(surface)) {
    imaging::Point centre{{0, 0, 0}};
    for (const auto p : loop) centre = centre + (1.0 / static_cast<double>(loop.size())) * surface.points[p];
    surface.points.push_back(centre);
    for (std::size_t i = 0; i < loop.size(); ++i)
      surface.triangles.push_back({loop[(i + 1) % loop.size()], loop[i], std::ssize(surface.points) - 1});
  }
  return geometry::enclosed_volume(surface);
}

/// Of the body itself, by counting points [m^3].
double lumen_volume(const DissectionModel& model) {
  const double h = 0.8e-3;
  const auto box = model.box();
  double count = 0;
  for (double x = box.low[0] + 0.37 * h; x < box.high[0]; x += h)
    for (double y = box.low[1] + 0.61 * h; y < box.high[1]; y += h)
      for (double z = box.low[2] + 0.13 * h; z < box.high[2]; z += h) count += model.at({{x, y, z}}).lumen < 0;
  return count * h * h * h;
}

struct Deviations {
  double median, largest_of_95_percent;  ///< m
};

/// Thickness of the flap less that of the body at random places, along the normal of the flap.
Deviations thickness_deviations(const DissectionModel& model, const TriangleTree& surface, double thickness) {
  std::mt19937 random(3);
  const auto box = model.box();
  const auto from = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  const auto reach = [&](const imaging::Point& start, const Vec3<double>& direction, const auto& in_lumen) {
    double low = 0, high = 1.5 * thickness;
    for (int i = 0; i < 14; ++i) {
      const double middle = 0.5 * (low + high);
      (in_lumen(start + middle * direction) ? high : low) = middle;
    }
    return low;
  };
  std::vector<double> off;
  while (off.size() < 2000) {
    const imaging::Point p{
        {from(box.low[0], box.high[0]), from(box.low[1], box.high[1]), from(box.low[2], box.high[2])}};
    const auto v = model.at(p);
    if (v.flap > -0.3 * thickness || v.tear < 4e-3 || std::abs(v.side) > 0.3e-3) continue;
    Vec3<double> n;
    for (int d = 0; d < 3; ++d) {
      imaging::Point ahead = p, behind = p;
      ahead[d] += 1e-5;
      behind[d] -= 1e-5;
      n[d] = model.at(ahead).side - model.at(behind).side;
    }
    n = (1 / norm(n)) * n;
    const auto wet = [&](double way) { return model.at(p + way * n).lumen < -0.5 * thickness; };
    if (!wet(1.5 * thickness) || !wet(-1.5 * thickness)) continue;  // lumen on both sides, away from the corners
    const auto found = [&](const imaging::Point& x) { return surface.contains(x); };
    const auto true_one = [&](const imaging::Point& x) { return model.at(x).lumen < 0; };
    off.push_back(reach(p, n, found) + reach(p, -1.0 * n, found) - reach(p, n, true_one) -
                  reach(p, -1.0 * n, true_one));
  }
  std::sort(off.begin(), off.end());
  const double median = off[off.size() / 2];
  for (auto& x : off) x = std::abs(x);
  std::sort(off.begin(), off.end());
  return {median, off[off.size() * 95 / 100]};
}

/// Area of lumen in the middle sheet of the flap around a tear, over that of the body.
double tear_ratio(const DissectionModel& model, const TriangleTree& surface, const imaging::Point& centre) {
  const double h = 0.3e-3, half_width = 18e-3;
  double found = 0, exact = 0;
  for (double x = -half_width; x < half_width; x += h)
    for (double y = -half_width; y < half_width; y += h)
      for (double z = -half_width; z < half_width; z += h) {
        const imaging::Point p = centre + Vec3<double>{{x, y, z}};
        const auto v = model.at(p);
        if (std::abs(v.side) > 0.4e-3 || v.tear > 6e-3) continue;
        exact += v.lumen < 0;
        found += surface.contains(p);
      }
  return found / exact;
}

double rim_area(const TriangleSurface& surface, const geometry::Loop& loop, const imaging::Point& centre) {
  Vec3<double> sum{{0, 0, 0}};
  for (std::size_t i = 0; i < loop.size(); ++i)
    sum = sum + 0.5 * cross(surface.points[loop[i]] - centre, surface.points[loop[(i + 1) % loop.size()]] - centre);
  return norm(sum);
}

/// Vessel ends are where they are in the body, as steep and as wide: the scanner's blur has not rounded them.
void expect_openings(const imaging::LabelSurface& result, const DissectionModel& model) {
  const auto loops = geometry::boundary_loops(result.lumen);
  ASSERT_EQ(loops.size(), model.openings().size());
  for (const auto& o : model.openings()) {
    const auto& end = *std::min_element(result.ends.begin(), result.ends.end(), [&](const auto& a, const auto& b) {
      return norm(a.centre - o.centre) < norm(b.centre - o.centre);
    });
    EXPECT_LT(norm(end.centre - o.centre), 0.3e-3) << o.name;
    EXPECT_GT(dot(end.normal, o.normal), std::cos(4 * M_PI / 180)) << o.name;
    const auto& loop = *std::min_element(loops.begin(), loops.end(), [&](const auto& a, const auto& b) {
      return norm(result.lumen.points[a[0]] - o.centre) < norm(result.lumen.points[b[0]] - o.centre);
    });
    EXPECT_NEAR(rim_area(result.lumen, loop, o.centre) / (M_PI * o.lumen_radius * o.lumen_radius), 1, 0.03) << o.name;
  }
}

void expect_true(const imaging::ScanSettings& settings, const geometry::ParametricDissection& shape) {
  const DissectionModel model(shape);
  const auto result = imaging::surface_of(imaging::scan(model, settings),
                                          {.labels = {imaging::scan_true_lumen, imaging::scan_false_lumen}},
                                          [](const std::string& line) { std::printf("%s\n", line.c_str()); });
  const TriangleTree tree(result.lumen);
  const double volume = closed_volume(result.lumen) / lumen_volume(model);
  const auto thickness = thickness_deviations(model, tree, shape.flap.thickness);
  std::printf("volume %+.2f %% (1), flap thickness: median %+.3f mm, 95 %% within %.3f mm (0.2), tears",
              100 * (volume - 1), 1e3 * thickness.median, 1e3 * thickness.largest_of_95_percent);
  ASSERT_EQ(result.tears.size(), 2U);
  for (const auto& tear : result.tears) {
    const double ratio = tear_ratio(model, tree, tear.centre);
    std::printf(" %+.1f %%", 100 * (ratio - 1));
    EXPECT_NEAR(ratio, 1, 0.10);
  }
  std::printf(" (10)\n");
  EXPECT_NEAR(volume, 1, 0.01);
  EXPECT_NEAR(thickness.median, 0, 0.06e-3);
  EXPECT_LT(thickness.largest_of_95_percent, 0.2e-3);

  const auto part = geometry::components(result.lumen);
  EXPECT_EQ(*std::max_element(part.begin(), part.end()), 0);
  EXPECT_EQ(geometry::genus(result.lumen, std::ssize(result.ends)), 1);  // two tears, and no hole in the flap
  expect_openings(result, model);
}

TEST(LabelledImage, GivesVolumeFlapAndTearsOfTheDissection) { expect_true({}, {}); }

/// A tube with a flap about its middle, both ends of which are free. Planes lie between the voxels.
constexpr double tube_radius = 9e-3, tube_half = 30.1e-3, flap_half_length = 11.9e-3, flap_half = 1.4e-3;
int tube_with_flap(const imaging::Point& p) {
  if (std::hypot(p[0], p[1]) > tube_radius || std::abs(p[2]) > tube_half) return 0;
  if (std::abs(p[2]) > flap_half_length) return imaging::scan_true_lumen;
  return std::abs(p[0]) < flap_half ? 0 : p[0] > 0 ? imaging::scan_true_lumen : imaging::scan_false_lumen;
}

TEST(LabelledImage, BecomesAMeshWithAGrownWall) {
  imaging::LabelImage image{{{40, 40, 100}, {{-13.65e-3, -13.65e-3, -34.65e-3}}, {}}, {}};
  for (int d = 0; d < 3; ++d) image.frame.steps[d][d] = 0.7e-3;
  for (std::int64_t i = 0; i < image.frame.count(); ++i)
    image.labels.push_back(static_cast<std::int16_t>(tube_with_flap(image.frame.place(image.frame.voxel(i)))));
  const auto file = std::filesystem::temp_directory_path() / ("tunica_flap_" + std::to_string(::getpid()) + ".nrrd");
  imaging::write_label_image(image, file);
  case_file::MeshCase mesh_case;
  meshing::ImageGeometry geometry;
  geometry.file = file;
  geometry.surface.labels = {imaging::scan_true_lumen, imaging::scan_false_lumen};
  geometry.surface.openings = {{"in", {{{0, 0, -tube_half}}, {}}}, {"out", {{{0, 0, tube_half}}, {}}}};
  geometry.aorta_ends = {"out"};
  geometry.wall.thinnest = geometry.wall.thickest = 1.5e-3;
  mesh_case.geometry = meshing::Geometry(geometry);
  mesh_case.size = 3e-3;
  const auto made = make_mesh(mesh_case, [](const std::string&) {});
  std::filesystem::remove(file);

  const auto report = nlohmann::json::parse(made.report_json);
  EXPECT_EQ(report["lumen_boundary"]["parts"], 1);
  EXPECT_EQ(report["lumen_boundary"]["genus"], 1);
  EXPECT_EQ(report["lumen_boundary"]["manifold"], true);
  EXPECT_GT(report["shapes"]["smallest_dihedral_deg"].get<double>(), 3);
  double lumen = 0, wall = 0;
  for (const auto& region : report["regions"]) {
    const auto volume = region["volume_ml"].get<double>();
    (region["name"] == "lumen" ? lumen : wall) += volume;
  }
  const double sheet = 1e6 * 8 * tube_radius * flap_half * flap_half_length,
               whole = 1e6 * M_PI * tube_radius * tube_radius * 2 * tube_half,
               shell = 1e6 * M_PI * (std::pow(tube_radius + 1.5e-3, 2) - tube_radius * tube_radius) * 2 * tube_half;
  std::printf("lumen %.3f ml (%.3f), wall %.3f ml (%.3f)\n", lumen, whole - sheet, wall, shell + sheet);
  EXPECT_NEAR(lumen / (whole - sheet), 1, 0.02);
  EXPECT_NEAR(wall / (shell + sheet), 1, 0.03);
}

}  // namespace
}  // namespace tunica::stages
