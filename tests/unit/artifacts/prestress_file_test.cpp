#include "tunica/artifacts/prestress_file.hpp"

#include <gtest/gtest.h>

#include "temporary_folder.hpp"
#include "tunica/base/error.hpp"
#include "tunica/mesh/edge_nodes.hpp"
#include "tunica/mesh/generate.hpp"
#include "tunica/mesh/submesh.hpp"
#include "tunica/mesh_io/vtk_files.hpp"

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

  explicit Example(double shift, bool quadratic = false) {
    auto wall = mesh::submesh(whole, mesh::RegionKind::wall).data;
    for (auto& x : wall.points) x[0] += shift;
    if (quadratic) mesh::add_edge_nodes(wall);
    std::vector<double> values(6 * wall.tetrahedra.size() * (quadratic ? 4 : 1), 7.0);
    for (std::size_t k = 0; k < values.size() && quadratic; ++k) values[k] = static_cast<double>(k);
    write_prestress(file, wall, wall::PrestressKind::stress, values);
  }
};

std::string refusal(Example& e, int points) {
  try {
    read_prestress(e.file, e.whole, points);
  } catch (const InputError& error) {
    return error.what();
  }
  return "not refused";
}

TEST(PrestressFile, OfTheWallAloneFitsTheWallBesideALumen) {
  // What the interface moves its nodes by, and more than coordinates in single precision are rounded by.
  for (const double shift : {0.0, 1e-9, 1e-6}) {
    Example e(shift);
    ASSERT_NO_THROW(read_prestress(e.file, e.whole, 1)) << shift;
    EXPECT_EQ(e.whole.fields.back().values.back(), 7.0);
  }
}

TEST(PrestressFile, OfAnotherWallIsRefused) {
  Example e(1e-4);
  EXPECT_THROW(read_prestress(e.file, e.whole, 1), InputError);
  ASSERT_NO_THROW(read_prestress(e.file, e.whole, 1, 0.2)) << "where the interface may be as far apart";
}

TEST(PrestressFile, HoldsEveryPointOfQuadraticElementsAndTheirMean) {
  Example e(0.0, true);
  read_prestress(e.file, e.whole, 4);
  const auto& found = e.whole.fields.back();
  EXPECT_EQ(found.components, 24);
  const auto part = mesh::submesh(e.whole, mesh::RegionKind::wall);
  for (std::size_t k = 0; k < part.elements.size(); ++k)
    for (std::size_t c = 0; c < 24; ++c)
      EXPECT_EQ(found.values[24 * static_cast<std::size_t>(part.elements[k]) + c], static_cast<double>(24 * k + c));
  const auto shown = mesh_io::read_vtk_volume(e.file, {"prestress", "prestress 2", "von Mises stress [kPa]"});
  EXPECT_EQ(shown.fields[0].values[6 + 1], 24 + 1 + 6 * 1.5);
  EXPECT_EQ(shown.fields[1].values[6 + 1], 24 + 1 + 6);
  EXPECT_GT(shown.points.size(), part.nodes.size()) << "nodes on edges are missing";
}

TEST(PrestressFile, OfTheOtherElementsIsRefused) {
  const auto expect_refused = [](bool quadratic, const char* cure) {
    Example e(0.0, quadratic);
    const std::string text = refusal(e, quadratic ? 1 : 4);
    for (const char* part : {"wall.vtu", "tunica prestress CASE --overwrite", cure})
      EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  expect_refused(false, "set `elements: linear`");
  expect_refused(true, "set `elements: quadratic`");
}

}  // namespace
}  // namespace tunica::artifacts
