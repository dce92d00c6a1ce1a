#include "tunica/pipeline/record.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

#include "tunica/base/error.hpp"
#include "tunica/config/json_text.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/files/hash.hpp"
#include "tunica/files/lock.hpp"
#include "tunica/files/outputs.hpp"
#include "tunica/files/time_stamp.hpp"

namespace tunica::pipeline {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr const char* record_file = "stage.json";

}  // namespace

std::optional<Record> read_record(const fs::path& folder) {
  files::refuse_other_than_file(folder / record_file);
  std::ifstream stream(folder / record_file);
  if (!stream) return std::nullopt;
  try {
    const auto json = ordered_json::parse(stream);
    Record r;
    r.stage = json.at("stage");
    r.status = json.at("status");
    r.message = json.at("message");
    r.inputs = artifacts::inputs_from_json(json.at("inputs"));
    r.outputs = json.value("outputs", Outputs());
    r.seconds = json.at("seconds");
    r.ranks = json.at("ranks");
    r.version = json.at("program").at("version");
    r.commit = json.at("program").at("commit");
    r.time = json.at("time");
    return r;
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;  // of another program or cut off: the stage counts as never done
  }
}

void write_record(const fs::path& folder, const Record& r) {
  ordered_json json;
  json["stage"] = r.stage;
  json["status"] = r.status;
  json["message"] = r.message;
  json["seconds"] = r.seconds;
  json["time"] = files::time_stamp();
  json["ranks"] = r.ranks;
  json["program"] = {{"version", r.version}, {"commit", r.commit}};
  json["fingerprint"] = files::hex(r.inputs.fingerprint());
  json["inputs"] = artifacts::to_json(r.inputs);
  json["outputs"] = r.outputs;
  files::write_atomically(folder / record_file, config::json_text(json));
}

}  // namespace tunica::pipeline
