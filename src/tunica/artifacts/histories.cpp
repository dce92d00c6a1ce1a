#include "tunica/artifacts/histories.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>
#include <fstream>

#include "tunica/base/error.hpp"
#include "tunica/base/text.hpp"
#include "tunica/config/units.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/files/outputs.hpp"

namespace tunica::artifacts {

namespace dimension = config::dimension;
namespace fs = std::filesystem;

namespace {

/// The step of a line with so many numbers, none when it is another text.
std::optional<std::int64_t> step_of_line(const std::string& line, std::ptrdiff_t numbers) {
  std::int64_t step = 0;
  if (std::count(line.begin(), line.end(), ',') + 1 != numbers) return std::nullopt;
  const char *end = line.data() + line.size(), *cell = line.data();
  for (bool first = true; cell <= end; first = false) {
    const char* comma = std::find(cell, end, ',');
    double value = 0;
    const auto [stop, error] = first ? std::from_chars(cell, comma, step) : std::from_chars(cell, comma, value);
    if (error != std::errc{} || stop != comma) return std::nullopt;
    cell = comma + 1;
  }
  return step;
}

constexpr std::size_t longest_shown = 2000;  // of a header

std::string missing_steps(std::int64_t from, std::int64_t to) {
  return from == to ? fmt::format("the line of step {} is missing", from)
                    : fmt::format("the lines of steps {} to {} are missing", from, to);
}

/// Only the first few are told.
std::vector<std::string> shortened(std::vector<std::string> damage, const fs::path& file) {
  constexpr std::size_t most = 4;
  if (damage.size() <= most) return damage;
  const std::size_t more = damage.size() - most;
  damage.resize(most);
  damage.push_back(fmt::format("{}: and so on in {} more places", file.string(), more));
  return damage;
}

/// Lines of a history that is continued.
class KeptLines {
 public:
  KeptLines(const fs::path& file, std::int64_t last, CsvTable::Lines lines)
      : file_(file), last_(last), every_step_(lines == CsvTable::Lines::for_every_step) {}

  /// False when the line belongs to a step after the last one.
  bool add(const std::string& line, int number, std::ptrdiff_t cells) {
    const auto step = step_of_line(line, cells);
    if (step && *step > last_) return false;
    if (!step) {
      bad_.push_back(fmt::format("{}:{}: is no line of {} numbers, and is dropped", file_.string(), number, cells));
    } else if (previous_ && *step <= *previous_) {
      bad_.push_back(fmt::format("{}:{}: repeats step {}, and is dropped", file_.string(), number, *step));
    } else {
      if (every_step_ && previous_ && *step > *previous_ + 1) tell_gap(*previous_ + 1, *step - 1);
      damage_.insert(damage_.end(), bad_.begin(), bad_.end());
      bad_.clear();
      previous_ = step;
      if (!first_) first_ = step;
      text_ += line + "\n";
    }
    return true;
  }
  /// A last line without its end was being written when a run died.
  void finish() {
    const std::int64_t reached = previous_.value_or(0);
    if (every_step_ && reached < last_) {
      damage_.insert(damage_.end(), bad_.begin(), bad_.end());
      tell_gap(reached + 1, last_);
    }
  }
  const std::string& text() const { return text_; }
  std::optional<std::int64_t> first() const { return first_; }
  std::optional<std::int64_t> last() const { return previous_; }
  std::vector<std::string> damage() const { return shortened(damage_, file_); }

 private:
  void tell_gap(std::int64_t from, std::int64_t to) {
    damage_.push_back(fmt::format("{}: {}", file_.string(), missing_steps(from, to)));
  }

