// `tunica what-if`: a case with a tear closed, a new one, a stent graft, another pressure or beat, side by side.
#pragma once

#include <mpi.h>

#include <cstdio>
#include <filesystem>
#include <optional>

#include "tunica/artifacts/manifest.hpp"

namespace tunica::pipeline {

struct WhatIfRequest {
  std::filesystem::path file;
  std::optional<std::filesystem::path> output{};  ///< of the results, instead of the folder that the file names
  artifacts::ProgramVersion program{};
};

/// Does the case, as `tunica run` would, and then each variant, as a chain of its own on what they have in common; at
/// last what_if.csv and what_if.html. What is there is reused as in run_chain(). Returns the signal that stopped it, 0:
/// none. Throws InputError, before any work, with what is wrong in the file and the cases; for tears and places that
/// the mesh does not have, once it is there; SolverError where a stage fails or results cannot be written. Collective.
int what_if(const WhatIfRequest& request, MPI_Comm comm, std::FILE* screen);

}  // namespace tunica::pipeline
