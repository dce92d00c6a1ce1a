// Runs a case: mesh, time steps, results, checkpoints.
#pragma once

#include <mpi.h>

#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "tunica/stages/run_case.hpp"

namespace tunica::stages {

/// Computes the case and writes into the folder of results:
/// - a time series of fields for each region (fields.hpp), histories (histories.hpp), manifest.json, run.log;
/// - checkpoints/: after every so many steps, at the end, when a signal stops the run and when it fails; the last two
///   are kept.
/// A step that does not converge is halved, and never accepted as it is. Messages go to `screen` of rank 0. Signals stop
/// it where the caller has parallel::StopSignals; so it is with all stages, which install no handlers.
///
/// Throws InputError with all problems of case and meshes, before anything is written; SolverError when a step fails
/// after all halvings, with everything until then on disk. The same on all ranks. Collective.
RunOutcome run(MPI_Comm comm, const RunRequest& request, std::FILE* screen);

/// What check_posed() says of the case of `request`: the first lines of its log, then warnings. Throws what the run
/// throws before its first step. Collective.
struct RunCheck {
  std::vector<std::string> report, warnings;  ///< on rank 0
};
RunCheck check_run(MPI_Comm comm, const std::filesystem::path& case_file);

/// A RunCase: as run(), for a case at hand; `request.case_file` serves messages only. Collective.
RunOutcome run_case(const ReadCase& c, const RunRequest& request, MPI_Comm comm, std::FILE* screen);

}  // namespace tunica::stages
