// A run, step by step: `tunica run` takes it to its end, a program of one's own looks and acts between the steps.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <variant>

#include "tunica/artifacts/histories.hpp"
#include "tunica/quantities/quantity.hpp"
#include "tunica/stages/run_case.hpp"

namespace tunica::stages {

class Run;  // run.cpp

using OutletModel = std::variant<bc::Resistance, bc::Rcr>;

/// Writes into the folder of results what run() says, as far as it is stepped. Member functions are collective, but for
/// those that are const. An error of step(), checkpoint() or finish() ends the run, with everything until then on disk,
/// as it ends `tunica run`.
class Simulation {
 public:
  /// Everything before the first step: poses the case, takes its start or the checkpoint of the request, opens the
  /// folder. Throws as run(). Installs no signal handlers; messages go to `screen` of rank 0 (null: to run.log alone).
  /// `c` must outlive this.
  Simulation(const ReadCase& c, const RunRequest& request, MPI_Comm comm, std::FILE* screen);
  ~Simulation();
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// Takes the next step, in parts if it must be, and writes what is due after it. False where there is none: the run
  /// is at its end, its cycles are periodic, or a signal that parallel::StopSignals caught wants it to stop. Throws
  /// InputError after finish() and after an error.
  bool step();
  /// Writes fields and checkpoint of the last step and how the run has ended: `completed` where no step was left,
  /// `stopped` otherwise, to be continued by a restart. Fields and mesh stay. Again: the same outcome, no more.
  RunOutcome finish();
  /// Writes a checkpoint of the present state into the folder of results and returns its name; the last two are kept.
  std::filesystem::path checkpoint();

  bool finished() const;             ///< by finish() or by an error
  std::int64_t steps() const;        ///< completed
  std::int64_t steps_asked() const;  ///< at the end of the run at the latest
  double time() const;               ///< [s]; load factor in statics
  /// What the histories got of the last step, of its last part where it was taken in parts; its step is -1 before the
  /// first one.
  const artifacts::StepHistory& last() const;
  /// Fields of the last step; they stay where they are in memory for as long as this lives.
  const coupling::State& state() const;
  const distributed::DistributedMesh& mesh() const;
  /// A quantity of the last step in a region, by its key: artifacts::OutputFields::table. Collective.
  quantities::Table quantity(const std::string& key, const std::string& region);
  std::filesystem::path folder() const;

  /// Parameters of the outlet on a face. Throws InputError for a face without one.
  OutletModel outlet(const std::string& face) const;
  /// Other ones from the last step on; flow and stored pressure stay, and run.log says so. They are no part of
  /// checkpoints: a restart has those of the case until they are set again. Throws InputError as bc::Outlet does, and
  /// where a resistance would become a Windkessel or the other way round.
  void set_outlet(const std::string& face, const OutletModel& model);

 private:
  std::unique_ptr<Run> run_;
};

}  // namespace tunica::stages
