// Settings of the time stepping and of the solvers.
#pragma once

#include "tunica/config/schema.hpp"

namespace tunica::coupling {

struct NewtonSettings {
  double relative_tolerance = 1e-4;  ///< of the residual norm, relative to that at the start of the step
  double reference_fraction = 1e-3;  ///< a start below this share of the largest start so far counts as that share
  int max_iterations = 12;
  int line_search = 4;           ///< most halvings of an increment
  double growth = 1.2;           ///< growth of the residual norm that an increment may cause
  double mesh_tolerance = 1e-5;  ///< of the mesh motion, relative to the forces of the interface displacement

  static config::Schema<NewtonSettings> schema() {
    using namespace config;
    return Schema<NewtonSettings>("newton", "Newton's method within a step.")
        .number("relative_tolerance", &NewtonSettings::relative_tolerance, range(1e-14, 0.1),
                "Residual norm that ends a step, relative to the norm at its start")
        .by_default()
        .number("reference_fraction", &NewtonSettings::reference_fraction, range(0, 1),
                "A step that starts from less than this fraction of the largest starting norm so far is measured "
                "against that fraction, so that a run near a steady state does not chase round-off")
        .by_default()
        .integer("max_iterations", &NewtonSettings::max_iterations, range(1, 200),
                 "Iterations after which the step is rejected")
        .by_default()
        .integer("line_search", &NewtonSettings::line_search, range(0, 20),
                 "Most halvings of an increment that makes the residual grow")
        .by_default()
        .number("growth", &NewtonSettings::growth, range(0.5, 1e6),
                "Growth of the residual norm that an increment may cause")
        .by_default()
        .number("mesh_tolerance", &NewtonSettings::mesh_tolerance, range(1e-14, 0.1),
                "Residual of the mesh motion, relative to the forces of the interface displacement")
        .by_default();
  }
};

struct LinearSettings {
  double tolerance = 1e-4;  ///< of the residual norm, relative to the right-hand side
  int max_iterations = 500;
  int restart = 200;

  static config::Schema<LinearSettings> schema() {
    using namespace config;
    return Schema<LinearSettings>("linear", "GMRES within a Newton iteration.")
        .number("tolerance", &LinearSettings::tolerance, range(1e-14, 0.5),
                "Residual norm relative to the right-hand side")
        .by_default()
        .integer("max_iterations", &LinearSettings::max_iterations, range(1, 100000),
                 "Iterations after which the step is rejected")
        .by_default()
        .integer("restart", &LinearSettings::restart, range(2, 2000), "Vectors kept before GMRES starts anew")
        .by_default();
  }
};

struct TimeSettings {
  double step = 0.0;  ///< s
  std::int64_t steps = 0;
  double rho_infinity = 0.5;  ///< spectral radius of generalised-alpha at infinite frequency
  int max_halvings = 6;       ///< of a rejected step

  static config::Schema<TimeSettings> schema() {
    using namespace config;
    return Schema<TimeSettings>("time", "Time stepping.")
        .quantity("step", &TimeSettings::step, dimension::time, above(0), "Step size")
        .plausible("0.001 ms", "100 ms")
        .integer("steps", &TimeSettings::steps, range(1, 1e9), "Number of steps of that size")
        .number("rho_infinity", &TimeSettings::rho_infinity, range(0, 1),
                "Spectral radius of the generalised-alpha scheme at infinite frequency: 1 no damping, 0 most")
        .by_default()
        .integer("max_halvings", &TimeSettings::max_halvings, range(0, 30),
                 "How often a rejected step may be halved before the run stops")
        .by_default();
  }
};

}  // namespace tunica::coupling
