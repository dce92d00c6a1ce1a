// What the scheme takes from the flow beside what friction takes, by part of the vessel: read from the histories of a
// run. Where it is much, the flow is that of a more viscous blood.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tunica/case/case.hpp"

namespace tunica::artifacts {

struct PartDissipation {
  /// Numerical over viscous dissipation above which flow and pressure of a part are not to be relied on.
  static constexpr double limit = 0.5;

  std::string part;
  double viscous = 0, numerical = 0;  ///< over the time [J]

  /// Of their magnitudes; infinite where friction takes nothing, zero where nothing does.
  double ratio() const;
  bool above_limit() const { return ratio() > limit; }
};

struct Dissipation {
  double from = 0, until = 0;  ///< of the steps that the histories hold [s]
  std::vector<PartDissipation> parts;
  case_file::Elements elements = case_file::Elements::quadratic;  ///< of the run: the remedy depends on them

  bool above_limit() const;
  /// Names of the parts above the limit.
  std::vector<std::string> parts_above_limit() const;
};

/// Integrals over the steps that end after `from` and not after `until` [s]: of dissipation.csv, by part, or of
/// balance.csv, where the only part is "lumen", in a folder without it. None where the histories hold no such step.
/// Throws InputError when a history cannot be read. Not collective.
std::optional<Dissipation> read_dissipation(const std::filesystem::path& folder, double from, double until,
                                            case_file::Elements elements);

/// For the log: the ratios of all parts, and a warning for those above the limit; none where all keep it.
std::string describe(const Dissipation& dissipation);
std::optional<std::string> warning_of(const Dissipation& dissipation);

/// {limit, from_s, until_s, elements, parts: [{part, viscous_J, numerical_J, ratio, above_limit}]}, and back. A ratio
/// that is not finite is null; elements: linear or quadratic. Throws std::exception for another layout.
nlohmann::ordered_json to_json(const Dissipation& dissipation);
Dissipation dissipation_from_json(const nlohmann::ordered_json& json);

}  // namespace tunica::artifacts
