#include "tunica/field_io/series_index.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tunica/base/error.hpp"
#include "tunica/files/outputs.hpp"

namespace tunica::field_io {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

fs::path series_file(const fs::path& folder, const std::string& region) { return folder / (region + series_ending); }
std::string mesh_file(const std::string& region) { return region + "_mesh" + file_ending; }
std::string instant_file(const std::string& region, std::int64_t step) {
  return fmt::format("{}_{:06}{}", region, step, file_ending);
}

namespace {

fs::path earlier_series(fs::path path) {
  return path.replace_extension().replace_extension(".pvd");  // .hdf.series
}

std::string item(const char* type, int bytes, const std::string& dimensions, const std::string& place) {
  return fmt::format("<DataItem Format=\"HDF\" NumberType=\"{}\" Precision=\"{}\" Dimensions=\"{}\">{}</DataItem>",
                     type, bytes, dimensions, place);
}

std::string attribute(const ArrayHead& array, const char* centre, const char* group, std::size_t tuples,
                      const std::string& file) {
  const char* kind = array.components == 1 ? "Scalar" : array.components == 3 ? "Vector" : "Tensor";
  const auto dimensions =
      array.components == 1 ? fmt::format("{}", tuples) : fmt::format("{} {}", tuples, array.components);
  return fmt::format("<Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"{}\">{}</Attribute>\n", array.name, kind,
                     centre, item("Float", 4, dimensions, fmt::format("{}:/VTKHDF/{}/{}", file, group, array.name)));
}

/// In the order in which a file that is read gives them, so that a run that goes on lists them as one that did not
/// stop.
std::vector<ArrayHead> by_name(std::vector<ArrayHead> arrays) {
  std::sort(arrays.begin(), arrays.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return arrays;
}

std::string grid(const RegionIndex& r, const SeriesEntry& instant) {
  const auto corners = r.elements * static_cast<std::size_t>(r.nodes_of_cell);
  const std::string mesh = mesh_file(r.name);
  std::string text = fmt::format(
      "<Grid Name=\"{}\">\n<Topology TopologyType=\"{}\" NumberOfElements=\"{}\">{}</Topology>\n"
      "<Geometry GeometryType=\"XYZ\">{}</Geometry>\n",
      r.name, r.nodes_of_cell == 10 ? "Tetrahedron_10" : "Tetrahedron", r.elements,
      item("Int", 4, fmt::format("{}", corners), mesh + ":/VTKHDF/Connectivity"),
      item("Float", 4, fmt::format("{} 3", r.nodes), mesh + ":/VTKHDF/Points"));
  for (const auto& a : by_name(instant.points)) text += attribute(a, "Node", "PointData", r.nodes, instant.file);
  for (const auto& a : by_name(instant.cells)) text += attribute(a, "Cell", "CellData", r.elements, instant.file);
  return text + "</Grid>\n";
}

}  // namespace

std::vector<SeriesEntry> read_series(const fs::path& path) {
  std::vector<SeriesEntry> series;
  const auto refuse = [](const fs::path& file, const std::string& what, const std::string& cure) {
    throw InputError(file.string(), what, cure);
  };
  if (!fs::exists(path)) {
    if (const fs::path earlier = earlier_series(path); fs::exists(earlier))
      refuse(earlier, "is a series of an earlier version of tunica, which this one does not read",
             "run the case again with --overwrite; ParaView opens the series as it is");
    return series;
  }
  files::refuse_other_than_file(path);
  std::ifstream file(path);
  const auto json = ordered_json::parse(file, nullptr, false);
  const char* cure = "give another results directory, or move this file away";
  if (json.is_discarded()) refuse(path, "is cut off or altered: it is no JSON", cure);
  try {
    for (const auto& entry : json.at("files")) {
      SeriesEntry found{entry.at("time").get<double>(), entry.at("name").get<std::string>()};
      if (!std::isfinite(found.time) || found.file.empty() || found.file.find('/') != std::string::npos)
        throw std::invalid_argument("no entry of a series");
      series.push_back(std::move(found));
    }
  } catch (const std::exception&) {
    refuse(path, "is not a series of results that tunica wrote", cure);
  }
  return series;
}

std::string series_text(const std::vector<SeriesEntry>& series) {
  std::string text = "{\n  \"file-series-version\": \"1.0\",\n  \"files\": [\n";
  for (std::size_t k = 0; k < series.size(); ++k)
    text += fmt::format("    {{\"name\": {}, \"time\": {}}}{}\n", ordered_json(series[k].file).dump(), series[k].time,
                        k + 1 < series.size() ? "," : "");
  return text + "  ]\n}\n";
}

std::string overview_text(const std::vector<RegionIndex>& regions) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n<Domain>\n"
      "<Grid Name=\"results\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  for (std::size_t k = 0; !regions.empty() && k < regions[0].series.size(); ++k) {
    const double time = regions[0].series[k].time;
    text += fmt::format(
        "<Grid Name=\"regions\" GridType=\"Collection\" CollectionType=\"Spatial\">\n<Time Value=\"{}\"/>\n", time);
    for (const auto& r : regions)
      if (k < r.series.size() && r.series[k].time == time) text += grid(r, r.series[k]);
    text += "</Grid>\n";
  }
  return text + "</Grid>\n</Domain>\n</Xdmf>\n";
}

}  // namespace tunica::field_io
