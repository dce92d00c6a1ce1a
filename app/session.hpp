// Subcommands that run on several ranks.
#pragma once

#include <functional>

namespace tunica::app {

/// Runs `action` between the start and the end of MPI and PETSc. Returns its exit code, or that of the error it throws,
/// which rank 0 reports. Input and solver errors have to come to all ranks alike; any other exception ends all ranks.
int in_session(const std::function<int()>& action);

}  // namespace tunica::app
