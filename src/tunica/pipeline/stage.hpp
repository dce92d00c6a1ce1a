// What the chain knows of a stage. To add one: write its entry in stages.cpp.
#pragma once

#include <mpi.h>

#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "tunica/artifacts/inputs.hpp"
#include "tunica/artifacts/manifest.hpp"
#include "tunica/case/case.hpp"
#include "tunica/config/document.hpp"

namespace tunica::pipeline {

/// Without . and .. in it.
inline std::filesystem::path absolute_path(const std::filesystem::path& path) {
  return std::filesystem::absolute(path).lexically_normal();
}

/// The whole case file.
struct Chain {
  std::filesystem::path file;
  config::Document document;     ///< as it was read; its paths count from the folder of the file
  case_file::Case settings;      ///< the same in values
  std::filesystem::path output;  ///< folder of results
  artifacts::ProgramVersion program;
};

/// One time of a stage, on all ranks.
struct StageCall {
  MPI_Comm comm;
  std::filesystem::path file;  ///< its case file
  bool resume = false;         ///< go on with what is in the folder, as far as the stage can
  artifacts::ProgramVersion program{};
  std::FILE* screen = stdout;
  bool verbose = false;  ///< as RunRequest::verbose

  std::filesystem::path folder() const { return file.parent_path(); }
};

struct Stage {
  const char* name;     ///< of its folder, and for --from and --until
  const char* what;     ///< for the header
  const char* file;     ///< name of its case file
  const char* by_hand;  ///< command that does it again, in its folder
  const char* output;   ///< key of the case that names another folder; empty: there is none
  const char* result;   ///< the file that is written last
  /// What it leaves, as patterns of paths in its folder: once one of these files is gone or damaged, it is not fresh.
  std::vector<std::string> outputs;
  std::function<bool(const case_file::Case&)> wanted;

  /// Its case file, with paths that count from `folder`. On rank 0, when the stages before it are done.
  std::function<config::Document(const Chain&, const std::filesystem::path& folder)> document;
  const config::Description* description;
  /// What the document settles. Throws InputError.
  std::function<std::vector<config::Setting>(const config::Document&, const config::Origin&)> settings;
  std::vector<std::string> without;  ///< patterns of keys that do not change the result
  /// Files that it reads besides those that the document names, with a name each; may be empty.
  std::function<std::vector<std::pair<std::string, std::filesystem::path>>(const Chain&)> reads;

  /// What it goes on with, as patterns of names in its folder: removed before it begins anew, so that a later call
  /// cannot take what belongs to other inputs.
  std::vector<std::string> partial;
  /// Can it go on with what is there after such a change?
  std::function<bool(const artifacts::Change&)> continues;
  /// Can it, with the same inputs, make up for outputs that are lost by going on with what is there? May be empty: no.
  std::function<bool(const std::filesystem::path& folder, const std::vector<std::string>& lost)> recovers;
  /// Does it. Returns the signal that stopped it, 0: none. Collective.
  std::function<int(const StageCall&)> run;
};

/// All stages, in order.
const std::vector<Stage>& stages();

/// The stage of that name, which has to be one of them.
const Stage& stage(const std::string& name);

/// Where a stage of the chain writes.
std::filesystem::path folder_of(const Chain& chain, const Stage& stage);

}  // namespace tunica::pipeline
