// Benchmarks with references: `tunica validate`.
#pragma once

#include <mpi.h>

#include <cstdio>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tunica/case/case.hpp"
#include "tunica/stages/run_case.hpp"

namespace tunica::stages {

/// Makes the mesh that a file asks for, over one that is there, as `tunica mesh` does. Not collective.
using MakeMesh = std::function<void(const std::filesystem::path& mesh_file)>;

struct ValidateRequest {
  std::vector<std::string> names;  ///< of benchmarks; empty: all that do not take long
  bool full = false;               ///< meshes that resolve them
  case_file::Elements elements = case_file::Elements::quadratic;
  std::filesystem::path folder = "validation";
  RunCase run_case;
  artifacts::ProgramVersion program;
  MakeMesh make_mesh;
};

struct ValidateOutcome {
  int signal = 0;       ///< that stopped a run
  bool passed = false;  ///< all figures of all benchmarks are within their tolerances
};

/// Computes benchmarks, each in a folder of its own (<folder>/<name>: case.yaml, meshes, results), and writes
/// validation.html, validation.csv and validation.json. A benchmark whose case and mesh are unchanged is not computed
/// again, one that was interrupted goes on. Throws InputError for a name that is not known. Collective.
ValidateOutcome validate_program(MPI_Comm comm, const ValidateRequest& request, std::FILE* screen);

/// Names and titles of all benchmarks, one a line.
std::string list_benchmarks();

}  // namespace tunica::stages
