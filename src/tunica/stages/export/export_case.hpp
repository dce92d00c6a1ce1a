// tunica export: a case as svMultiPhysics reads it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tunica::stages {

struct ExportRequest {
  std::filesystem::path case_file;
  std::filesystem::path folder;  ///< to be written: solver.xml, mesh/lumen, mesh/wall, tables
  std::string units;             ///< cgs, mmgs or si: of all numbers there
  bool overwrite = false;        ///< replace what an earlier export has left in `folder`
};

struct ExportOutcome {
  std::vector<std::string> files;    ///< that were written, relative to `folder`
  std::vector<std::string> changed;  ///< what svMultiPhysics computes otherwise, key by key
  std::vector<std::string> warnings;
};

/// Writes meshes with GlobalNodeID, GlobalElementID and a file for each face, solver.xml, and what that names: time
/// courses (.flow), fibre directions (FIB_DIR), domains (DOMAIN_ID), prestress at the nodes (Stress). Throws InputError
/// with all that svMultiPhysics cannot pose, each with the key of the case, before anything is written, and where
/// `folder` holds a solver.xml and `overwrite` is not set. Not collective, needs MPI.
ExportOutcome export_case(const ExportRequest& request);

}  // namespace tunica::stages
