// Thick cylinder under pressure, plane strain: exact finite and small deformations, tissue support, Newton's rate.
#include "verification/wall/cylinder.hpp"

#include <fstream>
#include <optional>
#include <sstream>

#include "folders.hpp"
#include "verification/wall/banded_newton.hpp"

namespace tunica::verification {
namespace {

constexpr double mu = 5e4;  // Pa

struct Solution {
  double inner_displacement, outer_displacement;
  double outer_scatter;  ///< largest deviation of a node at the outer face from the mean [m]
  WallStress stress;
  coupling::StepReport last;
};

double scatter(const distributed::DistributedMesh& mesh, const State& state, const std::string& face, double mean) {
  double result = 0;
  for (const auto& triangle : mesh.face(face).triangles)
    for (const auto i : triangle) {
      const auto& X = mesh.points[i];
      const double r = std::hypot(X[0] + state.displacement[at(i)], X[1] + state.displacement[at(i) + 1]);
      result = std::max(result, std::abs(r - std::hypot(X[0], X[1]) - mean));
    }
  return parallel::global_max(mesh.comm, result);
}

Solution inflate(const SolidCase& c, const mesh::MeshData& tube, int steps, const bc::Condition& inner,
                 const bc::Condition& outer, Order order = Order::linear) {
  const auto mesh = share(tube, order);
  Problem problem(mesh, solid_input(c, plane_strain(inner, outer)));
  State state = problem.initial_state();
  Solution s{};
  s.last = load(problem, state, steps);
  s.inner_displacement = radial_displacement(mesh, state, "wall_inner");
  s.outer_displacement = radial_displacement(mesh, state, "wall_outer");
  s.outer_scatter = scatter(mesh, state, "wall_outer", s.outer_displacement);
  s.stress = wall_stress(mesh, problem.wall_model(), state, A + s.inner_displacement);
  return s;
}

Solution inflate(const SolidCase& c, int radial, int steps, const bc::Condition& inner, const bc::Condition& outer,
                 Order order = Order::linear) {
  return inflate(c, mesh::thick_cylinder(sizes(radial), mesh::Sector::quarter), steps, inner, outer, order);
}

/// The displacement element by elimination, each rank for itself.
Solution inflate_directly(double shear_modulus, double nu, int radial, int steps, double pressure) {
  const auto mesh = distributed::distribute(mesh::thick_cylinder(sizes(radial), mesh::Sector::quarter), MPI_COMM_SELF);
  const auto in = solid_input({Element::displacement, shear_modulus, nu}, {});
  std::vector<char> fixed(3 * static_cast<std::size_t>(mesh.nodes()), 0);
  const auto hold = [&](const char* face, int direction) {
    for (const auto& triangle : mesh.face(face).triangles)
      for (const auto i : triangle) fixed[3 * static_cast<std::size_t>(i) + direction] = 1;
  };
  hold("symmetry_x", 0), hold("symmetry_y", 1), hold("wall_inlet", 2), hold("wall_outlet", 2);
  BandedNewton newton(mesh, *in.wall, fixed);
  State state;
  state.displacement.assign(at(mesh.nodes()), 0.0);
  state.velocity_pressure = state.acceleration = state.displacement;
  for (int k = 1; k <= steps; ++k) {
    double increment = 1;
    for (int iteration = 0; iteration < 20 && increment > 1e-10 * A; ++iteration)
      increment = newton.iterate(state, "wall_inner", pressure * k / steps);
    EXPECT_LE(increment, 1e-10 * A);
  }
  Solution s{};
  s.inner_displacement = radial_displacement(mesh, state, "wall_inner");
  s.outer_displacement = radial_displacement(mesh, state, "wall_outer");
  s.stress = wall_stress(mesh, newton.model(), state, A + s.inner_displacement);
  return s;
}

/// Rows of a reference table, numbers only; nothing when the table is not there.
std::optional<std::vector<std::vector<double>>> reference(const char* file) {
  std::ifstream in(std::string(TUNICA_SHARED_DATA) + "/analytic/" + file);
  if (!in) return std::nullopt;
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || !(std::isdigit(static_cast<unsigned char>(line[0])))) continue;
    std::istringstream cells(line);
    auto& row = rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::stod(cell));
  }
  return rows;
}

