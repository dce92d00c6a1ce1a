#include "tunica/config/units.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "tunica/base/error.hpp"
#include "tunica/config/nearest.hpp"

namespace tunica::config {
namespace {

struct Unit {
  double factor = 1.0;
  Dimension dimension;
};

struct Symbol {
  const char* name;
  double factor;
  Dimension dimension;
  const char* prefixes;  // the SI prefixes that are in use with it
};

constexpr double millimetre_of_mercury = 133.322387415;  // conventional: 13595.1 kg/m^3 * 9.80665 m/s^2 * 1 mm
constexpr double centimetre_of_water = 98.0665;

// u stands for micro.
constexpr auto symbols = std::to_array<Symbol>({
    {"m", 1.0, dimension::length, "kcmun"},
    {"s", 1.0, dimension::time, "mun"},
    {"min", 60.0, dimension::time, ""},
    {"h", 3600.0, dimension::time, ""},
    {"Hz", 1.0, dimension::frequency, "kM"},
    {"g", 1e-3, dimension::mass, "kmu"},
    {"N", 1.0, dimension::force, "kmu"},
    {"dyn", 1e-5, dimension::force, ""},
    {"Pa", 1.0, dimension::pressure, "hkMGm"},
    {"bar", 1e5, dimension::pressure, "m"},
    {"Ba", 0.1, dimension::pressure, ""},
    {"mmHg", millimetre_of_mercury, dimension::pressure, ""},
    {"cmH2O", centimetre_of_water, dimension::pressure, ""},
    {"P", 0.1, dimension::dynamic_viscosity, "cm"},
    {"L", 1e-3, dimension::volume, "cmu"},
    {"l", 1e-3, dimension::volume, "cmu"},
    {"J", 1.0, {1, 2, -2}, "mu"},
    {"W", 1.0, {1, 2, -3}, "m"},
    {"rad", 1.0, dimension::angle, "m"},
    {"deg", std::numbers::pi / 180.0, dimension::angle, ""},
    {"%", 0.01, dimension::none, ""},
    {"1", 1.0, dimension::none, ""},
});

double prefix_factor(char prefix) {
  switch (prefix) {
    case 'n':
      return 1e-9;
    case 'u':
      return 1e-6;
    case 'm':
      return 1e-3;
    case 'c':
      return 1e-2;
    case 'h':
      return 1e2;
    case 'k':
      return 1e3;
    case 'M':
      return 1e6;
    default:
      return 1e9;  // 'G', the only other one in the table
  }
}

struct Named {
  Dimension dimension;
  const char* name;
  const char* usual;  // the first one is SI
};

constexpr auto named = std::to_array<Named>({
    {dimension::none, "number", ""},
    {dimension::angle, "angle", "rad, deg"},
    {dimension::length, "length", "m, cm, mm, um"},
    {dimension::area, "area", "m^2, cm^2, mm^2"},
    {dimension::volume, "volume", "m^3, cm^3, mm^3, L, ml"},
    {dimension::time, "time", "s, ms"},
    {dimension::frequency, "frequency or rate", "1/s"},
    {dimension::velocity, "velocity", "m/s, cm/s, mm/s"},
    {dimension::acceleration, "acceleration", "m/s^2, cm/s^2"},
    {dimension::mass, "mass", "kg, g"},
    {dimension::density, "density", "kg/m^3, g/cm^3"},
    {dimension::force, "force", "N, dyn"},
    {dimension::pressure, "pressure or stress", "Pa, kPa, MPa, mmHg, dyn/cm^2"},
    {dimension::dynamic_viscosity, "dynamic viscosity", "Pa s, mPa s, P, cP, dyn s/cm^2"},
    {dimension::volume_flow, "volume flow", "m^3/s, cm^3/s, ml/s, L/min, ml/min"},
    {dimension::resistance, "flow resistance", "Pa s/m^3, dyn s/cm^5, mmHg s/ml"},
    {dimension::compliance, "compliance", "m^3/Pa, cm^5/dyn, ml/mmHg"},
    {dimension::stiffness_per_area, "stiffness per area", "N/m^3, dyn/cm^3"},
    {dimension::damping_per_area, "damping per area", "N s/m^3, dyn s/cm^3"},
});

const Named* find_name(const Dimension& d) {
  for (const Named& n : named)
    if (n.dimension == d) return &n;
  return nullptr;
}

std::vector<std::string> split_usual(const Dimension& d) {
  std::vector<std::string> units;
  std::string_view rest = find_name(d) ? find_name(d)->usual : "";
  while (!rest.empty()) {
    const std::size_t comma = rest.find(", ");
    units.emplace_back(rest.substr(0, comma));
    rest = comma == std::string_view::npos ? std::string_view() : rest.substr(comma + 2);
  }
  return units;
}

std::optional<Unit> find_symbol(std::string_view name) {
  for (const Symbol& s : symbols)
    if (name == s.name) return Unit{s.factor, s.dimension};
  if (name.size() < 2) return std::nullopt;
  for (const Symbol& s : symbols)
    if (name.substr(1) == s.name && std::string_view(s.prefixes).find(name[0]) != std::string_view::npos) {
      return Unit{prefix_factor(name[0]) * s.factor, s.dimension};
    }
  return std::nullopt;
}

std::vector<std::string> all_symbols() {
  std::vector<std::string> names;
  for (const Symbol& s : symbols) {
    names.emplace_back(s.name);
    for (const char* p = s.prefixes; *p; ++p) names.push_back(*p + std::string(s.name));
  }
  return names;
}

std::string replace_all(const std::string& text, std::string_view what, std::string_view by) {
  std::string result;
  std::size_t from = 0;
  for (std::size_t at; (at = text.find(what, from)) != std::string::npos; from = at + what.size())
    result.append(text, from, at - from).append(by);
  return result.append(text, from, std::string::npos);
}

// Other spellings: micro sign and Greek mu, superscripts, multiplication dot.
std::string plain_ascii(std::string_view unit) {
  std::string text(unit);
  constexpr std::pair<const char*, const char*> spellings[] = {
      {"\u00b5", "u"},  {"\u03bc", "u"},  {"\u00b7", "*"},  {"\u207b", "^-"},
      {"\u00b9", "^1"}, {"\u00b2", "^2"}, {"\u00b3", "^3"}, {"^-^", "^-"},
  };
  for (const auto& [what, by] : spellings) text = replace_all(text, what, by);
  return text;
}

// Recursive descent over  symbol[^power] { (blank | * | . | /) symbol[^power] }.
class UnitParser {
 public:
  explicit UnitParser(std::string_view unit) : original_(unit), text_(plain_ascii(unit)) {}

