#include "tunica/stages/run/restart.hpp"

#include <fmt/format.h>

#include "tunica/artifacts/checkpoint.hpp"
#include "tunica/artifacts/run_folder.hpp"
#include "tunica/base/error.hpp"
#include "tunica/case/table_ends.hpp"
#include "tunica/parallel/agree.hpp"

namespace tunica::stages {

namespace fs = std::filesystem;

void refuse_tables_that_end(MPI_Comm comm, const case_file::Case& c, const artifacts::StepGrid& from,
                            std::int64_t last_step) {
  case_file::AskedTime asked = case_file::asked_by_run(c);
  if (c.time) {
    const auto left = last_step - from.steps_done();
    if (left <= 0) return;
    asked.begin = from.time();
    asked.first = asked.begin + 0.5 * c.time->step;
    asked.end = asked.begin + static_cast<double>(left) * c.time->step;
  }
  parallel::on_root(comm, [&] {
    auto problems = case_file::check_table_ends(c.boundary, asked);
    if (!problems.empty()) throw InputError(std::move(problems));
  });
}

fs::path last_whole_checkpoint(MPI_Comm comm, const fs::path& folder, const std::string& anew, parallel::Log& log) {
  std::vector<std::string> passed_over;
  std::string name = parallel::on_root(comm, [&] {
    auto found = artifacts::last_sound_checkpoint(folder);
    if (!found.file && found.passed_over.empty())
      throw InputError(folder.string(), "holds no checkpoint to restart from", "begin anew: " + anew);
    if (!found.file) {
      std::string damaged;
      for (const auto& line : found.passed_over) damaged += "\n  " + line;
      throw InputError(folder.string(), "holds no checkpoint that is whole:" + damaged, "begin anew: " + anew);
    }
    passed_over = std::move(found.passed_over);
    return found.file->string();
  });
  parallel::broadcast(comm, name);
  for (const auto& line : passed_over) log.warning(line + "; the one before is taken");
  return name;
}

void tell_missing_fields(const fs::path& folder, const std::vector<std::string>& regions, double time,
                         parallel::Log& log) {
  constexpr std::size_t most = 4;
  auto missing = artifacts::missing_fields(folder, regions, time);
  if (missing.size() > most) {
    missing[most - 1] = fmt::format("and {} more fields are missing", missing.size() - most + 1);
    missing.resize(most);
  }
  for (const auto& line : missing) log.warning(line);
}

}  // namespace tunica::stages
