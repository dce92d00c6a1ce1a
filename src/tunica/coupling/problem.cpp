#include "tunica/coupling/problem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>

#include "tunica/base/error.hpp"
#include "tunica/coupling/convection.hpp"
#include "tunica/coupling/element_loops.hpp"
#include "tunica/coupling/nodal.hpp"
#include "tunica/coupling/stopwatch.hpp"
#include "tunica/coupling/wall_model.hpp"
#include "tunica/coupling/wall_viscosity.hpp"
#include "tunica/parallel/agree.hpp"

namespace tunica::coupling {

using assembly::TimeScheme;

namespace {

assembly::KrylovSettings krylov_settings(const LinearSettings& linear) {
  return {.tolerance = linear.tolerance, .max_iterations = linear.max_iterations, .restart = linear.restart};
}

bool has_region(const distributed::DistributedMesh& mesh, mesh::RegionKind kind) {
  return std::any_of(mesh.regions.begin(), mesh.regions.end(), [&](const auto& r) { return r.kind == kind; });
}

bool is_lumen(const distributed::EdgeNode& edge) { return edge.kind == mesh::RegionKind::lumen; }

}  // namespace

int StepReport::linear_iterations() const {
  int sum = 0;
  for (const auto& record : iterations) sum += record.linear_iterations;
  return sum;
}

struct Problem::Wall {
  WallModel model;
  std::vector<WallModel::Group> groups;

