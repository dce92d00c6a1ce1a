#include "tunica/pipeline/follow_up.hpp"

#include <fmt/format.h>

#include "tunica/base/error.hpp"
#include "tunica/files/lock.hpp"
#include "tunica/files/outputs.hpp"
#include "tunica/parallel/agree.hpp"
#include "tunica/parallel/patience.hpp"
#include "tunica/pipeline/chain.hpp"
#include "tunica/pipeline/follow_up_findings.hpp"
#include "tunica/pipeline/plan.hpp"

namespace tunica::pipeline {

namespace {

namespace fs = std::filesystem;

class FollowUpRun {
 public:
  FollowUpRun(const FollowUpRequest& request, MPI_Comm comm, std::FILE* screen)
      : request_(request), comm_(comm), screen_(screen) {}

  int all() {
    begin();
    if (request_.dry_run) return 0;
    for (std::size_t k = 0; k < files_.size(); ++k)
      if (makes_mesh_[k] != 0)
        if (const int signal = chain(k, "mesh"); signal != 0) return signal;
    look();
    if (request_.run)
      for (std::size_t k = 0; k < files_.size(); ++k)
        if (const int signal = chain(k, {}); signal != 0) return signal;
    finish();
    return 0;
  }

 private:
  void begin() {
    parallel::on_root_patiently(comm_, [&] {
      plan_ = plan_follow_up(request_.file, request_.output, request_.run);
      files::make_folder(plan_.output);
      files::try_outputs(plan_.output, follow_up_files(plan_));
      lock_ = files::FolderLock(plan_.output);
      if (!lock_.taken_over().empty()) say("warning: " + lock_.taken_over());
      write_and_check_cases(plan_);
      for (const auto& scan : plan_.scans) {
        files_.push_back(scan.file.string());
        std::vector<Problem> warnings;
        makes_mesh_.push_back(read_chain(scan.file, std::nullopt, warnings).settings.mesh ? 1 : 0);
        for (const auto& warning : warnings) say(fmt::format("warning: scans.{}: {}", scan.name, format(warning)));
        if (request_.dry_run) foretell(scan);
      }
    });
    parallel::broadcast(comm_, files_);
    parallel::broadcast(comm_, makes_mesh_);
  }

  ChainRequest chain_request(const std::string& file) const {
    ChainRequest request;
    request.case_file = file;
    request.program = request_.program;
    return request;
  }

  int chain(std::size_t k, const std::optional<std::string>& until) {
    parallel::on_root(comm_, [&] {
      say(fmt::format("\n##### {} ({}), of {} scans", plan_.scans[k].name, plan_.scans[k].date, plan_.scans.size()));
    });
    ChainRequest request = chain_request(files_[k]);
    request.until = until;
    return run_chain(request, comm_, screen_);
  }

  /// The shape of each, and whether they are of one aorta.
  void look() {
    for (const auto& file : files_) {
      std::vector<Problem> warnings;
      chains_.push_back(parallel::agree(comm_, [&] { return read_chain(file, std::nullopt, warnings); }));
      scans_.push_back(scan_anatomy(chains_.back(), spacing(), comm_));
    }
    parallel::on_root(comm_, [&] {
      std::vector<Problem> problems;
      for (std::size_t k = 1; k < scans_.size(); ++k)
        for (const auto& p : analysis::check_match(scans_[0]->anatomy, scans_[k]->anatomy,
                                                   "scans." + plan_.scans[k].name, plan_.scans[0].name))
          problems.push_back(p);
      if (!problems.empty()) throw InputError(std::move(problems));
    });
  }

  double spacing() {
    double spacing = plan_.settings.spacing;
    parallel::broadcast(comm_, spacing);
    return spacing;
  }

  void finish() {
    parallel::on_root(comm_, [&] {
      std::vector<const ScanAnatomy*> scans;
      for (const auto& scan : scans_) scans.push_back(&*scan);
      const auto findings = find_follow_up(plan_, scans, chains_, request_.run);
      say("");
      for (const auto& line : write_follow_up(findings)) say(line);
    });
  }

  // --- rank 0 -------------------------------------------------------------------------------------------------------

  void say(const std::string& line) const {
    std::fprintf(screen_, "%s\n", line.c_str());
    std::fflush(screen_);
  }

  void foretell(const ScanCase& scan) const {
    say(fmt::format("{} ({})", scan.name, scan.date));
    ChainRequest request = chain_request(scan.file.string());
    if (!request_.run && makes_mesh_.back() != 0) request.until = "mesh";
    if (request_.run || makes_mesh_.back() != 0)
      for (const auto& line : check_chain(request, false)) say("  " + line);
    else
      say("  its mesh is there");
  }

  const FollowUpRequest& request_;
  MPI_Comm comm_;
  std::FILE* screen_;
  std::vector<std::string> files_;  ///< of the chains, on all ranks
  std::vector<int> makes_mesh_;     ///< likewise
  std::vector<Chain> chains_;
  std::vector<std::optional<ScanAnatomy>> scans_;  ///< with values on rank 0

  FollowUpPlan plan_;  ///< rank 0
  files::FolderLock lock_;
};

}  // namespace

int follow_up(const FollowUpRequest& request, MPI_Comm comm, std::FILE* screen) {
  return FollowUpRun(request, comm, screen).all();
}

}  // namespace tunica::pipeline
