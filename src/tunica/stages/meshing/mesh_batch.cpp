#include "tunica/stages/meshing/mesh_batch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "tunica/base/error.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/files/csv_file.hpp"

namespace tunica::stages {

namespace {

MeshOutcome attempt(const std::string& file, const std::function<std::string(const std::string&)>& make) {
  const auto start = std::chrono::steady_clock::now();
  MeshOutcome outcome{file, 0, 0, {}};
  try {
    outcome.message = make(file);
  } catch (const InputError& error) {
    outcome.exit_code = 2;
    const auto more = error.problems().size() - 1;
    outcome.message = format(error.problems().front()) + (more > 0 ? fmt::format(" (and {} more problems)", more) : "");
  } catch (const std::exception& error) {
    outcome.exit_code = 3;
    outcome.message = error.what();
  }
  std::replace(outcome.message.begin(), outcome.message.end(), '\n', ' ');
  outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return outcome;
}

}  // namespace

std::vector<MeshOutcome> attempt_all(const std::vector<std::string>& files,
                                     const std::function<std::string(const std::string&)>& make) {
  std::vector<MeshOutcome> outcomes;
  for (const auto& file : files) outcomes.push_back(attempt(file, make));
  return outcomes;
}

std::string outcome_text(const std::vector<MeshOutcome>& outcomes) {
  std::size_t longest = 4;
  for (const auto& o : outcomes) longest = std::max(longest, o.file.size());
  std::string text = fmt::format("{:<{}}  exit  seconds  outcome\n", "file", longest);
  for (const auto& o : outcomes)
    text += fmt::format("{:<{}}  {:>4}  {:>7.1f}  {}\n", o.file, longest, o.exit_code, o.seconds, o.message);
  const auto done = std::count_if(outcomes.begin(), outcomes.end(), [](const auto& o) { return o.exit_code == 0; });
  return text + fmt::format("{} of {} done\n", done, outcomes.size());
}

void write_outcomes(const std::vector<MeshOutcome>& outcomes, const std::string& path) {
  std::string csv = "file,exit_code,seconds,outcome\n";
  for (const auto& o : outcomes)
    csv += fmt::format("{},{},{:.1f},{}\n", files::quoted(o.file), o.exit_code, o.seconds, files::quoted(o.message));
  files::write_atomically(path, csv);
}

int worst_of(const std::vector<MeshOutcome>& outcomes) {
  int worst = 0;
  for (const auto& o : outcomes) worst = std::max(worst, o.exit_code);
  return worst;
}

}  // namespace tunica::stages
