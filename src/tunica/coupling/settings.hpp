// Settings of the time stepping and of the solvers.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tunica/base/tensor.hpp"
#include "tunica/config/schema.hpp"

namespace tunica::coupling {

struct NewtonSettings {
  double relative_tolerance = 1e-4;  ///< of the residual norm, relative to that at the start of the step
  double reference_fraction = 1e-3;  ///< a start below this share of the largest start so far counts as that share
  int max_iterations = 12;
  int line_search = 4;           ///< most halvings of an increment
  double growth = 1.2;           ///< growth of the residual norm that an increment may cause
  double mesh_tolerance = 1e-5;  ///< of the mesh motion, relative to the forces of the interface displacement
  double mass_tolerance = 1e-5;  ///< of the balance of the false lumen, relative to the largest flow through a tear

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
        .by_default()
        .number("mass_tolerance", &NewtonSettings::mass_tolerance, range(1e-14, 1),
                "What is left of the balance of the false lumen, relative to the largest flow through a tear so far, "
                "that takes one iteration more")
        .by_default();
  }
};

struct LinearSettings {
  double tolerance = 1e-4;        ///< of the residual norm, relative to the right-hand side; never solved to less
  double first_tolerance = 3e-3;  ///< the same while another Newton iteration is expected
  int max_iterations = 500;
  int restart = 200;

  static config::Schema<LinearSettings> schema() {
    using namespace config;
    return Schema<LinearSettings>("linear",
                                  "GMRES within a Newton iteration. In the last one of a step it stops at 0.03 of the "
                                  "residual that ends the step, if that comes before its own tolerance.")
        .number("tolerance", &LinearSettings::tolerance, range(1e-14, 0.5),
                "Residual norm relative to the right-hand side")
        .by_default()
        .number("first_tolerance", &LinearSettings::first_tolerance, range(1e-14, 0.5),
                "The same in the first Newton iterations of a step, after which another one follows anyway. "
                "No larger than `tolerance`: every system is solved to `tolerance`")
        .by_default()
        .integer("max_iterations", &LinearSettings::max_iterations, range(1, 100000),
                 "Iterations after which the step is rejected")
        .by_default()
        .integer("restart", &LinearSettings::restart, range(2, 2000), "Vectors kept before GMRES starts anew")
        .by_default();
  }
};

/// A run that goes on until its cycles repeat themselves.
struct CycleSettings {
  double period = 0.0;  ///< s
  int most = 10;
  double tolerance = 0.01;  ///< change from cycle to cycle, of the largest pressure and flow of each opening

  static config::Schema<CycleSettings> schema() {
    using namespace config;
    return Schema<CycleSettings>("cycles", "Cycles that are computed until they repeat themselves.")
        .quantity("period", &CycleSettings::period, dimension::time, above(0),
                  "Length of a cycle, a multiple of `step`")
        .plausible("0.3 s", "2 s")
        .integer("most", &CycleSettings::most, range(1, 10000), "Cycles after which the run ends in any case")
        .by_default()
        .number("tolerance", &CycleSettings::tolerance, between(0, 1),
                "Change of mean, largest and smallest pressure and flow of every opening from one cycle to the next "
                "that counts as none, relative to the largest pressure and the largest flow of that opening")
        .by_default();
  }
};

/// Steps whose size follows the error.
struct AdaptiveSettings {
  double tolerance = 1e-3;  ///< of the velocity in a step, relative
  double smallest = 0.0;    ///< s

  static config::Schema<AdaptiveSettings> schema() {
    using namespace config;
    return Schema<AdaptiveSettings>("adaptive", "Steps whose size follows the error in time.")
        .number("tolerance", &AdaptiveSettings::tolerance, range(1e-8, 0.5),
                "Difference of a step's velocity from that of an explicit step of first order, root mean square over "
                "the nodes, relative to the largest so far")
        .by_default()
        .quantity("smallest", &AdaptiveSettings::smallest, dimension::time, above(0),
                  "Step that the error makes no smaller; `step` is the largest, and all are halves, quarters and so on "
                  "of it");
  }
};

/// The instant of a step whose pressures and tractions act.
enum class LoadInstant {
  balance,  ///< t_{n+alpha_f}, where momentum is balanced: of second order in time
  end       ///< t_{n+1}, as related codes take them: of first order
};

struct TimeSettings {
  double step = 0.0;       ///< s
  std::int64_t steps = 0;  ///< 0: not given, as there are cycles
  std::optional<CycleSettings> cycles;
  std::optional<AdaptiveSettings> adaptive;
  double rho_infinity = 0.5;  ///< spectral radius of generalised-alpha at infinite frequency
  LoadInstant loads = LoadInstant::balance;
  int max_halvings = 6;  ///< of a rejected step

  /// Steps in a cycle; only with cycles.
  std::int64_t steps_per_cycle() const { return std::llround(cycles.value().period / step); }
  /// Steps at the end of the run at the latest.
  std::int64_t most_steps() const { return cycles ? cycles->most * steps_per_cycle() : steps; }

  static config::Schema<TimeSettings> schema();
};

/// A pressure that is held at one node, for blood that is enclosed by given velocities.
struct PressurePoint {
  Vec3<double> place{};   ///< the lumen corner nearest to it in the initial mesh is taken [m]
  double pressure = 0.0;  ///< [Pa]
};

/// Of the fixed point (prestress.hpp).
struct PrestressSettings {
  enum class Method {
    stress,   ///< additive, (5.1)
    stretch,  ///< multiplicative, (5.2)
    inverse   ///< multiplicative, from a stress-free shape of the whole wall, (5.7)
  };
  /// What the stress of a loaded wall becomes in the imaged shape, (5.4); additive method only.
  enum class Update { first_piola, second_piola };

  /// Where there is no such shape.
  enum class Fallback { stress, stretch };

  Method method = Method::stress;
  Update update = Update::first_piola;
  std::optional<Fallback> fallback{};  ///< method inverse only; none: an error
  std::vector<std::string> exclude{};  ///< wall regions that stay free of prestress
  double tolerance = 1e-6;             ///< largest displacement under the load [m]
  int max_iterations = 60;
  double relaxation = 1.0;  ///< share of an update that is taken
  int load_steps = 1;       ///< in which the load grows, with an update after each; doubled where that fails

  static config::Schema<PrestressSettings> schema();
};

}  // namespace tunica::coupling
