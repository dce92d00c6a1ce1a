#include "tunica/stages/run/run.hpp"

#include <fmt/format.h>

#include <cstring>
#include <functional>

#include "tunica/artifacts/checkpoint.hpp"
#include "tunica/artifacts/histories.hpp"
#include "tunica/assembly/time_scheme.hpp"
#include "tunica/base/error.hpp"
#include "tunica/parallel/agree.hpp"
#include "tunica/parallel/shared_error.hpp"
#include "tunica/parallel/signals.hpp"
#include "tunica/stages/run/adaptive_steps.hpp"
#include "tunica/stages/run/run_in_steps.hpp"

namespace tunica::stages {

namespace fs = std::filesystem;
using coupling::StepReport;

namespace {

constexpr std::size_t kept_checkpoints = 2;

/// What an end without warning costs at most, beside the step under way [s].
constexpr double longest_without_checkpoint = 120;

}  // namespace

StepReport Run::attempt() {
  const double size = grid_.next_step();
  return is_static() ? problem_->solve_static(state_, grid_.time() + size) : problem_->advance(state_, size);
}

void Run::accepted(const StepReport& report, double dt, int wanted_level) {
  const double start = grid_.time();
  state_is_whole_ = false;
  grid_.accept(wanted_level);
  if (is_static())
    ++state_.step;
  else
    state_.time = grid_.time();
  last_ = {
      .step = state_.step, .time = grid_.time(), .dt = dt, .evaluated = grid_.time(), .record = {}, .report = report};
  if (!is_static())
    last_.evaluated = start + assembly::TimeScheme::generalised_alpha(dt, case_.time->rho_infinity).alpha_f * dt;
  last_.record = monitors_->evaluate(is_static() ? 0.0 : dt);
  if (at_end()) last_.faces_at_end = monitors_->faces_at_end(state_);
  last_.points = posed_.probes->evaluate(at_end() ? coupling::with_end_pressure(state_) : state_);
  on_disk([&] {
    parallel::on_root(comm_, [&] {
      histories_->append(last_, state_.outlets);
      if (lumen_histories_) lumen_histories_->append(last_.step, last_.evaluated, *last_.record.lumens);
    });
  });
  state_is_whole_ = true;

  auto& p = progress_;
  p.newton_iterations += std::ssize(report.iterations);
  p.linear_iterations += report.linear_iterations();
  p.timings.assembly += report.timings.assembly;
  p.timings.set_up += report.timings.set_up;
  p.timings.linear += report.timings.linear;
  p.timings.mesh += report.timings.mesh;
  p.timings.total += report.timings.total;
  log_->detail(step_line(report, dt) + tears_text(last_.record));
}

void Run::rejected(const StepReport& report) {
  ++progress_.rejected_steps;
  const double size = grid_.next_step();
  if (!grid_.halve()) give_up(report);
  log_->warning(fmt::format("step of {} from t = {} rejected: {}; trying {}", time_text(size), time_text(grid_.time()),
                            report.failure, time_text(grid_.next_step())));
}

// One that the error is too large for is taken back like one that failed.
void Run::judge(const StepReport& report, const coupling::State& before, double dt) {
  const StepError error = step_error(mesh_, before, state_);
  const double tolerance = case_.time->adaptive->tolerance;
  const int wanted = wanted_level(*case_.time, grid_.level(), error);
  if (wanted > grid_.level() && grid_.halve()) {
    state_is_whole_ = false;
    state_ = before;
    state_is_whole_ = true;
    ++progress_.rejected_steps;
    log_->info(fmt::format("step of {} from t = {} taken back: error {:.2e}, tolerance {:.2e}", time_text(dt),
                           time_text(grid_.time()), error.relative, tolerance));
    return;
  }
  state_.velocity_reference = error.reference;
  accepted(report, dt, wanted);
}

bool Run::take_step() {
  const auto done = grid_.steps_done();
  do {
    if (parallel::stop_requested(comm_) != 0) return false;
    const double dt = grid_.next_step();
    const bool adaptive = case_.time && case_.time->adaptive;
    const coupling::State before = adaptive ? state_ : coupling::State{};
    const StepReport report = attempt();
    if (!report.converged)
      rejected(report);
    else if (adaptive)
      judge(report, before, dt);
    else
      accepted(report, dt, 0);
  } while (!grid_.on_grid() || grid_.steps_done() == done);
  return true;
}

bool Run::finish_cycle(bool anew) {
  const auto& settings = *case_.time->cycles;
  const int cycle = static_cast<int>(grid_.steps_done() / case_.time->steps_per_cycle());
  CycleChange change;
  on_disk([&] {
    change = parallel::on_root(comm_, [&] {
      // A run may have ended after the step and before the line of its cycle.
      const bool lacks_line = folder_has_results_ && !cycles_->has(state_.step);
      return anew || lacks_line ? cycles_->append(cycle, state_.step) : cycles_->compare(cycle);
    });
  });
  parallel::broadcast(comm_, change);
  const bool periodic = change.below(settings.tolerance), last = cycle == settings.most;
  if (periodic || !last)
    log_->info(describe(change, settings));
  else
    log_->warning(describe(change, settings));
  tell_dissipation((cycle - 1) * settings.period, cycle * settings.period);
  return periodic;
}

void Run::write_fields() {
  if (fields_step_ == grid_.steps_done()) return;
  fields_->write(*writer_, grid_.steps_done(), grid_.time(), state_);
  fields_step_ = grid_.steps_done();
}

void Run::save() {
  if (checkpoint_state_ == state_.step) return;
  const fs::path file = artifacts::checkpoint_file(checkpoint_folder(), grid_.steps_done());
  on_disk([&] {
    // In this order: a checkpoint without the histories that lead to it could not be continued.
    parallel::on_root(comm_, [&] {
      histories_->sync();
      if (lumen_histories_) lumen_histories_->sync();
    });
    artifacts::write_checkpoint(file, mesh_, {state_, grid_.position(), case_hash_, mesh_hash_});
  });
  last_checkpoint_ = file;
  checkpoint_state_ = state_.step;
  parallel::on_root(comm_, [&] {
    auto files = artifacts::list_checkpoints(checkpoint_folder());
    for (std::size_t k = 0; k + kept_checkpoints < files.size(); ++k) fs::remove(files[k]);
  });
}

void Run::on_disk(const std::function<void()>& write) const {
  try {
    write();
  } catch (const SolverError& error) {
    throw SolverError(fmt::format("step {} (t = {}): {}", grid_.steps_done(), time_text(grid_.time()), error.what()));
  }
}

void Run::record(const std::string& status, const std::string& message) {
  auto& p = progress_;
  p.status = status;
  p.message = message;
  p.last_step = grid_.steps_done();
  p.time = grid_.time();
  p.total_seconds = MPI_Wtime() - started_;
  p.peak_memory = parallel::global_sum(comm_, artifacts::peak_memory());
  parallel::on_root(comm_, [&] { manifest_->write(p); });
}

void Run::give_up(const StepReport& report) {
  const auto worst = problem_->worst_node();
  std::string norms = "none";
  if (!report.iterations.empty()) norms.clear();
  for (const auto& iteration : report.iterations) norms += fmt::format("{:.3e} ", iteration.norm);
  save();
  throw SolverError(
      fmt::format("the {} did not converge from t = {} (after {}), with steps down to {}.\n"
                  "  reason: {}\n  residual norms: {}\n"
                  "  largest unbalanced force: {:.3e} N near ({:.5g}, {:.5g}, {:.5g}) m of the initial mesh\n"
                  "  last checkpoint: {}\n"
                  "  try a smaller step, more Newton iterations, or look at the results near that place",
                  is_static() ? "load step" : "time step", time_text(grid_.time()), plural(grid_.steps_done(), "step"),
                  time_text(grid_.next_step()), report.failure, norms, worst.force, worst.place[0], worst.place[1],
                  worst.place[2], last_checkpoint_.string()));
}

// An error that all ranks throw alike. Once the state is on disk nothing of the run is lost; a disk that takes no more
// is told beside the error, which stays the one that ended the run.
void Run::end_failed(const std::string& message) {
  const auto try_to = [&](const char* what, const auto& action) {
    try {
      action();
    } catch (const std::exception& error) {
      log_->warning(fmt::format("{}: {}", what, error.what()));
    }
  };
  bar_.reset();
  ended_ = true;
  if (state_is_whole_) try_to("no checkpoint of the last step", [&] { save(); });
  try_to("the manifest does not tell the end of the run", [&] { record("failed", message); });
  log_->note_error(message);
}

// An error that the other ranks may not know of: no rank waits for another.
void Run::end_alone(const std::string& message) {
  if (parallel::size(comm_) == 1) return end_failed(message);
  ended_ = true;
  try {
    artifacts::record_end(folder_, "failed", message);
  } catch (const std::exception&) {
    // The error that ends the run is told anyway.
  }
}

template <class Action>
auto Run::guarded(const Action& action) {
  try {
    return action();
  } catch (const InputError& error) {
    end_failed(error.what());
    throw;
  } catch (const SolverError& error) {
    end_failed(error.what());
    throw;
  } catch (const parallel::SharedError& error) {
    end_failed(error.what());
    throw;
  } catch (const std::exception& error) {
    end_alone(error.what());
    throw;
  } catch (...) {
    end_alone("unknown error");
    throw;
  }
}

void Run::refuse_after_end() const {
  if (ended_)
    throw InputError(folder_.string(), "holds a run that has ended", "go on from its last checkpoint by a restart");
}

bool Run::step() {
  refuse_after_end();
  return guarded([&] {
    begin();
    const auto done = grid_.steps_done();
    while (left() && grid_.steps_done() == done) take_and_write();  // one that was taken back leaves it where it was
    return grid_.steps_done() > done;
  });
}

RunOutcome Run::finish() {
  if (!ended_)
    guarded([&] {
      begin();
      end();
    });
  return {.signal = signal_, .steps = grid_.steps_done()};
}

fs::path Run::checkpoint() {
  refuse_after_end();
  guarded([&] {
    begin();
    save();
    saved_ = MPI_Wtime();
  });
  return last_checkpoint_;
}

void Run::begin() {
  if (begun_) return;
  begun_ = true;
  const std::int64_t end = end_step();
  periodic_ = at_cycle_end() && finish_cycle(false);
  nothing_to_do_ = !left();
  saved_ = begun_at_ = MPI_Wtime();
  if (nothing_to_do_) {
    log_->info(periodic_
                   ? std::string("nothing to do: the run is periodic")
                   : fmt::format("nothing to do: {} of {} are completed", grid_.steps_done(), plural(end, "step")));
    return;
  }
  if (grid_.steps_done() == 0 && grid_.on_grid()) write_fields();
  first_step_ = grid_.steps_done();
  bar_.emplace(*log_, "run", static_cast<double>(grid_.steps_done()), static_cast<double>(end));
}

void Run::take_and_write() {
  const std::int64_t end = end_step();
  if (!take_step()) {
    signal_ = parallel::stop_requested(comm_);
    return;
  }
  if (grid_.steps_done() % case_.output.every == 0) write_fields();
  const bool overdue = parallel::any(comm_, MPI_Wtime() - saved_ > longest_without_checkpoint);
  if (grid_.steps_done() % case_.output.checkpoint_every == 0 || overdue) {
    save();
    saved_ = MPI_Wtime();
  }
  if (at_cycle_end()) periodic_ = finish_cycle(true);
  bar_->update(static_cast<double>(grid_.steps_done()), progress_note(end, MPI_Wtime() - begun_at_, first_step_));
}

void Run::end() {
  bar_.reset();
  const bool stopped = left() || signal_ != 0;
  if (!nothing_to_do_) {
    if (signal_ == 0 && grid_.on_grid()) write_fields();
    save();
  }
  tell_dissipation_of_run();
  ended_ = true;
  record(stopped ? "stopped" : "completed", signal_ != 0                   ? fmt::format("signal {}", signal_)
                                            : stopped                      ? "by the program that ran it"
                                            : periodic_ && !nothing_to_do_ ? "periodic"
                                                                           : "");
  if (nothing_to_do_) return;
  if (stopped) {
    const std::string resume = request_.resume.empty() ? command("--restart") : request_.resume;
    const std::string by = signal_ != 0 ? fmt::format("stopped by SIG{}", sigabbrev_np(signal_)) : "stopped";
    log_->warning(fmt::format("{} after {}, t = {}; nothing is lost. To continue:\n  {}", by,
                              plural(grid_.steps_done(), "step"), time_text(grid_.time()), resume));
  } else {
    tell_answer();
    log_->info(fmt::format("{} in {:.1f} s ({:.1f} s set-up), {:.0f} MB of memory; results in {}",
                           plural(grid_.steps_done(), "step"), progress_.total_seconds, progress_.set_up_seconds,
                           progress_.peak_memory / 1e6, folder_.string()));
  }
}

RunOutcome run_case(const ReadCase& c, const RunRequest& request, MPI_Comm comm, std::FILE* screen) {
  Simulation simulation(c, request, comm, screen);
  while (simulation.step()) {
  }
  return simulation.finish();
}

RunOutcome run(MPI_Comm comm, const RunRequest& request, std::FILE* screen) {
  return run_case(read_case(comm, request.case_file, request.case_text), request, comm, screen);
}

RunCheck check_run(MPI_Comm comm, const fs::path& case_file) {
  const ReadCase c = read_case(comm, case_file);
  RunCheck check{.report = c.mesh.report, .warnings = c.warnings};
  check.warnings.insert(check.warnings.end(), c.mesh.warnings.begin(), c.mesh.warnings.end());
  if (const std::string earlier = check_posed(c, comm); !earlier.empty()) check.report.push_back(earlier);
  return check;
}

}  // namespace tunica::stages
