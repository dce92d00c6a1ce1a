#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "tunica/analysis/frame_figures.hpp"
#include "tunica/base/units.hpp"
#include "tunica/config/json_text.hpp"
#include "tunica/drawing/plot.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/files/outputs.hpp"
#include "tunica/flow_imaging/inlet_profile.hpp"
#include "tunica/geometry/surface_file.hpp"
#include "tunica/stages/motion/moving_vessel.hpp"

namespace tunica::stages {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr double correlated = 3;         ///< smoothing lengths over which errors of the wall hang together
constexpr std::size_t ring_times = 200;  ///< of a table for a run, which takes straight lines between them

/// A quantity over the phases with one standard deviation of each value, in the unit of its name.
struct Curve {
  std::string name, unit;
  std::vector<double> values{}, deviations{};
  std::string heading() const { return fmt::format("{} [{}]", name, unit); }
};

Vec3<double> at_node(const std::vector<double>& displacement, std::int64_t node) {
  const double* u = displacement.data() + 3 * static_cast<std::size_t>(node);
  return {{u[0], u[1], u[2]}};
}

class Curves {
 public:
  Curves(const MotionCase& c, const MovingVessel& v, const std::vector<Phase>& phases)
      : case_(c), vessel_(v), phases_(phases) {
    for (std::size_t n = 0; n < v.nodes.size(); ++n) surface_of_[v.nodes[n]] = n;
  }

  /// Areas of planes, volumes, tears, the flap, points.
  std::vector<Curve> all() const {
    std::vector<Curve> curves;
    for (const auto& plane : vessel_.planes) curves.push_back(of_plane(plane));
    add_figures(curves);
    for (const auto& point : vessel_.points) curves.push_back(of_point(point));
    return curves;
  }

  /// One standard deviation of an area whose rim runs through some of these nodes [m^2]: errors of the wall hang
  /// together over some smoothing lengths, and along the rim they add up as independent ones.
  double deviation_of_area(double area, const std::vector<std::int64_t>& nodes, const Phase& phase) const {
    double squares = 0, count = 0;
    for (const auto node : nodes)
      if (const auto at = surface_of_.find(node); at != surface_of_.end()) {
        squares += phase.motion.deviation[at->second] * phase.motion.deviation[at->second];
        count += 1;
      }
    if (count == 0) return 0;
    const double rim = 2.5 * std::sqrt(M_PI * area);  // a circle has 2 sqrt(pi A), true lumens are flat
    return std::sqrt(squares / count * rim * correlated * case_.tracking.smoothing);
  }

 private:
  Curve of_plane(const flow_imaging::CrossSection& plane) const {
    Curve curve{.name = plane.name, .unit = "mm^2"};
    std::vector<std::int64_t> nodes;
    for (const auto& point : plane.on_mesh) nodes.push_back(point.a), nodes.push_back(point.b);
    for (const auto& phase : phases_) {
      const double area = flow_imaging::state_of(plane, {.displacement = phase.displacement}).area;
      curve.values.push_back(area * 1e6);
      curve.deviations.push_back(deviation_of_area(area, nodes, phase) * 1e6);
    }
    return curve;
  }

  /// Motion since the first phase, as a run records it since its start.
  Curve of_point(const TrackedPoint& point) const {
    Curve curve{.name = point.name, .unit = "mm"};
    const auto& place = vessel_.vessel.mesh.points[static_cast<std::size_t>(point.node)];
    std::size_t nearest = 0;
    for (std::size_t n = 0; n < vessel_.nodes.size(); ++n) {
      const auto& wall = vessel_.wall.surface.points;
      if (norm(wall[n] - place) < norm(wall[nearest] - place)) nearest = n;
    }
    const auto first = at_node(phases_.front().displacement, point.node);
    for (const auto& phase : phases_) {
      curve.values.push_back(norm(at_node(phase.displacement, point.node) - first) / unit::mm);
      curve.deviations.push_back(phase.motion.deviation[nearest] / unit::mm);
    }
    return curve;
  }

