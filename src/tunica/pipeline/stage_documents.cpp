#include "tunica/pipeline/stage_documents.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tunica/case/fibres_case.hpp"

namespace tunica::pipeline {

namespace {

namespace fs = std::filesystem;
using config::Document;

std::string path_to(const fs::path& file, const fs::path& folder) {
  return absolute_path(file).lexically_relative(absolute_path(folder)).string();
}

/// The whole case with paths that count from a stage's folder.
Document case_for(const Chain& chain, const fs::path& folder) {
  Document document = chain.document;
  config::move_paths(document, *description_of<case_file::Case>(), chain.file.parent_path(), folder);
  return document;
}

/// What a stage left in its folder for the section `meshes`, or the section of the case.
Document meshes_for(const Chain& chain, const fs::path& folder, bool with_fibres) {
  const bool fibres = with_fibres && chain.settings.fibres;
  if (!fibres && !chain.settings.mesh) return case_for(chain, folder).part("meshes");
  const fs::path from = folder_of(chain, stage(fibres ? "fibres" : "mesh"));
  const fs::path file = from / "meshes.yaml";
  Document meshes = Document(config::read_text(file), file.string()).part("meshes");
  config::move_paths(meshes, *description_of<case_file::MeshSettings>(), from, folder);
  if (!chain.settings.solves_wall())
    for (const char* part : {"wall", "interface"}) meshes.remove(part);
  return meshes;
}

/// What the faces of a mesh of the stage `mesh` are.
void name_ends(const Chain& chain, const Document& meshes, Document& fibres) {
  std::ifstream stream(folder_of(chain, stage("mesh")) / "report.json");
  const std::string first = nlohmann::json::parse(stream).at("faces").at(0).at("name");  // of the lumen, at the inlet
  const std::string inlet = first.substr(first.find('_'));
  if (!fibres.has("inlet")) fibres.set("inlet", Document(fmt::format("[wall{0}, lumen{0}]", inlet)));
  if (!fibres.has("outer")) fibres.set("outer", "wall_outer");
  if (!fibres.has("tears") && meshes.has("wall.regions.true_lumen_wall") && meshes.has("wall.regions.false_lumen_wall"))
    fibres.set("tears", Document("{true_lumen: true_lumen_wall, false_lumen: false_lumen_wall}"));
}

/// A case on the mesh that was made, without the sections of stages.
Document computed_case(const Chain& chain, const fs::path& folder) {
  Document document = case_for(chain, folder);
  for (const char* section : {"mesh", "fibres", "prestress", "post", "measured", "report", "compare"})
    document.remove(section);
  document.set("meshes", meshes_for(chain, folder, true));
  return document;
}

/// The case on the mesh that was made, with its other stages.
Document case_on_mesh(const Chain& chain, const fs::path& folder) {
  Document document = case_for(chain, folder);
  for (const char* key : {"mesh", "fibres", "compare", "prestress.output", "post.output"}) document.remove(key);
  document.set("meshes", meshes_for(chain, folder, true));
  return document;
}

/// The prestress and the state that the case starts from, where the stage `prestress` has found them.
void set_start(const Chain& chain, const fs::path& folder, Document& document) {
  if (!chain.settings.finds_prestress()) return;
  const fs::path found = folder_of(chain, stage("prestress"));
  document.set("wall.prestress", path_to(found / "wall.vtu", folder));
  document.set("start", path_to(found / "start.checkpoint", folder));
}

/// The period of the inflow of a case whose run starts from the end of the beat that its outlets were tuned by [s];
/// none where it cannot: the outlets are given, or a ramp starts the flow from rest.
std::optional<double> tuned_beat(const Chain& chain) {
  const auto& c = chain.settings;
  if (!stage("outlets").wanted(c) || c.start) return std::nullopt;
  std::optional<double> period;
  for (const auto& [face, condition] : c.boundary)
    if (const auto* flow = std::get_if<bc::Flow>(&condition)) {
      if (flow->course.ramp_time > 0) return std::nullopt;
      if (!period) period = bc::inflow(*flow).period();
    }
  return period;
}

/// The outlets, where the stage `outlets` has found them.
void set_outlets_file(const Chain& chain, const fs::path& folder, Document& document) {
  const Stage& outlets = stage("outlets");
  if (outlets.wanted(chain.settings))
    document.set("outlets.file", path_to(folder_of(chain, outlets) / outlets.result, folder));
}

/// As set_start() and set_outlets_file(); the run goes on from the end of the last beat of the tuning where it can.
void set_start_and_outlets(const Chain& chain, const fs::path& folder, Document& document) {
  set_start(chain, folder, document);
  set_outlets_file(chain, folder, document);
  if (!tuned_beat(chain)) return;
  document.set("start", path_to(folder_of(chain, stage("outlets")) / "start.checkpoint", folder));
  document.set("outlets.continued", "true");
}

}  // namespace

Document mesh_document(const Chain& chain, const fs::path& folder) {
  Document mesh = case_for(chain, folder).part("mesh");
  if (!mesh.has("title") && !chain.settings.title.empty()) mesh.set("title", chain.settings.title);
  mesh.set("output", ".");
  return mesh;
}

Document fibres_document(const Chain& chain, const fs::path& folder) {
  Document fibres = case_for(chain, folder).part("fibres");
  const Document meshes = meshes_for(chain, folder, false);
  if (chain.settings.mesh) name_ends(chain, meshes, fibres);
  if (!chain.settings.title.empty()) fibres.set("title", chain.settings.title);
  fibres.set("meshes", meshes);
  fibres.set("output", ".");
  return fibres;
}

Document prestress_document(const Chain& chain, const fs::path& folder) {
  Document document = computed_case(chain, folder);
  document.set("prestress", case_for(chain, folder).part("prestress"));
  document.set("prestress.output", ".");
  document.set("output.directory", ".");
  return document;
}

Document outlets_document(const Chain& chain, const fs::path& folder) {
  Document document = computed_case(chain, folder);
  set_start(chain, folder, document);
  document.set("outlets.output", ".");
  document.set("output.directory", ".");
  return document;
}

Document run_document(const Chain& chain, const fs::path& folder) {
  Document document = computed_case(chain, folder);
  set_start_and_outlets(chain, folder, document);
  document.set("output.directory", ".");
  return document;
}

Document post_document(const Chain& chain, const fs::path& folder) {
  Document document = run_document(chain, folder);
  Document figures = case_for(chain, folder).part("post");
  const bool has_window = figures.has("period") || figures.has("from") || figures.has("until");
  if (!has_window && document.has("time.cycles.period")) figures.set("period", document.text("time.cycles.period"));
  document.set("post", figures);
  document.set("post.output", ".");
  if (chain.document.has("measured")) document.set("measured", case_for(chain, folder).part("measured"));
  document.set("output.directory", path_to(folder_of(chain, stage("run")), folder));
  return document;
}

Document report_document(const Chain& chain, const fs::path& folder) {
  Document document;
  if (!chain.settings.title.empty()) document.set("title", chain.settings.title);
  document.set("case", path_to(chain.file, folder));
  for (const auto& s : stages())
    if (s.wanted(chain.settings) && s.name != std::string("report"))
      document.set(fmt::format("stages.{}", s.name), path_to(folder_of(chain, s), folder));
  const auto wanted = chain.settings.report.value_or(case_file::ReportSettings{});
  document.set("pictures", wanted.pictures ? "true" : "false");
  document.set("view", wanted.view ? "true" : "false");
  document.set("length_unit", chain.settings.output.units.length);
  if (const fs::path bands = chain.output / "converge/converge.json"; fs::exists(bands))
    document.set("convergence", path_to(bands, folder));
  document.set("output", ".");
  return document;
}

void add_leading_beat(const Chain& chain, Document& document) {
  const auto beat = tuned_beat(chain);
  const auto& c = chain.settings;
  if (!beat || !c.time || c.time->cycles) return;
  const auto fields = std::llround(std::ceil(*beat / (c.time->step * c.output.every) * (1 - 1e-9)));
  document.set("time.steps", std::to_string(c.time->steps + fields * c.output.every));
  if (!c.post) return;
  const auto set = [&](const char* key, double time) { document.set(key, fmt::format("{:.17g} s", time + *beat)); };
  if (c.post->from || !c.post->period) set("post.from", c.post->from.value_or(0));
  if (c.post->until) set("post.until", *c.post->until);
}

Document case_on_common_mesh(const Chain& chain, const fs::path& folder) {
  Document document = case_on_mesh(chain, folder);
  set_outlets_file(chain, folder, document);
  add_leading_beat(chain, document);
  return document;
}

Document case_with_common_outlets(const Chain& chain, const fs::path& folder) {
  Document document = case_for(chain, folder);
  for (const auto& s : stages()) document.remove(s.output);
  document.remove("compare");
  set_outlets_file(chain, folder, document);
  add_leading_beat(chain, document);
  return document;
}

Document case_on_common_start(const Chain& chain, const fs::path& folder) {
  Document document = case_on_mesh(chain, folder);
  set_start_and_outlets(chain, folder, document);
  if (document.has("wall.prestress")) document.remove("prestress");
  return document;
}

}  // namespace tunica::pipeline
