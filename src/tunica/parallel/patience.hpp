// Work of minutes on one rank, while the others leave their cores alone.
#pragma once

#include <mpi.h>

#include <exception>
#include <utility>

#include "tunica/parallel/agree.hpp"

namespace tunica::parallel {

/// A barrier in which ranks that wait sleep between two looks, some hundredths of a second. Collective.
void patient_barrier(MPI_Comm comm);

/// As on_root() without a result, for long work: MPI's own waiting keeps a core busy. Collective.
template <class Action>
void on_root_patiently(MPI_Comm comm, Action&& action) {
  std::exception_ptr error;
  if (rank(comm) == 0) {
    try {
      std::forward<Action>(action)();
    } catch (...) {
      error = std::current_exception();
    }
  }
  patient_barrier(comm);
  throw_if_any(comm, error);
}

}  // namespace tunica::parallel
