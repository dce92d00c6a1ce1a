#include "tunica/artifacts/answer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "tunica/artifacts/histories.hpp"
#include "tunica/files/csv_file.hpp"

namespace tunica::artifacts {

namespace {

constexpr std::size_t most_lines = 12;

/// "  78.1    96   121 mmHg": of the rows from `first` on.
std::optional<std::string> range_text(const files::CsvColumns& table, const std::string& quantity, std::size_t first) {
  for (std::size_t k = 0; k < table.headers.size(); ++k) {
    const std::string& header = table.headers[k];
    if (!header.starts_with(quantity + " [") || first >= table.columns[k].size()) continue;
    const auto begin = table.columns[k].begin() + static_cast<std::ptrdiff_t>(first), end = table.columns[k].end();
    double sum = 0;
    for (auto value = begin; value != end; ++value) sum += *value;
    const auto unit = header.substr(quantity.size() + 2, header.size() - quantity.size() - 3);
    return fmt::format("{:>8.3g} {:>8.3g} {:>8.3g} {}", *std::min_element(begin, end),
                       sum / static_cast<double>(end - begin), *std::max_element(begin, end), unit);
  }
  return std::nullopt;
}

}  // namespace

std::vector<std::string> answer_lines(const std::filesystem::path& faces, const std::vector<std::string>& openings,
                                      double from) {
  const auto table = files::read_csv(faces, history_remedy, files::Gaps::allowed);
  if (table.columns.size() < 2) return {};
  const auto& times = table.columns[1];  // after the step
  const auto first = static_cast<std::size_t>(std::upper_bound(times.begin(), times.end(), from) - times.begin());
  std::size_t width = 0;
  for (const auto& name : openings) width = std::max(width, name.size());
  std::vector<std::string> lines;
  for (const auto& name : openings) {
    if (lines.size() == most_lines) break;
    const auto pressure = range_text(table, name + " pressure", first), flow = range_text(table, name + " flow", first);
    if (pressure && flow)
      lines.push_back(fmt::format("  {:<{}} {}  {}", name, std::min<std::size_t>(width, 28), *pressure, *flow));
  }
  return lines;
}

}  // namespace tunica::artifacts
