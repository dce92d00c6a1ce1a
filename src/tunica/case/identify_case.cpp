#include "tunica/case/identify_case.hpp"

#include <fmt/format.h>

#include "tunica/case/descriptions.hpp"
#include "tunica/case/keys.hpp"

namespace tunica::case_file {

namespace {

using config::Problems;
using config::Schema;

Schema<IdentifiedKey> identified_key_schema() {
  return Schema<IdentifiedKey>("parameter", "A positive value that is found within bounds.")
      .texts("keys", &IdentifiedKey::keys, "Key of the case whose value it is; several have the same value")
      .by_default()
      .texts("factor_on", &IdentifiedKey::factor_on, "Keys of the case whose values it multiplies")
      .by_default()
      .texts("between", &IdentifiedKey::between, "Bounds, in one unit; without unit for a factor")
      .text("start", &IdentifiedKey::start,
            "First value, in the unit of the bounds; that of the case when left out, 1 for a factor")
      .optional()
      .check([](const IdentifiedKey& k, Problems& problems) {
        if (k.keys.empty() == k.factor_on.empty())
          problems.add("", k.keys.empty() ? "names no key" : "has both `keys` and `factor_on`",
                       "give one: `keys: wall.density`, or `factor_on: [wall.material.dfd.k1]`");
        if (k.between.size() != 2)
          problems.add("between", fmt::format("has {} entries", k.between.size()), "write `between: [0.1 MPa, 4 MPa]`");
      });
}

}  // namespace

Schema<IdentifyCase> IdentifyCase::schema() {
  return Schema<IdentifyCase>("identify", "Values of some keys of a case, found from what was measured.")
      .text("title", &IdentifyCase::title, "Of the page of results")
      .by_default()
      .file("case", &IdentifyCase::case_file, "The case file; it needs the sections `post` and `measured`")
      .map("parameters", &IdentifyCase::parameters, identified_key_schema(),
           "What is found, by name, as in `support: {keys: boundary.wall_outer.support.stiffness, between: [1e6 "
           "N/m^3, 1e8 N/m^3]}`")
      .texts("measurements", &IdentifyCase::measurements,
             "Patterns of what it is found from, as in `areas/*` or `displacements/flap`; none: all of `measured`")
      .by_default()
      .number("tolerance", &IdentifyCase::tolerance, config::between(0, 0.5),
              "It ends when no parameter would change by a larger share")
      .by_default()
      .number("difference", &IdentifyCase::difference, config::between(0, 0.5),
              "Share by which a parameter is changed for the derivatives")
      .by_default()
      .integer("independent_values", &IdentifyCase::independent_values, config::range(1, 10000),
               "How many independent values a measured curve counts for at most: neighbouring points have errors in "
               "common")
      .by_default()
      .integer("max_runs", &IdentifyCase::max_runs, config::range(3, 10000), "Most runs of the case")
      .by_default()
      .path("output", &IdentifyCase::output, "Folder of the results, relative to that of the file")
      .by_default("identify")
      .check([](const IdentifyCase& c, Problems& problems) {
        if (c.parameters.empty())
          problems.add("parameters", "names none",
                       "add `support: {keys: boundary.wall_outer.support.stiffness, between: [1e6 N/m^3, 1e8 N/m^3]}`");
        check_keys("parameters", c.parameters, "parameter", problems);
        const auto least = c.parameters.size() + 2;
        if (static_cast<std::size_t>(c.max_runs) < least)
          problems.add("max_runs",
                       fmt::format("is {}: one run at the start, one for each derivative and a step", c.max_runs),
                       fmt::format("allow {} or more", least));
      });
}

config::Parsed<IdentifyCase> read_identify_case(const std::filesystem::path& file) {
  return config::parse_file(IdentifyCase::schema(), file);
}

std::shared_ptr<const config::Description> identify_description() { return IdentifyCase::schema().description(); }

}  // namespace tunica::case_file
