// stage.json: what went into a stage, and how it ended.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "tunica/artifacts/inputs.hpp"
#include "tunica/pipeline/outputs.hpp"
#include "tunica/pipeline/stage.hpp"

namespace tunica::pipeline {

struct Record {
  std::string stage, status;  ///< running, done, stopped, failed
  std::string message;        ///< of the error or the signal
  artifacts::Inputs inputs;
  Outputs outputs;     ///< what it has left when it was done; empty in records that do not tell
  double seconds = 0;  ///< all times together that led to this result
  int ranks = 1;
  std::string version, commit, time;  ///< of the program; when it was written
};

/// The last one of a folder; none when there is none or it is no such file. Not collective, as all here.
std::optional<Record> read_record(const std::filesystem::path& folder);
void write_record(const std::filesystem::path& folder, const Record& record);

}  // namespace tunica::pipeline
