// The steady flow on its way through a folder: checkpoints, and going on with what an earlier call has left.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "tunica/parallel/log.hpp"
#include "tunica/stages/prestress/steady_flow.hpp"

namespace tunica::stages {

/// A signal has asked for the end; thrown on all ranks alike.
struct Stopped {
  int signal;
};

struct FlowFolder {
  std::filesystem::path folder;
  std::uint64_t mesh_hash;  ///< of the lumen; significant on rank 0
  std::string remedy;       ///< for a state of another mesh
};

/// Is there a steady flow, or a part of the way to it? Not collective.
bool has_flow(const std::filesystem::path& folder);
/// Not collective.
void remove_flow(const std::filesystem::path& folder);

/// Brings `state` to the steady flow, and leaves flow.checkpoint, one step before its end, and flow_checkpoints/, the
/// last two of those on the way. `keep`: goes on with what is there: with the end, and where that is missing or damaged
/// with the last state on the way that is whole, or else from the start; a warning says so. Throws Stopped after a
/// signal and SolverError, both with the last state on disk; InputError when the state belongs to another mesh.
/// Collective.
SteadyRecord find_steady_flow(coupling::Problem& problem, coupling::State& state, const case_file::SteadyFlow& flow,
                              const FlowFolder& folder, bool keep, parallel::Log& log);

}  // namespace tunica::stages
