#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tunica/artifacts/run_folder.hpp"
#include "tunica/base/error.hpp"
#include "tunica/case/face_patterns.hpp"
#include "tunica/case/fibres_case.hpp"
#include "tunica/meshing/assemble.hpp"
#include "tunica/parallel/agree.hpp"
#include "tunica/parallel/patience.hpp"
#include "tunica/parallel/signals.hpp"
#include "tunica/pipeline/stage_documents.hpp"
#include "tunica/stages/fibres/fibres.hpp"
#include "tunica/stages/meshing/mesh_case.hpp"
#include "tunica/stages/post/post.hpp"
#include "tunica/stages/prestress/flow_folder.hpp"
#include "tunica/stages/prestress/prestress.hpp"
#include "tunica/stages/report/report.hpp"
#include "tunica/stages/run/run.hpp"
#include "tunica/stages/tuning/tune.hpp"

namespace tunica::pipeline {

namespace {

namespace fs = std::filesystem;
using artifacts::Change;
using config::Document;
using NamedFiles = std::vector<std::pair<std::string, fs::path>>;

template <class T>
std::vector<config::Setting> settings_of(const Document& document, const config::Origin& origin) {
  std::vector<config::Setting> settings;
  config::parse_document(T::schema(), document, origin, &settings);
  return settings;
}

/// The fields and histories of a run are as they are since this file was written.
NamedFiles run_manifest(const Chain& chain) { return {{"run", folder_of(chain, stage("run")) / "manifest.json"}}; }

NamedFiles records(const Chain& chain) {
  NamedFiles files;
  for (const auto& s : stages())
    if (s.wanted(chain.settings) && s.name != std::string("report"))
      files.emplace_back(s.name, folder_of(chain, s) / "stage.json");
  return files;
}

// --- what is done ---------------------------------------------------------------------------------------------------

files::Say say_to(const StageCall& call) {
  const bool speaks = parallel::rank(call.comm) == 0 && call.screen;
  return [speaks, screen = call.screen](const std::string& line) {
    if (!speaks) return;
    std::fprintf(screen, "%s\n", line.c_str());
    std::fflush(screen);
  };
}

bool on_all(MPI_Comm comm, const std::function<bool()>& ask) {
  bool answer = parallel::on_root(comm, ask);
  parallel::broadcast(comm, answer);
  return answer;
}

int run_mesh(const StageCall& call) {
  parallel::on_root_patiently(call.comm, [&] {
    const auto say = say_to(call);
    const auto parsed = case_file::read_mesh_case(call.file);
    for (const auto& warning : parsed.warnings) say("warning: " + format(warning));
    say(fmt::format("\n{}", stages::mesh_to_files(parsed.value, true, say).text));
  });
  return 0;
}

int run_fibres(const StageCall& call) {
  const auto say = say_to(call);
  say(fmt::format("\n{}", stages::fibres::fibres_to_files({.file = call.file, .overwrite = true}, call.comm, say)));
  return 0;
}

int run_prestress(const StageCall& call) {
  stages::PrestressRequest request;
  request.case_file = call.file;
  request.program = call.program;
  request.keep_flow = on_all(call.comm, [&] { return call.resume && stages::has_flow(call.folder()); });
  request.overwrite = !request.keep_flow;
  request.verbose = call.verbose;
  const parallel::StopSignals signals;
  return stages::prestress(call.comm, request, call.screen);
}

int run_outlets(const StageCall& call) {
  stages::TuneRequest request;
  request.case_file = call.file;
  request.overwrite = !call.resume;
  request.program = call.program;
  request.run_case = stages::run_case;
  request.verbose = call.verbose;
  const parallel::StopSignals signals;
  return stages::tune(call.comm, request, call.screen);
}

int run_post(const StageCall& call) {
  stages::post::PostRequest request;
  request.case_file = call.file;
  request.overwrite = true;
  request.program = call.program;
  stages::post::post_results(call.comm, request, call.screen);
  return 0;
}

int run_case_stage(const StageCall& call) {
  stages::RunRequest request;
  request.case_file = call.file;
  request.program = call.program;
  request.verbose = call.verbose;
  const auto say = say_to(call);
  request.restart = on_all(call.comm, [&] {
    if (!call.resume) return false;
    const auto found = artifacts::find_continuation(call.folder());
    if (!found.possible)
      for (const auto& line : found.warnings) say("warning: " + line + "; the run begins anew");
    return found.possible;
  });
  request.overwrite = !request.restart;
  const parallel::StopSignals signals;
  return stages::run(call.comm, request, call.screen).signal;
}

int run_report(const StageCall& call) {
  parallel::on_root_patiently(call.comm, [&] {
    const auto say = say_to(call);
    const auto parsed = stages::read_report_case(call.file);
    const auto page = stages::report_to_file(parsed.value, call.program, true, say);
    say(fmt::format("\nreport: {}", page.string()));
  });
  return 0;
}

// --- what can be kept -----------------------------------------------------------------------------------------------

bool never(const Change&) { return false; }

/// The steady flow does not know the wall, beyond the inside of its mesh, nor how the fixed point is found.
bool same_flow(const Change& change) {
  const auto of_wall = [](const std::string& key) {
    return key.starts_with("wall.") || (key.starts_with("prestress.") && !key.starts_with("prestress.flow"));
  };
  return change.files.empty() && std::all_of(change.settings.begin(), change.settings.end(), of_wall);
}

/// What comes after the steady flow is done anew in any case.
bool flow_is_kept(const fs::path& folder, const std::vector<std::string>&) { return stages::has_flow(folder); }

/// A run that has lost checkpoints goes on from one that is left; fields and histories come from all its steps.
bool run_goes_on(const fs::path& folder, const std::vector<std::string>& lost) {
  const bool only_checkpoints =
      std::all_of(lost.begin(), lost.end(), [](const auto& name) { return name.starts_with("checkpoints/"); });
  return only_checkpoints && artifacts::find_continuation(folder).possible;
}

bool more_steps(const Change& change) {
  if (change.settings.size() != 1 || !change.files.empty()) return false;
  const std::string& key = change.settings[0];
  return (key == "time.steps" || key == "time.cycles.most") && change.then.contains(key) && change.now.contains(key) &&
         std::stoll(change.now.at(key)) > std::stoll(change.then.at(key));
}

}  // namespace

const Stage& stage(const std::string& name) {
  return *std::find_if(stages().begin(), stages().end(), [&](const Stage& s) { return s.name == name; });
}

fs::path folder_of(const Chain& chain, const Stage& stage) {
  const std::string given = chain.document.text(stage.output);
  if (*stage.output == 0 || given.empty()) return chain.output / stage.name;
  return (chain.file.parent_path() / given).lexically_normal();
}

namespace {

Stage stage_mesh() {
  return {.name = "mesh",
          .what = "mesh of lumen and wall",
          .file = "mesh.yaml",
          .by_hand = "tunica mesh mesh.yaml --overwrite",
          .output = "mesh.output",
          .result = "meshes.yaml",
          .outputs = {"lumen/*", "wall/*", "meshes.yaml", "report.json", "report.html"},
          .wanted = [](const case_file::Case& c) { return c.mesh.has_value(); },
          .document = mesh_document,
          .description = description_of<case_file::MeshCase>(),
          .settings = settings_of<case_file::MeshCase>,
          .without = {"title", "output"},
          .reads = {},
          .partial = {},
          .continues = never,
          .recovers = {},
          .run = run_mesh};
}

Stage stage_fibres() {
  return {.name = "fibres",
          .what = "material directions in the wall",
          .file = "fibres.yaml",
          .by_hand = "tunica fibres fibres.yaml --overwrite",
          .output = "fibres.output",
          .result = "meshes.yaml",
          .outputs = {"lumen/*", "wall/*", "meshes.yaml", "report.json"},
          .wanted = [](const case_file::Case& c) { return c.fibres.has_value(); },
          .document = fibres_document,
          .description = description_of<case_file::FibresCase>(),
          .settings = settings_of<case_file::FibresCase>,
          .without = {"title", "output"},
          .reads = {},
          .partial = {},
          .continues = never,
          .recovers = {},
          .run = run_fibres};
}

Stage stage_prestress() {
  return {.name = "prestress",
          .what = "prestress of the imaged wall",
          .file = "case.yaml",
          .by_hand = "tunica prestress case.yaml --overwrite",
          .output = "prestress.output",
          .result = "start.checkpoint",
          .outputs = {"start.checkpoint", "flow.checkpoint", "wall.vtu", "prestress.json", "boundary.yaml",
                      "fixed_point.*", "flow/*", "wall/*", "traction/*", "unloaded/*"},
          .wanted = [](const case_file::Case& c) { return c.finds_prestress(); },
          .document = prestress_document,
          .description = description_of<case_file::Case>(),
          .settings = settings_of<case_file::Case>,
          // The steady flow has an inflow, resistances and a time step of its own.
          .without = {"title",
                      "output.*",
                      "prestress.output",
                      "mesh_motion.*",
                      "time.step",
                      "time.steps",
                      "time.max_halvings",
                      "time.cycles*",
                      "time.adaptive*",
                      "outlets.[!f]*",
                      "outlets.file",
                      "boundary.*.flow",
                      "boundary.*.flow.value",
                      "boundary.*.flow.step.*",
                      "boundary.*.flow.table*",
                      "boundary.*.flow.scale",
                      "boundary.*.flow.ramp_time",
                      "boundary.*.flow.positive",
                      "boundary.*.rcr.capacitance",
                      "boundary.*.rcr.initial_pressure"},
          .reads = {},
          .partial = {"flow.checkpoint", "flow_checkpoints"},
          .continues = same_flow,
          .recovers = flow_is_kept,
          .run = run_prestress};
}

Stage stage_outlets() {
  return {
      .name = "outlets",
      .what = "outlets for the pressures and flows that are asked for",
      .file = "case.yaml",
      .by_hand = "tunica tune case.yaml",
      .output = "outlets.output",
      .result = "outlets.yaml",
      .outputs = {"outlets.yaml", "start.checkpoint", "tuning.*", "pressure.svg"},
      .wanted = [](const case_file::Case& c) { return c.outlets && !c.outlets->given_file; },
      .document = outlets_document,
      .description = description_of<case_file::Case>(),
      .settings = settings_of<case_file::Case>,
      .without = {"title", "output.*", "time.step", "time.steps", "time.cycles*", "time.adaptive*", "outlets.output"},
      .reads = {},
      .partial = {"tuning.json", "probe", "cycle_*"},
      .continues = never,
      .recovers = {},
      .run = run_outlets};
}

Stage stage_run() {
  return {.name = "run",
          .what = "the case itself",
          .file = "case.yaml",
          .by_hand = "tunica run case.yaml --restart",
          .output = "",
          .result = "manifest.json",
          .outputs = {"manifest.json", "*.csv", "*.hdf", "*.series", "*.xdmf", "checkpoints/*"},
          .wanted = [](const case_file::Case&) { return true; },
          .document = run_document,
          .description = description_of<case_file::Case>(),
          .settings = settings_of<case_file::Case>,
          .without = {"title", "output.directory", "output.checkpoint_every", "outlets.output", "outlets.tolerance",
                      "outlets.max_cycles", "outlets.step"},
          .reads = {},
          .partial = {"checkpoints"},
          .continues = more_steps,
          .recovers = run_goes_on,
          .run = run_case_stage};
}

Stage stage_post() {
  return {.name = "post",
          .what = "figures of the cycle",
          .file = "case.yaml",
          .by_hand = "tunica post case.yaml --overwrite",
          .output = "post.output",
          .result = "post.json",
          .outputs = {"post.json", "*.csv", "*.svg", "*.vtp", "*.vtu"},
          .wanted = [](const case_file::Case& c) { return c.post.has_value(); },
          .document = post_document,
          .description = description_of<case_file::Case>(),
          .settings = settings_of<case_file::Case>,
          // What else the results depend on is in the manifest of the run.
          .without = {"title", "output.*", "post.output", "wall.prestress", "start", "time*", "newton*", "linear*",
                      "mesh_motion*", "outlets*", "boundary*"},
          .reads = run_manifest,
          .partial = {},
          .continues = never,
          .recovers = {},
          .run = run_post};
}

Stage stage_report() {
  return {.name = "report",
          .what = "one page with what was done and found",
          .file = "report.yaml",
          .by_hand = "tunica report report.yaml --overwrite",
          .output = "",
          .result = "report.html",
          .outputs = {"report.html"},
          .wanted = [](const case_file::Case& c) { return c.report.has_value(); },
          .document = report_document,
          .description = description_of<stages::ReportCase>(),
          .settings = settings_of<stages::ReportCase>,
          .without = {"output", "stages.*"},
          .reads = records,
          .partial = {},
          .continues = never,
          .recovers = {},
          .run = run_report};
}

}  // namespace

const std::vector<Stage>& stages() {
  static const std::vector<Stage> all{stage_mesh(), stage_fibres(), stage_prestress(), stage_outlets(),
                                      stage_run(),  stage_post(),   stage_report()};
  return all;
}

}  // namespace tunica::pipeline
