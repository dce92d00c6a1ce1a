#include <fmt/format.h>

#include <cmath>

#include "tunica/files/atomic_file.hpp"
#include "tunica/stages/post/report_files.hpp"
#include "tunica/stages/post/report_json.hpp"

namespace tunica::stages::post {

namespace {

/// Columns of equal length under one header line.
class Table {
 public:
  void add(const std::string& header, std::vector<double> values, double unit = 1) {
    for (auto& v : values) v /= unit;
    headers_.push_back(header);
    columns_.push_back(std::move(values));
  }
  std::string text() const {
    std::string text;
    for (std::size_t c = 0; c < headers_.size(); ++c) text += (c == 0 ? "" : ",") + headers_[c];
    text += "\n";
    for (std::size_t r = 0; r < columns_[0].size(); ++r) {
      for (std::size_t c = 0; c < columns_.size(); ++c)
        text += fmt::format("{}{:.8g}", c == 0 ? "" : ",", columns_[c][r]);
      text += "\n";
    }
    return text;
  }

 private:
  std::vector<std::string> headers_;
  std::vector<std::vector<double>> columns_;
};

Table table_in_time(const Findings& f) {
  Table table;
  table.add("time [s]", f.times);
  return table;
}

Table tears(const LumenFlows& lumens) {
  Table table;
  table.add("time [s]", lumens.times);
  for (const auto& tear : lumens.tears) table.add(tear.place.name + " flow [ml/s]", tear.flow, unit::ml);
  table.add("out of false lumen by its openings [ml/s]", lumens.outflow, unit::ml);
  table.add("through the wall of the false lumen [ml/s]", lumens.leakage, unit::ml);
  table.add("false lumen dV/dt [ml/s]", lumens.volume_rate, unit::ml);
  table.add("false lumen volume [ml]", lumens.volume, unit::ml);
  table.add("true lumen volume [ml]", lumens.true_volume, unit::ml);
  return table;
}

Table tear_areas(const Findings& f) {
  Table table = table_in_time(f);
  for (const auto& tear : f.vessel.tears)
    table.add(tear.name + " area [mm^2]", f.figures.column(analysis::column::tear(tear.name, "area")), unit::mm2);
  return table;
}

/// One quantity of one lumen: time down, stations across.
Table along_and_in_time(const Findings& f, std::size_t lumen, const char* what, const std::string& label, double unit) {
  Table table = table_in_time(f);
  for (std::size_t s = 0; s < f.vessel.stations.size(); ++s)
    if (!f.vessel.stations[s].sections[lumen].empty())
      table.add(fmt::format("{:g} mm {}", f.vessel.stations[s].distance / unit::mm, label),
                f.figures.column(analysis::column::station(s, lumen, what)), unit);
  return table;
}

Table pressure_difference(const Findings& f) {
  Table table = table_in_time(f);
  for (std::size_t s = 0; s < f.vessel.stations.size(); ++s) {
    const auto& station = f.vessel.stations[s];
    if (station.sections[0].empty() || station.sections[1].empty()) continue;
    auto difference = f.figures.column(analysis::column::station(s, 0, "pressure"));
    const auto other = f.figures.column(analysis::column::station(s, 1, "pressure"));
    for (std::size_t k = 0; k < other.size(); ++k) difference[k] -= other[k];
    table.add(fmt::format("{:g} mm [mmHg]", station.distance / unit::mm), difference, unit::mmHg);
  }
  return table;
}

/// One line for each station: means and extremes over the window. Empty sections give nan.
Table station_table(const Findings& f) {
  Table table;
  const auto n = f.vessel.stations.size();
  const auto of_stations = [&](const auto& get) {
    std::vector<double> values;
    for (std::size_t s = 0; s < n; ++s) values.push_back(get(s));
    return values;
  };
  table.add("distance [mm]", of_stations([&](auto s) { return f.vessel.stations[s].distance; }), unit::mm);
  for (int c = 0; c < 3; ++c)
    table.add(fmt::format("{} [mm]", "xyz"[c]), of_stations([&](auto s) { return f.vessel.stations[s].centre[c]; }),
              unit::mm);
  for (std::size_t lumen = 0; lumen < 2; ++lumen) {
    if (lumen == 1 && f.vessel.side.empty()) continue;
    const auto add = [&](const char* what, const char* label, double unit) {
      const auto statistic = [&](const char* name, double analysis::Course::*member) {
        table.add(
            fmt::format("{} {} {} [{}]", analysis::lumen_names[lumen], what, name, label), of_stations([&](auto s) {
              if (f.vessel.stations[s].sections[lumen].empty()) return std::nan("");
              return analysis::course(f.times, f.figures.column(analysis::column::station(s, lumen, what))).*member;
            }),
            unit);
      };
      statistic("mean", &analysis::Course::mean);
      statistic("largest", &analysis::Course::largest);
      statistic("smallest", &analysis::Course::smallest);
    };
    add("area", "mm^2", unit::mm2);
    add("pressure", "mmHg", unit::mmHg);
    add("flow", "ml/s", unit::ml);
  }
  return table;
}

Table stress(const Findings& f) {
  Table table = table_in_time(f);
  for (const auto& part : f.frames.wall_parts())
    for (const auto& quantity : f.frames.stresses()) {
      if (std::isnan(f.figures.column(analysis::column::stress(part.name, quantity, "mean"))[0])) continue;
      for (const double p : f.settings.percentiles)
        table.add(fmt::format("{} {} p{:g} [kPa]", part.name, quantity, p),
                  f.figures.column(analysis::column::stress(part.name, quantity, fmt::format("{:g}", p))), unit::kPa);
    }
  return table;
}

}  // namespace

std::vector<std::string> write_tables(const Findings& f, const std::filesystem::path& folder) {
  std::vector<std::string> files;
  const auto write = [&](const std::string& name, const Table& table) {
    files::write_atomically(folder / name, table.text());
    files.push_back(name);
  };
  if (f.has_stations()) {
    write("stations.csv", station_table(f));
    for (std::size_t lumen = 0; lumen < (f.vessel.side.empty() ? 1U : 2U); ++lumen) {
      const std::string name = analysis::lumen_names[lumen];
      write(name + "_pressure.csv", along_and_in_time(f, lumen, "pressure", "[mmHg]", unit::mmHg));
      write(name + "_area.csv", along_and_in_time(f, lumen, "area", "[mm^2]", unit::mm2));
      write(name + "_flow.csv", along_and_in_time(f, lumen, "flow", "[ml/s]", unit::ml));
    }
    if (!f.vessel.side.empty()) write("pressure_difference.csv", pressure_difference(f));
  }
  if (f.lumens) write("tears.csv", tears(*f.lumens));
  if (!f.vessel.tears.empty()) write("tear_areas.csv", tear_areas(f));
  if (f.has_flap()) {
    Table table = table_in_time(f);
    table.add("mean displacement [mm]", f.figures.column(analysis::column::flap_mean), unit::mm);
    table.add("largest displacement [mm]", f.figures.column(analysis::column::flap_largest), unit::mm);
    write("flap.csv", table);
  }
  if (!f.frames.stresses().empty()) write("stress.csv", stress(f));
  return files;
}

}  // namespace tunica::stages::post
