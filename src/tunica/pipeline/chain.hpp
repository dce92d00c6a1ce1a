// From one case file over all stages to a page: mesh, fibres, prestress, run, report. A stage whose inputs are those of
// its last time is not done again.
#pragma once

#include <mpi.h>

#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tunica/artifacts/manifest.hpp"
#include "tunica/case/case.hpp"

namespace tunica::pipeline {

struct ChainRequest {
  std::filesystem::path case_file;
  std::optional<std::filesystem::path> directory{};  ///< of the results, instead of the one that the case names
  std::optional<std::string> from{};                 ///< this stage and those after it are done anew
  std::optional<std::string> until{};                ///< the last stage that is done
  bool overwrite = false;                            ///< all stages are done anew
  bool dry_run = false;                              ///< only say what would be done, and why
  artifacts::ProgramVersion program{};
};

/// Does the case have stages besides its run? Throws InputError when the file cannot be read as YAML. Collective.
bool is_chain(const std::filesystem::path& case_file, MPI_Comm comm);

/// Does the stages of the case, each in a folder of its own in the folder of results:
/// - a case file of the stage alone, which can be run by hand; what the stage writes;
/// - stage.json: what went in, how it ended, how long it took.
/// A stage that was interrupted continues where it can. Returns the signal that stopped it, 0: none.
///
/// Throws InputError with all problems of the whole file before anything is done; what the stages throw, with the name
/// of the stage and how to go on. Collective.
int run_chain(const ChainRequest& request, MPI_Comm comm, std::FILE* screen);

/// All that can be said before any stage is done: problems of the file as InputError, warnings and what would be done
/// as lines. Not collective.
std::vector<std::string> check_chain(const ChainRequest& request);

}  // namespace tunica::pipeline
