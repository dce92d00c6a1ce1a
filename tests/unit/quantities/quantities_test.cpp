// On a tube of blood and wall: quantities of motions whose gradients are the same everywhere.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "tunica/coupling/nodal.hpp"
#include "tunica/distributed/distributed_mesh.hpp"
#include "tunica/mesh/edge_nodes.hpp"
#include "tunica/mesh/generate.hpp"
#include "tunica/quantities/quantity.hpp"
#include "tunica/wall/parameters.hpp"

namespace tunica::quantities {
namespace {

using coupling::Problem;
using coupling::State;
using mesh::RegionKind;

constexpr double viscosity = 4e-3;  // Pa s

mesh::MeshData tube(bool quadratic) {
  auto data = mesh::tube({.radius = 0.005,
                          .length = 0.02,
                          .wall_thickness = 0.001,
                          .cells_around = 8,
                          .cells_radial = 1,
                          .cells_along = 5,
                          .cells_through_wall = 1});
  if (quadratic) mesh::add_edge_nodes(data);
  return data;
}

coupling::ProblemInput blood_and_wall() {
  coupling::ProblemInput in;
  in.fluid = fluid::Parameters{.density = 1000, .viscosity = fluid::Newtonian{viscosity}};
  in.boundary.fluid = in.fluid;
  in.wall = wall::Parameters{};
  in.wall->element = wall::Element::displacement;
  in.wall->density = 1200;
  auto& law = std::get<wall::NeoHookeParameters>(in.wall->material);
  law.elastic.young_modulus = 3e5;
  law.elastic.poisson_ratio = 0.3;
  in.boundary.wall_has_pressure = false;
  in.boundary.interfaces = {{"lumen_wall", "wall_inner"}};
  in.boundary.conditions = {{"lumen_inlet", bc::Pressure{bc::WaveformInput{1000.0}}},
                            {"lumen_outlet", bc::Pressure{bc::WaveformInput{0.0}}},
                            {"wall_inlet", bc::Fixed{}},
                            {"wall_outlet", bc::Fixed{}},
                            {"wall_outer", bc::Free{}}};
  return in;
}

Mat3<double> tensor(const std::array<double, 9>& rows) {
  Mat3<double> t;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) t(i, j) = rows[static_cast<std::size_t>(3 * i + j)];
  return t;
}

/// Velocity gradient, displacement gradient and pressure that are the same everywhere.
const Mat3<double> A = tensor({2, 3, -1, 5, -4, 7, 6, -2, 2}),
                   H = tensor({0.1, 0.05, 0, -0.02, 0.2, 0.03, 0.04, 0, -0.1});
constexpr double p = 1300;

class Quantities : public testing::TestWithParam<bool> {
 protected:
  Quantities()
      : mesh_(distributed::distribute(tube(GetParam()), MPI_COMM_WORLD)),
        problem_(mesh_, blood_and_wall()),
        inside_(inside_of(problem_)),
        state_(problem_.initial_state()) {
    for (std::int32_t n = 0; n < mesh_.nodes(); ++n) {
      const Vec3<double> u = H * mesh_.points[n], v = A * (mesh_.points[n] + u);
      for (int i = 0; i < 3; ++i) {
        state_.velocity_pressure[coupling::at(n) + static_cast<std::size_t>(i)] = v[i];
        state_.displacement[coupling::at(n) + static_cast<std::size_t>(i)] = u[i];
      }
      state_.velocity_pressure[coupling::at(n) + 3] = p;
    }
    wall_ = problem_.fields_with_pressure(state_);
    moment_.emplace(problem_, inside_, state_, wall_);
  }

  std::size_t region(RegionKind kind) const {
    std::size_t r = 0;
    while (mesh_.regions[r].kind != kind) ++r;
    return r;
  }
  /// The first array of a quantity.
  std::vector<double> values(const std::string& key) {
    const auto* quantity = find(key);
    if (!quantity) throw std::invalid_argument(key);
    const bool lumen = quantity->place == Place::lumen_nodes;
    const auto all = quantity->values(*moment_, region(lumen ? RegionKind::lumen : RegionKind::wall));
    const auto seen = all.at(0).values();
    return {seen.begin(), seen.end()};
  }
  /// Every entry of each of the nine (or three, or one) components is that of `expected`.
  void expect_everywhere(const std::string& key, const std::vector<double>& expected, double tolerance) {
    const auto found = values(key);
    ASSERT_EQ(found.size() % expected.size(), 0u);
    for (std::size_t i = 0; i < found.size(); ++i)
      ASSERT_NEAR(found[i], expected[i % expected.size()], tolerance) << key << " " << i;
  }
  /// Calls f(local node) for the nodes of the lumen.
  template <class F>
  void for_lumen_nodes(const F& f) const {
    const auto& lumen = mesh_.regions[region(RegionKind::lumen)];
    std::set<std::int32_t> nodes;
    for (const auto& element : lumen.elements) nodes.insert(element.begin(), element.end());
    for (const auto& edges : lumen.edges) nodes.insert(edges.begin(), edges.end());
    for (const auto node : nodes) f(node);
  }

