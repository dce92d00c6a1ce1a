// Free vibration against exact frequencies, and energy over thousands of steps.
#include <limits>
#include <tuple>

#include "tunica/coupling/monitors.hpp"
#include "verification/wall/solid.hpp"

namespace tunica::verification {
namespace {

using Conditions = std::vector<std::pair<std::string, bc::Condition>>;

ProblemInput dynamic_input(const SolidCase& c, const Conditions& conditions, double rho_infinity) {
  ProblemInput in = solid_input(c, conditions);
  in.rho_infinity = rho_infinity;
  in.newton.relative_tolerance = 1e-6;
  in.newton.reference_fraction = 1.0;
  return in;
}

template <class Function>
void set_velocity(const distributed::DistributedMesh& mesh, State& state, const Function& v) {
  for (std::int32_t i = 0; i < mesh.nodes(); ++i) {
    const Vec3<double> value = v(mesh.points[i]);
    for (int c = 0; c < 3; ++c) state.velocity_pressure[at(i) + c] = state.displacement_rate[at(i) + c] = value[c];
  }
}

/// Period from the upward zero crossings of a signal, interpolated linearly.
class Crossings {
 public:
  void add(double t, double value) {
    if (started_ && last_ < 0 && value >= 0) {
      const double when = last_t_ + (t - last_t_) * last_ / (last_ - value);
      if (count_ == 0) first_ = when;
      latest_ = when;
      ++count_;
    }
    started_ = true;
    last_t_ = t;
    last_ = value;
  }
  double period() const {
    return count_ > 1 ? (latest_ - first_) / (count_ - 1) : std::numeric_limits<double>::quiet_NaN();
  }

