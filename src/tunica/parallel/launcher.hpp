// Was this process started by the MPI that it is linked with?
#pragma once

#include <functional>
#include <optional>
#include <string>

namespace tunica::parallel {

/// Value of an environment variable, none when it is not set.
using Environment = std::function<std::optional<std::string>(const char* name)>;

/// The launcher of another MPI starts N processes of which each takes itself for the only one. `ranks`: as this MPI
/// counts them. Returns what tells of more processes ("PMI_SIZE=4"), empty when nothing does. A single process within
/// an allocation of a batch system is none of N.
std::string sign_of_another_launcher(int ranks, const Environment& environment);

/// Number of this process among those that a launcher has started, as its environment tells it before MPI begins; 0 for
/// a process that was started alone.
long rank_from_launcher(const Environment& environment);
long rank_from_launcher();

/// Throws InputError when there is such a sign in the environment of this process.
void refuse_another_launcher(int ranks);

}  // namespace tunica::parallel
