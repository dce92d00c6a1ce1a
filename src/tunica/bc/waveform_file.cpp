// Reading of waveform tables: CSV and SimVascular's flow files.
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <fstream>
#include <string_view>

#include "tunica/base/error.hpp"
#include "tunica/bc/waveform.hpp"

namespace tunica::bc {

namespace {

std::string_view trim(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\"");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\"") - first + 1);
}

std::optional<double> number(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

std::vector<std::string_view> split_commas(std::string_view line) {
  std::vector<std::string_view> cells;
  for (;;) {
    const auto comma = line.find(',');
    cells.push_back(trim(line.substr(0, comma)));
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

std::vector<std::string_view> split_blanks(std::string_view line) {
  std::vector<std::string_view> cells;
  while (!(line = trim(line)).empty()) {
    const auto end = line.find_first_of(" \t");
    cells.push_back(line.substr(0, end));
    line.remove_prefix(end == std::string_view::npos ? line.size() : end);
  }
  return cells;
}

/// Lines that are neither blank nor comments, with their number.
class Lines {
 public:
  explicit Lines(const std::filesystem::path& path) : path_(path), stream_(path) {
    if (!stream_ || std::filesystem::is_directory(path))
      throw InputError(path.string(), "the waveform file cannot be opened",
                       "check the path (relative ones start at the case file) and the permissions");
  }
  bool next() {
    while (std::getline(stream_, line_)) {
      ++number_;
      if (number_ == 1 && line_.starts_with("\xEF\xBB\xBF")) line_.erase(0, 3);  // byte-order mark
      const auto content = trim(line_);
      if (!content.empty() && !content.starts_with('#')) return true;
    }
    return false;
  }
  std::string_view text() const { return trim(line_); }
  std::string where() const { return fmt::format("{}:{}", path_.string(), number_); }

 private:
  std::filesystem::path path_;
  std::ifstream stream_;
  std::string line_;
  int number_ = 0;
};

double require_number(std::string_view cell, const Lines& lines) {
  if (const auto value = number(cell)) return *value;
  throw InputError(lines.where(), fmt::format("'{}' is not a finite number", cell),
                   "write numbers with a decimal point; start comment lines with #");
}

void append(Table& table, double t, double value, const Lines& lines) {
  if (!table.times.empty() && t <= table.times.back())
    throw InputError(lines.where(),
                     fmt::format("time {} s does not increase (the line before has {} s)", t, table.times.back()),
                     "sort the lines by time and remove repeated times");
  table.times.push_back(t);
  table.values.push_back(value);
}

std::size_t find_column(const std::vector<std::string>& columns, const std::string& wanted, const char* key,
                        const std::string& where) {
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (columns[i] == wanted) return i;
  throw InputError(where, fmt::format("there is no column '{}'", wanted),
                   fmt::format("set `{}` to one of: {}", key, listed(columns)));
}

Table read_csv(const TableFile& file) {
  Lines lines(file.path);
  if (!lines.next())
    throw InputError(file.path.string(), "the waveform file is empty", "give a header line and lines of numbers");
  std::vector<std::string> columns;
  bool numeric = true;
  for (const auto cell : split_commas(lines.text())) {
    columns.emplace_back(cell);
    numeric = numeric && number(cell);
  }
  if (numeric)
    throw InputError(lines.where(), "the first line holds numbers, a header is missing",
                     "name the columns in the first line, such as t_s,Q_ml_per_s");
  if (columns.size() < 2)
    throw InputError(lines.where(), "there is one column, time and value are needed", "separate columns by commas");
  if (file.value_column.empty() && columns.size() > 2)
    throw InputError(lines.where(), fmt::format("there are {} columns and none is chosen", columns.size()),
                     fmt::format("set `value_column` to one of: {}", listed(columns)));
  const std::size_t t =
      file.time_column.empty() ? 0 : find_column(columns, file.time_column, "time_column", lines.where());
  const std::size_t v =
      file.value_column.empty() ? 1 - t : find_column(columns, file.value_column, "value_column", lines.where());
  Table table;
  while (lines.next()) {
    const auto cells = split_commas(lines.text());
    if (cells.size() != columns.size())
      throw InputError(lines.where(), fmt::format("{} columns, the header names {}", cells.size(), columns.size()),
                       "give every line as many values as the header has names");
    append(table, require_number(cells[t], lines) * file.time_unit, require_number(cells[v], lines) * file.value_unit,
           lines);
  }
  return table;
}

Table read_simvascular(const TableFile& file) {
  Lines lines(file.path);
  const char* remedy = "the first line is \"points modes\", each other one \"time value\"";
  if (!lines.next()) throw InputError(file.path.string(), "the waveform file is empty", remedy);
  const auto header = split_blanks(lines.text());
  const auto whole = [&](std::size_t i) {
    const double value = require_number(header[i], lines);
    if (value < 1 || value > 1e7 || value != std::floor(value))
      throw InputError(lines.where(), fmt::format("'{}' is not a whole number >= 1", header[i]), remedy);
    return static_cast<std::size_t>(value);
  };
  if (header.size() != 2)
    throw InputError(lines.where(), fmt::format("the first line has {} entries, not 2", header.size()), remedy);
  const std::size_t points = whole(0);
  Table table;
  table.modes = static_cast<int>(whole(1));
  while (lines.next()) {
    const auto cells = split_blanks(lines.text());
    if (cells.size() != 2) throw InputError(lines.where(), fmt::format("{} entries, not 2", cells.size()), remedy);
    append(table, require_number(cells[0], lines) * file.time_unit, require_number(cells[1], lines) * file.value_unit,
           lines);
  }
  if (table.times.size() != points)
    throw InputError(lines.where(), fmt::format("{} points follow, the first line says {}", table.times.size(), points),
                     "correct the first line, or restore the missing lines");
  return table;
}

}  // namespace

bool is_simvascular(const TableFile& file) {
  if (file.format != TableFormat::automatic) return file.format == TableFormat::simvascular;
  const auto extension = file.path.extension();
  if (extension == ".flow") return true;
  if (extension == ".csv") return false;
  throw InputError(file.path.string(), fmt::format("the extension '{}' does not tell the format", extension.string()),
                   "set `format` to csv or simvascular");
}

Table read_table(const TableFile& file) {
  Table table = is_simvascular(file) ? read_simvascular(file) : read_csv(file);
  if (table.times.size() < 2)
    throw InputError(file.path.string(), fmt::format("{} points, at least 2 are needed", table.times.size()),
                     "give the waveform at two times or more, or a constant");
  return table;
}

}  // namespace tunica::bc
