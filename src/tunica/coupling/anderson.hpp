// Anderson's acceleration of a fixed point x <- x + g(x).
#pragma once

#include <mpi.h>

#include <deque>
#include <span>
#include <vector>

namespace tunica::coupling {

/// Of the last points, the combination is taken whose measure, linear in between, is smallest:
///   x_next = x + s g - sum_j c_j (dx_j + s dg_j),   c = argmin |m - sum_j c_j dm_j| (5.6)
/// with the differences d of successive points (Walker & Ni 2011, doi:10.1137/10078356X, eq. 2.3).
class Anderson {
 public:
  /// Keeps at most `memory` differences.
  Anderson(MPI_Comm comm, std::size_t memory) : comm_(comm), memory_(memory) {}

  /// The next point after `x` with the residual g there. `measure`: what is to vanish; each of its entries belongs to
  /// one rank. `share` s of g. Collective.
  std::vector<double> next(const std::vector<double>& x, const std::vector<double>& g,
                           const std::vector<double>& measure, double share);
  void forget() { points_.clear(); }

 private:
  struct Point {
    std::vector<double> x, g, measure;
  };
  std::vector<double> coefficients() const;

  MPI_Comm comm_;
  std::size_t memory_;
  std::deque<Point> points_;  ///< the present one last
};

}  // namespace tunica::coupling
