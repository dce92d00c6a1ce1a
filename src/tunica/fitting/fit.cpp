#include "tunica/fitting/fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tunica/base/error.hpp"

namespace tunica::fitting {

double Fit::effective_count() const { return static_cast<double>(at_end.residuals.size()) / correlation.length; }

double Fit::degrees_of_freedom() const {
  const auto open = static_cast<double>(std::count(at_end.held.begin(), at_end.held.end(), false));
  return std::max(effective_count() - open, 1.0);
}

double Fit::excess(double other_squares) const {
  if (!(squares > 0.0)) return other_squares > 0.0 ? std::numeric_limits<double>::infinity() : 0.0;
  return degrees_of_freedom() * (other_squares / squares - 1.0);
}

std::size_t Fit::agreeing_starts() const {
  return static_cast<std::size_t>(
      std::count_if(start_squares.begin(), start_squares.end(), [&](double s) { return excess(s) < 1.0; }));
}

std::vector<Criteria> criteria(const std::vector<const Fit*>& fits) {
  const auto best =
      std::min_element(fits.begin(), fits.end(), [](const Fit* a, const Fit* b) { return a->squares < b->squares; });
  std::vector<Criteria> all;
  for (const Fit* f : fits) {
    const double n = (*best)->effective_count();
    // The noise is the parameter that comes to those of the law.
    const double parameters = static_cast<double>(f->x.size()) + 1.0;
    const double mean = std::max(f->squares, 1e-300) / static_cast<double>(f->at_end.residuals.size());
    all.push_back({2.0 * parameters + n * std::log(mean), parameters * std::log(n) + n * std::log(mean)});
  }
  return all;
}

namespace {

Deviation of_all(const std::vector<std::vector<double>>& curves, const std::vector<std::vector<double>>& measured) {
  std::vector<double> c, m;
  for (const auto& x : curves) c.insert(c.end(), x.begin(), x.end());
  for (const auto& x : measured) m.insert(m.end(), x.begin(), x.end());
  return deviation(c, m);
}

void complete(const Model& model, const Residuals& residuals, Fit& fit) {
  const auto measured = model.measured();
  fit.predicted = model.predicted(fit.x);
  fit.at_end.slopes = jacobian(residuals, fit.x);
  constexpr double at_bound = 1e-6;
  for (const double x : fit.x) fit.at_end.held.push_back(x < at_bound || x > 1.0 - at_bound);
  fit.correlation = correlation_of(model, fit.at_end);
  fit.overall = of_all(fit.predicted, measured);
  for (std::size_t k = 0; k < measured.size(); ++k) fit.by_protocol.push_back(deviation(fit.predicted[k], measured[k]));
}

}  // namespace

Fit fit(Model& model, const FitOptions& options) {
  const Residuals residuals = model.against(model.measured());
  std::vector<std::vector<double>> starts{model.start()};
  for (auto& s : scattered_starts(model.unknowns().size(), static_cast<std::size_t>(std::max(options.starts - 1, 0))))
    starts.push_back(std::move(s));
  model.choose_directions(starts.front(), options.direction_tolerance);
  try {
    model.predicted(starts.front());  // tests that do not suit the law are an error, not a start without stress
  } catch (const SolverError&) {
  }

  Fit result;
  result.squares = std::numeric_limits<double>::infinity();
  std::vector<std::vector<double>> ends;
  for (auto& start : starts) {
    double squares = std::numeric_limits<double>::infinity();
    try {
      // Far from a minimum few digits do; the best is polished below.
      const Minimum end = minimise(residuals, std::move(start), {.held = {}, .most_iterations = 40, .tolerance = 1e-4});
      squares = end.squares;
      if (squares < result.squares) {
        result.squares = squares;
        result.x = end.x;
      }
    } catch (const SolverError&) {  // no stress at this start; there are others
    }
    result.start_squares.push_back(squares);
  }
  if (result.x.empty())
    throw SolverError("the law has no stress at any of the starting values: narrow the bounds of its parameters");
  // The rule that suits the start need not suit the end.
  model.choose_directions(result.x, options.direction_tolerance);
  const Minimum best = minimise(residuals, result.x, {.held = {}, .most_iterations = 100, .tolerance = 1e-9});
  result.x = best.x;
  result.squares = best.squares;
  result.at_end.residuals = best.residuals;
  result.converged = best.converged;
  result.iterations = best.iterations;
  complete(model, residuals, result);
  return result;
}

std::vector<std::optional<Deviation>> held_out(const Model& model, const Fit& fit) {
  const std::vector<Protocol>& all = model.protocols();
  const auto measured = model.measured();
  std::vector<std::optional<Deviation>> deviations(all.size());
  for (std::size_t k = 0; k < all.size(); ++k) {
    const auto alike =
        std::count_if(all.begin(), all.end(), [&](const Protocol& p) { return p.specimen == all[k].specimen; });
    if (alike < 2) continue;
    const Residuals residuals = [&](std::span<const double> x, std::vector<double>& r) {
      if (!model.residuals(x, measured, r)) return false;
      std::size_t offset = 0;
      for (std::size_t j = 0; j < k; ++j) offset += all[j].values();
      std::fill_n(r.begin() + static_cast<std::ptrdiff_t>(offset), all[k].values(), 0.0);
      return true;
    };
    std::vector<double> J = jacobian(residuals, fit.x);
    const Minimum without = refit(residuals, fit.x, J, 1e-5 * fit.squares);
    deviations[k] = deviation(model.predicted(without.x)[k], measured[k]);
  }
  return deviations;
}

}  // namespace tunica::fitting