  distributed::DistributedMesh mesh_;
  Problem problem_;
  std::vector<InsideTriangle> inside_;
  State state_;
  coupling::FieldsView wall_;
  std::optional<Moment> moment_;
};

std::vector<double> rows(const Mat3<double>& t) {
  std::vector<double> r(9);
  put(t, r.data());
  return r;
}

TEST_P(Quantities, GradientAndVorticityOfALinearVelocity) {
  const auto gradients = values("velocity_gradient"), vorticity = values("vorticity");
  for_lumen_nodes([&](std::int32_t node) {
    for (std::size_t c = 0; c < 9; ++c)
      EXPECT_NEAR(gradients[9 * static_cast<std::size_t>(node) + c], rows(A)[c], 1e-10);
    const Vec3<double> curl{{A(2, 1) - A(1, 2), A(0, 2) - A(2, 0), A(1, 0) - A(0, 1)}};
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(vorticity[3 * static_cast<std::size_t>(node) + i], curl[i], 1e-10);
  });
}

// On the inside traction is pressure along the normal and shear across it; off the inside there is none.
TEST_P(Quantities, TractionIsPressureAndShear) {
  const auto traction = values("traction"), shear = values("wall_shear_stress");
  std::int64_t on_wall = 0;
  for_lumen_nodes([&](std::int32_t node) {
    const auto at = 3 * static_cast<std::size_t>(node);
    const Vec3<double> pressure{
        {traction[at] - shear[at], traction[at + 1] - shear[at + 1], traction[at + 2] - shear[at + 2]}};
    const double size = norm(pressure);
    if (size == 0) return;
    ++on_wall;
    EXPECT_NEAR(size, p, 1e-9 * p);
    const Vec3<double> x = mesh_.points[node];
    EXPECT_GT(pressure[0] * x[0] + pressure[1] * x[1], 0.9 * p * std::hypot(x[0], x[1]) * 0.9);
  });
  std::int64_t all = 0;
  MPI_Allreduce(&on_wall, &all, 1, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
  EXPECT_GT(all, 40);
}

TEST_P(Quantities, DeformationOfALinearDisplacement) {
  const Mat3<double> F = H + identity<double>();
  const Mat3<double> C = transpose(F) * F;
  expect_everywhere("deformation_gradient", rows(F), 1e-12);
  expect_everywhere("green_lagrange_strain", rows(0.5 * (C + (-1.0) * identity<double>())), 1e-12);
  expect_everywhere("jacobian", {determinant(F)}, 1e-12);
  const auto stretches = values("principal_stretches");
  ASSERT_GE(stretches.size(), 3u);
  EXPECT_NEAR(stretches[0] * stretches[1] * stretches[2], determinant(F), 1e-12);
  EXPECT_NEAR(stretches[0] * stretches[0] + stretches[1] * stretches[1] + stretches[2] * stretches[2],
              C(0, 0) + C(1, 1) + C(2, 2), 1e-12);
  EXPECT_GE(stretches[0], stretches[1]);
  EXPECT_GE(stretches[1], stretches[2]);
}

// Principal values and directions give the tensor back; invariants are those of the tensor.
TEST_P(Quantities, StressAndWhatIsMadeOfIt) {
  const auto sigma = values("cauchy_stress"), principal = values("principal_stresses"),
             directions = values("principal_directions"), mean = values("mean_stress"),
             largest = values("first_principal_stress"), equivalent = values("von_mises_stress");
  const double size = std::abs(principal.at(0)) + std::abs(principal.at(2));
  ASSERT_GT(size, 1e3);
  for (std::size_t e = 0; e < mean.size(); ++e) {
    const double *s = principal.data() + 3 * e, *d = directions.data() + 9 * e;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        double sum = 0;
        for (std::size_t k = 0; k < 3; ++k) sum += s[k] * d[3 * k + i] * d[3 * k + j];
        EXPECT_NEAR(sum, sigma[9 * e + 3 * i + j], 1e-9 * size);
      }
    EXPECT_NEAR(mean[e], (s[0] + s[1] + s[2]) / 3, 1e-9 * size);
    EXPECT_NEAR(largest[e], s[0], 1e-9 * size);
    const double a = s[0] - s[1], b = s[1] - s[2], c = s[2] - s[0];
    EXPECT_NEAR(equivalent[e], std::sqrt(0.5 * (a * a + b * b + c * c)), 1e-9 * size);
  }
}

// Whatever a case asks for can be written: as many numbers as the place has, all of them finite.
TEST_P(Quantities, EachFillsItsPlace) {
  std::set<std::string> keys;
  for (const auto& quantity : registry()) {
    EXPECT_TRUE(keys.insert(quantity.key).second) << quantity.key;
    EXPECT_EQ(find(quantity.key), &quantity);
    EXPECT_FALSE(quantity.help.empty());
    for (std::size_t r = 0; r < mesh_.regions.size(); ++r) {
      const bool lumen = mesh_.regions[r].kind == RegionKind::lumen;
      if (quantity.place != Place::nodes && lumen != (quantity.place == Place::lumen_nodes)) continue;
      if (!quantity.given(problem_)) continue;
      const auto entries = quantity.place == Place::wall_elements ? mesh_.regions[r].owned_elements : mesh_.nodes();
      for (const auto& values : quantity.values(*moment_, r)) {
        const auto all = values.values();
        if (entries > 0) {
          EXPECT_GE(all.size() + static_cast<std::size_t>(values.stride),
                    static_cast<std::size_t>(entries) * static_cast<std::size_t>(values.stride) +
                        static_cast<std::size_t>(quantity.components))
              << quantity.key;
        }
        for (const double v : all) ASSERT_TRUE(std::isfinite(v)) << quantity.key;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Elements, Quantities, testing::Bool(),
                         [](const auto& variant) { return variant.param ? "Quadratic" : "Linear"; });

}  // namespace
}  // namespace tunica::quantities
