#include "tunica/stages/history_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>

#include "tunica/base/error.hpp"
#include "tunica/stages/plot.hpp"

namespace tunica::stages {

namespace {

struct History {
  std::vector<std::string> headers;
  std::vector<std::vector<double>> columns;
};

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells(1);
  for (const char c : line)
    if (c == ',')
      cells.emplace_back();
    else if (c != '\r')
      cells.back() += c;
  return cells;
}

History read_history(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string line;
  if (!in || !std::getline(in, line))
    throw InputError(file.string(), "cannot be read, or is empty", "name a history of a run, such as faces.csv");
  History history{split(line), {}};
  history.columns.resize(history.headers.size());
  for (int number = 2; std::getline(in, line); ++number) {
    const auto cells = split(line);
    const std::string where = fmt::format("{}:{}", file.string(), number);
    if (cells.size() != history.headers.size())
      throw InputError(where, fmt::format("has {} columns, the header {}", cells.size(), history.headers.size()),
                       "mend or remove the line");
    for (std::size_t k = 0; k < cells.size(); ++k) {
      double value = 0;
      const char* end = cells[k].data() + cells[k].size();
      const auto [stop, error] = std::from_chars(cells[k].data(), end, value);
      if (error != std::errc() || stop != end)
        throw InputError(where, fmt::format("'{}' under '{}' is not a number", cells[k], history.headers[k]),
                         "mend or remove the line");
      history.columns[k].push_back(value);
    }
  }
  return history;
}

// Headers that contain `text`.
std::vector<std::size_t> find(const History& history, const std::string& text, const std::filesystem::path& file) {
  std::vector<std::size_t> found;
  for (std::size_t k = 0; k < history.headers.size(); ++k)
    if (history.headers[k].find(text) != std::string::npos) found.push_back(k);
  if (!found.empty()) return found;
  std::string all;
  for (const auto& header : history.headers) all += (all.empty() ? "" : ", ") + header;
  throw InputError(file.string(), fmt::format("no column is called '{}'", text), "choose from: " + all);
}

// What stands before and after the blank in front of "[unit]".
std::string unit_of(const std::string& header) {
  const auto at = header.rfind('[');
  return at == std::string::npos ? "" : header.substr(at);
}

}  // namespace

std::vector<std::string> plot_history(const HistoryPlotOptions& options) {
  const History history = read_history(options.history);
  const std::size_t x = find(history, options.x, options.history).front();
  std::vector<std::size_t> chosen;
  for (const auto& text : options.columns)
    for (const auto k : find(history, text, options.history))
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

}  // namespace tunica::stages
