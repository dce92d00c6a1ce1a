// The engine on bodies of right angles, whose volumes are exact, and meshes against the surfaces they were made from.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "block_vessel.hpp"
#include "tunica/mesh/boundary.hpp"
#include "tunica/meshing/fidelity.hpp"
#include "tunica/meshing/mesh_report.hpp"
#include "tunica/meshing/tetrahedralise.hpp"
#include "unit/geometry/small_surfaces.hpp"

namespace tunica::meshing {
namespace {

using geometry::Point;

const test::BlockVessel small{.across = 7, .along = 9, .flap_at = 3, .from = 2, .to = 8, .hole = false};

std::set<std::array<geometry::Index, 3>> sorted_triangles(std::vector<geometry::Triangle> triangles) {
  for (auto& t : triangles) std::sort(t.begin(), t.end());
  return {triangles.begin(), triangles.end()};
}
std::vector<geometry::Triangle> surface_of_mesh(const geometry::Tetrahedra& mesh) {
  std::vector<geometry::Triangle> triangles;
  for (const auto& t : geometry::surface_triangles(mesh)) triangles.push_back(t.nodes);
  return triangles;
}

TEST(Fill, KeepsVolumesAndTrianglesOfALumenInTwoParts) {
  // Without a hole in the flap the false lumen is a cavity of its own.
  const auto block = test::block_vessel(small);
  const auto complex = test::complex_of(block);
  ASSERT_NO_THROW(verify(complex));
  const auto mesh = tetrahedralise(complex, [](const Point&) { return 1e-3; }, {});
  for (const int label : {geometry::lumen_label, geometry::wall_label})
    EXPECT_NEAR(test::volume(mesh, label) / test::volume(block, label), 1, 1e-12) << label;
  EXPECT_EQ(sorted_triangles(surface_of_mesh(mesh)), sorted_triangles(complex.triangles));
  for (const auto& t : mesh.elements) EXPECT_GT(mesh::volume(mesh.points, t), 0);
  EXPECT_EQ(mesh.on_curve.size(), mesh.points.size());
  for (std::size_t n = 0; n < mesh.points.size(); ++n) {
    // Lines where three labels meet: the rims of the lumen at both ends.
    const Point x = 1e3 * mesh.points[n];
    const bool in_end = std::min(x[2], 9 - x[2]) < 1e-9;
    const double across = std::max(std::abs(x[0] - 3.5), std::abs(x[1] - 3.5));
    EXPECT_EQ(mesh.on_curve[n], in_end && std::abs(across - 2.5) < 1e-9) << x[0] << " " << x[1] << " " << x[2];
  }
}

TEST(Fill, VolumesDoNotDependOnPlaceAndDirection) {
  auto complex = test::complex_of(test::block_vessel(small));
  const double c = std::cos(0.5), s = std::sin(0.5);
  for (auto& x : complex.points) x = Point{{c * x[0] - s * x[2] + 0.3, x[1] - 0.2, s * x[0] + c * x[2] + 0.1}};
  const auto mesh = tetrahedralise(complex, [](const Point&) { return 1e-3; }, {});
  EXPECT_NEAR(test::volume(mesh, geometry::lumen_label) / volume(complex, Label::lumen), 1, 1e-9);
  EXPECT_NEAR(test::volume(mesh, geometry::wall_label) / volume(complex, Label::wall), 1, 1e-9);
}

/// A lumen of 12 x 12 x 24 mm alone, its sides in triangles of 2 mm.
SurfaceComplex duct() {
  const auto box = mesh::box(6, 6, 12, {{12e-3, 12e-3, 24e-3}}, mesh::RegionKind::lumen);
  return test::complex_of({box.points, box.tetrahedra, std::vector<int>(box.tetrahedra.size(), geometry::lumen_label),
                           std::vector<bool>(box.points.size(), false)});
}

TEST(Fill, ElementsAreSmallWhereSmallOnesAreAskedFor) {
  // From 2 mm at the lower end down to 0.8 mm at the upper one.
  const auto mesh = tetrahedralise(duct(), [](const Point& x) { return 2e-3 - 0.05 * x[2]; }, {});
  double volumes[2] = {0, 0}, counts[2] = {0, 0};
  for (const auto& t : mesh.elements) {
    const auto z = mesh::centroid(mesh.points, t)[2];
    if (z > 8e-3 && z < 16e-3) continue;
    const int half = z < 12e-3 ? 0 : 1;
    volumes[half] += mesh::volume(mesh.points, t);
    counts[half] += 1;
  }
  // Edge lengths of 1.8 and 1 mm on average would give a ratio of 5.8 of the volumes; the triangles given stay.
  EXPECT_GT(volumes[0] / counts[0], 2 * volumes[1] / counts[1]);
  EXPECT_NEAR(test::volume(mesh, geometry::lumen_label), 12e-3 * 12e-3 * 24e-3, 1e-15);
}

TEST(Fill, ALumenNeedsNoWall) {
  const auto mesh = tetrahedralise(duct(), [](const Point&) { return 2e-3; }, {});
  EXPECT_EQ(std::count(mesh.labels.begin(), mesh.labels.end(), geometry::wall_label), 0);
  // Most are well shaped without further ado.
  const mesh::MeshData data{mesh.points, mesh.elements, {}, {}, {}, {}, {}};
  const auto s = shapes(data, 0, std::ssize(mesh.elements));
  const auto below_15 = s.dihedral_histogram[0] + s.dihedral_histogram[1] + s.dihedral_histogram[2];
  EXPECT_LT(static_cast<double>(below_15), 0.05 * static_cast<double>(s.elements));
}

/// A tube and its wall as surfaces, and a mesh of them.
class FidelityTest : public testing::Test {
 protected:
  static constexpr double inner = 5e-3, outer = 6e-3, length = 12e-3;
  static constexpr int around = 40;
  FidelityTest() {
    using geometry::test::tube;
    ComplexOptions options;
    options.sizes.largest = 2e-3;
    prepared_.emplace(patient_complex({tube(inner, length, around, 12, 0),
                                       tube(outer, length, around, 12, 0),
                                       {{"in", {{0, 0, 0}}}, {"out", {{0, 0, length}}}}},
                                      options));
    mesh_ = tetrahedralise(prepared_->complex, [](const Point&) { return 2e-3; }, {.in_lumen = 2, .in_wall = 2});
  }
  Fidelity measure(const geometry::Tetrahedra& mesh) const {
    std::vector<std::array<geometry::Index, 3>> interface, outside;
    for (const auto& t : geometry::surface_triangles(mesh)) {
      const auto z = mesh::centroid(mesh.points, t.nodes)[2];
      const auto across = mesh::area_vector(mesh.points, t.nodes);
      const bool end = std::abs(across[2]) > 0.9 * norm(across) && (z < 1e-3 || z > length - 1e-3);
      if (t.neighbour_label == geometry::wall_label)
        interface.push_back(t.nodes);
      else if (!end)
        outside.push_back(t.nodes);
    }
    return fidelity(mesh, interface, outside, *prepared_);
  }
  std::optional<PreparedSurfaces> prepared_;
  geometry::Tetrahedra mesh_;
};

TEST_F(FidelityTest, VolumesAreThoseOfTheSurfacesGiven) {
  // Prisms on polygons of forty corners.
  const double polygon = 0.5 * around * std::sin(2 * M_PI / around);
  const auto found = measure(mesh_);
  EXPECT_NEAR(found.lumen_volume / (polygon * inner * inner * length), 1, 1e-6);
  EXPECT_NEAR(found.wall_volume / (polygon * (outer * outer - inner * inner) * length), 1, 1e-6);
}

TEST_F(FidelityTest, DistancesAreThoseThatTheMeshWasMovedBy) {
  const auto exact = measure(mesh_);
  EXPECT_LT(exact.lumen.largest_distance, 0.1e-3);
  auto wider = mesh_;
  for (auto& p : wider.points) {
    p[0] *= 1.1;
    p[1] *= 1.1;
  }
  const auto found = measure(wider);
  EXPECT_NEAR(found.lumen.largest_distance, 0.1 * inner, 0.02 * inner);
  EXPECT_NEAR(found.outer.largest_distance, 0.1 * outer, 0.02 * outer);
  EXPECT_GT(found.lumen.largest_per_edge, found.lumen.largest_distance / 2e-3);  // edges are at most 2 mm
  EXPECT_EQ(found.lumen_volume, exact.lumen_volume);                             // of the surfaces, not of the mesh
  // The mesh ends early: its triangles all lie on the surface, and parts of the surface are far from it.
  auto shorter = mesh_;
  for (auto& p : shorter.points) p[2] = std::min(p[2], 0.75 * length);
  EXPECT_NEAR(measure(shorter).lumen.largest_distance, 0.25 * length, 0.05e-3);
}

}  // namespace
}  // namespace tunica::meshing
