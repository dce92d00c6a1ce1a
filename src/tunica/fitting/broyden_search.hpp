// Least squares within bounds where each evaluation is a computation of hours: Levenberg-Marquardt steps with the
// derivatives of one difference for each unknown, which from then on follow what is evaluated (Broyden 1965).
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "tunica/fitting/bounded_step.hpp"

namespace tunica::fitting {

struct BroydenOptions {
  double tolerance = 0.01;    ///< a step in which no unknown changes by more ends the search
  double difference = 0.05;   ///< of an unknown, for the derivatives
  double longest_step = 1.0;  ///< of an unknown
};

enum class Purpose { start, difference, step };

/// Where residuals are wanted next.
struct Query {
  std::vector<double> x;
  Purpose purpose = Purpose::start;
  std::size_t unknown = 0;  ///< of a difference
};

enum class SearchEnd {
  none,          ///< it goes on
  converged,     ///< the next step is shorter than the tolerance, or promises nothing
  start_failed,  ///< there are no residuals at the start
  failing        ///< there are none around the lowest place that was found
};

/// Asks for one evaluation after the other; what it asks depends on the answers alone. Steps are kept within a radius,
/// which shrinks where an evaluation fails or the squares do not fall. Derivatives are computed anew at the present
/// place where a step fails on those that have followed, and at the end if that lies far from where they were computed.
class BroydenSearch {
 public:
  BroydenSearch(std::vector<double> start, Box bounds, const BroydenOptions& options);

  /// None: it has ended.
  const std::optional<Query>& next() const { return next_; }
  /// The answer to next(): residuals, always equally many; none where the evaluation failed.
  void tell(const std::optional<std::vector<double>>& residuals);

  SearchEnd end() const { return end_; }
  /// The place with the lowest squares, of the start and all steps.
  const std::vector<double>& x() const { return x_; }
  const std::vector<double>& residuals() const { return residuals_; }
  double squares() const { return squares_; }
  /// d residuals / dx by rows; empty until all have been computed once.
  const std::vector<double>& slopes() const { return slopes_; }

 private:
  void told_difference(const std::optional<std::vector<double>>& residuals);
  void told_step(const std::optional<std::vector<double>>& residuals);
  void differentiate();
  void ask_difference();
  void ask_step();
  void arrive();
  void finish(SearchEnd end);
  std::vector<double> step_within_radius() const;
  double promise_of(const std::vector<double>& step) const;
  void follow(const std::vector<double>& moved, const std::vector<double>& residuals);

  Box bounds_;
  BroydenOptions options_;
  std::optional<Query> next_;
  SearchEnd end_ = SearchEnd::none;
  std::vector<double> x_, residuals_;
  double squares_ = 0;
  std::vector<double> slopes_, columns_;  ///< columns_: of the differences that are on their way, one after the other
  std::vector<double> x_of_slopes_;       ///< where they were computed
  std::size_t unknown_ = 0;               ///< of the difference that is asked for
  int attempt_ = 0;                       ///< at it
  double radius_;
  bool failing_ = false;  ///< the last step had no residuals
};

/// What residuals tell of unknowns, by the slopes at the minimum.
struct Estimates {
  std::vector<double> deviations;                ///< one standard deviation; infinite where the residuals do not follow
  std::vector<std::vector<double>> correlation;  ///< of the errors of two unknowns
  double variance = 1;                           ///< of the residuals, at least that of their stated uncertainty
  double quantile = 0;                           ///< a 95 % interval is as many deviations to either side
};

/// Residuals are in units of their stated deviation. `independent`: how many independent ones they stand for.
Estimates estimate(const std::vector<double>& slopes, const std::vector<double>& residuals, std::size_t unknowns,
                   double independent);

}  // namespace tunica::fitting
