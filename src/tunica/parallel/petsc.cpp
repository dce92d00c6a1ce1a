#include "tunica/parallel/petsc.hpp"

#include <fmt/format.h>
#include <stdio_ext.h>

#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "tunica/base/error.hpp"

namespace tunica::parallel {

void check(PetscErrorCode code, const char* file, int line) {
  if (code == 0) return;
  const char* general = nullptr;
  char* specific = nullptr;
  PetscErrorMessage(code, &general, &specific);
  std::string_view name = file;
  name.remove_prefix(name.find_last_of('/') + 1);
  throw SolverError(fmt::format("PETSc error {} ({}) called from {}:{}: {}", static_cast<int>(code),
                                general != nullptr ? general : "unknown", name, line,
                                specific != nullptr ? specific : ""));
}

// A session within a program that has PETSc running has no arguments, and leaves PETSc to that program.
Session::Session(const std::vector<std::string>& options) {
  PetscBool running = PETSC_FALSE;
  check(PetscInitialized(&running));
  if (running == PETSC_TRUE) return;
  arguments_ = {"tunica", "-skip_petscrc", "-no_signal_handler"};
  arguments_.insert(arguments_.end(), options.begin(), options.end());
  for (auto& argument : arguments_) pointers_.push_back(argument.data());
  pointers_.push_back(nullptr);
  const char* variable = std::getenv("PETSC_OPTIONS");
  const std::string kept = variable != nullptr ? variable : "";
  unsetenv("PETSC_OPTIONS");
  int count = static_cast<int>(arguments_.size());
  char** values = pointers_.data();
  check(PetscInitialize(&count, &values, nullptr, nullptr));
  if (variable != nullptr) setenv("PETSC_OPTIONS", kept.c_str(), 1);
  check(PetscPushErrorHandler(PetscReturnErrorHandler, nullptr));
}

Session::~Session() {
  if (arguments_.empty()) return;
  // PETSc flushes the standard output at its end, and prints a trace where that fails; what cannot be written (a full
  // disk) is dropped before it. The stream keeps the error for those who look at the end of the program.
  if (std::fflush(stdout) != 0) __fpurge(stdout);
  PetscPopErrorHandler();
  PetscFinalize();
}

}  // namespace tunica::parallel
