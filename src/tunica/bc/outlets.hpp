// 0D outlets: resistance and three-element Windkessel (RCR), coupled implicitly to the flow through a face
// (docs/theory.md, section 4, "Outlets").
//
// What the fluid needs. The generalised-alpha scheme balances momentum at t_{n+af}, so the traction -P n of the outlet
// belongs to t_{n+af} too, driven by Q of v_{n+af}, which is (1-af) Q_n + af Q_{n+1}. Taking P at t_{n+1} instead
// would shift it by (1-af) dt and cost the second order. (The pressure field, although stored as "p_{n+1}", is the
// multiplier of that same balance.) P at t_{n+1} follows at commit, for the histories and as the start of the next
// step.
//
// Q is the flow out of the domain, [m^3/s], P in Pa, R in Pa s/m^3, C in m^3/Pa.
//
// Order of calls: `evaluate` as often as Newton likes, it changes nothing; `commit` once when a step is accepted. A
// rejected step is simply not committed.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace tunica::config {
template <class T>
class Schema;
}

namespace tunica::bc {

/// P = R Q + P_d.
struct Resistance {
  double resistance = 0.0;       ///< Pa s/m^3, >= 0
  double distal_pressure = 0.0;  ///< Pa
  static config::Schema<Resistance> schema();
};

/// P = P_c + R_p Q,  C dP_c/dt = Q - (P_c - P_d)/R_d.
struct Rcr {
  double proximal = 0.0;                        ///< R_p, Pa s/m^3, >= 0
  double capacitance = 0.0;                     ///< C, m^3/Pa, > 0
  double distal = 0.0;                          ///< R_d, Pa s/m^3, > 0
  double distal_pressure = 0.0;                 ///< P_d, Pa
  std::optional<double> initial_pressure = {};  ///< P_c(0), Pa; none: P_d
  static config::Schema<Rcr> schema();
};

/// Pressure of an outlet inside a step and its slope.
struct OutletPressure {
  double pressure = 0.0;        ///< P at t_{n+af}, Pa
  double per_end_flow = 0.0;    ///< dP(t_{n+af}) / dQ_{n+1}, Pa s/m^3
  double per_alpha_flow = 0.0;  ///< dP(t_{n+af}) / dQ_{n+af} = per_end_flow / af, Pa s/m^3
};

class Outlet {
 public:
  /// Starts at rest: Q = 0 and P_c as given. Throws InputError naming the values that are out of range.
  Outlet(std::string face, const std::variant<Resistance, Rcr>& model);

  /// Flow at the initial time, where a run does not start from rest. P_c stays.
  void set_initial_flow(double flow) { flow_ = flow; }

  /// Response at t_n + alpha_f dt when Q goes linearly from its committed value to `end_flow` at t_n + dt: exact
  /// solution of the ODE for that Q, so stable and accurate for any dt / (R_d C). 0 < alpha_f <= 1, dt > 0.
  OutletPressure evaluate(double dt, double alpha_f, double end_flow) const;
  /// The same, driven by Q_{n+af}, the flow of v_{n+af} that the fluid has at hand.
  OutletPressure evaluate_at_alpha(double dt, double alpha_f, double alpha_flow) const;
  /// Accepts the step: the state moves to t_n + dt with flow `end_flow`.
  void commit(double dt, double end_flow);

  double pressure() const;                               ///< P at the last committed time, Pa
  double flow() const { return flow_; }                  ///< Q at the last committed time
  double stored_pressure() const { return capacitor_; }  ///< P_c at the last committed time (P_d for a resistance)
  const std::string& face() const { return face_; }

  /// State for checkpoints: continuing from it gives the same bits. Parameters are not part of it.
  std::vector<double> state() const { return {flow_, capacitor_}; }
  /// Throws InputError when `values` is not what `state` gives.
  void restore(std::span<const double> values);

 private:
  struct Stored {
    double pressure;  // P_c, Pa
    double per_flow;  // its slope by the flow at that time, Pa s/m^3
  };
  Stored stored_after(double s, double end_flow) const;  // at t_n + s, Q linear from its committed value to end_flow

  std::string face_;
  double proximal_ = 0.0, distal_ = 0.0, capacitance_ = 0.0, distal_pressure_ = 0.0;  // capacitance 0: resistance
  double flow_ = 0.0;
  double capacitor_ = 0.0;
};

}  // namespace tunica::bc
