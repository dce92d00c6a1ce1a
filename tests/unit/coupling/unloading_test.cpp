#include "tunica/coupling/unloading.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tunica/base/error.hpp"
#include "tunica/coupling/settings.hpp"
#include "tunica/distributed/distributed_mesh.hpp"
#include "tunica/mesh/edge_nodes.hpp"
#include "tunica/mesh/generate.hpp"

namespace tunica::coupling {
namespace {

const Mat3<double> turn = [] {  // by 50 degrees about (1, 2, 2) / 3
  const double c = std::cos(50 * M_PI / 180), s = std::sin(50 * M_PI / 180);
  const Vec3<double> n{{1 / 3.0, 2 / 3.0, 2 / 3.0}};
  Mat3<double> R;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) R(i, j) = (1 - c) * n[i] * n[j] + (i == j ? c : 0.0);
  R(0, 1) -= s * n[2], R(1, 0) += s * n[2], R(0, 2) += s * n[1], R(2, 0) -= s * n[1], R(1, 2) -= s * n[0],
      R(2, 1) += s * n[0];
  return R;
}();

const Mat3<double> stretch{{{1.3, 0.2, 0.0}, {0.2, 0.9, -0.1}, {0.0, -0.1, 1.1}}};

double distance(const Mat3<double>& a, const Mat3<double>& b) {
  const Mat3<double> d = a + (-1.0) * b;
  return std::sqrt(double_dot(d, d));
}

TEST(Unloading, RotationIsThatOfThePolarDecomposition) {
  EXPECT_LT(distance(rotation_of(turn * stretch), turn), 1e-12);
  EXPECT_LT(distance(rotation_of(stretch * turn), turn), 1e-12);
  EXPECT_LT(distance(rotation_of(1e-6 * turn), turn), 1e-12);
}

class UnloadedBlock : public testing::TestWithParam<bool> {
 protected:
  UnloadedBlock() {
    auto data = mesh::box(1, 2, 1, {{1.0, 2.0, 1.0}}, mesh::RegionKind::wall);
    if (GetParam()) mesh::add_edge_nodes(data);
    mesh = distributed::distribute(data, MPI_COMM_WORLD);
  }
  /// U of x = F X.
  std::vector<double> motion(const Mat3<double>& F) const {
    std::vector<double> U;
    const Mat3<double> G = inverse(F);
    for (const auto& x : mesh.points) {
      const Vec3<double> u = x - G * x;
      U.insert(U.end(), {u[0], u[1], u[2]});
    }
    return U;
  }
  distributed::DistributedMesh mesh;
};
INSTANTIATE_TEST_SUITE_P(Elements, UnloadedBlock, testing::Bool(),
                         [](const auto& elements) { return elements.param ? "quadratic" : "linear"; });

// Directions of fibres turn with the unloaded shape, so that of a motion F = V R the law sees V alone.
TEST_P(UnloadedBlock, PrestretchIsTheLeftStretch) {
  const auto prestress = prestretch_of(mesh, motion(stretch * turn));
  ASSERT_TRUE(prestress);
  EXPECT_EQ(prestress->kind, wall::PrestressKind::stretch);
  std::size_t count = 0;
  for (const auto& values : prestress->values)
    for (std::size_t k = 0; k < values.size(); k += 9, ++count) {
      Mat3<double> V;
      for (std::size_t c = 0; c < 9; ++c) V(static_cast<int>(c / 3), static_cast<int>(c % 3)) = values[k + c];
      EXPECT_LT(distance(V, stretch), 1e-12);
    }
  EXPECT_EQ(count, mesh.regions[0].elements.size() * static_cast<std::size_t>(prestress_points(GetParam())));
}

TEST_P(UnloadedBlock, InvertedElementsAreNoShape) {
  Mat3<double> mirror = identity<double>();
  mirror(0, 0) = -0.5;
  EXPECT_EQ(prestretch_of(mesh, motion(mirror)).has_value(), mesh.regions[0].elements.empty());
}

TEST(Unloading, KeysThatHaveNoEffectAreRefused) {
  const auto read = [](const std::string& text) { return config::parse_text(PrestressSettings::schema(), text).value; };
  EXPECT_EQ(read("method: inverse\nfallback: stretch\n").fallback, PrestressSettings::Fallback::stretch);
  EXPECT_THROW(read("method: stretch\nfallback: stress\n"), InputError);
  EXPECT_THROW(read("method: inverse\nexclude: [flap]\n"), InputError);
}

}  // namespace
}  // namespace tunica::coupling
