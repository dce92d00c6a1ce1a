#include "tunica/artifacts/prestress_file.hpp"

#include <gtest/gtest.h>

#include "temporary_folder.hpp"
#include "tunica/base/error.hpp"
#include "tunica/mesh/generate.hpp"
#include "tunica/mesh/submesh.hpp"

namespace tunica::artifacts {
namespace {

/// A tube's wall in a mesh that has the lumen as well, and the file of a prestress of the wall alone whose coordinates
/// are `shift` away from it.
struct Example {
  test::TemporaryFolder folder;
  mesh::MeshData whole = mesh::tube({.radius = 5e-3,
                                     .length = 20e-3,
                                     .wall_thickness = 1e-3,
                                     .cells_around = 8,
                                     .cells_radial = 1,
                                     .cells_along = 4,
                                     .cells_through_wall = 1});
  std::filesystem::path file = folder.path() / "wall.vtu";

  explicit Example(double shift) {
    auto wall = mesh::submesh(whole, mesh::RegionKind::wall).data;
    for (auto& x : wall.points) x[0] += shift;
    std::vector<double> values(6 * wall.tetrahedra.size(), 7.0);
    write_prestress(file, wall, wall::PrestressKind::stress, values);
  }
};

TEST(PrestressFile, OfTheWallAloneFitsTheWallBesideALumen) {
  // What the interface moves its nodes by, and more than coordinates in single precision are rounded by.
  for (const double shift : {0.0, 1e-9, 1e-6}) {
    Example e(shift);
    ASSERT_NO_THROW(read_prestress(e.file, e.whole)) << shift;
    EXPECT_EQ(e.whole.fields.back().values.back(), 7.0);
  }
}

TEST(PrestressFile, OfAnotherWallIsRefused) {
  Example e(1e-4);
  EXPECT_THROW(read_prestress(e.file, e.whole), InputError);
  ASSERT_NO_THROW(read_prestress(e.file, e.whole, 0.2)) << "where the interface may be as far apart";
}

}  // namespace
}  // namespace tunica::artifacts
