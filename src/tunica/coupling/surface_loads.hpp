// Loads on the faces of a mesh: pressures, tractions, tissue support, and the backflow that comes with open lumen
// faces.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "tunica/assembly/block_matrix.hpp"
#include "tunica/bc/velocity_profile.hpp"
#include "tunica/bc/waveform.hpp"
#include "tunica/coupling/loop_views.hpp"
#include "tunica/distributed/distributed_mesh.hpp"
#include "tunica/fluid/parameters.hpp"
#include "tunica/wall/surface.hpp"

namespace tunica::coupling {

/// How the surface loads depend on the Newton unknown.
struct LoadCoefficients {
  double velocity = 1.0;      ///< d(v at t_{n+alpha_f}) / d(unknown)
  double displacement = 0.0;  ///< d(u at t_{n+alpha_f}) / d(unknown)
};

/// A vector as a function of the reference position [m] and the time [s]. Called on every rank that holds the node.
using VectorField = std::function<Vec3<double>(const Vec3<double>&, double)>;

/// Values of a table at the nodes of a face.
class NodalHistories {
 public:
  /// Throws InputError for a node that is far from all points of the table.
  NodalHistories(const distributed::DistributedMesh& mesh, const distributed::Face& face, bc::PointTable table);

  /// Values at time t [s], for `at`.
  std::vector<Vec3<double>> values(double t) const;
  const Vec3<double>& at(const std::vector<Vec3<double>>& values, std::int32_t node) const {
    return values[static_cast<std::size_t>(slot_[static_cast<std::size_t>(node)])];
  }

 private:
  bc::PointTable table_;
  std::vector<std::int32_t> slot_;  ///< [local node] in histories_; -1 beside the face
  std::vector<std::vector<Vec3<double>>> histories_;
};

struct SurfaceLoad {
  std::size_t face;
  enum class Kind { lumen_pressure, lumen_traction, follower_pressure, dead_pressure, dead_traction, support } kind;
  bc::Waveform course = bc::Waveform::constant(1.0);
  Vec3<double> vector{};
  std::vector<wall::TissueSupport<double>> support{};  ///< of each triangle: means of its nodes
  std::vector<double> pressures{};                     ///< follower pressure of each triangle; empty: `course`
  /// Tractions in the place of `vector`, factors of the pressure in their first components; interpolated between nodes.
  std::optional<NodalHistories> over_face{};
};

/// Traction [Pa] on the current lumen face, interpolated between the nodes like the velocity.
struct TractionField {
  std::size_t face;
  VectorField traction;
};

class SurfaceLoads {
 public:
  /// `fluid`: of the lumen; may be absent where there is none. The mesh and the pattern outlive this.
  SurfaceLoads(const distributed::DistributedMesh& mesh, const assembly::BlockPattern& pattern,
               const std::optional<fluid::Parameters>& fluid);

  void bind(SurfaceLoad load) { loads_.push_back(std::move(load)); }
  void bind(TractionField load) { traction_fields_.push_back(std::move(load)); }
  /// A lumen face whose pressure others add: backflow alone is added here.
  void bind_open(std::size_t face) { open_faces_.push_back(face); }

  /// Adds all loads at time t [s] to the residual ([local node][4]) and, where `matrix` is given, their tangent.
  /// `factor` multiplies the prescribed loads (pressure, traction, p0), for load steps in statics.
  void add(double t, double factor, const FieldsView& fields, const LoadCoefficients& coefficients,
           std::span<double> residual, assembly::BlockMatrix* matrix) const;

 private:
  struct Sums;  ///< what a load adds to, and how it depends on the unknown

  void add_lumen(const SurfaceLoad& load, double value, const Sums& sums) const;
  void add_quadratic_lumen(const SurfaceLoad& load, double value, const Sums& sums) const;
  void add_traction(const TractionField& load, double t, double factor, const Sums& sums) const;
  void add_over_lumen(const SurfaceLoad& load, double value, double t, const Sums& sums) const;
  void add_over_wall(const SurfaceLoad& load, double value, double t, const Sums& sums) const;
  void add_over_quadratic_wall(const SurfaceLoad& load, double value, double t, const Sums& sums) const;
  void add_backflow(std::size_t face, const Sums& sums) const;
  void add_wall(const SurfaceLoad& load, double value, double factor, const Sums& sums) const;
  void add_quadratic_wall(const SurfaceLoad& load, double value, double factor, const Sums& sums) const;

  const distributed::DistributedMesh& mesh_;
  const assembly::BlockPattern& pattern_;
  std::optional<fluid::Parameters> fluid_;
  std::vector<SurfaceLoad> loads_;
  std::vector<TractionField> traction_fields_;
  std::vector<std::size_t> open_faces_;
};

}  // namespace tunica::coupling
