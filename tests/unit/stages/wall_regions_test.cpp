#include "tunica/stages/import/wall_regions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "temporary_folder.hpp"
#include "tunica/base/error.hpp"
#include "tunica/mesh/generate.hpp"
#include "tunica/mesh_io/simvascular.hpp"
#include "tunica/mesh_io/volume_arrays.hpp"
#include "tunica/mesh_io/vtk_files.hpp"

namespace tunica::stages {

namespace {

class FibreAngle : public testing::Test {
 protected:
  /// Directions in the plane across an axis that differs from element to element, `angle(e)` from the first one.
  template <class Angle>
  void write(const char* name, const Angle& angle) const {
    mesh_io::VolumeArray array{.name = "FIB_DIR", .components = 3};
    for (std::size_t e = 0; e < box.tetrahedra.size(); ++e) {
      const double phi = 0.3 * static_cast<double>(e) + angle(e), tilt = 0.2 * static_cast<double>(e);
      for (const double v : {std::cos(phi), std::sin(phi) * std::cos(tilt), std::sin(phi) * std::sin(tilt)})
        array.values.push_back(2.0 * v);
    }
    mesh_io::write_volume_array(folder.path() / name, box, mesh::RegionKind::wall, 1.0, array);
  }
  peer_cases::FibreFiles files() const {
    return {folder.path() / "f1.vtu", folder.path() / "f2.vtu", "solver.xml:12 Fiber_direction_file_path"};
  }
  test::TemporaryFolder folder;
  mesh::MeshData box = mesh::box(2, 1, 1, {{1, 1, 1}}, mesh::RegionKind::wall);
};

TEST_F(FibreAngle, IsThatBetweenTheFamilies) {
  write("f1.vtu", [](std::size_t) { return 0.0; });
  for (const double angle : {0.0, 0.7, 1.9, std::numbers::pi}) {
    write("f2.vtu", [&](std::size_t) { return angle; });
    const auto angles = fibre_angles(files());
    ASSERT_EQ(angles.angles.size(), 1u);
    EXPECT_NEAR(angles.angles[0], angle, 1e-6);
  }
}

TEST_F(FibreAngle, MakesClassesWhereItDiffers) {
  write("f1.vtu", [](std::size_t) { return 0.0; });
  write("f2.vtu", [](std::size_t e) { return e == 3 ? 0.8 : 0.7; });
  const auto two = fibre_angles(files());
  ASSERT_EQ(two.angles.size(), 2u);
  EXPECT_NEAR(two.angles[0], 0.7, 1e-6);
  EXPECT_NEAR(two.angles[1], 0.8, 1e-6);
  for (std::size_t e = 0; e < two.class_of.size(); ++e) EXPECT_EQ(two.class_of[e], e == 3 ? 1 : 0);
  EXPECT_LT(two.largest_deviation, 1e-6);
  const auto any = [](std::size_t e) { return 0.2 + 0.1 * static_cast<double>(e * e % 7); };
  write("f2.vtu", any);
  const auto many = fibre_angles(files());
  for (std::size_t e = 0; e < many.class_of.size(); ++e)
    EXPECT_NEAR(many.angles.at(static_cast<std::size_t>(many.class_of[e])), any(e), many.largest_deviation + 1e-6);
  EXPECT_LE(many.largest_deviation, 0.006);
}

TEST_F(FibreAngle, RegionsAreWrittenByDomainAndClass) {
  mesh_io::write_simvascular(folder.path() / "wall", box, mesh::RegionKind::wall, 0.01);
  case_file::MeshSettings meshes;
  meshes.metres_per_unit = 0.01;
  meshes.wall.emplace().simvascular = folder.path() / "wall";
  FibreAngles angles{.angles = {0.1, 0.2}, .class_of = {}};
  std::string list;
  for (std::size_t e = 0; e < box.tetrahedra.size(); ++e) {
    angles.class_of.push_back(static_cast<std::int32_t>(e % 2));
    list += e < 3 ? "1\n" : "2 ";
  }
  std::ofstream(folder.path() / "domains.dat") << list;
  peer_cases::WallRegions wanted{folder.path() / "domains.dat", {1, 2}, "solver.xml:5 Domain_file_path", "regions.vtu"};
  write_wall_regions(wanted, angles, meshes, folder.path());
  const auto written = mesh_io::read_vtk_volume(folder.path() / "regions.vtu", {"REGION"});
  const auto volume = mesh_io::read_vtk_volume(folder.path() / "wall" / "mesh-complete.mesh.vtu");
  for (std::size_t n = 0; n < volume.points.size(); ++n)
    EXPECT_LT(norm(written.points.at(n) - volume.points[n]), 1e-6) << "in the unit of the meshes";
  const auto& values = written.fields.at(0).values;
  ASSERT_EQ(values.size(), box.tetrahedra.size());
  for (std::size_t e = 0; e < values.size(); ++e)
    EXPECT_EQ(values[e], (e < 3 ? 1000 : 2000) + static_cast<double>(e % 2));
  wanted.known = {1};
  EXPECT_NE(test::message_of<InputError>([&] {
              write_wall_regions(wanted, angles, meshes, folder.path());
            }).find("domains.dat"),
            std::string::npos);
  std::ofstream(folder.path() / "domains.dat") << "1 1\n";
  EXPECT_THROW(write_wall_regions(wanted, angles, meshes, folder.path()), InputError);
}

}  // namespace

}  // namespace tunica::stages
