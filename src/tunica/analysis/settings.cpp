#include "tunica/analysis/settings.hpp"

namespace tunica::analysis {

namespace {

using config::Problems;
using config::Schema;
namespace dimension = config::dimension;

Schema<frames::LumenWalls> lumens_schema() {
  using frames::LumenWalls;
  return Schema<LumenWalls>("lumens", "Regions of the wall by which the two lumens of a dissection are told apart.")
      .texts("true_lumen", &LumenWalls::true_lumen, "Along the true lumen")
      .texts("false_lumen", &LumenWalls::false_lumen, "Along the false lumen");
}

void check_settings(const PostSettings& s, Problems& problems) {
  if (s.period && s.from && s.until)
    problems.add("period", "is given, and both ends of the window too", "give two of `period`, `from`, `until`");
  if (s.from && s.until && !(*s.from < *s.until))
    problems.add("until", "does not lie after `from`", "give a window that has a length");
  if (s.percentiles.empty()) problems.add("percentiles", "names none", "leave it out for 50, 95 and 99");
}

}  // namespace

Schema<PostSettings> PostSettings::schema() {
  return Schema<PostSettings>("post", "What `tunica post` makes of the results.")
      .quantity(
          "period", &PostSettings::period, dimension::time, config::above(0),
          "Length of a cycle: the last one is looked at. When left out that of `time.cycles`; without that and without "
          "`from`, all results")
      .plausible("0.3 s", "2 s")
      .quantity("from", &PostSettings::from, dimension::time, config::at_least(0), "Start of the window")
      .quantity("until", &PostSettings::until, dimension::time, config::above(0),
                "End of the window; the last field when left out")
      .text("inlet", &PostSettings::inlet,
            "Face of the lumen where blood enters the aorta: stations count from it; when left out the only one with a "
            "`flow`, else lumen_inlet")
      .text("end", &PostSettings::end,
            "Face of the lumen where the aorta ends; when left out the opening that is farthest from the inlet")
      .quantity("spacing", &PostSettings::spacing, dimension::length, config::above(0),
                "Distance of stations along the centreline")
      .by_default()
      .plausible("0.5 mm", "50 mm")
      .quantities("percentiles", &PostSettings::percentiles, dimension::none, config::range(0, 100),
                  "Of stresses, by the volume of the wall that stays below [%]")
      .by_default("[50, 95, 99]")
      .section("lumens", &PostSettings::lumens, lumens_schema(),
               "Regions of the wall along the lumens; when left out true_lumen_wall and false_lumen_wall, if the wall "
               "has them")
      .text("flap", &PostSettings::flap, "Region of the wall whose displacement is reported")
      .by_default()
      .path("output", &PostSettings::output,
            "Folder of what is found, relative to that of the case file; `post` in that of the results when left out")
      .check(check_settings);
}

}  // namespace tunica::analysis
