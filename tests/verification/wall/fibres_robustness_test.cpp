// Newton's method with stiff fibres, k2 up to 100 and concentrations up to 30, in at most ten load steps with the
// settings that a run has by default.
#include <random>

#include "verification/wall/cylinder.hpp"

namespace tunica::verification {
namespace {

constexpr double side = 0.01;  // of the cube [m]
constexpr int most_steps = 10;

struct Stiffness {
  double k2, concentration;
};
constexpr Stiffness stiffnesses[] = {{1.0, 3.0}, {12.0, 10.0}, {100.0, 3.0}, {100.0, 30.0}};

wall::DfdParameters fibres(const Stiffness& s, double poisson_ratio) {
  wall::DfdParameters p;
  p.elastic.shear_modulus = 40e3;
  p.elastic.poisson_ratio = poisson_ratio;
  for (const double angle : {0.6, -0.6}) {
    wall::dfd::Family family;
    family.energy = {20e3, s.k2};
    family.orientation = wall::dfd::Bivariate{s.concentration, s.concentration, angle};
    p.families.push_back(family);
  }
  return p;
}

ProblemInput input(const Stiffness& s, double poisson_ratio,
                   std::vector<std::pair<std::string, bc::Condition>> conditions) {
  ProblemInput in = solid_input({Element::mixed}, std::move(conditions));
  in.wall->material = fibres(s, poisson_ratio);
  in.wall->fibre_frame = wall::ConstantFrame{};
  in.newton = {};
  in.linear = {};
  return in;
}

struct Effort {
  bool converged = true;
  int steps = 0, iterations = 0, shortened = 0;
};

void count(Effort& effort, const coupling::StepReport& report) {
  ++effort.steps;
  effort.iterations += static_cast<int>(report.iterations.size());
  for (const auto& record : report.iterations) effort.shortened += record.step_length < 1;
  effort.converged = report.converged;
}

void tell(const char* path, const Stiffness& s, const Effort& e, const std::string& failure) {
  print("%-22s k2 %3.0f, a = b = %2.0f: %s in %d steps, %d Newton iterations, %d of them shortened %s\n", path, s.k2,
        s.concentration, e.converged ? "converged" : "FAILED", e.steps, e.iterations, e.shortened, failure.c_str());
  EXPECT_TRUE(e.converged) << path << ": " << failure;
}

/// Load factors 1/n ... 1 with the loads of `problem`; before each step `prepare` may move the boundary.
template <class Prepare>
void march(const char* path, const Stiffness& s, Problem& problem, const Prepare& prepare) {
  State state = problem.initial_state();
  Effort effort;
  std::string failure;
  for (int step = 1; step <= most_steps && effort.converged; ++step) {
    const double factor = static_cast<double>(step) / most_steps;
    prepare(state, factor);
    const auto report = problem.solve_static(state, factor);
    count(effort, report);
    failure = report.failure;
  }
  tell(path, s, effort, failure);
}
void march(const char* path, const Stiffness& s, Problem& problem) {
  march(path, s, problem, [](State&, double) {});
}

distributed::DistributedMesh cube() { return share(mesh::box(3, 3, 3, {{side, side, side}}, mesh::RegionKind::wall)); }

TEST(FibreRobustness, UniaxialTensionOfAHundredKilopascal) {
  for (const auto& s : stiffnesses) {
    const auto mesh = cube();
    Problem problem(mesh, input(s, 0.5,
                                {{"x_min", held(true, false, false)},
                                 {"y_min", held(false, true, false)},
                                 {"z_min", held(false, false, true)},
                                 {"x_max", bc::Pressure{bc::WaveformInput{-1e5}}},
                                 {"y_max", bc::Free{}},
                                 {"z_max", bc::Free{}}}));
    march("uniaxial tension", s, problem);
  }
}

TEST(FibreRobustness, ShearByTwentyKilopascal) {
  for (const auto& s : stiffnesses)
    for (const double direction : {1.0, -1.0}) {
      const auto mesh = cube();
      Problem problem(mesh, input(s, 0.5,
                                  {{"x_min", bc::Free{}},
                                   {"x_max", bc::Free{}},
                                   {"y_min", bc::Fixed{}},
                                   {"y_max", bc::Traction{{{2e4 * direction, 0.0, 0.0}}}},
                                   {"z_min", bc::Free{}},
                                   {"z_max", bc::Free{}}}));
      march("shear, one face held", s, problem);
    }
}

/// The boundary follows F(t) = scale (I + t G), det F = 1, and the interior is found. The largest stretch stays where
/// fibres bear what tissue can: k2 E^2 <= 4, at which they are a thousand times as stiff as at rest for k2 = 100.
void drive_boundary(const char* path, const Stiffness& s, const Mat3<double>& G) {
  const auto mesh = cube();
  std::vector<std::pair<std::string, bc::Condition>> conditions;
  std::vector<char> moved(mesh.nodes(), 0);
  for (const std::string face : {"x_min", "x_max", "y_min", "y_max", "z_min", "z_max"}) {
    conditions.emplace_back(face, bc::Fixed{});
    for (const auto& triangle : mesh.face(face).triangles)
      for (const auto node : triangle) moved[node] = 1;
  }
  // The boundary gives the volume, so 1/K must not be zero.
  Problem problem(mesh, input(s, 0.4999, std::move(conditions)));
  march(path, s, problem, [&](State& state, double factor) {
    const Mat3<double> F = identity<double>() + factor * G;
    const Mat3<double> H = std::cbrt(1.0 / determinant(F)) * F + (-1.0) * identity<double>();
    for (std::int32_t i = 0; i < mesh.nodes(); ++i) {
      const Vec3<double> u = H * mesh.points[i];
      for (int c = 0; c < 3 && moved[i]; ++c) state.displacement[at(i) + c] = u[c];
    }
  });
}

/// Largest t <= 1 for which lambda_max^2 - 1 of I + t G stays below sqrt(4 / k2).
double bearable(const Mat3<double>& G, double k2) {
  double t = 1.0;
  for (;; t *= 0.95) {
    const Mat3<double> F = identity<double>() + t * G;
    const double J = determinant(F);
    const auto principal = wall::principal_stresses(std::pow(J, -2.0 / 3.0) * wall::right_cauchy_green(F));
    if (principal[0] - 1.0 <= std::sqrt(4.0 / k2)) return t;
  }
}

TEST(FibreRobustness, SimpleShearOfOneHalf) {
  for (const auto& s : stiffnesses)
    for (const double c : {0.5, -0.5}) {
      const Mat3<double> G{{{0, c, 0}, {0, 0, 0}, {0, 0, 0}}};
      drive_boundary("simple shear", s, bearable(G, s.k2) * G);
    }
}

TEST(FibreRobustness, RandomDeformations) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-0.25, 0.25);
  for (const auto& s : stiffnesses)
    for (int sample = 0; sample < 3; ++sample) {
      Mat3<double> G;
      for (int n = 0; n < 9; ++n) G(n / 3, n % 3) = uniform(random);
      drive_boundary("random F", s, bearable(G, s.k2) * G);
    }
}

TEST(FibreRobustness, InflationToAHundredMillimetresOfMercury) {
  for (const auto& s : stiffnesses) {
    const auto mesh = share(mesh::thick_cylinder(sizes(2), mesh::Sector::quarter));
    ProblemInput in = input(s, 0.5, plane_strain(bc::Pressure{bc::WaveformInput{13332.2}}, bc::Free{}));
    in.wall->fibre_frame = wall::CylindricalFrame{};
    Problem problem(mesh, in);
    march("inflation", s, problem);
  }
}

}  // namespace
}  // namespace tunica::verification
