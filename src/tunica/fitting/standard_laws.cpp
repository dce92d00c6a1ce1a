#include "tunica/fitting/standard_laws.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "tunica/base/error.hpp"

namespace tunica::fitting {

namespace {

struct StandardLaw {
  const char *name, *text;
};

// Bounds are wide for the matrix and the fibres of human arteries, so that a fit on one of them is worth a warning.
constexpr StandardLaw laws[] = {
    {"neo_hooke", R"(
material: {neo_hooke: {shear_modulus: $shear_modulus, poisson_ratio: 0.5}}
parameters:
  shear_modulus: {from: 0.1 kPa, to: 2000 kPa, start: 50 kPa}
)"},
    {"mooney_rivlin", R"(
material: {mooney_rivlin: {c1: $c1, c2: $c2, poisson_ratio: 0.5}}
parameters:
  c1: {from: 0.05 kPa, to: 1000 kPa, start: 20 kPa}
  c2: {from: 0 kPa, to: 500 kPa, start: 5 kPa}
)"},
    {"fung", R"(
material:
  fung:
    c: $c
    b_cc: $b_cc
    b_ll: $b_ll
    b_rr: $b_rr
    b_cl: $b_cl
    b_lr: 0
    b_rc: 0
    g_cl: 1
    g_lr: 1
    g_rc: 1
    poisson_ratio: 0.5
parameters:
  c: {from: 0.1 kPa, to: 1000 kPa, start: 30 kPa}
  b_cc: {from: 0.02, to: 100, start: 3}
  b_ll: {from: 0.02, to: 100, start: 3}
  b_rr: {from: 0.02, to: 100, start: 1}
  b_cl: {from: 0, to: 30, start: 0.3}
)"},
    {"hgo", R"(
material:
  hgo:
    shear_modulus: $shear_modulus
    poisson_ratio: 0.5
    families:
      - {k1: $k1, k2: $k2, mean_angle: $angle}
      - {k1: $k1, k2: $k2, mean_angle: -$angle}
parameters:
  shear_modulus: {from: 0.1 kPa, to: 1000 kPa, start: 50 kPa}
  k1: {from: 0.1 kPa, to: 1000 kPa, start: 30 kPa}
  k2: {from: 0, to: 200, start: 10}
  angle: {from: 0 deg, to: 90 deg, start: 40 deg}
)"},
    {"goh", R"(
material:
  goh:
    shear_modulus: $shear_modulus
    poisson_ratio: 0.5
    families:
      - {k1: $k1, k2: $k2, mean_angle: $angle, kappa: $kappa}
      - {k1: $k1, k2: $k2, mean_angle: -$angle, kappa: $kappa}
parameters:
  shear_modulus: {from: 0.1 kPa, to: 1000 kPa, start: 50 kPa}
  k1: {from: 0.1 kPa, to: 2000 kPa, start: 50 kPa}
  k2: {from: 0, to: 400, start: 20}
  angle: {from: 0 deg, to: 90 deg, start: 40 deg}
  kappa: {from: 0, to: 0.3333333333333333, start: 0.2}
)"},
    {"dfd", R"(
material:
  dfd:
    shear_modulus: $shear_modulus
    poisson_ratio: 0.5
    families:
      - {k1: $k1, k2: $k2, bivariate_von_mises: {a: $a, b: $b, mean_angle: $angle}}
      - {k1: $k1, k2: $k2, bivariate_von_mises: {a: $a, b: $b, mean_angle: -$angle}}
parameters:
  shear_modulus: {from: 0.1 kPa, to: 1000 kPa, start: 50 kPa}
  k1: {from: 0.1 kPa, to: 1000 kPa, start: 30 kPa}
  k2: {from: 0, to: 200, start: 10}
  angle: {from: 0 deg, to: 90 deg, start: 40 deg}
  a: {from: 0, to: 30, start: 2.5}
  b: {from: 1, to: 100, start: 20}
)"},
};

/// A quantity of whichever kind a law has: pressure, angle or plain number.
std::optional<std::pair<config::Dimension, double>> read_any(const std::string& text) {
  for (const config::Dimension& d : {config::dimension::none, config::dimension::angle, config::dimension::pressure}) {
    const auto parsed = config::parse_quantity(text, d);
    if (const double* value = std::get_if<double>(&parsed)) return {{d, *value}};
  }
  return std::nullopt;
}

}  // namespace

const std::vector<std::string>& standard_laws() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> n;
    for (const StandardLaw& l : laws) n.emplace_back(l.name);
    return n;
  }();
  return names;
}

std::string standard_law(const std::string& name) {
  const auto at = std::find_if(std::begin(laws), std::end(laws), [&](const StandardLaw& l) { return name == l.name; });
  return at == std::end(laws) ? "" : at->text;
}

Parameter make_parameter(const std::string& name, const ParameterSettings& settings, const std::string& where) {
  Parameter p{.name = name, .own = settings.own};
  const auto read = [&](const char* key, const std::string& text) {
    const auto value = read_any(text);
    if (!value)
      throw InputError(where + "." + key, fmt::format("`{}` is no number, stress or angle", text),
                       "write such as `10`, `10 kPa` or `10 deg`");
    return *value;
  };
  const auto [dimension, low] = read("from", settings.from);
  const auto [other, high] = read("to", settings.to);
  p.dimension = dimension;
  p.low = low;
  p.high = high;
  if (!(dimension == other))
    throw InputError(where,
                     fmt::format("goes from `{}` to `{}`, which are not of one kind", settings.from, settings.to),
                     "give both with the same kind of unit");
  if (!(low < high))
    throw InputError(where, fmt::format("goes from `{}` to `{}`", settings.from, settings.to),
                     "let `from` be smaller than `to`");
  p.start = p.value(0.5);
  if (settings.start.empty()) return p;
  const auto [third, start] = read("start", settings.start);
  if (!(third == dimension) || start < low || start > high)
    throw InputError(where + ".start", fmt::format("`{}` is not between the bounds", settings.start),
                     fmt::format("give a value from {} to {}", settings.from, settings.to));
  p.start = start;
  return p;
}

config::Schema<ParameterSettings> parameter_schema() {
  using P = ParameterSettings;
  return config::Schema<P>("parameter", "A value that is to be found, `$name` or `-$name` in the material.")
      .text("from", &P::from, "Smallest value, with its unit")
      .text("to", &P::to, "Largest value. Searched by the logarithm when it is ten times a positive `from` or more")
      .text("start", &P::start, "First starting value; in the middle when left out")
      .optional()
      .flag("own", &P::own, "Has every specimen a value of its own?")
      .by_default();
}

LawTemplate read_law(const config::Document& law, const std::string& where) {
  struct Section {
    std::vector<std::pair<std::string, ParameterSettings>> parameters;
  };
  const auto schema = config::Schema<Section>("parameters", "Parameters of a law.")
                          .map("parameters", &Section::parameters, parameter_schema(), "Values that are to be found")
                          .by_default();
  config::Document section;
  if (law.has("parameters")) section.set("parameters", law.part("parameters"));
  std::vector<Problem> problems;
  std::vector<Parameter> parameters;
  const auto parsed = config::parse_document(schema, section, {.name = where});
  for (const auto& [name, settings] : parsed.value.parameters) try {
      parameters.push_back(make_parameter(name, settings, where + ".parameters." + name));
    } catch (const InputError& error) {
      problems.insert(problems.end(), error.problems().begin(), error.problems().end());
    }
  if (!problems.empty()) throw InputError(std::move(problems));
  return LawTemplate(law.part("material"), std::move(parameters), where);
}

}  // namespace tunica::fitting
