// The 0D twin of a vessel: what the tuning of outlets solves in place of the flow (docs/theory.md, section 7).
//
//   Q(t) -->--+-- R_v, L_v --[R_p, C, R_d]   outlet 1
//             |-- R_v, L_v --[R_p, C, R_d]   outlet 2 ...
//            C_v
#pragma once

#include <string>
#include <vector>

#include "tunica/bc/outlets.hpp"
#include "tunica/bc/waveform.hpp"

namespace tunica::zerod {

/// What lies between the inlet and one outlet.
struct VesselPath {
  double resistance = 0;  ///< R_v [Pa s/m^3]
  double inertance = 0;   ///< L_v [Pa s^2/m^3]
};

struct Vessel {
  double compliance = 0;  ///< C_v [m^3/Pa]; 0: rigid
  std::vector<VesselPath> paths;
};

/// How the outlets share the flow, and of what a Windkessel consists.
struct FlowSplit {
  std::vector<double> fractions;  ///< of the mean outflow; they add up to 1
  double distal_share = 0.9;      ///< k_d = R_d / (R_p + R_d)
  double distal_pressure = 0.0;   ///< P_d [Pa]
};

/// Resistance and compliance of all outlets together.
struct Totals {
  double resistance = 0;  ///< R_T [Pa s/m^3]
  double compliance = 0;  ///< C_T [m^3/Pa]
};

/// R_i = R_T / q_i, C_i = C_T q_i, R_d = k_d R_i, R_p = (1 - k_d) R_i, (7.1); in the order of the fractions.
std::vector<bc::Rcr> share_out(const FlowSplit& split, const Totals& totals);

/// What the twin starts from.
struct TwinState {
  double time = 0;             ///< s
  double pressure = 0;         ///< at the inlet [Pa]
  std::vector<double> flows;   ///< into the outlets [m^3/s]
  std::vector<double> stored;  ///< P_c of the outlets [Pa]
};

/// One cycle of the twin: pressure at the inlet and flows into the outlets at equally spaced times, the start excluded.
struct TwinCycle {
  std::vector<double> times, pressure;
  std::vector<std::vector<double>> flows;  ///< [outlet][time]
  TwinState end;
};

struct Pressures {
  double systolic = 0, diastolic = 0, mean = 0;  ///< [Pa]
};
/// Of a cycle that repeats itself.
Pressures pressures(const TwinCycle& cycle);
/// Of a cycle that starts from another state, such as steady flow: the largest pressure after the time `settled` [s],
/// and the smallest one after that. Before the pulse the vessel still answers to the sudden start, and that minimum
/// would pass for the diastolic pressure.
Pressures first_pressures(const std::vector<double>& times, const std::vector<double>& pressure, double mean,
                          double settled);
Pressures first_pressures(const TwinCycle& cycle, double settled);
std::vector<double> mean_flows(const TwinCycle& cycle);

/// Second-order backward differences with a thousand steps in a period, each outlet exact for a flow linear in a step.
class Twin {
 public:
  /// `inflow`: periodic with `period` [s]. As many `outlets` as paths.
  Twin(Vessel vessel, std::vector<bc::Rcr> outlets, bc::Waveform inflow, double period);

  /// The first cycle from `start` on, to the end of the period.
  TwinCycle first_cycle(const TwinState& start) const;
  /// The cycle that repeats itself. Throws SolverError when a thousand cycles do not lead to it.
  TwinCycle periodic_cycle() const;

 private:
  Vessel vessel_;
  std::vector<bc::Rcr> outlets_;
  bc::Waveform inflow_;
  double period_;
};

/// Totals for which the twin's periodic systolic and diastolic pressure are the given ones, to 1e-6 of them. Throws
/// SolverError naming the bound where no totals do that.
Totals find_totals(const FlowSplit& split, const Vessel& vessel, const bc::Waveform& inflow, double period,
                   double systolic, double diastolic);

}  // namespace tunica::zerod
