// Volume flows inside the lumen as the scheme conserves them (docs/theory.md, eqs 10.8, 10.9).
//
// The continuity equation tested with a function q of the nodes says of the velocity v + v' that it carries what a
// surface on which q has one value cannot tell: linear elements hold div v = 0 only together with the unresolved
// velocity v', so that v alone, integrated over a cut, leaves as much behind as v' carries.
#pragma once

#include <span>
#include <vector>

#include "tunica/coupling/loop_views.hpp"
#include "tunica/distributed/distributed_mesh.hpp"
#include "tunica/distributed/lumen_map.hpp"

namespace tunica::coupling {

/// An accepted step, as far as flows depend on it.
struct FluxStep {
  const distributed::DistributedMesh& mesh;
  FieldsView fields;  ///< at t_{n+alpha_f}
  const fluid::Parameters& parameters;
  double dt = 0;  ///< [s]
};

/// Flow of each of `count` cuts towards rising q, the sum over its elements of the integral of grad q . (v + v' - v^)
/// [m^3/s]. Collective.
std::vector<double> cut_flows(const FluxStep& step, std::span<const distributed::CutElement> cuts, std::size_t count);

/// What lies where q is one.
struct PartBalance {
  double volume = 0;       ///< integral of q [m^3]
  double volume_rate = 0;  ///< its rate as the mesh moves, integral of q div v^ [m^3/s]
  double outflow = 0;      ///< of q through the openings of the lumen, relative to them [m^3/s]
  /// The same through the faces that the blood sticks to. Between the corners the mesh moves linearly, the blood of
  /// quadratic elements as their edges do: what passes is the difference. None of linear elements.
  double leakage = 0;
};
/// `q` [local node]; `sticks` [face]: does the blood stick to it? Collective.
PartBalance part_balance(const FluxStep& step, std::span<const double> q, std::span<const char> sticks);

/// True and false lumen of a step.
struct LumenRecord {
  std::vector<double> tear_flows;  ///< into the false lumen [m^3/s]
  PartBalance in_false;
  double true_volume = 0;  ///< [m^3]
  /// Sum of the flows through the tears less what leaves by openings and through the wall and what the false lumen
  /// gains [m^3/s]. It vanishes to the tolerance of Newton's method.
  double residual = 0;
  double largest_flow = 0;                 ///< of the tears, or of outflow and rate: what `residual` compares with
  std::vector<double> viscous, numerical;  ///< dissipation of each part [W]
};

/// All but `true_volume` and the dissipation. Collective.
LumenRecord lumen_record(const FluxStep& step, const distributed::LumenMap& map);

}  // namespace tunica::coupling
