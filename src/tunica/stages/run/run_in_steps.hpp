// One run: the class behind Simulation, and behind `tunica run`. Only for the files of this folder.
#pragma once

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <functional>
#include <optional>

#include "tunica/artifacts/lumen_histories.hpp"
#include "tunica/artifacts/step_grid.hpp"
#include "tunica/coupling/monitors.hpp"
#include "tunica/files/lock.hpp"
#include "tunica/parallel/progress.hpp"
#include "tunica/stages/run/cycles.hpp"
#include "tunica/stages/run/simulation.hpp"

namespace tunica::stages {

/// "1 step", "2 steps".
inline std::string plural(std::int64_t n, const char* noun) {
  return fmt::format("{} {}{}", n, noun, n == 1 ? "" : "s");
}

/// One run from its first to its last step. Its member functions are collective.
class Run {
 public:
  Run(const ReadCase& c, const RunRequest& request, MPI_Comm comm, std::FILE* screen);
  bool step();
  RunOutcome finish();
  std::filesystem::path checkpoint();
  bool ended() const { return ended_; }
  std::int64_t steps() const { return grid_.steps_done(); }
  /// Of this call, which may be asked to stop earlier.
  std::int64_t end_step() const { return std::min(last_step(), request_.until.value_or(last_step())); }
  double time() const { return grid_.time(); }
  const artifacts::StepHistory& last() const { return last_; }
  const coupling::State& state() const { return state_; }
  const distributed::DistributedMesh& mesh() const { return mesh_; }
  quantities::Table quantity(const std::string& key, const std::string& region) {
    return fields_->table(key, region, state_);
  }
  const std::filesystem::path& folder() const { return folder_; }
  const OutletModel& outlet(const std::string& face) const;
  void set_outlet(const std::string& face, const OutletModel& model);

 private:
  std::size_t find_outlet(const std::string& face) const;
  /// Runs `action`; an error that it throws ends the run.
  template <class Action>
  auto guarded(const Action& action);
  void refuse_after_end() const;
  void begin();
  bool left() const { return signal_ == 0 && !periodic_ && grid_.steps_done() < end_step(); }
  void take_and_write();
  void end();
  void end_failed(const std::string& message);
  void end_alone(const std::string& message);
  std::filesystem::path checkpoint_folder() const { return folder_ / "checkpoints"; }
  bool is_static() const { return std::holds_alternative<case_file::StaticWall>(case_.analysis); }
  /// Do results show the ends of steps, in statics as well?
  bool at_end() const { return case_.output.instant == case_file::Instant::end; }
  bool continued() const { return request_.restart || request_.restart_file; }
  std::int64_t last_step() const;
  artifacts::StepGrid make_grid(const artifacts::StepGrid::Position* position) const;

  void prepare_folder();
  void try_outputs() const;
  std::string command(const char* option) const;
  void pose();
  void describe_problem();
  void restore();
  void open_outputs();

  coupling::StepReport attempt();
  /// Takes one step, in parts if it must be. False when a signal came instead.
  bool take_step();
  void accepted(const coupling::StepReport& report, double dt, int wanted_level);
  void judge(const coupling::StepReport& report, const coupling::State& before, double dt);
  bool at_cycle_end() const {
    return case_.time && case_.time->cycles && grid_.on_grid() && grid_.steps_done() > 0 &&
           grid_.steps_done() % case_.time->steps_per_cycle() == 0;
  }
  /// At the end of a cycle: does it repeat the one before? `anew`: it has just been computed.
  bool finish_cycle(bool anew);
  /// Logs what the scheme takes from the flow in steps that end within (from, until] [s], and keeps it for the
  /// manifest.
  void tell_dissipation(double from, double until);
  /// Of the run, where no cycle has told it: the last full cycle, or all steps where there is none.
  void tell_dissipation_of_run();
  void rejected(const coupling::StepReport& report);
  void write_fields();
  void save();
  void record(const std::string& status, const std::string& message);
  /// Calls `write` and adds the step to what it throws.
  void on_disk(const std::function<void()>& write) const;
  [[noreturn]] void give_up(const coupling::StepReport& report);

  std::string time_text(double seconds) const;
  std::string step_line(const coupling::StepReport& report, double dt) const;
  std::string progress_note(std::int64_t end, double seconds, std::int64_t since) const;
  double planned_time() const;
  void tell_answer();
  std::string tears_text(const coupling::StepRecord& record) const;

  const ReadCase& input_;
  const case_file::Case& case_;
  RunRequest request_;
  MPI_Comm comm_;
  double started_ = MPI_Wtime();
  std::filesystem::path folder_;
  files::FolderLock lock_;  ///< rank 0
  double time_unit_;        ///< s

  std::uint64_t case_hash_ = 0, mesh_hash_ = 0;
  bool folder_has_results_ = false;
  std::string manifest_damage_;  ///< rank 0: of the manifest of the run that is continued
  std::optional<parallel::Log> log_;
  PosedCase posed_;
  distributed::DistributedMesh& mesh_ = posed_.mesh;
  std::optional<coupling::Problem>& problem_ = posed_.problem;
  std::optional<coupling::Monitors>& monitors_ = posed_.monitors;
  std::optional<artifacts::OutputFields>& fields_ = posed_.fields;
  std::optional<distributed::ResultsWriter> writer_;
  std::optional<artifacts::Histories> histories_;             ///< rank 0
  std::optional<artifacts::LumenHistories> lumen_histories_;  ///< rank 0, with lumens
  std::optional<Cycles> cycles_;                              ///< rank 0, with cycles
  std::optional<artifacts::Manifest> manifest_;               ///< rank 0
  coupling::State state_;
  artifacts::StepGrid grid_;
  artifacts::ManifestProgress progress_;
  std::filesystem::path last_checkpoint_;
  std::int64_t fields_step_ = -1;       ///< last step whose fields are on disk
  std::int64_t checkpoint_state_ = -1;  ///< accepted steps in the last checkpoint
  bool state_is_whole_ = true;          ///< the state belongs to one instant, and the histories reach up to it
  std::optional<parallel::Progress> bar_;
  bool told_dissipation_ = false;
  std::vector<OutletModel> outlet_models_;  ///< of state_.outlets
  artifacts::StepHistory last_{.step = -1, .record = {}, .report = {}};
  bool begun_ = false, nothing_to_do_ = false, periodic_ = false, ended_ = false;
  int signal_ = 0;               ///< that ends the run
  double saved_ = 0;             ///< when the last checkpoint was written [s]
  double begun_at_ = 0;          ///< s
  std::int64_t first_step_ = 0;  ///< steps that were done when it began
};

}  // namespace tunica::stages
