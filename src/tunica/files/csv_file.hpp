// The one reader of tables: a header line, then rows. Whatever spreadsheets and editors make of a table is read
// alike: byte-order mark, line ends of every system, quotes, blanks around, a plus sign; separated by commas,
// semicolons or tabs. Empty lines and lines that begin with # are skipped. The text is UTF-8.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace tunica::files {

/// A line that is neither empty nor a comment, as it stands in the file.
struct TextLine {
  int number;  ///< in the file, from 1
  std::string text;
};

/// Throws InputError as text::read, with `remedy` where the file cannot be read, and where it holds no line.
std::vector<TextLine> read_lines(const std::filesystem::path& file, const std::string& remedy);

struct TableRow {
  int line;                        ///< in the file, from 1
  std::vector<std::string> cells;  ///< as many as the header has
};

struct TextTable {
  std::filesystem::path file;
  int header_line = 0;
  std::vector<std::string> headers;
  std::vector<TableRow> rows;  ///< may be none

  /// "file:line".
  std::string where(int line) const;
  /// Number of the column with this header: as it is written, or else in other letters of case. Throws InputError
  /// listing those that exist, and where two columns have the name.
  std::size_t find(const std::string& header) const;
  /// The cell as a number: decimal point, whole cell, finite. Throws InputError with its line.
  double number(const TableRow& row, std::size_t column) const;
};

/// Throws InputError: as read_lines(), a line with too few or too many columns, a quote that is not closed. `remedy`
/// says what the file should be.
TextTable read_table(const std::filesystem::path& file, const std::string& remedy);

/// Numbers that are not there, which some tables of results write as nan.
enum class Gaps { refused, allowed };

struct CsvColumns {
  std::filesystem::path file;
  std::vector<std::string> headers;
  std::vector<std::vector<double>> columns;  ///< all of the same length

  /// As TextTable::find.
  std::size_t find(const std::string& header) const;
  const std::vector<double>& column(const std::string& header) const { return columns[find(header)]; }
};

/// A table of numbers alone. Throws InputError as read_table() and TextTable::number().
CsvColumns read_csv(const std::filesystem::path& file, const std::string& remedy, Gaps gaps = Gaps::refused);

/// A number with decimal point, a sign and blanks around allowed; does not depend on the locale. Throws InputError at
/// `where` for anything else, for one that is not finite, and for what a decimal comma or a typographic minus has
/// left; `name` says what the number is, as in "under 'sigma'".
double parse_number(std::string_view cell, const std::string& where, const std::string& name);
/// Is it one?
bool is_number(std::string_view cell);

/// The text as a cell in quotes, in which anything may stand; its own quotes are doubled.
std::string quoted(std::string text);

/// "a, b, c".
std::string listed(const std::vector<std::string>& names);

}  // namespace tunica::files
