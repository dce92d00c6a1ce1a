// Reading of waveform tables: CSV and SimVascular's flow files.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "tunica/base/error.hpp"
#include "tunica/base/text.hpp"
#include "tunica/bc/waveform.hpp"
#include "tunica/files/csv_file.hpp"

namespace tunica::bc {

namespace {

std::vector<std::string_view> split_blanks(std::string_view line) {
  constexpr const char* blanks = " \t";
  std::vector<std::string_view> cells;
  for (auto begin = line.find_first_not_of(blanks); begin != std::string_view::npos;) {
    const auto end = std::min(line.find_first_of(blanks, begin), line.size());
    cells.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(blanks, end);
  }
  return cells;
}

void append(Table& table, double t, double value, const std::string& where) {
  if (!table.times.empty() && t <= table.times.back())
    throw InputError(where,
                     fmt::format("time {} s does not increase (the line before has {} s)", t, table.times.back()),
                     "sort the lines by time and remove repeated times");
  table.times.push_back(t);
  table.values.push_back(value);
}

void check_header(const files::TextTable& table, const TableFile& file) {
  const std::string where = table.where(table.header_line);
  if (std::all_of(table.headers.begin(), table.headers.end(), files::is_number))
    throw InputError(where, "the first line holds numbers, a header is missing",
                     "name the columns in the first line, such as t_s,Q_ml_per_s");
  if (table.headers.size() < 2)
    throw InputError(where, "there is one column, time and value are needed",
                     "separate columns by commas, semicolons or tabs");
  if (file.value_column.empty() && table.headers.size() > 2)
    throw InputError(where, fmt::format("there are {} columns and none is chosen", table.headers.size()),
                     fmt::format("set `value_column` to one of: {}", files::listed(table.headers)));
}

Table read_csv(const TableFile& file) {
  const files::TextTable text = files::read_table(file.path, "give a header line and lines of numbers");
  check_header(text, file);
  const std::size_t t = file.time_column.empty() ? 0 : text.find(file.time_column);
  const std::size_t v = file.value_column.empty() ? 1 - t : text.find(file.value_column);
  if (t == v)
    throw InputError(text.where(text.header_line), fmt::format("'{}' is time and value", text.headers[t]),
                     "name two columns by `time_column` and `value_column`");
  Table table;
  for (const auto& row : text.rows)
    append(table, text.number(row, t) * file.time_unit, text.number(row, v) * file.value_unit, text.where(row.line));
  return table;
}

/// svSolver's .flow files have no line of points and modes before their times, the first of which is 0 then.
bool begins_with_a_time(const std::vector<files::TextLine>& lines) {
  const auto first = split_blanks(lines[0].text);
  return first.size() == 2 && files::is_number(first[0]) && files::parse_number(first[0], "", "") == 0;
}

Table read_simvascular(const TableFile& file) {
  const char* remedy = "the first line is \"points modes\" (or none), each other one \"time value\"";
  const auto lines = files::read_lines(file.path, remedy);
  const auto where = [&](const files::TextLine& line) { return fmt::format("{}:{}", file.path.string(), line.number); };
  const auto number = [&](const files::TextLine& line, std::string_view cell) {
    return files::parse_number(text::decimal_exponent(cell), where(line), "");  // svFSI reads those of Fortran
  };
  const auto header = split_blanks(lines[0].text);
  const auto whole = [&](std::size_t i) {
    const double value = number(lines[0], header[i]);
    if (value < 1 || value > 1e7 || value != std::floor(value))
      throw InputError(where(lines[0]), fmt::format("'{}' is not a whole number >= 1", header[i]), remedy);
    return static_cast<std::size_t>(value);
  };
  if (header.size() != 2)
    throw InputError(where(lines[0]), fmt::format("the first line has {} entries, not 2", header.size()), remedy);
  const bool headless = begins_with_a_time(lines);
  const std::size_t points = headless ? lines.size() : whole(0);
  Table table;
  if (!headless) table.modes = static_cast<int>(whole(1));
  for (std::size_t n = headless ? 0 : 1; n < lines.size(); ++n) {
    const auto cells = split_blanks(lines[n].text);
    if (cells.size() != 2) throw InputError(where(lines[n]), fmt::format("{} entries, not 2", cells.size()), remedy);
    append(table, number(lines[n], cells[0]) * file.time_unit, number(lines[n], cells[1]) * file.value_unit,
           where(lines[n]));
  }
  if (table.times.size() != points)
    throw InputError(where(lines.back()),
                     fmt::format("{} points follow, the first line says {}", table.times.size(), points),
                     "correct the first line, or restore the missing lines");
  return table;
}

/// Eight instants in the shortest wave.
Table points_of(const FourierSeries& series, const std::string& where) {
  const Waveform waveform = Waveform::fourier_series(series, where);
  const auto intervals = 8 * series.cosine.size();
  Table table{.times = {}, .values = {}, .modes = static_cast<int>(series.cosine.size())};
  for (std::size_t i = 0; i < intervals; ++i) {
    table.times.push_back(series.start + series.period * static_cast<double>(i) / static_cast<double>(intervals));
    table.values.push_back(waveform.value(table.times.back()));
  }
  return table;
}

}  // namespace

bool is_fourier_series(const TableFile& file) {
  if (file.format != TableFormat::automatic) return file.format == TableFormat::fourier;
  return text::lower(file.path.extension().string()) == ".fcs";
}

bool is_simvascular(const TableFile& file) {
  if (is_fourier_series(file)) return true;
  if (file.format != TableFormat::automatic) return file.format == TableFormat::simvascular;
  const std::string extension = text::lower(file.path.extension().string());
  if (extension == ".flow") return true;
  if (extension == ".csv") return false;
  throw InputError(file.path.string(), fmt::format("the extension '{}' does not tell the format", extension),
                   "set `format` to csv or simvascular");
}

std::vector<FourierSeries> read_fourier_series(const TableFile& file, std::size_t components) {
  const char* remedy =
      "the numbers are start and period, value and slope of the trend, the number of modes, and for each mode its real "
      "and imaginary part; of several components all real parts before all imaginary ones";
  const auto lines = files::read_lines(file.path, remedy);
  const auto where = [&](std::size_t line) { return fmt::format("{}:{}", file.path.string(), lines[line].number); };
  struct Number {
    double value;
    std::size_t line, beside;  // `beside`: how many there are on its line
  };
  std::vector<Number> numbers;
  for (std::size_t n = 0; n < lines.size(); ++n) {
    const auto cells = split_blanks(lines[n].text);
    for (const auto cell : cells)
      numbers.push_back({files::parse_number(text::decimal_exponent(cell), where(n), ""), n, cells.size()});
  }
  const std::size_t head = 3 + 2 * components;
  if (numbers.size() < head) throw InputError(where(lines.size() - 1), "the file ends before its modes", remedy);
  const Number& modes = numbers[head - 1];
  const bool counts = modes.value >= 1 && modes.value <= 1e6 && modes.value == std::floor(modes.value);
  const std::size_t follow = numbers.size() - head;
  if (!counts || follow != 2 * components * static_cast<std::size_t>(modes.value))
    throw InputError(where(modes.line),
                     fmt::format("{} modes of {} numbers, and {} numbers follow", modes.value, 2 * components, follow),
                     remedy);
  // svMultiPhysics writes value and slope of each component on a line of its own, svFSI all values before all slopes.
  const bool in_pairs = numbers[2].beside == 2;
  std::vector<FourierSeries> all;
  for (std::size_t c = 0; c < components; ++c) {
    FourierSeries& series = all.emplace_back();
    series.start = numbers[0].value * file.time_unit;
    series.period = numbers[1].value * file.time_unit;
    series.value = numbers[in_pairs ? 2 + 2 * c : 2 + c].value * file.value_unit;
    series.slope = numbers[in_pairs ? 3 + 2 * c : 2 + components + c].value * file.value_unit / file.time_unit;
    for (std::size_t n = head + c; n < numbers.size(); n += 2 * components) {
      series.cosine.push_back(numbers[n].value * file.value_unit);
      series.sine.push_back(-numbers[n + components].value * file.value_unit);
    }
  }
  return all;
}

Table read_table(const TableFile& file) {
  if (is_fourier_series(file)) return points_of(read_fourier_series(file)[0], file.path.string());
  Table table = is_simvascular(file) ? read_simvascular(file) : read_csv(file);
  if (table.times.size() < 2)
    throw InputError(file.path.string(), fmt::format("{} points, at least 2 are needed", table.times.size()),
                     "give the waveform at two times or more, or a constant");
  return table;
}

}  // namespace tunica::bc
