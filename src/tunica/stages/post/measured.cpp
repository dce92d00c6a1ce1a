#include "tunica/stages/post/measured.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tunica/analysis/cycle.hpp"
#include "tunica/artifacts/histories.hpp"
#include "tunica/base/error.hpp"
#include "tunica/drawing/plot.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/files/csv_file.hpp"

namespace tunica::stages::post {

namespace {

using case_file::Measurement;
using case_file::MeasurementKind;
using nlohmann::ordered_json;
namespace dimension = config::dimension;

constexpr double agreeing = 2, doubtful = 3;  ///< standard deviations

std::string column_of(const std::string& name, const char* quantity) {
  return fmt::format("measured {} {}", name, quantity);
}

/// A computed course over the window, SI.
struct Computed {
  std::vector<double> times, values;

  /// By straight lines; the ends hold beyond them.
  double at(double t) const {
    const auto after = std::upper_bound(times.begin(), times.end(), t);
    if (after == times.begin()) return values.front();
    if (after == times.end()) return values.back();
    const auto k = static_cast<std::size_t>(after - times.begin());
    const double share = (t - times[k - 1]) / (times[k] - times[k - 1]);
    return (1 - share) * values[k - 1] + share * values[k];
  }
};

Computed at_opening(const Findings& f, const std::string& name, const std::string& quantity) {
  const auto at = std::find_if(f.openings.begin(), f.openings.end(), [&](const auto& o) { return o.name == name; });
  Computed c{at->times, quantity == "flow" ? at->flow : at->pressure};
  if (quantity == "flow" && name == f.data.faces[f.vessel.inlet].name)
    for (auto& v : c.values) v = -v;
  return c;
}

Computed at_point(const Findings& f, const std::string& name, const std::string& quantity) {
  const auto table = files::read_csv(f.results / "points.csv", "run the case again, with the point in `output.points`");
  const auto times = artifacts::si_column(table, "time", dimension::time);
  std::vector<std::vector<double>> columns;
  if (quantity == "pressure")
    columns.push_back(artifacts::si_column(table, name + " pressure", dimension::pressure));
  else
    for (const char* axis : {"x", "y", "z"})
      columns.push_back(artifacts::si_column(table, fmt::format("{} displacement {}", name, axis), dimension::length));
  Computed c;
  std::size_t first = 0;
  for (std::size_t k = 0; k < times.size(); ++k) {
    if (times[k] < f.window.from || times[k] > f.window.until) continue;
    if (c.times.empty()) first = k;
    c.times.push_back(times[k]);
    double squares = 0;
    for (const auto& column : columns) squares += std::pow(column[k] - column[first], 2);
    c.values.push_back(quantity == "pressure" ? columns[0][k] : std::sqrt(squares));
  }
  if (c.times.size() < 3)
    throw InputError(table.file.string(), "has fewer than three lines in the window", "run the case again");
  return c;
}

Computed computed_of(const Findings& f, const std::string& name, const Measurement& m, const MeasurementKind& kind) {
  if (m.opening) return at_opening(f, *m.opening, kind.quantity);
  if (m.point) return at_point(f, *m.point, kind.quantity);
  return {f.times, f.figures.column(column_of(name, kind.quantity))};
}

ordered_json row_of(const std::string& what, double measured, double deviation, double computed, double unit) {
  const double off = (computed - measured) / deviation;
  const char* verdict = std::abs(off) <= agreeing ? "agrees" : std::abs(off) <= doubtful ? "doubtful" : "differs";
  return {{"what", what},
          {"measured", measured / unit},
          {"deviation", deviation / unit},
          {"computed", computed / unit},
          {"difference", (computed - measured) / unit},
          {"difference_in_deviations", off},
          {"verdict", verdict}};
}

/// Measured values, and what is computed at the same times.
struct Course {
  std::vector<double> times, measured, deviations, computed;  ///< times: since the start of the window
};

Course course_of(const Findings& f, const Measurement& m, const Computed& computed) {
  const auto read = case_file::read_course(m);
  const double period = f.window.until - f.window.from;
  Course c;
  std::vector<std::size_t> order(read.times.size());
  std::vector<double> within;
  for (std::size_t k = 0; k < order.size(); ++k) {
    order[k] = k;
    within.push_back(read.times[k] - period * std::floor(read.times[k] / period));
  }
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return within[a] < within[b]; });
  for (const auto k : order) {
    c.times.push_back(within[k]);
    c.measured.push_back(read.values[k]);
    c.deviations.push_back(read.deviations[k]);
    c.computed.push_back(computed.at(f.window.from + within[k]));
  }
  return c;
}

