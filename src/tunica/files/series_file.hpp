// The text files that hold a time series together: .pvd lists the times, .pvtu the pieces of one time.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tunica/files/atomic_file.hpp"

namespace tunica::files {

struct SeriesEntry {
  double time;       ///< s
  std::string file;  ///< relative to the .pvd, without characters that XML escapes
};

/// Reads what `pvd_text` made; an empty series when there is no such file. Throws InputError when it is another text.
std::vector<SeriesEntry> read_pvd(const std::filesystem::path& path);
std::string pvd_text(const std::vector<SeriesEntry>& series);

struct ArrayHeader {
  std::string name;  ///< without characters that XML escapes, since VTK does not escape them either
  int components;
};
/// Head file of pieces that hold Float32 arrays and points. `pieces`: relative to the .pvtu.
std::string pvtu_text(const std::vector<ArrayHeader>& nodal, const std::vector<ArrayHeader>& cells,
                      const std::vector<std::string>& pieces);

}  // namespace tunica::files