  std::variant<Unit, UnitError> parse() {
    Unit unit;
    bool divided = false, first = true;
    while (true) {
      const Separator separator = read_separator();
      if (at_ == text_.size()) {
        if (separator == Separator::blank || first) break;
        return UnitError{fmt::format("unit `{}` ends with an operator", original_), "write the unit after it"};
      }
      if (separator == Separator::blank && divided) {
        return UnitError{fmt::format("unit `{}` is ambiguous: a product after a slash", original_),
                         "put every divisor after its own slash, products first: `kg/m/s`, `N s/m^3`"};
      }
      if (auto error = multiply(unit, separator == Separator::slash ? -1 : 1)) return *error;
      divided = separator == Separator::slash;
      first = false;
    }
    return unit;
  }

 private:
  enum class Separator { blank, product, slash };

  Separator read_separator() {
    Separator separator = Separator::blank;
    for (; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (c == ' ' || c == '\t') continue;
      if (separator != Separator::blank || (c != '*' && c != '.' && c != '/')) break;
      separator = c == '/' ? Separator::slash : Separator::product;
    }
    return separator;
  }

  std::optional<UnitError> multiply(Unit& unit, int sign) {
    const std::size_t end = std::min(text_.find_first_of(" \t*./^", at_), text_.size());
    const std::string name = text_.substr(at_, end - at_);
    const std::optional<Unit> symbol = find_symbol(name);
    if (!symbol) return unknown(name);
    at_ = end;
    int power = 1;
    if (at_ < text_.size() && text_[at_] == '^') {
      const char* begin = text_.data() + at_ + 1;
      const auto [stop, failure] = std::from_chars(begin, text_.data() + text_.size(), power);
      if (failure != std::errc() || power > 9 || power < -9)  // the absolute value of the smallest int is none
        return UnitError{fmt::format("power in unit `{}` is not a small integer", original_),
                         "write e.g. `cm^2`, `s^-1`"};
      at_ += 1 + (stop - begin);
    }
    power *= sign;
    unit.factor *= std::pow(symbol->factor, power);
    unit.dimension.kilogram += power * symbol->dimension.kilogram;
    unit.dimension.metre += power * symbol->dimension.metre;
    unit.dimension.second += power * symbol->dimension.second;
    unit.dimension.radian += power * symbol->dimension.radian;
    return std::nullopt;
  }

  UnitError unknown(const std::string& name) const {
    UnitError error{fmt::format("unit `{}` is not known", name.empty() ? original_ : name), ""};
    const std::size_t digit = name.find_first_of("0123456789");
    if (digit != std::string::npos && digit > 0 && find_symbol(name.substr(0, digit))) {
      error.remedy = fmt::format("write powers with ^: `{}^{}`", name.substr(0, digit), name.substr(digit));
      return error;
    }
    const std::vector<std::string> names = all_symbols();
    const std::string meant = nearest(name, names);
    if (!meant.empty()) error.remedy = fmt::format("did you mean `{}`?", meant);
    return error;
  }

