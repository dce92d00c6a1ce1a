#include "tunica/case/fibre_settings.hpp"

#include <numbers>

#include "tunica/case/keys.hpp"

namespace tunica::case_file {

namespace {

using config::Schema;
namespace dimension = config::dimension;

const config::Range any_mean_angle = config::range(-std::numbers::pi / 2, std::numbers::pi / 2);

Schema<frames::NormalMethod> normal_schema() {
  using frames::ConditionalMean;
  using frames::FilteredDyads;
  return Schema<frames::NormalMethod>("normal", "How the normals of the interface become e3 in the wall.")
      .one_of()
      .alternative(Schema<FilteredDyads>("filtered", "Directions without sign, spread by a filter.")
                       .quantity("length", &FilteredDyads::length, dimension::length, config::above(0),
                                 "Over which the influence of a place decays; about the thickness of wall and flap")
                       .by_default()
                       .plausible("0.2 mm", "10 mm"))
      .alternative(Schema<ConditionalMean>("conditional", "Vectors, carried inwards and averaged over neighbours.")
                       .quantity("tolerance", &ConditionalMean::tolerance, dimension::angle,
                                 config::range(0, std::numbers::pi),
                                 "Neighbours that deviate more than this from the element take no part")
                       .by_default("120 deg")
                       .integer("cycles", &ConditionalMean::cycles, config::range(0, 1000), "Of averaging")
                       .by_default());
}

Schema<RegionFibres> region_schema() {
  return Schema<RegionFibres>("region", "Fibres of one region of the wall.")
      .quantity("mean_angle", &RegionFibres::mean_angle, dimension::angle, any_mean_angle,
                "Of the two families, from e1 towards e2");
}

Schema<frames::LumenWalls> tears_schema() {
  using frames::LumenWalls;
  return Schema<LumenWalls>("tears", "Regions of the wall by which the tears are found.")
      .texts("true_lumen", &LumenWalls::true_lumen, "Along the true lumen")
      .texts("false_lumen", &LumenWalls::false_lumen, "Along the false lumen");
}

}  // namespace

Schema<FibreSettings> FibreSettings::schema() {
  using frames::Domain;
  return Schema<FibreSettings>("fibres", "Material directions in the wall, as `tunica fibres` makes them.")
      .texts("inlet", &FibreSettings::inlet, "Faces where the vessel begins: ring of the wall and cap of the lumen")
      .by_default()
      .texts("outer", &FibreSettings::outer, "Faces along the vessel; all others but the interface are its ends")
      .by_default()
      .texts("inner", &FibreSettings::inner, "Faces of the wall towards the lumen, when `meshes` has no interface")
      .by_default()
      .quantity("mean_angle", &FibreSettings::mean_angle, dimension::angle, any_mean_angle,
                "Of the two families of fibres, from e1 (around the vessel) towards e2 (along it)")
      .map("regions", &FibreSettings::regions, region_schema(), "Other angles, by the name of the region of the wall")
      .by_default()
      .section(
          "normal", [](FibreSettings& c) -> frames::NormalMethod& { return c.frames.normal; }, normal_schema(),
          "How the normals of the interface become e3")
      .by_default("filtered")
      .choice(
          "domain", [](FibreSettings& c) -> Domain& { return c.frames.domain; },
          {{"lumen_and_wall", Domain::lumen_and_wall}, {"wall", Domain::wall}},
          "Where the potential along the vessel is solved for; on the wall alone it flows around tears")
      .by_default()
      .section("tears", &FibreSettings::tears, tears_schema(),
               "For the distance to the nearest tear; none when left out")
      .path("output", &FibreSettings::output, "Folder of the mesh with its directions, relative to that of this file")
      .by_default("fibres")
      .check([](const FibreSettings& c, config::Problems& problems) {
        check_keys("regions", c.regions, "region", problems);
      });
}

}  // namespace tunica::case_file
