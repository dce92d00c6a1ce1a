// `tunica study`: one case with other values of some of its keys, and what its figures make of them.
#pragma once

#include <mpi.h>

#include <cstdio>
#include <filesystem>
#include <optional>

#include "tunica/artifacts/manifest.hpp"

namespace tunica::pipeline {

struct StudyRequest {
  std::filesystem::path file;
  std::optional<std::filesystem::path> output{};  ///< of the results, instead of the folder that the file names
  std::optional<int> point{};                     ///< from 1: this one alone, without the table
  bool shared = false;                            ///< only the stages that points have in common
  bool table = false;                             ///< only the table of what is there
  bool dry_run = false;                           ///< only say what would be done; case files are written
  artifacts::ProgramVersion program{};
};

struct StudyOutcome {
  int signal = 0;  ///< that stopped it, 0: none
  int failed = 0;  ///< points whose computation failed
};

/// Does the points one after the other, each as a chain in point_0001, ... of the folder of results; stages up to
/// `outlets` whose settings are the same are done once, in shared/. At last study.csv, study.json and study.html. A
/// point that fails is recorded with its error, and the others are done. What is there is reused and what was
/// interrupted goes on, as in run_chain(). Throws InputError, before any work, with what is wrong in the file and in
/// the cases of all points that are done; SolverError where results cannot be written. Collective.
StudyOutcome study(const StudyRequest& request, MPI_Comm comm, std::FILE* screen);

}  // namespace tunica::pipeline
