// A run until its first step: the problem, the folder of results, the checkpoint that it goes on from.
#include "tunica/artifacts/checkpoint.hpp"
#include "tunica/assembly/isa.hpp"
#include "tunica/base/error.hpp"
#include "tunica/config/units.hpp"
#include "tunica/files/outputs.hpp"
#include "tunica/parallel/agree.hpp"
#include "tunica/stages/run/adaptive_steps.hpp"
#include "tunica/stages/run/restart.hpp"
#include "tunica/stages/run/run_in_steps.hpp"

namespace tunica::stages {

namespace fs = std::filesystem;

namespace {

constexpr int static_halvings = 6;

}  // namespace

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

}  // namespace tunica::stages