  /// As `tunica post` has them for a run.
  void add_figures(std::vector<Curve>& curves) const {
    const auto& data = vessel_.vessel.mesh;
    auto run = case_file::describe(vessel_.vessel.settings);
    const auto settings = post_settings(vessel_.vessel.settings);
    const analysis::FrameFigures figures(run, settings, data, vessel_.anatomy, {}, phases_.front().displacement);
    analysis::FieldFrame frame;
    frame.velocity.assign(3 * data.points.size(), 0.0);
    frame.pressure.assign(data.points.size(), 0.0);
    std::vector<std::string> tears;
    for (const auto& tear : vessel_.anatomy.tears) tears.push_back(tear.name);
    const auto first = curves.size();
    for (const auto& phase : phases_) {
      frame.displacement = phase.displacement;
      std::size_t at = first;
      const auto add = [&](const std::string& name, const char* unit, double value, double deviation) {
        if (at == curves.size()) curves.push_back({.name = name, .unit = unit});
        curves[at].values.push_back(value);
        curves[at++].deviations.push_back(deviation);
      };
      for (const auto& [name, value] : figures.evaluate(frame, {})) {
        if (name == analysis::column::true_volume || name == analysis::column::false_volume)
          add(name == analysis::column::true_volume ? "true lumen" : "false lumen", "ml", value / unit::ml, 0);
        else if (name == analysis::column::flap_mean)
          add("flap mean", "mm", value / unit::mm, mean_deviation(phase) / unit::mm);
        else if (name == analysis::column::flap_largest)
          add("flap largest", "mm", value / unit::mm, mean_deviation(phase) / unit::mm);
        for (const auto& tear : tears)
          if (name == analysis::column::tear(tear, "area")) add(tear, "mm^2", value * 1e6, 0);
      }
    }
  }

  static double mean_deviation(const Phase& phase) {
    double sum = 0;
    for (const double d : phase.motion.deviation) sum += d * d;
    return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, phase.motion.deviation.size())));
  }

  const MotionCase& case_;
  const MovingVessel& vessel_;
  const std::vector<Phase>& phases_;
  std::map<std::int64_t, std::size_t> surface_of_;
};

std::string table_of(const std::vector<Curve>& curves, const std::vector<Phase>& phases) {
  std::string text = "time [s]";
  for (const auto& c : curves) text += fmt::format(",{},{} deviation [{}]", c.heading(), c.name, c.unit);
  text += "\n";
  for (std::size_t k = 0; k < phases.size(); ++k) {
    text += fmt::format("{:.9g}", phases[k].time);
    for (const auto& c : curves) text += fmt::format(",{:.7g},{:.4g}", c.values[k], c.deviations[k]);
    text += "\n";
  }
  return text;
}

/// A line for each section of the aorta and phase.
std::string stations_of(const MovingVessel& v, const std::vector<Phase>& phases, const Curves& curves) {
  std::string text =
      "distance [mm],time [s],true lumen [mm^2],true lumen deviation [mm^2],false lumen [mm^2],"
      "false lumen deviation [mm^2]\n";
  for (const auto& station : v.anatomy.stations)
    for (const auto& phase : phases) {
      text += fmt::format("{:.6g},{:.9g}", station.distance / unit::mm, phase.time);
      for (const auto& section : station.sections) {
        std::vector<std::int64_t> nodes;
        for (const auto& t : section) nodes.insert(nodes.end(), t.nodes.begin(), t.nodes.end());
        const auto figures =
            analysis::evaluate(section, {.points = &v.vessel.mesh.points, .displacement = phase.displacement});
        const double area = norm(figures.area);
        text += fmt::format(",{:.7g},{:.4g}", area * 1e6, curves.deviation_of_area(area, nodes, phase) * 1e6);
      }
      text += "\n";
    }
  return text;
}

void write_surfaces(const MotionCase& c, const MovingVessel& v, const std::vector<Phase>& phases) {
  std::string list = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
  for (std::size_t k = 0; k < phases.size(); ++k) {
    auto surface = v.wall.surface;
    std::vector<double> displacement, deviation;
    for (std::size_t n = 0; n < surface.points.size(); ++n) {
      const auto& u = phases[k].motion.displacement[n];
      surface.points[n] = surface.points[n] + u;
      for (int d = 0; d < 3; ++d) displacement.push_back(u[d] / unit::mm);
      deviation.push_back(phases[k].motion.deviation[n] / unit::mm);
    }
    const auto name = fmt::format("motion_{:03}.vtp", k);
    geometry::write_surface(surface, c.output / name,
                            {{"displacement [mm]", std::move(displacement), 3}, {"deviation [mm]", deviation}});
    list += fmt::format("<DataSet timestep=\"{:.9g}\" file=\"{}\"/>\n", phases[k].time, name);
  }
  files::write_atomically(c.output / "motion.pvd", list + "</Collection>\n</VTKFile>\n");
}