/// Incompressible neo-Hooke tube (plane strain), inner radius A -> a: r^2 = R^2 + a^2 - A^2, sigma_tt - sigma_rr =
/// mu (lambda^2 - lambda^-2) with lambda = r/R, and equilibrium integrated over the wall.
struct Inflated {
  double pressure, hoop_inner;
};
Inflated exact_inflation(double a) {
  const double k = a * a - A * A;
  const auto integrand = [&](double r) {
    const double square = r * r / (r * r - k);  // lambda^2
    return mu * (square - 1 / square) / r;
  };
  const double b = std::sqrt(B * B + k);
  const int n = 2000;  // Simpson
  double sum = integrand(a) + integrand(b);
  for (int i = 1; i < n; ++i) sum += (i % 2 ? 4 : 2) * integrand(a + (b - a) * i / n);
  const double p = sum * (b - a) / (3 * n);
  return {p, -p + a * integrand(a)};
}

TEST(ThickCylinder, ClosedFormEqualsTheTable) {
  const auto rows = reference("thick_cylinder_neohooke.csv");
  if (!rows) GTEST_SKIP() << "no reference data";
  double p_error = 0, hoop_error = 0;
  for (const auto& row : *rows) {
    const Inflated exact = exact_inflation(1e-3 * row[0]);
    p_error = std::max(p_error, std::abs(exact.pressure / 1e3 - row[2]));
    hoop_error = std::max(hoop_error, std::abs(exact.hoop_inner / 1e3 - row[5]));
  }
  print("thick cylinder: closed form against the table, %zu rows: pressure %.1e kPa, hoop stress %.1e kPa\n",
        rows->size(), p_error, hoop_error);
  EXPECT_LT(p_error, 1e-6);
  EXPECT_LT(hoop_error, 1e-5);
}

/// 20 % inflation under follower pressure, 4 elements through the wall.
TEST(ThickCylinder, MixedElementAndLockingOfTheDisplacementElement) {
  const double a = 0.012;
  const Inflated exact = exact_inflation(a);
  print(
      "thick cylinder A 10 B 12 mm, mu 50 kPa, p %.4f kPa, exact (nu 0.5): u %.4f mm, hoop %.3f kPa\n"
      "  element        nu      cells  u inner mm  error %%   hoop inner kPa  error %%  scatter %%\n",
      exact.pressure / 1e3, 1e3 * (a - A), exact.hoop_inner / 1e3);
  const auto run = [&](Element element, double nu, int radial) {
    const Solution s = element == Element::mixed ? inflate({element, mu, nu}, radial, 4,
                                                           bc::Pressure{bc::WaveformInput{exact.pressure}}, bc::Free{})
                                                 : inflate_directly(mu, nu, radial, 4, exact.pressure);
    const double u_error = s.inner_displacement / (a - A) - 1, hoop_error = s.stress.hoop_inner / exact.hoop_inner - 1;
    print("  %-12s %7.4f    %2d     %.5f    %+7.3f    %.4f        %+7.3f   %.2f\n", name(element), nu, radial,
          1e3 * s.inner_displacement, 100 * u_error, s.stress.hoop_inner / 1e3, 100 * hoop_error,
          100 * s.stress.hoop_scatter / exact.hoop_inner);
    return std::pair(u_error, hoop_error);
  };
  for (const double nu : {0.4999, 0.5})
    for (const int radial : {2, 4}) {
      const auto [u_error, hoop_error] = run(Element::mixed, nu, radial);
      if (radial == 4) {
        EXPECT_LT(std::abs(u_error), 0.01);
        EXPECT_LT(std::abs(hoop_error), 0.01);
      }
    }
  double previous = 1;
  for (const double nu : {0.49, 0.499, 0.4999}) {
    run(Element::mixed, nu, 4);
    const auto [u_error, hoop_error] = run(Element::displacement, nu, 4);
    EXPECT_LT(u_error, previous);  // the closer to 0.5, the stiffer
    previous = u_error;
  }
  EXPECT_LT(previous, -0.1);  // locked
}

