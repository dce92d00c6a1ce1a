// `tunica compare`: the same mesh, directions and outlets with several wall laws.
#pragma once

#include <mpi.h>

#include <cstdio>

#include "tunica/pipeline/chain.hpp"

namespace tunica::pipeline {

/// Does the stages of the case up to its outlets, and then for each law of the section `compare` prestress, run,
/// figures and page, as a chain of its own in compare/<name>; at last compare/compare.csv, compare.html: stresses by
/// region and displacements side by side. Stages are reused as in run_chain(); `from`, `until` and `dry_run` of the
/// request are not looked at. Returns the signal that stopped it, 0: none. Throws as run_chain(). Collective.
int compare_laws(const ChainRequest& request, MPI_Comm comm, std::FILE* screen);

/// The same when the stages that the laws have in common are done already. Collective.
int compare_on_common(const ChainRequest& request, MPI_Comm comm, std::FILE* screen);

}  // namespace tunica::pipeline