ordered_json rows_of_course(const Course& c, const MeasurementKind& kind) {
  const auto n = static_cast<double>(c.times.size());
  double measured = 0, computed = 0, variance = 0, squares = 0, in_deviations = 0;
  for (std::size_t k = 0; k < c.times.size(); ++k) {
    const double off = c.computed[k] - c.measured[k];
    measured += c.measured[k] / n;
    computed += c.computed[k] / n;
    variance += std::pow(c.deviations[k] / n, 2);
    squares += off * off / n;
    in_deviations += std::pow(off / c.deviations[k], 2) / n;
  }
  const auto extreme = [&](const char* what, bool largest) {
    const auto by = [largest](double a, double b) { return largest ? a < b : b < a; };
    const auto at = std::max_element(c.measured.begin(), c.measured.end(), by);
    return row_of(what, *at, c.deviations[static_cast<std::size_t>(at - c.measured.begin())],
                  *std::max_element(c.computed.begin(), c.computed.end(), by), kind.si);
  };
  ordered_json rows = {row_of("mean", measured, std::sqrt(variance), computed, kind.si), extreme(kind.largest, true),
                       extreme(kind.smallest, false)};
  const double rms = std::sqrt(in_deviations);
  rows.push_back({{"what", "course (rms)"},
                  {"measured", nullptr},
                  {"deviation", nullptr},
                  {"computed", nullptr},
                  {"difference", std::sqrt(squares) / kind.si},
                  {"difference_in_deviations", rms},
                  {"verdict", rms <= agreeing   ? "agrees"
                              : rms <= doubtful ? "doubtful"
                                                : "differs"}});
  return rows;
}

ordered_json rows_of_values(const Measurement& m, const Computed& computed, const MeasurementKind& kind) {
  const auto c = analysis::course(computed.times, computed.values);
  ordered_json rows = ordered_json::array();
  const auto add = [&](const char* what, const std::optional<double>& measured, double value) {
    if (measured) rows.push_back(row_of(what, *measured, m.uncertainty.value(), value, kind.si));
  };
  add(kind.largest, m.largest, c.largest);
  add(kind.smallest, m.smallest, c.smallest);
  add("mean", m.mean, c.mean);
  return rows;
}

/// The measured curve with its deviations over the computed one; single values as lines.
void draw(const std::filesystem::path& file, const std::string& name, const Measurement& m, const Computed& computed,
          const std::optional<Course>& course, double from, const MeasurementKind& kind) {
  drawing::Series line{.name = "computed", .colour = 0};
  for (std::size_t k = 0; k < computed.times.size(); ++k) {
    line.x.push_back(computed.times[k] - from);
    line.y.push_back(computed.values[k] / kind.si);
  }
  std::vector<drawing::Series> series{line};
  if (course) {
    drawing::Series points{.name = "measured", .line = false, .markers = true, .colour = 1},
        low{.name = "one standard deviation", .dashed = true, .colour = 1}, high{.dashed = true, .colour = 1};
    for (std::size_t k = 0; k < course->times.size(); ++k) {
      for (auto* curve : {&points, &low, &high}) curve->x.push_back(course->times[k]);
      points.y.push_back(course->measured[k] / kind.si);
      low.y.push_back((course->measured[k] - course->deviations[k]) / kind.si);
      high.y.push_back((course->measured[k] + course->deviations[k]) / kind.si);
    }
    for (auto* curve : {&points, &low, &high}) series.push_back(std::move(*curve));
  } else {
    bool named = false;
    for (const auto& value : {m.largest, m.smallest, m.mean}) {
      if (!value) continue;
      series.push_back({.name = named ? "" : "measured",
                        .x = {line.x.front(), line.x.back()},
                        .y = {*value / kind.si, *value / kind.si},
                        .dashed = true,
                        .colour = 1});
      named = true;
    }
  }
  drawing::write_plot(file.string(), series,
                      {.title = name,
                       .x_label = "time since the start of the beat [s]",
                       .y_label = fmt::format("{} [{}]", kind.quantity, kind.unit)});
}

std::string place_of(const Measurement& m) {
  if (m.opening) return *m.opening;
  if (m.point) return "point " + *m.point;
  const auto& c = m.plane->centre;
  return fmt::format("plane at ({:.1f}, {:.1f}, {:.1f}) mm", 1e3 * c[0], 1e3 * c[1], 1e3 * c[2]);
}

}  // namespace

