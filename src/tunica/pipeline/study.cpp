#include "tunica/pipeline/study.hpp"

#include <fmt/format.h>

#include <set>

#include "tunica/base/error.hpp"
#include "tunica/files/lock.hpp"
#include "tunica/files/outputs.hpp"
#include "tunica/parallel/agree.hpp"
#include "tunica/parallel/patience.hpp"
#include "tunica/pipeline/chain.hpp"
#include "tunica/pipeline/foresight.hpp"
#include "tunica/pipeline/plan.hpp"
#include "tunica/pipeline/study_results.hpp"

namespace tunica::pipeline {

namespace {

namespace fs = std::filesystem;

/// One chain of the study, or its beginning.
struct Job {
  std::size_t point;
  std::string until{};  ///< last stage; empty: all
};

class StudyRun {
 public:
  StudyRun(const StudyRequest& request, MPI_Comm comm, std::FILE* screen)
      : request_(request), comm_(comm), screen_(screen) {}

  StudyOutcome all() {
    begin();
    if (request_.dry_run) return {};
    StudyOutcome outcome;
    for (std::size_t k = 0; k < files_.size() && outcome.signal == 0; ++k) outcome.signal = one(k);
    finish(outcome);
    return outcome;
  }

 private:
  void begin() {
    parallel::on_root_patiently(comm_, [&] {
      plan_ = plan_study(request_.file, request_.output);
      choose();
      prepare();
      for (const auto& job : jobs_) {
        files_.push_back(plan_.cases[job.point].file.string());
        until_.push_back(job.until);
      }
    });
    parallel::broadcast(comm_, files_);
    parallel::broadcast(comm_, until_);
  }

  /// A chain in which an error of a single point does not end the study. Returns the signal that stopped it.
  int one(std::size_t k) {
    parallel::on_root(comm_, [&] { announce(jobs_[k]); });
    ChainRequest chain;
    chain.case_file = files_[k];
    chain.program = request_.program;
    if (!until_[k].empty()) chain.until = until_[k];
    const PointEnd end = run_point(chain, comm_, screen_);
    parallel::on_root(comm_, [&] { record(jobs_[k], end); });
    return end.signal;
  }

  void finish(StudyOutcome& outcome) {
    parallel::on_root_patiently(comm_, [&] {
      outcome.failed = failed_;
      if (request_.point || request_.shared) return;
      const auto results = read_results(plan_);
      outcome.failed = 0;
      for (const auto& r : results) outcome.failed += r.state.status == "failed";
      for (const auto& line : write_study(plan_, results)) say(line);
    });
    parallel::broadcast(comm_, outcome.failed);
  }

  // --- rank 0 -------------------------------------------------------------------------------------------------------

  void say(const std::string& line) const {
    std::fprintf(screen_, "%s\n", line.c_str());
    std::fflush(screen_);
  }

  void choose() {
    if (request_.table) return;
    const std::size_t count = plan_.points.size();
    if (request_.point && (*request_.point < 1 || static_cast<std::size_t>(*request_.point) > count))
      throw InputError("--point", fmt::format("{} is no point of the study", *request_.point),
                       fmt::format("give one from 1 to {}", count));
    if (request_.shared) return choose_shared();
    if (request_.point) return jobs_.push_back({static_cast<std::size_t>(*request_.point - 1)});
    for (std::size_t k = 0; k < count; ++k) jobs_.push_back({k});
  }

  /// The first point that has a shared stage does it; stages before that one are shared, too, or its own.
  void choose_shared() {
    std::set<fs::path> chosen;
    for (std::size_t k = 0; k < plan_.cases.size(); ++k) {
      std::string last;
      for (const auto& stage : stages())
        if (const auto at = plan_.cases[k].shared.find(stage.name); at != plan_.cases[k].shared.end())
          if (chosen.insert(at->second).second) last = stage.name;
      if (!last.empty()) jobs_.push_back({k, last});
    }
  }

  /// Everything that can be refused before the first stage is.
  void prepare() {
    std::vector<std::size_t> points;
    for (const auto& job : jobs_) points.push_back(job.point);
    CaseFiles cases(!request_.dry_run);
    cases.make_folder(plan_.output);
    files::try_outputs(plan_.output, {"study.csv", "study.json", "study.html"});
    for (const auto k : points) files::refuse_if_owned_by_another(plan_.cases[k].folder);
    if (!request_.point && !request_.dry_run) {  // points of an array of jobs run side by side
      lock_ = files::FolderLock(plan_.output);
      if (!lock_.taken_over().empty()) say("warning: " + lock_.taken_over());
    }
    write_and_check_cases(plan_, points, cases);
    if (!points.empty()) check_first(plan_.cases[points.front()]);
    if (request_.dry_run)
      for (const auto k : points) foretell(k);
  }

  /// Meshes that the case names are read once, not for every point: what is wrong with one is wrong with most.
  static void check_first(const PointCase& first) {
    std::vector<Problem> warnings;
    check_on_meshes(read_chain(first.file, std::nullopt, warnings));
  }

  void foretell(std::size_t k) const {
    say(fmt::format("{}: {}", plan_.name_of(k), read_state(plan_.cases[k]).status));
    ChainRequest chain;
    chain.case_file = plan_.cases[k].file;
    chain.program = request_.program;
    for (const auto& line : check_chain(chain, false)) say("  " + line);
    for (const auto& [stage, folder] : plan_.cases[k].shared)
      say(fmt::format("  shared: {} in {}", stage, folder.lexically_relative(plan_.output).string()));
  }

  void announce(const Job& job) const {
    say(fmt::format("\n##### {}{}, of {}", plan_.name_of(job.point),
                    job.until.empty() ? "" : fmt::format(", its shared stages up to {}", job.until),
                    plan_.points.size()));
    if (job.until.empty()) write_state(plan_.cases[job.point], {"running", ""});
  }

  void record(const Job& job, const PointEnd& end) {
    if (!end.error.empty()) {
      ++failed_;
      say(fmt::format("{} failed: {}", plan_.name_of(job.point), end.error));
    }
    if (job.until.empty()) write_state(plan_.cases[job.point], state_of(end));
  }

  const StudyRequest& request_;
  MPI_Comm comm_;
  std::FILE* screen_;
  std::vector<std::string> files_, until_;  ///< of the jobs, on all ranks

  StudyPlan plan_;  ///< rank 0, as what follows
  std::vector<Job> jobs_;
  files::FolderLock lock_;
  int failed_ = 0;
};

}  // namespace

StudyOutcome study(const StudyRequest& request, MPI_Comm comm, std::FILE* screen) {
  return StudyRun(request, comm, screen).all();
}

}  // namespace tunica::pipeline
