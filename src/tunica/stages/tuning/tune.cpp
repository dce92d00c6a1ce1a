#include "tunica/stages/tuning/tune.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tunica/artifacts/checkpoint.hpp"
#include "tunica/artifacts/load_mesh.hpp"
#include "tunica/artifacts/outlets_file.hpp"
#include "tunica/artifacts/run_folder.hpp"
#include "tunica/base/error.hpp"
#include "tunica/case/case_text.hpp"
#include "tunica/config/units.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/files/lock.hpp"
#include "tunica/files/outputs.hpp"
#include "tunica/parallel/agree.hpp"
#include "tunica/parallel/log.hpp"
#include "tunica/parallel/signals.hpp"
#include "tunica/stages/tuning/tuning_report.hpp"

namespace tunica::stages {

namespace {

namespace fs = std::filesystem;

constexpr double probed_share = 0.35;  ///< of a cycle: enough of the pulse to tell compliance and paths
constexpr int default_steps = 200;     ///< in a cycle
constexpr const char* start_file = "start.checkpoint";
constexpr int fewest_steps = 20;
/// Of Newton's method in the tuning runs: pressures and flows are right to 1e-4 then (docs/performance.md), and the
/// outlets to a hundredth at best.
constexpr double newton_tolerance = 1e-3;

/// Six digits: a machine that rounds otherwise comes to the same case, and finds its runs again.
double rounded(double value) { return std::stod(fmt::format("{:.5e}", value)); }

/// What a run in 3D is given.
struct Plan {
  zerod::Totals totals;
  std::vector<double> stored;  ///< P_c at the start [Pa]
};

/// The one lumen face with a flow condition. Adds to `problems` what else stands in the way.
std::string find_inlet(const case_file::Case& c, const std::vector<bc::BoundaryFace>& faces,
                       std::vector<Problem>& problems) {
  std::vector<std::string> inlets;
  const auto& shares = c.outlets->fractions;
  for (const auto& [name, condition] : c.boundary) {
    const bool of_lumen = std::any_of(faces.begin(), faces.end(), [&, &n = name](const auto& face) {
      return face.name == n && face.field == bc::Field::lumen;
    });
    if (!of_lumen) continue;
    if (std::holds_alternative<bc::Flow>(condition))
      inlets.push_back(name);
    else if (!std::holds_alternative<bc::NoSlip>(condition) && !std::holds_alternative<bc::Symmetry>(condition) &&
             std::none_of(shares.begin(), shares.end(), [&, &n = name](const auto& f) { return f.first == n; }))
      problems.push_back({"boundary." + name, fmt::format("has the condition {}", bc::name(condition)),
                          "beside the face with the inflow every opening is an outlet: give it a share in "
                          "outlets.fractions"});
  }
  if (inlets.size() == 1) return inlets[0];
  problems.push_back({"boundary", fmt::format("{} faces of the lumen have a flow condition", inlets.size()),
                      "the tuning needs one inlet with a periodic flow"});
  return "";
}

/// A ramp belongs to runs that start from rest; the tuning looks at the periodic state.
bc::Waveform inflow_without_ramp(const case_file::Case& c, const std::string& inlet) {
  const auto at = std::find_if(c.boundary.begin(), c.boundary.end(), [&](const auto& b) { return b.first == inlet; });
  auto flow = std::get<bc::Flow>(at->second);
  flow.course.ramp_time = 0;
  return bc::inflow(flow);
}

/// One `tunica tune`. Its member functions are collective.
class Tuning {
 public:
  Tuning(MPI_Comm comm, const TuneRequest& request, std::FILE* screen);
  /// To the end, or to another one, of which tuning.json tells.
  int steps();

 private:
  void read();
  void prepare_folder();
  void remove_earlier();

  const case_file::TuningCase& settings() const { return *case_.settings.outlets; }
  bool rigid() const { return std::holds_alternative<case_file::RigidFlow>(case_.settings.analysis); }
  fs::path folder() const { return settings().output; }
  std::string mmHg(double pressure) const {
    return fmt::format("{:.4g}", pressure / config::unit_factor("mmHg", config::dimension::pressure));
  }

