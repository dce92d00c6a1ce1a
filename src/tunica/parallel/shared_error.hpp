// Errors that all ranks throw alike.
#pragma once

#include <stdexcept>

namespace tunica::parallel {

/// What `agree` and `on_root` throw on all ranks for an error of another kind than InputError and SolverError. Any
/// other exception may be that of one rank alone, while the others wait for it.
class SharedError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace tunica::parallel
