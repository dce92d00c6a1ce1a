// What the runs of an identification have found, and its files.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tunica/base/limits.hpp"
#include "tunica/fitting/broyden_search.hpp"
#include "tunica/pipeline/identify_plan.hpp"

namespace tunica::pipeline {

/// A chosen measurement beside what one run has computed, in its unit.
struct HeldAgainst {
  std::vector<std::string> what{};  ///< of single values: "mean"
  std::vector<double> times{};      ///< of a curve [s]
  std::vector<double> measured{}, deviations{}, computed{};

  /// Root mean square of the differences, in deviations.
  double misfit() const;
};

/// Those of the plan, in its order, from what the stage `post` of a run has left. Throws SolverError where a value is
/// missing. Not collective, as all here.
std::vector<HeldAgainst> read_held(const IdentifyPlan& plan, const PointCase& run);

/// Differences in deviations, each weighed so that the squares of a measurement count for its independent values.
std::vector<double> residuals_of(const IdentifyPlan& plan, const std::vector<HeldAgainst>& held);

/// A line of the table.
struct IdentifyRun {
  std::vector<double> values;  ///< of the parameters
  fitting::Query query{};
  PointState state{};
  double seconds = 0;         ///< of all its stages, shared ones included
  double misfit = base::nan;  ///< root mean square over all independent values, in deviations
  bool lowest = false;        ///< lower than all steps before it
};

struct Identified {
  std::vector<IdentifyRun> runs;
  std::size_t best = 0;                           ///< number of the run with the lowest misfit, from 0
  std::vector<HeldAgainst> first, last;           ///< of the start and of the best
  std::vector<double> slopes{};                   ///< of the residuals by the logarithms; empty: none yet
  std::optional<fitting::Estimates> estimates{};  ///< of the logarithms
  bool converged = false;
  std::string ending;  ///< why there are no more runs

  const std::vector<double>& values() const { return runs[best].values; }
  /// 95 %; none while there are no derivatives.
  std::optional<std::pair<double, double>> interval(std::size_t parameter) const;
  std::string interval_text(std::size_t parameter) const;  ///< "0.39 to 0.41"
};

/// "start", "difference of flap", "step".
std::string purpose_of(const IdentifyPlan& plan, const IdentifyRun& run);

/// What the measurements do not determine, in words.
std::vector<std::string> undetermined(const IdentifyPlan& plan, const Identified& found);

/// Writes identify.csv, identify.json, identify.html and identified.yaml. Returns lines on what was found.
std::vector<std::string> write_identified(const IdentifyPlan& plan, const Identified& found);

}  // namespace tunica::pipeline