  Wall(const distributed::DistributedMesh& mesh, const wall::Parameters& parameters) : model(mesh, parameters) {}
};

Problem::Problem(const distributed::DistributedMesh& mesh, const ProblemInput& input)
    : mesh_(mesh),
      input_(input),
      isa_(assembly::choose_isa()),
      pattern_(assembly::make_pattern(mesh)),
      boundaries_(mesh, pattern_, input.boundary),
      moved_faces_(mesh, input.boundary.conditions),
      follows_wall_(mesh.nodes(), 0),
      matrix_(pattern_),
      ties_(mesh.comm, boundaries_.tied_nodes()),
      solver_(mesh, pattern_, isa_, krylov_settings(input.linear), ties_) {
  const bool lumen = has_region(mesh, mesh::RegionKind::lumen), wall = has_region(mesh, mesh::RegionKind::wall);
  if (lumen != input.fluid.has_value())
    throw InputError("fluid", lumen ? "the mesh has a lumen but the case has no fluid" : "there is no lumen to flow in",
                     "give both a lumen mesh and a `fluid` section, or neither");
  if (wall != input.wall.has_value())
    throw InputError("wall", wall ? "the mesh has a wall but the case has no wall law" : "there is no wall mesh",
                     "give both a wall mesh and a `wall` section, or neither");
  if (wall && input.mesh_displacement)
    throw InputError("mesh_displacement", "the lumen mesh follows the wall", "prescribe it only without a wall");
  if (wall) wall_ = std::make_unique<Wall>(mesh, *input.wall);
  const int width = static_cast<int>(isa_);
  for (std::size_t r = 0; r < mesh.regions.size(); ++r) {
    const auto& region = mesh.regions[r];
    if (region.kind == mesh::RegionKind::lumen) continue;
    auto groups = wall_->model.groups(mesh, r, pattern_, width);
    std::move(groups.begin(), groups.end(), std::back_inserter(wall_->groups));
    distributed::for_each_node(region,
                               [&](std::int32_t node) { follows_wall_[node] = follows_wall_[mesh.host[node]] = 1; });
  }
  // A ghost may be a wall node although no wall element is seen here: its owner knows.
  std::vector<double> follows(follows_wall_.begin(), follows_wall_.end());
  mesh.halo.update(follows, 1);
  std::transform(follows.begin(), follows.end(), follows_wall_.begin(), [](double f) { return f > 0.5 ? 1 : 0; });
  for (const auto& region : mesh.regions) {
    if (region.kind != mesh::RegionKind::lumen) continue;
    auto groups = lumen_groups(mesh, region, follows_wall_, pattern_, width);
    std::move(groups.begin(), groups.end(), std::back_inserter(lumen_groups_));
  }
  edges_ = distributed::edge_nodes(mesh);
  has_idle_pressures_ = parallel::global_sum(mesh.comm, static_cast<double>(boundaries_.idle_pressures().size())) > 0;
  negligible_ = negligible_forces();
  if (lumen && wall) mesh_motion_.emplace(mesh, isa_, input.mesh_motion, boundaries_.mesh_constraints());

  const std::size_t n = at(mesh.nodes());
  reference_position_.assign(n, 0.0);
  for (std::int32_t i = 0; i < mesh.nodes(); ++i)
    for (int c = 0; c < 3; ++c) reference_position_[at(i) + c] = mesh.points[i][c];
  position_ = reference_position_;
  for (auto* field : {&velocity_pressure_, &acceleration_, &mesh_velocity_, &stream_, &convection_, &displacement_,
                      &residual_, &increment_})
    field->assign(n, 0.0);
}

// A wall at rest leaves a residual of its modulus times the precision of arithmetic, and when loads set in later there
// is nothing larger that it could be compared with. So the norm of a pressure of 1e-12 shear moduli on its surface, ten
// thousand times the precision, counts as nothing.
std::vector<double> Problem::negligible_forces() const {
  if (!wall_) return {};
  const double mu = wall_->model.shear_modulus_at_rest();
  std::vector<double> forces(at(mesh_.nodes()), 0.0);
  for (const auto& face : mesh_.faces) {
    if (mesh_.regions[face.region].kind != mesh::RegionKind::wall) continue;
    for (std::size_t k = 0; k < face.triangles.size(); ++k) {
      const auto& t = face.triangles[k];
      const Vec3<double> twice =
          cross(mesh_.points[t[1]] - mesh_.points[t[0]], mesh_.points[t[2]] - mesh_.points[t[0]]);
      for (const auto node : mesh_.quadratic ? face.edges[k] : t)
        for (int c = 0; c < 3; ++c) forces[at(mesh_.host[node]) + c] += 1e-12 * mu / 6.0 * twice[c];
    }
  }
  forces.resize(at(mesh_.owned_nodes));
  return forces;
}

Problem::~Problem() = default;

const WallModel& Problem::wall_model() const {
  assert(wall_);
  return wall_->model;
}

std::vector<std::string> Problem::notes() const { return wall_ ? wall_->model.notes() : std::vector<std::string>(); }

void Problem::set_prestress(WallPrestress prestress) {
  assert(wall_);
  wall_->model.set_prestress(std::move(prestress), wall_->groups);
}

State Problem::initial_state() const {
  State state;
  const std::size_t n = at(mesh_.nodes());
  for (auto* field : {&state.velocity_pressure, &state.acceleration, &state.displacement, &state.displacement_rate})
    field->assign(n, 0.0);
  state.end_pressure.assign(static_cast<std::size_t>(mesh_.nodes()), 0.0);
  state.outlets = boundaries_.make_outlets();
  return state;
}

FieldsView Problem::fields() const {
  return {reference_position_.data(),
          position_.data(),
          velocity_pressure_.data(),
          acceleration_.data(),
          mesh_velocity_.data(),
          displacement_.data(),
          stream_.data(),
          convection_.data()};
}

FieldsView Problem::fields_with_pressure(const State& state) const {
  if (accepted_step_ == state.step) return fields();
  return {.velocity_pressure = state.velocity_pressure.data(),
          .acceleration = state.acceleration.data(),
          .displacement = state.displacement.data()};
}

void Problem::synchronise_twins(State& state) const {
  for (std::int32_t i = 0; i < mesh_.nodes(); ++i) {
    const auto host = mesh_.host[i];
    if (host == i) continue;
    for (auto* field : {&state.velocity_pressure, &state.acceleration, &state.displacement, &state.displacement_rate})
      for (int c = 0; c < 3; ++c) (*field)[at(i) + c] = (*field)[at(host) + c];
  }
}

// Fields at the instants of generalised-alpha; statics takes the new values themselves.
void Problem::evaluate_fields(const State& old_state, const State& next, const Instant& instant) {
  if (!instant.scheme) {
    velocity_pressure_ = next.velocity_pressure;
    displacement_ = next.displacement;
    return;
  }
  const TimeScheme& scheme = *instant.scheme;
  for (std::int32_t i = 0; i < mesh_.nodes(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const std::size_t k = at(i) + c;
      velocity_pressure_[k] = scheme.at_alpha_f(old_state.velocity_pressure[k], next.velocity_pressure[k]);
      acceleration_[k] = scheme.at_alpha_m(old_state.acceleration[k], next.acceleration[k]);
      displacement_[k] = scheme.at_alpha_f(old_state.displacement[k], next.displacement[k]);
      mesh_velocity_[k] = scheme.at_alpha_m(old_state.displacement_rate[k], next.displacement_rate[k]);
      position_[k] = reference_position_[k] + displacement_[k];
    }
    velocity_pressure_[at(i) + 3] = next.velocity_pressure[at(i) + 3];
  }
  for (const auto& edge : edges_)
    for (auto* field : {&position_, &mesh_velocity_})
      if (is_lumen(edge)) set_to_mean(*field, edge);
}

// Linear between the ends of the step, as all that is prescribed. The first step goes out from what the state has,
// which may be blood at rest.
std::vector<Boundaries::FaceFlow> Problem::flows_to_prescribe(const State& state, double until,
                                                              const TimeScheme& scheme) const {
  auto flows = boundaries_.prescribed_flows(state.time);
  if (state.dt == 0) {
    auto position = state.displacement;
    for (std::size_t k = 0; k < position.size(); ++k) position[k] += reference_position_[k];
    FieldsView view = fields();
    view.position = position.data();
    view.velocity_pressure = state.velocity_pressure.data();
    view.mesh_velocity = state.displacement_rate.data();
    flows = boundaries_.actual_flows(view);
  }
  const auto at_end = boundaries_.prescribed_flows(until);
  for (std::size_t k = 0; k < flows.size(); ++k)
    flows[k].outward = scheme.at_alpha_f(flows[k].outward, at_end[k].outward);
  return flows;
}

// The opening stretches and its nodes slide as the mesh moves, so that the same velocities carry another flow.
void Problem::scale_inflows(const State& old_state, State& next, const TimeScheme& scheme) {
  if (!moving() || prescribed_flows_.empty()) return;
  boundaries_.scale_inflows(prescribed_flows_, scheme.alpha_f, fields(), next.velocity_pressure);
  for (const auto& inflow : boundaries_.inflow_nodes())
    for (int c = 0; c < 3; ++c) {
      const std::size_t k = at(inflow.node) + c;
      const double v_old = old_state.velocity_pressure[k], v = next.velocity_pressure[k];
      next.acceleration[k] = scheme.new_rate(v_old, old_state.acceleration[k], v);
      velocity_pressure_[k] = scheme.at_alpha_f(v_old, v);
      acceleration_[k] = scheme.at_alpha_m(old_state.acceleration[k], next.acceleration[k]);
    }
}

// Rates and wall displacements that belong to the velocities of `next`.
void Problem::follow_velocity(const State& old_state, State& next, const TimeScheme& scheme) const {
  for (std::int32_t i = 0; i < mesh_.nodes(); ++i)
    for (int c = 0; c < 3; ++c) {
      const std::size_t k = at(i) + c;
      const double v_old = old_state.velocity_pressure[k], v = next.velocity_pressure[k];
      next.acceleration[k] = scheme.new_rate(v_old, old_state.acceleration[k], v);
      if (!follows_wall_[i]) continue;
      const double rate_old = old_state.displacement_rate[k];
      next.displacement_rate[k] = scheme.displacement_rate(rate_old, scheme.at_alpha_f(v_old, v));
      next.displacement[k] = scheme.new_value(old_state.displacement[k], rate_old, next.displacement_rate[k]);
    }
}

void Problem::set_to_mean(std::span<double> field, const distributed::EdgeNode& edge) const {
  for (int c = 0; c < 3; ++c)
    field[at(edge.node) + c] = 0.5 * (field[at(edge.ends[0]) + c] + field[at(edge.ends[1]) + c]);
}

// Walls have no part in it, and a step that is repeated finds the same.
double Problem::largest_speed(const State& state) const {
  double largest = 0;
  if (input_.fluid)
    for (std::int32_t i = 0; i < mesh_.owned_nodes; ++i)
      if (!follows_wall_[i]) largest = std::max(largest, norm(vector_at(state.velocity_pressure.data(), i)));
  return parallel::global_max(mesh_.comm, largest);
}

// What the stabilisation of quadratic elements takes from the start of the step.
void Problem::remember_start(const State& state, const State& next) {
  flow_speed_ = largest_speed(next);
  for (std::size_t k = 0; k < stream_.size(); ++k) stream_[k] = -state.displacement_rate[k];
  for (const auto& edge : edges_)
    if (is_lumen(edge)) set_to_mean(stream_, edge);
  for (std::size_t k = 0; k < stream_.size(); k += 4) {
    stream_[k + 3] = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      stream_[k + c] += state.velocity_pressure[k + c];
      stream_[k + 3] += state.acceleration[k + c] * state.acceleration[k + c];
    }
  }
  if (input_.fluid) convection_ = resolved_convection(mesh_, state, stream_);
}

