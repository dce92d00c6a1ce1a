#include "tunica/pipeline/compare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tunica/base/error.hpp"
#include "tunica/drawing/page.hpp"
#include "tunica/drawing/plot.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/files/lock.hpp"
#include "tunica/files/outputs.hpp"
#include "tunica/parallel/agree.hpp"
#include "tunica/pipeline/foresight.hpp"
#include "tunica/pipeline/plan.hpp"
#include "tunica/pipeline/side_by_side.hpp"
#include "tunica/pipeline/stage_documents.hpp"

namespace tunica::pipeline {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// What the laws have in common ends with this stage; empty when they have none.
std::string last_common_stage(const case_file::Case& c) {
  for (const auto& [name, wanted] : {std::pair{"outlets", c.outlets && !c.outlets->given_file},
                                     std::pair{"fibres", c.fibres.has_value()}, std::pair{"mesh", c.mesh.has_value()}})
    if (wanted) return name;
  return {};
}

/// Writes the case file of a law and returns its name.
fs::path write_variant(const Chain& chain, const std::string& name) {
  const fs::path folder = chain.output / "compare" / name, file = folder / "case.yaml";
  config::Document document = case_on_common_mesh(chain, folder);
  document.set("title", fmt::format("{}{}{}", chain.settings.title, chain.settings.title.empty() ? "" : ": ", name));
  const config::Document law = with_law(chain.document, name);
  document.set("wall.material", law.part("wall.material"));
  document.remove("wall.regions");
  if (law.has("wall.regions")) document.set("wall.regions", law.part("wall.regions"));
  if (!document.has("post")) document.set("post", config::Document("{}"));
  if (!document.has("report")) document.set("report", config::Document("{pictures: false}"));
  document.set("output.directory", ".");
  files::make_folder(folder);
  files::write_atomically(file, fmt::format("# {} of `tunica compare` {}\n", name, chain.file.filename().string()) +
                                    config::commented_yaml(document, *description_of<case_file::Case>()));
  return file;
}

using Line = ComparedLine;  ///< a stress of a region, or a displacement

void add(std::vector<Line>& lines, const std::string& what, const std::string& unit, std::size_t law, std::size_t laws,
         const json& value) {
  auto at = std::find_if(lines.begin(), lines.end(), [&](const Line& l) { return l.what == what; });
  if (at == lines.end()) at = lines.insert(lines.end(), {what, unit, std::vector<double>(laws, std::nan(""))});
  if (value.is_number()) at->values[law] = value.get<double>();
}

void add_figures(std::vector<Line>& lines, const json& post, std::size_t law, std::size_t laws) {
  for (const auto& region : post.value("stress", json::array()))
    for (const auto& [key, values] : region.items()) {
      if (!values.is_object()) continue;
      for (const auto& [percent, value] : values.at("at_peak").items())
        add(lines,
            fmt::format("{} {} {} at peak pressure", region.value("name", ""), key.substr(0, key.rfind('_')), percent),
            "kPa", law, laws, value);
    }
  const json flap = post.value("flap", json::object());
  for (const char* key : {"largest_displacement_mm", "mean_displacement_over_the_cycle_mm"})
    if (flap.contains(key))
      add(lines, fmt::format("flap {}", std::string(key).substr(0, std::string(key).rfind('_'))), "mm", law, laws,
          flap[key]);
}

std::vector<Line> read_compared_figures(const Chain& chain, const std::vector<std::string>& names) {
  std::vector<Line> lines;
  for (std::size_t k = 0; k < names.size(); ++k) {
    const fs::path file = chain.output / "compare" / names[k] / "post/post.json";
    files::refuse_other_than_file(file);
    std::ifstream stream(file);
    const json post = json::parse(stream, nullptr, false);
    if (post.is_discarded())
      throw SolverError(fmt::format("the figures of {} do not read; do its stage `post` anew", names[k]));
    add_figures(lines, post, k, names.size());
  }
  return lines;
}

/// A stress of all regions in one plot: laws along the axis, one curve for each line.
std::string plot_of(const std::vector<Line>& lines, const std::string& title, const std::string& part) {
  std::vector<drawing::Series> series;
  std::string unit;
  for (const auto& line : lines) {
    if (line.what.find(part) == std::string::npos) continue;
    drawing::Series s{
        .name = line.what.substr(0, line.what.find(' ')), .x = {}, .y = line.values, .line = false, .markers = true};
    for (std::size_t k = 0; k < line.values.size(); ++k) s.x.push_back(static_cast<double>(k + 1));
    series.push_back(std::move(s));
    unit = line.unit;
  }
  if (series.empty()) return "";
  return drawing::page::drawing(drawing::draw_plot(series, {.title = title,
                                                            .x_label = "law, by its number in the table",
                                                            .y_label = fmt::format("{} [{}]", title, unit),
                                                            .width = 560}));
}

void write_comparison(const Chain& chain, const std::vector<std::string>& names) {
  const auto lines = read_compared_figures(chain, names);
  const fs::path folder = chain.output / "compare";
  write_compared_csv(folder / "compare.csv", names, lines);
  files::write_atomically(
      folder / "compare.html",
      drawing::page::begin("Wall laws side by side") + compared_table(names, lines) +
          plot_of(lines, "von Mises stress, 95 % of the volume below", "von_mises_stress p95") +
          plot_of(lines, "first principal stress, 95 % of the volume below", "first_principal_stress p95") +
          plot_of(lines, "largest displacement of the flap", "flap largest") + drawing::page::end());
}

}  // namespace

