#include "tunica/artifacts/dissipation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "tunica/artifacts/histories.hpp"
#include "tunica/base/digits.hpp"
#include "tunica/config/units.hpp"

namespace tunica::artifacts {

namespace fs = std::filesystem;
using case_file::Elements;
using nlohmann::ordered_json;

namespace {

struct PowerColumns {
  std::string part;
  const std::vector<double>*viscous, *numerical;
};

/// "<part> viscous dissipation [W]" beside "<part> numerical dissipation [W]"; without a name it is the whole lumen.
std::vector<PowerColumns> power_columns(const files::CsvColumns& table) {
  const std::string viscous = "viscous dissipation [W]", numerical = "numerical dissipation [W]";
  std::vector<PowerColumns> found;
  for (const auto& header : table.headers) {
    if (!header.ends_with(viscous)) continue;
    const std::string part = header.substr(0, header.size() - viscous.size());
    found.push_back({part.empty() ? "lumen" : part.substr(0, part.size() - 1), &table.column(header),
                     &table.column(part + numerical)});
  }
  return found;
}

}  // namespace

double PartDissipation::ratio() const {
  if (viscous == 0) return numerical == 0 ? 0.0 : std::numeric_limits<double>::infinity();
  return std::abs(numerical / viscous);
}

bool Dissipation::above_limit() const {
  return std::any_of(parts.begin(), parts.end(), [](const auto& p) { return p.above_limit(); });
}

std::vector<std::string> Dissipation::parts_above_limit() const {
  std::vector<std::string> names;
  for (const auto& p : parts)
    if (p.above_limit()) names.push_back(p.part);
  return names;
}

std::optional<Dissipation> read_dissipation(const fs::path& folder, double from, double until, Elements elements) {
  const fs::path by_part = folder / "dissipation.csv";
  const auto powers = files::read_csv(fs::exists(by_part) ? by_part : folder / "balance.csv", history_remedy,
                                      files::Gaps::allowed),
             steps = files::read_csv(folder / "steps.csv", history_remedy, files::Gaps::allowed);
  const auto columns = power_columns(powers);
  const auto ends = si_column(steps, "time", config::dimension::time),
             sizes = si_column(steps, "dt", config::dimension::time);
  // A line may be lost in one of the tables, so lines go together by their step.
  std::map<double, std::size_t> line_of;
  const auto& numbers = powers.column("step");
  for (std::size_t k = 0; k < numbers.size(); ++k) line_of[numbers[k]] = k;
  Dissipation d{0, 0, {}, elements};
  for (const auto& c : columns) d.parts.push_back({c.part});
  bool any = false;
  for (std::size_t k = 0; k < ends.size(); ++k) {
    const double slack = 1e-3 * sizes[k];  // tables have ten digits
    const auto line = line_of.find(steps.column("step")[k]);
    if (ends[k] <= from + slack || ends[k] > until + slack || line == line_of.end()) continue;
    if (!any) d.from = ends[k] - sizes[k];
    d.until = ends[k];
    any = true;
    for (std::size_t p = 0; p < columns.size(); ++p) {
      d.parts[p].viscous += sizes[k] * (*columns[p].viscous)[line->second];
      d.parts[p].numerical += sizes[k] * (*columns[p].numerical)[line->second];
    }
  }
  if (!any) return std::nullopt;
  return d;
}

std::string describe(const Dissipation& d) {
  std::string text = fmt::format("numerical over viscous dissipation from {:.6g} s to {:.6g} s:", d.from, d.until);
  for (std::size_t k = 0; k < d.parts.size(); ++k)
    text += fmt::format("{} {} {:.3g}", k == 0 ? "" : ",", d.parts[k].part, d.parts[k].ratio());
  return text;
}

std::optional<std::string> warning_of(const Dissipation& d) {
  if (!d.above_limit()) return std::nullopt;
  std::string places;
  for (const auto& p : d.parts)
    if (p.above_limit()) places += fmt::format("{}{:.3g} times in: {}", places.empty() ? "" : ", ", p.ratio(), p.part);
  return fmt::format(
      "the scheme takes more than {:g} times what friction takes from the flow ({}): flow, pressure and wall shear "
      "there depend on the mesh; refine it there (more elements across the lumen and the tears){}",
      PartDissipation::limit, places,
      d.elements == Elements::quadratic ? "" : "; linear elements gain far more from `elements: quadratic`");
}

ordered_json to_json(const Dissipation& d) {
  ordered_json parts = ordered_json::array();
  for (const auto& p : d.parts)
    parts.push_back({{"part", p.part},
                     {"viscous_J", p.viscous},
                     {"numerical_J", p.numerical},
                     {"ratio", std::isfinite(p.ratio()) ? ordered_json(p.ratio()) : ordered_json()},
                     {"above_limit", p.above_limit()}});
  return {{"limit", PartDissipation::limit},
          {"from_s", base::without_noise(d.from)},
          {"until_s", base::without_noise(d.until)},
          {"elements", d.elements == Elements::quadratic ? "quadratic" : "linear"},
          {"parts", parts}};
}

Dissipation dissipation_from_json(const ordered_json& json) {
  const auto elements = json.value("elements", "linear") == "quadratic" ? Elements::quadratic : Elements::linear;
  Dissipation d{json.at("from_s"), json.at("until_s"), {}, elements};
  for (const auto& p : json.at("parts")) d.parts.push_back({p.at("part"), p.at("viscous_J"), p.at("numerical_J")});
  return d;
}

}  // namespace tunica::artifacts
