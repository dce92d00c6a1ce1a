// Errors of the three kinds that a user or developer can meet.
//
// InputError: the case, a file or a mesh is wrong; the user can mend it (exit code 2).
// SolverError: the input is fine but a computation did not succeed (exit code 3).
// Bugs are asserted, never thrown.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace tunica {

/// One thing that is wrong with the input: where, what was found, and how to mend it.
struct Problem {
  std::string where;   ///< path in the case file, file name, or place in the mesh (coordinates, element)
  std::string what;    ///< what is wrong, with the offending value and the allowed range
  std::string remedy;  ///< what to do about it
};

std::string format(const Problem& problem);

/// All problems that were found, reported together.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<Problem> problems);
  InputError(std::string where, std::string what, std::string remedy)
      : InputError({Problem{std::move(where), std::move(what), std::move(remedy)}}) {}
  const std::vector<Problem>& problems() const { return problems_; }

 private:
  std::vector<Problem> problems_;
};

/// A computation failed; the message says what, at which stage and time, with which norms.
class SolverError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace tunica
