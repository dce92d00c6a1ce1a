// `tunica identify`: values of some keys of a case, found from what was measured.
#pragma once

#include <mpi.h>

#include <cstdio>
#include <filesystem>
#include <optional>

#include "tunica/artifacts/manifest.hpp"

namespace tunica::pipeline {

struct IdentifyRequest {
  std::filesystem::path file;
  std::optional<std::filesystem::path> output{};  ///< of the results, instead of the folder that the file names
  bool dry_run = false;                           ///< only say what would be done; the case of the first run is written
  artifacts::ProgramVersion program{};
};

struct IdentifyOutcome {
  int signal = 0;         ///< that stopped it, 0: none
  bool converged = true;  ///< that of a dry run is
};

/// Does one run after the other, each as a chain in run_0001, ... of the folder of results, where the search for the
/// least squares asks for it; stages up to `outlets` that no parameter changes are done once, in shared/. At last
/// identify.csv, identify.json, identify.html and identified.yaml. The same inputs ask for the same runs, so that what
/// is there is reused and what was interrupted goes on, as in run_chain(). A run that fails shortens the step. Throws
/// InputError, before any work, with what is wrong in the file and the case; SolverError where the first run fails or
/// results cannot be written. Collective.
IdentifyOutcome identify(const IdentifyRequest& request, MPI_Comm comm, std::FILE* screen);

}  // namespace tunica::pipeline
