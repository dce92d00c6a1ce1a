// The lumen surface from a labelled image with noise against the body that was imaged.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "tunica/stages/imaging/label_surface.hpp"
#include "tunica/stages/imaging/synthetic_scan.hpp"
#include "tunica/stages/meshing/dissection_model.hpp"
#include "tunica/stages/meshing/triangle_tree.hpp"

namespace tunica::stages::imaging {
namespace {

using meshing::DissectionModel;
using meshing::TriangleSurface;
using meshing::TriangleTree;

/// Volume after each rim is closed by triangles to its centre [m^3].
double closed_volume(TriangleSurface surface) {
  for (const auto& loop : meshing::boundary_loops(surface)) {
    Point centre{{0, 0, 0}};
    for (const auto p : loop) centre = centre + (1.0 / static_cast<double>(loop.size())) * surface.points[p];
    surface.points.push_back(centre);
    for (std::size_t i = 0; i < loop.size(); ++i)
      surface.triangles.push_back({loop[(i + 1) % loop.size()], loop[i], std::ssize(surface.points) - 1});
  }
  return meshing::enclosed_volume(surface);
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
  const auto reach = [&](const Point& start, const Vec3<double>& direction, const auto& in_lumen) {
    double low = 0, high = 1.5 * thickness;
    for (int i = 0; i < 14; ++i) {
      const double middle = 0.5 * (low + high);
      (in_lumen(start + middle * direction) ? high : low) = middle;
    }
    return low;
  };
  std::vector<double> off;
  while (off.size() < 2000) {
    const Point p{{from(box.low[0], box.high[0]), from(box.low[1], box.high[1]), from(box.low[2], box.high[2])}};
    const auto v = model.at(p);
    if (v.flap > -0.3 * thickness || v.tear < 4e-3 || std::abs(v.side) > 0.3e-3) continue;
    Vec3<double> n;
    for (int d = 0; d < 3; ++d) {
      Point ahead = p, behind = p;
      ahead[d] += 1e-5;
      behind[d] -= 1e-5;
      n[d] = model.at(ahead).side - model.at(behind).side;
    }
    n = (1 / norm(n)) * n;
    const auto wet = [&](double way) { return model.at(p + way * n).lumen < -0.5 * thickness; };
    if (!wet(1.5 * thickness) || !wet(-1.5 * thickness)) continue;  // lumen on both sides, away from the corners
    const auto found = [&](const Point& x) { return surface.contains(x); };
    const auto true_one = [&](const Point& x) { return model.at(x).lumen < 0; };
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
double tear_ratio(const DissectionModel& model, const TriangleTree& surface, const Point& centre) {
  const double h = 0.3e-3, half_width = 18e-3;
  double found = 0, exact = 0;
  for (double x = -half_width; x < half_width; x += h)
    for (double y = -half_width; y < half_width; y += h)
      for (double z = -half_width; z < half_width; z += h) {
        const Point p = centre + Vec3<double>{{x, y, z}};
        const auto v = model.at(p);
        if (std::abs(v.side) > 0.4e-3 || v.tear > 6e-3) continue;
        exact += v.lumen < 0;
        found += surface.contains(p);
      }
  return found / exact;
}

void expect_true(const ScanSettings& settings, const meshing::ParametricDissection& shape) {
  const DissectionModel model(shape);
  const auto result = surface_of(scan(model, settings), {.labels = {scan_true_lumen, scan_false_lumen}},
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

  const auto part = meshing::components(result.lumen);
  EXPECT_EQ(*std::max_element(part.begin(), part.end()), 0);
  EXPECT_EQ(meshing::genus(result.lumen, std::ssize(result.ends)), 1);  // two tears, and no hole in the flap
  ASSERT_EQ(result.ends.size(), model.openings().size());
  for (const auto& o : model.openings()) {
    double nearest = 1, turned = 0;
    for (const auto& end : result.ends)
      if (norm(end.centre - o.centre) < nearest) {
        nearest = norm(end.centre - o.centre);
        turned = dot(end.normal, o.normal);
      }
    EXPECT_LT(nearest, 0.3e-3) << o.name;
    EXPECT_GT(turned, std::cos(3 * M_PI / 180)) << o.name;
  }
}

TEST(LabelledImage, GivesVolumeFlapAndTearsOfTheDissection) { expect_true({}, {}); }

}  // namespace
}  // namespace tunica::stages::imaging
