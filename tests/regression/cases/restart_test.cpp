// Runs that are interrupted and continued.
#include <csignal>

#include "small_cases.hpp"
#include "tunica/base/error.hpp"
#include "tunica/parallel/signals.hpp"

namespace tunica::test {
namespace {

/// Drops what tells runs apart: the hashes and the state stay.
std::string checkpoint_of(const fs::path& results, int step) {
  return slurp(results / "checkpoints" / fmt::format("step_{:08}.checkpoint", step));
}

stages::RunRequest into(const fs::path& directory) {
  stages::RunRequest request;
  request.directory = directory;
  return request;
}

void expect_same_results(const fs::path& a, const fs::path& b, int step) {
  EXPECT_FALSE(checkpoint_of(a, step).empty());
  EXPECT_TRUE(checkpoint_of(a, step) == checkpoint_of(b, step)) << "the states differ";
  for (const char* file : {"faces.csv", "balance.csv", "outlets.csv", "lumen.hdf.series"})
    EXPECT_EQ(slurp(a / file), slurp(b / file)) << file;
}

class Restart : public testing::TestWithParam<std::string> {};

TEST_P(Restart, ContinuesBitForBitOnAsManyRanks) {
  const SharedFolder folder;
  const auto file = folder.write("case.yaml", GetParam());
  run(file, into(folder.path() / "whole"));
  stages::RunRequest request = into(folder.path() / "parts");
  request.until = 5;
  run(file, request);
  request.until.reset();
  request.restart = true;
  const std::string printed = run(file, request);
  if (parallel::rank(MPI_COMM_WORLD) == 0) {
    EXPECT_NE(printed.find("continuing from"), std::string::npos) << printed;
  }
  expect_same_results(folder.path() / "whole", folder.path() / "parts", 10);

  // Once more from the middle: later lines and checkpoints are dropped first.
  MPI_Barrier(MPI_COMM_WORLD);
  request.restart_file = folder.path() / "parts/checkpoints/step_00000005.checkpoint";
  request.until = 6;
  run(file, request);
  EXPECT_EQ(Table(folder.path() / "parts/faces.csv")["step"].size(), 6u);
  EXPECT_FALSE(fs::exists(folder.path() / "parts/checkpoints/step_00000010.checkpoint"));
}

INSTANTIATE_TEST_SUITE_P(Cases, Restart, testing::Values(coupled_case(10), windkessel_case(10)),
                         [](const auto& test) { return test.index == 0 ? "coupled" : "windkessel"; });

TEST(RestartOnOtherRanks, AgreesToTheTolerance) {
  const SharedFolder folder;
  const auto file = folder.write("case.yaml", coupled_case(10));
  const auto whole = folder.path() / "whole", parts = folder.path() / "parts";
  run(file, into(whole));
  if (parallel::rank(MPI_COMM_WORLD) == 0) {
    stages::RunRequest alone = into(parts);
    alone.until = 5;
    run(file, alone, MPI_COMM_SELF);
  }
  MPI_Barrier(MPI_COMM_WORLD);
  stages::RunRequest request = into(parts);
  request.restart = true;
  run(file, request);
  const Table a(whole / "balance.csv"), b(parts / "balance.csv");
  for (const char* column : {"lumen volume [mm^3]", "wall strain energy [J]", "max displacement [mm]", "dV/dt [ml/s]"})
    EXPECT_NEAR(a.last(column), b.last(column), 1e-7 * std::abs(a.last(column))) << column;
}

/// A screen that sends this process a signal when a line appears.
struct Trigger {
  std::string line;
  int signal;
  std::string seen = {};
};

ssize_t look(void* cookie, const char* text, std::size_t size) {
  auto& trigger = *static_cast<Trigger*>(cookie);
  trigger.seen.append(text, size);
  if (!trigger.line.empty() && trigger.seen.find(trigger.line) != std::string::npos) {
    trigger.line.clear();
    std::raise(trigger.signal);
  }
  return static_cast<ssize_t>(size);
}

class StoppedRun : public testing::TestWithParam<int> {};

TEST_P(StoppedRun, FinishesItsStepAndCanBeContinued) {
  const SharedFolder folder;
  const auto file = folder.write("case.yaml", coupled_case(10));
  const auto whole = folder.path() / "whole", parts = folder.path() / "parts";
  run(file, into(whole));
  Trigger trigger{"step 3/10", GetParam()};
  std::FILE* screen = fopencookie(&trigger, "w", {nullptr, look, nullptr, nullptr});
  stages::RunRequest request = into(parts);
  request.case_file = file;
  const auto outcome = [&] {
    const parallel::StopSignals signals;  // stages have no handlers of their own
    return stages::run(MPI_COMM_WORLD, request, screen);
  }();
  std::fclose(screen);
  EXPECT_EQ(outcome.signal, GetParam());
  EXPECT_EQ(outcome.steps, 3);
  EXPECT_FALSE(checkpoint_of(parts, 3).empty());
  EXPECT_NE(slurp(parts / "manifest.json").find("\"status\": \"stopped\""), std::string::npos);
  if (parallel::rank(MPI_COMM_WORLD) == 0) {
    EXPECT_NE(trigger.seen.find("after 3 steps"), std::string::npos) << trigger.seen;
  }
  MPI_Barrier(MPI_COMM_WORLD);
  request.restart = true;
  run(file, request);
  expect_same_results(whole, parts, 10);
}

INSTANTIATE_TEST_SUITE_P(Signals, StoppedRun, testing::Values(SIGINT, SIGTERM, SIGUSR1));

TEST(ResultsFolder, IsNotOverwrittenSilently) {
  const SharedFolder folder;
  const auto file = folder.write("case.yaml", windkessel_case(5)), other = folder.write("other.yaml", coupled_case(5));
  run(file);
  const auto results = folder.path() / "results";
  const std::string before = slurp(results / "faces.csv");
  MPI_Barrier(MPI_COMM_WORLD);
  const auto refused = [&](const fs::path& c, bool restart, const char* what) {
    stages::RunRequest request = into(results);
    request.restart = restart;
    const std::string message = message_of<InputError>([&] { run(c, request); });
    EXPECT_NE(message.find(what), std::string::npos) << message;
  };
  refused(file, false, "holds results of this case");
  refused(other, false, "holds results of another case");
  refused(other, true, "holds results on another mesh");
  EXPECT_EQ(slurp(results / "faces.csv"), before);
  EXPECT_TRUE(fs::exists(results / "outlets.csv"));

  MPI_Barrier(MPI_COMM_WORLD);
  if (parallel::rank(MPI_COMM_WORLD) == 0) std::ofstream(results / "notes.txt") << "mine";
  stages::RunRequest request = into(results);
  request.overwrite = true;
  request.until = 2;
  run(other, request);
  EXPECT_TRUE(fs::exists(results / "wall.hdf.series"));
  EXPECT_FALSE(fs::exists(results / "lumen_000005.hdf"));
  EXPECT_TRUE(fs::exists(results / "notes.txt"));  // not a file of a run
}

TEST(ResultsFolder, ACompletedRunHasNothingLeftToDo) {
  const SharedFolder folder;
  const auto file = folder.write("case.yaml", windkessel_case(3));
  run(file);
  stages::RunRequest request;
  request.restart = true;
  const std::string printed = run(file, request);
  if (parallel::rank(MPI_COMM_WORLD) == 0) {
    EXPECT_NE(printed.find("nothing to do: 3 of 3 steps"), std::string::npos) << printed;
  }
  const auto longer = folder.write("case.yaml", windkessel_case(5));
  const std::string more = run(longer, request);
  if (parallel::rank(MPI_COMM_WORLD) == 0) {
    EXPECT_NE(more.find("changed since the checkpoint was written: time.steps; the run goes on"), std::string::npos)
        << more;
  }
  EXPECT_EQ(Table(folder.path() / "results/faces.csv")["step"].size(), 5u);
}

}  // namespace
}  // namespace tunica::test
