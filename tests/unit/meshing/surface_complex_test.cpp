#include "tunica/meshing/surface_complex.hpp"

#include <set>

#include "tunica/geometry/caps.hpp"
#include "tunica/geometry/surface_file.hpp"
#include "tunica/geometry/surface_mending.hpp"
#include "tunica/meshing/grown_wall.hpp"
#include "unit/geometry/small_surfaces.hpp"

namespace tunica::meshing {
namespace {

using namespace geometry::test;

PatientSurfaces two_tubes() {
  return {tube(5e-3, 20e-3, 60, 30), tube(6e-3, 20e-3, 72, 30), {{"in", {{0, 0, 0}}}, {"out", {{0, 0, 20e-3}}}}};
}

TEST(PlaneCap, FillsADiscAndARing) {
  std::vector<geometry::Point> outer, inner;
  for (int i = 0; i < 40; ++i) outer.push_back({{2 * std::cos(M_PI * i / 20), 2 * std::sin(M_PI * i / 20), 1}});
  for (int i = 0; i < 20; ++i) inner.push_back({{std::cos(M_PI * i / 10), std::sin(M_PI * i / 10), 1}});
  const double disc = 20 * 4 * std::sin(M_PI / 20), hole = 10 * std::sin(M_PI / 10);
  for (const double z : {1.0, -1.0}) {
    auto cap = geometry::plane_cap(outer, {}, {{0, 0, z}});
    EXPECT_NEAR(geometry::area(cap), disc, 1e-12);
    for (const auto& t : cap.triangles) EXPECT_GT(z * geometry::area_vector(cap, t)[2], 0);
    EXPECT_GT(smallest_angle_degrees(cap), 20);
    cap = geometry::plane_cap(outer, inner, {{0, 0, z}});
    EXPECT_NEAR(geometry::area(cap), disc - hole, 1e-12);
    EXPECT_EQ(geometry::boundary_loops(cap).size(), 2u);
    for (std::size_t p = 0; p < 60; ++p) EXPECT_EQ(norm(cap.points[p] - (p < 40 ? outer[p] : inner[p - 40])), 0);
  }
  for (auto& p : inner) p[0] += 1.5;
  EXPECT_TRUE(says(message_of<SolverError>([&] { geometry::plane_cap(outer, inner, {{0, 0, 1}}); }), "cross"));
}

TEST(PatientComplex, ClosesAndLabelsATubeWithWall) {
  std::vector<std::string> lines;
  ComplexOptions options;
  options.sizes.largest = 1.5e-3;
  options.log = [&](const std::string& line) { lines.push_back(line); };
  const auto prepared = patient_complex(two_tubes(), options);
  const auto& complex = prepared.complex;
  EXPECT_NO_THROW(verify(complex));
  const double lumen = M_PI * 25e-6 * 20e-3, wall = M_PI * 11e-6 * 20e-3;
  EXPECT_NEAR(volume(complex, Label::lumen) / lumen, 1, 5e-3);
  EXPECT_NEAR(volume(complex, Label::wall) / wall, 1, 5e-3);
  std::set<std::string> names;
  for (const auto& p : complex.patches) names.insert(p.name);
  EXPECT_EQ(names, (std::set<std::string>{"interface", "wall_outer", "lumen_in", "lumen_out", "wall_in", "wall_out"}));
  EXPECT_EQ(complex.rims.size(), 4u);
  for (std::int32_t p = 0; p < std::ssize(complex.patches); ++p)
    if (complex.patches[p].name == "wall_in") {
      EXPECT_NEAR(area(complex, p) / (M_PI * 11e-6), 1, 1e-2);
      EXPECT_GT(smallest_angle_degrees({complex.points, complex.triangles}), 20);
    }
  for (const auto t : prepared.thickness.value) EXPECT_NEAR(t, 1e-3, 0.03e-3);
  EXPECT_NEAR(prepared.sizes({{5e-3, 0, 10e-3}}), 1e-3, 0.1e-3);
  EXPECT_NEAR(prepared.sizes({{6e-3, 0, 10e-3}}), 1.3e-3, 0.1e-3);  // what the lumen allows at 1 mm
  EXPECT_GT(lines.size(), 5u);
}

TEST(PatientComplex, AWrongUnitIsAnError) {
  auto surfaces = two_tubes();
  for (auto* surface : {&surfaces.lumen, &*surfaces.outer})
    for (auto& p : surface->points) p = 1e3 * p;
  surfaces.names.clear();
  EXPECT_TRUE(says(message_of<InputError>([&] { patient_complex(surfaces, {}); }), "length_unit"));
}

TEST(VesselRoles, NamesThatNoOpeningHasAreErrors) {
  const std::vector<geometry::NamedPlace> names = {{"in", {{0, 0, 0}}}, {"out", {{0, 0, 20e-3}}}};
  VesselRoles roles;
  roles.inlet = "out";
  EXPECT_NO_THROW(check_names(roles, names));
  roles.aorta_ends = {"abdominal_aorta"};
  EXPECT_TRUE(says(message_of<InputError>([&] { check_names(roles, names); }), "in, out"));
}

TEST(CheckNesting, WritesPlacesWhereNoFolderIsYet) {
  const Folder folder;
  const auto tubes = two_tubes();
  EXPECT_THROW(geometry::check_nesting(*tubes.outer, tubes.lumen, 0.1e-3, folder.path / "mesh" / "problems.vtp"),
               InputError);
  EXPECT_TRUE(std::filesystem::exists(folder.path / "mesh" / "problems.vtp"));
}

TEST(PatientComplex, WithoutAWall) {
  auto surfaces = two_tubes();
  surfaces.outer.reset();
  const auto complex = patient_complex(surfaces, {}).complex;
  EXPECT_NO_THROW(verify(complex));
  EXPECT_EQ(complex.patches[0].positive, Label::outside);
  EXPECT_EQ(volume(complex, Label::wall), 0);
}

TEST(PatientComplex, WithAGrownWall) {
  const auto lumen = two_lumens();
  GrowthSettings growth;
  growth.thinnest = growth.thickest = 1.5e-3;
  growth.spacing = 0.8e-3;
  ComplexOptions options;
  options.lumen_parts = 2;
  const auto prepared = patient_complex(with_grown_wall(lumen, {}, growth, {}, options), options);
  EXPECT_NO_THROW(verify(prepared.complex));
  const double ball = 4 * M_PI * 64e-9 / 3, tubes = M_PI * 16e-6 * (24e-3 + 12e-3);
  EXPECT_NEAR(volume(prepared.complex, Label::lumen) / (ball + tubes), 1, 1e-2);
  // Between the lumens lies a flap of 2 mm, elsewhere the wall of 1.5 mm.
  double flap = 1, wall = 1;
  for (std::size_t p = 0; p < prepared.lumen.surface().points.size(); ++p)
    if (const auto& x = prepared.lumen.surface().points[p]; std::abs(x[2]) < 5e-3) {
      auto& least = prepared.thickness.flap[p] ? flap : wall;
      least = std::min(least, prepared.thickness.value[p]);
    }
  EXPECT_NEAR(flap, 2e-3, 0.05e-3);
  EXPECT_NEAR(wall, 1.5e-3, 0.15e-3);  // samples every 0.8 mm
}

TEST(PatientComplex, GrownWallIsThinnerAroundTheFalseLumenIfAsked) {
  GrowthSettings growth;
  growth.thinnest = growth.thickest = 1.5e-3;
  growth.false_lumen_wall = 1e-3;
  growth.spacing = 0.5e-3;
  ComplexOptions options;
  options.lumen_parts = 2;
  const auto prepared = patient_complex(with_grown_wall(two_lumens(), {}, growth, {}, options), options);
  std::vector<double> wall;
  for (std::size_t p = 0; p < prepared.thickness.value.size(); ++p)
    if (!prepared.thickness.flap[p] && std::isfinite(prepared.thickness.value[p]))
      wall.push_back(prepared.thickness.value[p]);
  std::sort(wall.begin(), wall.end());
  EXPECT_NEAR(wall[wall.size() / 20], 1e-3, 0.1e-3);
  EXPECT_NEAR(wall[3 * wall.size() / 4], 1.5e-3, 0.1e-3);
}

TEST(PatientComplex, WrittenWithPatches) {
  const Folder folder;
  const auto complex = patient_complex(two_tubes(), {}).complex;
  write_complex(complex, folder.path / "complex.vtp");
  EXPECT_EQ(geometry::read_surface(folder.path / "complex.vtp", 1).triangles, complex.triangles);
}

TEST(Verify, FindsGapsTurnedPatchesAndCrossings) {
  const auto complex = patient_complex(two_tubes(), {}).complex;
  const auto why = [](const SurfaceComplex& broken) { return message_of<SolverError>([&] { verify(broken); }); };
  auto broken = complex;
  broken.triangles.pop_back();
  broken.patch_of.pop_back();
  EXPECT_TRUE(says(why(broken), "do not close"));
  broken = complex;
  std::swap(broken.patches[2].negative, broken.patches[2].positive);
  EXPECT_TRUE(says(why(broken), "do not close"));
  broken = complex;
  broken.points[surface_of(complex, PatchKind::interface).triangles[100][0]] = {{20e-3, 0, 10e-3}};
  EXPECT_TRUE(says(why(broken), "pairs of triangles cross"));
}

}  // namespace
}  // namespace tunica::meshing