/// Nodes of a face with their motion; those on edges have the mean of the ends.
void write_ring(const MotionCase& c, const MovingVessel& v, const std::string& name, const std::vector<Phase>& phases,
                const fs::path& file) {
  const auto& data = v.vessel.mesh;
  std::map<std::array<std::int64_t, 2>, bool> ends;  // of each node: itself twice, or those of its edge
  for (const auto& t : v.vessel.face(name).triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      ends[{t[i], t[i]}] = true;
      if (v.vessel.settings.elements == case_file::Elements::quadratic)
        ends[{std::min(t[i], t[(i + 1) % 3]), std::max(t[i], t[(i + 1) % 3])}] = true;
    }
  std::vector<Vec3<double>> points;
  for (const auto& [pair, _] : ends)
    points.push_back(0.5 *
                     (data.points[static_cast<std::size_t>(pair[0])] + data.points[static_cast<std::size_t>(pair[1])]));
  flow_imaging::NodalCourse course{.times = {}, .period = c.phases.period, .values = {}};
  for (const auto& phase : phases) {
    course.times.push_back(phase.time);
    auto& values = course.values.emplace_back();
    for (const auto& [pair, _] : ends)
      values.push_back(0.5 * (at_node(phase.displacement, pair[0]) + at_node(phase.displacement, pair[1])));
  }
  flow_imaging::write_nodal_table(
      points, course.times.size() < 3 ? course : flow_imaging::resampled(course, ring_times), "ux,uy,uz", file);
}

/// Where an opening goes as a whole, and how much wider it gets.
ordered_json opening_motion(const MovingVessel& v, const std::string& name, const std::vector<Phase>& phases) {
  const auto& triangles = v.vessel.face(name).triangles;
  ordered_json list = ordered_json::array();
  for (const auto& phase : phases) {
    Vec3<double> mean{}, vector{}, vector_then{};
    double area = 0;
    for (const auto& t : triangles) {
      Vec3<double> x[3], y[3], u{};
      for (std::size_t i = 0; i < 3; ++i) {
        const auto moved = at_node(phase.displacement, t[i]);
        x[i] = v.vessel.mesh.points[static_cast<std::size_t>(t[i])];
        y[i] = x[i] + moved;
        u = u + (1.0 / 3) * moved;
      }
      const auto a = 0.5 * cross(x[1] - x[0], x[2] - x[0]);
      vector = vector + a;
      vector_then = vector_then + 0.5 * cross(y[1] - y[0], y[2] - y[0]);
      mean = mean + norm(a) * u;
      area += norm(a);
    }
    mean = (1 / area) * mean;
    list.push_back(
        {{"time_s", phase.time},
         {"displacement_mm", ordered_json::array({mean[0] / unit::mm, mean[1] / unit::mm, mean[2] / unit::mm})},
         {"out_of_vessel_mm", dot(mean, vector) / norm(vector) / unit::mm},
         {"area_mm2", norm(vector_then) * 1e6}});
  }
  return {{"name", name}, {"phases", list}};
}

ordered_json report_of(const MotionCase& c, const MovingVessel& v, const std::vector<Phase>& phases,
                       const std::vector<Curve>& curves) {
  ordered_json report = {{"case", c.case_file.string()},
                         {"period_s", c.phases.period},
                         {"smoothing_mm", c.tracking.smoothing / unit::mm},
                         {"phases", ordered_json::array()},
                         {"curves", ordered_json::array()},
                         {"openings", ordered_json::array()}};
  for (const auto& phase : phases) {
    double largest = 0, squares = 0;
    for (const auto& u : phase.motion.displacement) largest = std::max(largest, norm(u));
    for (const double d : phase.motion.deviation) squares += d * d / static_cast<double>(phase.motion.deviation.size());
    report["phases"].push_back({{"file", phase.file},
                                {"time_s", phase.time},
                                {"seen_share", phase.seen},
                                {"residual_mm", phase.residual / unit::mm},
                                {"largest_displacement_mm", largest / unit::mm},
                                {"deviation_mm", std::sqrt(squares) / unit::mm}});
  }
  for (const auto& curve : curves) {
    const auto [least, most] = std::minmax_element(curve.values.begin(), curve.values.end());
    double mean = 0;
    for (const double value : curve.values) mean += value / static_cast<double>(curve.values.size());
    report["curves"].push_back(
        {{"name", curve.name}, {"unit", curve.unit}, {"smallest", *least}, {"largest", *most}, {"mean", mean}});
  }
  for (const auto& name : v.vessel.openings) report["openings"].push_back(opening_motion(v, name, phases));
  return report;
}

