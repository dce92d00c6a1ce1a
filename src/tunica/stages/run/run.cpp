#include "tunica/stages/run/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>

#include "tunica/artifacts/answer.hpp"
#include "tunica/artifacts/checkpoint.hpp"
#include "tunica/artifacts/histories.hpp"
#include "tunica/artifacts/lumen_histories.hpp"
#include "tunica/artifacts/step_grid.hpp"
#include "tunica/assembly/isa.hpp"
#include "tunica/assembly/time_scheme.hpp"
#include "tunica/base/error.hpp"
#include "tunica/config/units.hpp"
#include "tunica/coupling/monitors.hpp"
#include "tunica/files/hash.hpp"
#include "tunica/files/lock.hpp"
#include "tunica/files/outputs.hpp"
#include "tunica/parallel/agree.hpp"
#include "tunica/parallel/progress.hpp"
#include "tunica/parallel/shared_error.hpp"
#include "tunica/parallel/signals.hpp"
#include "tunica/stages/run/adaptive_steps.hpp"
#include "tunica/stages/run/cycles.hpp"
#include "tunica/stages/run/restart.hpp"
#include "tunica/stages/run/simulation.hpp"

namespace tunica::stages {

namespace fs = std::filesystem;
using coupling::StepReport;

namespace {

constexpr int static_halvings = 6;
constexpr std::size_t kept_checkpoints = 2;

/// What an end without warning costs at most, beside the step under way [s].
constexpr double longest_without_checkpoint = 120;

std::string plural(std::int64_t n, const char* noun) { return fmt::format("{} {}{}", n, noun, n == 1 ? "" : "s"); }

}  // namespace

/// One run from its first to its last step. Its member functions are collective.
class Run {
 public:
  Run(const ReadCase& c, const RunRequest& request, MPI_Comm comm, std::FILE* screen);
  bool step();
  RunOutcome finish();
  fs::path checkpoint();
  bool ended() const { return ended_; }
  std::int64_t steps() const { return grid_.steps_done(); }
  /// Of this call, which may be asked to stop earlier.
  std::int64_t end_step() const { return std::min(last_step(), request_.until.value_or(last_step())); }
  double time() const { return grid_.time(); }
  const artifacts::StepHistory& last() const { return last_; }
  const coupling::State& state() const { return state_; }
  const distributed::DistributedMesh& mesh() const { return mesh_; }
  const fs::path& folder() const { return folder_; }
  const OutletModel& outlet(const std::string& face) const;
  void set_outlet(const std::string& face, const OutletModel& model);

 private:
  std::size_t find_outlet(const std::string& face) const;
  /// Runs `action`; an error that it throws ends the run.
  template <class Action>
  auto guarded(const Action& action);
  void refuse_after_end() const;
  void begin();
  bool left() const { return signal_ == 0 && !periodic_ && grid_.steps_done() < end_step(); }
  void take_and_write();
  void end();
  void end_failed(const std::string& message);
  void end_alone(const std::string& message);
  fs::path checkpoint_folder() const { return folder_ / "checkpoints"; }
  bool is_static() const { return std::holds_alternative<case_file::StaticWall>(case_.analysis); }
  /// Do results show the ends of steps, in statics as well?
  bool at_end() const { return case_.output.instant == case_file::Instant::end; }
  bool continued() const { return request_.restart || request_.restart_file; }
  std::int64_t last_step() const;
  artifacts::StepGrid make_grid(const artifacts::StepGrid::Position* position) const;

  void prepare_folder();
  void try_outputs() const;
  std::string command(const char* option) const;
  void pose();
  void describe_problem();
  void restore();
  void open_outputs();

