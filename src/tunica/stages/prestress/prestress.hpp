// `tunica prestress`: the prestress of an imaged vessel under its diastolic load (docs/theory.md, section 5).
#pragma once

#include <mpi.h>

#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tunica/artifacts/manifest.hpp"
#include "tunica/bc/check.hpp"
#include "tunica/case/case.hpp"

namespace tunica::stages {

struct PrestressRequest {
  std::filesystem::path case_file;
  std::optional<std::string> case_text;            ///< where it does not stand in that file
  std::optional<std::filesystem::path> directory;  ///< of the results, instead of the one that the case names
  bool overwrite = false;                          ///< results in the folder may be replaced
  /// The steady flow in the folder is taken as it is. One that was interrupted goes on, and so does one whose last
  /// state is damaged, from the state before or from the start, with a warning.
  bool keep_flow = false;
  artifacts::ProgramVersion program;
  bool verbose = false;  ///< the screen gets what prestress.log gets
};

/// Looks at a case on these faces and regions of the wall before anything is computed; `c.boundary` has no patterns any
/// more. Throws InputError where the steady flow cannot have the conditions of the lumen, or statics not those of the
/// wall, and for regions that are not there.
void check_prestress(const case_file::Case& c, const std::vector<bc::BoundaryFace>& faces,
                     const std::vector<std::string>& wall_regions);

/// Finds the prestress of the wall and writes into the folder of results:
/// - flow.checkpoint, flow/: the steady flow between rigid walls, one step before its end and at its end;
///   flow_checkpoints/: on the way there, the last two; boundary.yaml, its conditions;
/// - traction/: its traction on the wall;
/// - fixed_point.csv, fixed_point.svg: how the fixed point converged, line by line;
/// - wall.vtu: the prestress, for the key `wall.prestress` (prestress_file.hpp); wall/: stress in the imaged shape;
/// - unloaded/: with method `inverse` the wall in its unloaded shape, as write_simvascular() writes it;
/// - start.checkpoint: the state of flow and wall, for the key `start`;
/// - prestress.json: what was done and found, prestress.log.
/// The wall has the loads that the case gives it, and where the case has flow, its traction.
///
/// Throws InputError with all problems of case and meshes before anything is written; SolverError when flow or fixed
/// point do not converge, with everything until then on disk. The same on all ranks. Returns the signal that stopped
/// it, or 0. Collective.
int prestress(MPI_Comm comm, const PrestressRequest& request, std::FILE* screen);

}  // namespace tunica::stages