/// Change of each area against its mean.
void plot_curves(const std::vector<Curve>& curves, const std::vector<Phase>& phases, const fs::path& file) {
  std::vector<drawing::Series> series;
  for (const auto& curve : curves) {
    if (curve.unit != "mm^2" && curve.unit != "ml") continue;
    double mean = 0;
    for (const double value : curve.values) mean += value / static_cast<double>(curve.values.size());
    if (!(mean > 0)) continue;
    auto& line = series.emplace_back();
    line.name = curve.name;
    line.markers = true;
    for (std::size_t k = 0; k < phases.size(); ++k) {
      line.x.push_back(phases[k].time);
      line.y.push_back(100 * (curve.values[k] / mean - 1));
    }
  }
  if (series.empty()) return;
  drawing::write_plot(
      file.string(), series,
      {.title = "Areas and volumes over the beat", .x_label = "time [s]", .y_label = "off the mean [%]"});
}

/// The lines of a case that read what was found.
std::string lines_for_case(const MotionCase& c, const std::vector<Phase>& phases) {
  const auto folder = fs::absolute(c.output).lexically_normal();
  std::string text;
  const auto curve = [&](const std::string& name, const char* unit) {
    return fmt::format(
        "curve: {{file: {}, value_column: \"{} [{}]\", uncertainty_column: \"{} deviation [{}]\", time_unit: s, "
        "unit: {}}}",
        (folder / "curves.csv").string(), name, unit, name, unit, unit);
  };
  if (!c.planes.empty() || !c.points.empty()) text += "measured:\n";
  if (!c.planes.empty()) text += "  areas:\n";
  for (const auto& [name, plane] : c.planes) {
    const auto &x = plane.centre, &n = plane.normal;
    text += fmt::format(
        "    {}:\n      plane: {{centre: [{:.6g} mm, {:.6g} mm, {:.6g} mm], normal: [{:.6g}, {:.6g}, {:.6g}]}}\n      "
        "{}\n",
        name, 1e3 * x[0], 1e3 * x[1], 1e3 * x[2], n[0], n[1], n[2], curve(name, "mm^2"));
  }
  if (!c.points.empty()) text += "  displacements:           # of points in `output.points`\n";
  for (const auto& [name, _] : c.points)
    text += fmt::format("    {}:\n      point: {}\n      {}\n", name, name, curve(name, "mm"));
  if (!c.rings.empty()) text += "boundary:\n";
  for (const auto& ring : c.rings)
    text += fmt::format(
        "  {}:\n    displacement: {{over_face: {{table: {}, period: {:.9g} s, unit: m, length_unit: m, interpolation: "
        "nearest}}}}\n",
        ring, (folder / fmt::format("ring_{}.csv", ring)).string(), c.phases.period);
  double at_start = 0;
  for (const auto& u : phases.front().motion.displacement) at_start = std::max(at_start, norm(u));
  if (!text.empty() && at_start > 0)
    text +=
        "# Times are those of the phases, and the mesh is that of `mesh_at`: a run that starts from the mesh has to "
        "start at "
        "that phase of its inflow.\n# `shift` of a curve moves its times; motions of points count from the first "
        "phase.\n";
  return text;
}

}  // namespace

std::vector<std::string> motion_files() {
  return {"curves.csv", "stations.csv", "curves.svg", "motion.json", "motion.pvd", "motion_*.vtp", "ring_*.csv"};
}

void write_motion(const MotionCase& c, const MovingVessel& v, const std::vector<Phase>& phases, const files::Say& say) {
  const Curves curves(c, v, phases);
  const auto all = curves.all();
  files::remove_outputs(c.output, motion_files());
  files::write_atomically(c.output / "curves.csv", table_of(all, phases));
  if (!v.anatomy.stations.empty()) files::write_atomically(c.output / "stations.csv", stations_of(v, phases, curves));
  write_surfaces(c, v, phases);
  for (const auto& ring : c.rings) write_ring(c, v, ring, phases, c.output / fmt::format("ring_{}.csv", ring));
  plot_curves(all, phases, c.output / "curves.svg");
  const auto report = report_of(c, v, phases, all);
  say(fmt::format("\n{:<28} {:>6} {:>10} {:>10} {:>10}", "", "", "smallest", "largest", "mean"));
  for (const auto& curve : report["curves"])
    say(fmt::format("{:<28} {:>6} {:>10.4g} {:>10.4g} {:>10.4g}", curve["name"].get<std::string>(),
                    curve["unit"].get<std::string>(), curve["smallest"].get<double>(), curve["largest"].get<double>(),
                    curve["mean"].get<double>()));
  if (const auto lines = lines_for_case(c, phases); !lines.empty()) say("\nLines for a case:\n\n" + lines);
  files::write_atomically(c.output / "motion.json", config::json_text(report));
  say(fmt::format("curves.csv, stations.csv, motion.pvd with its files, motion.json{} in {}",
                  c.rings.empty() ? "" : ", ring_*.csv", c.output.string()));
}

}  // namespace tunica::stages
