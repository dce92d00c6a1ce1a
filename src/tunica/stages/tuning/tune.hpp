// `tunica tune`: Windkessel outlets for given pressures and shares of the flow (docs/theory.md, section 7).
#pragma once

#include <mpi.h>

#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tunica/artifacts/manifest.hpp"
#include "tunica/bc/check.hpp"
#include "tunica/bc/waveform.hpp"
#include "tunica/case/case.hpp"
#include "tunica/stages/run_case.hpp"

namespace tunica::stages {

struct TuneRequest {
  std::filesystem::path case_file;
  std::optional<std::string> case_text;            ///< where it does not stand in that file
  std::optional<std::filesystem::path> directory;  ///< of the results, instead of the one that the case names
  bool overwrite = false;                          ///< results of another case in the folder may be replaced
  artifacts::ProgramVersion program;
  RunCase run_case;      ///< computes the probe and the cycles
  bool verbose = false;  ///< as RunRequest::verbose, for these
};

/// What a tuning goes out from.
struct TuningBasis {
  std::string inlet;    ///< the one face of the lumen with a flow
  bc::Waveform inflow;  ///< without its ramp
  double period = 0;    ///< s
  int steps_per_cycle = 0;
};
/// Looks at a case with `outlets` on these faces before anything is computed; `c.boundary` has no patterns any more.
/// Throws InputError where there is no one inlet with a periodic inflow, or a cycle has too few steps.
TuningBasis tuning_basis(const case_file::Case& c, const std::vector<bc::BoundaryFace>& faces);

/// Finds the outlets and writes into the folder of results:
/// - probe/, cycle_1/, ...: the runs in 3D, as `tunica run` leaves them;
/// - tuning.json: what was done and found; tuning.csv, tuning.svg: cycle by cycle; pressure.svg: the last cycle in 3D
///   and in the 0D model; tune.log;
/// - outlets.yaml: the outlets for `tunica run` (outlets_file.hpp), best.yaml in its place when the targets are missed.
/// Runs that are there are not computed again, and one that was interrupted goes on. Returns the signal that stopped
/// it, or 0.
///
/// Throws InputError with all problems of case and meshes before anything is written; SolverError when a step fails, no
/// outlets do what is asked, or the cycles are used up, with everything until then on disk. The same on all ranks.
/// Collective.
int tune(MPI_Comm comm, const TuneRequest& request, std::FILE* screen);

}  // namespace tunica::stages
