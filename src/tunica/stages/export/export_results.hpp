// Results of a run in the files and the names of svMultiPhysics.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tunica::stages {

struct ResultsRequest {
  std::filesystem::path case_file;
  std::filesystem::path folder;  ///< to be written
  std::string units;             ///< cgs, mmgs or si: of all numbers there
};

/// Writes what the run of a case has left: `result_<step>.vtu` for every instant of its fields, with the points and
/// elements of its mesh files in their order, lumen before wall, and the point arrays Velocity, Pressure (of the
/// blood), Displacement and WSS (of the blood's wall, in length); and of histories `B_<NS or FS>_Velocity_flux.txt` and
/// `B_..._Pressure_average.txt`, a line for each step, of the faces of the lumen; and of the instants of the fields
/// `V_<NS or FS>_Pressure_flux.txt`, the mean pressure of the blood, and `V_<ST or FS>_Jacobian_flux.txt`, the volume
/// of each wall region over that at the start. Returns their names. Throws
/// InputError where there are no results, SolverError when a file cannot be written. Not collective.
std::vector<std::string> export_results(const ResultsRequest& request);

}  // namespace tunica::stages