 private:
  bool started_ = false;
  double last_t_ = 0, last_ = 0, first_ = 0, latest_ = 0;
  int count_ = 0;
};

/// Component of a nodal field at the first owned node of `face` on the lowest rank that has one.
double probe(const distributed::DistributedMesh& mesh, const State& state, const std::string& face, bool radial) {
  double sums[2] = {};
  for (const auto& triangle : mesh.face(face).triangles)
    for (const auto i : triangle) {
      if (i >= mesh.owned_nodes) continue;
      const double* u = state.displacement.data() + at(i);
      const auto& X = mesh.points[i];
      sums[0] += radial ? (u[0] * X[0] + u[1] * X[1]) / std::hypot(X[0], X[1]) : u[0];
      sums[1] += 1;
    }
  parallel::global_sum(mesh.comm, sums);
  return sums[0] / sums[1];
}

struct Ring {
  static constexpr double A = 0.010, B = 0.012, mu = 5e4, density = 1100;
  static mesh::MeshData data(int radial) {
    return mesh::thick_cylinder({.inner = A,
                                 .outer = B,
                                 .length = (B - A) / radial,
                                 .cells_radial = radial,
                                 .cells_around = 8 * radial,
                                 .cells_along = 1},
                                mesh::Sector::quarter);
  }
  static Conditions conditions() {
    return {{"wall_inner", bc::Free{}},
            {"wall_outer", bc::Free{}},
            {"wall_inlet", held(false, false, true)},
            {"wall_outlet", held(false, false, true)},
            {"symmetry_x", held(true, false, false)},
            {"symmetry_y", held(false, true, false)}};
  }
  /// Breathing of the incompressible ring in plane strain, u = c/r: kinetic energy pi rho c'^2 ln(B/A), strain energy
  /// 2 pi mu c^2 (1/A^2 - 1/B^2) per length.
  static double frequency() {
    return std::sqrt(2 * mu * (1 / (A * A) - 1 / (B * B)) / (density * std::log(B / A))) / (2 * std::numbers::pi);
  }
  static Vec3<double> velocity(const Vec3<double>& X, double at_inner) {
    const double factor = at_inner * A / (X[0] * X[0] + X[1] * X[1]);
    return {{factor * X[0], factor * X[1], 0}};
  }
};

/// Takes `periods` periods of `steps_per_period` steps and returns measured / exact frequency.
double measured_frequency(Problem& problem, State& state, const std::string& face, bool radial, double exact,
                          int steps_per_period, int periods) {
  Crossings crossings;
  const double dt = 1.0 / (exact * steps_per_period);
  for (int k = 0; k < steps_per_period * periods; ++k) {
    const auto report = problem.advance(state, dt);
    EXPECT_TRUE(report.converged) << report.failure;
    if (!report.converged) break;
    crossings.add(state.time, probe(problem.mesh(), state, face, radial));
  }
  return 1.0 / (crossings.period() * exact);
}

TEST(Vibration, BreathingRing) {
  print("breathing ring, nu 0.5, exact %.3f Hz, 100 steps per period\n", Ring::frequency());
  for (const auto& [radial, order] : {std::pair{1, Order::linear},
                                      {2, Order::linear},
                                      {4, Order::linear},
                                      {1, Order::quadratic},
                                      {2, Order::quadratic}}) {
    const auto mesh = share(Ring::data(radial), order);
    Problem problem(mesh, dynamic_input({Element::mixed, Ring::mu, 0.5, Ring::density}, Ring::conditions(), 0.8));
    State state = problem.initial_state();
    const double amplitude = 1e-3 * Ring::A * 2 * std::numbers::pi * Ring::frequency();
    set_velocity(mesh, state, [&](const auto& X) { return Ring::velocity(X, amplitude); });
    const double error = measured_frequency(problem, state, "wall_inner", true, Ring::frequency(), 100, 4) - 1;
    print("  %d %s elements through the wall: frequency %+.3f %%\n", radial, name(order), 100 * error);
    if (radial > (order == Order::linear ? 2 : 0)) {
      EXPECT_LT(std::abs(error), 0.01);
    }
  }
}

/// Longitudinal wave in a bar whose sides slide: c^2 = (K + 4 mu / 3) / rho whatever the Poisson's ratio.
TEST(Vibration, BarInUniaxialStrain) {
  const double length = 0.02, side = 0.002, mu = 1e5, nu = 0.3, density = 1100;
  const double bulk = 2 * mu * (1 + nu) / (3 * (1 - 2 * nu)), c = std::sqrt((bulk + 4 * mu / 3) / density);
  const double exact = c / (4 * length);
  for (const auto& [element, order] : {std::pair{Element::displacement, Order::linear},
                                       {Element::mixed, Order::linear},
                                       {Element::displacement, Order::quadratic},
                                       {Element::mixed, Order::quadratic}}) {
    const int across = order == Order::linear ? 2 : 1;
    const auto mesh =
        share(mesh::box(10 * across, across, across, {{length, side, side}}, mesh::RegionKind::wall), order);
    const Conditions conditions{{"x_min", held(true, false, false)}, {"x_max", bc::Free{}},
                                {"y_min", held(false, true, false)}, {"y_max", held(false, true, false)},
                                {"z_min", held(false, false, true)}, {"z_max", held(false, false, true)}};
    Problem problem(mesh, dynamic_input({element, mu, nu, density}, conditions, 0.8));
    State state = problem.initial_state();
    set_velocity(mesh, state, [&](const auto& X) -> Vec3<double> {
      return {{1e-3 * c * std::sin(0.5 * std::numbers::pi * X[0] / length), 0, 0}};
    });
    const double error = measured_frequency(problem, state, "x_max", false, exact, 100, 4) - 1;
    print("bar, exact %.3f Hz, %-9s %-12s: frequency %+.3f %%\n", exact, name(order), name(element), 100 * error);
    EXPECT_LT(std::abs(error), 0.005);
  }
}

struct EnergyCourse {
  double first = 0, least = 1e300, most = 0, last = 0;
};

/// Energy of a ring in free vibration of 10 % amplitude, over `steps` steps of a fortieth of its period.
EnergyCourse energy_course(Element element, double nu, double rho_infinity, int steps, Order order = Order::linear) {
  const auto mesh = share(Ring::data(1), order);
  Problem problem(mesh, dynamic_input({element, Ring::mu, nu, Ring::density}, Ring::conditions(), rho_infinity));
  State state = problem.initial_state();
  set_velocity(mesh, state, [&](const auto& X) {
    return Ring::velocity(X, 0.1 * Ring::A * 2 * std::numbers::pi * Ring::frequency());
  });
  const coupling::Monitors monitors(problem);
  const double dt = 1.0 / (40 * Ring::frequency());
  EnergyCourse course;
  for (int k = 0; k < steps; ++k) {
    const auto report = problem.advance(state, dt);
    EXPECT_TRUE(report.converged) << "step " << k << ": " << report.failure;
    if (!report.converged) break;
    const auto record = monitors.evaluate(dt);
    const double energy = record.wall_kinetic + record.wall_strain;
    if (k == 0) course.first = energy;
    course.least = std::min(course.least, energy);
    course.most = std::max(course.most, energy);
    course.last = energy;
  }
  print(
      "energy of a ring, 10 %%, %-9s %-12s nu %.4g, rho_inf %.1f, %d steps: / first: least %.4f, most %.4f, last "
      "%.4f\n",
      name(order), name(element), nu, rho_infinity, steps, course.least / course.first, course.most / course.first,
      course.last / course.first);
  return course;
}

TEST(Vibration, EnergyStaysBoundedWithoutDamping) {
  for (const Element element : {Element::displacement, Element::mixed}) {
    const auto course = energy_course(element, 0.3, 1.0, 2500);
    EXPECT_LT(course.most, 1.05 * course.first);
    EXPECT_GT(course.least, 0.95 * course.first);
  }
}

TEST(Vibration, EnergyOfQuadraticElements) {
  for (const auto& [element, nu, rho_infinity] :
       {std::tuple{Element::displacement, 0.3, 1.0}, {Element::mixed, 0.3, 1.0}, {Element::mixed, 0.5, 0.9}}) {
    const auto course = energy_course(element, nu, rho_infinity, 600, Order::quadratic);
    EXPECT_LT(course.most, 1.05 * course.first);
    EXPECT_GT(course.least, 0.95 * course.first);
  }
}

/// With nu = 0.5 the equations are differential-algebraic with a constraint on positions, for which a scheme without
/// any numerical damping is weakly unstable (Cardona & Geradin 1989): rho_infinity = 1 fails after some hundred steps.
TEST(Vibration, IncompressibleStaysStableWithLittleDamping) {
  const auto course = energy_course(Element::mixed, 0.5, 0.9, 2500);
  EXPECT_LT(course.most, 1.05 * course.first);
  EXPECT_GT(course.least, 0.95 * course.first);
}

TEST(Vibration, EnergyDecaysWithDamping) {
  for (const auto& [element, nu] : {std::pair{Element::displacement, 0.3}, {Element::mixed, 0.5}}) {
    const auto course = energy_course(element, nu, 0.5, 2500);
    EXPECT_LT(course.most, 1.05 * course.first);
    EXPECT_LT(course.last, 0.99 * course.first);
  }
}

}  // namespace
}  // namespace tunica::verification
