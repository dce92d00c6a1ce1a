// MPI and PETSc within a Python process, which may have them running already.
#pragma once

#include <mpi.h>
#include <pybind11/pybind11.h>

#include <functional>
#include <string>

#include "tunica/artifacts/manifest.hpp"

namespace tunica::python {

/// A duplicate of a communicator, so that no message of the program and of a run can meet; freed with the object.
/// Making one starts MPI and PETSc where they do not run; they end with the interpreter. Collective.
class OwnComm {
 public:
  /// `comm`: one of mpi4py, or None for all processes. Throws InputError for anything else.
  explicit OwnComm(const pybind11::object& comm);
  ~OwnComm();
  OwnComm(const OwnComm&) = delete;
  OwnComm& operator=(const OwnComm&) = delete;
  operator MPI_Comm() const { return comm_; }  // NOLINT: passes where MPI wants its own type

 private:
  MPI_Comm comm_ = MPI_COMM_NULL;
};

/// Objects that hold something of MPI or PETSc let go of it before these end. `release` is called once at most.
class Releasable {
 public:
  Releasable();
  virtual ~Releasable();
  Releasable(const Releasable&) = delete;
  Releasable& operator=(const Releasable&) = delete;
  virtual void release() = 0;
};

/// Version and commit of this package.
artifacts::ProgramVersion program();

/// Calls `say` (a Python function of a line, or None) from code that runs without the interpreter's lock; Ctrl-C ends
/// that code there.
std::function<void(const std::string&)> speaker(const pybind11::object& say);

}  // namespace tunica::python
