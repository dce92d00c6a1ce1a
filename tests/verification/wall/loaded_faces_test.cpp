// Faces that move as a whole under their load, viscosity of the wall, and the instant whose loads act.
#include "verification/wall/solid.hpp"

namespace tunica::verification {
namespace {

constexpr double size = 0.01;  // of the block [m]
constexpr double mu = 5e4;     // Pa

Vec3<double> displacement(const State& state, std::int32_t node) {
  const double* u = state.displacement.data() + at(node);
  return {{u[0], u[1], u[2]}};
}

/// Mean displacement of the owned nodes of a face.
Vec3<double> mean_of_face(const distributed::DistributedMesh& mesh, const State& state, const std::string& face) {
  double sums[4] = {};
  for (const auto& triangle : mesh.face(face).triangles)
    for (const auto node : triangle) {
      if (node >= mesh.owned_nodes) continue;
      for (int i = 0; i < 3; ++i) sums[i] += displacement(state, node)[i];
      sums[3] += 1;
    }
  parallel::global_sum(mesh.comm, sums);
  return {{sums[0] / sums[3], sums[1] / sums[3], sums[2] / sums[3]}};
}

using Conditions = std::vector<std::pair<std::string, bc::Condition>>;

Conditions block(bc::Condition top, bc::Condition side = bc::Free{}) {
  return {{"z_min", bc::Fixed{}}, {"z_max", std::move(top)}, {"x_min", std::move(side)},
          {"x_max", bc::Free{}},  {"y_min", bc::Free{}},     {"y_max", bc::Free{}}};
}

class UndeformingFace : public testing::TestWithParam<std::pair<Element, Order>> {};
INSTANTIATE_TEST_SUITE_P(Elements, UndeformingFace,
                         testing::Values(std::pair{Element::mixed, Order::linear},
                                         std::pair{Element::displacement, Order::linear},
                                         std::pair{Element::mixed, Order::quadratic}));

// Pulled and sheared under an oblique traction, the block must be that whose face is moved by as much.
TEST_P(UndeformingFace, IsAFaceMovedByWhatItsLoadMovesIt) {
  const auto [element, order] = GetParam();
  const auto mesh = share(mesh::box(3, 3, 3, {{size, size, size}}, mesh::RegionKind::wall), order);
  const SolidCase solid{element, mu, element == Element::mixed ? 0.5 : 0.3};
  bc::Traction traction{.vector = {{0.05 * mu, 0.02 * mu, 0.2 * mu}}, .undeforming = true};
  Problem loaded(mesh, solid_input(solid, block(traction)));
  State state = loaded.initial_state();
  const auto report = load(loaded, state, 1);
  const Vec3<double> moved = mean_of_face(mesh, state, "z_max");
  EXPECT_GT(moved[2], 0.02 * size);
  EXPECT_GT(moved[0], 0.01 * size);

  Problem prescribed(mesh, solid_input(solid, block(bc::Displacement{.value = moved})));
  State other = prescribed.initial_state();
  load(prescribed, other, 1);
  const double difference =
      largest(mesh, [&](std::int32_t i) { return norm(displacement(state, i) - displacement(other, i)); }) /
      norm(moved);
  print(
      "undeforming face, %-12s %-9s: moved by (%.4f, %.4f, %.4f) h in %zu iterations, %d linear ones; from the block "
      "with the displacement given %.1e\n",
      name(element), name(order), moved[0] / size, moved[1] / size, moved[2] / size, report.iterations.size(),
      report.linear_iterations(), difference);
  EXPECT_LT(difference, 1e-7);
}

// Beside a face that is held along x the whole face is.
TEST(UndeformingFaces, AreHeldWhereOneOfTheirNodesIs) {
  const auto mesh = share(mesh::box(2, 2, 2, {{size, size, size}}, mesh::RegionKind::wall));
  const bc::Traction traction{.vector = {{0.1 * mu, 0.1 * mu, 0}}, .undeforming = true};
  Problem problem(mesh, solid_input({Element::mixed, mu, 0.49}, block(traction, held(true, false, false))));
  State state = problem.initial_state();
  load(problem, state, 1);
  const Vec3<double> moved = mean_of_face(mesh, state, "z_max");
  EXPECT_EQ(moved[0], 0.0);
  EXPECT_GT(moved[1], 0.02 * size);
}

TEST(UndeformingFaces, ShareNoNodeWithOneThatIsMoved) {
  const auto mesh = share(mesh::box(2, 2, 2, {{size, size, size}}, mesh::RegionKind::wall));
  const bc::Traction traction{.vector = {{0, 0, mu}}, .undeforming = true};
  const auto input =
      solid_input({Element::mixed, mu, 0.49}, block(traction, bc::Displacement{.value = {{1e-4, 0, 0}}}));
  EXPECT_THROW(Problem(mesh, input), InputError);
}

/// d(gamma)/dt of simple shear under a shear load: tau = mu gamma + eta gamma' k.
double rate(wall::Viscosity::Law law, double gamma, double tau, double eta) {
  const double k = law == wall::Viscosity::Law::newtonian ? 1.0 : 0.5 + gamma * gamma;
  return (tau - mu * gamma) / (eta * k);
}

class Creep : public testing::TestWithParam<std::pair<wall::Viscosity::Law, Order>> {};
INSTANTIATE_TEST_SUITE_P(Laws, Creep,
                         testing::Values(std::pair{wall::Viscosity::Law::newtonian, Order::linear},
                                         std::pair{wall::Viscosity::Law::potential, Order::linear},
                                         std::pair{wall::Viscosity::Law::newtonian, Order::quadratic},
                                         std::pair{wall::Viscosity::Law::potential, Order::quadratic}));

// Simple shear is homogeneous: with viscosity and without mass a neo-Hookean block creeps as one equation says. The
// load grows smoothly, as a start at rest asks for.
TEST_P(Creep, OfASimpleShearIsThatOfOneEquation) {
  const auto [law, order] = GetParam();
  constexpr double tau = 0.6 * mu, eta = 0.05 * mu, end = 0.1;  // s
  const auto mesh = share(mesh::box(2, 2, 2, {{size, size, size}}, mesh::RegionKind::wall), order);
  const bc::Traction traction{.vector = {{tau, 0, 0}}, .course = {1.0, 1.0, end}, .fixed = {false, true, true}};
  const auto load_at = [&](double t) { return tau * 0.5 * (1 - std::cos(std::numbers::pi * t / end)); };
  auto input = solid_input({Element::mixed, mu, 0.5, 1e-3}, {{"y_min", bc::Fixed{}},
                                                             {"y_max", traction},
                                                             {"x_min", held(false, true, true)},
                                                             {"x_max", held(false, true, true)},
                                                             {"z_min", held(false, true, true)},
                                                             {"z_max", held(false, true, true)}});
  input.rho_infinity = 0.5;
  input.wall->viscosity = wall::Viscosity{law, eta};
  double gamma = 0;
  constexpr int fine = 100000;
  for (int k = 0; k < fine; ++k) {
    const double h = end / fine, middle = gamma + 0.5 * h * rate(law, gamma, load_at(h * k), eta);
    gamma += h * rate(law, middle, load_at(h * (k + 0.5)), eta);
  }
  double errors[2];
  int most = 0;
  for (int refinement = 0; refinement < 2; ++refinement) {
    const int steps = 20 << refinement;
    Problem problem(mesh, input);
    State state = problem.initial_state();
    for (int k = 0; k < steps; ++k) {
      const auto report = problem.advance(state, end / steps);
      ASSERT_TRUE(report.converged) << report.failure;
      most = std::max(most, static_cast<int>(report.iterations.size()));
    }
    errors[refinement] = std::abs(mean_of_face(mesh, state, "y_max")[0] / size / gamma - 1);
  }
  print(
      "creep, %s, %s: gamma %.5f after %.3g times the relaxation time, errors %.1e and %.1e with 20 and 40 steps, at "
      "most %d iterations\n",
      law == wall::Viscosity::Law::newtonian ? "newtonian" : "potential", name(order), gamma, end * mu / eta, errors[0],
      errors[1], most);
  EXPECT_LT(errors[0], 1e-3);
  EXPECT_LT(errors[1], 0.35 * errors[0]);
  EXPECT_LE(most, 5);
}

// With rho_infinity 0.5 momentum is balanced at two thirds of the step: a load that sets in later acts in it only as
// one of its end.
TEST(Loads, OfTheEndOfAStepActInItsBalance) {
  const auto mesh = share(mesh::box(2, 2, 2, {{size, size, size}}, mesh::RegionKind::wall));
  constexpr double dt = 0.01;
  const bc::Pressure late{.pressure = {bc::Step{.value = -0.1 * mu, .start = 0.8 * dt}}};
  for (const auto instant : {coupling::LoadInstant::balance, coupling::LoadInstant::end}) {
    auto input = solid_input({Element::mixed, mu, 0.49}, block(late));
    input.rho_infinity = 0.5;
    input.loads = instant;
    Problem problem(mesh, input);
    State state = problem.initial_state();
    EXPECT_TRUE(problem.advance(state, dt).converged);
    const double moved = mean_of_face(mesh, state, "z_max")[2];
    if (instant == coupling::LoadInstant::balance)
      EXPECT_EQ(moved, 0.0);
    else
      EXPECT_GT(moved, 1e-3 * size);
  }
}

}  // namespace
}  // namespace tunica::verification
