#include "tunica/stages/prestress/steady_flow.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tunica/base/error.hpp"
#include "tunica/coupling/nodal.hpp"
#include "tunica/parallel/agree.hpp"

namespace tunica::stages {

namespace {

constexpr int most_halvings = 6;

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// 0 for a condition that is no outlet.
double conductance(const bc::Condition& condition) {
  if (const auto* r = std::get_if<bc::Resistance>(&condition)) return 1.0 / r->resistance;
  if (const auto* r = std::get_if<bc::Rcr>(&condition)) return 1.0 / (r->proximal + r->distal);
  return 0.0;
}

void check_inflow(const FaceConditions& lumen, const case_file::SteadyFlow& flow) {
  std::vector<Problem> problems;
  int flows = 0;
  for (const auto& [face, condition] : lumen) {
    flows += std::holds_alternative<bc::Flow>(condition) ? 1 : 0;
    if (std::holds_alternative<bc::Velocity>(condition) || std::holds_alternative<bc::Traction>(condition) ||
        std::holds_alternative<bc::VelocityProfile>(condition))
      problems.push_back({"boundary." + face, fmt::format("{} has no place in the steady flow", bc::name(condition)),
                          "use flow, pressure, resistance or rcr"});
  }
  if (flows > 1)
    problems.push_back({"prestress.flow", fmt::format("{} faces have a flow condition", flows),
                        "one may have it: the inflow is shared out by the resistances of the outlets"});
  if (flows == 1 && !flow.inflow)
    problems.push_back({"prestress.flow.inflow", "is missing, but a face has a flow condition",
                        "give the flow at the end of diastole or the mean one, such as `inflow: 80 ml/s`"});
  if (flows == 0 && flow.inflow)
    problems.push_back({"prestress.flow.inflow", "is given, but no face has a flow condition", "remove it"});
  if (!problems.empty()) throw InputError(std::move(problems));
}

double largest(const distributed::DistributedMesh& mesh, const std::vector<double>& field, int begin, int end) {
  double result = 0.0;
  for (std::int32_t i = 0; i < mesh.owned_nodes; ++i)
    for (int c = begin; c < end; ++c)
      result = std::max(result, std::abs(field[coupling::at(i) + static_cast<std::size_t>(c)]));
  return parallel::global_max(mesh.comm, result);
}

SteadyRecord compare(const distributed::DistributedMesh& mesh, const coupling::State& before,
                     const coupling::State& after) {
  std::vector<double> change = after.velocity_pressure;
  for (std::size_t k = 0; k < change.size(); ++k) change[k] -= before.velocity_pressure[k];
  SteadyRecord r{.time = after.time, .dt = after.dt};
  r.largest_velocity = largest(mesh, after.velocity_pressure, 0, 3);
  r.largest_pressure = largest(mesh, after.velocity_pressure, 3, 4);
  const auto share = [](double part, double whole) { return whole > 0 ? part / whole : 0.0; };
  r.velocity_change = share(largest(mesh, change, 0, 3), r.largest_velocity);
  r.pressure_change = share(largest(mesh, change, 3, 4), r.largest_pressure);
  return r;
}

}  // namespace

FaceConditions steady_conditions(const FaceConditions& of_case, const std::vector<std::string>& lumen_faces,
                                 const std::vector<std::string>& interface_faces, const case_file::SteadyFlow& flow) {
  FaceConditions lumen;
  for (const auto& face : of_case)
    if (contains(lumen_faces, face.first)) lumen.push_back(face);
  check_inflow(lumen, flow);
  double total = 0.0;
  for (const auto& [face, condition] : lumen) total += conductance(condition);
  for (auto& [face, condition] : lumen) {
    if (const auto* given = std::get_if<bc::Flow>(&condition))
      condition = bc::Flow{bc::WaveformInput{*flow.inflow}, bc::Flow::Sign::inflow, given->profile};
    else if (const double share = conductance(condition) / total; flow.inflow && share > 0)
      condition = bc::Resistance{.resistance = flow.pressure / (*flow.inflow * share)};
    else if (!std::holds_alternative<bc::NoSlip>(condition) && !std::holds_alternative<bc::Symmetry>(condition))
      condition = bc::Pressure{bc::WaveformInput{flow.pressure}};
  }
  for (const auto& face : interface_faces) lumen.emplace_back(face, bc::NoSlip{});
  return lumen;
}

std::string conditions_text(const FaceConditions& conditions, const std::vector<std::string>& interface_faces) {
  std::string text = "# Steady flow that the prestress belongs to: lines for the section `boundary` of a case.\n";
  for (const auto& [face, condition] : conditions) {
    if (contains(interface_faces, face)) continue;
    if (const auto* inflow = std::get_if<bc::Flow>(&condition))
      text += fmt::format("{}: {{flow: {{value: {:.10g} ml/s, profile: {}}}}}\n", face,
                          1e6 * std::get<double>(inflow->course.source),
                          inflow->profile == bc::Profile::flat ? "flat" : "parabolic");
    if (const auto* outlet = std::get_if<bc::Resistance>(&condition))
      text += fmt::format("{}: {{resistance: {:.10g} Pa s/m^3}}\n", face, outlet->resistance);
    if (const auto* pressure = std::get_if<bc::Pressure>(&condition))
      text += fmt::format("{}: {{pressure: {:.10g} Pa}}\n", face, std::get<double>(pressure->pressure.source));
    if (std::holds_alternative<bc::NoSlip>(condition)) text += face + ": no_slip\n";
    if (std::holds_alternative<bc::Symmetry>(condition)) text += face + ": symmetry\n";
  }
  return text;
}

SteadySteps step_to_steady_state(coupling::Problem& problem, coupling::State& state, const case_file::SteadyFlow& flow,
                                 const std::function<bool(const SteadyRecord&)>& follow) {
  SteadySteps steps;
  SteadyRecord& record = steps.last;
  double dt = state.step > 0 ? std::min(flow.step, 2 * state.dt) : flow.step;
  do {
    steps.before_last = state;
    coupling::StepReport report;
    for (int halvings = 0; !(report = problem.advance(state, dt)).converged; ++halvings, dt *= 0.5)
      if (halvings == most_halvings)
        throw SolverError(
            fmt::format("the steady flow failed in step {} from t = {:.6g} s with steps down to {:.3g} s: {}",
                        state.step + 1, state.time, dt, report.failure));
    record = compare(problem.mesh(), steps.before_last, state);
    record.step = static_cast<int>(state.step);
    steps.before_last.dt = record.dt;
    record.last = std::max(record.velocity_change, record.pressure_change) * flow.step <= flow.tolerance * dt ||
                  state.step >= flow.steps;
    steps.stopped = !follow(record) && !record.last;
    dt = std::min(flow.step, 2 * dt);
  } while (!record.last && !steps.stopped);
  return steps;
}

SteadyRecord repeat_last_step(coupling::Problem& problem, coupling::State& state) {
  const coupling::State before = state;
  const auto report = problem.advance(state, before.dt);
  if (!report.converged)
    throw SolverError(
        fmt::format("the last step of the steady flow failed when it was taken again, from t = {:.6g} s "
                    "with {:.3g} s: {}",
                    before.time, before.dt, report.failure));
  SteadyRecord record = compare(problem.mesh(), before, state);
  record.step = static_cast<int>(state.step);
  return record;
}

std::vector<double> forces_on_wall(const coupling::Problem& problem) {
  const auto& mesh = problem.mesh();
  const std::vector<double> residual = problem.partial_residuals().lumen;
  std::vector<double> forces(residual.size(), 0.0);
  for (const auto& [face, condition] : problem.input().boundary.conditions) {
    if (!std::holds_alternative<bc::NoSlip>(condition)) continue;
    for (const auto* cells : {&mesh.face(face).triangles, &mesh.face(face).edges})
      for (const auto& nodes : *cells)
        for (const auto node : nodes)
          for (std::size_t c = 0; c < 3; ++c) forces[coupling::at(node) + c] = -residual[coupling::at(node) + c];
  }
  mesh.halo.update(forces, 4);
  return forces;
}

}  // namespace tunica::stages