  const fs::path& file_;
  std::int64_t last_;
  bool every_step_;
  std::optional<std::int64_t> first_, previous_;
  std::string text_;
  std::vector<std::string> damage_, bad_;  ///< `bad_`: since the last line that is kept
};

/// A line as it was written: an editor may have saved the file with the line ends of another system.
std::istream& take_line(std::istream& in, std::string& line) {
  std::getline(in, line);
  if (line.ends_with('\r')) line.pop_back();
  return in;
}

/// Lines of `file` up to `step`, the header included, and what is wrong with them.
KeptLines kept_lines(const fs::path& file, const std::string& header, std::int64_t step, CsvTable::Lines lines) {
  files::refuse_other_than_file(file);
  std::ifstream in(file);
  if (!in)
    throw InputError(file.string(), "the history to be continued is missing",
                     "put it back, or begin anew with --overwrite");
  std::string line;
  take_line(in, line);
  if (line != header)
    throw InputError(
        file.string(),
        fmt::format("has the columns `{}`, this run has `{}`", text::printable(line, longest_shown), header),
        "restart with the faces and output units of the case that wrote it, or in another directory");
  KeptLines kept(file, step, lines);
  const auto cells = std::count(header.begin(), header.end(), ',') + 1;
  for (int number = 2; take_line(in, line) && !in.eof() && kept.add(line, number, cells);) ++number;
  kept.finish();
  return kept;
}

}  // namespace

std::vector<HistoryBreak> breaks_of(const files::CsvColumns& history) {
  std::vector<HistoryBreak> breaks;
  const auto& steps = history.column("step");
  for (std::size_t k = 1; k < steps.size(); ++k) {
    const auto before = std::llround(steps[k - 1]), step = std::llround(steps[k]);
    if (step == before + 1) continue;
    const std::string what =
        step > before ? missing_steps(before + 1, step - 1) : fmt::format("step {} follows step {}", step, before);
    breaks.push_back({k, what});
  }
  return breaks;
}

std::vector<double> si_column(const files::CsvColumns& table, const std::string& name, const config::Dimension& due) {
  for (std::size_t k = 0; k < table.headers.size(); ++k) {
    const std::string& header = table.headers[k];
    if (!header.starts_with(name + " [") || !header.ends_with("]")) continue;
    const double factor = config::unit_factor(header.substr(name.size() + 2, header.size() - name.size() - 3), due);
    auto values = table.columns[k];
    for (auto& v : values) v *= factor;
    return values;
  }
  throw InputError(table.file.string(), fmt::format("no column is called '{} [unit]'", name),
                   "run the case again, or choose from: " + files::listed(table.headers));
}

CsvTable::CsvTable(const fs::path& file, std::vector<std::string> columns, std::optional<std::int64_t> continue_from,
                   Lines lines)
    : file_(file), columns_(columns.size()) {
  std::string header = "step";
  for (const auto& column : columns) header += "," + column;
  std::string text = header + "\n";
  if (continue_from) {
    const KeptLines kept = kept_lines(file, header, *continue_from, lines);
    text += kept.text();
    damage_ = kept.damage();
    first_step_ = kept.first();
    last_step_ = kept.last();
  }
  try {
    files::write_atomically(file, text);
  } catch (const SolverError& error) {
    throw InputError(file.string(), error.what(), "choose an output directory that can be written");
  }
}

void CsvTable::append(std::int64_t step, std::span<const double> values) {
  assert(values.size() == columns_);
  std::string line = std::to_string(step);
  for (const double v : values) line += fmt::format(",{:.10g}", v);
  line += "\n";
  files::append(file_, line);
}

void CsvTable::sync() const { files::sync_file(file_); }

CsvTable later_history(const fs::path& file, std::vector<std::string> columns,
                       std::optional<std::int64_t> continue_from, std::vector<std::string>& told) {
  const bool lacks = continue_from && !fs::exists(fs::symlink_status(file));
  if (lacks)
    told.push_back(fmt::format("{}: is missing in the run to be continued, and begins after step {}", file.string(),
                               *continue_from));
  return {file, std::move(columns), lacks ? std::nullopt : continue_from, CsvTable::Lines::for_every_step};
}

Histories::Histories(const fs::path& folder, const case_file::Case& c, const std::vector<std::string>& faces,
                     const std::vector<bc::Outlet>& outlets, std::optional<std::int64_t> continue_from)
    : per_si_{} {
  const case_file::OutputUnits& u = c.output.units;
  const double length = config::unit_factor(u.length, dimension::length);
  per_si_ = {.time = 1 / config::unit_factor(u.time, dimension::time),
             .area = 1 / (length * length),
             .volume = 1 / (length * length * length),
             .flow = 1 / config::unit_factor(u.flow, dimension::volume_flow),
             .pressure = 1 / config::unit_factor(u.pressure, dimension::pressure),
             .length = 1 / length,
             .velocity = 1 / config::unit_factor(u.velocity, dimension::velocity)};
  const bool statics = std::holds_alternative<case_file::StaticWall>(c.analysis);
  if (statics) per_si_.time = 1;
  const std::string time = statics ? "load factor" : fmt::format("time [{}]", u.time),
                    step_size = statics ? "load step" : fmt::format("dt [{}]", u.time),
                    area = fmt::format("[{}^2]", u.length), volume = fmt::format("[{}^3]", u.length),
                    flow = fmt::format("[{}]", u.flow), pressure = fmt::format("[{}]", u.pressure);
  if (c.solves_fluid()) {
    std::vector<std::string> columns{time};
    for (const auto& face : faces)
      columns.insert(columns.end(), {face + " flow " + flow, face + " pressure " + pressure, face + " area " + area});
    faces_.emplace(folder / "faces.csv", columns, continue_from, CsvTable::Lines::for_every_step);
  }
  if (!outlets.empty()) {
    std::vector<std::string> columns{time};
    for (const auto& o : outlets)
      columns.insert(columns.end(), {o.face() + " flow " + flow, o.face() + " pressure " + pressure,
                                     o.face() + " stored pressure " + pressure});
    outlets_.emplace(folder / "outlets.csv", columns, continue_from, CsvTable::Lines::for_every_step);
  }
  balance_.emplace(
      folder / "balance.csv",
      std::vector<std::string>{
          time, "lumen volume " + volume, "wall volume " + volume, "dV/dt " + flow, "mass residual " + flow,
          "relative mass residual", "fluid kinetic energy [J]", "wall kinetic energy [J]", "wall strain energy [J]",
          "viscous dissipation [W]", "numerical dissipation [W]", "power at openings [W]", "power of wall loads [W]",
          "interface power lumen [W]", "interface power wall [W]", "interface power residual [W]",
          fmt::format("max displacement [{}]", u.length), fmt::format("max velocity [{}]", u.velocity), "mesh quality"},
      continue_from, CsvTable::Lines::for_every_step);
  steps_.emplace(folder / "steps.csv",
                 std::vector<std::string>{time, step_size, "newton iterations", "linear iterations", "mesh iterations",
                                          "first norm", "last norm", "assembly [s]", "set-up [s]", "linear [s]",
                                          "mesh [s]", "total [s]"},
                 continue_from, CsvTable::Lines::for_every_step);
  open_points_and_forces(folder, c, faces, continue_from);
  open_inflows(folder, c, faces, continue_from);
}

namespace {

/// "<name> <what> x [unit]" and so on.
void add_vector(std::vector<std::string>& columns, const std::string& name, const char* what, const std::string& unit) {
  for (const char* axis : {"x", "y", "z"}) columns.push_back(fmt::format("{} {} {} [{}]", name, what, axis, unit));
}

}  // namespace

void Histories::open_points_and_forces(const fs::path& folder, const case_file::Case& c,
                                       const std::vector<std::string>& faces,
                                       std::optional<std::int64_t> continue_from) {
  const case_file::OutputUnits& u = c.output.units;
  const bool statics = std::holds_alternative<case_file::StaticWall>(c.analysis);
  const std::string time = statics ? "load factor" : fmt::format("time [{}]", u.time);
  if (!c.output.points.empty()) {
    std::vector<std::string> columns{time};
    for (const auto& [name, probe] : c.output.points) {
      add_vector(columns, name, "displacement", u.length);
      add_vector(columns, name, "velocity", u.velocity);
      columns.push_back(fmt::format("{} pressure [{}]", name, u.pressure));
    }
    points_.emplace(folder / "points.csv", columns, continue_from, CsvTable::Lines::for_every_step);
  }
  if (!c.output.forces || !c.solves_fluid()) return;
  std::vector<std::string> columns{time};
  for (const auto& face : sticking_faces(c, faces)) add_vector(columns, face, "force", "N");
  forces_.emplace(folder / "forces.csv", columns, continue_from, CsvTable::Lines::for_every_step);
}

void Histories::open_inflows(const fs::path& folder, const case_file::Case& c, const std::vector<std::string>& faces,
                             std::optional<std::int64_t> continue_from) {
  if (!c.solves_fluid()) return;
  std::vector<std::string> columns{fmt::format("time [{}]", c.output.units.time)};
  for (const auto& face : faces) {
    const bool prescribed = std::any_of(c.boundary.begin(), c.boundary.end(), [&](const auto& b) {
      return b.first == face && std::holds_alternative<bc::Flow>(b.second);
    });
    if (!prescribed) continue;
    for (const char* which : {"prescribed flow", "flow"})
      columns.push_back(fmt::format("{} {} [{}]", face, which, c.output.units.flow));
    columns.push_back(face + " relative difference");
  }
  if (columns.size() > 1) inflows_ = later_history(folder / "inflows.csv", columns, continue_from, begun_);
}

void Histories::append_inflows(const StepHistory& step) {
  if (!inflows_) return;
  std::vector<double> line{per_si_.time * step.evaluated};
  for (const auto& face : step.record.faces) {
    if (!face.prescribed) continue;
    const double difference = std::abs(face.flow - *face.prescribed);
    line.insert(line.end(), {per_si_.flow * *face.prescribed, per_si_.flow * face.flow,
                             difference > 0 ? difference / step.record.largest_flow : 0.0});
  }
  inflows_->append(step.step, line);
}

std::vector<std::string> Histories::damage() const {
  std::vector<std::string> all = begun_;
  std::optional<std::int64_t> first;
  for (const auto* table : {&faces_, &outlets_, &balance_, &steps_, &points_, &forces_, &inflows_}) {
    if (!*table) continue;
    all.insert(all.end(), (*table)->damage().begin(), (*table)->damage().end());
    if (const auto step = (*table)->first_step(); step) first = std::min(first.value_or(*step), *step);
  }
  for (const auto* table : {&faces_, &outlets_, &balance_, &steps_, &points_, &forces_, &inflows_})
    if (*table && (*table)->first_step() > first)
      all.push_back(
          fmt::format("{}: {}", (*table)->file().string(), missing_steps(*first, *(*table)->first_step() - 1)));
  return all;
}

std::vector<double> Histories::balance_line(const StepHistory& step) const {
  const auto& r = step.record;
  return {per_si_.time * step.evaluated,
          per_si_.volume * r.lumen_volume,
          per_si_.volume * r.wall_volume,
          per_si_.flow * r.volume_rate,
          per_si_.flow * r.mass_residual,
          r.largest_flow > 0 ? std::abs(r.mass_residual) / r.largest_flow : 0.0,
          r.fluid_kinetic,
          r.wall_kinetic,
          r.wall_strain,
          r.viscous_dissipation,
          r.numerical_dissipation,
          r.opening_power,
          r.wall_load_power,
          r.interface_power_lumen,
          r.interface_power_wall,
          r.interface_power_lumen + r.interface_power_wall,
          per_si_.length * r.max_displacement,
          per_si_.velocity * r.max_velocity,
          r.mesh_quality};
}

void Histories::sync() const {
  for (const auto* table : {&faces_, &outlets_, &balance_, &steps_, &points_, &forces_, &inflows_})
    if (*table) (*table)->sync();
}

void Histories::append_points_and_forces(const StepHistory& step) {
  if (points_) {
    std::vector<double> line{per_si_.time * step.time};
    for (const auto& p : step.points) {
      for (int i = 0; i < 3; ++i) line.push_back(per_si_.length * p.displacement[i]);
      for (int i = 0; i < 3; ++i) line.push_back(per_si_.velocity * p.velocity[i]);
      line.push_back(per_si_.pressure * p.pressure);
    }
    points_->append(step.step, line);
  }
  if (forces_) {
    std::vector<double> line{per_si_.time * step.evaluated};
    for (const auto& face : step.record.wall_forces)
      for (int i = 0; i < 3; ++i) line.push_back(face.force[i]);
    forces_->append(step.step, line);
  }
}

void Histories::append(const StepHistory& step, const std::vector<bc::Outlet>& outlets) {
  if (faces_) {
    std::vector<double> line{per_si_.time * (step.faces_at_end ? step.time : step.evaluated)};
    for (const auto& face : step.faces_at_end ? *step.faces_at_end : step.record.faces)
      line.insert(line.end(),
                  {per_si_.flow * face.flow, per_si_.pressure * face.mean_pressure, per_si_.area * face.area});
    faces_->append(step.step, line);
  }
  if (outlets_) {
    std::vector<double> line{per_si_.time * step.time};
    for (const auto& o : outlets)
      line.insert(line.end(),
                  {per_si_.flow * o.flow(), per_si_.pressure * o.pressure(), per_si_.pressure * o.stored_pressure()});
    outlets_->append(step.step, line);
  }
  balance_->append(step.step, balance_line(step));
  append_points_and_forces(step);
  append_inflows(step);
  int mesh_iterations = 0;
  for (const auto& iteration : step.report.iterations) mesh_iterations += iteration.mesh_iterations;
  const auto& t = step.report.timings;
  const double line[] = {per_si_.time * step.time,
                         per_si_.time * step.dt,
                         static_cast<double>(step.report.iterations.size()),
                         static_cast<double>(step.report.linear_iterations()),
                         static_cast<double>(mesh_iterations),
                         step.report.iterations.empty() ? step.report.final_norm : step.report.iterations[0].norm,
                         step.report.final_norm,
                         t.assembly,
                         t.set_up,
                         t.linear,
                         t.mesh,
                         t.total};
  steps_->append(step.step, line);
}

}  // namespace tunica::artifacts
