// Motion of the lumen mesh: extension of the interface displacement into the lumen (docs/theory.md, section 3).
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "tunica/ale/parameters.hpp"
#include "tunica/assembly/block_matrix.hpp"
#include "tunica/assembly/krylov.hpp"
#include "tunica/distributed/distributed_mesh.hpp"
#include "tunica/parallel/petsc.hpp"

namespace tunica::coupling {

/// The extension refers to the initial mesh, so matrix and multigrid hierarchy are made once.
///
/// Conjugate gradients on the elastic matrix, preconditioned by one BoomerAMG cycle per direction on the matrix of its
/// scalar counterpart: by Korn's inequality the two are equivalent with a constant that depends on Poisson's ratio
/// only.
class MeshMotion {
 public:
  /// `constraints`: lumen nodes that do not move freely; interface nodes have P = 0. Collective.
  MeshMotion(const distributed::DistributedMesh& mesh, assembly::Isa isa, const ale::Parameters& parameters,
             std::vector<assembly::NodeConstraint> constraints);

  /// Moves the free nodes of `displacement` ([local node][4], ghosts up to date) so that the lumen is in equilibrium
  /// with the values that the constrained directions hold, to `tolerance` relative to the forces of those values.
  /// Returns the iterations; throws SolverError when they do not suffice. Collective.
  int solve(std::span<double> displacement, double tolerance);

 private:
  struct LostBlock {  ///< what the elimination takes out of row `row`, column `column`: A (I - P)
    std::int32_t row, column;
    Mat3<double> a;
  };
  void assemble(const ale::Parameters& parameters);
  /// Multigrid on the scalar matrix with the entries `scalar` of pattern_; fixed nodes are Dirichlet nodes.
  void make_preconditioner(const std::vector<double>& scalar);
  void eliminate();
  void apply(const double* x, double* y);
  void precondition(const double* r, double* z);

  const distributed::DistributedMesh& mesh_;
  assembly::Isa isa_;
  assembly::BlockPattern pattern_;
  std::vector<float> blocks_;  ///< [block][12], padded columns
  std::vector<LostBlock> lost_;
  std::vector<assembly::NodeConstraint> constraints_;
  std::vector<std::int32_t> constraint_of_;  ///< [local node], -1: free
  parallel::MatHandle scalar_;
  parallel::PcHandle multigrid_;
  parallel::VecHandle rhs_, solution_;
  std::vector<double> halo_, increment_, residual_;
  std::unique_ptr<assembly::Krylov> krylov_;
};

/// Smallest quality (ale::relative_quality) of the lumen elements when their nodes stand at `position` ([local
/// node][4]), and where it is. Collective.
struct MeshQuality {
  double smallest = 1.0;
  std::int64_t element = -1;  ///< position in MeshData::tetrahedra
  Vec3<double> place{};       ///< centroid in the initial mesh [m]
};
MeshQuality mesh_quality(const distributed::DistributedMesh& mesh, std::span<const double> position);

}  // namespace tunica::coupling
