#include "tunica/mesh/quality.hpp"

#include <cmath>

#include "temporary_folder.hpp"
#include "tunica/base/error.hpp"
#include "tunica/mesh/generate.hpp"
#include "unit/mesh/check_mesh.hpp"

namespace tunica::mesh {

using test::message_of;

TEST(Quality, RegularTetrahedronIsPerfectAtAnySize) {
  for (double s : {1e-4, 1.0}) {
    const auto q = quality({{{{s, s, s}}, {{-s, -s, s}}, {{s, -s, -s}}, {{-s, s, -s}}}});
    EXPECT_NEAR(std::abs(q.volume), 8.0 / 3 * s * s * s, 1e-14 * s * s * s);
    EXPECT_NEAR(std::abs(q.scaled_jacobian), 1, 1e-14);
    EXPECT_NEAR(q.smallest_dihedral, std::acos(1.0 / 3) * 180 / M_PI, 1e-12);
    EXPECT_NEAR(std::abs(q.radius_ratio), 1, 1e-14);
  }
}

TEST(Quality, CornerOfACube) {
  const auto q = quality({{{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}}});
  EXPECT_NEAR(q.volume, 1.0 / 6, 1e-15);
  EXPECT_NEAR(q.scaled_jacobian, std::sqrt(2.0) / 2, 1e-15);
  EXPECT_NEAR(q.smallest_dihedral, std::acos(1 / std::sqrt(3.0)) * 180 / M_PI, 1e-12);
  // Inradius 1 / (3 + sqrt 3), circumradius sqrt(3) / 2.
  EXPECT_NEAR(q.radius_ratio, 3 / (3 + std::sqrt(3.0)) / (std::sqrt(3.0) / 2), 1e-14);
}

TEST(Quality, SliverIsSeenByEveryMeasure) {
  const double h = 1e-3;
  const auto q = quality({{{{0, 0, 0}}, {{1, 0, h}}, {{1, 1, 0}}, {{0, 1, h}}}});
  EXPECT_LT(std::abs(q.scaled_jacobian), 0.01);
  EXPECT_LT(q.smallest_dihedral, 1);
  EXPECT_LT(std::abs(q.radius_ratio), 0.01);
  const auto flat = quality({{{{0, 0, 0}}, {{1, 0, 0}}, {{1, 1, 0}}, {{0, 1, 0}}}});
  EXPECT_EQ(flat.volume, 0);
  EXPECT_EQ(flat.smallest_dihedral, 0);
}

TEST(Quality, ReportCountsSliversAndHistogram) {
  auto mesh = box(2, 2, 2, {{1, 1, 0.02}}, RegionKind::wall);
  const auto report = check_quality(mesh, 0, {.sliver_dihedral = 5}, "block");
  EXPECT_EQ(report.elements, 48);
  EXPECT_GT(report.slivers, 0);
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_NE(report.warnings[0].find("elements have a dihedral angle below 5 degrees"), std::string::npos);
  EXPECT_NE(report.summary.find("100.00 %"), std::string::npos) << report.summary;
  EXPECT_NEAR(report.smallest_volume, 0.02 / 48, 1e-15);
  EXPECT_TRUE(check_quality(box(2, 2, 2, {{1, 1, 1}}, RegionKind::wall), -1, {}, "cube").warnings.empty());
}

TEST(Quality, InvertedElementsAreRefusedWithPlace) {
  auto mesh = box(1, 1, 1, {{1, 1, 1}}, RegionKind::wall);
  std::swap(mesh.tetrahedra[3][0], mesh.tetrahedra[3][1]);
  const auto message = message_of<InputError>([&] { check_quality(mesh, 0, {}, "block"); });
  const auto c = mesh::centroid(mesh.points, mesh.tetrahedra[3]);
  const Vec3<double> places[] = {c};
  EXPECT_NE(message.find("1 of 6 elements have no positive volume: " + list_places(places)), std::string::npos)
      << message;
  EXPECT_THROW(orient_elements(mesh, "block"), InputError);
}

TEST(Quality, OrientationIsTurnedWhenAllElementsAgree) {
  auto mesh = box(1, 1, 1, {{1, 1, 1}}, RegionKind::wall);
  EXPECT_EQ(orient_elements(mesh, "block"), "");
  for (auto& t : mesh.tetrahedra) std::swap(t[0], t[1]);
  EXPECT_NE(orient_elements(mesh, "block").find("all 6 elements"), std::string::npos);
  testing::expect_sound(mesh);
  for (int e = 0; e < 5; ++e) std::swap(mesh.tetrahedra[e][0], mesh.tetrahedra[e][1]);
  const auto message = message_of<InputError>([&] { orient_elements(mesh, "block"); });
  EXPECT_NE(message.find("1 of 6 elements are inverted or flat (0 of them flat): element 6"), std::string::npos)
      << message;
}

}  // namespace tunica::mesh
