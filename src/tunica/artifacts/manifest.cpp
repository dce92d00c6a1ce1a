#include "tunica/artifacts/manifest.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tunica/artifacts/checkpoint.hpp"
#include "tunica/artifacts/histories.hpp"
#include "tunica/artifacts/libraries.hpp"
#include "tunica/base/digits.hpp"
#include "tunica/base/error.hpp"
#include "tunica/config/json_text.hpp"
#include "tunica/field_io/series_index.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/files/hash.hpp"
#include "tunica/files/outputs.hpp"
#include "tunica/files/time_stamp.hpp"

namespace tunica::artifacts {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

namespace {

constexpr const char* file_name = "manifest.json";

std::uint64_t from_hex(const std::string& text) { return std::stoull(text, nullptr, 16); }

ordered_json library_versions() {
  ordered_json json;
  for (const auto& [name, version] : libraries()) json[name] = version;
  return json;
}

/// Does `name` look like <region>_<step>.hdf or <region>_mesh.hdf, or like the <region>_<step>.pvtu and
/// <region>_<step>_<rank>.vtu of earlier versions?
bool is_series_file(std::string name, const std::string& region) {
  if (const std::string ending = files::temporary_ending; name.ends_with(ending))  // of a process that was killed
    name.resize(name.size() - ending.size());
  if (name == field_io::mesh_file(region)) return true;
  if (!name.starts_with(region + "_")) return false;
  if (!name.ends_with(field_io::file_ending) && !name.ends_with(".vtu") && !name.ends_with(".pvtu")) return false;
  const auto end = name.cbegin() + static_cast<std::ptrdiff_t>(name.rfind('.'));
  return std::all_of(name.cbegin() + static_cast<std::ptrdiff_t>(region.size()) + 1, end,
                     [](unsigned char c) { return std::isdigit(c) || c == '_'; });
}

/// "Discarded" when it is no JSON, as after a loss of power.
ordered_json read_manifest(const fs::path& file) {
  files::refuse_other_than_file(file);
  std::ifstream in(file);
  return ordered_json::parse(in, nullptr, false);
}

bool has_runs(const ordered_json& manifest) {
  if (!manifest.is_object() || !manifest.contains("runs")) return false;
  return manifest["runs"].is_array() && !manifest["runs"].empty();
}

/// Does a folder hold what only a run leaves?
bool has_traces(const fs::path& folder) {
  const bool histories = fs::exists(folder / "steps.csv") && fs::exists(folder / "balance.csv");
  return histories || !list_checkpoints(folder / "checkpoints").empty();
}

/// Regions whose series are in a folder.
std::vector<std::string> series_in(const fs::path& folder) {
  std::vector<std::string> regions;
  const std::string ending = field_io::series_ending;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.ends_with(ending)) regions.push_back(name.substr(0, name.size() - ending.size()));
    if (entry.path().extension() == ".pvd") regions.push_back(entry.path().stem().string());  // earlier versions
  }
  return regions;
}

[[noreturn]] void not_ours(const fs::path& file) {
  throw InputError(file.string(), "is no manifest that tunica wrote", "choose another output directory");
}

/// A name that leads to files in the folder of the results and nowhere else: they are removed by it.
std::string region_name(const ordered_json& region) {
  const std::string name = region.at("name");
  if (name.empty() || name.find('/') != std::string::npos) throw std::invalid_argument("no name of a region");
  return name;
}

}  // namespace

Manifest::Manifest(const fs::path& folder, const ManifestHead& head, bool continued)
    : file_(folder / file_name), head_(head), earlier_runs_("[]"), started_(files::time_stamp()) {
  if (!continued || !fs::exists(file_)) return;
  const ordered_json earlier = read_manifest(file_);
  if (earlier.is_discarded()) return;  // after a loss of power: what it told of earlier runs is lost
  if (!has_runs(earlier)) not_ours(file_);
  earlier_runs_ = earlier["runs"].dump();
}

