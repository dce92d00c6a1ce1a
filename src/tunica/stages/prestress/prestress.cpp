#include "tunica/stages/prestress/prestress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>

#include "tunica/artifacts/checkpoint.hpp"
#include "tunica/artifacts/fields.hpp"
#include "tunica/artifacts/problem_input.hpp"
#include "tunica/base/error.hpp"
#include "tunica/bc/check.hpp"
#include "tunica/case/case_text.hpp"
#include "tunica/case/table_ends.hpp"
#include "tunica/coupling/nodal.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/files/hash.hpp"
#include "tunica/files/outputs.hpp"
#include "tunica/mesh/boundary.hpp"
#include "tunica/parallel/agree.hpp"
#include "tunica/parallel/progress.hpp"
#include "tunica/parallel/signals.hpp"
#include "tunica/stages/prestress/flow_folder.hpp"
#include "tunica/stages/prestress/prestress_run.hpp"
#include "tunica/wall/parameters.hpp"

namespace tunica::stages {

namespace {

namespace fs = std::filesystem;
using coupling::at;
using mesh::RegionKind;
using nlohmann::ordered_json;

/// Number of each node of the whole mesh in a part, -1 outside.
std::vector<std::int64_t> numbers_in(const mesh::Submesh& part, std::size_t nodes) {
  std::vector<std::int64_t> number(nodes, -1);
  for (std::size_t k = 0; k < part.nodes.size(); ++k)
    number[static_cast<std::size_t>(part.nodes[k])] = static_cast<std::int64_t>(k);
  return number;
}

std::vector<std::string> faces_of(const mesh::MeshData& data) {
  std::vector<std::string> names;
  for (const auto& face : data.faces) names.push_back(face.name);
  return names;
}

/// The flow of a case alone, between rigid walls, with steady conditions.
case_file::Case flow_case(const case_file::Case& c, const FaceConditions& conditions) {
  case_file::Case flow = c;
  flow.analysis = case_file::RigidFlow{};
  flow.wall.reset();
  flow.mesh_motion.reset();
  flow.meshes.interface.reset();
  flow.boundary = conditions;
  flow.time->rho_infinity = 0.0;  // towards a steady state everything may be damped
  return flow;
}

/// A wall that inertia holds in a run may be loose in statics.
void check_support(const case_file::Case& wall, const std::vector<std::string>& wall_faces,
                   const std::vector<std::string>& interface_faces) {
  bc::BoundaryCase boundary;
  boundary.conditions = wall.boundary;
  boundary.static_wall = true;
  for (const auto& face : wall_faces) boundary.faces.push_back({face, bc::Field::wall});
  for (const auto& face : interface_faces) boundary.conditions.emplace_back(face, bc::Free{});
  auto problems = bc::check_boundary(boundary);
  if (!problems.empty()) throw InputError(std::move(problems));
}

}  // namespace

/// The wall of a case alone, in equilibrium with its loads.
case_file::Case wall_case(const case_file::Case& c, const std::vector<std::string>& wall_faces) {
  case_file::Case wall = c;
  wall.analysis = case_file::StaticWall{};
  wall.output.fields = quantities::standard();
  wall.fluid.reset();
  wall.mesh_motion.reset();
  wall.meshes.interface.reset();
  std::erase_if(wall.boundary, [&](const auto& condition) {
    return std::find(wall_faces.begin(), wall_faces.end(), condition.first) == wall_faces.end();
  });
  return wall;
}

PrestressRun::PrestressRun(MPI_Comm comm, const PrestressRequest& request, std::FILE* screen)
    : comm_(comm), request_(request) {
  read();
  folder_ = request.directory.value_or(settings().output);
  prepare_folder();
  log_.emplace(comm_,
               parallel::Log::Targets{.file = folder_ / "prestress.log", .screen = screen, .verbose = request.verbose});
  if (!lock_.taken_over().empty()) log_->warning(lock_.taken_over());
  if (!case_.title.empty()) log_->heading(case_.title);
  for (const auto& line : whole_.report) log_->detail(line);
  for (const auto& line : whole_.warnings) log_->warning(line);
}

// The prestress and the state that the case may name for its run are not read: this makes them.
void PrestressRun::read() {
  parallel::on_root(comm_, [&] {
    text_ = request_.case_text ? *request_.case_text : config::read_text(request_.case_file);
    auto parsed = case_file::read_case(text_, request_.case_file);
    case_ = std::move(parsed.value);
    for (const auto& warning : parsed.warnings) whole_.warnings.push_back(format(warning));
    if (!case_.prestress)
      throw InputError(request_.case_file.string(), "has no section `prestress`",
                       case_.solves_fluid() ? "add `prestress: {flow: {pressure: 80 mmHg, inflow: 80 ml/s}}`"
                                            : "add `prestress: {}`");
    if (case_.wall) case_.wall->prestress.reset();
    auto warnings = std::move(whole_.warnings);
    whole_ = artifacts::load_mesh(case_);
    whole_.warnings.insert(whole_.warnings.begin(), warnings.begin(), warnings.end());
    mesh_hash_ = artifacts::mesh_hash(whole_.data);
    lumen_part_ = mesh::submesh(whole_.data, RegionKind::lumen);
    wall_part_ = mesh::submesh(whole_.data, RegionKind::wall);
    lumen_hash_ = artifacts::mesh_hash(lumen_part_.data);
    lumen_faces_ = faces_of(lumen_part_.data);
    wall_faces_ = faces_of(wall_part_.data);
  });
  parallel::broadcast(comm_, text_);
  if (parallel::rank(comm_) != 0) case_ = case_file::parse_case(text_, request_.case_file);
  artifacts::name_faces(case_, whole_, comm_);
  if (case_.wall) case_.wall->prestress.reset();
  parallel::broadcast(comm_, mesh_hash_);
  parallel::broadcast(comm_, lumen_hash_);
  parallel::broadcast(comm_, lumen_faces_);
  parallel::broadcast(comm_, wall_faces_);
  if (case_.meshes.interface) {
    lumen_interface_ = case_.meshes.interface->lumen_faces;
    wall_interface_ = case_.meshes.interface->wall_faces;
  }
  parallel::on_root(comm_, [&] {
    check_prestress(case_, artifacts::faces_of(whole_.data), artifacts::wall_regions(whole_.data));
    auto problems =
        case_file::check_table_ends(wall_case(case_, wall_faces_).boundary, case_file::asked_by_prestress(case_));
    if (!problems.empty()) throw InputError(std::move(problems));
  });
}

void PrestressRun::prepare_folder() {
  parallel::on_root(comm_, [&] {
    lock_ = files::FolderLock(folder_);
    if (!request_.overwrite && !request_.keep_flow && fs::exists(folder_ / "prestress.log"))
      throw InputError(folder_.string(), "holds a prestress already",
                       "replace it by --overwrite, find it anew with the flow that is there by --keep-flow, or name "
                       "another folder by --output");
    if (request_.keep_flow && !has_flow(folder_))
      throw InputError(folder_.string(), "holds no flow.checkpoint that could be kept",
                       "find the flow: " + command("--overwrite"));
    files::try_outputs(folder_, {"prestress.log", prestress_report_file, "wall.vtu", "start.checkpoint",
                                 "flow.checkpoint", "boundary.yaml", "fixed_point.csv"});
    for (const char* file : {"prestress.log", prestress_report_file, "wall.vtu", "start.checkpoint"})
      fs::remove(folder_ / file);
    if (!request_.keep_flow) remove_flow(folder_);
  });
}

std::string PrestressRun::command(const char* option) const {
  return fmt::format("tunica prestress {}{} {}", request_.case_file.string(),
                     request_.directory ? " --output " + request_.directory->string() : "", option);
}

void PrestressRun::take_steps_of_flow(coupling::Problem& problem) {
  const FlowFolder flow_folder{folder_, lumen_hash_, "find the flow anew: " + command("--overwrite")};
  steady_ = find_steady_flow(problem, flow_, *settings().flow, flow_folder, request_.keep_flow, *log_);
  const auto& units = case_.output.units;
  log_->info(fmt::format(
      "steady flow: {} steps to t = {:.4g} s, velocity up to {:.4g} {}, pressure up to {:.4g} {}; in the last step "
      "they changed by {:.1e} and {:.1e}",
      steady_.step, steady_.time, steady_.largest_velocity * per_si(units.velocity, config::dimension::velocity),
      units.velocity, steady_.largest_pressure * per_si(units.pressure, config::dimension::pressure), units.pressure,
      steady_.velocity_change, steady_.pressure_change));
  if (const double change = std::max(steady_.velocity_change, steady_.pressure_change);
      change > settings().flow->tolerance)
    log_->warning(
        fmt::format("the flow is not steady: asked were changes of {:.1e} in a step. The prestress belongs "
                    "to its last instant",
                    settings().flow->tolerance));
}

void PrestressRun::write_flow(const coupling::Problem& problem, const case_file::Case& flow) {
  auto standard = flow;
  standard.output.fields = quantities::standard();
  artifacts::OutputFields fields(problem, standard);
  distributed::ResultsWriter writer(lumen_, results_in("flow"));
  fields.write(writer, steady_.step, steady_.time, flow_);
}

// From the lumen's node to the wall's node at the same place.
void PrestressRun::take_forces(const coupling::Problem& problem) {
  std::vector<double> forces = forces_on_wall(problem);
  for (std::size_t k = 3; k < forces.size(); k += 4) forces[k] = flow_.velocity_pressure[k];
  const auto of_lumen = parallel::gather_by_original_id(node_order(lumen_), forces, 4);
  parallel::on_root(comm_, [&] {
    const auto lumen = numbers_in(lumen_part_, whole_.data.points.size()),
               wall = numbers_in(wall_part_, whole_.data.points.size());
    forces_.assign(4 * wall_part_.nodes.size(), 0.0);
    for (const auto& [wall_node, lumen_node] : whole_.data.twins)
      for (std::size_t c = 0; c < 4; ++c)
        forces_[4 * static_cast<std::size_t>(wall[static_cast<std::size_t>(wall_node)]) + c] =
            of_lumen[4 * static_cast<std::size_t>(lumen[static_cast<std::size_t>(lumen_node)]) + c];
  });
}

void PrestressRun::find_flow() {
  const auto conditions = steady_conditions(case_.boundary, lumen_faces_, lumen_interface_, settings().flow.value());
  const case_file::Case flow = flow_case(case_, conditions);
  lumen_ = distributed::distribute(lumen_part_.data, comm_);
  coupling::Problem problem(lumen_, artifacts::problem_input(flow));
  parallel::on_root(comm_, [&] {
    files::write_atomically(folder_ / "boundary.yaml", conditions_text(conditions, lumen_interface_));
  });
  flow_ = problem.initial_state();
  take_steps_of_flow(problem);
  write_flow(problem, flow);
  take_forces(problem);
}

// Pressure acts along the normal of the moved wall, and so does nearly all of the flow's forces. Were they held in
// their directions, a flap between two lumens would tip over under the pair of pressures, (5.3).
coupling::ProblemInput PrestressRun::wall_input() {
  auto input = artifacts::problem_input(wall_case(case_, wall_faces_));
  local_forces_.assign(at(wall_.nodes()), 0.0);
  if (!case_.solves_fluid()) return input;
  parallel::scatter_by_original_id(node_order(wall_), forces_, local_forces_, 4);
  wall_.halo.update(local_forces_, 4);
  std::vector<double> pressure(static_cast<std::size_t>(wall_.nodes()));
  for (std::size_t k = 0; k < pressure.size(); ++k) pressure[k] = local_forces_[4 * k + 3];
  for (const auto& face : wall_interface_) input.boundary.wall_pressures.emplace_back(face, pressure);
  return input;
}

std::vector<double> PrestressRun::forces_beside_pressure() const {
  std::vector<double> forces = local_forces_;
  for (const auto& name : wall_interface_) {
    const auto& face = wall_.face(name);
    for (std::size_t k = 0; k < face.triangles.size(); ++k) {
      const auto& t = face.triangles[k];
      const double pressure =
          (local_forces_[at(t[0]) + 3] + local_forces_[at(t[1]) + 3] + local_forces_[at(t[2]) + 3]) / 3.0;
      // On a straight triangle a third of it acts on each corner, or on each node of an edge (quadratic_surface.hpp).
      const Vec3<double> share = (pressure / 3.0) * mesh::area_vector(wall_.points, t);
      for (const auto node : wall_.quadratic ? face.edges[k] : t)
        for (int c = 0; c < 3; ++c) forces[at(node) + static_cast<std::size_t>(c)] += share[c];
    }
  }
  wall_.halo.update(forces, 4);
  return forces;
}

void PrestressRun::find_wall() {
  wall_ = distributed::distribute(wall_part_.data, comm_);
  coupling::Problem problem(wall_, wall_input());
  for (const auto& line : problem.notes()) log_->detail(line);
  if (case_.solves_fluid()) {
    problem.set_nodal_forces(forces_beside_pressure());
    write_traction(problem);
  }
  parallel::on_root(comm_, [&] {
    history_.emplace(folder_ / "fixed_point.csv",
                     std::vector<std::string>{fmt::format("largest displacement [{}]", case_.output.units.length),
                                              "share of the update", "share of the load", "newton iterations",
                                              "linear iterations", "seconds"},
                     std::nullopt);
  });
  const auto result =
      coupling::find_prestress(problem, settings().fixed_point, settings().load_time, [&](const auto& record) {
        follow(record);
        if (const int signal = parallel::stop_requested(comm_); signal != 0) throw Stopped{signal};
      });
  log_->status("");
  plot_history(result.history);
  write_report(result);
  if (!result.converged)
    throw SolverError(fmt::format(
        "the fixed point of the prestress did not converge: {}\n  {}try a smaller "
        "`relaxation`, more `load_steps`, or another `method`{}",
        result.failure,
        result.method == coupling::PrestressSettings::Method::inverse
            ? "there may be no unloaded shape, as where a thin flap buckles: `fallback: stretch` would take over; or "
            : "",
        case_.solves_fluid()
            ? fmt::format(", with the flow and traction that are in {}: {}", folder_.string(), command("--keep-flow"))
            : fmt::format(": {}", command("--overwrite"))));
  if (!result.inverse_failure.empty())
    log_->warning(fmt::format("no unloaded shape was found: {}. The prestress is that of the fallback `{}`",
                              result.inverse_failure, name_of(result.method)));
  write_prestress_file(result.prestress);
  if (!result.unloading.empty()) write_unloaded(result.unloading);
  write_stress(problem, result.state);
  write_start(result.state);
}

// For an end that has a signal or an error of its own to tell.
void PrestressRun::record_end(const char* status, const std::string& message) {
  log_->note_error(message);
  if (parallel::rank(comm_) != 0) return;
  const ordered_json json = {{"program", {{"version", request_.program.version}, {"commit", request_.program.commit}}},
                             {"case_file", request_.case_file.string()},
                             {"case", text_},
                             {"mesh_hash", files::hex(mesh_hash_)},
                             {"status", status},
                             {"converged", false},
                             {"failure", message},
                             {"seconds", MPI_Wtime() - started_}};
  try {
    // A fixed point that did not converge has its report already.
    if (!fs::exists(folder_ / prestress_report_file))
      files::write_atomically(folder_ / prestress_report_file, json.dump(2) + "\n");
  } catch (const std::exception& error) {
    log_->warning(fmt::format("prestress.json does not tell the end: {}", error.what()));
  }
}

int PrestressRun::steps() {
  try {
    compute();
    return 0;
  } catch (const Stopped& stopped) {
    record_end("stopped", fmt::format("signal {}", stopped.signal));
    const bool has_flow = case_.solves_fluid() && flow_.step > 0;
    log_->warning(fmt::format("stopped by SIG{}{}. To continue:\n  {}", sigabbrev_np(stopped.signal),
                              has_flow ? "; the steady flow is kept" : "",
                              command(has_flow ? "--keep-flow" : "--overwrite")));
    return stopped.signal;
  } catch (const std::exception& error) {
    record_end("failed", error.what());
    throw;
  } catch (...) {
    record_end("failed", "unknown error");
    throw;
  }
}

void PrestressRun::compute() {
  if (case_.solves_fluid()) find_flow();
  find_wall();
  log_->info(fmt::format("prestress found in {:.1f} s. For the case:\n  wall: {{prestress: {}}}\n  start: {}",
                         MPI_Wtime() - started_, (folder_ / "wall.vtu").string(),
                         (folder_ / "start.checkpoint").string()));
}

void check_prestress(const case_file::Case& c, const std::vector<bc::BoundaryFace>& faces,
                     const std::vector<std::string>& wall_regions) {
  const case_file::InterfaceSettings interface = c.meshes.interface.value_or(case_file::InterfaceSettings{});
  std::vector<std::string> lumen, wall;
  for (const auto& face : faces) (face.field == bc::Field::lumen ? lumen : wall).push_back(face.name);
  if (c.solves_fluid()) steady_conditions(c.boundary, lumen, interface.lumen_faces, c.prestress->flow.value());
  check_support(wall_case(c, wall), wall, interface.wall_faces);
  for (const auto& region : c.prestress->fixed_point.exclude)
    if (std::find(wall_regions.begin(), wall_regions.end(), region) == wall_regions.end())
      throw InputError("prestress.exclude", fmt::format("the mesh has no wall region {}", region),
                       "use some of: " + mesh::list_names(wall_regions));
}

int prestress(MPI_Comm comm, const PrestressRequest& request, std::FILE* screen) {
  return PrestressRun(comm, request, screen).steps();
}

}  // namespace tunica::stages
