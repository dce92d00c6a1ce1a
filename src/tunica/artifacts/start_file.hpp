// A state to start from that was made elsewhere, in the form of a checkpoint.
#pragma once

#include <cstdint>
#include <filesystem>

#include "tunica/coupling/state.hpp"

namespace tunica::artifacts {

/// Writes a checkpoint at time zero, that a case names as its `start`, which read_start() reads: the nodal fields of
/// `state` are those of the whole mesh, in its order. Throws SolverError when that fails. Not collective.
void write_start(const std::filesystem::path& file, const coupling::State& state, std::uint64_t mesh_hash);

}  // namespace tunica::artifacts
