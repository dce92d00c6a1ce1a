#include "tunica/files/csv_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>

#include "tunica/base/error.hpp"

namespace tunica::files {

namespace {

std::string trimmed(const std::string& cell) {
  const auto first = cell.find_first_not_of(" \t\r");
  return first == std::string::npos ? "" : cell.substr(first, cell.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells(1);
  for (const char c : line)
    if (c == ',')
      cells.emplace_back();
    else
      cells.back() += c;
  for (std::string& cell : cells) cell = trimmed(cell);
  return cells;
}

}  // namespace

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

std::size_t CsvColumns::find(const std::string& header) const {
  const auto found = std::find(headers.begin(), headers.end(), header);
  if (found == headers.end())
    throw InputError(file.string(), fmt::format("no column is called '{}'", header), "choose from: " + listed(headers));
  return static_cast<std::size_t>(found - headers.begin());
}

CsvColumns read_csv(const std::filesystem::path& file, const std::string& remedy) {
  std::ifstream in(file);
  CsvColumns table{file, {}, {}};
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (trimmed(line).empty() || line.starts_with('#')) continue;
    const auto cells = split(line);
    if (table.headers.empty()) {
      table.headers = cells;
      table.columns.resize(cells.size());
      continue;
    }
    const std::string where = fmt::format("{}:{}", file.string(), number);
    if (cells.size() != table.headers.size())
      throw InputError(where, fmt::format("has {} columns, the header {}", cells.size(), table.headers.size()),
                       "mend or remove the line");
    for (std::size_t k = 0; k < cells.size(); ++k) {
      double value = 0;
      const char* end = cells[k].data() + cells[k].size();
      const auto [stop, error] = std::from_chars(cells[k].data(), end, value);
      if (error != std::errc() || stop != end)
        throw InputError(where, fmt::format("'{}' under '{}' is not a number", cells[k], table.headers[k]),
                         "mend or remove the line");
      table.columns[k].push_back(value);
    }
  }
  if (table.headers.empty()) throw InputError(file.string(), "cannot be read, or is empty", remedy);
  return table;
}

}  // namespace tunica::files
