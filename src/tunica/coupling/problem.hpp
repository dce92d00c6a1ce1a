// One time step of flow, wall and mesh motion as a monolithic system (docs/theory.md, section 4).
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tunica/ale/parameters.hpp"
#include "tunica/assembly/linear_solver.hpp"
#include "tunica/assembly/time_scheme.hpp"
#include "tunica/base/boxed.hpp"
#include "tunica/coupling/boundaries.hpp"
#include "tunica/coupling/lumen_groups.hpp"
#include "tunica/coupling/mesh_motion.hpp"
#include "tunica/coupling/moved_faces.hpp"
#include "tunica/coupling/settings.hpp"
#include "tunica/coupling/state.hpp"
#include "tunica/distributed/element_nodes.hpp"
#include "tunica/distributed/lumen_map.hpp"

namespace tunica::wall {
struct Parameters;  // wall/parameters.hpp
}

namespace tunica::coupling {

class WallModel;       // wall_model.hpp
struct WallPrestress;  // wall_prestress.hpp

/// What is to be solved; lumen and wall are each present or not, as the mesh is.
struct ProblemInput {
  std::optional<fluid::Parameters> fluid;
  Boxed<wall::Parameters> wall;
  ale::Parameters mesh_motion;
  BoundaryInput boundary;
  /// Prescribed displacement [m] of the lumen mesh, for flow without a wall. The start state must hold the displacement
  /// and the rate of its own time.
  VectorField mesh_displacement;
  distributed::LumenMap lumens;  ///< empty where there is no false lumen
  double rho_infinity = 0.5;
  LoadInstant loads = LoadInstant::balance;
  NewtonSettings newton;
  LinearSettings linear;
};

/// What one Newton iteration did.
struct NewtonRecord {
  double norm = 0;  ///< of the residual it started from
  int linear_iterations = 0;
  int mesh_iterations = 0;
  double step_length = 1;  ///< below 1 after a line search
};

/// Seconds spent.
struct StepTimings {
  double assembly = 0, set_up = 0, linear = 0, mesh = 0, total = 0;
};

struct StepReport {
  bool converged = false;
  std::string failure;  ///< why not
  std::vector<NewtonRecord> iterations;
  double final_norm = 0;
  StepTimings timings;

  int linear_iterations() const;
};

class Problem {
 public:
  /// Throws InputError when mesh, physics and conditions do not fit. Collective.
  Problem(const distributed::DistributedMesh& mesh, const ProblemInput& input);
  ~Problem();

  /// At rest, undeformed.
  State initial_state() const;

  /// Moves the lumen mesh of `state`, of which no node is displaced yet, to where its wall is displaced to; leaves
  /// other states as they are. Collective.
  void settle_mesh(State& state);

  /// Takes `state` from t_n to t_n + dt, or leaves it untouched and says why not. Collective.
  StepReport advance(State& state, double dt);

  /// Static equilibrium of the wall under `factor` times the loads of time state.time, starting from `state`.
  /// Collective.
  StepReport solve_static(State& state, double factor);

  /// External forces on nodes [N], [local node][4] (the fourth entry is not used; twins add to their hosts), in every
  /// evaluation from now on: body forces, varying tractions. Statics multiplies them by its load factor.
  void set_nodal_forces(std::span<const double> forces);

  /// Prestress of the wall in every evaluation from now on. Throws as WallModel::set_prestress.
  void set_prestress(WallPrestress prestress);

  /// Residual of the lumen elements alone and of the wall elements alone for the step that `advance` last accepted:
  /// their sum vanishes at the interface. [local node][4], at t_{n+alpha_f}. Collective.
  struct PartialResiduals {
    std::vector<double> lumen, wall;
  };
  PartialResiduals partial_residuals() const;

  /// Node with the largest unbalanced force of the last evaluation: where a failed step went wrong. Collective.
  struct WorstNode {
    double force = 0;      ///< [N]; NaN counts as largest
    Vec3<double> place{};  ///< in the initial mesh [m]
  };
  WorstNode worst_node() const;

