#include "tunica/pipeline/what_if_plan.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tunica/base/error.hpp"
#include "tunica/case/case.hpp"
#include "tunica/case/fibres_case.hpp"
#include "tunica/case/study_case.hpp"
#include "tunica/pipeline/plan.hpp"
#include "tunica/pipeline/point.hpp"
#include "tunica/pipeline/stage_documents.hpp"

namespace tunica::pipeline {

namespace {

namespace fs = std::filesystem;
using case_file::WhatIf;
using config::Document;

// --- loads ----------------------------------------------------------------------------------------------------------

/// "0.8 s" by a factor; a unit alone counts as one of it.
std::string scaled(const std::string& text, double factor) {
  const auto [number, unit] = case_file::number_and_unit(text).value_or(std::pair{1.0, text});
  return fmt::format("{:.10g}{}{}", number * factor, unit.empty() ? "" : " ", unit);
}

void scale_key(Document& document, const std::string& key, double factor) {
  if (document.has(key)) document.set(key, scaled(document.text(key), factor));
}

/// The flow at a face with other height and time.
void scale_flow(Document& document, const std::string& flow, double height, double time) {
  if (!document.text(flow).empty()) {  // a number alone
    if (time != 1) throw InputError(flow, "is constant and has no beat", "give the flow as a `table` over the beat");
    return document.set(flow, scaled(document.text(flow), height));
  }
  if (time != 1 && !document.has(flow + ".table"))
    throw InputError(flow, "is no table over the beat", "give the flow as a `table`");
  if (height != 1)
    document.set(flow + ".scale", fmt::format("{:.10g}", height * (document.has(flow + ".scale")
                                                                       ? std::stod(document.text(flow + ".scale"))
                                                                       : 1.0)));
  if (time == 1) return;
  scale_key(document, flow + ".table.time_unit", time);
  scale_key(document, flow + ".table.period", time);
  scale_key(document, flow + ".ramp_time", time);
}

void change_flow(Document& document, const WhatIf& variant, const std::vector<std::string>& faces) {
  const double rate = variant.heart_rate.value_or(1), stroke = variant.stroke_volume.value_or(1);
  if (rate == 1 && stroke == 1) return;
  if (faces.empty()) throw InputError("boundary", "no face has a `flow` whose beat could change", "give the inflow");
  for (const auto& face : faces) scale_flow(document, fmt::format("boundary.{}.flow", face), rate * stroke, 1 / rate);
  if (rate == 1) return;
  for (const char* key : {"time.step", "time.cycles.period", "post.period", "post.from", "post.until"})
    scale_key(document, key, 1 / rate);
}

void change_pressure(Document& document, const WhatIf& variant) {
  if (!variant.pressure) return;
  if (!document.has("outlets.systolic"))
    throw InputError("outlets", "the case has no section that says which pressures its outlets are tuned for",
                     "add `outlets`, or change the outlets themselves by `set`");
  scale_key(document, "outlets.systolic", *variant.pressure);
  scale_key(document, "outlets.diastolic", *variant.pressure);
  for (const char* found : {"outlets.file", "outlets.continued"}) document.remove(found);
}

/// All that does not touch the mesh. `faces`: with a flow.
void change(Document& document, const WhatIfPlan& plan, std::size_t k, const std::vector<std::string>& faces) {
  const auto& [name, variant] = plan.settings.variants[k];
  change_pressure(document, variant);
  change_flow(document, variant, faces);
  if (variant.sleeve && document.has("wall")) {
    const std::string from = fmt::format("variants.{}.sleeve.", name),
                      to = fmt::format("wall.regions.{}", case_file::sleeve_region);
    Document sleeve = plan.document.part(from.substr(0, from.size() - 1));
    for (const char* key : {"from", "to", "regions"}) sleeve.remove(key);
    document.set(to, sleeve);
  }
  for (const auto& setting : variant.set) {
    const auto equals = setting.find('=');
    const std::string key = setting.substr(0, equals);
    for (const char* stage : {"mesh", "meshes", "fibres"})
      if (key == stage || key.starts_with(std::string(stage) + "."))
        throw InputError("set", fmt::format("{} would need another mesh or other directions", key),
                         "vary such keys by `tunica study`");
    document.set(key, Document(setting.substr(equals + 1), "the value of " + key));
  }
  document.remove("compare");
  add_to_title(document, name);
}

std::vector<std::string> faces_with_flow(const case_file::Case& c) {
  std::vector<std::string> faces;
  for (const auto& [face, condition] : c.boundary)
    if (std::holds_alternative<bc::Flow>(condition)) faces.push_back(face);
  return faces;
}

/// The case on the mesh that the variant has made, its directions told from that of the case.
Document on_changed_mesh(const Chain& chain, const fs::path& folder, const std::string& end) {
  Document document = case_with_common_outlets(chain, folder);
  const fs::path file = folder / "mesh/meshes.yaml";
  Document meshes = Document(config::read_text(file), file.string()).part("meshes");
  static const auto description = case_file::MeshSettings::schema().description();
  config::move_paths(meshes, *description, file.parent_path(), folder);
  if (!chain.settings.solves_wall())
    for (const char* part : {"wall", "interface"}) meshes.remove(part);
  document.remove("mesh");
  document.set("meshes", meshes);
  document.set("post.end", end);
  if (chain.settings.fibres && chain.settings.mesh) {
    const Document fibres = fibres_document(chain, folder);  // knows inlet, outside and tears of the mesh that was made
    for (const char* key : {"inlet", "outer", "tears"})
      if (fibres.has(key)) document.set(fmt::format("fibres.{}", key), fibres.part(key));
  }
  return document;
}

}  // namespace

WhatIfPlan plan_what_if(const fs::path& file, const std::optional<fs::path>& output) {
  WhatIfPlan plan{
      case_file::read_what_if_case(file).value, Document(config::read_text(file), file.string()), file, {}, {}};
  plan.case_file = absolute_path(plan.settings.case_file);
  plan.output = absolute_path(output.value_or(plan.settings.output));
  std::vector<Problem> warnings, problems;
  const Chain chain = read_chain(plan.case_file, std::nullopt, warnings);
  if (!chain.settings.post)
    problems.push_back(
        {plan.case_file.string(), "has no section `post`, whose figures stand side by side", "add `post: {}`"});
  const fs::path results = absolute_path(chain.settings.output.directory).lexically_normal(),
                 here = plan.output.lexically_normal();
  if (here == results || !fs::relative(here, results).string().starts_with(".."))
    problems.push_back({"output", fmt::format("{} is where the case has its own results", plan.output.string()),
                        "name a folder beside it"});
  for (std::size_t k = 0; k < plan.settings.variants.size(); ++k) {
    const auto& [name, variant] = plan.settings.variants[k];
    try {
      Document document = chain.document;
      change(document, plan, k, faces_with_flow(chain.settings));
      config::parse_document(case_file::Case::schema(), document,
                             {.name = plan.case_file.string(), .folder = plan.case_file.parent_path()});
      if (variant.changes_mesh() && !chain.settings.solves_fluid())
        throw InputError("analysis", "has no blood whose way could change", "choose fsi or flow");
    } catch (const InputError& error) {
      for (const auto& p : error.problems())
        problems.push_back({fmt::format("variants.{}: {}", name, p.where), p.what, p.remedy});
    }
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  return plan;
}

analysis::AnatomyChange change_of(const WhatIf& variant, const Chain& chain) {
  analysis::AnatomyChange change{.close_tears = variant.close_tears, .open_tears = {}, .sleeves = {}};
  for (const auto& tear : variant.open_tears) change.open_tears.push_back({tear.position, tear.area});
  if (const auto& s = variant.sleeve) change.sleeves.push_back({s->from, s->to, s->regions, case_file::sleeve_region});
  change.flap = chain.settings.post->flap;
  return change;
}

std::string variant_text(const WhatIfPlan& plan, std::size_t k, const Chain& chain, const std::string& end) {
  const auto& [name, variant] = plan.settings.variants[k];
  const fs::path folder = plan.folder_of(k);
  Document document = variant.changes_mesh() ? on_changed_mesh(chain, folder, end)
                      : variant.set.empty()  ? case_on_common_start(chain, folder)
                                             : case_on_common_mesh(chain, folder);
  const bool other_beat = variant.pressure || variant.heart_rate || variant.stroke_volume;
  if (other_beat && !variant.changes_mesh() && variant.set.empty()) add_leading_beat(chain, document);
  change(document, plan, k, faces_with_flow(chain.settings));
  document.set("output.directory", ".");
  return fmt::format("# {} of `tunica what-if` {}\n", name, plan.file.filename().string()) +
         config::commented_yaml(document, *description_of<case_file::Case>());
}

}  // namespace tunica::pipeline
