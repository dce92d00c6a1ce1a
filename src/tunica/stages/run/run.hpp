// Runs a case: mesh, time steps, results, checkpoints.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tunica/artifacts/load_mesh.hpp"
#include "tunica/artifacts/manifest.hpp"
#include "tunica/case/case.hpp"

namespace tunica::stages {

struct RunRequest {
  std::filesystem::path case_file;
  std::optional<std::filesystem::path> directory;     ///< of the results, instead of the one that the case names
  bool restart = false;                               ///< go on from the last checkpoint in the folder of results
  std::optional<std::filesystem::path> restart_file;  ///< go on from this checkpoint
  bool overwrite = false;                             ///< results in the folder may be removed
  std::optional<std::int64_t> until;                  ///< stop when so many steps are completed
  std::string resume;  ///< command that goes on with a run that a signal has stopped; empty: `tunica run ... --restart`
  artifacts::ProgramVersion program;
};

struct RunOutcome {
  int signal = 0;  ///< that stopped the run; 0: it came to its end
  std::int64_t steps = 0;
};

/// Computes the case and writes into the folder of results:
/// - a time series of fields for each region (fields.hpp), histories (histories.hpp), manifest.json, run.log;
/// - checkpoints/: after every so many steps, at the end, when a signal stops the run and when it fails; the last two
///   are kept.
/// A step that does not converge is halved, and never accepted as it is. Messages go to `screen` of rank 0.
///
/// Throws InputError with all problems of case and meshes, before anything is written; SolverError when a step fails
/// after all halvings, with everything until then on disk. The same on all ranks. Collective.
RunOutcome run(MPI_Comm comm, const RunRequest& request, std::FILE* screen);

/// A case that was read already, with the text that it was read from and (on rank 0) its mesh.
struct ReadCase {
  case_file::Case settings;
  std::string text;
  std::string outlets;  ///< text of the file of tuned outlets that `settings` has taken over; empty without
  artifacts::CheckedMesh mesh;
  std::vector<std::string> warnings;  ///< on rank 0: of values in the case that look like slips
};

/// What tells results of this case from those of another: of its text, its outlets and its prestress. For rank 0.
std::uint64_t case_hash(const ReadCase& c);

/// The same for a case at hand; `request.case_file` serves messages only. Collective.
RunOutcome run_case(const ReadCase& c, const RunRequest& request, MPI_Comm comm, std::FILE* screen);

}  // namespace tunica::stages
