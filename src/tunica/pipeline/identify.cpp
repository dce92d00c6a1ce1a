#include "tunica/pipeline/identify.hpp"

#include <fmt/format.h>

#include <cmath>

#include "tunica/base/error.hpp"
#include "tunica/files/csv_file.hpp"
#include "tunica/files/lock.hpp"
#include "tunica/files/outputs.hpp"
#include "tunica/parallel/agree.hpp"
#include "tunica/parallel/patience.hpp"
#include "tunica/pipeline/figures.hpp"
#include "tunica/pipeline/foresight.hpp"
#include "tunica/pipeline/identify_results.hpp"
#include "tunica/pipeline/plan.hpp"

namespace tunica::pipeline {

namespace {

/// In the logarithms of the parameters, so that all steps are relative.
fitting::BroydenSearch search_of(const IdentifyPlan& plan) {
  std::vector<double> start;
  fitting::Box bounds;
  for (const auto& p : plan.parameters) {
    start.push_back(std::log(p.start));
    bounds.low.push_back(std::log(p.low));
    bounds.high.push_back(std::log(p.high));
  }
  return {std::move(start),
          std::move(bounds),
          {.tolerance = plan.settings.tolerance, .difference = std::log1p(plan.settings.difference)}};
}

class Identification {
 public:
  Identification(const IdentifyRequest& request, MPI_Comm comm, std::FILE* screen)
      : request_(request), comm_(comm), screen_(screen) {}

  IdentifyOutcome all() {
    begin();
    if (request_.dry_run) return {};
    IdentifyOutcome outcome;
    while (outcome.signal == 0) {
      std::string file = parallel::on_root(comm_, [&] { return prepare(); });
      parallel::broadcast(comm_, file);
      if (file.empty()) break;
      ChainRequest chain;
      chain.case_file = file;
      chain.program = request_.program;
      const PointEnd end = run_point(chain, comm_, screen_);
      parallel::on_root_patiently(comm_, [&] { take(end); });
      outcome.signal = end.signal;
    }
    outcome.converged = parallel::on_root(comm_, [&] { return finish(outcome.signal); });
    parallel::broadcast(comm_, outcome.converged);
    return outcome;
  }

 private:
  void begin() {
    parallel::on_root_patiently(comm_, [&] {
      plan_ = plan_identify(request_.file, request_.output);
      search_ = search_of(plan_);
      CaseFiles cases(!request_.dry_run);
      cases.make_folder(plan_.output);
      files::try_outputs(plan_.output, {"identify.csv", "identify.json", "identify.html", "identified.yaml"});
      const PointCase first = case_of_run(plan_, 1, values_of(*search_->next()));
      files::refuse_if_owned_by_another(first.folder);
      if (!request_.dry_run) {
        lock_ = files::FolderLock(plan_.output);
        if (!lock_.taken_over().empty()) say("warning: " + lock_.taken_over());
        // Those of another case or other measurements would look like the answer to this one until it is found.
        files::remove_outputs(plan_.output, {"identify.csv", "identify.json", "identify.html", "identified.yaml"});
      }
      cases.write(first);
      std::vector<Problem> warnings;
      check_on_meshes(read_chain(first.file, std::nullopt, warnings));  // the chains tell the warnings
      if (request_.dry_run) foretell(first);
    });
  }

  // --- rank 0 -------------------------------------------------------------------------------------------------------

  void say(const std::string& line) const {
    std::fprintf(screen_, "%s\n", line.c_str());
    std::fflush(screen_);
  }

  /// Those that the case files hold: bounds are met as they are written.
  static std::vector<double> values_of(const fitting::Query& query) {
    std::vector<double> values;
    for (const double x : query.x) values.push_back(std::exp(x));
    return values;
  }

  void foretell(const PointCase& first) const {
    for (const auto& p : plan_.parameters)
      say(fmt::format("{}: starts at {}, between {} and {}", p.name, p.shown(p.start), p.shown(p.low),
                      p.shown(p.high)));
    for (const auto& m : plan_.measurements)
      say(fmt::format("{}: {}, counts for {} values", m.path(), m.curve ? "a curve" : "single values", m.independent));
    const std::size_t n = plan_.parameters.size();
    say(fmt::format("\nruns: 1 at the start, {} for derivatives, and 3 to 8 steps as a rule{}; at most {}", n,
                    n > 1 ? fmt::format(", with derivatives once more at the end: {} to {}", n + 4, 2 * n + 9) : "",
                    plan_.settings.max_runs));
    say("the first one:");
    ChainRequest chain;
    chain.case_file = first.file;
    chain.program = request_.program;
    for (const auto& line : check_chain(chain, false)) say("  " + line);
    for (const auto& [stage, folder] : plan_.shared)
      say(fmt::format("  shared by all: {} in {}", stage, folder.lexically_relative(plan_.output).string()));
  }

