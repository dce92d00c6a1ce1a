#include "tunica/case/case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tunica/bc/velocity_profile.hpp"
#include "tunica/bc/waveform.hpp"
#include "tunica/case/case_text.hpp"
#include "tunica/case/compared_law.hpp"
#include "tunica/case/keys.hpp"
#include "tunica/case/mesh_settings.hpp"
#include "tunica/case/plausible.hpp"
#include "tunica/quantities/quantity.hpp"
#include "tunica/wall/parameters.hpp"

namespace tunica::case_file {

using config::Problems;
using config::Schema;
namespace dimension = config::dimension;

namespace {

// --- what is computed ---------------------------------------------------------------------------------------------

Schema<StaticWall> static_wall_schema() {
  return Schema<StaticWall>("static_wall", "Wall alone, in equilibrium with its loads.")
      .integer("load_steps", &StaticWall::load_steps, config::range(1, 100000),
               "Equal steps in which loads are applied")
      .by_default()
      .quantity("load_time", &StaticWall::load_time, dimension::time, config::at_least(0),
                "Loads that vary in time are those of this time")
      .by_default();
}

Schema<Analysis> analysis_schema() {
  return Schema<Analysis>("analysis", "What is computed.")
      .one_of()
      .alternative(Schema<FluidStructure>("fsi", "Blood and wall, coupled."))
      .alternative(Schema<RigidFlow>("flow", "Blood in a rigid wall."))
      .alternative(Schema<DynamicWall>("wall", "Wall alone, with inertia."))
      .alternative(static_wall_schema());
}

std::string name(const Analysis& analysis) { return analysis_schema().description()->fields[analysis.index()].key; }

// --- output -------------------------------------------------------------------------------------------------------

struct OutputUnit {
  const char* key;
  std::string OutputUnits::*member;
  config::Dimension due;
  const char* help;
};
constexpr OutputUnit output_units[] = {
    {"length", &OutputUnits::length, dimension::length,
     "Coordinates, displacement; squared and cubed for area and volume"},
    {"time", &OutputUnits::time, dimension::time,
     "Time in histories and on the screen; series for ParaView count in s"},
    {"velocity", &OutputUnits::velocity, dimension::velocity, "Velocity"},
    {"pressure", &OutputUnits::pressure, dimension::pressure, "Pressure"},
    {"stress", &OutputUnits::stress, dimension::pressure, "Stress and traction"},
    {"flow", &OutputUnits::flow, dimension::volume_flow, "Volume flow"},
};

Schema<coupling::PressurePoint> pressure_point_schema() {
  using coupling::PressurePoint;
  return Schema<PressurePoint>("pressure_point", "A pressure that is held at one node of the lumen.")
      .quantities("place", &PressurePoint::place, dimension::length, config::anything(),
                  "The corner of an element that is nearest to it is taken")
      .quantity("pressure", &PressurePoint::pressure, dimension::pressure, config::anything(), "Pressure there")
      .by_default();
}

Schema<ProbePoint> probe_schema() {
  return Schema<ProbePoint>("probe", "A place whose velocity, displacement and pressure are recorded.")
      .quantities("place", &ProbePoint::place, dimension::length, config::anything(), "In the initial mesh")
      .choice("region", &ProbePoint::region, {{"lumen", mesh::RegionKind::lumen}, {"wall", mesh::RegionKind::wall}},
              "Where it lies; where both meet, only the pressure depends on it. The lumen when left out, or the wall "
              "where there is no lumen")
      .shorthand("place");
}

// --- the whole ----------------------------------------------------------------------------------------------------

struct Part {
  const char* key;
  bool wanted, present;
  const char* remedy;  ///< when it is wanted and missing
};

/// What the stages before the run give is not given besides.
void check_chain(const Case& c, Problems& problems) {
  if (c.mesh.has_value() == c.meshes.given())
    problems.add(c.mesh ? "meshes" : "", c.mesh ? "is given, and `mesh` too" : "`meshes` is missing: no mesh is given",
                 "give `meshes`, which are there, or `mesh`, which is made first");
  if (c.mesh && !c.solves_fluid())
    problems.add("mesh", "makes lumen and wall, but the analysis is of the wall alone",
                 "choose `analysis: fsi` or `flow`, or make the mesh by `tunica mesh` and give its wall as `meshes`");
  if (!c.compare.empty() && !c.solves_wall())
    problems.add("compare", "is given, but the analysis has no wall", "remove it");
  if (c.fibres && !c.solves_wall()) problems.add("fibres", "is given, but the analysis has no wall", "remove it");
  if (c.compare.size() == 1)
    problems.add("compare", "names fewer than two laws", "add `compare: {neo_hooke: {material: ...}, ...}`");
  if (c.outlets && c.outlets->continued && !c.start)
    problems.add("outlets.continued", "is true, but there is no `start` to go on from",
                 "name the start.checkpoint that `tunica tune` has left, or remove the key");
  if (!(c.mesh || c.fibres) || !c.prestress) return;
  const char* remedy = "remove it: that of the stage `prestress` is taken";
  if (c.wall && c.wall->prestress) problems.add("wall.prestress", "is given, and the section `prestress` too", remedy);
  if (c.start) problems.add("start", "is given, and the section `prestress` too", remedy);
}

/// Fields that `post` and the report read and the series will not have.
void check_fields(const Case& c, Problems& problems) {
  if (!c.post && !c.report) return;
  std::string missing;
  const auto& all = quantities::registry();
  const auto need = [&](std::string_view key) {
    for (std::size_t i = 0; i < all.size(); ++i)
      if (all[i].key == key && !c.output.fields[i]) missing += fmt::format("{}{}", missing.empty() ? "" : ", ", key);
  };
  if (c.solves_fluid())
    for (const auto* key : {"velocity", "pressure", "wall_shear_stress"}) need(key);
  if (c.solves_wall()) need("displacement");
  if (!missing.empty())
    problems.add("output.fields", fmt::format("leaves out what `{}` reads: {}", c.post ? "post" : "report", missing),
                 "add them, or leave out `fields`: all that `post` reads is written then");
}

void check_case(const Case& c, Problems& problems) {
  const bool coupled = c.solves_fluid() && c.solves_wall(),
             static_wall = std::holds_alternative<StaticWall>(c.analysis);
  const std::string analysis = name(c.analysis);
  const Part parts[] = {
      {"fluid", c.solves_fluid(), c.fluid.has_value(), "add `fluid:`; with `{}` it has the usual values of blood"},
      {"wall", c.solves_wall(), c.wall.has_value(), "add `wall:` with density and material"},
      {"prestress", c.prestress && c.solves_wall(), c.prestress.has_value(), ""},
      {"outlets", c.outlets && c.solves_fluid(), c.outlets.has_value(), ""},
      {"mesh_motion", coupled, coupled || c.mesh_motion.has_value(), ""},
      {"time", !static_wall, c.time.has_value(), "add `time: {step: 1 ms, steps: 100}`"},
      {"meshes.lumen", c.solves_fluid(), c.mesh ? c.solves_fluid() : c.meshes.has_lumen(), "give a mesh of the lumen"},
      {"meshes.wall", c.solves_wall(), c.mesh ? c.solves_wall() : c.meshes.has_wall(), "give a mesh of the wall"},
      {"meshes.interface", coupled, c.mesh ? coupled : c.meshes.interface.has_value(),
       "name the surface that both have in common: `interface: {lumen: <face>, wall: <face>}`"},
  };
  for (const Part& part : parts) {
    if (part.wanted && !part.present)
      problems.add(part.key, fmt::format("is missing, but `analysis: {}` needs it", analysis), part.remedy);
    if (!part.wanted && part.present)
      problems.add(part.key, fmt::format("is given, but `analysis: {}` does not use it", analysis),
                   "remove it, or choose another analysis");
  }
  check_chain(c, problems);
  check_keys("compare", c.compare, "compared law", problems);
  if (c.wall) check_keys("wall.regions", c.wall->regions, "region", problems);
  if (c.prestress && c.solves_wall()) {
    if (coupled && !c.prestress->flow)
      problems.add("prestress.flow", "is missing: the traction of the flow loads the wall",
                   "add `flow: {pressure: 80 mmHg, inflow: 80 ml/s}`");
    if (!coupled && c.prestress->flow)
      problems.add("prestress.flow", fmt::format("is given, but `analysis: {}` has no flow", analysis),
                   "remove it: the loads on the wall are those of `boundary`");
  }
  if (c.outlets)
    for (const auto& [face, share] : c.outlets->fractions)
      if (std::any_of(c.boundary.begin(), c.boundary.end(), [&](const auto& b) { return b.first == face; }))
        problems.add("boundary." + face, "is an outlet of `outlets.fractions` as well",
                     "remove it from one of them: tuned outlets have no entry in `boundary`");
  if (c.time && c.time->cycles && !c.solves_fluid())
    problems.add("time.cycles", fmt::format("is given, but `analysis: {}` has no openings to look at", analysis),
                 "give `steps`");
  for (const auto& [face, condition] : c.boundary)
    if (c.prestress && std::holds_alternative<bc::Displacement>(condition))
      problems.add("boundary." + face,
                   "moves the face, and the section `prestress` looks for a wall that nothing moves",
                   "hold the face by `fixed`, or remove `prestress`");
  if (c.boundary.empty()) problems.add("boundary", "names no face", "give every face of the mesh a condition");
  check_fields(c, problems);
}

/// A run can only become periodic when a cycle holds whole periods of everything that drives it.
void check_period(const Case& c, const std::string& where, const bc::Waveform& course, std::vector<Problem>& found) {
  if (!c.time || !c.time->cycles || !course.period()) return;
  const double periods = c.time->cycles->period / *course.period();
  if (periods < 0.5 || std::abs(periods - std::round(periods)) > 1e-6)
    found.push_back({"time.cycles.period",
                     fmt::format("of {:.9g} s is no multiple of the period of {:.9g} s of {}", c.time->cycles->period,
                                 *course.period(), where),
                     "give the period of the waveform"});
}

/// Tables that do not read or make no waveform, each named by its place in the case file.
std::vector<Problem> check_waveforms(const Case& c) {
  std::vector<Problem> found;
  for (const auto& [face, condition] : c.boundary) {
    const std::string where = "boundary." + face;
    const auto check = [&](const bc::Waveform& course) { check_period(c, where, course, found); };
    try {
      if (const auto* flow = std::get_if<bc::Flow>(&condition)) check(bc::inflow(*flow));
      if (const auto* pressure = std::get_if<bc::Pressure>(&condition)) {
        check(bc::make_waveform(pressure->pressure));
        if (pressure->over_face) const bc::PointTable table(*pressure->over_face, bc::factor_column);
      }
      if (const auto* velocity = std::get_if<bc::Velocity>(&condition)) check(bc::make_waveform(velocity->course));
      if (const auto* profile = std::get_if<bc::VelocityProfile>(&condition)) {
        check(bc::make_waveform(profile->course));
        if (profile->table) const bc::PointTable table(profile->over_face(), bc::velocity_columns);
      }
      if (const auto* traction = std::get_if<bc::Traction>(&condition)) {
        check(bc::make_waveform(traction->course));
        if (traction->over_face) const bc::PointTable table(*traction->over_face, bc::traction_columns);
      }
      if (const auto* moved = std::get_if<bc::Displacement>(&condition)) {
        check(bc::make_waveform(moved->course));
        if (moved->over_face) const bc::PointTable table(*moved->over_face, bc::displacement_columns);
      }
    } catch (const InputError& error) {
      for (const Problem& p : error.problems()) found.push_back({where + ": " + p.where, p.what, p.remedy});
    }
  }
  return found;
}

/// The fractions add up to 1 exactly, and the outlets get conditions, so that whatever looks at the faces finds one on
/// each.
void place_outlets(Case& c, std::vector<Problem>& warnings) {
  double sum = 0;
  for (const auto& [face, share] : c.outlets->fractions) sum += share;
  if (std::abs(sum - 1) > 1e-9)
    warnings.push_back({"outlets.fractions", fmt::format("add up to {:.6g}", sum), "they are divided by that sum"});
  for (auto& [face, share] : c.outlets->fractions) share /= sum;
  for (auto& outlet : provisional_outlets(*c.outlets)) c.boundary.push_back(std::move(outlet));
}

/// What only the whole case can tell of the measurements.
std::vector<Problem> problems_of_measured(const Case& c) {
  if (!c.measured) return {};
  const MeasuredCase& measured = *c.measured;
  std::vector<std::string> points;
  for (const auto& [name, place] : c.output.points) points.push_back(name);
  auto problems = check_measured(measured, points);
  if (!c.post)
    problems.push_back(
        {"measured", "is given, and no `post` that would compare it with the results", "add `post: {}`"});
  if (!c.solves_fluid() && !(measured.pressures.empty() && measured.flows.empty() && measured.areas.empty()))
    problems.push_back(
        {"measured", "has pressures, flows or areas of the lumen, but the analysis has no flow", "remove them"});
  return problems;
}

config::Parsed<Case> parse(const std::string& yaml, const std::filesystem::path& file, bool check_files) {
  const config::Origin origin{.name = file.string(), .folder = file.parent_path(), .check_files = check_files};
  config::Parsed<Case> parsed = config::parse_document(Case::schema(), case_document(yaml, file), origin);
  Case& c = parsed.value;
  if (c.solves_fluid() && c.solves_wall() && !c.mesh_motion) c.mesh_motion.emplace();
  if (c.outlets) place_outlets(c, parsed.warnings);
  return parsed;
}

}  // namespace

Schema<OutputUnits> OutputUnits::schema() {
  Schema<OutputUnits> schema("units", "Units of results.");
  for (const OutputUnit& unit : output_units) schema.text(unit.key, unit.member, unit.help).by_default();
  return schema.check([](const OutputUnits& units, Problems& problems) {
    for (const OutputUnit& unit : output_units) {
      const auto factor = config::parse_unit(units.*unit.member, unit.due);
      if (const auto* error = std::get_if<config::UnitError>(&factor))
        problems.add(unit.key, error->what, error->remedy);
    }
  });
}

Schema<OutputSettings> OutputSettings::schema() {
  return Schema<OutputSettings>("output", "Where, how often and in which units results are written.")
      .path("directory", &OutputSettings::directory, "Folder of the results, relative to that of the case file")
      .by_default("results")
      .integer("every", &OutputSettings::every, config::range(1, 1e9), "Steps between two fields of the time series")
      .by_default()
      .integer(
          "checkpoint_every", &OutputSettings::checkpoint_every, config::range(1, 1e9),
          "Steps between two checkpoints; one is also written after two minutes without, at the end, and when a run is "
          "interrupted")
      .by_default()
      .section("units", &OutputSettings::units, OutputUnits::schema(), "Units of fields and histories")
      .by_default()
      .map("points", &OutputSettings::points, probe_schema(),
           "Places in the mesh whose velocity, displacement and pressure are recorded in points.csv, by name; each "
           "moves "
           "with the mesh")
      .by_default()
      .flag("forces", &OutputSettings::forces,
            "Record the force of the blood on each face that it sticks to in forces.csv")
      .by_default()
      .any_of(
          "fields", &OutputSettings::fields, quantities::keys(),
          "Fields of the time series; `post`, and with it `report`, needs the standard ones of the blood, and of the "
          "wall displacement. docs/results.md tells what they are")
      .by_default()
      .choice("instant", &OutputSettings::instant, {{"balance", Instant::balance}, {"end", Instant::end}},
              "Instant of pressures, of stresses and strains, and of faces.csv: `balance` within the step, where the "
              "equations are "
              "met; `end` the end of the step, as svMultiPhysics and svFSI write it")
      .by_default();
}

bool Case::solves_fluid() const {
  return std::holds_alternative<FluidStructure>(analysis) || std::holds_alternative<RigidFlow>(analysis);
}

bool Case::finds_prestress() const { return prestress && !(wall && wall->prestress); }

bool Case::wall_has_pressure() const { return wall && wall->element == wall::Element::mixed; }

std::vector<std::string> Case::wall_arrays() const { return wall ? wall->cell_arrays() : std::vector<std::string>(); }

std::optional<std::filesystem::path> Case::prestress_file() const { return wall ? wall->prestress : std::nullopt; }

bool Case::solves_wall() const { return !std::holds_alternative<RigidFlow>(analysis); }

Schema<Case> Case::schema() {
  return Schema<Case>("tunica case",
                      "A case file is YAML. Every dimensional value has its unit: `125 mmHg`, `0.04 dyn s/cm^2`, "
                      "`0.2 ms`. Unknown keys are errors. File names are relative to the folder of the case file.")
      .text("title", &Case::title, "Free text for logs and reports")
      .by_default()
      .section("analysis", &Case::analysis, analysis_schema(), "What is computed")
      .section("mesh", &Case::mesh, MeshCase::schema(),
               "What `tunica run` meshes first, as in the file of `tunica mesh`; in place of `meshes`")
      .section("meshes", &Case::meshes, MeshSettings::schema(), "Meshes that are there; in place of `mesh`")
      .optional()
      .section("fibres", &Case::fibres, FibreSettings::schema(),
               "Material directions that `tunica run` makes first, as in the file of `tunica fibres`; inlet, outer and "
               "tears may be left out after `mesh`")
      .choice("elements", &Case::elements, {{"linear", Elements::linear}, {"quadratic", Elements::quadratic}},
              "Velocity and displacement in a tetrahedron; pressure is linear. `quadratic` gives every edge a node and "
              "needs 4 elements across the lumen; `linear` needs 10 and more, and is quick on coarse meshes")
      .by_default()
      .section("fluid", &Case::fluid, fluid::Parameters::schema(), "Blood; for `fsi` and `flow`")
      .section("wall", &Case::wall, wall::Parameters::schema(), "Vessel wall; for `fsi`, `wall` and `static_wall`")
      .section("mesh_motion", &Case::mesh_motion, ale::Parameters::schema(),
               "How the mesh of the lumen follows the wall; for `fsi`, with its defaults when left out")
      .section("pressure_point", &Case::pressure_point, pressure_point_schema(),
               "Pressure at one place, for blood that is enclosed by faces that all prescribe its velocity")
      .map("boundary", &Case::boundary, bc::condition_schema(),
           "The condition of every face except the interface, by the name of the face")
      .section("time", &Case::time, coupling::TimeSettings::schema(), "Time stepping; for all but `static_wall`")
      .path("start", &Case::start,
            "State that the run starts from: start.checkpoint of `tunica prestress`; at rest when left out")
      .section("prestress", &Case::prestress, PrestressCase::schema(), "What `tunica prestress` shall find, and how")
      .section("outlets", &Case::outlets, TuningCase::schema(),
               "Outlets by pressures and shares of the flow, which `tunica tune` finds")
      .section("post", &Case::post, analysis::PostSettings::schema(),
               "What `tunica post` makes of the results; with its defaults when left out")
      .section("measured", &Case::measured, MeasuredCase::schema(),
               "Measurements that `tunica post` and the report hold the results against; docs/measured.md")
      .section("report", &Case::report, ReportSettings::schema(), "The page that `tunica run` writes last")
      .map("compare", &Case::compare, ComparedLaw::schema(),
           "Wall laws that `tunica compare` puts side by side, by the names that they shall have")
      .by_default()
      .section("newton", &Case::newton, coupling::NewtonSettings::schema(), "Nonlinear solver")
      .by_default()
      .section("linear", &Case::linear, coupling::LinearSettings::schema(), "Linear solver")
      .by_default()
      .section("output", &Case::output, OutputSettings::schema(), "Results")
      .by_default()
      .check(check_case);
}

config::Document case_document(const std::string& yaml, const std::filesystem::path& file) {
  config::Document document(yaml, file.string());
  if (document.has("fibres") && document.has("wall") && !document.has("wall.fibre_frame"))
    document.set("wall.fibre_frame", config::Document("mesh: {e1: e1, e2: e2}"));
  return document;
}

config::Parsed<Case> read_case(const std::filesystem::path& file) { return read_case(config::read_text(file), file); }

config::Parsed<Case> read_case(const std::string& yaml, const std::filesystem::path& file) {
  config::Parsed<Case> parsed = parse(yaml, file, true);
  std::vector<Problem> problems = check_waveforms(parsed.value);
  for (auto& problem : problems_of_measured(parsed.value)) problems.push_back(std::move(problem));
  if (!problems.empty()) throw InputError(std::move(problems));
  for (auto& warning : implausible_values(parsed.value)) parsed.warnings.push_back(std::move(warning));
  return parsed;
}

Case parse_case(const std::string& yaml, const std::filesystem::path& file) { return parse(yaml, file, false).value; }

std::vector<std::pair<std::string, std::string>> interface_pairs(const MeshSettings& meshes) {
  std::vector<std::pair<std::string, std::string>> pairs;
  if (!meshes.interface) return pairs;
  const auto &lumen = meshes.interface->lumen_faces, &wall = meshes.interface->wall_faces;
  for (std::size_t k = 0; k < std::max(lumen.size(), wall.size()); ++k)
    pairs.emplace_back(lumen[std::min(k, lumen.size() - 1)], wall[std::min(k, wall.size() - 1)]);
  return pairs;
}

std::vector<std::string> sticking_faces(const Case& c, const std::vector<std::string>& lumen_faces) {
  const auto pairs = interface_pairs(c.meshes);
  std::vector<std::string> faces;
  for (const auto& name : lumen_faces)
    if (std::any_of(pairs.begin(), pairs.end(), [&](const auto& pair) { return pair.first == name; }) ||
        std::any_of(c.boundary.begin(), c.boundary.end(),
                    [&](const auto& b) { return b.first == name && std::holds_alternative<bc::NoSlip>(b.second); }))
      faces.push_back(name);
  return faces;
}

namespace {

std::optional<analysis::LayerBorders> borders_of(const wall::Composition& composition) {
  if (!composition.layers) return std::nullopt;
  analysis::LayerBorders borders{.depth = composition.layers->depth, .beyond = {}};
  for (const auto& layer : composition.layers->outwards) borders.beyond.push_back(layer.beyond);
  return borders;
}

}  // namespace

analysis::RunDescription describe(const Case& c) {
  analysis::RunDescription run{.fluid = c.solves_fluid(),
                               .wall = c.solves_wall(),
                               .interface = c.meshes.interface.has_value(),
                               .sticking_faces = {},
                               .inflow_faces = {},
                               .length_unit = c.output.units.length};
  for (const auto& [lumen, wall] : interface_pairs(c.meshes)) run.sticking_faces.push_back(lumen);
  for (const auto& [face, condition] : c.boundary) {
    if (std::holds_alternative<bc::NoSlip>(condition)) run.sticking_faces.push_back(face);
    if (std::holds_alternative<bc::Flow>(condition)) run.inflow_faces.push_back(face);
  }
  if (c.solves_wall()) {
    run.layers = borders_of(c.wall->composition);
    for (const auto& [region, own] : c.wall->regions) run.layers_of_region[region] = borders_of(own.composition);
  }
  return run;
}

}  // namespace tunica::case_file