  StepReport attempt();
  /// Takes one step, in parts if it must be. False when a signal came instead.
  bool take_step();
  void accepted(const StepReport& report, double dt, int wanted_level);
  void judge(const StepReport& report, const coupling::State& before, double dt);
  bool at_cycle_end() const {
    return case_.time && case_.time->cycles && grid_.on_grid() && grid_.steps_done() > 0 &&
           grid_.steps_done() % case_.time->steps_per_cycle() == 0;
  }
  /// At the end of a cycle: does it repeat the one before? `anew`: it has just been computed.
  bool finish_cycle(bool anew);
  /// Logs what the scheme takes from the flow in steps that end within (from, until] [s], and keeps it for the
  /// manifest.
  void tell_dissipation(double from, double until);
  /// Of the run, where no cycle has told it: the last full cycle, or all steps where there is none.
  void tell_dissipation_of_run();
  void rejected(const StepReport& report);
  void write_fields();
  void save();
  void record(const std::string& status, const std::string& message);
  /// Calls `write` and adds the step to what it throws.
  void on_disk(const std::function<void()>& write) const;
  [[noreturn]] void give_up(const StepReport& report);

  std::string time_text(double seconds) const;
  std::string step_line(const StepReport& report, double dt) const;
  std::string progress_note(std::int64_t end, double seconds, std::int64_t since) const;
  double planned_time() const;
  void tell_answer();
  std::string tears_text(const coupling::StepRecord& record) const;

  const ReadCase& input_;
  const case_file::Case& case_;
  RunRequest request_;
  MPI_Comm comm_;
  double started_ = MPI_Wtime();
  fs::path folder_;
  files::FolderLock lock_;  ///< rank 0
  double time_unit_;        ///< s

