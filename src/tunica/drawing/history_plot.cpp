#include "tunica/drawing/history_plot.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tunica/base/error.hpp"
#include "tunica/drawing/plot.hpp"
#include "tunica/files/csv_file.hpp"
#include "tunica/files/outputs.hpp"

namespace tunica::drawing {

namespace {

// Headers that contain `text`.
std::vector<std::size_t> find(const files::CsvColumns& history, const std::string& text) {
  std::vector<std::size_t> found;
  for (std::size_t k = 0; k < history.headers.size(); ++k)
    if (history.headers[k].find(text) != std::string::npos) found.push_back(k);
  if (!found.empty()) return found;
  throw InputError(history.file.string(), fmt::format("no column is called '{}'", text),
                   "choose from: " + files::listed(history.headers));
}

// What stands before and after the blank in front of "[unit]".
std::string unit_of(const std::string& header) {
  const auto at = header.rfind('[');
  return at == std::string::npos ? "" : header.substr(at);
}

}  // namespace

std::vector<std::string> plot_history(const HistoryPlotOptions& options) {
  files::try_output(options.output);
  const files::CsvColumns history = files::read_csv(options.history, "name a history of a run, such as faces.csv");
  const std::size_t x = find(history, options.x).front();
  std::vector<std::size_t> chosen;
  for (const auto& text : options.columns)
    for (const auto k : find(history, text))
      if (std::find(chosen.begin(), chosen.end(), k) == chosen.end()) chosen.push_back(k);

  std::vector<Series> series;
  std::vector<std::string> names;
  const std::string unit = unit_of(history.headers[chosen.front()]);
  for (const auto k : chosen) {
    const std::string& header = history.headers[k];
    if (unit_of(header) != unit)
      throw InputError(options.history.string(),
                       fmt::format("'{}' and '{}' have different units", history.headers[chosen.front()], header),
                       "draw them in two plots");
    series.push_back({.name = header, .x = history.columns[x], .y = history.columns[k]});
    names.push_back(header);
  }
  PlotOptions plot;
  plot.title = options.title;
  plot.x_label = history.headers[x];
  plot.y_label = names.size() == 1 ? names.front() : unit;
  write_plot(options.output.string(), series, plot);
  return names;
}

}  // namespace tunica::drawing
