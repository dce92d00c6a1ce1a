#include "tunica/pipeline/converge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tunica/analysis/grid_convergence.hpp"
#include "tunica/base/error.hpp"
#include "tunica/case/mesh_settings.hpp"
#include "tunica/config/json_text.hpp"
#include "tunica/drawing/page.hpp"
#include "tunica/drawing/plot.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/files/hash.hpp"
#include "tunica/files/lock.hpp"
#include "tunica/files/outputs.hpp"
#include "tunica/parallel/agree.hpp"
#include "tunica/pipeline/figures.hpp"
#include "tunica/pipeline/plan.hpp"
#include "tunica/pipeline/stage_documents.hpp"

namespace tunica::pipeline {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using nlohmann::ordered_json;

constexpr double formal_order = 2.0;  // in space of pressures and stresses, in time of the scheme

/// One computation of the study.
struct Level {
  std::string name;           ///< "case", "mesh_1", "step_1"
  fs::path file, results;     ///< its case file and its folder of results
  double size = 0, step = 0;  ///< edge of a tetrahedron of the mean volume over that of the case [-]; s
  std::int64_t elements = 0;
  double seconds = 0;  ///< of the stage `run`
  std::map<std::string, double> figures{};
};

struct Study {
  Chain chain;
  Level base;
  std::vector<Level> meshes, steps;
};

// --- cases of the levels --------------------------------------------------------------------------------------------

/// The mesh `factor` times as fine.
void refine_mesh(const case_file::Case& c, double factor, config::Document& document) {
  const auto mm = [](double metres) { return fmt::format("{:.6g} mm", 1e3 * metres); };
  if (c.mesh) {
    std::string size = fmt::format("edge: {}", mm(case_file::edge_length(c.mesh->size) / factor));
    if (const auto across = case_file::across(c.mesh->size))
      size = fmt::format("elements_across: {{count: {:.6g}, longest_edge: {}{}}}", factor * across->count,
                         mm(across->longest / factor),
                         across->shortest ? ", shortest_edge: " + mm(*across->shortest / factor) : "");
    document.set("mesh.size", config::Document("{" + size + "}"));
    return;
  }
  const mesh::TubeSizes& tube = *c.meshes.tube;
  const auto cells = [&](const char* key, int coarse, int multiple) {
    const int fine = multiple * static_cast<int>(std::lround(coarse * factor / multiple));
    document.set(fmt::format("meshes.tube.{}", key), std::to_string(std::max(coarse, fine)));
  };
  cells("cells_around", tube.cells_around, 4);
  cells("cells_radial", tube.cells_radial, 1);
  cells("cells_along", tube.cells_along, 1);
  if (tube.wall_thickness > 0) cells("cells_through_wall", tube.cells_through_wall, 1);
}

/// Steps `parts` times as small, with the same fields.
void refine_steps(const case_file::Case& c, int parts, config::Document& document) {
  document.set("time.step", fmt::format("{:.17g} s", c.time->step / parts));
  if (!c.time->cycles) document.set("time.steps", std::to_string(c.time->steps * parts));
  document.set("output.every", std::to_string(c.output.every * parts));
}

void write_level(const Study& study, const Level& level, config::Document document) {
  document.remove("report");
  document.set("title", fmt::format("{}{}{}", study.chain.settings.title,
                                    study.chain.settings.title.empty() ? "" : ": ", level.name));
  document.set("output.directory", ".");
  files::make_folder(level.results);
  files::write_atomically(
      level.file, fmt::format("# {} of `tunica converge` {}\n", level.name, study.chain.file.filename().string()) +
                      config::commented_yaml(document, *description_of<case_file::Case>()));
}

Level level_of(const Chain& chain, const std::string& name) {
  const fs::path folder = chain.output / "converge" / name;
  return {.name = name, .file = folder / "case.yaml", .results = folder, .step = chain.settings.time->step};
}

void check_request(const ConvergeRequest& request, const case_file::Case& c) {
  std::vector<Problem> problems;
  if (!c.post)
    problems.push_back({"post", "is missing, and figures of the cycle are what is compared", "add `post: {}`"});
  if (!c.time) problems.push_back({"analysis", "has no steps in time", "converge a case with `time`"});
  if (request.steps > 0 && c.time && c.time->adaptive)
    problems.push_back({"time.adaptive", "leaves no step to be halved", "give --steps 0, or steps of one size"});
  if (request.meshes.value_or(0) > 0 && !c.mesh && !c.meshes.tube)
    problems.push_back({"meshes", "names files, which tunica cannot refine",
                        "give --meshes 0, or let tunica make the mesh (section `mesh`)"});
  if (problems.empty() && request.meshes == 0 && request.steps == 0)
    problems.push_back({"--meshes, --steps", "are both 0, so that there is nothing to compare", "give one of them"});
  if (!problems.empty()) throw InputError(std::move(problems));
}

/// On rank 0.
Study plan_convergence(const ConvergeRequest& request) {
  std::vector<Problem> warnings;
  Study study{.chain = read_chain(request.chain.case_file, request.chain.directory, warnings),
              .base = {},
              .meshes = {},
              .steps = {}};
  const Chain& chain = study.chain;
  check_request(request, chain.settings);
  study.base = {.name = "case", .file = chain.file, .results = chain.output, .step = chain.settings.time->step};
  const bool refinable = chain.settings.mesh || chain.settings.meshes.tube;
  for (int k = 1; k <= request.meshes.value_or(refinable ? 2 : 0); ++k)
    study.meshes.push_back(level_of(chain, fmt::format("mesh_{}", k)));
  for (int k = 1; k <= request.steps; ++k) study.steps.push_back(level_of(chain, fmt::format("step_{}", k)));
  files::try_outputs(chain.output, {"converge/converge.json", "converge/converge.csv", "converge/converge.html"});
  return study;
}

/// When the case itself is done: the levels take its outlets, and smaller steps its start.
void write_levels(const ConvergeRequest& request, Study& study) {
  const auto& c = study.chain.settings;
  for (std::size_t k = 0; k < study.meshes.size(); ++k) {
    auto document = case_with_common_outlets(study.chain, study.meshes[k].results);
    refine_mesh(c, std::pow(request.ratio, static_cast<double>(k + 1)), document);
    write_level(study, study.meshes[k], std::move(document));
  }
  for (std::size_t k = 0; k < study.steps.size(); ++k) {
    auto document = case_on_common_start(study.chain, study.steps[k].results);
    const int parts = 1 << (k + 1);
    refine_steps(c, parts, document);
    study.steps[k].step = c.time->step / parts;
    write_level(study, study.steps[k], std::move(document));
  }
}

// --- figures --------------------------------------------------------------------------------------------------------

fs::path folder_of_stage(const Level& level, const Chain& chain, const char* stage) {
  if (level.name != "case") return level.results / stage;
  return folder_of(chain, pipeline::stage(stage));
}

void read_level(Level& level, const Chain& chain) {
  level.figures = read_figures(folder_of_stage(level, chain, "post") / "post.json");
  const json manifest = read_json(folder_of_stage(level, chain, "run") / "manifest.json");
  level.elements = manifest.at("mesh").at("elements");
  for (const auto& run : manifest.at("runs")) level.seconds += run.at("seconds").at("total").get<double>();
}

/// A figure over the levels.
struct Row {
  std::string path;
  double value;
  std::vector<double> meshes, steps;  ///< the case first
  analysis::ErrorBand of_mesh, of_step;

