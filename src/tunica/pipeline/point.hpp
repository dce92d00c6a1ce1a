// A case with other values of some of its keys, as a chain of its own: a point of a study, a run of an identification.
#pragma once

#include <mpi.h>

#include <cstdio>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tunica/pipeline/chain.hpp"
#include "tunica/pipeline/stage.hpp"

namespace tunica::pipeline {

struct PointCase {
  std::filesystem::path folder, file;  ///< of its results; its case file
  std::string text;                    ///< of the case file
  /// Folders of the stages that it shares with other points, by the name of the stage.
  std::map<std::string, std::filesystem::path> shared{};

  /// Where a stage of it writes.
  std::filesystem::path folder_of_stage(const std::string& stage) const;
};

/// Is a setting the key, or one below it?
bool lies_under(const std::string& path, const std::string& key);

/// The case with these values by key, in YAML, its paths as they were; every stage in its own place.
config::Document with_values(const config::Document& base,
                             const std::vector<std::pair<std::string, std::string>>& values);
/// "Title: point 3".
void add_to_title(config::Document& document, const std::string& more);

/// All that can matter to a stage before `run`, as text: points with the same text share what it makes.
std::string what_matters(const Stage& stage, const std::vector<config::Setting>& settings);
/// Can points have the result of the stage in common?
bool is_shareable(const Stage& stage);

/// The case file of a point. `head`: its first line, without the # and the end; `from`: the folder that paths of the
/// document count from.
std::string text_of_point(const PointCase& point, config::Document document, const std::filesystem::path& from,
                          const std::string& head);
/// Makes its folder and writes the case file, where that is another one.
void write_case(const PointCase& point);

/// Case files that are kept, or only looked at: then what it has written and made is gone with its end, and what was
/// there is as it was.
class CaseFiles {
 public:
  explicit CaseFiles(bool keep) : keep_(keep) {}
  ~CaseFiles();
  CaseFiles(const CaseFiles&) = delete;
  CaseFiles& operator=(const CaseFiles&) = delete;

  /// With those above it.
  void make_folder(const std::filesystem::path& folder);
  void write(const PointCase& point);

 private:
  bool keep_;
  std::vector<std::pair<std::filesystem::path, std::optional<std::string>>> before_;  ///< text; none: no such file
  std::vector<std::filesystem::path> made_;                                           ///< folders, outermost first
};

/// point.json: how a point ended. Not collective, as what is above and below.
struct PointState {
  std::string status;   ///< running, done, stopped, failed; pending: never begun with the case as it is
  std::string message;  ///< of the error
};
PointState read_state(const PointCase& point);
void write_state(const PointCase& point, const PointState& state);

std::filesystem::path post_json(const PointCase& point);
/// All its stages, shared ones included.
double seconds_of(const PointCase& point);

/// How the chain of a point came to its end.
struct PointEnd {
  int signal = 0;       ///< that stopped it, 0: none
  std::string error{};  ///< empty: none
};

/// As run_chain(), but an error is returned, not thrown. Collective.
PointEnd run_point(const ChainRequest& request, MPI_Comm comm, std::FILE* screen);
/// For point.json.
PointState state_of(const PointEnd& end);

}  // namespace tunica::pipeline