void Problem::prescribe_mesh(State& state) const {
  for (std::int32_t i = 0; i < mesh_.nodes(); ++i) {
    const Vec3<double> u = input_.mesh_displacement(mesh_.points[i], state.time);
    for (int c = 0; c < 3; ++c) state.displacement[at(i) + c] = u[c];
  }
}

int Problem::move_mesh(const State& old_state, State& next, const TimeScheme& scheme) {
  if (!moving()) return 0;
  const Stopwatch watch(timings_.mesh);
  int iterations = 0;
  if (mesh_motion_)
    iterations = mesh_motion_->solve(next.displacement, input_.newton.mesh_tolerance);
  else
    prescribe_mesh(next);
  for (const auto& edge : edges_)
    if (is_lumen(edge) && !follows_wall_[edge.node]) set_to_mean(next.displacement, edge);
  for (std::int32_t i = 0; i < mesh_.nodes(); ++i)
    if (!follows_wall_[i])
      for (int c = 0; c < 3; ++c) {
        const std::size_t k = at(i) + c;
        next.displacement_rate[k] =
            scheme.new_rate(old_state.displacement[k], old_state.displacement_rate[k], next.displacement[k]);
      }
  return iterations;
}

void Problem::settle_mesh(State& state) {
  if (!mesh_motion_) return;
  double of_wall = 0, of_mesh = 0;
  for (std::int32_t i = 0; i < mesh_.nodes(); ++i) {
    double& largest = follows_wall_[i] ? of_wall : of_mesh;
    largest = std::max(largest, norm(vector_at(state.displacement.data(), i)));
  }
  of_wall = parallel::global_max(mesh_.comm, of_wall);
  if (of_wall == 0 || parallel::global_max(mesh_.comm, of_mesh) > 0) return;
  synchronise_twins(state);
  mesh_motion_->solve(state.displacement, input_.newton.mesh_tolerance);
  for (const auto& edge : edges_)
    if (is_lumen(edge) && !follows_wall_[edge.node]) set_to_mean(state.displacement, edge);
  mesh_.halo.update(state.displacement, 4);
}

