#include "tunica/pipeline/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tunica/base/error.hpp"
#include "tunica/case/face_patterns.hpp"
#include "tunica/files/csv_file.hpp"
#include "tunica/files/outputs.hpp"

namespace tunica::pipeline {

namespace {

using nlohmann::json;

void collect(const json& value, const std::string& path, std::map<std::string, double>& figures) {
  const std::string below = path.empty() ? "" : path + "/";
  if (value.is_number()) figures[path] = value.get<double>();
  if (value.is_object())
    for (const auto& [key, entry] : value.items()) collect(entry, below + key, figures);
  if (value.is_array())
    for (std::size_t k = 0; k < value.size(); ++k)
      collect(value[k],
              below + (value[k].is_object() ? value[k].value("name", std::to_string(k + 1)) : std::to_string(k + 1)),
              figures);
}

}  // namespace

const std::vector<std::string>& default_quantities() {
  static const std::vector<std::string> patterns = {"openings/*/pressure/*",
                                                    "openings/*/flow_outwards/mean_ml_s",
                                                    "tears/*/volume_*",
                                                    "tears/*/flow_into_false_lumen/*",
                                                    "stations/*/true_minus_false_pressure/*",
                                                    "false_lumen/ejection_fraction",
                                                    "false_lumen/volume/*",
                                                    "wall_shear/tawss_Pa/*",
                                                    "stress/*/at_peak/*",
                                                    "flap/*displacement*"};
  return patterns;
}

bool fits_any(const std::vector<std::string>& patterns, const std::string& path) {
  return std::any_of(patterns.begin(), patterns.end(),
                     [&](const auto& pattern) { return case_file::matches(pattern, path); });
}

json read_json(const std::filesystem::path& file) {
  files::refuse_other_than_file(file);
  std::ifstream stream(file);
  json read = json::parse(stream, nullptr, false);
  if (read.is_discarded()) throw SolverError(fmt::format("{} does not read; do its stage anew", file.string()));
  return read;
}

std::string figure_text(double value) { return std::isfinite(value) ? fmt::format("{:.4g}", value) : "–"; }

nlohmann::ordered_json finite_or_null(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
}

std::string csv_cell(std::string text) {
  const bool plain = text.find_first_of(",;\"\r\n\t") == std::string::npos;
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
  return plain ? text : files::quoted(std::move(text));
}

std::map<std::string, double> figures_in(const json& post) {
  std::map<std::string, double> figures;
  collect(post, "", figures);
  return figures;
}

std::map<std::string, double> read_figures(const std::filesystem::path& post_json) {
  return figures_in(read_json(post_json));
}

}  // namespace tunica::pipeline