  double band() const {
    double sum = 0;
    for (const auto* e : {&of_mesh, &of_step})
      if (e->kind != analysis::ErrorBand::Kind::one_level) sum += e->band;
    return sum;
  }
};

std::vector<double> sizes_of(const Level& base, const std::vector<Level>& finer, double Level::*size) {
  std::vector<double> sizes{base.*size};
  for (const auto& level : finer) sizes.push_back(level.*size);
  return sizes;
}

/// The figure at all levels; empty when one of them lacks it.
std::vector<double> values_of(const std::string& path, const Level& base, const std::vector<Level>& finer) {
  std::vector<double> values{base.figures.at(path)};
  for (const auto& level : finer) {
    if (!level.figures.contains(path)) return {};
    values.push_back(level.figures.at(path));
  }
  return values;
}

std::vector<Row> compare(const Study& study, const std::vector<std::string>& quantities) {
  std::vector<Row> rows;
  const auto mesh_sizes = sizes_of(study.base, study.meshes, &Level::size);
  const auto step_sizes = sizes_of(study.base, study.steps, &Level::step);
  for (const auto& [path, value] : study.base.figures) {
    if (!fits_any(quantities, path)) continue;
    Row row{.path = path,
            .value = value,
            .meshes = values_of(path, study.base, study.meshes),
            .steps = values_of(path, study.base, study.steps),
            .of_mesh = {},
            .of_step = {}};
    if (row.meshes.empty() || row.steps.empty()) continue;
    row.of_mesh = analysis::error_band(mesh_sizes, row.meshes, formal_order);
    row.of_step = analysis::error_band(step_sizes, row.steps, formal_order);
    rows.push_back(std::move(row));
  }
  if (rows.empty())
    throw InputError("--quantity", "matches no figure of all levels",
                     "see the paths in post/post.json, such as openings/lumen_inlet/pressure/mean_mmHg");
  return rows;
}

// --- what is written ------------------------------------------------------------------------------------------------

ordered_json to_json(const analysis::ErrorBand& e) {
  return {{"kind", e.text()},
          {"band", finite_or_null(e.band)},
          {"order", finite_or_null(e.order)},
          {"extrapolated", finite_or_null(e.extrapolated)}};
}

ordered_json to_json(const Level& level) {
  return {{"name", level.name},
          {"elements", level.elements},
          {"relative_size", level.size},
          {"step_s", level.step},
          {"run_s", level.seconds}};
}

void write_json(const fs::path& file, const Study& study, const std::vector<Row>& rows, const std::string& post_hash) {
  ordered_json page = {{"case", study.chain.file.filename().string()}, {"post_hash", post_hash}};
  page["levels"] = {to_json(study.base)};
  for (const auto* list : {&study.meshes, &study.steps})
    for (const auto& level : *list) page["levels"].push_back(to_json(level));
  for (const auto& row : rows)
    page["figures"][row.path] = {{"value", row.value},           {"band", row.band()},
                                 {"mesh", to_json(row.of_mesh)}, {"step", to_json(row.of_step)},
                                 {"values_by_mesh", row.meshes}, {"values_by_step", row.steps}};
  files::write_atomically(file, config::json_text(page));
}

std::string share(const Row& row, double band) {
  return row.value == 0 || !std::isfinite(band) ? "–" : fmt::format("{:.1f} %", 100 * band / std::abs(row.value));
}

void write_csv(const fs::path& file, const Study& study, const std::vector<Row>& rows) {
  std::string csv = "figure,case";
  for (const auto* list : {&study.meshes, &study.steps})
    for (const auto& level : *list) csv += "," + level.name;
  csv += ",band,mesh band,mesh order,mesh,step band,step order,step\n";
  for (const auto& row : rows) {
    csv += fmt::format("{},{:.10g}", row.path, row.value);
    for (const auto* values : {&row.meshes, &row.steps})
      for (std::size_t k = 1; k < values->size(); ++k) csv += fmt::format(",{:.10g}", (*values)[k]);
    csv += fmt::format(",{:.4g},{:.4g},{:.3g},{},{:.4g},{:.3g},{}\n", row.band(), row.of_mesh.band, row.of_mesh.order,
                       row.of_mesh.text(), row.of_step.band, row.of_step.order, row.of_step.text());
  }
  files::write_atomically(file, csv);
}

std::string levels_table(const Study& study) {
  std::vector<std::vector<std::string>> rows;
  const auto add = [&](const Level& level) {
    rows.push_back({level.name, std::to_string(level.elements), fmt::format("{:.3f}", level.size),
                    fmt::format("{:.4g}", 1e3 * level.step), fmt::format("{:.0f}", level.seconds)});
  };
  add(study.base);
  for (const auto* list : {&study.meshes, &study.steps}) std::for_each(list->begin(), list->end(), add);
  return drawing::page::table({"level", "tetrahedra", "mean edge over that of the case", "step [ms]", "run [s]"}, rows);
}

/// Differences from the case over all levels, as shares of its values.
std::string plot_of(const std::vector<Row>& rows, const std::vector<double>& sizes, std::vector<double> Row::*values,
                    const std::string& what) {
  if (sizes.size() < 2) return "";
  std::vector<drawing::Series> series;
  for (const auto& row : rows) {
    if (row.value == 0 || series.size() == 7) continue;
    drawing::Series s{.name = row.path, .x = sizes, .y = {}, .line = true, .markers = true};
    for (const double v : row.*values) s.y.push_back(100 * (v - row.value) / std::abs(row.value));
    series.push_back(std::move(s));
  }
  if (series.empty()) return "";
  return drawing::page::drawing(drawing::draw_plot(
      series, {.title = "change with the " + what, .x_label = what, .y_label = "change [%]", .width = 900}));
}

void write_page(const fs::path& file, const Study& study, const std::vector<Row>& rows) {
  std::vector<std::string> head = {"figure", "value", "± band", "of the value"};
  for (const auto* list : {&study.meshes, &study.steps})
    for (const auto& level : *list) head.push_back(level.name);
  for (const char* cell : {"mesh: order", "± by mesh", "step: order", "± by step"}) head.emplace_back(cell);
  std::vector<std::vector<std::string>> cells;
  for (const auto& row : rows) {
    auto& line = cells.emplace_back(std::vector<std::string>{drawing::page::escaped(row.path), figure_text(row.value),
                                                             figure_text(row.band()), share(row, row.band())});
    for (const auto* values : {&row.meshes, &row.steps})
      for (std::size_t k = 1; k < values->size(); ++k) line.push_back(figure_text((*values)[k]));
    for (const auto* e : {&row.of_mesh, &row.of_step}) {
      line.push_back(std::isfinite(e->order) ? fmt::format("{:.2f}, {}", e->order, e->text()) : e->text());
      line.push_back(share(row, e->band));
    }
  }
  files::write_atomically(
      file,
      drawing::page::begin(
          fmt::format("Convergence{}{}", study.chain.settings.title.empty() ? "" : ": ", study.chain.settings.title)) +
          "<p>The same case on finer meshes and with smaller steps. A band is an estimate of how far the figure of the "
          "case is from that of an infinitely fine mesh and step: 1.25 times the distance to Richardson's "
          "extrapolation "
          "where an order is observed that can be believed, 3 times where it is assumed or cannot, 3 times the range "
          "where the figures oscillate or their increments grow. The bands of mesh and step are added.</p>\n" +
          levels_table(study) + drawing::page::table(head, cells) +
          plot_of(rows, sizes_of(study.base, study.meshes, &Level::size), &Row::meshes,
                  "mean edge over that of the case") +
          plot_of(rows, sizes_of(study.base, study.steps, &Level::step), &Row::steps, "step [s]") +
          drawing::page::end());
}

void write_results(Study& study, const ConvergeRequest& request, std::FILE* screen) {
  read_level(study.base, study.chain);
  for (auto* list : {&study.meshes, &study.steps})
    for (auto& level : *list) read_level(level, study.chain);
  const auto size = [&](const Level& level) {
    return std::cbrt(static_cast<double>(study.base.elements) / static_cast<double>(level.elements));
  };
  study.base.size = 1.0;
  for (auto* list : {&study.meshes, &study.steps})
    for (auto& level : *list) level.size = size(level);
  const auto rows = compare(study, request.quantities.empty() ? default_quantities() : request.quantities);
  const fs::path folder = study.chain.output / "converge";
  files::Hash post;  // figures of another time have no bands
  const std::string text = config::read_text(folder_of_stage(study.base, study.chain, "post") / "post.json");
  post.add(text.data(), text.size());
  write_json(folder / "converge.json", study, rows, files::hex(post.value()));
  write_csv(folder / "converge.csv", study, rows);
  write_page(folder / "converge.html", study, rows);
  std::fprintf(screen, "\n%-64s %12s %12s\n", "figure", "value", "+-");
  for (const auto& row : rows) std::fprintf(screen, "%-64s %12.5g %12.2g\n", row.path.c_str(), row.value, row.band());
  std::fprintf(screen, "\nconvergence: %s\n", (folder / "converge.html").c_str());
}

}  // namespace