  /// Fields at t_{n+alpha_f} of the last evaluation.
  FieldsView fields() const;
  /// Displacement and pressure of one instant: those at t_{n-1+alpha_f} where the step that this problem last accepted
  /// led to `state`; its own elsewhere, as at the start of a run and in statics. `state` must outlive them.
  FieldsView fields_with_pressure(const State& state) const;
  const Boundaries& boundaries() const { return boundaries_; }
  /// Flows that the conditions `flow` prescribe at t_{n+alpha_f} of the last step.
  const std::vector<Boundaries::FaceFlow>& prescribed_flows() const { return prescribed_flows_; }
  /// Largest speed [m/s] of the blood when the last step began, prescribed velocities at its end included; quadratic
  /// elements only.
  double flow_speed() const { return flow_speed_; }
  /// Only with a wall.
  const WallModel& wall_model() const;
  /// What a log should say of its laws: one line each; empty without a wall.
  std::vector<std::string> notes() const;
  const distributed::DistributedMesh& mesh() const { return mesh_; }
  const ProblemInput& input() const { return input_; }
  bool moving() const { return mesh_motion_.has_value() || input_.mesh_displacement; }

 private:
  /// How the residual depends on the Newton unknown, and at which instant it is evaluated.
  struct Instant {
    std::optional<assembly::TimeScheme> scheme;  ///< none: statics
    double time = 0;                             ///< of the loads [s]
    double load_factor = 1;
  };
  void evaluate_fields(const State& old_state, const State& next, const Instant& instant);
  void follow_velocity(const State& old_state, State& next, const assembly::TimeScheme& scheme) const;
  std::vector<Boundaries::FaceFlow> flows_to_prescribe(const State& state, double until,
                                                       const assembly::TimeScheme& scheme) const;
  void scale_inflows(const State& old_state, State& next, const assembly::TimeScheme& scheme);
  void interpolate_pressure(State& state) const;
  void set_to_mean(std::span<double> field, const distributed::EdgeNode& edge) const;
  double largest_speed(const State& state) const;
  void remember_start(const State& state, const State& next);
  void prescribe_mesh(State& state) const;
  int move_mesh(const State& old_state, State& next, const assembly::TimeScheme& scheme);
  void synchronise_twins(State& state) const;
  void add_lumen(const Instant& instant, std::span<double> residual, float* blocks) const;
  void add_wall(const Instant& instant, std::span<double> residual, float* blocks) const;
  void assemble(const State& next, const Instant& instant, bool with_tangent);
  double residual_norm() const;
  void update_present_modulus(const State& state);
  StepReport newton(const State& old_state, State& next, const Instant& instant);
  void iterate(const State& old_state, State& next, const Instant& instant, StepReport& report);
  bool closes_mass(State& next, const Instant& instant) const;
  /// First residual, tangent and preconditioner of a step; returns the norm that ends it and the norm of round-off.
  struct Targets {
    double converged, noise;
  };
  Targets start(State& next, const Instant& instant, double& norm);
  bool solve_increment(NewtonRecord& record, double absolute, std::string& failure);
  /// Goes along the increment as far as the residual allows; returns its norm there, none when every length fails.
  std::optional<double> line_search(const State& old_state, State& next, const Instant& instant, double norm,
                                    double target, NewtonRecord& record, std::string& failure);
  void update(const State& old_state, State& next, const Instant& instant, std::span<const double> start,
              double step_length, NewtonRecord& record);
  std::string mesh_failure() const;
  std::vector<double> negligible_forces() const;

  const distributed::DistributedMesh& mesh_;
  ProblemInput input_;
  assembly::Isa isa_;
  assembly::BlockPattern pattern_;
  Boundaries boundaries_;
  MovedFaces moved_faces_;
  std::vector<LumenGroup> lumen_groups_;
  struct Wall;
  std::unique_ptr<Wall> wall_;      ///< null without one
  std::vector<double> negligible_;  ///< forces whose norm is noise, [owned node][4]; empty without a wall
  std::vector<char> follows_wall_;  ///< [local node] wall nodes and their hosts
  std::vector<distributed::EdgeNode>
      edges_;  ///< those with nodes; in the lumen they move the mesh as the mean of their ends does
  bool has_idle_pressures_ = false;  ///< on some rank
  assembly::BlockMatrix matrix_;
  assembly::Ties ties_;
  assembly::LinearSolver solver_;
  std::optional<MeshMotion> mesh_motion_;

  std::vector<double> reference_position_, position_, velocity_pressure_, acceleration_, mesh_velocity_, stream_,
      convection_, displacement_;
  std::vector<double> residual_, increment_, nodal_forces_;
  std::vector<assembly::RankOne> outlets_;
  std::vector<double> outlet_flows_;
  Instant last_instant_;
  double flow_speed_ = 0.0;
  StepTimings timings_;  ///< of the step under way
  std::vector<Boundaries::FaceFlow> prescribed_flows_;
  std::optional<std::int64_t> accepted_step_;  ///< State::step that the last accepted step led to; none in the next one
};

}  // namespace tunica::coupling
