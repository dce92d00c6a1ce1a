#include "tunica/artifacts/histories.hpp"

#include <fmt/format.h>

#include <cassert>
#include <charconv>
#include <cmath>
#include <fstream>

#include "tunica/base/error.hpp"
#include "tunica/config/units.hpp"
#include "tunica/files/atomic_file.hpp"

namespace tunica::artifacts {

namespace dimension = config::dimension;
namespace fs = std::filesystem;

namespace {

/// Lines of `file` up to `step`, the header included. A last line without its end was being written when a run died.
std::string kept_lines(const fs::path& file, const std::string& header, std::int64_t step) {
  std::ifstream in(file);
  if (!in)
    throw InputError(file.string(), "the history to be continued is missing",
                     "put it back, or begin anew with --overwrite");
  std::string line, text;
  std::getline(in, line);
  if (line != header)
    throw InputError(file.string(), fmt::format("has the columns `{}`, this run has `{}`", line, header),
                     "restart with the faces and output units of the case that wrote it, or in another directory");
  text = header + "\n";
  while (std::getline(in, line) && !in.eof()) {
    std::int64_t number = 0;
    const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), number);
    if (error != std::errc{} || number > step) break;
    text += line + "\n";
  }
  return text;
}

}  // namespace

CsvTable::CsvTable(const fs::path& file, std::vector<std::string> columns, std::optional<std::int64_t> continue_from)
    : file_(file), columns_(columns.size()) {
  std::string header = "step";
  for (const auto& column : columns) header += "," + column;
  const std::string text = continue_from ? kept_lines(file, header, *continue_from) : header + "\n";
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
    faces_.emplace(folder / "faces.csv", columns, continue_from);
  }
  if (!outlets.empty()) {
    std::vector<std::string> columns{time};
    for (const auto& o : outlets)
      columns.insert(columns.end(), {o.face() + " flow " + flow, o.face() + " pressure " + pressure,
                                     o.face() + " stored pressure " + pressure});
    outlets_.emplace(folder / "outlets.csv", columns, continue_from);
  }
  balance_.emplace(
      folder / "balance.csv",
      std::vector<std::string>{
          time, "lumen volume " + volume, "wall volume " + volume, "dV/dt " + flow, "mass residual " + flow,
          "relative mass residual", "fluid kinetic energy [J]", "wall kinetic energy [J]", "wall strain energy [J]",
          "viscous dissipation [W]", "numerical dissipation [W]", "power at openings [W]", "power of wall loads [W]",
          "interface power lumen [W]", "interface power wall [W]", "interface power residual [W]",
          fmt::format("max displacement [{}]", u.length), fmt::format("max velocity [{}]", u.velocity), "mesh quality"},
      continue_from);
  steps_.emplace(folder / "steps.csv",
                 std::vector<std::string>{time, step_size, "newton iterations", "linear iterations", "mesh iterations",
                                          "first norm", "last norm", "assembly [s]", "set-up [s]", "linear [s]",
                                          "mesh [s]", "total [s]"},
                 continue_from);
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
  for (const auto* table : {&faces_, &outlets_, &balance_, &steps_})
    if (*table) (*table)->sync();
}

void Histories::append(const StepHistory& step, const std::vector<bc::Outlet>& outlets) {
  if (faces_) {
    std::vector<double> line{per_si_.time * step.evaluated};
    for (const auto& face : step.record.faces)
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
