#include "tunica/parallel/launcher.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "tunica/base/error.hpp"

namespace tunica::parallel {

namespace {

/// -1: not set, or no number.
long number(const Environment& environment, const char* name) {
  const auto text = environment(name);
  if (!text || text->empty() || text->find_first_not_of("0123456789") != std::string::npos || text->size() > 9)
    return -1;
  return std::stol(*text);
}

std::optional<std::string> of_process(const char* name) {
  const char* value = std::getenv(name);
  if (value == nullptr) return std::nullopt;
  return value;
}

}  // namespace

std::string sign_of_another_launcher(int ranks, const Environment& environment) {
  if (ranks != 1) return {};
  // Open MPI and MPICH tell their processes how many they are. Who was told "one" is the only one, whatever surrounds
  // it: an mpirun within a job step, say.
  for (const char* told : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "MV2_COMM_WORLD_SIZE"}) {
    const long size = number(environment, told);
    if (size == 1) return {};
    if (size > 1) return fmt::format("{}={}", told, size);
  }
  // Processes on this host; those of a job step; the number of this one. SLURM_NTASKS is not among them: a batch script
  // has it too, and what it starts without srun is a single process.
  for (const char* told : {"MPI_LOCALNRANKS", "SLURM_STEP_NUM_TASKS"})
    if (const long size = number(environment, told); size > 1) return fmt::format("{}={}", told, size);
  if (const long rank = number(environment, "PMIX_RANK"); rank > 0) return fmt::format("PMIX_RANK={}", rank);
  return {};
}

long rank_from_launcher(const Environment& environment) {
  for (const char* told : {"OMPI_COMM_WORLD_RANK", "PMI_RANK", "MV2_COMM_WORLD_RANK", "PMIX_RANK"})
    if (const long rank = number(environment, told); rank >= 0) return rank;
  // In a batch script, too; there it is 0.
  return std::max(0L, number(environment, "SLURM_PROCID"));
}

long rank_from_launcher() { return rank_from_launcher(of_process); }

void refuse_another_launcher(int ranks) {
  const std::string sign = sign_of_another_launcher(ranks, of_process);
  if (sign.empty()) return;
  throw InputError(
      "the launcher of this program",
      fmt::format("has started several processes ({}), but each of them takes itself for the only one", sign),
      "start it by the mpirun of the MPI that tunica was built with; for one process among others, unset that "
      "variable");
}

}  // namespace tunica::parallel
