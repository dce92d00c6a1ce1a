// The preview of a mesh: openings and tears as the labels have them, before anything is remeshed.
#include "tunica/stages/meshing/preview.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "temporary_folder.hpp"
#include "tunica/imaging/label_image.hpp"
#include "tunica/meshing/geometry.hpp"

namespace tunica::stages {
namespace {

constexpr double mm = 1e-3;

/// A tube of radius 7 mm between z = -20 and 20 mm with a false lumen behind a flap with two holes of 3 mm radius.
std::int16_t label_at(const geometry::Point& p) {
  if (std::hypot(p[0], p[1]) >= 7 * mm || std::abs(p[2]) >= 20 * mm) return 0;
  const bool hole = std::hypot(p[1], p[2] - 8 * mm) < 3 * mm || std::hypot(p[1], p[2] + 8 * mm) < 3 * mm;
  const bool wall =
      p[0] < 1.05 * mm && std::abs(p[2]) < 16 * mm && (std::abs(p[0]) < 1.05 * mm ? !hole : std::abs(p[2]) > 14 * mm);
  if (wall) return 0;
  return p[0] < 0 && std::abs(p[2]) < 14 * mm ? 2 : 1;
}

imaging::LabelImage image() {
  const imaging::Size3 size{26, 26, 62};
  imaging::LabelImage result{{size, {}, {{{{0.7 * mm, 0, 0}}, {{0, 0.7 * mm, 0}}, {{0, 0, 0.7 * mm}}}}}, {}};
  for (int d = 0; d < 3; ++d) result.frame.origin[d] = -0.35 * mm * static_cast<double>(size[d] - 1);
  for (std::int64_t i = 0; i < result.frame.count(); ++i)
    result.labels.push_back(label_at(result.frame.place(result.frame.voxel(i))));
  return result;
}

TEST(Preview, ShowsEndsAndTearsOfLabels) {
  const test::TemporaryFolder folder;
  imaging::write_label_image(image(), folder.path() / "labels.nrrd");
  meshing::ImageGeometry geometry;
  geometry.file = folder.path() / "labels.nrrd";
  geometry.surface.labels = {1, 2};
  geometry.surface.openings = {{"inlet", {{{0, 0, -20 * mm}}, {}}}, {"outlet", {{{0, 0, 20 * mm}}, {}}}};
  geometry.aorta_ends = {"outlet"};
  case_file::MeshCase mesh_case;
  mesh_case.geometry = meshing::Geometry{geometry};
  mesh_case.output = folder.path() / "mesh";
  const auto text = preview_to_files(mesh_case, [](const std::string&) {});
  EXPECT_NE(text.find("inlet"), std::string::npos) << text;
  EXPECT_NE(text.find("genus 1"), std::string::npos) << text;
  std::size_t tears = 0;
  for (auto at = text.find("tear of"); at != std::string::npos; at = text.find("tear of", at + 1)) ++tears;
  EXPECT_EQ(tears, 2U) << text;
  std::ifstream png(mesh_case.output / "preview.png", std::ios::binary);
  std::string start(4, '\0');
  png.read(start.data(), 4);
  EXPECT_EQ(start, "\x89PNG");
  EXPECT_TRUE(std::filesystem::exists(mesh_case.output / "preview.html"));
  EXPECT_FALSE(std::filesystem::exists(mesh_case.output / "report.json"));
}

}  // namespace
}  // namespace tunica::stages
