// Least squares within bounds by Levenberg-Marquardt. All unknowns lie between 0 and 1.
#pragma once

#include <functional>
#include <span>
#include <vector>

namespace tunica::fitting {

/// Residuals at unknowns x, always equally many; false where there are none, so that the step is refused.
using Residuals = std::function<bool(std::span<const double> x, std::vector<double>& residuals)>;

struct Minimum {
  std::vector<double> x{};
  std::vector<double> residuals{};
  double squares = 0.0;  ///< their sum of squares
  bool converged = false;
  int iterations = 0;
};

struct SearchOptions {
  std::vector<bool> held{};  ///< unknowns that stay at the start; none: all are free
  int most_iterations = 100;
  double tolerance = 1e-10;  ///< least relative fall of the squares
};

/// From `start`. Derivatives are central differences, or one-sided at a bound. Throws SolverError when there are no
/// residuals at the start.
Minimum minimise(const Residuals& residuals, std::vector<double> start, const SearchOptions& options = {});

struct RefitOptions {
  std::vector<bool> held{};  ///< as in SearchOptions
  bool thorough = false;     ///< J is that of the start, and only one computed at the end decides that it is the end
};

/// From a start near the minimum, with derivatives `J` of residuals about there, as jacobian() has them: Gauss-Newton
/// steps in which J follows the residuals by Broyden's updates, so that a step costs one evaluation; it is computed
/// anew where a step fails. Ends when the next step promises to take less than `enough` off the squares. For hundreds
/// of refits; the fit itself is for minimise().
Minimum refit(const Residuals& residuals, std::vector<double> start, std::vector<double>& J, double enough,
              const RefitOptions& options = {});

/// d residuals / dx by rows, `residuals.size()` times `x.size()`, by one-sided differences; zero for unknowns that are
/// held. Throws SolverError where there are none.
std::vector<double> jacobian(const Residuals& residuals, std::span<const double> x, const std::vector<bool>& held = {});

/// Points that fill the unit cube evenly, the first ones of Halton's sequence.
std::vector<std::vector<double>> scattered_starts(std::size_t unknowns, std::size_t count);

}  // namespace tunica::fitting