void Manifest::write(const ManifestProgress& p) {
  ordered_json regions = ordered_json::array(), runs = ordered_json::parse(earlier_runs_);
  ordered_json across = ordered_json::array();
  for (const auto& part : head_.across)
    across.push_back({{"name", part.name}, {"least", part.least}, {"median", part.median}});
  for (const auto& [name, elements] : head_.regions) regions.push_back({{"name", name}, {"elements", elements}});
  const bool running = p.status == "running";
  runs.push_back({{"started", started_},
                  {"ended", running ? "" : files::time_stamp()},
                  {"status", p.status},
                  {"message", p.message},
                  {"inputs", to_json(head_.inputs)},
                  {"ranks", head_.ranks},
                  {"first_step", head_.first_step},
                  {"last_step", p.last_step},
                  {"time_s", base::without_noise(p.time)},
                  {"newton_iterations", p.newton_iterations},
                  {"linear_iterations", p.linear_iterations},
                  {"rejected_steps", p.rejected_steps},
                  {"seconds",
                   {{"total", p.total_seconds},
                    {"set_up", p.set_up_seconds},
                    {"steps", p.timings.total},
                    {"assembly", p.timings.assembly},
                    {"preconditioner", p.timings.set_up},
                    {"linear", p.timings.linear},
                    {"mesh_motion", p.timings.mesh}}},
                  {"peak_memory_MB", p.peak_memory / 1e6}});
  if (p.dissipation) runs.back()["dissipation"] = to_json(*p.dissipation);
  const ordered_json manifest = {
      {"tunica",
       {{"version", head_.program.version}, {"commit", head_.program.commit}, {"instruction_set", instruction_set()}}},
      {"libraries", library_versions()},
      {"case",
       {{"file", head_.case_file.string()},
        {"hash", files::hex(head_.inputs.fingerprint())},
        {"text", head_.case_text}}},
      {"mesh",
       {{"hash", files::hex(head_.mesh_hash)},
        {"nodes", head_.nodes},
        {"elements", head_.elements},
        {"regions", regions},
        {"elements_across", across}}},
      {"runs", runs}};
  files::write_atomically(file_, config::json_text(manifest));
}

std::optional<EarlierResults> find_results(const fs::path& folder) {
  const fs::path file = folder / file_name;
  const bool exists = fs::exists(file);
  const ordered_json json = exists ? read_manifest(file) : ordered_json();
  if (!exists || json.is_discarded()) {
    EarlierResults results;
    results.damage = exists ? "is cut off or altered" : "is missing";
    if (!has_traces(folder)) {
      if (exists) not_ours(file);
      return std::nullopt;
    }
    results.regions = series_in(folder);
    return results;
  }
  if (!has_runs(json)) not_ours(file);
  try {
    EarlierResults results;
    results.case_hash = from_hex(json.at("case").at("hash"));
    results.case_file = json.at("case").at("file");
    results.mesh_hash = from_hex(json.at("mesh").at("hash"));
    results.status = json.at("runs").back().at("status");
    results.last_step = json.at("runs").back().at("last_step");
    for (const auto& region : json.at("mesh").at("regions")) results.regions.push_back(region_name(region));
    for (const auto& run : json.at("runs"))
      if (run.contains("inputs")) results.inputs.push_back(inputs_from_json(run.at("inputs")));
    return results;
  } catch (const std::exception&) {
    not_ours(file);
  }
}

void record_end(const fs::path& folder, const std::string& status, const std::string& message) {
  const fs::path file = folder / file_name;
  ordered_json json = read_manifest(file);
  if (!has_runs(json)) return;
  ordered_json& run = json["runs"].back();
  if (!run.is_object() || run.value("status", "") != "running") return;
  run["status"] = status;
  run["message"] = message;
  run["ended"] = files::time_stamp();
  files::write_atomically(file, json.dump(2) + "\n");
}

std::string changed_since(const fs::path& checkpoint, std::uint64_t then, const Inputs& now) {
  const std::string unknown = "the case or a file that it names";
  const auto results = find_results(checkpoint.parent_path().parent_path());
  if (!results) return unknown;
  const auto known = std::find_if(results->inputs.begin(), results->inputs.end(),
                                  [&](const Inputs& inputs) { return inputs.fingerprint() == then; });
  return known == results->inputs.end() ? unknown : text_of(difference(*known, now));
}

void remove_results(const fs::path& folder, const EarlierResults& results) {
  std::vector<fs::path> files = list_checkpoints(folder / "checkpoints");
  for (const auto& name : Histories::files()) files.push_back(folder / name);
  for (const auto& region : results.regions) {
    files.push_back(field_io::series_file(folder, region));
    files.push_back(folder / (region + ".pvd"));
    for (const auto& entry : fs::directory_iterator(folder))
      if (is_series_file(entry.path().filename().string(), region)) files.push_back(entry.path());
  }
  files.push_back(folder / field_io::overview_file);
  files.push_back(folder / "run.log");
  files.push_back(folder / file_name);  // last: as long as it is there, the folder is known to hold results
  for (const auto& file : files) fs::remove(file);
}

double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

}  // namespace tunica::artifacts
