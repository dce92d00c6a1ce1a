#include "tunica/stages/import/nodal_prestress.hpp"

#include <gtest/gtest.h>

#include "temporary_folder.hpp"
#include "tunica/artifacts/prestress_file.hpp"
#include "tunica/base/error.hpp"
#include "tunica/mesh/generate.hpp"
#include "tunica/mesh_io/simvascular.hpp"
#include "tunica/mesh_io/volume_arrays.hpp"

namespace tunica::stages {

namespace {

using mesh::RegionKind;
using mesh_io::VolumeArray;

/// A component of a stress that is linear in space [dyn/cm^2], x in m.
double stress(const Vec3<double>& x, int component) {
  return 1e4 * (1 + component) + 1e6 * x[0] - 2e6 * x[component % 3];
}

class NodalPrestress : public testing::Test {
 protected:
  void write(double stretch) const {
    auto other = wall;
    for (auto& x : other.points) x[0] *= stretch;
    VolumeArray array{.name = "Stress", .of = VolumeArray::Of::nodes, .components = 6};
    for (const auto& x : wall.points)
      for (int i = 0; i < 6; ++i) array.values.push_back(stress(x, i));
    mesh_io::write_volume_array(folder.path() / "nodal.vtu", other, RegionKind::wall, 0.01, array);
  }
  void convert() const {
    write_element_prestress(folder.path() / "nodal.vtu", 0.1, meshes, folder.path() / "wall.vtu");
  }

  test::TemporaryFolder folder;
  mesh::MeshData wall = mesh::box(2, 3, 2, {{0.02, 0.03, 0.01}}, RegionKind::wall);
  case_file::MeshSettings meshes;

  void SetUp() override {
    mesh_io::write_simvascular(folder.path() / "mesh", wall, RegionKind::wall, 0.01);
    meshes.metres_per_unit = 0.01;
    meshes.wall.emplace().simvascular = folder.path() / "mesh";
  }
};

TEST_F(NodalPrestress, GivesEachElementTheLinearFunctionAtItsMiddle) {
  write(1.0);
  convert();
  auto data = wall;
  artifacts::read_prestress(folder.path() / "wall.vtu", data, 1);
  const auto& values = data.fields.at(0).values;
  for (std::size_t e = 0; e < data.tetrahedra.size(); ++e) {
    Vec3<double> middle{};
    for (const auto node : data.tetrahedra[e]) middle = middle + 0.25 * data.points[static_cast<std::size_t>(node)];
    for (int i = 0; i < 6; ++i)
      EXPECT_NEAR(values[6 * e + static_cast<std::size_t>(i)], 0.1 * stress(middle, i), 1e-8) << e;
  }
}

TEST_F(NodalPrestress, OfCellsIsTakenAsItIs) {
  VolumeArray array{.name = "Stress", .of = VolumeArray::Of::elements, .components = 6};
  for (std::size_t k = 0; k < 6 * wall.tetrahedra.size(); ++k) array.values.push_back(static_cast<double>(k));
  mesh_io::write_volume_array(folder.path() / "nodal.vtu", wall, RegionKind::wall, 0.01, array);
  convert();
  auto data = wall;
  artifacts::read_prestress(folder.path() / "wall.vtu", data, 1);
  for (std::size_t k = 0; k < 6 * wall.tetrahedra.size(); ++k)
    EXPECT_DOUBLE_EQ(data.fields.at(0).values[k], 0.1 * static_cast<double>(k));
}

TEST_F(NodalPrestress, WithoutTheArrayIsAnError) {
  VolumeArray array{.name = "Other", .of = VolumeArray::Of::elements, .components = 6};
  array.values.assign(6 * wall.tetrahedra.size(), 1.0);
  mesh_io::write_volume_array(folder.path() / "nodal.vtu", wall, RegionKind::wall, 0.01, array);
  EXPECT_NE(test::message_of<InputError>([&] { convert(); }).find("called Stress"), std::string::npos);
}

TEST_F(NodalPrestress, OfAnotherWallIsAnError) {
  write(1.01);
  EXPECT_THROW(convert(), InputError);
}

}  // namespace

}  // namespace tunica::stages
