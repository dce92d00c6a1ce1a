// A wall with dispersed fibres: inflation of a thick tube against a semi-analytic solution, convergence of Newton's
// method, and elements near incompressibility.
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/tools/roots.hpp>
#include <utility>

#include "verification/wall/banded_newton.hpp"
#include "verification/wall/cylinder.hpp"
#include "verification/wall/helical_fibres.hpp"

namespace tunica::verification {
namespace {

constexpr double systole = 13332.2;  // 100 mmHg [Pa]

/// Inflation R -> r = sqrt(R^2 + a^2 - A^2) of an incompressible tube in plane strain. The families mirror each other,
/// so that F = diag(r/R, 1, R/r) in the fibre frame and equilibrium over the wall gives the inner pressure
///   p(a) = int_a^b (sigma_tt - sigma_rr) / r dr,   sigma_tt - sigma_rr = lambda^2 S_bar_tt - lambda^-2 S_bar_rr.
class Inflation {
 public:
  explicit Inflation(const wall::LawParameters& p) : law_(wall::make_law(p)) {}

  double stress_difference(double r, double a) const {
    const double square = r * r / (r * r - a * a + A * A);  // lambda^2
    const wall::Symmetric<double> C{{square, 1.0, 1.0 / square, 0, 0, 0}};
    return std::visit(
        [&](const auto& law) {
          const auto S = wall::stress(law, C);
          return square * S[0] - S[2] / square;
        },
        law_);
  }
  double pressure(double a) const {
    using Rule = boost::math::quadrature::gauss_kronrod<double, 31>;
    const double b = std::sqrt(B * B + a * a - A * A);
    return Rule::integrate([&](double r) { return stress_difference(r, a) / r; }, a, b, 10, 1e-12);
  }
  /// sigma_tt at r, for the inner radius a: sigma_rr grows from -p(a).
  double hoop_stress(double r, double a) const {
    using Rule = boost::math::quadrature::gauss_kronrod<double, 15>;
    const auto slope = [&](double s) { return stress_difference(s, a) / s; };
    return Rule::integrate(slope, a, r, 5, 1e-10) - pressure(a) + stress_difference(r, a);
  }
  /// The inner radius under a pressure.
  double radius(double p) const {
    std::uintmax_t iterations = 100;
    const auto [low, high] =
        boost::math::tools::toms748_solve([&](double a) { return pressure(a) - p; }, A, 2.0 * A,
                                          boost::math::tools::eps_tolerance<double>(48), iterations);
    return 0.5 * (low + high);
  }

