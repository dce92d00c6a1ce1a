// Prestress of an imaged wall by a fixed point (docs/theory.md, section 5): which stress, or which stretch, does the
// wall have in the imaged shape if that shape is in equilibrium with its loads?
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tunica/coupling/problem.hpp"
#include "tunica/coupling/settings.hpp"
#include "tunica/coupling/wall_prestress.hpp"

namespace tunica::coupling {

/// One iteration of the fixed point.
struct PrestressRecord {
  int iteration = 0;           ///< from 1
  double displacement = 0;     ///< largest |u| under the load of nodes of prestressed elements [m]; NaN when unsolved
  Vec3<double> place{};        ///< where, in the imaged shape [m]
  double relaxation = 0;       ///< of the update before it; 0 in the first
  double load = 0;             ///< share of the load
  int newton = 0, linear = 0;  ///< iterations
  double seconds = 0;
  std::string failure;  ///< why it is unsolved
};

struct PrestressResult {
  bool converged = false;
  std::string failure;                                                   ///< why not
  PrestressSettings::Method method = PrestressSettings::Method::stress;  ///< that found it
  std::string inverse_failure;  ///< why the fallback had to take over; empty when it had not
  WallPrestress prestress;
  /// Method inverse: motion from the unloaded to the imaged shape [m], [local node][3]. Empty otherwise.
  std::vector<double> unloading;
  State state;  ///< imaged shape under the load: u = 0, and the pressure of the wall, which additive prestress contains
  std::vector<PrestressRecord> history;
};

/// Fixed point for the wall of `problem`, which has no flow, under its loads at time `load_time` [s] and its nodal
/// forces. Leaves the problem with the prestress found. Throws InputError for an excluded region that is not in the
/// wall. Collective.
PrestressResult find_prestress(Problem& problem, const PrestressSettings& settings, double load_time,
                               const std::function<void(const PrestressRecord&)>& follow);

}  // namespace tunica::coupling