void Problem::add_lumen(const Instant& instant, std::span<double> residual, float* blocks) const {
  const ElementLoops loops = element_loops(isa_);
  for (const auto& group : lumen_groups_) {
    const TimeScheme& s = *instant.scheme;
    loops.fluid(group.view(), fields(), *input_.fluid,
                {s.dt, s.acceleration_per_unknown(), s.velocity_per_unknown(), flow_speed_},
                {s.displacement_per_unknown(), s.velocity_per_unknown()}, {residual.data(), blocks});
  }
}

void Problem::add_wall(const Instant& instant, std::span<double> residual, float* blocks) const {
  if (!wall_) return;
  const ElementLoops loops = element_loops(isa_);
  // The constraint rows are scaled so that their coupling to the velocity is that of the continuity equation.
  const wall::Coefficients c =
      instant.scheme
          ? wall::Coefficients{instant.scheme->acceleration_per_unknown(), instant.scheme->displacement_per_unknown(),
                               instant.scheme->velocity_per_unknown() / instant.scheme->displacement_per_unknown()}
          : wall::Coefficients{};
  for (const auto& group : wall_->groups)
    loops.wall.assemble(group.view(), fields(), wall_->model.element_settings(), c, {residual.data(), blocks});
}

void Problem::assemble(const State& next, const Instant& instant, bool with_tangent) {
  const Stopwatch watch(timings_.assembly);
  std::fill(residual_.begin(), residual_.end(), 0.0);
  if (with_tangent) matrix_.set_zero();
  float* blocks = with_tangent ? matrix_.blocks.data()->a : nullptr;
  add_lumen(instant, residual_, blocks);
  add_wall(instant, residual_, blocks);
  // In statics nothing moves.
  if (input_.wall && input_.wall->viscosity && instant.scheme)
    add_wall_viscosity(mesh_, pattern_, *input_.wall->viscosity, fields(),
                       {instant.scheme->displacement_per_unknown(), instant.scheme->velocity_per_unknown()}, residual_,
                       with_tangent ? &matrix_ : nullptr);

  const LoadCoefficients loads = instant.scheme ? LoadCoefficients{instant.scheme->velocity_per_unknown(),
                                                                   instant.scheme->displacement_per_unknown()}
                                                : LoadCoefficients{0.0, 1.0};
  boundaries_.loads().add(instant.time, instant.load_factor, fields(), loads, residual_,
                          with_tangent ? &matrix_ : nullptr);
  for (std::size_t k = 0; k < nodal_forces_.size(); ++k) residual_[k] -= instant.load_factor * nodal_forces_[k];
  outlet_flows_ = boundaries_.outlet_flows(fields());
  std::vector<double> pressures, slopes;
  for (std::size_t k = 0; k < next.outlets.size(); ++k) {
    const auto p = next.outlets[k].evaluate_at_alpha(instant.scheme->dt, instant.scheme->alpha_f, outlet_flows_[k]);
    pressures.push_back(p.pressure);
    slopes.push_back(p.per_alpha_flow * instant.scheme->velocity_per_unknown());
  }
  outlets_ = boundaries_.add_outlets(pressures, fields(), residual_);
  for (std::size_t k = 0; k < outlets_.size(); ++k) outlets_[k].coefficient = slopes[k];

  boundaries_.constraints().apply(residual_);
  ties_.average(residual_);
  if (with_tangent) boundaries_.constraints().apply(matrix_);
}

