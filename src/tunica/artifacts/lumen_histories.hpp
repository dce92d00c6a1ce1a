// Histories of true and false lumen: what passes the tears, and what friction and the scheme take from the flow.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tunica/analysis/lumens.hpp"
#include "tunica/artifacts/histories.hpp"
#include "tunica/case/case.hpp"
#include "tunica/coupling/lumen_fluxes.hpp"

namespace tunica::artifacts {

/// - lumens.csv: flow into the false lumen through each tear, its outflow by openings, leakage of its wall, dV/dt,
///   volumes of both lumens, and what is left of the balance;
/// - dissipation.csv: viscous and numerical dissipation of each part of the lumen;
/// - lumens.json: names, centres and areas of the tears, in mm.
/// A folder of a version that did not write them is continued: they begin with the restart. Not collective.
class LumenHistories {
 public:
  /// Throws as CsvTable.
  LumenHistories(const std::filesystem::path& folder, const case_file::OutputUnits& units,
                 const analysis::Lumens& lumens, std::optional<std::int64_t> continue_from);

  /// `evaluated`: time that the record belongs to [s].
  void append(std::int64_t step, double evaluated, const coupling::LumenRecord& record);
  void sync() const;
  std::vector<std::string> damage() const;

 private:
  double per_second_, per_flow_, per_volume_;
  std::vector<std::string> begun_;  ///< files that a continued run lacks
  std::optional<CsvTable> lumens_, dissipation_;
};

/// What a run has written of its lumens, in SI.
struct LumenSeries {
  files::CsvColumns table;    ///< lumens.csv as it stands
  std::vector<double> times;  ///< s
  std::vector<analysis::TearPlace> tears;
  std::vector<std::vector<double>> tear_flows;  ///< [tear][line] into the false lumen [m^3/s]
  /// Of the false lumen: flow by its openings, leakage of its wall, dV/dt [m^3/s], volume [m^3]; volume of the true
  /// one.
  std::vector<double> outflow, leakage, volume_rate, volume, true_volume;
};
/// None where lumens.csv or lumens.json is not there. Throws InputError where they do not read or do not fit together.
std::optional<LumenSeries> read_lumens(const std::filesystem::path& folder);

}  // namespace tunica::artifacts
