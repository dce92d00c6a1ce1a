// Tables in CSV files: one header line, then numbers. Blank lines and lines that begin with # are skipped.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tunica::files {

struct CsvColumns {
  std::filesystem::path file;
  std::vector<std::string> headers;
  std::vector<std::vector<double>> columns;  ///< all of the same length

  /// Number of the column with this header. Throws InputError listing those that exist.
  std::size_t find(const std::string& header) const;
  const std::vector<double>& column(const std::string& header) const { return columns[find(header)]; }
};

/// Throws InputError: a file that is missing or empty, a line with too few or too many columns, a value that is no
/// number (with its line). `remedy` says what the file should be.
CsvColumns read_csv(const std::filesystem::path& file, const std::string& remedy);

/// "a, b, c".
std::string listed(const std::vector<std::string>& names);

}  // namespace tunica::files
