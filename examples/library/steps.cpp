// Uses tunica as a library: a law of its own at a material point, and the steps of a case with its fields between them.
//
// Usage: steps CASE STEPS
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <tunica/base/error.hpp>
#include <tunica/parallel/agree.hpp>
#include <tunica/parallel/petsc.hpp>
#include <tunica/stages/posed_case.hpp>
#include <tunica/wall/material_point.hpp>
#include <tunica/wall/materials/mooney_rivlin.hpp>

using namespace tunica;

/// Psi = c1 (I1 - 3) + c2 (I2 - 3), from its energy alone: stress and tangent follow.
struct OwnLaw {
  double c1, c2;  ///< [Pa]
  template <class T>
  T energy(const wall::Symmetric<T>& C) const {
    const T I1 = trace(C), I2 = T(0.5) * (I1 * I1 - double_dot(C, C));
    return T(c1) * (I1 - T(3.0)) + T(c2) * (I2 - T(3.0));
  }
  double shear_modulus_at_rest() const { return 2.0 * (c1 + c2); }
};
static_assert(wall::Material<OwnLaw>);

/// Largest difference of the stresses and tangents of the own law and the built-in one, relative.
double difference_of_laws() {
  const Mat3<double> F{{{1.1, 0.2, 0.0}, {-0.1, 0.95, 0.05}, {0.0, 0.1, 1.02}}};
  const wall::Volumetric volumetric{wall::VolumetricEnergy::simo_taylor, 1e6};
  const auto own = wall::material_point(F, OwnLaw{2e4, 5e3}, volumetric);
  const auto built_in = wall::material_point(F, wall::MooneyRivlin{2e4, 5e3}, volumetric);
  double size = 0.0, difference = 0.0;
  for (int n = 0; n < 21; ++n) {
    size = std::max(size, std::abs(built_in.tangent.v[n]));
    difference = std::max(difference, std::abs(own.tangent.v[n] - built_in.tangent.v[n]));
  }
  for (int n = 0; n < 6; ++n) difference = std::max(difference, std::abs(own.cauchy[n] - built_in.cauchy[n]));
  return difference / size;
}

/// Takes the steps of a case that has a course in time, and prints time, largest speed and pressure after each.
void take_steps(const char* case_file, int steps) {
  const stages::ReadCase c = stages::read_case(MPI_COMM_WORLD, case_file);
  if (!c.settings.time) throw InputError(case_file, "has no section `time`", "take a case with steps in time");
  stages::PosedCase posed;
  posed.pose(c, MPI_COMM_WORLD);
  coupling::State state = posed.problem->initial_state();
  for (int step = 0; step < steps; ++step) {
    const coupling::StepReport report = posed.problem->advance(state, c.settings.time->step);
    if (!report.converged) throw SolverError(report.failure);
    double speed = 0.0, pressure = 0.0;
    for (std::size_t node = 0; node < state.velocity_pressure.size() / 4; ++node) {
      const double* v = &state.velocity_pressure[4 * node];  // vx, vy, vz [m/s], p [Pa]
      speed = std::max(speed, std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]));
      pressure = std::max(pressure, v[3]);
    }
    speed = parallel::global_max(MPI_COMM_WORLD, speed);
    pressure = parallel::global_max(MPI_COMM_WORLD, pressure);
    if (parallel::rank(MPI_COMM_WORLD) == 0)
      std::printf("t %.6g s  speed %.6g m/s  pressure %.6g Pa\n", state.time, speed, pressure);
  }
}

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: steps CASE STEPS\n");
    return 2;
  }
  const parallel::Session session;
  try {
    if (parallel::rank(MPI_COMM_WORLD) == 0)
      std::printf("own law and built-in law differ by %.1e\n", difference_of_laws());
    take_steps(argv[1], std::atoi(argv[2]));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "steps: %s\n", error.what());
    return 1;
  }
  return 0;
}