  Plan make_plan(const zerod::Vessel& vessel, double systolic, double diastolic);
  /// Computes a case in 3D with the outlets of the plan, or takes what is there. False when a signal came.
  bool compute(const std::string& name, const Plan& plan, int steps);
  artifacts::TunedOutlets tuned_outlets(const Plan& plan) const;
  ReadCase run_input(const std::string& name, const Plan& plan, int steps) const;
  /// How a run in 3D is to begin.
  struct Start {
    bool done = false, restart = false, overwrite = false;
  };
  /// For rank 0.
  Start start_of_run(const fs::path& results, const ReadCase& input);
  /// Is what a completed run has measured still there?
  bool has_measured(const fs::path& results, double duration);
  void look_at_probe();
  void look_at_cycle(int number, const Plan& plan);
  void tell(int number, const TuningCycle& cycle);
  void write_result(const fs::path& file, const TuningCycle& cycle, const char* status);
  /// For rank 0: start.checkpoint, the state at the end of a cycle.
  void keep_end_of(const std::string& cycle);
  std::string command(const std::string& option) const {
    return fmt::format("tunica tune {}{}{}{}", request_.case_file.string(),
                       request_.directory ? " --output " + request_.directory->string() : "", option.empty() ? "" : " ",
                       option);
  }
  int finish();
  int look_for_outlets();
  void record(const char* status);
  [[noreturn]] void give_up();

