#include "tunica/stages/measure/measure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tunica/base/error.hpp"
#include "tunica/base/units.hpp"
#include "tunica/config/json_text.hpp"
#include "tunica/drawing/plot.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/files/csv_file.hpp"
#include "tunica/files/lock.hpp"
#include "tunica/files/outputs.hpp"
#include "tunica/flow_imaging/inlet_profile.hpp"
#include "tunica/stages/vessel_of_case.hpp"

namespace tunica::stages {

namespace {

namespace fs = std::filesystem;
namespace flow = flow_imaging;
using config::Problems;
using config::Schema;
using nlohmann::ordered_json;

constexpr double slab_of_openings = 4;  ///< voxels: there is lumen on one side alone

Schema<ProfileSettings> profile_schema() {
  return Schema<ProfileSettings>("profile", "Velocities of an opening in space and time, as the condition of a run.")
      .text("opening", &ProfileSettings::opening, "Face of the lumen")
      .quantity("smoothing", &ProfileSettings::smoothing, config::dimension::length, config::above(0),
                "Length of correlation of the profile; when left out the radius of the opening")
      .plausible("1 mm", "30 mm")
      .number("slab", &ProfileSettings::slab, config::range(0.5, 30), "Voxels behind the opening that tell of it")
      .by_default()
      .integer("times", &ProfileSettings::times, config::range(10, 5000),
               "Of the table, between the frames by periodic cubic splines")
      .by_default();
}

/// What is looked at, found in the mesh alone.
struct Sections {
  std::vector<flow::CrossSection> all;
  std::vector<int> signs;  ///< +1: into the vessel, -1: out of it, 0: a plane
};

Sections find_sections(const MeasureCase& c, const VesselOfCase& vessel) {
  Sections sections;
  std::vector<Problem> problems;
  const auto collect = [&](int sign, const auto& find) {
    try {
      sections.all.push_back(find());
      sections.signs.push_back(sign);
    } catch (const InputError& error) {
      problems.insert(problems.end(), error.problems().begin(), error.problems().end());
    }
  };
  if (c.openings)
    for (const auto& name : vessel.openings) {
      const bool inlet = name == vessel.inlet;
      collect(inlet ? 1 : -1, [&] {
        auto section = flow::opening_section(vessel.mesh, vessel.face(name));
        if (!inlet) return section;
        section.normal = -1.0 * section.normal;
        for (auto& t : section.triangles) std::swap(t[1], t[2]);
        return section;
      });
    }
  for (const auto& [name, plane] : c.planes)
    collect(0, [&, &n = name, &p = plane] {
      return flow::plane_section(vessel.mesh, p.centre, p.normal, n, "planes." + n);
    });
  for (const auto& [name, plane] : c.planes)
    if (std::find(vessel.openings.begin(), vessel.openings.end(), name) != vessel.openings.end())
      problems.push_back({"planes." + name, "has the name of an opening", "give it another name"});
  if (c.profile &&
      std::find(vessel.openings.begin(), vessel.openings.end(), c.profile->opening) == vessel.openings.end())
    problems.push_back({"profile.opening", fmt::format("the lumen has no opening '{}'", c.profile->opening),
                        "name one of: " + files::listed(vessel.openings)});
  if (sections.all.empty() && problems.empty() && !c.profile)
    problems.push_back({"planes", "names none, and `openings` is false", "give a plane, or a profile"});
  if (!problems.empty()) throw InputError(std::move(problems));
  return sections;
}

/// Velocities put right, and what they say of themselves.
struct Prepared {
  flow::VelocitySeries series;
  flow::LumenVoxels lumen;
  flow::Noise noise;
  ordered_json done;
};

Prepared prepare(const MeasureCase& c, const VesselOfCase& vessel, const files::Say& say) {
  Prepared p{.series = flow::read_series(c.velocity.value(), "velocity"), .lumen = {}, .noise = {}, .done = {}};
  auto& series = p.series;
  const auto& size = series.frame.size;
  say(fmt::format("velocities: {} x {} x {} voxels, {} frames over {:.4g} s", size[0], size[1], size[2],
                  series.frames(), series.period));
  p.lumen = flow::lumen_voxels(series, vessel.mesh, 0);
  if (p.lumen.samples.empty())
    throw InputError("velocity", "no voxel lies in the lumen of the mesh",
                     "bring mesh and images into the same coordinates: both in those of the patient");
  const auto wrapped = flow::unwrap(series, flow::near_lumen(series.frame, p.lumen.shares, 1));
  if (series.encoding) say(fmt::format("unwrapped: {} values of voxels and frames", wrapped));
  p.done["unwrapped_values"] = wrapped;
  const auto at_rest = flow::static_tissue(series, flow::near_lumen(series.frame, p.lumen.shares, 3));
  p.done["voxels_of_static_tissue"] = at_rest.size();
  if (c.background) {
    const auto offset = flow::fit_offset(series, at_rest, *c.background);
    flow::subtract(series, offset);
    say(fmt::format("offset of static tissue: up to {:.3g} cm/s, taken away", offset.largest / unit::cm_s));
    p.done["largest_offset_cm_s"] = offset.largest / unit::cm_s;
  }
  if (c.noise)
    p.noise = {*c.noise, 0};
  else
    p.noise = flow::measure_noise(series, at_rest);
  say(fmt::format("noise: {:.3g} cm/s{}", p.noise.deviation / unit::cm_s, c.noise ? "" : " in static tissue"));
  p.done["noise_cm_s"] = p.noise.deviation / unit::cm_s;
  p.lumen = flow::lumen_voxels(series, vessel.mesh, p.noise.magnitude);
  return p;
}

std::string table_of(const std::vector<flow::FlowCurve>& curves, const std::vector<double>& times) {
  std::string text = "time [s]";
  for (const auto& c : curves) text += fmt::format(",{0} [ml/s],{0} deviation [ml/s]", c.name);
  text += "\n";
  for (std::size_t k = 0; k < times.size(); ++k) {
    text += fmt::format("{:.9g}", times[k]);
    for (const auto& c : curves)
      text += fmt::format(",{:.7g},{:.4g}", c.flow[k] / unit::ml, c.deviation_at(k) / unit::ml);
    text += "\n";
  }
  return text;
}

ordered_json vector_of(const Vec3<double>& v, double unit) {
  return ordered_json::array({v[0] / unit, v[1] / unit, v[2] / unit});
}

ordered_json report_of(const flow::FlowCurve& c) {
  const auto [least, most] = std::minmax_element(c.flow.begin(), c.flow.end());
  return {{"name", c.name},
          {"centre_mm", vector_of(c.centre, unit::mm)},
          {"normal", vector_of(c.normal, 1)},
          {"area_mm2", c.area * 1e6},
          {"voxels", c.voxels},
          {"mean_ml_s", c.mean() / unit::ml},
          {"deviation_of_mean_ml_s", c.mean_deviation() / unit::ml},
          {"largest_ml_s", *most / unit::ml},
          {"smallest_ml_s", *least / unit::ml},
          {"deviation_by_noise_ml_s", c.deviation_by_noise() / unit::ml},
          {"unresolved_share", c.unresolved}};
}

void plot_curves(const std::vector<flow::FlowCurve>& curves, const std::vector<double>& times, const fs::path& file) {
  std::vector<drawing::Series> series;
  for (const auto& c : curves) {
    auto& line = series.emplace_back();
    line.name = c.name;
    line.x = times;
    for (const double q : c.flow) line.y.push_back(q / unit::ml);
  }
  drawing::write_plot(file.string(), series,
                      {.title = "Measured flow: of openings into the vessel at the inlet, out of it elsewhere",
                       .x_label = "time [s]",
                       .y_label = "flow [ml/s]"});
}

fs::path profile_file(const MeasureCase& c, const std::string& opening) {
  return c.output / fmt::format("profile_{}.csv", opening);
}

/// Writes the table of a profile; the lines of the case that read it go to `say`.
void write_profile(const MeasureCase& c, const flow::OpeningMesh& opening, const flow::NodalCourse& course,
                   const files::Say& say) {
  const auto file = profile_file(c, opening.name);
  flow::write_nodal_table(opening.points, flow::resampled(course, static_cast<std::size_t>(c.profile->times)),
                          "vx,vy,vz", file);
  say(
      fmt::format("\nThe velocities of {0} at its {1} nodes are the condition\n\n"
                  "boundary:\n  {0}:\n    profile: {{table: {2}, length_unit: m, unit: m/s, period: {3:.9g} s, "
                  "interpolation: nearest}}",
                  opening.name, opening.points.size(), fs::absolute(file).lexically_normal().string(), course.period));
}

/// `measured`: the flow of the opening, where it was found already.
flow::NodalCourse fitted_profile(const MeasureCase& c, const VesselOfCase& vessel, const Prepared& p,
                                 const flow::OpeningMesh& opening, const flow::FlowCurve* measured,
                                 const files::Say& say) {
  const auto section = flow::opening_section(vessel.mesh, vessel.face(opening.name));
  const double radius = std::sqrt(section.area / M_PI);
  const auto length = c.profile->smoothing ? c.profile->smoothing : c.smoothing;
  const flow::ProfileFit fit(p.series, p.lumen, section, p.noise,
                             {.length = length.value_or(radius), .slab = c.profile->slab, .at_end = true});
  say(fmt::format("profile of {}: {} voxels, smoothed over {:.3g} mm", opening.name, fit.voxels(),
                  fit.length() / unit::mm));
  std::vector<double> outflow;
  const double sign = opening.name == vessel.inlet ? -1 : 1;
  for (std::size_t k = 0; k < p.series.frames(); ++k)
    outflow.push_back(measured ? sign * measured->flow[k] : fit.flow()[k]);
  return flow::profile_at_nodes(p.series, fit, opening, outflow);
}

void check_sources(const MeasureCase& c, Problems& problems) {
  if (c.velocity.has_value() == c.plane.has_value())
    problems.add("", c.velocity ? "has `velocity` and `plane`" : "has no velocities", "give `velocity`, or `plane`");
  if (c.plane && !c.profile)
    problems.add("profile", "is missing: velocities on a plane are laid onto an opening",
                 "add `profile: {opening: lumen_inlet}`");
  if (c.plane && !c.planes.empty())
    problems.add("planes", "are measured in velocity images, and `plane` has none", "remove them");
}

/// Velocities on a plane become a profile, and nothing else.
void lay_plane_onto_opening(const MeasureCase& c, const VesselOfCase& vessel, const files::Say& say) {
  const auto plane = flow::read_plane_series(*c.plane, "plane");
  const auto opening = flow::opening_mesh(vessel.mesh, vessel.face(c.profile->opening));
  double mean = 0;
  const auto weights = flow::frame_weights(plane.times, plane.period);
  for (std::size_t k = 0; k < plane.times.size(); ++k) mean += weights[k] * plane.flow(k);
  say(fmt::format("plane: {} frames of {} points, mean flow {:.4g} ml/s", plane.times.size(), plane.points.size(),
                  mean / unit::ml));
  write_profile(c, opening, flow::plane_at_nodes(plane, opening, c.plane->turn), say);
}

}  // namespace

Schema<MeasureCase> MeasureCase::schema() {
  using M = MeasureCase;
  return Schema<M>("tunica measure", "File of `tunica measure`, in YAML like a case file.")
      .file("case", &M::case_file, "Case file whose lumen is looked at; its mesh is there")
      .section("velocity", &M::velocity, flow::SeriesFiles::schema(), "Velocity images over the beat")
      .section("plane", &M::plane, flow::PlaneFiles::schema(),
               "Or velocities on a plane, of this or another vessel: they are laid onto the opening of `profile`")
      .choice("background", &M::background,
              {{"none", -1}, {"constant", 0}, {"linear", 1}, {"quadratic", 2}, {"cubic", 3}},
              "Offset by eddy currents that is fitted to static tissue and taken away: a polynomial in space")
      .by_default("linear")
      .quantity("noise", &M::noise, config::dimension::velocity, config::above(0),
                "Standard deviation of the velocity of a voxel; found in static tissue when left out")
      .quantity("smoothing", &M::smoothing, config::dimension::length, config::above(0),
                "Length of correlation of the velocities in a section; when left out half its radius")
      .plausible("1 mm", "30 mm")
      .number("slab", &M::slab, config::range(0.5, 10), "Voxels before and behind a section that tell of it")
      .by_default()
      .map("planes", &M::planes, case_file::MeasuredPlane::schema(), "Planes through the lumen, by name")
      .by_default()
      .flag("openings", &M::openings, "Measure the flow through all openings of the lumen too")
      .by_default()
      .flag("balance", &M::balance,
            "Move the means of the openings by their shares of the variance so that what enters leaves")
      .by_default()
      .section("profile", &M::profile, profile_schema(), "Velocities of an opening as the condition of a run")
      .path("output", &M::output, "Folder of the results, relative to that of this file")
      .by_default("flow")
      .check(check_sources);
}

config::Parsed<MeasureCase> read_measure_case(const fs::path& file) {
  auto parsed = config::parse_file(MeasureCase::schema(), file);
  if (parsed.value.background == -1) parsed.value.background.reset();
  return parsed;
}

void measure(const MeasureCase& c, bool overwrite, const files::Say& say) {
  if (!overwrite &&
      (fs::exists(c.output / "flows.json") || (c.profile && fs::exists(profile_file(c, c.profile->opening)))))
    throw InputError(c.output.string(), "holds measured flow already", "give --overwrite, or another `output`");
  const files::FolderLock lock(c.output);
  if (!lock.taken_over().empty()) say("warning: " + lock.taken_over());
  files::try_outputs(c.output, {"flows.csv", "flows.json", "flows.svg"});
  const auto vessel = vessel_of_case(c.case_file);
  const auto sections = find_sections(c, vessel);
  if (c.plane) return lay_plane_onto_opening(c, vessel, say);
  const auto p = prepare(c, vessel, say);
  std::vector<flow::FlowCurve> curves;
  std::vector<int> signs;
  std::vector<std::string> left_out;
  for (std::size_t k = 0; k < sections.all.size(); ++k) {
    const auto& section = sections.all[k];
    try {
      const bool opening = sections.signs[k] != 0;
      const flow::ProfileFit fit(
          p.series, p.lumen, section, p.noise,
          {.length = c.smoothing, .slab = opening ? std::max(c.slab, slab_of_openings) : c.slab, .at_end = opening});
      curves.push_back(flow::flow_curve(p.series, fit, section));
      signs.push_back(sections.signs[k]);
    } catch (const InputError& error) {
      if (sections.signs[k] == 0) throw;  // a plane was asked for by name
      left_out.push_back(error.what());
      say(fmt::format("warning: left out: {}", error.what()));
    }
  }
  ordered_json report = {{"case", c.case_file.string()}, {"period_s", p.series.period}, {"velocities", p.done}};
  const bool whole = c.openings && left_out.empty();
  if (c.balance && whole) {
    const double lacked = flow::balance_means(curves, signs);
    say(fmt::format("balance of the openings: {:.3g} ml/s were left on average, shared among them", lacked / unit::ml));
    report["mass_left_before_balance_ml_s"] = lacked / unit::ml;
  } else if (c.balance && c.openings) {
    say("warning: the openings are not balanced, since not all of them could be measured");
  }
  report["left_out"] = left_out;
  report["flows"] = ordered_json::array();
  if (!curves.empty())
    say(fmt::format("\n{:<32} {:>10} {:>8} {:>10} {:>10} {:>8} {:>7}", "flow [ml/s]", "mean", "+-", "largest",
                    "smallest", "+-", "voxels"));
  for (const auto& curve : curves) {
    const auto entry = report_of(curve);
    report["flows"].push_back(entry);
    say(fmt::format("{:<32} {:>10.4g} {:>8.2g} {:>10.4g} {:>10.4g} {:>8.2g} {:>7}", curve.name,
                    entry["mean_ml_s"].get<double>(), entry["deviation_of_mean_ml_s"].get<double>(),
                    entry["largest_ml_s"].get<double>(), entry["smallest_ml_s"].get<double>(),
                    entry["deviation_by_noise_ml_s"].get<double>(), curve.voxels));
  }
  if (!curves.empty()) {
    files::write_atomically(c.output / "flows.csv", table_of(curves, p.series.times));
    plot_curves(curves, p.series.times, c.output / "flows.svg");
  }
  if (c.profile) {
    const auto at =
        std::find_if(curves.begin(), curves.end(), [&](const auto& q) { return q.name == c.profile->opening; });
    const auto opening = flow::opening_mesh(vessel.mesh, vessel.face(c.profile->opening));
    write_profile(c, opening, fitted_profile(c, vessel, p, opening, at == curves.end() ? nullptr : &*at, say), say);
  }
  files::write_atomically(c.output / "flows.json", config::json_text(report));
  say(fmt::format("\nflows.csv, flows.json, flows.svg in {}", c.output.string()));
}

}  // namespace tunica::stages
