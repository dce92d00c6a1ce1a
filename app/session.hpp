// A subcommand that computes in parallel: MPI and PETSc around it, errors as exit codes.
#pragma once

#include <mpi.h>

#include <cstdio>
#include <exception>

#include "tunica/base/error.hpp"
#include "tunica/parallel/agree.hpp"
#include "tunica/parallel/petsc.hpp"

namespace tunica::app {

inline int report(int code, const std::exception& error) {
  if (parallel::rank(MPI_COMM_WORLD) == 0) {
    std::fflush(stdout);
    std::fprintf(stderr, "tunica: %s\n", error.what());
  }
  return code;
}

/// Calls `compute`, which returns an exit code, and returns that. Input and solver errors come to all ranks alike; any
/// other exception may be that of one rank for which the others would wait for ever.
template <class Compute>
int in_session(const Compute& compute) {
  constexpr int input_error = 2, solver_failure = 3;
  const parallel::Session session;
  try {
    return compute();
  } catch (const InputError& error) {
    return report(input_error, error);
  } catch (const SolverError& error) {
    return report(solver_failure, error);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "tunica: rank %d: %s\n", parallel::rank(MPI_COMM_WORLD), error.what());
    MPI_Abort(MPI_COMM_WORLD, solver_failure);
    throw;  // not reached
  }
}

}  // namespace tunica::app
