#include "session.hpp"

#include <mpi.h>

#include <cstdio>
#include <exception>

#include "tunica/base/error.hpp"
#include "tunica/parallel/agree.hpp"
#include "tunica/parallel/launcher.hpp"
#include "tunica/parallel/petsc.hpp"

namespace tunica::app {
namespace {

constexpr int input_error = 2, solver_failure = 3;

int report(int code, const std::exception& error) {
  if (parallel::rank(MPI_COMM_WORLD) == 0) {
    std::fflush(stdout);
    std::fprintf(stderr, "tunica: %s\n", error.what());
  }
  return code;
}

}  // namespace

int in_session(const std::function<int()>& action) {
  const parallel::Session session;
  try {
    parallel::refuse_another_launcher(parallel::size(MPI_COMM_WORLD));
    return action();
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
