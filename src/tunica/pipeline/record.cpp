#include "tunica/pipeline/record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tunica/base/error.hpp"
#include "tunica/config/json_text.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/files/hash.hpp"
#include "tunica/files/lock.hpp"
#include "tunica/files/time_stamp.hpp"

namespace tunica::pipeline {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;
using Map = std::map<std::string, std::string>;

constexpr const char* record_file = "stage.json";

void add(files::Hash& hash, const std::string& text) {
  hash.add(text.data(), text.size());
  const std::size_t length = text.size();
  hash.add(&length, sizeof length);
}

/// Locks, and files that are being written: no content of a folder.
bool is_passing(const fs::path& file) {
  const std::string name = file.filename().string();
  return name.starts_with(files::lock_name) || name.ends_with(files::temporary_ending);
}

void add_file(files::Hash& hash, const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::vector<char> block(1 << 20);
  while (stream) {
    stream.read(block.data(), static_cast<std::streamsize>(block.size()));
    hash.add(block.data(), static_cast<std::size_t>(stream.gcount()));
  }
}

std::vector<std::string> changed(const Map& then, const Map& now) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : then)
    if (const auto at = now.find(key); at == now.end() || at->second != value) keys.push_back(key);
  for (const auto& [key, value] : now)
    if (!then.contains(key)) keys.push_back(key);
  return keys;
}

}  // namespace

std::string Inputs::fingerprint() const {
  files::Hash hash;
  for (const auto* map : {&settings, &files})
    for (const auto& [key, value] : *map) {
      add(hash, key);
      add(hash, value);
    }
  return files::hex(hash.value());
}

std::optional<Record> read_record(const fs::path& folder) {
  std::ifstream stream(folder / record_file);
  if (!stream) return std::nullopt;
  try {
    const auto json = ordered_json::parse(stream);
    Record r;
    r.stage = json.at("stage");
    r.status = json.at("status");
    r.message = json.at("message");
    r.inputs.settings = json.at("settings").get<Map>();
    r.inputs.files = json.at("files").get<Map>();
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
  json["fingerprint"] = r.inputs.fingerprint();
  json["settings"] = r.inputs.settings;
  json["files"] = r.inputs.files;
  json["outputs"] = r.outputs;
  files::write_atomically(folder / record_file, config::json_text(json));
}

std::string Fingerprints::of(const fs::path& path) {
  const fs::path full = fs::absolute(path).lexically_normal();
  if (const auto known = known_.find(full); known != known_.end()) return known->second;
  if (!fs::exists(full)) return {};
  files::Hash hash;
  if (fs::is_directory(full)) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(full))
      if (entry.is_regular_file() && !is_passing(entry.path())) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const auto& file : files) {
      add(hash, file.lexically_relative(full).string());
      add_file(hash, file);
    }
  } else {
    add_file(hash, full);
  }
  return known_[full] = files::hex(hash.value());
}

Change difference(const Inputs& then, const Inputs& now) {
  return {changed(then.settings, now.settings), changed(then.files, now.files), then.settings, now.settings};
}

std::string text_of(const Change& change) {
  constexpr std::size_t most = 3;
  auto names = change.settings;
  names.insert(names.end(), change.files.begin(), change.files.end());
  std::string text;
  for (std::size_t k = 0; k < std::min(most, names.size()); ++k) text += (k == 0 ? "" : ", ") + names[k];
  return names.size() > most ? fmt::format("{} and {} more", text, names.size() - most) : text;
}

}  // namespace tunica::pipeline
