// The run manifest: what was run with what, and how it ended. And the folder of results that it describes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tunica/artifacts/dissipation.hpp"
#include "tunica/artifacts/inputs.hpp"
#include "tunica/coupling/problem.hpp"
#include "tunica/distributed/distributed_mesh.hpp"
#include "tunica/geometry/elements_across.hpp"

namespace tunica::artifacts {

/// Version of this program, and the commit that it was built from.
struct ProgramVersion {
  std::string version, commit;
};

/// What does not change while a run goes on.
struct ManifestHead {
  ProgramVersion program;
  std::filesystem::path case_file;
  std::string case_text;
  Inputs inputs;  ///< of the case; its fingerprint is the hash of the case
  std::uint64_t mesh_hash = 0;
  int ranks = 1;
  std::int64_t nodes = 0, elements = 0;
  std::vector<std::pair<std::string, std::int64_t>> regions;  ///< name, elements
  std::int64_t first_step = 0;                                ///< completed steps at the start
  std::vector<geometry::AcrossPart> across{};                 ///< elements across the parts of the lumen
};

/// How far it came.
struct ManifestProgress {
  std::string status = "running";  ///< or completed, stopped, failed
  std::string message;
  std::int64_t last_step = 0, newton_iterations = 0, linear_iterations = 0, rejected_steps = 0;
  double time = 0;                ///< s
  coupling::StepTimings timings;  ///< sums over the steps
  double set_up_seconds = 0, total_seconds = 0;
  double peak_memory = 0;                    ///< sum over the ranks [byte]
  std::optional<Dissipation> dissipation{};  ///< over the last full cycle, or the run where there is none
};

/// manifest.json in the folder of the results. A restart adds an entry to the list of runs. Not collective: for one
/// rank.
class Manifest {
 public:
  /// `continued`: keep the list of earlier runs, as far as it can be read.
  Manifest(const std::filesystem::path& folder, const ManifestHead& head, bool continued);
  /// Writes the file anew. Throws SolverError when it cannot.
  void write(const ManifestProgress& progress);

 private:
  std::filesystem::path file_;
  ManifestHead head_;
  std::string earlier_runs_;  ///< JSON list
  std::string started_;
};

/// What a manifest tells about results that are there already.
struct EarlierResults {
  std::string damage;  ///< of the manifest: is missing, or is cut off. Then nothing but the regions is known
  std::uint64_t case_hash = 0, mesh_hash = 0;
  std::string case_file, status;
  std::int64_t last_step = 0;
  std::vector<std::string> regions;
  std::vector<Inputs> inputs;  ///< of the runs that made them, as far as they are known
};
/// None when the folder holds neither a manifest nor checkpoints or histories. Throws InputError when there is a
/// manifest.json of something else. Not collective.
std::optional<EarlierResults> find_results(const std::filesystem::path& folder);

/// Writes how the last run in the manifest ended, when that manifest says that it is running: for an end of which only
/// one rank may know. Does nothing when there is no such manifest. Not collective.
void record_end(const std::filesystem::path& folder, const std::string& status, const std::string& message);

/// What has changed in a case since a checkpoint of the hash `then` was written into the folder of results beside it:
/// names of settings and files, as far as the manifest there knows them. Not collective.
std::string changed_since(const std::filesystem::path& checkpoint, std::uint64_t then, const Inputs& now);

/// Removes the files that a run writes, and nothing else. Not collective.
void remove_results(const std::filesystem::path& folder, const EarlierResults& results);

/// Largest resident memory of this process so far [byte].
double peak_memory();

}  // namespace tunica::artifacts
