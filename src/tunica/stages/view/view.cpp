#include "tunica/stages/view/view.hpp"

#include <fmt/format.h>

#include <fstream>

#include "tunica/base/error.hpp"
#include "tunica/drawing/page.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/files/outputs.hpp"
#include "tunica/stages/beat.hpp"
#include "tunica/viewer/view_page.hpp"

namespace tunica::stages {

namespace {

namespace fs = std::filesystem;
namespace page = drawing::page;

nlohmann::json figures_of(const fs::path& folder) {
  std::ifstream stream(folder / "post.json");
  if (folder.empty() || !stream) return nullptr;
  auto read = nlohmann::json::parse(stream, nullptr, false);
  if (read.is_discarded()) throw InputError((folder / "post.json").string(), "is no JSON", "do `tunica post` anew");
  return read;
}

std::string plots_of(const std::vector<viewer::Plot>& plots) {
  std::string text =
      plots.empty() ? "" : "<h2>Curves</h2>\n<p class=\"screen\">A click shows that instant above; drag to zoom.</p>\n";
  for (std::size_t k = 0; k < plots.size(); ++k) text += viewer::plot(plots, k, page::escaped(plots[k].title));
  return text;
}

}  // namespace

void write_view(const ViewRequest& request, const files::Say& say) {
  if (request.output.extension() != ".html")
    throw InputError(request.output.string(), "is no name of a page", "let it end in .html");
  if (!request.overwrite && fs::exists(request.output))
    throw InputError(request.output.string(), "is there already", "give --overwrite, or another name by --output");
  files::try_output(request.output);
  const BeatSource source{request.case_file, request.results, figures_of(request.post)};
  const auto plots = collect_plots(source, request.post);
  auto beat = collect_beat(source, say);
  const std::string title = beat.title.empty() ? "Beat" : beat.title;
  const auto remarks = beat.remarks;
  say("view: modes and page");
  const auto packed = viewer::pack(std::move(beat), request.packing);
  std::string text = viewer::begin_page(title) + viewer::view() + plots_of(plots) + "<h2>How exact the view is</h2>\n";
  for (const auto& remark : remarks) text += fmt::format("<p class=\"missing\">{}.</p>\n", page::escaped(remark));
  files::write_atomically(request.output, text + viewer::accuracy(packed) + viewer::end_page(plots, &packed));
}

}  // namespace tunica::stages