  std::string original_, text_;
  std::size_t at_ = 0;
};

std::string advice(const Dimension& due) {
  if (due == dimension::none) return "write a number without unit";
  const std::string units = usual_units(due);
  return units.empty() ? fmt::format("use a unit of dimension {}", name_of(due)) : fmt::format("use one of: {}", units);
}

// "a length", "an area"
std::string with_article(const Dimension& d) {
  const std::string name = name_of(d);
  return (name[0] == 'a' ? "an " : "a ") + name;
}

std::string_view trim(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\n");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\n") - begin + 1);
}

struct Split {
  double number;
  std::string_view unit;
};

std::optional<Split> split_number(std::string_view text) {
  text = trim(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  double number = 0.0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (failure != std::errc() || !std::isfinite(number)) return std::nullopt;
  return Split{number, trim(text.substr(end - text.data()))};
}

/// The value in SI, unless it has lost digits or itself beyond the ends of what a number holds (1e-320 s, 1e308 km).
std::variant<double, UnitError> representable(double value, std::string_view text) {
  if (value == 0.0 || std::isnormal(value)) return value;
  return UnitError{fmt::format("`{}` is too {} for a number", trim(text), std::isinf(value) ? "large" : "close to 0"),
                   "write a value between 1e-307 and 1e308 in SI units, or 0"};
}

}  // namespace

std::variant<double, UnitError> parse_unit(std::string_view unit, const Dimension& due) {
  auto parsed = UnitParser(trim(unit)).parse();
  if (auto* error = std::get_if<UnitError>(&parsed)) {
    if (error->remedy.empty()) error->remedy = advice(due);
    return *error;
  }
  const Unit& found = std::get<Unit>(parsed);
  if (found.dimension == due) return found.factor;
  return UnitError{
      fmt::format("`{}` is the unit of {}, not of {}", trim(unit), with_article(found.dimension), with_article(due)),
      advice(due)};
}

std::variant<double, UnitError> parse_quantity(std::string_view text, const Dimension& due) {
  const std::optional<Split> split = split_number(text);
  if (!split) {
    const std::string example =
        due == dimension::none ? "a number" : fmt::format("a number and a unit, `1 {}`", si_unit(due));
    return UnitError{fmt::format("`{}` is not {}", trim(text), with_article(due)), fmt::format("write {}", example)};
  }
  if (split->unit.empty()) {
    if (due == dimension::none) return representable(split->number, text);
    return UnitError{fmt::format("`{}` has no unit; {} is due", trim(text), with_article(due)), advice(due)};
  }
  auto factor = parse_unit(split->unit, due);
  if (auto* error = std::get_if<UnitError>(&factor)) return *error;
  return representable(split->number * std::get<double>(factor), text);
}

double unit_factor(std::string_view unit, const Dimension& due) {
  auto factor = parse_unit(unit, due);
  if (auto* error = std::get_if<UnitError>(&factor))
    throw InputError(fmt::format("unit `{}`", unit), error->what, error->remedy);
  return std::get<double>(factor);
}

std::string name_of(const Dimension& d) {
  if (const Named* n = find_name(d)) return n->name;
  return "quantity in " + si_unit(d);
}

std::string si_unit(const Dimension& d) {
  if (d == dimension::none) return "";
  const std::vector<std::string> units = split_usual(d);
  if (!units.empty()) return units.front();
  std::string text;
  for (const auto& [symbol, power] : {std::pair{"kg", d.kilogram}, {"m", d.metre}, {"s", d.second}, {"rad", d.radian}})
    if (power != 0)
      text += fmt::format("{}{}{}", text.empty() ? "" : " ", symbol, power == 1 ? "" : fmt::format("^{}", power));
  return text;
}

std::string usual_units(const Dimension& d) { return find_name(d) ? find_name(d)->usual : si_unit(d); }

std::string in_si(double value, const Dimension& d) {
  const std::string unit = si_unit(d);
  return unit.empty() ? fmt::format("{}", value) : fmt::format("{} {}", value, unit);
}

std::string likely_meant(std::string_view text, const Dimension& d, double low, double high) {
  const std::optional<Split> split = split_number(text);
  if (!split) return "";
  for (const std::string& unit : split_usual(d)) {
    const double value = split->number * std::get<double>(parse_unit(unit, d));
    if (unit != split->unit && value >= low && value <= high) return fmt::format("{} {}", split->number, unit);
  }
  return "";
}

}  // namespace tunica::config
