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

wall::DfdParameters fibres(const Stiffness& s) {
  wall::DfdParameters p;
  p.elastic.shear_modulus = 40e3;
  p.elastic.poisson_ratio = 0.5;
  for (const double angle : {0.6, -0.6}) {
    wall::dfd::Family family;
    family.energy = {20e3, s.k2};
    family.orientation = wall::dfd::Bivariate{s.concentration, s.concentration, angle};
    p.families.push_back(family);
  }
  return p;
}

ProblemInput input(const Stiffness& s, std::vector<std::pair<std::string, bc::Condition>> conditions) {
  ProblemInput in = solid_input({Element::mixed}, std::move(conditions));
  in.wall->material = fibres(s);
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

/// A cube whose `driven` faces follow u = factor G X while the interior is found.
void drive(const char* path, const Stiffness& s, const Mat3<double>& G,
           std::vector<std::pair<std::string, bc::Condition>> conditions, const std::vector<std::string>& driven) {
  const auto mesh = share(mesh::box(3, 3, 3, {{side, side, side}}, mesh::RegionKind::wall));
  Problem problem(mesh, input(s, std::move(conditions)));
  State state = problem.initial_state();
  std::vector<char> moved(mesh.nodes(), 0);
  for (const auto& face : driven)
    for (const auto& triangle : mesh.face(face).triangles)
      for (const auto node : triangle) moved[node] = 1;
  Effort effort;
  std::string failure;
  for (int step = 1; step <= most_steps && effort.converged; ++step) {
    for (std::int32_t i = 0; i < mesh.nodes(); ++i) {
      const Vec3<double> u = (static_cast<double>(step) / most_steps) * (G * mesh.points[i]);
      for (int c = 0; c < 3 && moved[i]; ++c) state.displacement[at(i) + c] = u[c];
    }
    const auto report = problem.solve_static(state, 1.0);
    count(effort, report);
    failure = report.failure;
  }
  tell(path, s, effort, failure);
}

const std::vector<std::string> all_faces{"x_min", "x_max", "y_min", "y_max", "z_min", "z_max"};

std::vector<std::pair<std::string, bc::Condition>> all_held() {
  std::vector<std::pair<std::string, bc::Condition>> conditions;
  for (const auto& face : all_faces) conditions.emplace_back(face, bc::Fixed{});
  return conditions;
}

TEST(FibreRobustness, UniaxialExtensionToTwentyPercent) {
  for (const auto& s : stiffnesses) {
    const Mat3<double> G{{{0.2, 0, 0}, {0, 0, 0}, {0, 0, 0}}};
    drive("uniaxial, clamped ends", s, G,
          {{"x_min", bc::Fixed{}},
           {"x_max", bc::Fixed{}},
           {"y_min", bc::Free{}},
           {"y_max", bc::Free{}},
           {"z_min", bc::Free{}},
           {"z_max", bc::Free{}}},
          {"x_min", "x_max"});
  }
}

TEST(FibreRobustness, SimpleShearOfOneHalf) {
  for (const auto& s : stiffnesses)
    for (const double c : {0.5, -0.5}) {
      const Mat3<double> G{{{0, c, 0}, {0, 0, 0}, {0, 0, 0}}};
      drive("simple shear", s, G, all_held(), all_faces);
    }
}

TEST(FibreRobustness, RandomDeformations) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-0.15, 0.15);
  for (const auto& s : stiffnesses)
    for (int sample = 0; sample < 3; ++sample) {
      Mat3<double> F = identity<double>();
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) F(i, j) += uniform(random);
      const double scale = std::cbrt(1.0 / determinant(F));  // the wall keeps its volume
      drive("random F", s, scale * F + (-1.0) * identity<double>(), all_held(), all_faces);
    }
}

TEST(FibreRobustness, InflationToAHundredMillimetresOfMercury) {
  for (const auto& s : stiffnesses) {
    const auto mesh = share(mesh::thick_cylinder(sizes(2), mesh::Sector::quarter));
    ProblemInput in = input(s, plane_strain(bc::Pressure{bc::WaveformInput{13332.2}}, bc::Free{}));
    in.wall->fibre_frame = wall::CylindricalFrame{};
    Problem problem(mesh, in);
    State state = problem.initial_state();
    Effort effort;
    std::string failure;
    for (int step = 1; step <= most_steps && effort.converged; ++step) {
      const auto report = problem.solve_static(state, static_cast<double>(step) / most_steps);
      count(effort, report);
      failure = report.failure;
    }
    tell("inflation", s, effort, failure);
  }
}

}  // namespace
}  // namespace tunica::verification
