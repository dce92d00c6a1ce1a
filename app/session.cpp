#include "session.hpp"

#include <mpi.h>

#include <cstdio>
#include <exception>
#include <new>

#include "exit_codes.hpp"
#include "tunica/base/error.hpp"
#include "tunica/parallel/agree.hpp"
#include "tunica/parallel/launcher.hpp"
#include "tunica/parallel/petsc.hpp"
#include "tunica/parallel/shared_error.hpp"

namespace tunica::app {
namespace {

int report(int code, const std::exception& error) {
  if (parallel::rank(MPI_COMM_WORLD) == 0) {
    std::fflush(stdout);
    std::fprintf(stderr, "tunica: %s\n", error.what());
  }
  return code;
}

/// For an error that the other ranks may not know of, and would wait for this one for ever.
int end_all(const char* error) {
  std::fprintf(stderr, "tunica: rank %d: %s\n", parallel::rank(MPI_COMM_WORLD), error);
  if (parallel::size(MPI_COMM_WORLD) > 1) MPI_Abort(MPI_COMM_WORLD, solver_failure);
  return solver_failure;
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
  } catch (const parallel::SharedError& error) {
    return report(solver_failure, error);
  } catch (const std::bad_alloc&) {
    return end_all("there is not enough memory");
  } catch (const std::exception& error) {
    return end_all(error.what());
  } catch (...) {
    return end_all("unknown error");
  }
}

}  // namespace tunica::app
