#include "tunica/parallel/launcher.hpp"

#include <gtest/gtest.h>

#include <map>

namespace tunica::parallel {
namespace {

std::string sign(const std::map<std::string, std::string>& variables, int ranks = 1) {
  return sign_of_another_launcher(ranks, [&](const char* name) -> std::optional<std::string> {
    const auto at = variables.find(name);
    if (at == variables.end()) return std::nullopt;
    return at->second;
  });
}

TEST(Launcher, OfAnotherMpiIsNoticed) {
  EXPECT_EQ(sign({{"PMI_SIZE", "4"}, {"PMI_RANK", "0"}}), "PMI_SIZE=4");
  EXPECT_EQ(sign({{"OMPI_COMM_WORLD_SIZE", "2"}}), "OMPI_COMM_WORLD_SIZE=2");
  EXPECT_EQ(sign({{"MV2_COMM_WORLD_SIZE", "8"}}), "MV2_COMM_WORLD_SIZE=8");
  EXPECT_EQ(sign({{"MPI_LOCALNRANKS", "3"}}), "MPI_LOCALNRANKS=3");
  EXPECT_EQ(sign({{"PMIX_RANK", "1"}}), "PMIX_RANK=1");
  EXPECT_EQ(sign({{"SLURM_STEP_NUM_TASKS", "16"}, {"SLURM_PROCID", "0"}}), "SLURM_STEP_NUM_TASKS=16");
}

TEST(Launcher, TellsTheNumberOfAProcess) {
  const auto rank = [](const std::map<std::string, std::string>& variables) {
    return rank_from_launcher([&](const char* name) -> std::optional<std::string> {
      const auto at = variables.find(name);
      return at == variables.end() ? std::nullopt : std::optional(at->second);
    });
  };
  EXPECT_EQ(rank({}), 0);
  EXPECT_EQ(rank({{"OMPI_COMM_WORLD_RANK", "0"}, {"PMIX_RANK", "0"}}), 0);
  EXPECT_EQ(rank({{"OMPI_COMM_WORLD_RANK", "3"}}), 3);
  EXPECT_EQ(rank({{"PMI_RANK", "2"}}), 2);
  EXPECT_EQ(rank({{"SLURM_PROCID", "1"}, {"SLURM_STEP_NUM_TASKS", "4"}}), 1);
}

TEST(Launcher, SerialProcessesAndOwnRanksAreFine) {
  EXPECT_EQ(sign({}), "");
  EXPECT_EQ(sign({{"PMI_SIZE", "4"}}, 4), "") << "this MPI counts them too";
  EXPECT_EQ(sign({{"OMPI_COMM_WORLD_SIZE", "1"}, {"PMIX_RANK", "0"}}), "");
  EXPECT_EQ(sign({{"SLURM_NTASKS", "16"}, {"SLURM_PROCID", "0"}, {"SLURM_JOB_ID", "7"}}), "") << "a batch script";
  EXPECT_EQ(sign({{"SLURM_STEP_NUM_TASKS", "1"}}), "") << "srun -n 1";
  EXPECT_EQ(sign({{"SLURM_STEP_NUM_TASKS", "3"}, {"OMPI_COMM_WORLD_SIZE", "1"}}), "") << "mpirun's daemons are a step";
  EXPECT_EQ(sign({{"PMI_SIZE", "many"}, {"PMIX_RANK", ""}}), "");
}

}  // namespace
}  // namespace tunica::parallel
