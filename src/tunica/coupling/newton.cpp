// Newton's method of a step (docs/theory.md, section 4): members of Problem.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tunica/base/error.hpp"
#include "tunica/coupling/lumen_fluxes.hpp"
#include "tunica/coupling/nodal.hpp"
#include "tunica/coupling/problem.hpp"
#include "tunica/coupling/stopwatch.hpp"
#include "tunica/parallel/agree.hpp"

namespace tunica::coupling {

namespace {

// An increment that misses the linear tolerance still takes Newton's method nearer, by the share that is left of the
// linear residual: whether the step converges is decided by the nonlinear residual alone.
constexpr double usable_linear_residual = 0.05;

// How far a linear system is worth being solved (Dembo, Eisenstat & Steihaug 1982). An iteration leaves about 3 % of
// the residual, because the tangent holds tau and the inner mesh fixed. While that is more than what ends the step,
// another one follows anyway, and what is left of the linear residual need not be less. The last one leaves so little
// that the balance of mass, which the norm hardly knows, closes to 1e-6 at the default tolerances. Where iterations
// leave less than 3 %, the last one still begins close to the end, since the mesh that follows it unbalances mass.
constexpr double newton_rate = 0.03, last_share = 0.03;

double useful_residual(const LinearSettings& linear, double norm, double target) {
  if (linear.first_tolerance <= linear.tolerance) return 0;
  return newton_rate * norm > target ? std::max(linear.first_tolerance * norm, 2 * target) : last_share * target;
}

}  // namespace

// next = start + step_length * increment, and all that follows from it.
void Problem::update(const State& old_state, State& next, const Instant& instant, std::span<const double> start,
                     double step_length, NewtonRecord& record) {
  auto& unknown = instant.scheme ? next.velocity_pressure : next.displacement;
  for (std::size_t k = 0; k < unknown.size(); ++k) {
    const double value = start[k] + step_length * increment_[k];
    if (k % 4 < 3)
      unknown[k] = value;
    else
      next.velocity_pressure[k] = value;
  }
  if (instant.scheme) {
    follow_velocity(old_state, next, *instant.scheme);
    record.mesh_iterations += move_mesh(old_state, next, *instant.scheme);
  }
  synchronise_twins(next);
  record.step_length = step_length;
  evaluate_fields(old_state, next, instant);
  if (instant.scheme) scale_inflows(old_state, next, *instant.scheme);
}

double Problem::residual_norm() const { return solver_.norm(std::span(residual_).first(at(mesh_.owned_nodes))); }

Problem::Targets Problem::start(State& next, const Instant& instant, double& norm) {
  assemble(next, instant, true);
  double sum = 0;
  for (std::size_t i = 0; i < at(mesh_.owned_nodes); ++i) sum += residual_[i];
  if (!std::isfinite(parallel::global_sum(mesh_.comm, sum))) {  // inverted elements: no use in factorising
    norm = std::numeric_limits<double>::quiet_NaN();
    return {0.0, 0.0};
  }
  {
    const Stopwatch watch(timings_.set_up);
    solver_.update_preconditioner(matrix_, outlets_);
  }
  norm = residual_norm();
  next.residual_reference = std::max(next.residual_reference, norm);
  const NewtonSettings& settings = input_.newton;
  const double noise = negligible_.empty() ? 0.0 : solver_.norm(negligible_);
  const double relative =
      settings.relative_tolerance * std::max(norm, settings.reference_fraction * next.residual_reference);
  return {std::max(relative, noise), noise};
}

bool Problem::solve_increment(NewtonRecord& record, double absolute, std::string& failure) {
  const Stopwatch watch(timings_.linear);
  std::vector<double> negative(at(mesh_.owned_nodes));
  for (std::size_t i = 0; i < negative.size(); ++i) negative[i] = -residual_[i];
  const auto result = solver_.solve(matrix_, outlets_, negative, increment_, absolute);
  record.linear_iterations = result.iterations;
  const bool usable = result.converged || result.residual < usable_linear_residual;
  if (!usable)
    failure = fmt::format("the linear solver stopped after {} iterations at a relative residual of {:.2e}",
                          result.iterations, result.residual);
  return usable;
}

std::optional<double> Problem::line_search(const State& old_state, State& next, const Instant& instant, double norm,
                                           double target, NewtonRecord& record, std::string& failure) {
  std::vector<double> from = instant.scheme ? next.velocity_pressure : next.displacement;
  for (std::size_t i = 3; i < from.size(); i += 4) from[i] = next.velocity_pressure[i];
  double step_length = 1.0;
  for (int halving = 0; halving <= input_.newton.line_search; ++halving, step_length *= 0.5) {
    update(old_state, next, instant, from, step_length, record);
    failure = mesh_failure();
    if (!failure.empty()) continue;
    assemble(next, instant, false);
    const double new_norm = residual_norm();
    if (std::isfinite(new_norm) && (new_norm <= input_.newton.growth * norm || new_norm <= target)) return new_norm;
    failure = fmt::format("the residual grows from {:.3e} to {:.3e} along the Newton direction", norm, new_norm);
  }
  return std::nullopt;
}

/// The norm hardly knows what a false lumen gains or loses as a whole.
bool Problem::closes_mass(State& next, const Instant& instant) const {
  if (input_.lumens.empty() || !instant.scheme) return true;
  const auto record = lumen_record({mesh_, fields(), *input_.fluid, instant.scheme->dt}, input_.lumens);
  next.tear_flow_reference = std::max(next.tear_flow_reference, record.largest_flow);
  return std::abs(record.residual) <= input_.newton.mass_tolerance * next.tear_flow_reference;
}

void Problem::iterate(const State& old_state, State& next, const Instant& instant, StepReport& report) {
  double norm = 0;
  update_present_modulus(old_state);
  const Targets target = start(next, instant, norm);
  const double first = norm;
  bool once_more = false;  // for the balance of the false lumen
  for (int k = 0;; ++k) {
    report.final_norm = norm;
    if (!std::isfinite(norm)) {
      report.failure = k == 0 ? "an element of the wall or the lumen is inverted, or a load is not a finite number"
                              : "the residual is not a finite number";
      return;
    }
    if (norm <= target.converged && (k > 0 || norm <= target.noise)) {
      const bool last = once_more || norm <= target.noise || k == input_.newton.max_iterations;
      if (closes_mass(next, instant) || last) {
        report.converged = true;
        return;
      }
      once_more = true;
    }
    if (k == input_.newton.max_iterations) {
      report.failure = fmt::format("Newton's method did not converge in {} iterations: residual {:.3e}, asked {:.3e}",
                                   k, norm, target.converged);
      return;
    }
    // A time step keeps the modulus of its start. A load step may be long: there it follows the iterates until they are
    // close, and is then held, so that the last iterations converge quadratically.
    if (k > 0) {
      const bool follows = !instant.scheme && norm > 1e-3 * first;
      if (follows) update_present_modulus(next);
      assemble(next, instant, true);
      if (follows) norm = residual_norm();
    }
    NewtonRecord& record = report.iterations.emplace_back();
    record.norm = norm;
    const double enough = useful_residual(input_.linear, norm, target.converged);
    if (!solve_increment(record, enough, report.failure)) return;
    const auto new_norm = line_search(old_state, next, instant, norm, target.converged, record, report.failure);
    if (!new_norm) return;
    norm = *new_norm;
  }
}

StepReport Problem::newton(const State& old_state, State& next, const Instant& instant) {
  StepReport report;
  timings_ = {};
  try {
    const Stopwatch watch(timings_.total);
    iterate(old_state, next, instant, report);
  } catch (const SolverError& error) {  // thrown on all ranks alike
    report.failure = error.what();
  }
  report.timings = timings_;
  return report;
}

}  // namespace tunica::coupling