MeasuredSections find_measured_sections(const case_file::MeasuredCase& measured, const case_file::Case& c,
                                        const mesh::MeshData& data) {
  MeasuredSections sections;
  std::vector<std::string> known;
  for (const auto& face : data.faces)
    if (data.regions[static_cast<std::size_t>(face.region)].kind == mesh::RegionKind::lumen) known.push_back(face.name);
  const auto sticks = case_file::sticking_faces(c, known);
  std::erase_if(known, [&](const auto& n) { return std::find(sticks.begin(), sticks.end(), n) != sticks.end(); });
  std::vector<Problem> problems;
  for (const auto& kind : case_file::measurement_kinds())
    for (const auto& [name, m] : measured.*kind.entries) {
      const auto where = fmt::format("measured.{}.{}", kind.key, name);
      if (m.opening && std::find(known.begin(), known.end(), *m.opening) == known.end())
        problems.push_back({where + ".opening", fmt::format("the lumen has no opening '{}'", *m.opening),
                            "use one of: " + files::listed(known)});
      if (!m.plane) continue;
      try {
        sections.emplace_back(
            name, flow_imaging::plane_section(data, m.plane->centre, m.plane->normal, name, where + ".plane"));
      } catch (const InputError& error) {
        problems.insert(problems.end(), error.problems().begin(), error.problems().end());
      }
    }
  if (!problems.empty()) throw InputError(std::move(problems));
  return sections;
}

void add_sections(const MeasuredSections& sections, const analysis::FieldFrame& frame,
                  const std::vector<double>& mesh_velocity, analysis::FigureTable::Row& row) {
  for (const auto& [name, section] : sections) {
    const auto state = flow_imaging::state_of(section, {.displacement = frame.displacement,
                                                        .velocity = frame.velocity,
                                                        .mesh_velocity = mesh_velocity,
                                                        .pressure = frame.pressure});
    row.emplace_back(column_of(name, "area"), state.area);
    row.emplace_back(column_of(name, "flow"), state.flow);
    row.emplace_back(column_of(name, "pressure"), state.pressure);
  }
}

ordered_json compare_measured(const Findings& f, const case_file::MeasuredCase& measured,
                              const std::filesystem::path& folder, ordered_json& files) {
  ordered_json list = ordered_json::array();
  for (const auto& kind : case_file::measurement_kinds())
    for (const auto& [name, m] : measured.*kind.entries) {
      const auto computed = computed_of(f, name, m, kind);
      std::optional<Course> course;
      if (m.curve) course = course_of(f, m, computed);
      const std::string file = "measured_" + name;
      draw(folder / (file + ".svg"), name, m, computed, course, f.window.from, kind);
      files.push_back(file + ".svg");
      if (course) {
        std::string text = fmt::format("time [s],measured [{0}],deviation [{0}],computed [{0}]\n", kind.unit);
        for (std::size_t k = 0; k < course->times.size(); ++k)
          text += fmt::format("{:.9g},{:.7g},{:.5g},{:.7g}\n", course->times[k], course->measured[k] / kind.si,
                              course->deviations[k] / kind.si, course->computed[k] / kind.si);
        files::write_atomically(folder / (file + ".csv"), text);
        files.push_back(file + ".csv");
      }
      list.push_back({{"name", name},
                      {"quantity", kind.quantity},
                      {"unit", kind.unit},
                      {"place", place_of(m)},
                      {"plot", file + ".svg"},
                      {"rows", course ? rows_of_course(*course, kind) : rows_of_values(m, computed, kind)}});
    }
  return list;
}

std::string measured_text(const ordered_json& list) {
  std::string text = "held against measurements:\n";
  const auto number = [](const ordered_json& v) {
    return v.is_number() ? fmt::format("{:.4g}", v.get<double>()) : "-";
  };
  for (const auto& m : list)
    for (const auto& row : m["rows"])
      text += fmt::format("  {} {} [{}]: measured {} +- {}, computed {}, difference {} ({} deviations): {}\n",
                          m["name"].get<std::string>(), row["what"].get<std::string>(), m["unit"].get<std::string>(),
                          number(row["measured"]), number(row["deviation"]), number(row["computed"]),
                          number(row["difference"]), number(row["difference_in_deviations"]),
                          row["verdict"].get<std::string>());
  return text;
}

}  // namespace tunica::stages::post
