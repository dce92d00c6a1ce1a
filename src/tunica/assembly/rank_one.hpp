// Outlets couple all nodes of a face through their flow rate: A += coefficient s s^T, never stored as a matrix.
#pragma once

#include <mpi.h>

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace tunica::assembly {

/// s holds the area vectors of the nodes of one face, s_A = int N_A n dA [m^2], already projected on the free motions.
/// Only owned nodes are listed.
struct RankOne {
  double coefficient = 0;  ///< d(traction)/d(flow), times d(velocity)/d(unknown) [Pa s/m^3]
  std::vector<std::int32_t> nodes;
  std::vector<std::array<double, 3>> s;
};

/// s_k^T x of every outlet, x: [owned node][4], summed over the ranks in one message. Collective.
std::vector<double> flows(MPI_Comm comm, const std::vector<RankOne>& outlets, std::span<const double> x);

/// y += factor s.
void add_scaled(const RankOne& outlet, double factor, std::span<double> y);

/// The inverse of B + sum c_k s_k s_k^T from that of B by the Sherman-Morrison-Woodbury formula, exact as far as B^-1
/// is.
class RankOneInverse {
 public:
  /// `solve` turns r into B^-1 r in place, [owned node][4]; called once for each outlet. Throws SolverError when the
  /// sum is singular. Collective.
  RankOneInverse(MPI_Comm comm, std::vector<RankOne> outlets, std::size_t size,
                 const std::function<void(std::span<double>)>& solve);
  RankOneInverse() = default;

  /// B^-1 r becomes (B + sum c_k s_k s_k^T)^-1 r. Collective.
  void correct(std::span<double> z) const;

 private:
  MPI_Comm comm_ = MPI_COMM_NULL;
  std::vector<RankOne> outlets_;
  std::vector<std::vector<double>> solved_;  ///< B^-1 s_k
  std::vector<double> inverse_;              ///< of (1 + diag(c) s^T B^-1 s), row by row
};

}  // namespace tunica::assembly
