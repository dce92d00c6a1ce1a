// The conditions of a case, bound to the faces of a distributed mesh.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tunica/assembly/block_matrix.hpp"
#include "tunica/assembly/rank_one.hpp"
#include "tunica/bc/conditions.hpp"
#include "tunica/coupling/held_nodes.hpp"
#include "tunica/coupling/settings.hpp"
#include "tunica/coupling/surface_loads.hpp"
#include "tunica/distributed/distributed_mesh.hpp"
#include "tunica/fluid/parameters.hpp"

namespace tunica::coupling {

/// A value as a function of the time [s]. Called on all ranks alike, in the same order; gives all of them the same.
using Course = std::function<double(double)>;

/// A lumen face may have the condition `fixed` here, which then holds the velocity.
struct BoundaryInput {
  std::vector<std::pair<std::string, bc::Condition>> conditions;  ///< face name, condition
  std::vector<std::pair<std::string, std::string>> interfaces;    ///< (lumen face, wall face)
  bool wall_has_pressure = true;                                  ///< mixed wall element
  std::optional<fluid::Parameters> fluid;

  // Conditions on lumen faces that only code can give, such as exact solutions.
  std::vector<std::pair<std::string, VectorField>> velocity_fields;  ///< face, velocity at t_{n+1} [m/s]
  /// Face, traction [Pa] on the current face at t_{n+alpha_f}, interpolated between the nodes like the velocity.
  std::vector<std::pair<std::string, VectorField>> traction_fields;
  /// Face with a condition `flow`, Q(t) [m^3/s] into the lumen in the place of what the condition says of it.
  std::vector<std::pair<std::string, Course>> inflows{};
  /// Wall face, pressure [Pa] at its nodes [local node]: follows the deformed face, each triangle takes the mean of its
  /// nodes. Statics multiplies it by its load factor.
  std::vector<std::pair<std::string, std::vector<double>>> wall_pressures;
  /// Lumen flow with prescribed velocity all around.
  std::optional<PressurePoint> pressure_point;
};

class Boundaries {
 public:
  /// Throws InputError for an unknown face or a table that cannot be read; whether every face has one fitting condition
  /// is for the caller to check (bc::check_boundary). Collective.
  Boundaries(const distributed::DistributedMesh& mesh, const assembly::BlockPattern& pattern,
             const BoundaryInput& input);

  /// Free motions of nodes in the (v, p) system.
  const assembly::Constraints& constraints() const { return constraints_; }
  /// Free motions of lumen nodes in the mesh motion: the interface is led by the wall, openings slide in their plane.
  const std::vector<assembly::NodeConstraint>& mesh_constraints() const { return mesh_constraints_; }

  /// Owned nodes of every wall face that keeps its shape under its load.
  const std::vector<std::vector<std::int32_t>>& tied_nodes() const { return tied_nodes_; }

  /// Pressures that the equations do not know, held as they are.
  const std::vector<IdlePressure>& idle_pressures() const { return idle_pressures_; }

  /// Sets the prescribed velocities of time t [s], and the pressure that is held, in `velocity_pressure` ([local
  /// node][4]).
  void prescribe(double t, std::span<double> velocity_pressure) const;

  /// All that acts on faces but the pressures of the outlets.
  const SurfaceLoads& loads() const { return loads_; }

  /// Outlets, in order: their models, and where they are.
  std::vector<bc::Outlet> make_outlets() const;
  /// Volume flow out of the outlets [m^3/s] with the fields at t_{n+alpha_f}. Collective.
  std::vector<double> outlet_flows(const FieldsView& fields) const;
  /// Adds the pressures of the outlets [Pa] and returns the vectors of their rank-one tangents, coefficient unset.
  std::vector<assembly::RankOne> add_outlets(std::span<const double> pressures, const FieldsView& fields,
                                             std::span<double> residual) const;

  struct PrescribedNode {
    std::int32_t node;
    Vec3<double> velocity;  ///< per unit of the course
    std::size_t course;
    bc::Axes axes{true, true, true};  ///< along these
  };

  /// A face with a condition `flow`, and the flow out of the lumen through it [m^3/s].
  struct FaceFlow {
    std::size_t face;
    double outward;
  };
  /// What those faces prescribe at time t, in the order of the conditions.
  std::vector<FaceFlow> prescribed_flows(double t) const;
  /// What passes them, relative to the moving mesh, as the balance of mass counts it (eq. 4.5a). Collective.
  std::vector<FaceFlow> actual_flows(const FieldsView& fields) const;

  /// A node inside such a face, ghosts included.
  struct InflowNode {
    std::int32_t node;
    Vec3<double> velocity;  ///< per unit of the flow
    std::size_t inflow;     ///< number of its face in prescribed_flows()
  };
  const std::vector<InflowNode>& inflow_nodes() const { return inflow_nodes_; }
  /// Scales the velocities of those nodes at t_{n+1}, of which `fields` hold the share `weight`, so that the flows of
  /// `fields` become `flows`. `fields` themselves are left as they are. Collective.
  void scale_inflows(std::span<const FaceFlow> flows, double weight, const FieldsView& fields,
                     std::span<double> velocity_pressure) const;

 private:
  struct FieldNode {
    std::int32_t node;
    std::size_t field;     ///< in velocity_fields_
    Mat3<double> allowed;  ///< projector on the planes of symmetry that the node lies on
    bc::Axes axes;         ///< along these
  };
  struct OutletFace {
    std::size_t face;
    std::variant<bc::Resistance, bc::Rcr> model;
  };
  struct Builder;

  void bind_given(const BoundaryInput& input, Builder& builder, const std::map<std::string, std::size_t>& index_of);
  void hold_unknown_pressures(const BoundaryInput& input, Builder& builder);
  void hold_mesh(const BoundaryInput& input, Builder& builder);
  void find_inflow_nodes();

  const distributed::DistributedMesh& mesh_;
  SurfaceLoads loads_;
  assembly::Constraints constraints_;
  std::vector<assembly::NodeConstraint> mesh_constraints_;
  std::vector<Course> courses_;
  std::vector<PrescribedNode> prescribed_;
  std::vector<VectorField> velocity_fields_;
  std::vector<FieldNode> field_nodes_;
  std::int32_t pressure_node_ = -1;  ///< owned, whose pressure is held; -1: not on this rank
  double held_pressure_ = 0.0;       ///< [Pa]
  std::vector<IdlePressure> idle_pressures_;
  std::vector<OutletFace> outlets_;
  std::vector<std::vector<std::int32_t>> tied_nodes_;
  std::vector<Mat3<double>> projector_;  ///< of constrained owned nodes, looked up through projector_of_
  std::vector<std::int32_t> projector_of_;
  struct Inflow {
    std::size_t face, course;
  };
  std::vector<Inflow> inflows_;
  std::vector<InflowNode> inflow_nodes_;
  std::vector<double> inflow_profiles_;  ///< velocities of inflow_nodes_, else zero [local node][4]
};

}  // namespace tunica::coupling