  /// The case file of the next run; empty: there is none.
  std::string prepare() {
    if (!search_->next() || runs_.size() == static_cast<std::size_t>(plan_.settings.max_runs)) return {};
    auto& run = runs_.emplace_back(IdentifyRun{.values = values_of(*search_->next()), .query = *search_->next()});
    point_ = case_of_run(plan_, runs_.size(), run.values);
    say(fmt::format("\n##### run {}, {} ({}), of at most {}", runs_.size(), purpose_of(plan_, run),
                    plan_.text(run.values), plan_.settings.max_runs));
    write_case(point_);
    write_state(point_, {"running", ""});
    return point_.file.string();
  }

  void take(const PointEnd& end) {
    auto& run = runs_.back();
    run.state = state_of(end);
    std::vector<HeldAgainst> held;
    if (run.state.status == "done") try {
        held = read_held(plan_, point_);
      } catch (const SolverError& error) {
        run.state = {"failed", error.what()};
      }
    run.seconds = seconds_of(point_);
    write_state(point_, run.state);
    if (end.signal != 0) return;
    if (held.empty()) {
      say(fmt::format("run {} failed: {}", runs_.size(), run.state.message));
      search_->tell(std::nullopt);
      if (search_->end() == fitting::SearchEnd::start_failed)
        throw SolverError(fmt::format("the first run, {}, failed: {}", plan_.text(run.values), run.state.message));
      return;
    }
    tell(run, std::move(held));
  }

  void tell(IdentifyRun& run, std::vector<HeldAgainst> held) {
    const auto residuals = residuals_of(plan_, held);
    double squares = 0;
    for (const double r : residuals) squares += r * r;
    run.misfit = std::sqrt(squares / plan_.independent());
    const bool step = run.query.purpose != fitting::Purpose::difference;
    run.lowest = step && (runs_.size() == 1 || squares < search_->squares());
    search_->tell(residuals);
    if (runs_.size() == 1) first_ = held;
    if (run.lowest) {
      best_ = runs_.size() - 1;
      last_ = std::move(held);
    }
    say(fmt::format(
        "run {}: misfit {} deviations{}", runs_.size(), figure_text(run.misfit),
        run.lowest ? "" : fmt::format("; the lowest is {} of run {}", figure_text(runs_[best_].misfit), best_ + 1)));
  }

  std::string ending(int signal) const {
    if (signal != 0) return fmt::format("Stopped by signal {}; the same command goes on.", signal);
    switch (search_->end()) {
      case fitting::SearchEnd::converged:
        return fmt::format("Converged after {} runs.", runs_.size());
      case fitting::SearchEnd::failing:
        return fmt::format("Not converged: after {} runs, those around the best values fail.", runs_.size());
      default:
        return fmt::format("Not converged after {} runs, as many as `max_runs` allows.", runs_.size());
    }
  }

  /// Has it converged?
  bool finish(int signal) {
    if (first_.empty()) return false;  // stopped in the first run
    Identified found{.runs = runs_,
                     .best = best_,
                     .first = first_,
                     .last = last_,
                     .slopes = search_->slopes(),
                     .converged = search_->end() == fitting::SearchEnd::converged,
                     .ending = ending(signal)};
    if (!found.slopes.empty())
      found.estimates =
          fitting::estimate(found.slopes, search_->residuals(), plan_.parameters.size(), plan_.independent());
    for (const auto& line : write_identified(plan_, found)) say(line);
    if (signal == 0) tell_of_other_runs();
    return found.converged;
  }

  /// Folders of more runs than there were are of an earlier identification.
  void tell_of_other_runs() const {
    std::vector<std::string> others;
    for (auto k = runs_.size() + 1; k <= static_cast<std::size_t>(plan_.settings.max_runs); ++k)
      if (const auto other = case_of_run(plan_, k, runs_.front().values); std::filesystem::exists(other.file))
        others.push_back(other.folder.filename().string());
    if (!others.empty()) say(fmt::format("of an earlier identification, not of this one: {}", files::listed(others)));
  }

  const IdentifyRequest& request_;
  MPI_Comm comm_;
  std::FILE* screen_;

  IdentifyPlan plan_;  ///< rank 0, as what follows
  files::FolderLock lock_;
  std::optional<fitting::BroydenSearch> search_;
  PointCase point_;  ///< of the last run
  std::vector<IdentifyRun> runs_;
  std::size_t best_ = 0;
  std::vector<HeldAgainst> first_, last_;
};

}  // namespace

IdentifyOutcome identify(const IdentifyRequest& request, MPI_Comm comm, std::FILE* screen) {
  return Identification(request, comm, screen).all();
}

}  // namespace tunica::pipeline