int converge(const ConvergeRequest& request, MPI_Comm comm, std::FILE* screen) {
  files::FolderLock lock;  // rank 0; the chains in it find it their own
  Study study = parallel::on_root(comm, [&] {
    Study planned = plan_convergence(request);
    lock = files::FolderLock(planned.chain.output);
    if (!lock.taken_over().empty()) std::fprintf(screen, "warning: %s\n", lock.taken_over().c_str());
    return planned;
  });
  ChainRequest base;  // all its stages, whatever else was asked for
  base.case_file = request.chain.case_file;
  base.directory = request.chain.directory;
  base.overwrite = request.chain.overwrite;
  base.program = request.chain.program;
  if (const int signal = run_chain(base, comm, screen); signal != 0) return signal;
  std::vector<std::string> files = parallel::on_root(comm, [&] {
    write_levels(request, study);
    std::vector<std::string> names;
    for (const auto* list : {&study.meshes, &study.steps})
      for (const auto& level : *list) names.push_back(level.file.string());
    return names;
  });
  parallel::broadcast(comm, files);
  for (std::size_t k = 0; k < files.size(); ++k) {
    if (parallel::rank(comm) == 0)
      std::fprintf(screen, "\n##### %s (%zu of %zu)\n", fs::path(files[k]).parent_path().filename().c_str(), k + 1,
                   files.size());
    ChainRequest level;
    level.case_file = files[k];
    level.overwrite = request.chain.overwrite;
    level.program = request.chain.program;
    if (const int signal = run_chain(level, comm, screen); signal != 0) return signal;
  }
  parallel::on_root(comm, [&] { write_results(study, request, screen); });
  base.overwrite = false;
  return run_chain(base, comm, screen);  // the bands are taken into the report
}

}  // namespace tunica::pipeline
