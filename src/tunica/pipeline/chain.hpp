// From one case file over all stages to a page: mesh, fibres, prestress, run, report. A stage whose inputs are those of
// its last time is not done again.
#pragma once

#include <mpi.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tunica/artifacts/manifest.hpp"
#include "tunica/pipeline/record.hpp"

namespace tunica::pipeline {

struct ChainRequest {
  std::filesystem::path case_file;
  std::optional<std::filesystem::path> directory{};  ///< of the results, instead of the one that the case names
  std::optional<std::string> from{};                 ///< this stage and those after it are done anew
  std::optional<std::string> until{};                ///< the last stage that is done
  bool overwrite = false;                            ///< all stages are done anew
  std::optional<std::string> only{};                 ///< this stage alone, on what those before it have left
  bool dry_run = false;                              ///< only say what would be done, and why
  bool verbose = false;                              ///< as RunRequest::verbose
  artifacts::ProgramVersion program{};
};

/// Does the case ask for more than its run? Each of the sections mesh, fibres, prestress, outlets, post, report and
/// compare does, but a prestress that `wall.prestress` names already, and outlets that lie in their file beside the
/// case. Throws InputError when the file cannot be read as YAML. Collective.
bool is_chain(const std::filesystem::path& case_file, MPI_Comm comm);

/// Do the results of such a case lie in folders of its stages? Not where the manifest of a run of the meshes that it
/// names lies in its folder of results itself: that was made by hand, or the file is that of a single stage. As
/// is_chain().
bool lies_in_stages(const std::filesystem::path& case_file, MPI_Comm comm);

/// Is it a case file at all, in contrast to that of a single stage? As is_chain().
bool is_case(const std::filesystem::path& file, MPI_Comm comm);

/// Does the stages of the case, each in a folder of its own in the folder of results:
/// - a case file of the stage alone, which can be run by hand; what the stage writes;
/// - stage.json: what went in, how it ended, how long it took.
/// At last the laws of `compare`, as compare_on_common() does them, unless only a part is asked for. A stage that was
/// interrupted continues where it can. Returns the signal that stopped it, 0: none.
///
/// Throws InputError with all problems of the whole file before anything is done; what the stages throw, with the name
/// of the stage and how to go on. Collective.
int run_chain(const ChainRequest& request, MPI_Comm comm, std::FILE* screen);

/// All that can be said before any stage is done: problems of the file as InputError, warnings and what would be done
/// as lines. `with_meshes`: meshes that the case names are read, and every stage is asked about them. Not collective.
std::vector<std::string> check_chain(const ChainRequest& request, bool with_meshes);

/// The record of a stage that was asked for by its own command, so that a chain which asks for the same takes what it
/// made. Not collective.
class OwnRecord {
 public:
  /// `file`: the case file of the stage, `folder`: where it writes. Writes nothing yet.
  OwnRecord(const std::string& stage, const std::filesystem::path& file, const std::filesystem::path& folder, int ranks,
            const artifacts::ProgramVersion& program);
  /// Before the stage writes: what is there belongs to other inputs from now on. Makes the folder.
  void begin();
  void done();

 private:
  std::filesystem::path folder_;
  Record record_;
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
};

}  // namespace tunica::pipeline
