// From what a case names to surfaces: files in any unit, and a segmented image.
#include "tunica/meshing/geometry.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tunica/geometry/surface_file.hpp"
#include "unit/geometry/small_surfaces.hpp"
#include "unit/imaging/small_images.hpp"

namespace tunica::meshing {
namespace {

using namespace geometry::test;
using geometry::TriangleSurface;
constexpr double mm = 1e-3;

TriangleSurface scaled(TriangleSurface surface, double factor) {
  for (auto& p : surface.points) p = factor * p;
  return surface;
}

void expect_same(const TriangleSurface& a, const TriangleSurface& b) {
  ASSERT_EQ(a.points.size(), b.points.size());
  EXPECT_EQ(a.triangles, b.triangles);
  for (std::size_t p = 0; p < a.points.size(); ++p) EXPECT_LT(norm(a.points[p] - b.points[p]), 1e-8);
}

TEST(SurfaceFiles, MayBeInAnyUnit) {
  const Folder folder;
  const auto lumen = tube(5 * mm, 20 * mm, 30, 12), outer = tube(6 * mm, 20 * mm, 36, 12);
  for (const auto& [unit, name] : {std::pair{1e-3, "mm"}, std::pair{1e-2, "cm"}, std::pair{1.0, "m"}}) {
    geometry::write_surface(scaled(lumen, 1 / unit), folder.path / "lumen.vtp");
    geometry::write_surface(scaled(outer, 1 / unit), folder.path / "outer.vtp");
    std::ofstream(folder.path / "names.csv")
        << "name,centre_x,centre_y,centre_z\nlower,0,0,0\nupper,0,0," << 20 * mm / unit << "\n";
    SurfaceFiles files;
    files.lumen = folder.path / "lumen.vtp";
    files.outer_wall = folder.path / "outer.vtp";
    files.openings = folder.path / "names.csv";
    files.metres_per_unit = unit;
    files.roles.inlet = "upper";
    const auto made = surfaces_of(files, {});
    expect_same(made.surfaces.lumen, lumen);
    expect_same(*made.surfaces.outer, outer);
    EXPECT_EQ(made.lumen_parts, 1);
    EXPECT_EQ(made.roles.inlet, "upper");
    ASSERT_EQ(made.surfaces.names.size(), 2U) << name;
    EXPECT_NEAR(norm(made.surfaces.names[1].place - geometry::Point{{0, 0, 20 * mm}}), 0, 1e-12);
    files.roles.inlet = "middle";
    EXPECT_TRUE(says(message_of<InputError>([&] { surfaces_of(files, {}); }), "take one of lower, upper"));
  }
}

TEST(SurfaceFiles, AWallIsGrownWhereNoneIsGiven) {
  const Folder folder;
  geometry::write_surface(tube(5 * mm, 16 * mm, 48, 20), folder.path / "lumen.vtp");
  SurfaceFiles files;
  files.lumen = folder.path / "lumen.vtp";
  files.metres_per_unit = 1;
  files.wall.emplace();
  files.wall->thinnest = files.wall->thickest = 1.5 * mm;
  files.wall->spacing = 0.8 * mm;
  const auto made = surfaces_of(files, {});
  ASSERT_TRUE(made.surfaces.outer);
  for (const auto& p : made.surfaces.outer->points) EXPECT_NEAR(std::hypot(p[0], p[1]), 6.5 * mm, 0.08 * mm);
  for (const auto& p : made.surfaces.lumen.points) EXPECT_LT(std::hypot(p[0], p[1]), 5 * mm + 1e-9);
}

TEST(SurfaceFiles, AFalseLumenThatNoTearJoinsIsASecondPart) {
  const Folder folder;
  auto lumen = tube(4 * mm, 24 * mm, 40, 26);
  for (auto& p : lumen.points) p = p - Vec3<double>{{5 * mm, 0, 12 * mm}};
  auto closed = contour({{5 * mm, 5 * mm, 12 * mm}}, 0.7 * mm, [](const geometry::Point& x) {
    return std::hypot(x[0], x[1], std::max(std::abs(x[2]) - 6 * mm, 0.0)) - 4 * mm;
  });
  for (auto& p : closed.points) p[0] += 5 * mm;
  geometry::write_surface(lumen, folder.path / "lumen.vtp");
  geometry::write_surface(closed, folder.path / "false.vtp");
  geometry::write_surface(tube(14 * mm, 24 * mm, 40, 26), folder.path / "outer.vtp");
  SurfaceFiles files;
  files.lumen = folder.path / "lumen.vtp";
  files.false_lumen = folder.path / "false.vtp";
  files.outer_wall = folder.path / "outer.vtp";
  files.metres_per_unit = 1;
  const auto made = surfaces_of(files, {});
  EXPECT_EQ(made.lumen_parts, 2);
  const auto part = geometry::components(made.surfaces.lumen);
  EXPECT_EQ(*std::max_element(part.begin(), part.end()), 1);
  EXPECT_NEAR(geometry::area(made.surfaces.lumen), geometry::area(lumen) + geometry::area(closed), 1e-9);
}

TEST(PatientComplex, AnotherGenusThanAskedForIsAnErrorAtOnce) {
  ComplexOptions options;
  options.genus = 1;
  const auto text = message_of<InputError>([&] { patient_complex({tube(5 * mm, 20 * mm, 40, 20), {}, {}}, options); });
  EXPECT_TRUE(says(text, "has genus 0, asked for is 1")) << text;
}

TEST(ImageGeometry, AnOpeningAsWideAsTheInletIsAnEndOfTheAorta) {
  const Folder folder;
  const auto image = imaging::testing::image_of(
      [](const geometry::Point& p) { return std::hypot(p[0], p[1]) < 5 * mm && std::abs(p[2]) < 10 * mm ? 1 : 0; },
      {24, 24, 36}, imaging::testing::straight);
  imaging::write_label_image(image, folder.path / "scan.nrrd");
  ImageGeometry geometry;
  geometry.file = folder.path / "scan.nrrd";
  geometry.surface.openings = {{"upper", {{{0, 0, 10 * mm}}, {}}}, {"lower", {{{0, 0, -10 * mm}}, {}}}};
  const auto text = message_of<InputError>([&] { surfaces_of(geometry, {}); });
  EXPECT_TRUE(says(text, "give `aorta_ends: [lower]`")) << text;
}

TEST(ImageGeometry, IsALumenWithAWallAroundIt) {
  const Folder folder;
  const auto image = imaging::testing::image_of(
      [](const geometry::Point& p) { return std::hypot(p[0], p[1]) < 5 * mm && std::abs(p[2]) < 10 * mm ? 4 : 0; },
      {24, 24, 36}, imaging::testing::straight);
  imaging::write_label_image(image, folder.path / "scan.nrrd");
  ImageGeometry geometry;
  geometry.file = folder.path / "scan.nrrd";
  geometry.surface.labels.true_lumen = 4;
  geometry.surface.openings = {{"upper", {{{0, 0, 10 * mm}}, {}}}, {"lower", {{{0, 0, -10 * mm}}, {}}}};
  geometry.surface.inlet = "lower";
  geometry.aorta_ends = {"upper"};
  geometry.wall.thinnest = geometry.wall.thickest = 1.4 * mm;
  geometry.wall.spacing = 0.8 * mm;
  const auto made = surfaces_of(geometry, {});
  EXPECT_EQ(made.roles.inlet, "lower");
  EXPECT_EQ(made.roles.aorta_ends, (std::vector<std::string>{"upper"}));
  ASSERT_EQ(made.surfaces.names.size(), 2U);
  EXPECT_EQ(made.surfaces.names[0].name, "upper");
  EXPECT_NEAR(made.surfaces.names[0].place[2], 10 * mm, 0.35 * mm);
  for (const auto& p : made.surfaces.lumen.points) EXPECT_NEAR(std::hypot(p[0], p[1]), 5 * mm, 0.35 * mm);
  ASSERT_TRUE(made.surfaces.outer);
  for (const auto& p : made.surfaces.outer->points) EXPECT_NEAR(std::hypot(p[0], p[1]), 6.4 * mm, 0.4 * mm);
  // Both end in the same planes.
  for (const auto* surface : {&made.surfaces.lumen, &*made.surfaces.outer}) {
    EXPECT_EQ(geometry::boundary_loops(*surface).size(), 2U);
    for (const auto& p : surface->points) EXPECT_LT(std::abs(p[2]), 10.4 * mm);
  }
}

}  // namespace
}  // namespace tunica::meshing
