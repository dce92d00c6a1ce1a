// The function between the voxels and its zero surface, on bodies that are known exactly.
#include "tunica/imaging/smooth_field.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "small_images.hpp"

namespace tunica::imaging {
namespace {

using namespace testing;
using std::numbers::pi;

SmoothField field_of(const LabelImage& image, double sigma) {
  return smooth_field(lumen_mask(image, {}, 6, silent), sigma);
}

TEST(SmoothField, IsExactBetweenVoxelsForProductsOfLinearFunctions) {
  SmoothField field{{{4, 3, 5}, {{1 * mm, 2 * mm, 3 * mm}}, oblique()}, {}, {}};
  field.to_voxels = inverse(field.frame.matrix());
  const auto function = [](double i, double j, double k) { return 0.1 + i * (0.5 - j) + 0.25 * k * j - i * j * k; };
  for (std::int64_t index = 0; index < field.frame.count(); ++index) {
    const auto v = field.frame.voxel(index);
    field.values.push_back(
        static_cast<float>(function(static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2]))));
  }
  for (const Point& v : {Point{{0.3, 0.9, 3.7}}, Point{{2.99, 1.01, 0.01}}, Point{{1.5, 0.5, 2.5}}})
    EXPECT_NEAR(field.at(field.frame.place(v)), function(v[0], v[1], v[2]), 1e-5);
  for (const Point& v : {Point{{-0.01, 1, 1}}, Point{{3.01, 1, 1}}, Point{{1, 2.01, 1}}, Point{{1, 1, -0.5}}})
    EXPECT_EQ(field.at(field.frame.place(v)), 0.5);
}

TEST(SmoothField, APlaneStaysMidwayBetweenItsVoxels) {
  // Half of a long block; far from its other sides the function is that of a plane, odd about it.
  const auto image =
      image_of([](const Point& p) { return p[0] < 0 && std::abs(p[1]) < 12 * mm && std::abs(p[2]) < 12 * mm; },
               {32, 40, 40}, straight);
  for (const double sigma : {0.5, 0.85, 2.0}) {
    const auto field = field_of(image, sigma);
    EXPECT_NEAR(field.at({{0, 0.2 * mm, -0.1 * mm}}), 0, 1e-6);
    for (const double x : {0.3 * mm, 1.1 * mm, 2.2 * mm})
      EXPECT_NEAR(field.at({{x, 0, 0}}), -field.at({{-x, 0, 0}}), 5e-5);
    EXPECT_GT(field.at({{0.35 * mm, 0, 0}}), 0.1);
  }
}

/// Where the function is zero along x, from inside to outside or back, by bisection.
double zero_between(const SmoothField& field, double a, double b) {
  const bool rises = field.at({{a, 0, 0}}) < 0;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (a + b);
    ((field.at({{middle, 0, 0}}) < 0) == rises ? a : b) = middle;
  }
  return 0.5 * (a + b);
}

TEST(SmoothField, HardlyThickensAThinSheetOfTissue) {
  // A flap of two or three voxels between two lumens.
  for (const int voxels : {2, 3}) {
    const double half = 0.5 * voxels * 0.7 * mm;
    // Voxels lie beside x = 0 for two and on it for three.
    const std::int64_t across = voxels == 2 ? 40 : 41;
    const auto image = image_of([&](const Point& p) { return std::abs(p[0]) > half && norm(p) < 11 * mm; },
                                {across, 40, 40}, straight);
    SmoothField field = smooth_field({image.frame,
                                      [&] {
                                        std::vector<Kind> kinds;
                                        for (const auto l : image.labels)
                                          kinds.push_back(l ? Kind::true_lumen : Kind::tissue);
                                        return kinds;
                                      }(),
                                      {},
                                      {}},
                                     0.85);
    const double thickness = zero_between(field, 0, 5 * mm) - zero_between(field, -5 * mm, 0);
    EXPECT_NEAR(thickness / (2 * half), 1, 0.06) << voxels;
  }
}

geometry::TriangleSurface ring(const std::array<Vec3<double>, 3>& steps) {
  const auto image = image_of(
      [](const Point& p) { return std::hypot(std::hypot(p[0], p[1]) - 6 * mm, p[2]) < 2.5 * mm; }, {32, 32, 16}, steps);
  return boundary(field_of(image, 0.85));
}

TEST(SmoothField, ARingHasAHole) {
  for (const auto& steps : {straight, oblique()}) {
    const auto surface = ring(steps);
    EXPECT_TRUE(geometry::boundary_loops(surface).empty());
    EXPECT_EQ(geometry::genus(surface, 0), 1);
    const double volume = 2 * pi * pi * 6 * 2.5 * 2.5 * 1e-9, surface_area = 4 * pi * pi * 6 * 2.5 * 1e-6;
    EXPECT_NEAR(geometry::enclosed_volume(surface) / volume, 1, 0.04);
    EXPECT_NEAR(geometry::area(surface) / surface_area, 1, 0.04);
    for (const auto& p : surface.points) EXPECT_NEAR(std::hypot(std::hypot(p[0], p[1]) - 6 * mm, p[2]) / mm, 2.5, 0.35);
  }
}

TEST(SmoothField, DoesNotDependOnTheOrderOfTheAxes) {
  auto steps = straight;
  std::swap(steps[0], steps[1]);
  steps[2] = -1.0 * steps[2];
  const auto one = ring(straight), other = ring(steps);
  EXPECT_EQ(one.points.size(), other.points.size());
  EXPECT_NEAR(geometry::enclosed_volume(one) / geometry::enclosed_volume(other), 1, 1e-6);
  EXPECT_NEAR(geometry::area(one) / geometry::area(other), 1, 0.01);  // diagonals may differ
}

}  // namespace
}  // namespace tunica::imaging
