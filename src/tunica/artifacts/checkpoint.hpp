// Checkpoints: everything that a run needs to go on, in one file that does not depend on the number of ranks.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tunica/artifacts/step_grid.hpp"
#include "tunica/coupling/state.hpp"
#include "tunica/distributed/distributed_mesh.hpp"

namespace tunica::artifacts {

struct Checkpoint {
  coupling::State state;
  StepGrid::Position position;
  std::uint64_t case_hash = 0, mesh_hash = 0;
  bool has_end_pressure = true;  ///< false of one that an early version wrote: State::end_pressure is a guess
};

/// Writes `checkpoint` as an AtomicFile, so that an interruption, also of the machine, leaves either the whole file or
/// none. Nodal fields stand in the order of the mesh files. Throws SolverError on all ranks when that fails.
/// Collective.
void write_checkpoint(const std::filesystem::path& file, const distributed::DistributedMesh& mesh,
                      const Checkpoint& checkpoint);

/// Reads what write_checkpoint wrote, on any number of ranks. `start` is the initial state of the problem, whose
/// outlets take over what the file says; `mesh_hash` (significant on rank 0) that of the mesh in use. Throws InputError
/// on all ranks when the file cannot be read, is damaged (with `remedy`), or belongs to another mesh or other outlets.
/// Nothing is taken from it before all of it is known to be whole. Collective.
Checkpoint read_checkpoint(const std::filesystem::path& file, const distributed::DistributedMesh& mesh,
                           const coupling::State& start, std::uint64_t mesh_hash, const std::string& remedy);

/// An outlet of a checkpoint.
struct OutletStart {
  std::string face;
  double flow, pressure;  ///< m^3/s, Pa
};
/// Takes the nodal fields of `state` from a checkpoint, for a run that starts from it at time zero, and returns its
/// outlets, which need not be those of the case. Throws as read_checkpoint. Collective.
std::vector<OutletStart> read_start(const std::filesystem::path& file, const distributed::DistributedMesh& mesh,
                                    coupling::State& state, std::uint64_t mesh_hash, const std::string& remedy);

/// What is wrong with a checkpoint: cut off, altered, of another format, not to be opened. Empty when it is whole.
/// Reads all of it. Not collective.
std::string damage_of(const std::filesystem::path& file);

/// Name of the checkpoint after `step` completed steps.
std::filesystem::path checkpoint_file(const std::filesystem::path& folder, std::int64_t step);
/// Checkpoints in `folder`, ascending steps; empty when there is no folder. Not collective.
std::vector<std::filesystem::path> list_checkpoints(const std::filesystem::path& folder);
/// The last checkpoint in a folder that is whole.
struct SoundCheckpoint {
  std::optional<std::filesystem::path> file;
  std::vector<std::string> passed_over;  ///< a line for each later one: its name and what is wrong with it
};
/// Not collective.
SoundCheckpoint last_sound_checkpoint(const std::filesystem::path& folder);
/// Number of completed steps in the name of a checkpoint, -1 for another name.
std::int64_t step_of(const std::filesystem::path& file);

}  // namespace tunica::artifacts
