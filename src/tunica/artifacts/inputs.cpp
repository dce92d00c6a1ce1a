#include "tunica/artifacts/inputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tunica/base/error.hpp"
#include "tunica/case/case.hpp"
#include "tunica/case/face_patterns.hpp"
#include "tunica/files/hash.hpp"
#include "tunica/files/named_files.hpp"
#include "tunica/mesh_io/simvascular.hpp"

namespace tunica::artifacts {

namespace {

namespace fs = std::filesystem;
using config::Kind;
using nlohmann::ordered_json;

void add(files::Hash& hash, const std::string& text) {
  hash.add(text.data(), text.size());
  const std::size_t length = text.size();
  hash.add(&length, sizeof length);
}

bool is_path(Kind kind) { return kind == Kind::file || kind == Kind::folder || kind == Kind::path; }

/// "q.csv (boundary.lumen_inlet.flow.table.file)" of a key and of what it brings with it.
std::string label_of(const std::string& key, const InputFile& file) {
  return fmt::format("{} ({})", file.name, key.substr(0, key.find(" > ")));
}

template <class Map, class Name>
std::vector<std::string> changed(const Map& then, const Map& now, const Name& name) {
  std::vector<std::string> names;
  for (const auto& [key, value] : then)
    if (const auto at = now.find(key); at == now.end() || !(at->second == value)) names.push_back(name(key, value));
  for (const auto& [key, value] : now)
    if (!then.contains(key)) names.push_back(name(key, value));
  return names;
}

}  // namespace

std::uint64_t Inputs::fingerprint() const {
  files::Hash hash;
  for (const auto& [key, value] : settings) add(hash, key), add(hash, value);
  for (const auto& [key, file] : files) add(hash, key), add(hash, file.hash);
  return hash.value();
}

std::string Fingerprints::hash_of(const fs::path& file) {
  std::error_code none;
  const fs::path canonical = fs::canonical(file, none);
  if (none) return {};
  if (const auto known = known_.find(canonical); known != known_.end()) return known->second;
  files::Hash hash;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw InputError(file.string(), "cannot be read", "check its permissions");
  std::vector<char> block(1 << 20);
  std::size_t size = 0;
  while (stream) {
    stream.read(block.data(), static_cast<std::streamsize>(block.size()));
    const auto count = static_cast<std::size_t>(stream.gcount());
    hash.add(block.data(), count);
    size += count;
  }
  hash.add(&size, sizeof size);
  return known_[canonical] = files::hex(hash.value());
}

void Fingerprints::add_file(Inputs& inputs, const std::string& key, const std::string& label, const std::string& name,
                            const fs::path& file) {
  std::error_code none;
  const bool there = fs::is_regular_file(file, none);
  if (const auto [at, is_new] = inputs.files.emplace(label, InputFile{name, there ? hash_of(file) : ""}); !is_new)
    return;  // one that names itself
  if (!there) return;
  for (const auto& named : files::named_files(file))
    add_file(inputs, key, fmt::format("{} > {}", key, named), named, file.parent_path() / named);
}

// All folders that keys name are meshes. What else lies there, be it the results of the case, does not matter.
void Fingerprints::add(Inputs& inputs, const std::string& key, const fs::path& path) {
  std::error_code none;
  const std::string name = (path.filename().empty() ? path.parent_path() : path).filename().string();
  if (!fs::is_directory(path, none)) return add_file(inputs, key, key, name, path);
  inputs.files.emplace(key, InputFile{name, "folder"});
  for (const auto& file : mesh_io::simvascular_files(path)) {
    const std::string inside = file.lexically_relative(path).string();
    add_file(inputs, key, fmt::format("{} > {}", key, inside), inside, file);
  }
}

Inputs inputs_of(const std::vector<config::Setting>& settings, const std::vector<std::string>& without) {
  Inputs inputs;
  Fingerprints fingerprints;
  for (const auto& s : settings) {
    if (std::any_of(without.begin(), without.end(), [&](const auto& w) { return case_file::matches(w, s.path); }))
      continue;
    if (!is_path(s.kind))
      inputs.settings[s.path] = s.value;
    else if (!s.value.empty())
      fingerprints.add(inputs, s.path, s.value);
  }
  return inputs;
}

Inputs run_inputs(const std::string& yaml, const fs::path& case_file) {
  const config::Origin origin{.name = case_file.string(), .folder = case_file.parent_path(), .check_files = false};
  std::vector<config::Setting> settings;
  config::parse_document(case_file::Case::schema(), case_file::case_document(yaml, case_file), origin, &settings);
  return inputs_of(settings, {"title", "output.directory", "output.checkpoint_every", "outlets.output", "outlets.file",
                              "prestress*", "post*", "report*", "compare*"});
}

Change difference(const Inputs& then, const Inputs& now) {
  const auto key_itself = [](const std::string& key, const std::string&) { return key; };
  return {changed(then.settings, now.settings, key_itself), changed(then.files, now.files, label_of), then.settings,
          now.settings};
}

std::string text_of(const Change& change) {
  constexpr std::size_t most = 4;
  auto names = change.files;
  names.insert(names.end(), change.settings.begin(), change.settings.end());
  std::string text;
  for (std::size_t k = 0; k < std::min(most, names.size()); ++k) text += (k == 0 ? "" : ", ") + names[k];
  return names.size() > most ? fmt::format("{} and {} more", text, names.size() - most) : text;
}

ordered_json to_json(const Inputs& inputs) {
  ordered_json files = ordered_json::object();
  for (const auto& [key, file] : inputs.files) files[key] = {{"name", file.name}, {"hash", file.hash}};
  return {{"settings", inputs.settings}, {"files", files}};
}

Inputs inputs_from_json(const ordered_json& json) {
  Inputs inputs;
  inputs.settings = json.at("settings").get<std::map<std::string, std::string>>();
  for (const auto& [key, file] : json.at("files").items())
    inputs.files[key] = {file.at("name").get<std::string>(), file.at("hash").get<std::string>()};
  return inputs;
}

}  // namespace tunica::artifacts
