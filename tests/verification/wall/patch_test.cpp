// Patch test: the elements reproduce a homogeneous finite deformation on an irregular mesh.
#include "verification/wall/solid.hpp"

namespace tunica::verification {
namespace {

constexpr double size = 0.01;  // of the block [m]
constexpr double mu = 5e4;     // Pa

/// A box whose inner nodes are shaken by up to 15 % of a cell.
mesh::MeshData shaken_box(int n) {
  auto data = mesh::box(n, n, n, {{size, size, size}}, mesh::RegionKind::wall);
  const double h = size / n;
  for (auto& x : data.points) {
    const bool inner = std::ranges::all_of(x.x, [&](double c) { return c > 0.1 * h && c < size - 0.1 * h; });
    if (!inner) continue;
    const Vec3<double> old = x;
    for (int i = 0; i < 3; ++i) x[i] += 0.15 * h * std::sin(1e4 * old[(i + 1) % 3] + 2e3 * old[i] + i);
  }
  return data;
}

const std::vector<std::string> all_faces{"x_min", "x_max", "y_min", "y_max", "z_min", "z_max"};

/// u = G X on the whole boundary; inside, Newton's method starts from 90 % of it.
void linear_displacement(Element element, double nu) {
  const auto mesh = share(shaken_box(4));
  std::vector<std::pair<std::string, bc::Condition>> conditions;
  for (const auto& face : all_faces) conditions.emplace_back(face, bc::Fixed{});
  Problem problem(mesh, solid_input({element, mu, nu}, conditions));
  const Mat3<double> G{{{0.12, 0.05, -0.03}, {0.02, -0.08, 0.06}, {-0.04, 0.03, 0.05}}};
  const auto exact = [&](const Vec3<double>& X) { return G * X; };
  State state = problem.initial_state();
  set_displacement(mesh, state, [&](const Vec3<double>& X) {
    const bool inner = std::ranges::all_of(X.x, [&](double c) { return c > 1e-9 && c < size - 1e-9; });
    return (inner ? 0.9 : 1.0) * exact(X);
  });
  load(problem, state, 1);
  const double error = largest(mesh, [&](std::int32_t i) {
    const Vec3<double> u{{state.displacement[at(i)], state.displacement[at(i) + 1], state.displacement[at(i) + 2]}};
    return norm(u - exact(mesh.points[i]));
  });
  const double relative = error / (0.12 * size);
  double stress_error = 0;
  Mat3<double> first{};
  bool have_first = false;
  for_each_element(mesh, problem.wall_model(), state, [&](const ElementData& e) {
    const auto s = cauchy_stress(e, problem.wall_model());
    if (!have_first) first = s, have_first = true;
    for (int k = 0; k < 9; ++k) stress_error = std::max(stress_error, std::abs(s(k / 3, k % 3) - first(k / 3, k % 3)));
  });
  stress_error = parallel::global_max(mesh.comm, stress_error) / mu;
  print("patch, u = G X, %-12s nu %.4g: error of u %.1e, scatter of the stress %.1e mu\n", name(element), nu, relative,
        stress_error);
  EXPECT_LT(relative, 1e-9);
  EXPECT_LT(stress_error, 1e-8);
}

/// Uniaxial follower tension with symmetry planes: uniform stress, equal to the traction.
void uniform_traction(Element element, double nu) {
  const auto mesh = share(shaken_box(4));
  const double tension = 0.2 * mu;
  Problem problem(mesh, solid_input({element, mu, nu}, {{"x_min", held(true, false, false)},
                                                        {"y_min", held(false, true, false)},
                                                        {"z_min", held(false, false, true)},
                                                        {"x_max", bc::Pressure{bc::WaveformInput{-tension}}},
                                                        {"y_max", bc::Free{}},
                                                        {"z_max", bc::Free{}}}));
  State state = problem.initial_state();
  load(problem, state, 2);
  double error = 0;
  for_each_element(mesh, problem.wall_model(), state, [&](const ElementData& e) {
    const auto s = cauchy_stress(e, problem.wall_model());
    for (int k = 0; k < 9; ++k) error = std::max(error, std::abs(s(k / 3, k % 3) - (k == 0 ? tension : 0.0)));
  });
  error = parallel::global_max(mesh.comm, error) / tension;
  print("patch, tension, %-12s nu %.4g: error of the stress %.1e\n", name(element), nu, error);
  EXPECT_LT(error, 1e-8);
}

TEST(Patch, LinearDisplacementField) {
  linear_displacement(Element::displacement, 0.3);
  linear_displacement(Element::mixed, 0.3);
  linear_displacement(Element::mixed, 0.49);
}

TEST(Patch, UniformTraction) {
  uniform_traction(Element::displacement, 0.3);
  uniform_traction(Element::displacement, 0.45);
  uniform_traction(Element::mixed, 0.3);
  uniform_traction(Element::mixed, 0.4999);
  uniform_traction(Element::mixed, 0.5);
}

}  // namespace
}  // namespace tunica::verification