/// The same inflation with quadratic elements. Their edges are straight, so that what is left is the polygon in place
/// of the circle: 8 edges for each element through the quarter, whose error falls with the square of their length.
TEST(ThickCylinder, QuadraticElement) {
  const double a = 0.012;
  const Inflated exact = exact_inflation(a);
  print("thick cylinder, quadratic elements, p %.4f kPa, exact (nu 0.5): u %.4f mm, hoop %.3f kPa\n",
        exact.pressure / 1e3, 1e3 * (a - A), exact.hoop_inner / 1e3);
  const auto run = [&](Element element, double nu, int radial) {
    const Solution s = inflate({element, mu, nu}, radial, 4, bc::Pressure{bc::WaveformInput{exact.pressure}},
                               bc::Free{}, Order::quadratic);
    const double u_error = s.inner_displacement / (a - A) - 1, hoop_error = s.stress.hoop_inner / exact.hoop_inner - 1;
    print("  %-12s %7.4f    %2d     %.5f    %+7.3f    %.4f        %+7.3f   %.2f  (%d linear iterations in %zu)\n",
          name(element), nu, radial, 1e3 * s.inner_displacement, 100 * u_error, s.stress.hoop_inner / 1e3,
          100 * hoop_error, 100 * s.stress.hoop_scatter / exact.hoop_inner, s.last.linear_iterations(),
          s.last.iterations.size());
    return std::pair(u_error, hoop_error);
  };
  for (const double nu : {0.49, 0.4999}) run(Element::mixed, nu, 2);
  double previous = 0;
  for (const int radial : {1, 2, 4}) {
    const auto [u_error, hoop_error] = run(Element::mixed, 0.5, radial);
    EXPECT_LT(std::abs(u_error), 0.01);
    EXPECT_LT(std::abs(hoop_error), 0.01);
    previous = u_error;
  }
  EXPECT_LT(std::abs(previous), 1e-3);
}

/// Lame's solution, at a thousandth of the table's pressure so that strains are small.
TEST(ThickCylinder, SmallStrains) {
  const auto rows = reference("lame_cylinder.csv");
  if (!rows) GTEST_SKIP() << "no reference data";
  const double scale = 1e-3, E = 3e5, nu = 0.49;
  for (const Element element : {Element::mixed, Element::displacement}) {
    const double G = E / (2 * (1 + nu)), p = 1e3 * scale;
    const Solution s = element == Element::mixed
                           ? inflate({element, G, nu}, 4, 1, bc::Pressure{bc::WaveformInput{p}}, bc::Free{})
                           : inflate_directly(G, nu, 4, 1, p);
    const double u_a = 1e-3 * scale * rows->front()[1], u_b = 1e-3 * scale * rows->back()[1];
    const double hoop = 1e3 * scale * rows->front()[3];
    const double errors[3] = {s.inner_displacement / u_a - 1, s.outer_displacement / u_b - 1,
                              s.stress.hoop_inner / hoop - 1};
    print("Lame, nu 0.49, %-12s: errors %%: u inner %+.3f, u outer %+.3f, hoop inner %+.3f\n", name(element),
          100 * errors[0], 100 * errors[1], 100 * errors[2]);
    if (element == Element::mixed) {
      for (const double e : errors) EXPECT_LT(std::abs(e), 0.01);
    }
  }
}

