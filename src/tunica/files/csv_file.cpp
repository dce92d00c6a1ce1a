#include "tunica/files/csv_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "tunica/base/error.hpp"
#include "tunica/base/text.hpp"

namespace tunica::files {

namespace {

constexpr std::string_view typographic_minus = "\xE2\x88\x92", en_dash = "\xE2\x80\x93";

/// Where the cell begins that a line's place is given for.
struct Place {
  const std::filesystem::path& file;
  int line;
  std::string text() const { return fmt::format("{}:{}", text::printable(file.string(), 400), line); }
};

/// The text of a cell in quotes, and what follows it.
struct Quoted {
  std::string text;
  std::string_view rest;
};

Quoted unquote(std::string_view line, const Place& place) {
  Quoted result;
  for (std::size_t i = 1; i < line.size(); ++i) {
    if (line[i] != '"') {
      result.text += line[i];
    } else if (i + 1 < line.size() && line[i + 1] == '"') {
      result.text += line[i++];
    } else {
      result.rest = line.substr(i + 1);
      return result;
    }
  }
  throw InputError(place.text(),
                   fmt::format("the quote before '{}' is not closed in its line", text::printable(line.substr(1), 20)),
                   "close it, and keep every row in one line");
}

/// The separator may be a tab, which is a blank elsewhere.
std::string_view trimmed(std::string_view cell) { return text::trimmed(cell); }

std::vector<std::string> split(std::string_view line, char separator, const Place& place) {
  std::vector<std::string> cells;
  for (;;) {
    const auto start = line.find_first_not_of(separator == '\t' ? " " : " \t");
    if (start != std::string_view::npos && line[start] == '"') {
      Quoted quoted = unquote(line.substr(start), place);
      const auto next = quoted.rest.find(separator);
      if (const auto more = trimmed(quoted.rest.substr(0, next)); !more.empty())
        throw InputError(place.text(), fmt::format("'{}' follows a closed quote", text::printable(more, 20)),
                         "write a quote within quotes twice, and separate the cells");
      cells.emplace_back(trimmed(quoted.text));
      line = next == std::string_view::npos ? std::string_view() : quoted.rest.substr(next + 1);
      if (next == std::string_view::npos) return cells;
      continue;
    }
    const auto next = line.find(separator);
    cells.emplace_back(trimmed(line.substr(0, next)));
    if (next == std::string_view::npos) return cells;
    line.remove_prefix(next + 1);
  }
}

/// Without the empty cells at the end that spreadsheets leave there.
std::vector<std::string> split_header(std::string_view line, char separator, const Place& place) {
  auto cells = split(line, separator, place);
  while (cells.size() > 1 && cells.back().empty()) cells.pop_back();
  return cells;
}

bool is_comment(std::string_view line) { return line.starts_with('#') || line.starts_with("\"#"); }
bool is_blank(std::string_view line) { return line.find_first_not_of(" \t,;\"") == std::string_view::npos; }

/// Separators that stand outside quotes, the most telling one first.
std::vector<char> separators_in(std::string_view line) {
  std::vector<char> found;
  for (const char candidate : {'\t', ';', ','}) {
    bool quoted = false;
    for (const char c : line) {
      quoted = quoted != (c == '"');
      if (!quoted && c == candidate) {
        found.push_back(candidate);
        break;
      }
    }
  }
  return found;
}

/// A header may hold another separator in its names: the row below tells which one it is.
char separator_of(const std::vector<TextLine>& lines, std::size_t header, const std::filesystem::path& file) {
  const auto candidates = separators_in(lines[header].text);
  if (candidates.empty()) return ',';
  if (candidates.size() > 1 && header + 1 < lines.size())
    for (const char c : candidates) {
      const auto names = split_header(lines[header].text, c, {file, lines[header].number});
      if (names.size() > 1 && split(lines[header + 1].text, c, {file, lines[header + 1].number}).size() == names.size())
        return c;
    }
  return candidates.front();
}

/// "sep=;" in front of the header, which Excel reads and other programs write.
std::optional<char> named_separator(const TextLine& line, const std::filesystem::path& file) {
  if (line.text.size() != 5 || !line.text.starts_with("sep=")) return std::nullopt;
  if (std::string_view(",;\t|").find(line.text[4]) == std::string_view::npos)
    throw InputError(Place{file, line.number}.text(), fmt::format("'{}' names no separator", line.text),
                     "separate columns by commas, semicolons or tabs");
  return line.text[4];
}

/// What a number that is none may have been meant to be.
std::string remedy_for(std::string_view cell) {
  if (cell.empty()) return "give a number, or remove the line";
  if (cell.find(typographic_minus) != std::string_view::npos || cell.find(en_dash) != std::string_view::npos)
    return "write the plain minus sign '-'";
  const auto comma = cell.find(',');
  if (comma != std::string_view::npos && cell.find_first_not_of("0123456789+-.,eE") == std::string_view::npos)
    return "write numbers with a decimal point and without separators of thousands, such as 1234.5";
  return "write numbers with a decimal point; start comment lines with #";
}

enum class NumberReading { number, no_number, not_finite, out_of_range };

NumberReading read_number(std::string_view cell, double& value) {
  if (cell.size() > 1 && cell.front() == '+' && cell[1] != '-' && cell[1] != '+') cell.remove_prefix(1);
  const char* end = cell.data() + cell.size();
  const auto [stop, error] = std::from_chars(cell.data(), end, value);
  if (error == std::errc::result_out_of_range && stop == end) return NumberReading::out_of_range;
  if (error != std::errc() || stop != end) return NumberReading::no_number;
  return std::isfinite(value) ? NumberReading::number : NumberReading::not_finite;
}

std::size_t find_header(const std::vector<std::string>& headers, const std::string& wanted,
                        const std::filesystem::path& file) {
  const auto matching = [&](const auto& same) {
    std::vector<std::size_t> found;
    for (std::size_t k = 0; k < headers.size(); ++k)
      if (same(headers[k])) found.push_back(k);
    return found;
  };
  auto found = matching([&](const std::string& header) { return header == wanted; });
  if (found.empty())
    found =
        matching([&](const std::string& header) { return text::lower(header) == text::lower(text::trimmed(wanted)); });
  const std::string where = text::printable(file.string(), 400);
  if (found.size() > 1)
    throw InputError(where, fmt::format("{} columns are called '{}'", found.size(), wanted), "give each its own name");
  if (found.empty())
    throw InputError(where, fmt::format("no column is called '{}'", wanted), "choose from: " + listed(headers));
  return found.front();
}

std::string column_remedy(std::size_t cells, std::size_t headers, char separator) {
  std::string remedy = "give every line as many values as the header has names, or remove it";
  if (separator == ',' && cells > headers) remedy += "; decimals are written with a point";
  return remedy;
}

}  // namespace

std::string quoted(std::string text) {
  for (std::size_t at = 0; (at = text.find('"', at)) != std::string::npos; at += 2) text.insert(at, 1, '"');
  return '"' + text + '"';
}

std::string listed(const std::vector<std::string>& names) {
  std::string all;
  for (const auto& name : names) all += (all.empty() ? "" : ", ") + text::printable(name, 60);
  return all;
}

std::vector<TextLine> read_lines(const std::filesystem::path& file, const std::string& remedy) {
  const std::string content = text::read(file);
  std::vector<TextLine> lines;
  int number = 0;
  for (std::size_t begin = 0; begin < content.size();) {
    const std::size_t end = std::min(content.find_first_of("\r\n", begin), content.size());
    ++number;
    const auto line = std::string_view(content).substr(begin, end - begin), words = text::trimmed(line);
    if (!words.empty() && !is_comment(words)) lines.push_back({number, std::string(line)});
    begin = end + (content.compare(end, 2, "\r\n") == 0 ? 2 : 1);
  }
  if (lines.empty()) throw InputError(text::printable(file.string(), 400), "is empty", remedy);
  return lines;
}

bool is_number(std::string_view cell) {
  double value = 0;
  return read_number(text::trimmed(cell), value) == NumberReading::number;
}

double parse_number(std::string_view cell, const std::string& where, const std::string& name) {
  cell = text::trimmed(cell);
  double value = 0;
  const char* what = nullptr;
  switch (read_number(cell, value)) {
    case NumberReading::number:
      return value;
    case NumberReading::no_number:
      what = "is not a number";
      break;
    case NumberReading::not_finite:
      what = "is not a finite number";
      break;
    case NumberReading::out_of_range:
      what = "is larger or smaller than a number can be";
      break;
  }
  throw InputError(where, fmt::format("'{}' {}{}{}", text::printable(cell), name, name.empty() ? "" : " ", what),
                   remedy_for(cell));
}

std::string TextTable::where(int line) const { return Place{file, line}.text(); }

std::size_t TextTable::find(const std::string& header) const { return find_header(headers, header, file); }

double TextTable::number(const TableRow& row, std::size_t column) const {
  return parse_number(row.cells[column], where(row.line), fmt::format("under '{}'", headers[column]));
}

TextTable read_table(const std::filesystem::path& file, const std::string& remedy) {
  std::vector<TextLine> lines = read_lines(file, remedy);
  TextTable table{file, 0, {}, {}};
  std::size_t header = 0;
  const std::optional<char> named = named_separator(lines[0], file);
  if (named) header = 1;
  while (header < lines.size() && is_blank(lines[header].text)) ++header;
  if (header == lines.size()) throw InputError(text::printable(file.string(), 400), "is empty", remedy);
  const char separator = named ? *named : separator_of(lines, header, file);
  table.header_line = lines[header].number;
  table.headers = split_header(lines[header].text, separator, {file, lines[header].number});
  for (std::size_t n = header + 1; n < lines.size(); ++n) {
    if (is_blank(lines[n].text)) continue;
    const Place place{file, lines[n].number};
    auto cells = split(lines[n].text, separator, place);
    while (cells.size() > table.headers.size() && cells.back().empty()) cells.pop_back();
    if (cells.size() != table.headers.size())
      throw InputError(place.text(), fmt::format("has {} columns, the header {}", cells.size(), table.headers.size()),
                       column_remedy(cells.size(), table.headers.size(), separator));
    table.rows.push_back({lines[n].number, std::move(cells)});
  }
  return table;
}

std::size_t CsvColumns::find(const std::string& header) const { return find_header(headers, header, file); }

CsvColumns read_csv(const std::filesystem::path& file, const std::string& remedy, Gaps gaps) {
  const TextTable text = read_table(file, remedy);
  CsvColumns table{file, text.headers, {}};
  for (std::size_t k = 0; k < text.headers.size(); ++k) {
    auto& column = table.columns.emplace_back();
    for (const auto& row : text.rows) {
      const bool gap = gaps == Gaps::allowed && text::lower(row.cells[k]) == "nan";
      column.push_back(gap ? std::nan("") : text.number(row, k));
    }
  }
  return table;
}

}  // namespace tunica::files
