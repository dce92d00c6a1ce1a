#include "tunica/stages/fibres/fibres_case.hpp"

#include <numbers>

namespace tunica::stages::fibres {

namespace {

using config::Problems;
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

void check_case(const FibresCase& c, Problems& problems) {
  if (!c.meshes.has_wall()) problems.add("meshes", "has no wall", "give the mesh of a wall");
  const bool joined = c.meshes.has_lumen() && c.meshes.interface;
  if (!c.meshes.interface && c.inner.empty())
    problems.add("inner", "is missing, and `meshes.interface` too",
                 "name the faces of the wall towards the lumen, or the interface of wall and lumen");
  if (c.meshes.interface && !c.inner.empty())
    problems.add("inner", "is given, but `meshes.interface` says it already", "remove it");
  if (c.frames.domain == frames::Domain::lumen_and_wall && !joined)
    problems.add("domain", "is lumen_and_wall, but there is no lumen joined to the wall",
                 "give `meshes.lumen` and `meshes.interface`, or write `domain: wall`");
  if (c.tears && !joined)
    problems.add("tears", "is given, but there is no lumen joined to the wall",
                 "give `meshes.lumen` and `meshes.interface`, or remove it");
  if (c.inlet.empty()) problems.add("inlet", "names no face", "name the ring of the wall where blood enters");
}

FibresCase parse(const std::string& yaml, const std::filesystem::path& file, bool check_files,
                 std::vector<Problem>* warnings) {
  const config::Origin origin{.name = file.string(), .folder = file.parent_path(), .check_files = check_files};
  auto parsed = config::parse_text(FibresCase::schema(), yaml, origin);
  if (warnings) *warnings = std::move(parsed.warnings);
  return std::move(parsed.value);
}

}  // namespace

Schema<FibresCase> FibresCase::schema() {
  using frames::Domain;
  return Schema<FibresCase>("tunica fibres", "File of `tunica fibres`, in YAML like a case file.")
      .text("title", &FibresCase::title, "Free text for logs and reports")
      .by_default()
      .section("meshes", &FibresCase::meshes, MeshSettings::schema(), "As in a case file; `tunica mesh` writes it")
      .texts("inlet", &FibresCase::inlet, "Faces where the vessel begins: ring of the wall and cap of the lumen")
      .texts("outer", &FibresCase::outer, "Faces along the vessel; all others but the interface are its ends")
      .by_default()
      .texts("inner", &FibresCase::inner, "Faces of the wall towards the lumen, when `meshes` has no interface")
      .by_default()
      .quantity("mean_angle", &FibresCase::mean_angle, dimension::angle, any_mean_angle,
                "Of the two families of fibres, from e1 (around the vessel) towards e2 (along it)")
      .map("regions", &FibresCase::regions, region_schema(), "Other angles, by the name of the region of the wall")
      .by_default()
      .section(
          "normal", [](FibresCase& c) -> frames::NormalMethod& { return c.frames.normal; }, normal_schema(),
          "How the normals of the interface become e3")
      .by_default("filtered")
      .choice(
          "domain", [](FibresCase& c) -> Domain& { return c.frames.domain; },
          {{"lumen_and_wall", Domain::lumen_and_wall}, {"wall", Domain::wall}},
          "Where the potential along the vessel is solved for; on the wall alone it flows around tears")
      .by_default()
      .section("tears", &FibresCase::tears, tears_schema(), "For the distance to the nearest tear; none when left out")
      .path("output", &FibresCase::output, "Folder of the mesh with its directions, relative to that of this file")
      .by_default("fibres")
      .check(check_case);
}

config::Parsed<FibresCase> read_fibres_case(const std::filesystem::path& file) {
  config::Parsed<FibresCase> parsed;
  parsed.value = parse(config::read_text(file), file, true, &parsed.warnings);
  return parsed;
}

FibresCase parse_fibres_case(const std::string& yaml, const std::filesystem::path& file) {
  return parse(yaml, file, false, nullptr);
}

}  // namespace tunica::stages::fibres
