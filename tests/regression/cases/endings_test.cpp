// Errors in the middle of a run: what was computed stays, and the manifest tells the end.
#include <functional>

#include "small_cases.hpp"
#include "tunica/artifacts/manifest.hpp"
#include "tunica/base/error.hpp"

namespace tunica::test {
namespace {

/// A screen that does something, on the rank that writes, when a line appears.
struct Watcher {
  std::string line;
  std::function<void()> action;
  std::string seen = {};
};

ssize_t watch(void* cookie, const char* text, std::size_t size) {
  auto& watcher = *static_cast<Watcher*>(cookie);
  watcher.seen.append(text, size);
  if (!watcher.line.empty() && watcher.seen.find(watcher.line) != std::string::npos) {
    watcher.line.clear();
    watcher.action();
  }
  return static_cast<ssize_t>(size);
}

template <class Error>
std::string message_of_run(const fs::path& file, Watcher watcher) {
  std::FILE* screen = fopencookie(&watcher, "w", {nullptr, watch, nullptr, nullptr});
  stages::RunRequest request;
  request.case_file = file;
  request.verbose = true;  // the steps are what is watched
  const std::string message = message_of<Error>([&] { stages::run(MPI_COMM_WORLD, request, screen); });
  std::fclose(screen);
  MPI_Barrier(MPI_COMM_WORLD);
  return message;
}

void expect_continued_as_whole(const fs::path& folder, const fs::path& file, int steps) {
  stages::RunRequest request;
  request.restart = true;
  run(file, request);
  request.restart = false;
  request.directory = folder / "whole";
  run(file, request);
  for (const std::string& name :
       {std::string("balance.csv"), std::string("cycles.csv"), fmt::format("checkpoints/step_{:08}.checkpoint", steps)})
    EXPECT_TRUE(slurp(folder / "results" / name) == slurp(folder / "whole" / name)) << name;
}

// The table of the cycles is made from the histories, which somebody has damaged meanwhile.
TEST(Endings, AnInputErrorDuringTheRunLeavesACheckpointAndAStatus) {
  const SharedFolder folder;
  std::string text = windkessel_case(6);
  text.replace(text.find("steps: 6"), 8, "cycles: {period: 6 ms, most: 4}");
  const auto file = folder.write("case.yaml", text), results = folder.path() / "results";
  const std::string message = message_of_run<InputError>(
      file, {"step 5/12", [&] { std::ofstream(results / "faces.csv", std::ios::app) << "nonsense\n"; }});
  EXPECT_NE(message.find("faces.csv:"), std::string::npos) << message;
  EXPECT_NE(slurp(results / "manifest.json").find("\"status\": \"failed\""), std::string::npos);
  EXPECT_TRUE(fs::exists(results / "checkpoints/step_00000006.checkpoint"));
  EXPECT_NE(slurp(results / "run.log").find("error   "), std::string::npos);
  MPI_Barrier(MPI_COMM_WORLD);
  expect_continued_as_whole(folder.path(), file, 12);
}

// A history that cannot be written lacks a step: the state of that step is not kept, since it would leave a hole.
TEST(Endings, AHistoryThatCannotBeWrittenLeavesTheCheckpointBefore) {
  const SharedFolder folder;
  std::string text = windkessel_case(8);
  text.replace(text.find("every: 5"), 8, "every: 2, checkpoint_every: 2");
  const auto file = folder.write("case.yaml", text), results = folder.path() / "results";
  const std::string message =
      message_of_run<SolverError>(file, {"step 3/8", [&] { fs::rename(results / "steps.csv", results / "kept"); }});
  EXPECT_NE(message.find("steps.csv"), std::string::npos) << message;
  EXPECT_NE(slurp(results / "manifest.json").find("\"status\": \"failed\""), std::string::npos);
  EXPECT_TRUE(fs::exists(results / "checkpoints/step_00000002.checkpoint"));
  EXPECT_FALSE(fs::exists(results / "checkpoints/step_00000004.checkpoint"));
  if (parallel::rank(MPI_COMM_WORLD) == 0) fs::rename(results / "kept", results / "steps.csv");
  MPI_Barrier(MPI_COMM_WORLD);
  expect_continued_as_whole(folder.path(), file, 8);
}

}  // namespace
}  // namespace tunica::test