std::string Problem::mesh_failure() const {
  if (!moving()) return {};
  const MeshQuality worst = mesh_quality(mesh_, position_);
  if (worst.smallest > input_.mesh_motion.minimum_quality) return {};
  return fmt::format(
      "the moving lumen mesh is spoilt: element {} near ({:.5g}, {:.5g}, {:.5g}) m has {:.3g} of its "
      "initial quality, allowed is {:.3g}",
      worst.element, worst.place[0], worst.place[1], worst.place[2], worst.smallest,
      input_.mesh_motion.minimum_quality);
}

void Problem::update_present_modulus(const State& state) {
  if (!wall_) return;
  const Stopwatch watch(timings_.assembly);
  FieldsView view = fields();
  view.displacement = state.displacement.data();
  wall_->model.update_present_modulus(wall_->groups, view, isa_);
}

StepReport Problem::advance(State& state, double dt) {
  const TimeScheme scheme = TimeScheme::generalised_alpha(dt, input_.rho_infinity);
  const double of_loads = input_.loads == LoadInstant::end ? 1.0 : scheme.alpha_f;
  const Instant instant{scheme, state.time + of_loads * dt, 1.0};
  accepted_step_.reset();
  State next = state;
  next.time = state.time + dt;
  next.dt = dt;
  ++next.step;
  prescribed_flows_ = flows_to_prescribe(state, next.time, scheme);
  boundaries_.prescribe(next.time, next.velocity_pressure);
  moved_faces_.at(next.time, [&](std::int32_t node, int axis, double displacement) {
    const std::size_t k = at(node) + static_cast<std::size_t>(axis);
    next.velocity_pressure[k] = scheme.velocity_towards(state.displacement[k], state.displacement_rate[k],
                                                        state.velocity_pressure[k], displacement);
  });
  if (mesh_.quadratic) remember_start(state, next);
  follow_velocity(state, next, scheme);
  // Until the first increment the mesh goes on as it moved; the interface is moved by its velocity.
  for (std::int32_t i = 0; i < mesh_.nodes(); ++i)
    for (int c = 0; c < 3 && !follows_wall_[i]; ++c) {
      const std::size_t k = at(i) + c;
      next.displacement[k] = state.displacement[k] + dt * state.displacement_rate[k];
    }
  synchronise_twins(next);
  evaluate_fields(state, next, instant);
  scale_inflows(state, next, scheme);

  StepReport report = newton(state, next, instant);
  if (!report.converged) return report;
  last_instant_ = instant;
  for (std::size_t k = 0; k < next.outlets.size(); ++k) {
    const double old_flow = state.outlets[k].flow();
    next.outlets[k].commit(dt, old_flow + (outlet_flows_[k] - old_flow) / scheme.alpha_f);
  }
  interpolate_pressure(next);
  for (std::int32_t i = 0; i < mesh_.nodes(); ++i)
    next.end_pressure[static_cast<std::size_t>(i)] =
        scheme.at_end(state.end_pressure[static_cast<std::size_t>(i)], next.velocity_pressure[at(i) + 3]);
  state = next;
  accepted_step_ = state.step;
  return report;
}

