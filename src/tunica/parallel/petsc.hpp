// Ownership of PETSc objects and of the PETSc session.
#pragma once

#include <petscksp.h>

#include <string>
#include <utility>
#include <vector>

namespace tunica::parallel {

/// Turns a PETSc error code into a SolverError that says what PETSc reported and where it was called.
void check(PetscErrorCode code, const char* file = __builtin_FILE(), int line = __builtin_LINE());

/// Owns one PETSc object: `VecHandle x; check(VecCreate(comm, x.out()));`, then pass `x` where PETSc wants a Vec.
/// Move-only. Destroying is collective: handles go out of scope on all ranks in the same order, before the Session.
template <class T, PetscErrorCode (*destroy)(T*)>
class Handle {
 public:
  Handle() = default;
  /// Takes over `object`.
  explicit Handle(T object) : object_(object) {}
  Handle(Handle&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
  Handle& operator=(Handle&& other) noexcept {
    if (this != &other) {
      reset();
      object_ = std::exchange(other.object_, nullptr);
    }
    return *this;
  }
  ~Handle() { reset(); }

  T get() const { return object_; }
  operator T() const { return object_; }  // NOLINT: implicit, so that handles pass where PETSc wants its own types

  /// Where a create function stores its object; one that is held already is destroyed first.
  T* out() {
    reset();
    return &object_;
  }
  void reset() {
    // An error code has nowhere to go from a destructor; PETSc has printed or stored its cause.
    if (object_ != nullptr) static_cast<void>(destroy(&object_));
    object_ = nullptr;
  }

 private:
  T object_ = nullptr;
};

using VecHandle = Handle<Vec, VecDestroy>;
using MatHandle = Handle<Mat, MatDestroy>;
using KspHandle = Handle<KSP, KSPDestroy>;
using PcHandle = Handle<PC, PCDestroy>;
using IsHandle = Handle<IS, ISDestroy>;
using ScatterHandle = Handle<VecScatter, VecScatterDestroy>;

/// MPI and PETSc from construction to destruction. PETSc reads neither ~/.petscrc nor PETSC_OPTIONS nor the program's
/// arguments, installs no signal handler and prints no error traces (they arrive through `check`).
class Session {
 public:
  /// `options`: given to PETSc as they are, such as {"-log_view"}.
  explicit Session(const std::vector<std::string>& options = {});
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

 private:
  std::vector<std::string> arguments_;  // PETSc keeps pointers into these
  std::vector<char*> pointers_;
};

}  // namespace tunica::parallel
