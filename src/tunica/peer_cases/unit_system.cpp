#include "tunica/peer_cases/unit_system.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace tunica::peer_cases {

namespace {

// Of millimetre, gram and second follow pascals: 1 g/(mm s^2) = 1 Pa.
constexpr auto systems = std::to_array<UnitSystem>({
    {"cgs", "cm", 1e-2, "g/cm^3", "dyn s/cm^2", "dyn/cm^2", "cm/s", "cm^3/s", "dyn s/cm^5", "cm^5/dyn", "dyn/cm^3",
     "dyn s/cm^3", 1e3},
    {"mmgs", "mm", 1e-3, "g/mm^3", "Pa s", "Pa", "mm/s", "mm^3/s", "Pa s/mm^3", "mm^3/Pa", "Pa/mm", "Pa s/mm", 1e6},
    {"si", "m", 1.0, "kg/m^3", "Pa s", "Pa", "m/s", "m^3/s", "Pa s/m^3", "m^3/Pa", "N/m^3", "N s/m^3", 1.0},
});

constexpr double lightest_blood = 500, heaviest_blood = 2000;  // kg/m^3

bool is_blood(double density) { return density >= lightest_blood && density <= heaviest_blood; }

}  // namespace

const UnitSystem& unit_system(const std::string& name) {
  for (const UnitSystem& system : systems)
    if (name == system.name) return system;
  throw InputError("--units",
                   name.empty() ? std::string("is missing: the file does not say which units its numbers have")
                                : fmt::format("is `{}`", name),
                   "write --units cgs (cm, g, s), --units mmgs (mm, g, s) or --units si (m, kg, s)");
}

std::optional<std::string> scaled_length_unit(const UnitSystem& units, double scale) {
  constexpr std::pair<double, const char*> known[] = {
      {1.0, "m"}, {1e-2, "cm"}, {1e-3, "mm"}, {1e-6, "um"}, {1e3, "km"}};
  const double metres = scale * units.metres;
  for (const auto& [size, unit] : known)
    if (std::abs(metres - size) <= 1e-12 * size) return unit;
  return std::nullopt;
}

void check_blood_density(const UnitSystem& units, double density, const std::string& where,
                         std::vector<Problem>& problems) {
  const double here = density * units.kilograms_per_cubic_metre;
  if (is_blood(here)) return;
  for (const UnitSystem& other : systems)
    if (is_blood(density * other.kilograms_per_cubic_metre))
      problems.push_back(
          {where,
           fmt::format("is {:.6g} kg/m^3 with --units {}, no density of blood; with --units {} it is {:.6g} "
                       "kg/m^3",
                       here, units.name, other.name, density * other.kilograms_per_cubic_metre),
           fmt::format("write --units {}, or correct the density", other.name)});
}

}  // namespace tunica::peer_cases