 private:
  wall::Law law_;
};

struct Errors {
  double displacement, hoop_stress;
};

/// Relative L2 errors: of the displacement against r(R), of the hoop stress of the elements at their deformed
/// centroids.
Errors errors(const Problem& problem, const State& state, const Inflation& inflation, double a) {
  double sums[4] = {};
  for_each_element(problem.mesh(), problem.wall_model(), state, [&](const ElementData& e) {
    for (int corner = 0; corner < 4; ++corner) {
      const double R = std::hypot(e.X[corner][0], e.X[corner][1]), u = std::sqrt(R * R + a * a - A * A) / R - 1.0;
      for (int c = 0; c < 2; ++c) {
        const double exact = u * e.X[corner][c], error = state.displacement[at(e.nodes[corner]) + c] - exact;
        sums[0] += e.state.reference.volume * error * error;
        sums[1] += e.state.reference.volume * exact * exact;
      }
    }
    double x[2] = {};
    for (int corner = 0; corner < 4; ++corner)
      for (int c = 0; c < 2; ++c) x[c] += 0.25 * (e.X[corner][c] + e.state.displacement[corner][c]);
    const double r = std::hypot(x[0], x[1]), co = x[0] / r, si = x[1] / r;
    const auto s = cauchy_stress(e, problem.wall_model());
    const double hoop = si * si * s(0, 0) + co * co * s(1, 1) - 2 * co * si * s(0, 1);
    const double exact = inflation.hoop_stress(r, a), error = hoop - exact;
    sums[2] += e.state.reference.volume * error * error;
    sums[3] += e.state.reference.volume * exact * exact;
  });
  parallel::global_sum(problem.mesh().comm, sums);
  return {std::sqrt(sums[0] / sums[1]), std::sqrt(sums[2] / sums[3])};
}

TEST(FibreTube, InflationConvergesToTheSemiAnalyticSolution) {
  const wall::LawParameters material = helical(0.5);
  const Inflation exact(material);
  const double a = exact.radius(systole), hoop = -systole + exact.stress_difference(a, a);
  print(
      "tube with two helical DFD families, 100 mmHg, plane strain, nu 0.5: inner radius 10 -> %.4f mm, hoop %.3f kPa\n"
      "  cells  u inner mm  error %%   L2 of u    order  L2 of hoop  order  hoop inner kPa  iterations\n",
      1e3 * a, hoop / 1e3);
  Errors before{}, now{};
  const auto solve = [&](int radial, Order order) {
    const auto mesh = share(mesh::thick_cylinder(sizes(radial), mesh::Sector::quarter), order);
    Problem problem(mesh, fibre_input(Element::mixed, material,
                                      plane_strain(bc::Pressure{bc::WaveformInput{systole}}, bc::Free{})));
    State state = problem.initial_state();
    const auto last = load(problem, state, 5);
    const double u = radial_displacement(mesh, state, "wall_inner");
    before = std::exchange(now, errors(problem, state, exact, a));
    print("   %2d    %.5f   %+.3f   %.3e  %5.2f  %.3e  %5.2f   %.3f      %zu  %s\n", radial, 1e3 * u,
          100 * (u / (a - A) - 1), now.displacement, std::log2(before.displacement / now.displacement), now.hoop_stress,
          std::log2(before.hoop_stress / now.hoop_stress),
          wall_stress(mesh, problem.wall_model(), state, A + u).hoop_inner / 1e3, last.iterations.size(), name(order));
  };
  for (const int radial : {2, 4, 8}) solve(radial, Order::linear);
  EXPECT_GT(std::log2(before.displacement / now.displacement), 1.8);
  EXPECT_GT(std::log2(before.hoop_stress / now.hoop_stress), 0.9);
  EXPECT_LT(now.displacement, 3e-4);
  EXPECT_LT(now.hoop_stress, 0.02);
  // Straight edges leave the polygon, of second order; one quadratic element is as good as three linear ones.
  for (const int radial : {1, 2}) solve(radial, Order::quadratic);
  EXPECT_GT(std::log2(before.displacement / now.displacement), 1.8);
  EXPECT_LT(now.displacement, 2e-3);
  EXPECT_LT(now.hoop_stress, 0.02);
}

/// Norms of one load step of the tube from `from` to `to` [Pa].
std::vector<double> norms_of_a_step(Element element, double poisson_ratio, double from, double to) {
  const auto mesh = share(mesh::thick_cylinder(sizes(2), mesh::Sector::quarter));
  Problem problem(mesh, fibre_input(element, helical(poisson_ratio),
                                    plane_strain(bc::Pressure{bc::WaveformInput{1.0}}, bc::Free{})));
  State state = problem.initial_state();
  for (int k = 1; k <= 4 && from > 0; ++k) EXPECT_TRUE(problem.solve_static(state, 0.25 * k * from).converged);
  const auto report = problem.solve_static(state, to);
  EXPECT_TRUE(report.converged) << report.failure;
  std::vector<double> norms;
  for (const auto& record : report.iterations) norms.push_back(record.norm);
  norms.push_back(report.final_norm);
  return norms;
}

/// The largest next / now^2, both relative to the first norm, once now is below a fifth. The single precision of the
/// stored tangent leaves 1e-5 of now, the residual of round-off 1e-10.
double quadratic_constant(const std::vector<double>& norms) {
  double constant = 0;
  for (std::size_t k = 0; k + 1 < norms.size(); ++k) {
    const double now = norms[k] / norms[0], next = norms[k + 1] / norms[0];
    if (now < 0.2) constant = std::max(constant, (next - 1e-5 * now - 1e-10) / (now * now));
  }
  return constant;
}

/// At rest every direction is at the switch, and during the step from there some begin to pull, others to be
/// compressed. Between 100 and 105 mmHg hardly any changes.
TEST(FibreTube, NewtonConvergesQuadraticallyAtTheSwitchAndAwayFromIt) {
  for (const Element element : {Element::displacement, Element::mixed})
    for (const double from : {0.0, systole}) {
      const double nu = element == Element::mixed ? 0.5 : 0.3;
      const auto norms = norms_of_a_step(element, nu, from, from + 0.05 * systole);
      print("Newton with DFD, %-12s nu %.2g, %-18s norms", name(element), nu,
            from > 0 ? "away from switch:" : "at the switch:");
      for (const double x : norms) print(" %.2e", x);
      const double constant = quadratic_constant(norms);
      print(", constant %.2g\n", constant);
      EXPECT_LT(constant, 1.0);
      EXPECT_LE(norms.size(), 5u);
      EXPECT_LT(norms.back(), 2e-9 * norms.front());
    }
}

/// Displacement element by elimination: the locked tangent is beyond the iterative solver. `held_in` names faces and
/// the direction in which they are held.
State solve_directly(const distributed::DistributedMesh& mesh, const wall::Parameters& parameters,
                     const std::vector<std::pair<const char*, int>>& held_in, const char* loaded, double pressure) {
  std::vector<char> fixed(3 * static_cast<std::size_t>(mesh.nodes()), 0);
  for (const auto& [face, direction] : held_in)
    for (const auto& triangle : mesh.face(face).triangles)
      for (const auto i : triangle) fixed[3 * static_cast<std::size_t>(i) + direction] = 1;
  BandedNewton newton(mesh, parameters, fixed);
  State state;
  state.displacement.assign(at(mesh.nodes()), 0.0);
  state.velocity_pressure = state.acceleration = state.displacement;
  constexpr int steps = 25;
  for (int k = 1; k <= steps; ++k) {
    double increment = 1;
    for (int iteration = 0; iteration < 20 && increment > 1e-9 * A; ++iteration)
      increment = newton.iterate(state, loaded, pressure * k / steps);
    EXPECT_LE(increment, 1e-9 * A);
  }
  return state;
}

/// Both elements beside each other. The exact solution of the tube is that of nu = 0.5, which 0.4999 should meet.
TEST(FibreTube, LockingOfTheDisplacementElement) {
  const Inflation exact(helical(0.5));
  const double a = exact.radius(systole);
  print(
      "tube with DFD, 4 cells, 100 mmHg, inner displacement, of the incompressible one\n     nu     mixed   "
      "displacement\n");
  double before = 1.0;
  for (const double nu : {0.49, 0.499, 0.4999}) {
    const auto sections = sizes(4);
    const auto mesh = share(mesh::thick_cylinder(sections, mesh::Sector::quarter));
    const ProblemInput in =
        fibre_input(Element::mixed, helical(nu), plane_strain(bc::Pressure{bc::WaveformInput{systole}}, bc::Free{}));
    Problem problem(mesh, in);
    State state = problem.initial_state();
    load(problem, state, 5);
    const double mixed = radial_displacement(mesh, state, "wall_inner") / (a - A) - 1.0;
    const auto own = distributed::distribute(mesh::thick_cylinder(sections, mesh::Sector::quarter), MPI_COMM_SELF);
    wall::Parameters parameters = *in.wall;
    parameters.element = Element::displacement;
    const State direct =
        solve_directly(own, parameters, {{"symmetry_x", 0}, {"symmetry_y", 1}, {"wall_inlet", 2}, {"wall_outlet", 2}},
                       "wall_inner", systole);
    const double displacement = radial_displacement(own, direct, "wall_inner") / (a - A) - 1.0;
    print("  %7.4f  %+.2f %%   %+.2f %%\n", nu, 100 * mixed, 100 * displacement);
    if (nu > 0.499) {
      EXPECT_LT(std::abs(mixed), 0.005);
    }
    EXPECT_LT(displacement, before);  // ever stiffer
    before = displacement;
  }
  EXPECT_LT(before, -0.03);
}

/// A cube between clamps pulled by 60 kPa: mean elongation, with the mixed element on a finer mesh as the reference.
TEST(FibreCube, LockingOfTheDisplacementElement) {
  constexpr double side = 0.01, tension = 6e4;
  const auto elongation = [&](const distributed::DistributedMesh& mesh, const State& state) {
    double sums[2] = {};
    for (std::int32_t i = 0; i < mesh.owned_nodes; ++i)
      if (mesh.points[i][0] > 0.999 * side) sums[0] += state.displacement[at(i)], sums[1] += 1;
    parallel::global_sum(mesh.comm, sums);
    return sums[0] / sums[1];
  };
  const auto input = [&](double nu) {
    auto in = fibre_input(Element::mixed, helical(nu),
                          {{"x_min", bc::Fixed{}},
                           {"x_max", bc::Pressure{bc::WaveformInput{-tension}}},
                           {"y_min", bc::Free{}},
                           {"y_max", bc::Free{}},
                           {"z_min", bc::Free{}},
                           {"z_max", bc::Free{}}});
    in.wall->fibre_frame = wall::ConstantFrame{};
    return in;
  };
  const auto solve = [&](int n, double nu) {
    const auto mesh = share(mesh::box(n, n, n, {{side, side, side}}, mesh::RegionKind::wall));
    Problem problem(mesh, input(nu));
    State state = problem.initial_state();
    load(problem, state, 5);
    return elongation(mesh, state);
  };
  print(
      "cube with DFD, one end held, 60 kPa: elongation, 4 cells, of the mixed element with 8\n     nu     mixed   "
      "displacement\n");
  for (const double nu : {0.49, 0.499, 0.4999}) {
    const double reference = solve(8, nu), mixed = solve(4, nu) / reference - 1.0;
    const auto own =
        distributed::distribute(mesh::box(4, 4, 4, {{side, side, side}}, mesh::RegionKind::wall), MPI_COMM_SELF);
    wall::Parameters parameters = *input(nu).wall;
    parameters.element = Element::displacement;
    const State direct = solve_directly(own, parameters, {{"x_min", 0}, {"x_min", 1}, {"x_min", 2}}, "x_max", -tension);
    const double displacement = elongation(own, direct) / reference - 1.0;
    print("  %7.4f  %+.2f %%   %+.2f %%\n", nu, 100 * mixed, 100 * displacement);
    EXPECT_LT(std::abs(mixed), 0.02);
    EXPECT_LT(displacement, mixed);
  }
}

}  // namespace
}  // namespace tunica::verification