  MPI_Comm comm_;
  const TuneRequest& request_;
  std::FILE* screen_;
  double started_ = MPI_Wtime();
  ReadCase case_;
  std::string inlet_;
  std::optional<bc::Waveform> inflow_;  ///< rank 0
  double period_ = 0;                   ///< s
  int steps_per_cycle_ = 0;
  int signal_ = 0;
  bool report_is_damaged_ = false;  ///< rank 0: that of an earlier call
  files::FolderLock lock_;          ///< rank 0
  std::optional<parallel::Log> log_;
  TuningReport report_;  ///< rank 0
};

Tuning::Tuning(MPI_Comm comm, const TuneRequest& request, std::FILE* screen)
    : comm_(comm), request_(request), screen_(screen) {
  read();
  prepare_folder();
  log_.emplace(comm_, parallel::Log::Targets{.file = folder() / "tune.log", .screen = screen});
  if (report_is_damaged_)
    log_->warning(fmt::format("{} is cut off or altered; the runs in this folder tell whether they are of this case",
                              (folder() / "tuning.json").string()));
  if (!lock_.taken_over().empty()) log_->warning(lock_.taken_over());
  if (rigid() || case_.settings.start) return;
  log_->warning(
      "the case names no `start`: the wall of the first cycle is not yet under its diastolic pressure, and what the "
      "cycle tells is doubtful. Find the prestress first: `tunica prestress`");
}

void Tuning::read() {
  parallel::on_root(comm_, [&] {
    case_.text = request_.case_text ? *request_.case_text : config::read_text(request_.case_file);
    auto parsed = case_file::read_case(case_.text, request_.case_file);
    case_.settings = std::move(parsed.value);
    for (const auto& warning : parsed.warnings) case_.warnings.push_back(format(warning));
    if (!case_.settings.outlets)
      throw InputError(request_.case_file.string(), "has no section `outlets`",
                       "add `outlets: {systolic: 125 mmHg, diastolic: 75 mmHg, fractions: {<outlet>: 1}}`");
    case_.mesh = artifacts::load_mesh(case_.settings);
    case_.inputs = artifacts::run_inputs(case_.text, request_.case_file);
  });
  parallel::broadcast(comm_, case_.text);
  if (parallel::rank(comm_) != 0) case_.settings = case_file::parse_case(case_.text, request_.case_file);
  artifacts::name_faces(case_.settings, case_.mesh, comm_);
  if (request_.directory) case_.settings.outlets->output = *request_.directory;
  case_.settings.outlets->continued = false;  // each run of the tuning has outlets of its own
  parallel::on_root(comm_, [&] {
    TuningBasis basis = tuning_basis(case_.settings, artifacts::faces_of(case_.mesh.data));
    inlet_ = basis.inlet;
    inflow_ = std::move(basis.inflow);
    period_ = basis.period;
    steps_per_cycle_ = basis.steps_per_cycle;
  });
  parallel::broadcast(comm_, inlet_);
  parallel::broadcast(comm_, period_);
  parallel::broadcast(comm_, steps_per_cycle_);
}

void Tuning::prepare_folder() {
  parallel::on_root(comm_, [&] {
    report_.folder = folder();
    report_.program = request_.program;
    report_.inputs = case_.inputs;
    lock_ = files::FolderLock(folder());
    const auto earlier = find_tuning(folder());
    report_is_damaged_ = earlier && !earlier->inputs;
    const auto known = earlier ? earlier->inputs.value_or(report_.inputs) : report_.inputs;
    if (known != report_.inputs && !request_.overwrite)
      throw InputError(folder().string(),
                       fmt::format("holds the tuning of another case, or of this one before it was changed: {}",
                                   artifacts::text_of(artifacts::difference(known, report_.inputs))),
                       "replace it by --overwrite, or name another folder by --output");
    if (!earlier && !request_.overwrite && fs::exists(settings().file()))
      throw InputError(settings().file().string(), "is there already, and no tuning beside it that it came from",
                       "replace it by --overwrite, or name another one by outlets.file");
    files::try_outputs(folder(), {"tune.log", "tuning.json", "tuning.csv", "best.yaml", start_file});
    files::try_output(settings().file());
    if (earlier && request_.overwrite) remove_earlier();
    for (const fs::path& file : {settings().file(), folder() / "best.yaml", folder() / start_file}) fs::remove(file);
    write_report(report_, case_.settings);
  });
}

void Tuning::remove_earlier() {
  std::vector<fs::path> runs{folder() / "probe"};
  for (int k = 1; fs::exists(folder() / fmt::format("cycle_{}", k)); ++k)
    runs.push_back(folder() / fmt::format("cycle_{}", k));
  for (const auto& run : runs)
    if (const auto results = artifacts::find_results(run)) artifacts::remove_results(run, *results);
  for (const char* file : {"tuning.csv", "tuning.svg", "pressure.svg"}) fs::remove(folder() / file);
}

Plan Tuning::make_plan(const zerod::Vessel& vessel, double systolic, double diastolic) {
  Plan plan = parallel::on_root(comm_, [&] {
    zerod::Totals totals = zerod::find_totals(settings().flow_split(), vessel, *inflow_, period_, systolic, diastolic);
    totals = {rounded(totals.resistance), rounded(totals.compliance)};
    auto stored = zerod::Twin(vessel, zerod::share_out(settings().flow_split(), totals), *inflow_, period_)
                      .periodic_cycle()
                      .end.stored;
    std::transform(stored.begin(), stored.end(), stored.begin(), rounded);
    return Plan{totals, stored};
  });
  parallel::broadcast(comm_, plan.totals);
  parallel::broadcast(comm_, plan.stored);
  return plan;
}

artifacts::TunedOutlets Tuning::tuned_outlets(const Plan& plan) const {
  artifacts::TunedOutlets tuned;
  const auto shared = zerod::share_out(settings().flow_split(), plan.totals);
  for (std::size_t i = 0; i < shared.size(); ++i) {
    tuned.emplace_back(settings().fractions[i].first, shared[i]);
    tuned.back().second.initial_pressure = plan.stored[i];
  }
  return tuned;
}

ReadCase Tuning::run_input(const std::string& name, const Plan& plan, int steps) const {
  ReadCase run = case_;
  case_file::Case& c = run.settings;
  artifacts::set_outlets(c, tuned_outlets(plan));
  for (auto& [face, condition] : c.boundary)
    if (auto* flow = std::get_if<bc::Flow>(&condition)) flow->course.ramp_time = 0;
  c.title = fmt::format("Tuning of the outlets: {}", name);
  c.time->step = period_ / steps_per_cycle_;
  c.time->steps = steps;
  c.time->cycles.reset();
  c.time->adaptive.reset();
  c.newton.relative_tolerance = std::max(c.newton.relative_tolerance, newton_tolerance);
  c.newton.mass_tolerance = 1;  // pressures and flows of the openings do not feel it
  c.output.every = steps;
  c.output.checkpoint_every = std::max(steps_per_cycle_ / 10, 1);
  run.inputs.settings["tuning"] =
      fmt::format("{}: {} of {} steps, R_T = {:.5e} Pa s/m^3, C_T = {:.5e} m^3/Pa, P_c =", name, steps,
                  steps_per_cycle_, plan.totals.resistance, plan.totals.compliance);
  for (const double p : plan.stored) run.inputs.settings["tuning"] += fmt::format(" {:.5e}", p);
  return run;
}

bool Tuning::has_measured(const fs::path& results, double duration) {
  try {
    double sum = 0;
    for (const double dt : read_measured(results, case_.settings, inlet_, period_).durations) sum += dt;
    if (sum < (1 - 1e-6) * duration)
      throw InputError(results.string(), fmt::format("its histories end after {:.6g} s of {:.6g} s", sum, duration),
                       "");
    return true;
  } catch (const InputError& error) {
    const auto& problem = error.problems().front();
    log_->warning(fmt::format("{}: {}; the run is computed anew", problem.where, problem.what));
    return false;
  }
}

Tuning::Start Tuning::start_of_run(const fs::path& results, const ReadCase& input) {
  const auto earlier = artifacts::find_results(results);
  if (!earlier) return {};
  if (!earlier->damage.empty()) {
    log_->warning(fmt::format("{}: the manifest {}; the run is computed anew", results.string(), earlier->damage));
    return {.done = false, .restart = false, .overwrite = true};
  }
  if (earlier->case_hash != input.inputs.fingerprint() || earlier->mesh_hash != artifacts::mesh_hash(input.mesh.data)) {
    if (!request_.overwrite)
      throw InputError(results.string(), "holds a run with another mesh, inflow or prestress",
                       "replace it by --overwrite, or name another folder by --output");
    return {.done = false, .restart = false, .overwrite = true};
  }
  if (earlier->status == "completed") {
    const auto& time = *input.settings.time;
    const bool whole = has_measured(results, static_cast<double>(time.steps) * time.step);
    return {.done = whole, .restart = false, .overwrite = !whole};
  }
  const auto found = artifacts::find_continuation(results);
  if (!found.possible)
    for (const auto& line : found.warnings) log_->warning(line + "; the run is computed anew");
  return {.done = false, .restart = found.possible, .overwrite = !found.possible};
}

bool Tuning::compute(const std::string& name, const Plan& plan, int steps) {
  signal_ = parallel::stop_requested(comm_);
  if (signal_ != 0) return false;
  const ReadCase input = run_input(name, plan, steps);
  RunRequest run;
  run.case_file = request_.case_file;
  run.directory = folder() / name;
  run.program = request_.program;
  run.verbose = request_.verbose;
  run.resume = command("");
  Start start = parallel::on_root(comm_, [&] { return start_of_run(folder() / name, input); });
  parallel::broadcast(comm_, start);
  log_->info(fmt::format("{}: R_T = {:.5g} Pa s/mm^3, C_T = {:.5g} mm^3/Pa, {} steps{}", name,
                         1e-9 * plan.totals.resistance, 1e9 * plan.totals.compliance, steps,
                         start.done ? ", computed before" : ""));
  if (start.done) return true;
  run.restart = start.restart;
  run.overwrite = start.overwrite;
  signal_ = request_.run_case(input, run, comm_, screen_).signal;
  return signal_ == 0;
}

void Tuning::look_at_probe() {
  parallel::on_root(comm_, [&] {
    const Measured run = read_measured(folder() / "probe", case_.settings, inlet_, period_);
    report_.probe = identify(run, rigid());
    write_report(report_, case_.settings);
  });
}

void Tuning::look_at_cycle(int number, const Plan& plan) {
  parallel::on_root(comm_, [&] {
    TuningCycle cycle;
    cycle.totals = plan.totals;
    cycle.run = read_measured(folder() / fmt::format("cycle_{}", number), case_.settings, inlet_, period_);
    cycle.vessel = identify(cycle.run, rigid());
    const zerod::Twin twin(cycle.vessel, zerod::share_out(settings().flow_split(), plan.totals), *inflow_, period_);
    cycle.first = twin.first_cycle(start_of(cycle.run, cycle.vessel, plan.stored));
    cycle.periodic = twin.periodic_cycle();
    cycle.fractions = mean_flows(cycle.run);
    double sum = 0;
    for (const double flow : cycle.fractions) sum += flow;
    for (double& share : cycle.fractions) share /= sum;
    tell(number, cycle);
    report_.cycles.push_back(std::move(cycle));
    report_.seconds = MPI_Wtime() - started_;
    write_report(report_, case_.settings);
  });
}

void Tuning::tell(int number, const TuningCycle& cycle) {
  const auto line = [&](const char* what, const zerod::Pressures& p) {
    log_->info(fmt::format("  {:<24} {}/{} mmHg, mean {}", what, mmHg(p.systolic), mmHg(p.diastolic), mmHg(p.mean)));
  };
  log_->info(fmt::format("cycle {} of at most {}:", number, settings().max_cycles));
  line("asked", {settings().systolic, settings().diastolic, settings().mean()});
  line("measured in 3D", cycle.measured());
  line("0D from the same start", cycle.foreseen_first());
  line("0D, periodic", zerod::pressures(cycle.periodic));
  line("foreseen when periodic", cycle.foreseen());
  for (std::size_t i = 0; i < cycle.fractions.size(); ++i)
    log_->info(fmt::format("  {}: {:.4g} of the outflow, asked {:.4g}", settings().fractions[i].first,
                           cycle.fractions[i], settings().fractions[i].second));
}

// For rank 0.
void Tuning::write_result(const fs::path& file, const TuningCycle& cycle, const char* status) {
  report_.status = status;
  report_.seconds = MPI_Wtime() - started_;
  artifacts::write_outlets(file, settings(), tuned_outlets({cycle.totals, cycle.periodic.end.stored}));
  write_report(report_, case_.settings);
}

void Tuning::keep_end_of(const std::string& cycle) {
  const fs::path last = artifacts::checkpoint_file(folder() / cycle / "checkpoints", steps_per_cycle_);
  const std::string damage = artifacts::damage_of(last);
  if (!damage.empty())
    throw InputError(last.string(), fmt::format("the state at the end of the cycle: {}", damage),
                     command("--overwrite"));
  files::write_atomically(folder() / start_file, fs::path(start_file).extension().string(), [&](const fs::path& file) {
    fs::copy_file(last, file, fs::copy_options::overwrite_existing);
  });
}

int Tuning::finish() {
  parallel::on_root(comm_, [&] {
    const TuningCycle& last = report_.cycles.back();
    keep_end_of(fmt::format("cycle_{}", report_.cycles.size()));
    write_result(settings().file(), last, "converged");
    const double mean = last.foreseen().mean, rule = settings().mean();
    if (std::abs(mean / rule - 1) > settings().tolerance)
      log_->warning(
          fmt::format("the mean pressure is {} mmHg, (systolic + 2 diastolic)/3 is {}: with both given, it "
                      "follows from the shape of the inflow; a smaller distal_share lowers it",
                      mmHg(mean), mmHg(rule)));
    log_->info(fmt::format("outlets found in {:.1f} s, within {:.2g} % of what was asked; for `tunica run`: {}",
                           report_.seconds, 100 * last.miss(settings()), settings().file().string()));
  });
  return 0;
}

void Tuning::give_up() {
  std::string message = parallel::on_root(comm_, [&] {
    const auto& cycles = report_.cycles;
    const auto best = std::min_element(cycles.begin(), cycles.end(), [&](const auto& a, const auto& b) {
      return a.miss(settings()) < b.miss(settings());
    });
    write_result(folder() / "best.yaml", *best, "not converged");
    const zerod::Pressures p = best->foreseen();
    return fmt::format(
        "the outlets miss the targets after {} cycle{}: at best {}/{} mmHg (mean {}), asked are {}/{} mmHg; off by "
        "{:.3g} %, tolerance {:.3g} %\n  the best outlets are in {}; `tunica run` takes them from {}\n  try a larger "
        "max_cycles or tolerance, and {}",
        cycles.size(), cycles.size() == 1 ? "" : "s", mmHg(p.systolic), mmHg(p.diastolic), mmHg(p.mean),
        mmHg(settings().systolic), mmHg(settings().diastolic), 100 * best->miss(settings()), 100 * settings().tolerance,
        (folder() / "best.yaml").string(), settings().file().string(), command("--overwrite"));
  });
  parallel::broadcast(comm_, message);
  throw SolverError(message);
}

// For rank 0, and for an end that has an error of its own to tell.
void Tuning::record(const char* status) {
  if (parallel::rank(comm_) != 0) return;
  try {
    report_.status = status;
    report_.seconds = MPI_Wtime() - started_;
    write_report(report_, case_.settings);
  } catch (const std::exception& error) {
    log_->warning(fmt::format("tuning.json does not tell the end of the tuning: {}", error.what()));
  }
}

int Tuning::steps() {
  try {
    const int signal = look_for_outlets();
    if (signal != 0) record("stopped");
    return signal;
  } catch (...) {
    record(report_.status == "not converged" ? "not converged" : "failed");
    throw;
  }
}

int Tuning::look_for_outlets() {
  const double systolic = settings().systolic, diastolic = settings().diastolic;
  const zerod::Vessel none{0.0, std::vector<zerod::VesselPath>(settings().fractions.size())};
  if (!compute("probe", make_plan(none, systolic, diastolic),
               std::max(static_cast<int>(probed_share * steps_per_cycle_), 7)))
    return signal_;
  look_at_probe();
  Plan plan = make_plan(report_.probe.value_or(none), systolic, diastolic);
  for (int k = 1; k <= settings().max_cycles; ++k) {
    if (!compute(fmt::format("cycle_{}", k), plan, steps_per_cycle_)) return signal_;
    look_at_cycle(k, plan);
    struct Next {
      bool done;
      double systolic, diastolic;
    };
    // (7.6): what 3D has more than the twin, the twin is asked for less.
    Next next = parallel::on_root(comm_, [&] {
      const TuningCycle& last = report_.cycles.back();
      const zerod::Pressures m = last.measured(), f = last.foreseen_first();
      return Next{last.miss(settings()) <= settings().tolerance, systolic - (m.systolic - f.systolic),
                  diastolic - (m.diastolic - f.diastolic)};
    });
    parallel::broadcast(comm_, next);
    if (next.done) return finish();
    if (k < settings().max_cycles)
      plan = make_plan(report_.cycles.empty() ? none : report_.cycles.back().vessel, next.systolic, next.diastolic);
  }
  give_up();
}

}  // namespace

TuningBasis tuning_basis(const case_file::Case& c, const std::vector<bc::BoundaryFace>& faces) {
  std::vector<Problem> problems;
  const std::string inlet = find_inlet(c, faces, problems);
  if (!problems.empty()) throw InputError(std::move(problems));
  TuningBasis basis{.inlet = inlet, .inflow = inflow_without_ramp(c, inlet)};
  if (!basis.inflow.period())
    throw InputError("boundary." + inlet, "the flow is not periodic", "give it as a periodic `table`");
  if (basis.inflow.mean() <= 0)
    throw InputError("boundary." + inlet,
                     fmt::format("the mean flow of {:.4g} m^3/s leaves the vessel", -basis.inflow.mean()),
                     "turn it round by `positive: outflow`");
  basis.period = *basis.inflow.period();
  const double step = c.outlets->step.value_or(basis.period / default_steps);
  basis.steps_per_cycle = static_cast<int>(std::ceil(basis.period / step * (1 - 1e-9)));
  if (basis.steps_per_cycle < fewest_steps)
    throw InputError("outlets.step",
                     fmt::format("leaves {} steps for a period of {:.4g} s", basis.steps_per_cycle, basis.period),
                     fmt::format("give at most a {}th of the period, or leave it out", fewest_steps));
  return basis;
}

int tune(MPI_Comm comm, const TuneRequest& request, std::FILE* screen) {
  return Tuning(comm, request, screen).steps();
}

}  // namespace tunica::stages