namespace {

/// On rank 0. Throws InputError when there are not at least two laws.
Chain read_laws(const ChainRequest& request) {
  std::vector<Problem> warnings;
  Chain chain = read_chain(request.case_file, request.directory, warnings);
  if (chain.settings.compare.size() < 2)
    throw InputError("compare", "names fewer than two laws", "add `compare: {neo_hooke: {material: ...}, ...}`");
  return chain;
}

}  // namespace

int compare_laws(const ChainRequest& request, MPI_Comm comm, std::FILE* screen) {
  files::FolderLock lock;  // rank 0; the chains in it find it their own
  std::string common = parallel::on_root(comm, [&] {
    const Chain chain = read_laws(request);
    lock = files::FolderLock(chain.output);
    if (!lock.taken_over().empty()) std::fprintf(screen, "warning: %s\n", lock.taken_over().c_str());
    files::try_outputs(chain.output, {"compare/compare.csv", "compare/compare.html"});
    return last_common_stage(chain.settings);
  });
  parallel::broadcast(comm, common);
  if (!common.empty()) {
    ChainRequest first = request;
    first.until = common;
    if (const int signal = run_chain(first, comm, screen); signal != 0) return signal;
  }
  return compare_on_common(request, comm, screen);
}

int compare_on_common(const ChainRequest& request, MPI_Comm comm, std::FILE* screen) {
  Chain chain = parallel::on_root(comm, [&] { return read_laws(request); });
  std::vector<std::string> names;
  for (const auto& [name, law] : chain.settings.compare) names.push_back(name);
  parallel::broadcast(comm, names);
  for (const auto& name : names) {
    std::string file = parallel::on_root(comm, [&] {
      std::fprintf(screen, "\n##### %s\n", name.c_str());
      return write_variant(chain, name).string();
    });
    parallel::broadcast(comm, file);
    ChainRequest variant;
    variant.case_file = file;
    variant.overwrite = request.overwrite;
    variant.program = request.program;
    if (const int signal = run_chain(variant, comm, screen); signal != 0) return signal;
  }
  parallel::on_root(comm, [&] {
    write_comparison(chain, names);
    std::fprintf(screen, "\nside by side: %s\n", (chain.output / "compare/compare.html").c_str());
  });
  return 0;
}

}  // namespace tunica::pipeline
