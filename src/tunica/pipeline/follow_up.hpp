// `tunica follow-up`: what became of an aorta between scans, and what blood and wall were like where it grew.
#pragma once

#include <mpi.h>

#include <cstdio>
#include <filesystem>
#include <optional>

#include "tunica/artifacts/manifest.hpp"

namespace tunica::pipeline {

struct FollowUpRequest {
  std::filesystem::path file;
  std::optional<std::filesystem::path> output{};  ///< of the results, instead of the folder that the file names
  bool run = false;                               ///< compute the beat of every scan, too
  bool dry_run = false;                           ///< only say what would be done; case files are written
  artifacts::ProgramVersion program{};
};

/// Meshes all scans, each as a chain in a folder of its own, holds their branches against each other, computes them
/// where that is asked for, and writes follow_up.html, follow_up.json, tables (.csv) and maps (.vtp). What is there is
/// reused as in run_chain(). Returns the signal that stopped it, 0: none. Throws InputError, before any work, with what
/// is wrong in the file and the cases of all scans, and before anything is computed with what says that the scans are
/// not of one aorta; SolverError where a stage fails or results cannot be written. Collective.
int follow_up(const FollowUpRequest& request, MPI_Comm comm, std::FILE* screen);

}  // namespace tunica::pipeline
