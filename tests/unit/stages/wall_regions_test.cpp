#include "tunica/stages/import/fibre_angle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "temporary_folder.hpp"
#include "tunica/base/error.hpp"
#include "tunica/mesh/generate.hpp"
#include "tunica/mesh_io/volume_arrays.hpp"

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
    EXPECT_NEAR(fibre_angle(files()), angle, 1e-6);
  }
}

TEST_F(FibreAngle, ThatDiffersIsMissingPhysics) {
  write("f1.vtu", [](std::size_t) { return 0.0; });
  write("f2.vtu", [](std::size_t e) { return e == 3 ? 0.8 : 0.7; });
  const auto message = test::message_of<InputError>([&] { fibre_angle(files()); });
  EXPECT_NE(message.find("solver.xml:12 Fiber_direction_file_path"), std::string::npos) << message;
  EXPECT_NE(message.find("from 40.11 to 45.84 degrees"), std::string::npos) << message;
}

}  // namespace

}  // namespace tunica::stages
