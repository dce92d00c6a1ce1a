// What a run is asked and what it answers: for stages that have cases computed in 3D on their way to something else.
// They are handed the run as a function, since no stage knows another.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "tunica/artifacts/manifest.hpp"
#include "tunica/stages/posed_case.hpp"

namespace tunica::stages {

struct RunRequest {
  std::filesystem::path case_file;
  std::optional<std::string> case_text;               ///< where it does not stand in that file
  std::optional<std::filesystem::path> directory;     ///< of the results, instead of the one that the case names
  bool restart = false;                               ///< go on from the last checkpoint in the folder of results
  std::optional<std::filesystem::path> restart_file;  ///< go on from this checkpoint
  bool overwrite = false;                             ///< results in the folder may be removed
  bool verbose = false;                               ///< a line for each step on the screen; run.log has them anyway
  std::optional<std::int64_t> until;                  ///< stop when so many steps are completed
  std::string resume;  ///< command that goes on with a run that a signal has stopped; empty: `tunica run ... --restart`
  artifacts::ProgramVersion program;
};

struct RunOutcome {
  int signal = 0;  ///< that stopped the run; 0: it came to its end
  std::int64_t steps = 0;
};

/// Computes a case as `tunica run` does, results and checkpoints included (run/run.hpp). Collective.
using RunCase = std::function<RunOutcome(const ReadCase&, const RunRequest&, MPI_Comm, std::FILE*)>;

}  // namespace tunica::stages
