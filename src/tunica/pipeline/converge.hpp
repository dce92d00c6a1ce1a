// `tunica converge`: how far the figures of a case are from those of a finer mesh and a smaller step.
#pragma once

#include <mpi.h>

#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "tunica/pipeline/chain.hpp"

namespace tunica::pipeline {

struct ConvergeRequest {
  ChainRequest chain;           ///< of the case itself; `from`, `until`, `only` and `dry_run` are not looked at
  std::optional<int> meshes{};  ///< finer meshes; none: 2 where the case says how its mesh is made, else 0
  double ratio = 1.4;           ///< of the edges of one mesh to those of the next finer one
  int steps = 1;                ///< halvings of the step
  std::vector<std::string> quantities{};  ///< patterns of figures; empty: default_quantities()
};

/// Does the case, then the same on finer meshes and, on its own mesh, with smaller steps, each as a chain of its own in
/// converge/<level>; outlets are those of the case, steps start from its prestress. At last converge/converge.json,
/// converge.csv and converge.html: every figure by level, its observed order and error band; the report of the case is
/// written again, with bands. Stages are reused as in run_chain(): what was interrupted goes on. Returns the signal
/// that stopped it, 0: none. Throws InputError when the case has no section `post`, no mesh that can be refined, or no
/// fixed step to halve; else as run_chain(). Collective.
int converge(const ConvergeRequest& request, MPI_Comm comm, std::FILE* screen);

}  // namespace tunica::pipeline
