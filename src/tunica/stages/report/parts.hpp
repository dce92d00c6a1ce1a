// The parts of the page, each as HTML.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tunica/files/phases.hpp"
#include "tunica/stages/report/report.hpp"
#include "tunica/viewer/beat.hpp"

namespace tunica::stages::report {

using nlohmann::json;

/// What the stages left, as far as it is there; null where it is not.
struct Results {
  const ReportCase& report;
  json mesh, fibres, prestress, tuning, manifest, post;
  std::map<std::string, json> records;  ///< stage.json by the name of the stage
  json bands;  ///< by path in post.json, of `tunica converge`; null: none, false: of other figures than these

  std::filesystem::path folder(const std::string& stage) const;  ///< empty when the case has no such stage
};
/// Throws InputError for a file that does not read.
Results read_results(const ReportCase& report);

/// What lies at a path such as "cycle/systolic_mmHg" below an object; null where there is none.
json at(const json& object, const std::string& path);
/// A number with so many significant digits; "–" for null.
std::string figure(const json& value, int digits = 4);
/// " ± 0.2" for a figure of post.json whose error band is known, lists by name; else empty.
std::string band(const Results& r, const std::string& path);
/// Stands after a figure of post.json that lies where the scheme disturbs the flow; `of`: the object that holds it.
std::string mark(const json& of);
/// What the scheme takes from the flow, {limit, from_s, until_s, parts} of artifacts/dissipation.hpp, as a table, with
/// a warning and the meaning of the mark where it is too much.
std::string dissipation_table(const json& dissipation);

/// "lumen_left_renal" -> "left renal", as HTML.
std::string readable(std::string name);
/// A line that says what the page lacks, and why.
std::string missing(const std::string& what, const std::string& why);
/// Drawings (.svg) of a folder with a line below each; nothing for those that are not there.
std::string drawings(const std::filesystem::path& folder,
                     const std::vector<std::pair<std::string, std::string>>& captions_by_file);

/// The four tears with the largest area, in their order: small ones are told together and not drawn.
std::vector<json> largest_tears(const json& tears);

/// Figures beside targets and published values; is the beat periodic, what is not resolved. The first of `plots` are
/// the pressures of the openings.
std::string answer_part(const Results& r, const std::vector<viewer::Plot>& plots);
/// Pressures that were asked for at the inlet as dotted lines in the first plot, that of the pressures of the openings.
void add_targets(const Results& r, std::vector<viewer::Plot>& plots);
std::string summary_part(const Results& r, const artifacts::ProgramVersion& program);
std::string mesh_part(const Results& r);
std::string fibres_part(const Results& r);
std::string prestress_part(const Results& r);
std::string outlets_part(const Results& r);
std::string run_part(const Results& r);
/// Tables of the cycle, and the plots where they belong; a page has each of `plots` once.
std::string cycle_part(const Results& r, const std::vector<viewer::Plot>& plots);
std::string pictures_part(const Results& r, const files::Say& say);

}  // namespace tunica::stages::report
