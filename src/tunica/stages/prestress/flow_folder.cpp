#include "tunica/stages/prestress/flow_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "tunica/artifacts/checkpoint.hpp"
#include "tunica/base/error.hpp"
#include "tunica/parallel/agree.hpp"
#include "tunica/parallel/progress.hpp"
#include "tunica/parallel/signals.hpp"

namespace tunica::stages {

namespace fs = std::filesystem;

namespace {

constexpr int steps_between_checkpoints = 20;
constexpr std::size_t kept_flow_checkpoints = 2;

fs::path end_of(const fs::path& folder) { return folder / "flow.checkpoint"; }
fs::path way_in(const fs::path& folder) { return folder / "flow_checkpoints"; }

/// Empty when the end of an earlier flow is whole.
std::string damage_of_end(MPI_Comm comm, const fs::path& folder) {
  std::string damage = parallel::on_root(comm, [&] {
    return fs::exists(end_of(folder)) ? artifacts::damage_of(end_of(folder)) : std::string("is not there");
  });
  parallel::broadcast(comm, damage);
  return damage;
}

/// Takes the last whole state on the way to the end, if there is one.
void take_state_on_the_way(const distributed::DistributedMesh& mesh, coupling::State& state, const FlowFolder& folder,
                           const std::string& damage, parallel::Log& log) {
  artifacts::SoundCheckpoint sound;
  std::string file = parallel::on_root(mesh.comm, [&] {
    sound = artifacts::last_sound_checkpoint(way_in(folder.folder));
    return sound.file ? sound.file->string() : std::string();
  });
  parallel::broadcast(mesh.comm, file);
  for (const auto& line : sound.passed_over) log.warning(line + "; it is passed over");
  log.warning(fmt::format("{}: {}; the steady flow {}", end_of(folder.folder).string(), damage,
                          file.empty() ? "is computed anew" : "goes on from " + file));
  if (!file.empty()) state = artifacts::read_checkpoint(file, mesh, state, folder.mesh_hash, folder.remedy).state;
}

void save(const distributed::DistributedMesh& mesh, const coupling::State& state, const FlowFolder& folder) {
  const fs::path way = way_in(folder.folder);
  artifacts::write_checkpoint(artifacts::checkpoint_file(way, state.step), mesh, {state, {}, 0, folder.mesh_hash});
  parallel::on_root(mesh.comm, [&] {
    const auto files = artifacts::list_checkpoints(way);
    for (std::size_t k = 0; k + kept_flow_checkpoints < files.size(); ++k) fs::remove(files[k]);
  });
}

SteadySteps take_steps(coupling::Problem& problem, coupling::State& state, const case_file::SteadyFlow& flow,
                       const FlowFolder& folder, parallel::Log& log) {
  const auto& mesh = problem.mesh();
  parallel::Progress bar(log, "steady flow", static_cast<double>(std::min<std::int64_t>(state.step, flow.steps - 1)),
                         static_cast<double>(flow.steps));
  try {
    return step_to_steady_state(problem, state, flow, [&](const SteadyRecord& r) {
      bar.update(r.step,
                 fmt::format("velocity changes by {:.1e}, pressure by {:.1e}", r.velocity_change, r.pressure_change));
      if (r.step % steps_between_checkpoints == 0 && !r.last) save(mesh, state, folder);
      return parallel::stop_requested(mesh.comm) == 0;
    });
  } catch (const SolverError&) {  // on all ranks alike
    if (state.step > 0) save(mesh, state, folder);
    throw;
  }
}

}  // namespace

bool has_flow(const fs::path& folder) {
  return fs::exists(end_of(folder)) || !artifacts::list_checkpoints(way_in(folder)).empty();
}

void remove_flow(const fs::path& folder) {
  fs::remove(end_of(folder));
  for (const auto& file : artifacts::list_checkpoints(way_in(folder))) fs::remove(file);
}

SteadyRecord find_steady_flow(coupling::Problem& problem, coupling::State& state, const case_file::SteadyFlow& flow,
                              const FlowFolder& folder, bool keep, parallel::Log& log) {
  const auto& mesh = problem.mesh();
  if (keep) {
    const std::string damage = damage_of_end(mesh.comm, folder.folder);
    if (damage.empty()) {
      const fs::path end = end_of(folder.folder);
      state = artifacts::read_checkpoint(end, mesh, state, folder.mesh_hash, folder.remedy).state;
      return repeat_last_step(problem, state);
    }
    take_state_on_the_way(mesh, state, folder, damage, log);
  }
  const SteadySteps steps = take_steps(problem, state, flow, folder, log);
  if (steps.stopped) {
    save(mesh, state, folder);
    throw Stopped{parallel::stop_requested(mesh.comm)};
  }
  artifacts::write_checkpoint(end_of(folder.folder), mesh, {steps.before_last, {}, 0, folder.mesh_hash});
  return steps.last;
}

}  // namespace tunica::stages
