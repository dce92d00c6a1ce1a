// Everything that a time step starts from. Nothing else is remembered between steps, so a run that is continued from
// a saved state takes the same steps, bit for bit, on the same number of ranks.
#pragma once

#include <cstdint>
#include <vector>

#include "tunica/bc/outlets.hpp"

namespace tunica::coupling {

/// Nodal fields, [local node][4] with ghosts up to date. Twin nodes (wall side of the interface) repeat the motion of
/// their hosts. In the lumen, displacement is that of the mesh.
struct State {
  std::int64_t step = 0;
  double time = 0.0;                      ///< s
  double dt = 0.0;                        ///< size of the step that led here; 0 at the start [s]
  std::vector<double> velocity_pressure;  ///< v at t_n [m/s]; p, collocated at t_{n-1+alpha_f} [Pa]
  /// p at t_n [local node] [Pa]: that for which the pressure is linear in every step.
  std::vector<double> end_pressure;
  std::vector<double> acceleration;       ///< dv/dt at t_n, at fixed mesh node [m/s^2]
  std::vector<double> displacement;       ///< u at t_n [m]
  std::vector<double> displacement_rate;  ///< du/dt at t_n [m/s]
  std::vector<bc::Outlet> outlets;        ///< in the order of the model's outlet faces
  double residual_reference = 0.0;        ///< largest initial residual norm so far: what "small" is measured against
  double velocity_reference = 0.0;        ///< largest norm of the nodal velocities so far, for adaptive steps [m/s]
  double tear_flow_reference = 0.0;       ///< largest flow through a tear so far [m^3/s]
};

/// `state` with its pressures at t_n in the place of those at t_{n-1+alpha_f}.
State with_end_pressure(State state);

}  // namespace tunica::coupling
