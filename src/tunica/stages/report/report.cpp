#include "tunica/stages/report/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "tunica/artifacts/dissipation.hpp"
#include "tunica/base/error.hpp"
#include "tunica/drawing/page.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/files/hash.hpp"
#include "tunica/files/lock.hpp"
#include "tunica/files/outputs.hpp"
#include "tunica/stages/beat.hpp"
#include "tunica/stages/report/measured_part.hpp"
#include "tunica/stages/report/parts.hpp"
#include "tunica/viewer/view_page.hpp"

namespace tunica::stages {

namespace fs = std::filesystem;
using config::Schema;

namespace {

Schema<fs::path> folder_schema() {
  return Schema<fs::path>("folder", "Folder of a stage.")
      .path(
          "folder", [](fs::path& p) -> fs::path& { return p; }, "Folder")
      .shorthand("folder");
}

std::string case_part(const ReportCase& report) {
  return "<h2 id=\"case\">Case file</h2>\n<details class=\"fine\"><summary>" +
         drawing::page::escaped(report.case_file.filename().string()) + "</summary><pre>" +
         drawing::page::escaped(config::read_text(report.case_file)) + "</pre></details>\n";
}

constexpr const char* contents =
    "<nav aria-label=\"Parts of the page\"><a href=\"#answer\">found</a>{}"
    "<a href=\"#mesh\">geometry</a><a href=\"#cycle\">the beat</a><a href=\"#pictures\">pictures</a>"
    "<a href=\"#method\">method</a><a href=\"#run\">numerics</a><a href=\"#case\">case file</a></nav>\n";

/// The beat in 3D; a case whose fields cannot be shown says why.
struct View {
  std::string text, accuracy;
  std::optional<viewer::PackedBeat> beat;
};

View view_of(const stages::report::Results& r, const BeatSource& source, const files::Say& say) {
  if (!r.report.settings.view) return {};
  View view{"<h2 id=\"view3d\">The beat in 3D</h2>\n", "", {}};
  const auto without = [&](const std::string& why) {
    view.text += stages::report::missing("The view", why);
    return view;
  };
  if (r.manifest.is_null()) return without("there are no fields of a run");
  if (!fs::exists(source.case_file)) return without("case.yaml is not in the folder of the run");
  try {
    auto beat = collect_beat(source, say);
    for (const auto& remark : beat.remarks) view.accuracy += stages::report::missing("The view", remark);
    say("view: modes and page");
    view.beat = viewer::pack(std::move(beat), {});
    view.text += viewer::view();
    view.accuracy += viewer::accuracy(*view.beat);
  } catch (const InputError& error) {
    say(fmt::format("warning: no view in the report: {}", error.what()));
    return without(error.what());
  }
  return view;
}

}  // namespace

Schema<ReportCase> ReportCase::schema() {
  return Schema<ReportCase>("tunica report", "File of `tunica report`, in YAML like a case file.")
      .text("title", &ReportCase::title, "Heading of the page")
      .by_default()
      .file("case", &ReportCase::case_file, "The case file, which stands at the end of the page")
      .map("stages", &ReportCase::stages, folder_schema(),
           "Folders of the stages mesh, fibres, prestress, outlets, run, post; those that are left out are missing")
      .include(&ReportCase::settings, case_file::ReportSettings::schema())
      .unit("length_unit", &ReportCase::metres_per_unit, config::dimension::length,
            "Unit of the coordinates in the fields of the run")
      .by_default()
      .path("output", &ReportCase::output, "Folder of the page, relative to that of this file")
      .by_default("report")
      .path("convergence", &ReportCase::convergence, "converge.json of the case: error bands of its figures");
}

config::Parsed<ReportCase> read_report_case(const fs::path& file) {
  return config::parse_file(ReportCase::schema(), file);
}

fs::path report_to_file(const ReportCase& report, const artifacts::ProgramVersion& program, bool overwrite,
                        const files::Say& say) {
  const fs::path file = report.output / "report.html";
  if (!overwrite && fs::exists(file))
    throw InputError(file.string(), "is there already", "give --overwrite, or another `output`");
  const files::FolderLock lock(report.output);
  if (!lock.taken_over().empty()) say("warning: " + lock.taken_over());
  files::try_outputs(report.output, {"report.html"});
  namespace part = stages::report;
  const auto r = part::read_results(report);
  const BeatSource source{r.folder("run") / "case.yaml", r.folder("run"), r.post};
  auto plots = collect_plots(source, r.folder("post"));
  part::add_targets(r, plots);
  const View view = view_of(r, source, say);
  std::string text = viewer::begin_page(report.title.empty() ? "Report" : report.title) +
                     fmt::format(contents, view.text.empty() ? "" : "<a href=\"#view3d\">3D</a>");
  text +=
      part::answer_part(r, plots) + view.text + "<div class=\"columns\">\n" + part::mesh_part(r) + part::fibres_part(r);
  text += part::cycle_part(r, plots) + part::measured_part(r) + part::pictures_part(r, say);
  text += "<h2 id=\"method\">Method</h2>\n" + part::prestress_part(r) + part::outlets_part(r);
  text += part::run_part(r) + part::summary_part(r, program);
  if (view.beat) text += "<h3>How exact the view in 3D is</h3>\n" + view.accuracy;
  text += case_part(report) + "</div>\n" + viewer::end_page(plots, view.beat ? &*view.beat : nullptr);
  files::write_atomically(file, text);
  return file;
}

namespace report {

namespace {

/// Bands by the path of the figure, where they belong to the figures of the cycle as they are now.
json read_bands(const json& convergence, const fs::path& post) {
  if (convergence.is_null() || post.empty()) return nullptr;
  const std::string text = config::read_text(post / "post.json");
  files::Hash hash;
  hash.add(text.data(), text.size());
  if (convergence.value("post_hash", "") != files::hex(hash.value())) return false;
  return convergence.value("figures", json());
}

json read_json(const fs::path& file) {
  files::refuse_other_than_file(file);
  std::ifstream stream(file);
  if (file.empty() || !stream) return nullptr;
  json read = json::parse(stream, nullptr, false);
  if (read.is_discarded()) throw InputError(file.string(), "is no JSON", "do the stage anew that has written it");
  return read;
}

}  // namespace

fs::path Results::folder(const std::string& stage) const {
  const auto at = report.stages.find(stage);
  return at == report.stages.end() ? fs::path() : at->second;
}

Results read_results(const ReportCase& report) {
  Results r{.report = report,
            .mesh = {},
            .fibres = {},
            .prestress = {},
            .tuning = {},
            .manifest = {},
            .post = {},
            .records = {},
            .bands = {}};
  const auto read = [&](const char* stage, const char* file) {
    const fs::path folder = r.folder(stage);
    return folder.empty() ? json() : read_json(folder / file);
  };
  r.mesh = read("mesh", "report.json");
  r.fibres = read("fibres", "report.json");
  r.prestress = read("prestress", "prestress.json");
  r.tuning = read("outlets", "tuning.json");
  r.manifest = read("run", "manifest.json");
  r.post = read("post", "post.json");
  if (report.convergence && !r.post.is_null()) r.bands = read_bands(read_json(*report.convergence), r.folder("post"));
  for (const auto& [stage, folder] : report.stages)
    if (auto record = read_json(folder / "stage.json"); !record.is_null()) r.records[stage] = std::move(record);
  return r;
}

json at(const json& object, const std::string& path) {
  const json::json_pointer pointer("/" + path);
  return object.is_object() && object.contains(pointer) ? object.at(pointer) : json();
}

std::string figure(const json& value, int digits) {
  if (value.is_string()) return drawing::page::escaped(value.get<std::string>());
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_number_integer()) return value.dump();
  if (!value.is_number() || !std::isfinite(value.get<double>())) return "–";
  return fmt::format("{:.{}g}", value.get<double>(), digits);
}

std::string band(const Results& r, const std::string& path) {
  if (!r.bands.is_object() || !r.bands.contains(path) || !r.bands[path].value("band", json()).is_number()) return "";
  return fmt::format(" ± {:.2g}", r.bands[path]["band"].get<double>());
}

std::string mark(const json& of) { return of.is_object() && of.contains("numerically_dissipated_in") ? " †" : ""; }

std::string dissipation_table(const json& dissipation) {
  const auto d = artifacts::dissipation_from_json(dissipation);
  std::vector<std::vector<std::string>> rows;
  for (const auto& p : d.parts)
    rows.push_back({drawing::page::escaped(p.part) + (p.above_limit() ? " †" : ""), fmt::format("{:.4g}", p.viscous),
                    fmt::format("{:.4g}", p.numerical), fmt::format("{:.3g}", p.ratio())});
  std::string text = drawing::page::table({fmt::format("dissipation from {:.6g} s to {:.6g} s", d.from, d.until),
                                           "by viscosity [J]", "by the scheme [J]", "ratio"},
                                          rows);
  if (const auto warning = warning_of(d))
    text += missing("Warning", *warning + ". Figures that lie there bear the mark †");
  return text;
}

std::string readable(std::string name) {
  if (name.starts_with("lumen_")) name = name.substr(6);
  std::replace(name.begin(), name.end(), '_', ' ');
  return drawing::page::escaped(name);
}

std::string missing(const std::string& what, const std::string& why) {
  return fmt::format("<p class=\"missing\">{}: {}.</p>\n", drawing::page::prose(what), drawing::page::prose(why));
}

std::string drawings(const fs::path& folder, const std::vector<std::pair<std::string, std::string>>& captions_by_file) {
  std::string text;
  for (const auto& [file, caption] : captions_by_file) {
    std::ifstream stream(folder / file, std::ios::binary);
    if (!stream) continue;
    const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(stream), {}};
    text += drawing::page::picture(drawing::page::data_url(bytes, "svg+xml"), caption);
  }
  return text;
}

}  // namespace report

}  // namespace tunica::stages
