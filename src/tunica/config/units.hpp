// Physical dimensions and units of the case file. Inside the program every value is SI.
//
//   parse_quantity("0.04 dyn s/cm^2", dimension::dynamic_viscosity)   ->  0.004 (Pa s)
//   unit_factor("mmHg", dimension::pressure)                          ->  133.322...
//
// A unit is a product of symbols with integer powers: "dyn s/cm^2", "Pa*s", "Pa.s", "m^3/s", "s^-1", "1/s". A slash
// divides by the next symbol only; a product by a blank after a slash ("kg/m s") would be ambiguous and is refused.
#pragma once

#include <string>
#include <string_view>
#include <variant>

namespace tunica::config {

/// Exponents of kilogram, metre, second, and of the radian, so that an angle in degrees is not taken for a number.
struct Dimension {
  int kilogram = 0;
  int metre = 0;
  int second = 0;
  int radian = 0;
  friend constexpr bool operator==(const Dimension&, const Dimension&) = default;
};

namespace dimension {
inline constexpr Dimension none{0, 0, 0};
inline constexpr Dimension angle{0, 0, 0, 1};
inline constexpr Dimension length{0, 1, 0};
inline constexpr Dimension area{0, 2, 0};
inline constexpr Dimension volume{0, 3, 0};
inline constexpr Dimension time{0, 0, 1};
inline constexpr Dimension frequency{0, 0, -1};  // also shear rate
inline constexpr Dimension velocity{0, 1, -1};
inline constexpr Dimension acceleration{0, 1, -2};
inline constexpr Dimension mass{1, 0, 0};
inline constexpr Dimension density{1, -3, 0};
inline constexpr Dimension force{1, 1, -2};
inline constexpr Dimension pressure{1, -1, -2};  // also stress, modulus
inline constexpr Dimension dynamic_viscosity{1, -1, -1};
inline constexpr Dimension volume_flow{0, 3, -1};
inline constexpr Dimension resistance{1, -4, -1};          // Pa s/m^3
inline constexpr Dimension compliance{-1, 4, 2};           // m^3/Pa
inline constexpr Dimension stiffness_per_area{1, -2, -2};  // N/m^3
inline constexpr Dimension damping_per_area{1, -2, -1};    // N s/m^3
}  // namespace dimension

/// Why a text is not the wanted quantity, and what to write instead.
struct UnitError {
  std::string what;
  std::string remedy;
};

/// SI value of a number with unit. A dimensionless quantity is a bare number (or a number in %); a bare
/// number where a unit is due is an error.
std::variant<double, UnitError> parse_quantity(std::string_view text, const Dimension& due);

/// SI value of one unit of the wanted dimension.
std::variant<double, UnitError> parse_unit(std::string_view unit, const Dimension& due);

/// As parse_unit, for units of output and of data files. Throws InputError.
double unit_factor(std::string_view unit, const Dimension& due);

std::string name_of(const Dimension& dimension);  ///< "dynamic viscosity"; "kg^a m^b s^c" when it has no name
std::string si_unit(const Dimension& dimension);  ///< "Pa s"; empty for dimensionless
/// Usual units, the SI one first, separated by commas: "Pa s, mPa s, cP, dyn s/cm^2".
std::string usual_units(const Dimension& dimension);
/// "0.004 Pa s": reads back to the same bits.
std::string in_si(double value, const Dimension& dimension);

/// The same digits in another usual unit that fall into [low, high], as "1.06 g/cm^3"; empty when there is none. Finds
/// slips of the unit: 1.06 kg/m^3 for the density of blood.
std::string likely_meant(std::string_view text, const Dimension& dimension, double low, double high);

}  // namespace tunica::config