// Pressure is linear and lives at the corners: what nodes on edges show of it is for pictures, and so is that of
// corners between rigid walls, which the equations do not know.
void Problem::interpolate_pressure(State& state) const {
  auto& p = state.velocity_pressure;
  for (const auto& [node, corners] : boundaries_.idle_pressures()) {
    p[at(node) + 3] = 0;
    for (const auto corner : corners) p[at(node) + 3] += p[at(corner) + 3] / static_cast<double>(corners.size());
  }
  if (has_idle_pressures_) mesh_.halo.update(p, 4);
  for (const auto& edge : edges_) p[at(edge.node) + 3] = 0.5 * (p[at(edge.ends[0]) + 3] + p[at(edge.ends[1]) + 3]);
}

StepReport Problem::solve_static(State& state, double factor) {
  if (input_.fluid) throw InputError("analysis", "statics has no flow", "solve the wall alone, or use a time step");
  const Instant instant{std::nullopt, state.time, factor};
  State next = state;
  moved_faces_.at(state.time, [&](std::int32_t node, int axis, double displacement) {
    next.displacement[at(node) + static_cast<std::size_t>(axis)] = factor * displacement;
  });
  synchronise_twins(next);
  evaluate_fields(state, next, instant);
  StepReport report = newton(state, next, instant);
  if (!report.converged) return report;
  last_instant_ = instant;
  interpolate_pressure(next);
  for (std::int32_t i = 0; i < mesh_.nodes(); ++i)
    next.end_pressure[static_cast<std::size_t>(i)] = next.velocity_pressure[at(i) + 3];
  state = next;
  return report;
}

void Problem::set_nodal_forces(std::span<const double> forces) {
  if (forces.size() != residual_.size()) throw std::invalid_argument("set_nodal_forces: four entries per local node");
  nodal_forces_.assign(residual_.size(), 0.0);
  for (std::int32_t i = 0; i < mesh_.nodes(); ++i)
    for (int c = 0; c < 3; ++c) nodal_forces_[at(mesh_.host[i]) + c] += forces[at(i) + c];
}

Problem::WorstNode Problem::worst_node() const {
  WorstNode worst;
  for (std::int32_t i = 0; i < mesh_.owned_nodes; ++i) {
    const Vec3<double> r{{residual_[at(i)], residual_[at(i) + 1], residual_[at(i) + 2]}};
    const double force = norm(r);
    if (std::isnan(worst.force) || !(force > worst.force || std::isnan(force))) continue;
    worst = {force, mesh_.points[i]};
  }
  struct {
    double value;
    int rank;
  } mine{std::isnan(worst.force) ? std::numeric_limits<double>::infinity() : worst.force, 0}, all{};
  MPI_Comm_rank(mesh_.comm, &mine.rank);
  MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE_INT, MPI_MAXLOC, mesh_.comm);
  MPI_Bcast(&worst, sizeof worst, MPI_BYTE, all.rank, mesh_.comm);
  return worst;
}

Problem::PartialResiduals Problem::partial_residuals() const {
  PartialResiduals parts{std::vector<double>(residual_.size()), std::vector<double>(residual_.size())};
  add_lumen(last_instant_, parts.lumen, nullptr);
  add_wall(last_instant_, parts.wall, nullptr);
  return parts;
}

}  // namespace tunica::coupling
