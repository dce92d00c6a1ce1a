#include "tunica/case/what_if_case.hpp"

#include <fmt/format.h>

#include "tunica/case/descriptions.hpp"
#include "tunica/case/keys.hpp"

namespace tunica::case_file {

namespace {

using config::Problems;
using config::Schema;
namespace dimension = config::dimension;

Schema<NewTear> new_tear_schema() {
  return Schema<NewTear>("new_tear", "A hole in the flap, as round as the mesh allows.")
      .quantity("position", &NewTear::position, dimension::length, config::at_least(0),
                "Of its middle along the aorta, as the `distance` of stations and tears")
      .quantity("area", &NewTear::area, dimension::area, config::above(0), "Of the flap that is taken away");
}

Schema<Sleeve> sleeve_schema() {
  return Schema<Sleeve>("sleeve",
                        "A stent graft: a stretch of the wall becomes the region `sleeve`, and tears in it are closed.")
      .quantity("from", &Sleeve::from, dimension::length, config::at_least(0), "Along the aorta, as `distance`")
      .quantity("to", &Sleeve::to, dimension::length, config::above(0), "Likewise")
      .texts("regions", &Sleeve::regions, "Regions of the wall that it lines")
      .by_default("[true_lumen_wall, flap]")
      .include(&Sleeve::material, wall::RegionMaterial::schema())
      .check([](const Sleeve& s, Problems& problems) {
        if (s.to <= s.from) problems.add("to", "is not beyond `from`", "give the place upstream first");
      });
}

Schema<WhatIf> variant_schema() {
  const auto factor = config::range(0.2, 5);
  return Schema<WhatIf>("what_if", "What is other than in the case.")
      .texts("close_tears", &WhatIf::close_tears,
             "Tears by their names in post.json, tear_1 being the first downstream")
      .by_default()
      .list("open_tears", &WhatIf::open_tears, new_tear_schema(), "Holes that are made in the flap")
      .by_default()
      .section("sleeve", &WhatIf::sleeve, sleeve_schema(), "A stiff, sealed stretch of the wall")
      .number("pressure", &WhatIf::pressure, factor, "Factor on the pressures that the outlets are tuned for")
      .number("heart_rate", &WhatIf::heart_rate, factor, "Factor on the beats in a minute; outlets stay as they are")
      .number("stroke_volume", &WhatIf::stroke_volume, factor, "Factor on the volume of a beat, likewise")
      .texts("set", &WhatIf::set, "Keys of the case with other values, as in `fluid.density=1050 kg/m^3`")
      .by_default()
      .check([](const WhatIf& w, Problems& problems) {
        if (!w.changes_mesh() && !w.pressure && !w.heart_rate && !w.stroke_volume && w.set.empty())
          problems.add("", "changes nothing",
                       "add one of close_tears, open_tears, sleeve, pressure, heart_rate, "
                       "stroke_volume, set");
        for (const auto& setting : w.set)
          if (setting.find('=') == std::string::npos || setting.front() == '=')
            problems.add("set", fmt::format("`{}` is no assignment", setting), "write key.of.the.case=value");
      });
}

}  // namespace

Schema<WhatIfCase> WhatIfCase::schema() {
  return Schema<WhatIfCase>("what_if_case", "One case with another anatomy or other loads, side by side.")
      .text("title", &WhatIfCase::title, "Of the page of results")
      .by_default()
      .file("case", &WhatIfCase::case_file, "The case; it needs the section `post`")
      .map("variants", &WhatIfCase::variants, variant_schema(), "What is other, by name")
      .path("output", &WhatIfCase::output, "Folder of the results, relative to that of the file")
      .by_default("what_if")
      .check([](const WhatIfCase& w, Problems& problems) {
        if (w.variants.empty()) problems.add("variants", "names none", "add `exit_closed: {close_tears: tear_2}`");
        check_keys("variants", w.variants, "variant", problems);
      });
}

config::Parsed<WhatIfCase> read_what_if_case(const std::filesystem::path& file) {
  return config::parse_file(WhatIfCase::schema(), file);
}

std::shared_ptr<const config::Description> what_if_description() { return WhatIfCase::schema().description(); }

}  // namespace tunica::case_file
