// What a result depends on, key by key: settings as values, files by their contents. No path takes part, so that a
// folder can be moved with all that is in it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "tunica/config/document.hpp"

namespace tunica::artifacts {

struct InputFile {
  std::string name;  ///< for messages
  std::string hash;  ///< of the contents; empty: there is no such file

  bool operator==(const InputFile& other) const { return hash == other.hash; }
};

/// The same inputs give the same result.
struct Inputs {
  std::map<std::string, std::string> settings;  ///< value by key
  /// By the key that names the file; what a file or folder brings with it: by `key > name`.
  std::map<std::string, InputFile> files;

  std::uint64_t fingerprint() const;
  bool operator==(const Inputs&) const = default;
};

/// Contents of files; each is read once.
class Fingerprints {
 public:
  /// Adds the file or the mesh folder `path` as `key`: with the files of the mesh, links followed, and all files that
  /// a file names (files/named_files.hpp). A path without a file is added as missing.
  void add(Inputs& inputs, const std::string& key, const std::filesystem::path& path);

 private:
  std::string hash_of(const std::filesystem::path& file);
  void add_file(Inputs& inputs, const std::string& key, const std::string& label, const std::string& name,
                const std::filesystem::path& file);
  std::map<std::filesystem::path, std::string> known_;
};

/// Of settings as a document settles them. `without`: patterns of keys that do not matter. Throws InputError where a
/// file cannot be read. Not collective, as all here.
Inputs inputs_of(const std::vector<config::Setting>& settings, const std::vector<std::string>& without);

/// Of a run: the text of its case file, and all files that this names but tuned outlets. What belongs to other stages,
/// titles and folders of results do not matter. Throws InputError where the text does not read.
Inputs run_inputs(const std::string& yaml, const std::filesystem::path& case_file);

/// What differs, by name.
struct Change {
  std::vector<std::string> settings;             ///< keys
  std::vector<std::string> files;                ///< "q.csv (boundary.lumen_inlet.flow.table.file)"
  std::map<std::string, std::string> then, now;  ///< all settings
};
Change difference(const Inputs& then, const Inputs& now);
/// "q.csv (boundary.lumen_inlet.flow.table.file), time.steps and 3 more"; files first.
std::string text_of(const Change& change);

nlohmann::ordered_json to_json(const Inputs& inputs);
/// Throws nlohmann::json::exception when it was not made by to_json().
Inputs inputs_from_json(const nlohmann::ordered_json& json);

}  // namespace tunica::artifacts
