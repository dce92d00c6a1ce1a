// stage.json: what went into a stage, and how it ended.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tunica/pipeline/outputs.hpp"
#include "tunica/pipeline/stage.hpp"

namespace tunica::pipeline {

/// What a stage depends on: the same inputs give the same result.
struct Inputs {
  std::map<std::string, std::string> settings;  ///< value by key
  std::map<std::string, std::string> files;     ///< fingerprint by path, relative to the folder of the stage

  std::string fingerprint() const;
  bool operator==(const Inputs&) const = default;
};

struct Record {
  std::string stage, status;  ///< running, done, stopped, failed
  std::string message;        ///< of the error or the signal
  Inputs inputs;
  Outputs outputs;     ///< what it has left when it was done; empty in records that do not tell
  double seconds = 0;  ///< all times together that led to this result
  int ranks = 1;
  std::string version, commit, time;  ///< of the program; when it was written
};

/// The last one of a folder; none when there is none or it is no such file. Not collective, as all here.
std::optional<Record> read_record(const std::filesystem::path& folder);
void write_record(const std::filesystem::path& folder, const Record& record);

/// Fingerprints of files and folders; each is read once.
class Fingerprints {
 public:
  /// Empty when there is nothing of that name.
  std::string of(const std::filesystem::path& path);

 private:
  std::map<std::filesystem::path, std::string> known_;
};

Change difference(const Inputs& then, const Inputs& now);
/// "wall.material.neo_hooke.young_modulus, time.steps and 3 more".
std::string text_of(const Change& change);

}  // namespace tunica::pipeline