/// Elastic bedding at the outer face: Lame with the outer pressure q = k_s u(B).
TEST(ThickCylinder, TissueSupport) {
  const double E = 3e5, nu = 0.49, p = 1.0, k_s = 1e7;
  // u = c1 r + c2 / r, sigma_rr = 2 (lambda + mu) c1 - 2 mu c2 / r^2 (plane strain)
  const double G = E / (2 * (1 + nu)), lambda = 2 * G * nu / (1 - 2 * nu);
  const auto exact = [&](double k) {
    // sigma_rr(A) = -p, sigma_rr(B) + k u(B) = 0
    const double a11 = 2 * (lambda + G), a12 = -2 * G / (A * A), a21 = 2 * (lambda + G) + k * B,
                 a22 = -2 * G / (B * B) + k / B;
    const double det = a11 * a22 - a12 * a21;
    const double c1 = -p * a22 / det, c2 = p * a21 / det;
    return std::pair(c1 * A + c2 / A, c1 * B + c2 / B);
  };
  const auto compare = [&](const char* what, const Solution& s, double k) {
    const auto [u_a, u_b] = exact(k);
    const double errors[2] = {s.inner_displacement / u_a - 1, s.outer_displacement / u_b - 1};
    print(
        "tissue support k_s %.0e N/m^3, %s: u inner %.4e m (exact %.4e, %+.3f %%), u outer %+.3f %%, scatter %.3f %%\n",
        k, what, s.inner_displacement, u_a, 100 * errors[0], 100 * errors[1], 100 * s.outer_scatter / u_b);
    for (const double e : errors) EXPECT_LT(std::abs(e), 0.01);
    EXPECT_LT(s.outer_scatter, 0.01 * u_b);
  };
  const SolidCase c{Element::mixed, G, nu};
  const bc::Pressure inner{bc::WaveformInput{p}};
  Solution constant{};
  for (const double k : {0.0, k_s})
    compare("constant", constant = inflate(c, 4, 1, inner, bc::Support{.stiffness = k}), k);
  compare("quadratic elements", inflate(c, 2, 1, inner, bc::Support{.stiffness = k_s}, Order::quadratic), k_s);

  // k_s between 0.2 and 1.8 of its mean around the tube, and the pressure p0 that makes up for it: the same balance.
  auto tube = mesh::thick_cylinder(sizes(4), mesh::Sector::quarter);
  mesh::NodeField stiffness{mesh::face_array_name("wall_outer", "k_s"), {}};
  mesh::NodeField pressure{mesh::face_array_name("wall_outer", "p_0"), {}};
  for (const auto& x : tube.points) {
    const double k = k_s * (1.0 + 0.8 * std::cos(4.0 * std::atan2(x[1], x[0])));
    stiffness.values.push_back(k);
    pressure.values.push_back((k_s - k) * exact(k_s).second);
  }
  tube.node_fields = {stiffness, pressure};
  const Solution varying =
      inflate(c, tube, 1, inner, bc::Support{.stiffness = bc::FaceArray{"k_s"}, .pressure = bc::FaceArray{"p_0"}});
  compare("varying around the tube", varying, k_s);
  EXPECT_NEAR(varying.outer_displacement, constant.outer_displacement, 1e-3 * constant.outer_displacement);
}

/// The tangent is consistent: norms fall quadratically until the single precision of the stored matrix limits an
/// iteration to about 1e-6.
TEST(ThickCylinder, NewtonConvergesQuadratically) {
  for (const auto& [element, order] : {std::pair{Element::displacement, Order::linear},
                                       {Element::mixed, Order::linear},
                                       {Element::displacement, Order::quadratic},
                                       {Element::mixed, Order::quadratic}}) {
    const SolidCase c{element, mu, element == Element::mixed ? 0.5 : 0.3};
    const Solution s = inflate(c, 2, 1, bc::Pressure{bc::WaveformInput{1000.0}}, bc::Support{.stiffness = 1e6}, order);
    std::vector<double> norms;
    for (const auto& record : s.last.iterations) norms.push_back(record.norm);
    norms.push_back(s.last.final_norm);
    print("Newton, %-9s %-12s nu %.2g: norms", name(order), name(element), c.poisson_ratio);
    for (const double x : norms) print(" %.2e", x);
    print("\n");
    ASSERT_GE(norms.size(), 4u);
    EXPECT_LE(norms.size(), 8u);
    // From the first relative norm below 1e-2: next <= C (this)^2 or the saturated rate.
    double constant = 0;
    for (std::size_t k = 1; k + 1 < norms.size(); ++k) {
      const double now = norms[k] / norms[0], next = norms[k + 1] / norms[0];
      if (now > 0.05) continue;
      if (next > 1e-5 * now) constant = std::max(constant, next / (now * now));
    }
    print("  largest (next / first) / (this / first)^2 outside saturation: %.2g\n", constant);
    EXPECT_LT(constant, 50.0);
  }
}

}  // namespace
}  // namespace tunica::verification