  std::uint64_t case_hash_ = 0, mesh_hash_ = 0;
  bool folder_has_results_ = false;
  std::string manifest_damage_;  ///< rank 0: of the manifest of the run that is continued
  std::optional<parallel::Log> log_;
  PosedCase posed_;
  distributed::DistributedMesh& mesh_ = posed_.mesh;
  std::optional<coupling::Problem>& problem_ = posed_.problem;
  std::optional<coupling::Monitors>& monitors_ = posed_.monitors;
  std::optional<artifacts::OutputFields>& fields_ = posed_.fields;
  std::optional<distributed::ResultsWriter> writer_;
  std::optional<artifacts::Histories> histories_;             ///< rank 0
  std::optional<artifacts::LumenHistories> lumen_histories_;  ///< rank 0, with lumens
  std::optional<Cycles> cycles_;                              ///< rank 0, with cycles
  std::optional<artifacts::Manifest> manifest_;               ///< rank 0
  coupling::State state_;
  artifacts::StepGrid grid_;
  artifacts::ManifestProgress progress_;
  fs::path last_checkpoint_;
  std::int64_t fields_step_ = -1;       ///< last step whose fields are on disk
  std::int64_t checkpoint_state_ = -1;  ///< accepted steps in the last checkpoint
  bool state_is_whole_ = true;          ///< the state belongs to one instant, and the histories reach up to it
  std::optional<parallel::Progress> bar_;
  bool told_dissipation_ = false;
  std::vector<OutletModel> outlet_models_;  ///< of state_.outlets
  artifacts::StepHistory last_{.step = -1, .record = {}, .report = {}};
  bool begun_ = false, nothing_to_do_ = false, periodic_ = false, ended_ = false;
  int signal_ = 0;               ///< that ends the run
  double saved_ = 0;             ///< when the last checkpoint was written [s]
  double begun_at_ = 0;          ///< s
  std::int64_t first_step_ = 0;  ///< steps that were done when it began
};

Run::Run(const ReadCase& c, const RunRequest& request, MPI_Comm comm, std::FILE* screen)
    : input_(c),
      case_(c.settings),
      request_(request),
      comm_(comm),
      folder_(request.directory.value_or(c.settings.output.directory)),
      time_unit_(config::unit_factor(c.settings.output.units.time, config::dimension::time)),
      grid_(make_grid(nullptr)) {
  mesh_hash_ = parallel::on_root(comm_, [&] { return artifacts::mesh_hash(input_.mesh.data); });
  parallel::broadcast(comm_, mesh_hash_);
  case_hash_ = parallel::on_root(comm_, [&] { return input_.inputs.fingerprint(); });
  parallel::broadcast(comm_, case_hash_);
  if (!continued()) refuse_tables_that_end(comm_, case_, grid_, end_step());
  pose();
  prepare_folder();
  log_.emplace(comm_,
               parallel::Log::Targets{.file = folder_ / "run.log", .screen = screen, .verbose = request.verbose});
  if (!lock_.taken_over().empty()) log_->warning(lock_.taken_over());
  if (!case_.title.empty()) log_->heading(case_.title);
  for (const auto& line : input_.mesh.report) log_->detail(line);
  for (const auto& line : input_.warnings) log_->warning(line);
  for (const auto& line : input_.mesh.warnings) log_->warning(line);
  describe_problem();
  restore();
  open_outputs();
  progress_.set_up_seconds = MPI_Wtime() - started_;
  record("running", "");
}

std::int64_t Run::last_step() const {
  if (const auto* s = std::get_if<case_file::StaticWall>(&case_.analysis)) return s->load_steps;
  return case_.time->most_steps();
}

// In statics the grid is that of the load factor.
artifacts::StepGrid Run::make_grid(const artifacts::StepGrid::Position* position) const {
  const auto* statics = std::get_if<case_file::StaticWall>(&case_.analysis);
  const double nominal = statics ? 1.0 / statics->load_steps : case_.time->step;
  const int halvings = statics                ? static_halvings
                       : case_.time->adaptive ? std::max(case_.time->max_halvings, finest_level(*case_.time))
                                              : case_.time->max_halvings;
  return position ? artifacts::StepGrid(nominal, halvings, *position) : artifacts::StepGrid(nominal, halvings);
}

void Run::try_outputs() const {
  std::vector<fs::path> files{"run.log", "manifest.json", fs::path("checkpoints") / "step_00000000.checkpoint"};
  for (const auto& name : artifacts::Histories::files()) files.emplace_back(name);
  files::try_outputs(folder_, files);
}

void Run::prepare_folder() {
  folder_has_results_ = parallel::on_root(comm_, [&] {
    lock_ = files::FolderLock(folder_);
    const auto results = artifacts::find_results(folder_);
    try_outputs();
    if (!results) return false;
    if (request_.overwrite) {
      artifacts::remove_results(folder_, *results);
      return false;
    }
    const std::string where = folder_.string();
    manifest_damage_ = results->damage;
    if (!manifest_damage_.empty()) {
      if (continued()) return true;  // the checkpoint tells its mesh
      throw InputError(
          where, fmt::format("holds results of a run, but their manifest.json {}", results->damage),
          "go on with them by --restart, remove them by --overwrite, or choose another folder by --output");
    }
    const bool same_case = results->case_hash == case_hash_, same_mesh = results->mesh_hash == mesh_hash_;
    if (!continued())
      throw InputError(where,
                       fmt::format("holds results of {}case {} ({}, {})", same_case ? "this " : "another ",
                                   results->case_file, results->status, plural(results->last_step, "step")),
                       same_case ? "go on with them by --restart, remove them by --overwrite, or choose another "
                                   "folder by --output"
                                 : "choose another folder by --output, or remove them by --overwrite");
    if (!same_mesh)
      throw InputError(where, fmt::format("holds results on another mesh, of case {}", results->case_file),
                       "choose another folder by --output");
    return true;
  });
  parallel::broadcast(comm_, folder_has_results_);
}

// What can be refused is refused here, before the folder is touched and earlier results in it are removed.
void Run::pose() {
  posed_.pose(input_, comm_);
  state_ = problem_->initial_state();
  for (const auto& outlet : state_.outlets)
    for (const auto& [face, condition] : case_.boundary) {
      if (face != outlet.face()) continue;
      if (const auto* rcr = std::get_if<bc::Rcr>(&condition)) outlet_models_.emplace_back(*rcr);
      if (const auto* resistance = std::get_if<bc::Resistance>(&condition)) outlet_models_.emplace_back(*resistance);
    }
  if (const auto* statics = std::get_if<case_file::StaticWall>(&case_.analysis)) state_.time = statics->load_time;
  if (case_.start && !continued()) {
    start_from(*case_.start, case_, mesh_, mesh_hash_, state_);
    problem_->settle_mesh(state_);
  }
}

void Run::describe_problem() {
  log_->info(fmt::format("{} nodes, {} elements, {}, {}", mesh_.global_nodes, mesh_.global_elements,
                         plural(parallel::size(comm_), "rank"), assembly::name(assembly::choose_isa())));
  for (const auto& line : problem_->notes()) log_->detail(line);
  log_->info(fmt::format("{} to t = {}, into {}; every step is told in run.log", plural(end_step(), "step"),
                         time_text(planned_time()), folder_.string()));
  for (const auto& inflow : input_.inflows)
    log_->info(fmt::format("inflow of {}: a function of the program that runs this", inflow.first));
  if (case_.start && !continued()) log_->info(fmt::format("starting from {}", case_.start->string()));
}

std::string Run::command(const char* option) const {
  return fmt::format("tunica run {}{} {}", request_.case_file.string(),
                     request_.directory ? " --output " + request_.directory->string() : "", option);
}

void Run::restore() {
  if (!continued()) return;
  const fs::path name = request_.restart_file
                            ? *request_.restart_file
                            : last_whole_checkpoint(comm_, checkpoint_folder(), command("--overwrite"), *log_);
  artifacts::Checkpoint checkpoint = artifacts::read_checkpoint(
      name, mesh_, state_, mesh_hash_,
      fmt::format("restart from another checkpoint, such as the last one that is whole: {}", command("--restart")));
  if (at_end() && !checkpoint.has_end_pressure)
    throw InputError(
        "output.instant",
        fmt::format("is end, but {} holds no pressures at the ends of steps: an early version wrote it", name.string()),
        "leave output.instant as it was, or begin anew with --overwrite");
  state_ = std::move(checkpoint.state);
  grid_ = make_grid(&checkpoint.position);
  refuse_tables_that_end(comm_, case_, grid_, end_step());
  if (case_.time && case_.time->cycles && checkpoint.position.nominal != case_.time->step)
    throw InputError(
        "time.step",
        fmt::format("is {:.9g} s, in the run to be continued {:.9g} s", case_.time->step, checkpoint.position.nominal),
        "keep the step of a run in cycles, or start anew");
  last_checkpoint_ = name;
  log_->info(fmt::format("continuing from {} after {}, t = {}", name.string(), plural(grid_.steps_done(), "step"),
                         time_text(grid_.time())));
  if (checkpoint.case_hash != case_hash_)
    log_->warning(fmt::format(
        "changed since the checkpoint was written: {}; the run goes on with what is there now",
        parallel::on_root(comm_, [&] { return artifacts::changed_since(name, checkpoint.case_hash, input_.inputs); })));
}

void Run::open_outputs() {
  const bool keep = continued() && folder_has_results_;
  std::vector<std::string> lumen_faces, regions;
  for (const auto& region : mesh_.regions) regions.push_back(region.name);
  for (const auto& face : mesh_.faces)
    if (mesh_.regions[face.region].kind == mesh::RegionKind::lumen) lumen_faces.push_back(face.name);
  artifacts::ManifestHead head{.program = request_.program,
                               .case_file = request_.case_file,
                               .case_text = input_.text,
                               .inputs = input_.inputs,
                               .mesh_hash = mesh_hash_,
                               .ranks = parallel::size(comm_),
                               .nodes = mesh_.global_nodes,
                               .elements = mesh_.global_elements,
                               .regions = {},
                               .first_step = grid_.steps_done(),
                               .across = input_.mesh.across};
  for (const auto& r : input_.mesh.data.regions) head.regions.emplace_back(r.name, r.end_element - r.first_element);
  parallel::on_root(comm_, [&] {
    const auto from = keep ? std::optional(state_.step) : std::nullopt;
    if (!manifest_damage_.empty())
      log_->warning(fmt::format("{} {}: the list of the runs in this folder begins anew",
                                (folder_ / "manifest.json").string(), manifest_damage_));
    if (keep) tell_missing_fields(folder_, regions, grid_.time(), *log_);
    histories_.emplace(folder_, case_, lumen_faces, state_.outlets, from);
    for (const auto& line : histories_->damage()) log_->warning(line);
    if (posed_.lumens) {
      lumen_histories_.emplace(folder_, case_.output.units, *posed_.lumens, from);
      for (const auto& line : lumen_histories_->damage()) log_->warning(line);
    }
    if (case_.time && case_.time->cycles) {
      cycles_.emplace(folder_, case_, openings(case_, lumen_faces), from);
      for (const auto& line : cycles_->damage()) log_->warning(line);
    }
    manifest_.emplace(folder_, head, keep);
    for (const auto& file : artifacts::list_checkpoints(checkpoint_folder()))  // of a future that is computed anew
      if (artifacts::step_of(file) > grid_.steps_done()) fs::remove(file);
  });
  distributed::ResultsOptions options{.directory = folder_};
  options.length_factor = 1 / config::unit_factor(case_.output.units.length, config::dimension::length);
  if (keep) options.continue_from = grid_.time();
  writer_.emplace(mesh_, options);
}

std::string Run::time_text(double t) const {
  if (is_static()) return fmt::format("{:.6g} of the load", t);
  return fmt::format("{:.6g} {}", t / time_unit_, case_.output.units.time);
}

std::string Run::step_line(const StepReport& report, double dt) const {
  const double first = report.iterations.empty() ? report.final_norm : report.iterations[0].norm;
  return fmt::format("step {}/{}  t {}  newton {}  linear {}  norm {:.2e} -> {:.2e}  dt {}  {:.2f} s",
                     grid_.on_grid() ? grid_.steps_done() : grid_.steps_done() + 1, last_step(),
                     time_text(grid_.time()), report.iterations.size(), report.linear_iterations(), first,
                     report.final_norm, time_text(dt), report.timings.total);
}

/// "  tears +12.3 -4.5 ml/s": into the false lumen; empty without tears.
std::string Run::tears_text(const coupling::StepRecord& record) const {
  if (!record.lumens || record.lumens->tear_flows.empty()) return {};
  const std::string& unit = case_.output.units.flow;
  std::string text = "  tears";
  for (const double flow : record.lumens->tear_flows)
    text += fmt::format(" {:+.3g}", flow / config::unit_factor(unit, config::dimension::volume_flow));
  return text + " " + unit;
}

/// "step 40/80  t 0.2 s  3.1 steps/s"
std::string Run::progress_note(std::int64_t end, double seconds, std::int64_t since) const {
  const double rate = seconds > 0 ? static_cast<double>(grid_.steps_done() - since) / seconds : 0;
  const auto speed =
      rate >= 1 || rate <= 0 ? fmt::format("{:.3g} steps/s", rate) : fmt::format("{:.3g} s/step", 1 / rate);
  return fmt::format("step {}/{}  t {}  {}", grid_.steps_done(), end, time_text(grid_.time()), speed);
}

double Run::planned_time() const {
  const auto end = static_cast<double>(end_step());
  return is_static() ? end / static_cast<double>(last_step()) : end * case_.time->step;
}

// Least, mean and largest pressure and flow of each opening over the last cycle, or over the whole run.
void Run::tell_answer() {
  if (!case_.solves_fluid() || is_static()) return;
  const double from = case_.time->cycles ? (grid_.time() - case_.time->cycles->period) / time_unit_ : -HUGE_VAL;
  std::vector<std::string> faces;
  for (const auto& face : mesh_.faces)
    if (mesh_.regions[static_cast<std::size_t>(face.region)].kind == mesh::RegionKind::lumen)
      faces.push_back(face.name);
  on_disk([&] {
    parallel::on_root(comm_, [&] {
      const auto lines = artifacts::answer_lines(folder_ / "faces.csv", openings(case_, faces), from);
      if (lines.empty()) return;
      log_->heading(case_.time->cycles ? "last cycle: least, mean, largest" : "whole run: least, mean, largest");
      for (const auto& line : lines) log_->info(line);
    });
  });
}

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

void Run::tell_dissipation(double from, double until) {
  if (!case_.solves_fluid()) return;
  told_dissipation_ = true;
  on_disk([&] {
    parallel::on_root(comm_, [&] {
      progress_.dissipation = artifacts::read_dissipation(folder_, from, until, case_.elements);
      if (!progress_.dissipation) return;
      log_->info(artifacts::describe(*progress_.dissipation));
      if (const auto warning = artifacts::warning_of(*progress_.dissipation)) log_->warning(*warning);
    });
  });
}

void Run::tell_dissipation_of_run() {
  if (is_static() || told_dissipation_) return;
  const auto per_cycle = case_.time->cycles ? case_.time->steps_per_cycle() : 0;
  const auto cycle = per_cycle > 0 ? grid_.steps_done() / per_cycle : 0;
  if (cycle == 0) return tell_dissipation(-HUGE_VAL, grid_.time());
  const double period = case_.time->cycles->period;
  tell_dissipation(static_cast<double>(cycle - 1) * period, static_cast<double>(cycle) * period);
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

std::size_t Run::find_outlet(const std::string& face) const {
  std::string names;
  for (std::size_t k = 0; k < state_.outlets.size(); ++k) {
    if (state_.outlets[k].face() == face) return k;
    names += (k == 0 ? "" : ", ") + state_.outlets[k].face();
  }
  throw InputError("outlet " + face, "the case has no resistance and no Windkessel on a face of this name",
                   names.empty() ? "give a face the condition `rcr` or `resistance`" : "name one of: " + names);
}

const OutletModel& Run::outlet(const std::string& face) const { return outlet_models_[find_outlet(face)]; }

void Run::set_outlet(const std::string& face, const OutletModel& model) {
  refuse_after_end();
  const std::size_t k = find_outlet(face);
  const bool resistances = std::holds_alternative<bc::Resistance>(model);
  if (model.index() != outlet_models_[k].index())
    throw InputError("outlet " + face,
                     resistances ? "is a Windkessel, and is given the parameters of a resistance"
                                 : "is a resistance, and is given the parameters of a Windkessel",
                     "keep the kind of outlet that the case has");
  bc::Outlet changed(face, model);
  if (resistances)
    changed.set_initial_flow(state_.outlets[k].flow());  // it stores nothing
  else
    changed.restore(state_.outlets[k].state());
  state_.outlets[k] = std::move(changed);
  outlet_models_[k] = model;
  const auto* rcr = std::get_if<bc::Rcr>(&model);
  const auto* resistance = std::get_if<bc::Resistance>(&model);
  log_->info(fmt::format(
      "from t = {} on, outlet {}: {}", time_text(grid_.time()), face,
      rcr ? fmt::format("proximal {:.6g} Pa s/m^3, capacitance {:.6g} m^3/Pa, distal {:.6g} Pa s/m^3, distal pressure "
                        "{:.6g} Pa",
                        rcr->proximal, rcr->capacitance, rcr->distal, rcr->distal_pressure)
          : fmt::format("resistance {:.6g} Pa s/m^3, distal pressure {:.6g} Pa", resistance->resistance,
                        resistance->distal_pressure)));
}

Simulation::Simulation(const ReadCase& c, const RunRequest& request, MPI_Comm comm, std::FILE* screen)
    : run_(std::make_unique<Run>(c, request, comm, screen)) {}
Simulation::~Simulation() = default;
bool Simulation::step() { return run_->step(); }
RunOutcome Simulation::finish() { return run_->finish(); }
fs::path Simulation::checkpoint() { return run_->checkpoint(); }
bool Simulation::finished() const { return run_->ended(); }
std::int64_t Simulation::steps() const { return run_->steps(); }
std::int64_t Simulation::steps_asked() const { return run_->end_step(); }
double Simulation::time() const { return run_->time(); }
const artifacts::StepHistory& Simulation::last() const { return run_->last(); }
const coupling::State& Simulation::state() const { return run_->state(); }
const distributed::DistributedMesh& Simulation::mesh() const { return run_->mesh(); }
fs::path Simulation::folder() const { return run_->folder(); }
OutletModel Simulation::outlet(const std::string& face) const { return run_->outlet(face); }
void Simulation::set_outlet(const std::string& face, const OutletModel& model) { run_->set_outlet(face, model); }

RunOutcome run_case(const ReadCase& c, const RunRequest& request, MPI_Comm comm, std::FILE* screen) {
  const parallel::StopSignals signals;  // one that comes while the run is prepared ends it before the first step
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
