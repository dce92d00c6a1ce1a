// The fit of a law to protocols: least squares from several starts, its quality, and criteria by which laws are ranked.
#pragma once

#include <optional>
#include <vector>

#include "tunica/fitting/correlation.hpp"
#include "tunica/fitting/deviation.hpp"

namespace tunica::fitting {

struct Fit {
  std::vector<double> x;                       ///< scaled unknowns
  double squares = 0.0;                        ///< weighted sum of squared residuals [kPa^2]
  Linearised at_end{};                         ///< residuals and how they change with the unknowns
  std::vector<std::vector<double>> predicted;  ///< [Pa], by protocol
  bool converged = false;
  int iterations = 0;
  std::vector<double> start_squares;  ///< where each start has ended [kPa^2]; infinite: nowhere
  Correlation correlation{};
  Deviation overall;                     ///< stresses [Pa], unweighted
  std::vector<Deviation> by_protocol{};  ///< the same of each

  double effective_count() const;     ///< of independent residuals
  double degrees_of_freedom() const;  ///< of those, what the free unknowns leave, at least 1
  /// By how many times the variance of one independent residual a sum of squares is worse than that of the fit.
  double excess(double other_squares) const;
  /// Starts that have come as low as the data can tell.
  std::size_t agreeing_starts() const;
};

/// Information criteria of Akaike and of Schwarz.
struct Criteria {
  double aic = 0.0, bic = 0.0;
};

struct FitOptions {
  int starts = 8;
  double direction_tolerance = 0.002;  ///< of the rule for dispersed fibres, relative error of the fibre stress
};

/// Sets the directions of the model. Throws SolverError when no start has a stress, InputError for tests that do not
/// suit the law.
Fit fit(Model& model, const FitOptions& options);

/// Refits without each protocol in turn, from the fit of all, and returns the deviation of the one left out, unless a
/// specimen would be left without any, or there is but one protocol. By protocol.
std::vector<std::optional<Deviation>> held_out(const Model& model, const Fit& fit);

/// Of fits to the same protocols. All count as many residuals as are independent in the best of them: what is alike in
/// the residuals of a worse law is its error, not that of the tests.
std::vector<Criteria> criteria(const std::vector<const Fit*>& fits);

}  // namespace tunica::fitting
