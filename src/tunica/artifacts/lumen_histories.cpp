#include "tunica/artifacts/lumen_histories.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tunica/base/error.hpp"
#include "tunica/config/json_text.hpp"
#include "tunica/config/units.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/files/outputs.hpp"

namespace tunica::artifacts {

namespace dimension = config::dimension;
namespace fs = std::filesystem;

namespace {

std::string tears_json(const analysis::Lumens& lumens) {
  nlohmann::ordered_json tears = nlohmann::ordered_json::array();
  for (const auto& tear : lumens.tears)
    tears.push_back({{"name", tear.name},
                     {"centre_mm", {1e3 * tear.centre[0], 1e3 * tear.centre[1], 1e3 * tear.centre[2]}},
                     {"area_mm2", 1e6 * tear.area}});
  return config::json_text(nlohmann::ordered_json{{"tears", tears}});
}

}  // namespace

LumenHistories::LumenHistories(const fs::path& folder, const case_file::OutputUnits& units,
                               const analysis::Lumens& lumens, std::optional<std::int64_t> continue_from)
    : per_second_(1 / config::unit_factor(units.time, dimension::time)),
      per_flow_(1 / config::unit_factor(units.flow, dimension::volume_flow)),
      per_volume_(std::pow(config::unit_factor(units.length, dimension::length), -3)) {
  const std::string time = fmt::format("time [{}]", units.time), flow = fmt::format("[{}]", units.flow),
                    volume = fmt::format("[{}^3]", units.length);
  const auto open = [&](std::optional<CsvTable>& table, const char* name, const std::vector<std::string>& columns) {
    table.emplace(later_history(folder / name, columns, continue_from, begun_));
  };
  std::vector<std::string> of_lumens{time}, of_parts{time};
  for (const auto& tear : lumens.map.tears) of_lumens.push_back(tear + " flow " + flow);
  of_lumens.insert(of_lumens.end(),
                   {"false lumen outflow " + flow, "false lumen wall leakage " + flow, "false lumen dV/dt " + flow,
                    "false lumen volume " + volume, "true lumen volume " + volume, "false lumen residual " + flow,
                    "relative residual"});
  for (const auto& part : lumens.map.parts)
    of_parts.insert(of_parts.end(), {part + " viscous dissipation [W]", part + " numerical dissipation [W]"});
  open(lumens_, "lumens.csv", of_lumens);
  open(dissipation_, "dissipation.csv", of_parts);
  files::write_atomically(folder / "lumens.json", tears_json(lumens));
}

void LumenHistories::append(std::int64_t step, double evaluated, const coupling::LumenRecord& r) {
  std::vector<double> line{per_second_ * evaluated};
  for (const double flow : r.tear_flows) line.push_back(per_flow_ * flow);
  line.insert(line.end(),
              {per_flow_ * r.in_false.outflow, per_flow_ * r.in_false.leakage, per_flow_ * r.in_false.volume_rate,
               per_volume_ * r.in_false.volume, per_volume_ * r.true_volume, per_flow_ * r.residual,
               r.largest_flow > 0 ? std::abs(r.residual) / r.largest_flow : 0.0});
  lumens_->append(step, line);
  line.resize(1);
  for (std::size_t part = 0; part < r.viscous.size(); ++part)
    line.insert(line.end(), {r.viscous[part], r.numerical[part]});
  dissipation_->append(step, line);
}

void LumenHistories::sync() const {
  lumens_->sync();
  dissipation_->sync();
}

std::vector<std::string> LumenHistories::damage() const {
  std::vector<std::string> all = begun_;
  for (const auto* table : {&lumens_, &dissipation_})
    all.insert(all.end(), (*table)->damage().begin(), (*table)->damage().end());
  return all;
}

std::optional<LumenSeries> read_lumens(const fs::path& folder) {
  const fs::path json_file = folder / "lumens.json";
  if (!fs::exists(folder / "lumens.csv") || !fs::exists(json_file)) return std::nullopt;
  LumenSeries series;
  series.table = files::read_csv(folder / "lumens.csv", history_remedy);
  files::refuse_other_than_file(json_file);
  std::ifstream in(json_file);
  try {
    const auto json = nlohmann::json::parse(in);
    for (const auto& tear : json.at("tears")) {
      const std::array<double, 3> centre = tear.at("centre_mm");
      series.tears.push_back({tear.at("name"),
                              {{1e-3 * centre[0], 1e-3 * centre[1], 1e-3 * centre[2]}},
                              1e-6 * tear.at("area_mm2").get<double>()});
    }
  } catch (const nlohmann::json::exception&) {
    throw InputError(json_file.string(), "is not what a run writes", history_remedy);
  }
  const auto column = [&](const std::string& name, const config::Dimension& due) {
    return si_column(series.table, name, due);
  };
  series.times = column("time", dimension::time);
  for (const auto& tear : series.tears)
    series.tear_flows.push_back(column(tear.name + " flow", dimension::volume_flow));
  series.outflow = column("false lumen outflow", dimension::volume_flow);
  series.leakage = column("false lumen wall leakage", dimension::volume_flow);
  series.volume_rate = column("false lumen dV/dt", dimension::volume_flow);
  series.volume = column("false lumen volume", dimension::volume);
  series.true_volume = column("true lumen volume", dimension::volume);
  return series;
}

}  // namespace tunica::artifacts
