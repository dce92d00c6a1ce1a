// The text files that list the instants of a run: <region>.hdf.series and results.xdmf.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tunica/field_io/field_file.hpp"

namespace tunica::field_io {

constexpr const char* series_ending = ".hdf.series";
constexpr const char* overview_file = "results.xdmf";

struct SeriesEntry {
  double time;       ///< s
  std::string file;  ///< in the folder of the series
  /// What the file has, for the overview: runs that go on may have other fields than before. Not in the text of a
  /// series.
  std::vector<ArrayHead> points{}, cells{};
};

/// `<folder>/<region>.hdf.series`, a list in JSON that ParaView opens.
std::filesystem::path series_file(const std::filesystem::path& folder, const std::string& region);
/// Names in the same folder.
std::string mesh_file(const std::string& region);
std::string instant_file(const std::string& region, std::int64_t step);

/// Reads what `series_text` made; an empty series when there is no such file. Throws InputError when it is another
/// text, and where in its place there is the .pvd of an earlier version of tunica.
std::vector<SeriesEntry> read_series(const std::filesystem::path& path);
std::string series_text(const std::vector<SeriesEntry>& series);

/// A region as the overview needs it.
struct RegionIndex {
  std::string name;
  std::size_t nodes, elements;
  int nodes_of_cell;
  std::vector<SeriesEntry> series;
};

/// All regions at all times of the first one, for ParaView (XDMF): a block for each region, the mesh named once for
/// each instant and kept in one place.
std::string overview_text(const std::vector<RegionIndex>& regions);

}  // namespace tunica::field_io
