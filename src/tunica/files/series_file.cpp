#include "tunica/files/series_file.hpp"

#include <fmt/format.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>

#include "tunica/base/error.hpp"
#include "tunica/base/text.hpp"
#include "tunica/files/outputs.hpp"

namespace tunica::files {

namespace {

constexpr const char* byte_order = std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";

std::string header_lines(const char* tag, const std::vector<ArrayHeader>& arrays) {
  std::string text = fmt::format("    <{}>\n", tag);
  for (const auto& a : arrays)
    text += fmt::format("      <PDataArray type=\"Float32\" Name=\"{}\" NumberOfComponents=\"{}\"/>\n", a.name,
                        a.components);
  return text + fmt::format("    </{}>\n", tag);
}

/// The value of attribute `name` in `line`, empty when there is none.
std::string attribute(const std::string& line, const std::string& name) {
  const auto begin = line.find(name + "=\"");
  if (begin == std::string::npos) return {};
  const auto from = begin + name.size() + 2;
  const auto end = line.find('"', from);
  return end == std::string::npos ? std::string() : line.substr(from, end - from);
}

}  // namespace

std::vector<SeriesEntry> read_pvd(const std::filesystem::path& path) {
  std::vector<SeriesEntry> series;
  if (!std::filesystem::exists(path)) return series;
  const auto refuse = [&](const std::string& what) {
    throw InputError(path.string(), what, "give another results directory, or move this file away");
  };
  refuse_other_than_file(path);
  std::ifstream file(path);
  if (!file) refuse("cannot be read");
  bool complete = false;
  for (std::string line; std::getline(file, line);) {
    complete |= line.find("</VTKFile>") != std::string::npos;
    if (line.find("<DataSet") == std::string::npos) continue;
    SeriesEntry entry{0, attribute(line, "file")};
    const auto time = attribute(line, "timestep");
    const auto [end, error] = std::from_chars(time.data(), time.data() + time.size(), entry.time);
    if (entry.file.empty() || time.empty() || error != std::errc() || end != time.data() + time.size() ||
        !std::isfinite(entry.time))
      refuse("is not a series that can be continued: " + text::printable(line));
    series.push_back(std::move(entry));
  }
  if (!complete) refuse("is not a complete .pvd file");
  return series;
}

std::string pvd_text(const std::vector<SeriesEntry>& series) {
  std::string text = fmt::format(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"{}\">\n  <Collection>\n",
      byte_order);
  for (const auto& entry : series)
    text += fmt::format("    <DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", entry.time, entry.file);
  return text + "  </Collection>\n</VTKFile>\n";
}

std::string pvtu_text(const std::vector<ArrayHeader>& nodal, const std::vector<ArrayHeader>& cells,
                      const std::vector<std::string>& pieces) {
  std::string text = fmt::format(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PUnstructuredGrid\" version=\"0.1\" byte_order=\"{}\">\n"
      "  <PUnstructuredGrid GhostLevel=\"0\">\n",
      byte_order);
  text +=
      header_lines("PPointData", nodal) + header_lines("PCellData", cells) + header_lines("PPoints", {{"Points", 3}});
  for (const auto& piece : pieces) text += fmt::format("    <Piece Source=\"{}\"/>\n", piece);
  return text + "  </PUnstructuredGrid>\n</VTKFile>\n";
}

}  // namespace tunica::files
