// Integral quantities of an accepted step: flows, volumes, energies, and the balances that must close.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tunica/coupling/lumen_fluxes.hpp"
#include "tunica/coupling/problem.hpp"

namespace tunica::coupling {

/// A face of the lumen at t_{n+alpha_f}; of Monitors::faces_at_end at t_{n+1}.
struct FaceRecord {
  std::string name;
  double flow = 0;                     ///< out of the lumen, relative to the moving face [m^3/s]
  double mean_pressure = 0;            ///< [Pa]
  double area = 0;                     ///< [m^2]
  std::optional<double> prescribed{};  ///< flow out of the lumen by a condition `flow` [m^3/s]
};

/// Force of the blood on a face that it sticks to, at t_{n+alpha_f}.
struct WallForce {
  std::string name;
  Vec3<double> force{};  ///< [N]
};

/// Values at t_{n+alpha_f}, where the equations are balanced. Fields of a region that is not there are zero.
struct StepRecord {
  std::vector<FaceRecord> faces;  ///< of the lumen, in the order of the mesh

  double lumen_volume = 0, wall_volume = 0;  ///< [m^3]
  double volume_rate = 0;                    ///< surface integral of the mesh velocity over the lumen boundary [m^3/s]
  /// Sum of the flows through all lumen faces + volume_rate [m^3/s]. The continuity equations add up to it, so that it
  /// vanishes to the tolerance of Newton's method.
  double mass_residual = 0;
  double largest_flow = 0;  ///< of the faces' magnitudes and |volume_rate| [m^3/s]: what mass_residual compares with

  double fluid_kinetic = 0, wall_kinetic = 0, wall_strain = 0;  ///< [J]
  double viscous_dissipation = 0, numerical_dissipation = 0;    ///< of the flow [W]
  double opening_power = 0;                                     ///< of the loads on lumen openings [W]
  double wall_load_power = 0;                                   ///< of loads and supports of the wall [W]
  /// Power that the lumen and the wall elements take from interface nodes that no load acts on [W]. Their sum is the
  /// power that the coupling makes or loses; it vanishes to the tolerance of Newton's method.
  double interface_power_lumen = 0, interface_power_wall = 0;

  double max_displacement = 0;  ///< of all nodes, the lumen mesh included [m]
  double max_velocity = 0;      ///< [m/s]
  double mesh_quality = 1;      ///< smallest of the moving lumen mesh relative to the initial one

  /// Of the lumen faces with no_slip and of the interface, in the order of the mesh. What the equations leave at the
  /// nodes of the face (consistent nodal forces); a node of several such faces counts for each in equal parts.
  std::vector<WallForce> wall_forces;
  std::optional<LumenRecord> lumens;  ///< where true and false lumen are told apart
};

/// What does not change from step to step.
class Monitors {
 public:
  /// `problem` must outlive this. `map`: where the lumens of a dissection are.
  explicit Monitors(const Problem& problem);

  /// For the step of size `dt` [s] that `problem` last accepted; 0 for a static equilibrium. All sums are added in rank
  /// order. Collective.
  StepRecord evaluate(double dt) const;
  /// The lumen faces at the time of `state`, which the step has led to. Collective.
  std::vector<FaceRecord> faces_at_end(const State& state) const;

 private:
  enum class NodeKind : char { inner, opening, interface, rim, wall };

  void find_sticking_faces();
  /// Flow, force of the pressure, area, sweep: rate of the volume that the face passes over.
  struct FaceSums {
    double flow, force, area, sweep;
    FaceRecord record(const std::string& name) const { return {name, flow, force / area, area, {}}; }
  };
  /// Of the lumen faces, in the order of the mesh. Collective.
  std::vector<std::pair<std::string, FaceSums>> face_sums(const FieldsView& fields) const;
  void faces(StepRecord& record) const;
  struct Power;
  Power linear_power(const distributed::Region& region, std::int32_t element, double dt) const;
  Power quadratic_power(const distributed::Region& region, std::int32_t element) const;
  void lumen_elements(double dt, StepRecord& record) const;
  void quadratic_wall_elements(std::size_t region, double (&sums)[3]) const;
  void wall_elements(StepRecord& record) const;
  void powers(const Problem::PartialResiduals& parts, StepRecord& record) const;
  void wall_forces(const Problem::PartialResiduals& parts, StepRecord& record) const;
  void extremes(StepRecord& record) const;
  void lumens(double dt, StepRecord& record) const;

  const Problem& problem_;
  std::vector<NodeKind> kind_;  ///< of the owned nodes
  /// Faces that the blood sticks to, with their owned nodes and what part of a node's force each has.
  struct StickingFace {
    std::size_t face;
    std::vector<std::pair<std::int32_t, double>> nodes;
  };
  std::vector<StickingFace> sticking_;
};

}  // namespace tunica::coupling
