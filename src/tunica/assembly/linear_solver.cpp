#include "tunica/assembly/linear_solver.hpp"

#include <cmath>

namespace tunica::assembly {

LinearSolver::LinearSolver(const distributed::DistributedMesh& mesh, const BlockPattern& pattern, Isa isa,
                           KrylovSettings settings, Ties ties)
    : mesh_(mesh),
      isa_(isa),
      ties_(std::move(ties)),
      preconditioner_(mesh, pattern, isa),
      halo_(4 * static_cast<std::size_t>(pattern.columns_count)),
      work_(4 * static_cast<std::size_t>(pattern.rows)),
      krylov_(
          mesh.comm, 4 * pattern.rows, settings, [this](const double* x, double* y) { multiply(x, y); },
          [this](const double* r, double* z) { precondition(r, z); }) {}

void LinearSolver::update_preconditioner(const BlockMatrix& matrix, const std::vector<RankOne>& outlets) {
  preconditioner_.update(matrix, outlets);
}

// In the scaled variables x^ = d x, r^ = r / d. Tied, x^ is d times one vector; the right-hand side, and so every
// vector of the Krylov space, is projected on these.
void LinearSolver::multiply(const double* x, double* y) {
  const auto& d = preconditioner_.scale();
  const std::size_t n = work_.size();
  for (std::size_t i = 0; i < n; ++i) halo_[i] = x[i] / d[i];
  mesh_.halo.update(halo_, 4);
  matrix_->multiply(isa_, halo_, {y, n});
  if (!outlets_->empty()) {
    const auto q = flows(mesh_.comm, *outlets_, halo_);
    for (std::size_t k = 0; k < q.size(); ++k) add_scaled((*outlets_)[k], (*outlets_)[k].coefficient * q[k], {y, n});
  }
  for (std::size_t i = 0; i < n; ++i) y[i] /= d[i];
  ties_.project(d, {y, n});
}

void LinearSolver::precondition(const double* r, double* z) {
  const auto& d = preconditioner_.scale();
  const std::size_t n = work_.size();
  for (std::size_t i = 0; i < n; ++i) work_[i] = r[i] * d[i];
  preconditioner_.apply(work_, {z, n});
  for (std::size_t i = 0; i < n; ++i) z[i] *= d[i];
  ties_.project(d, {z, n});
}

LinearResult LinearSolver::solve(const BlockMatrix& matrix, const std::vector<RankOne>& outlets,
                                 std::span<const double> rhs, std::span<double> x, double absolute) {
  matrix_ = &matrix;
  outlets_ = &outlets;
  const auto& d = preconditioner_.scale();
  std::vector<double> b(work_.size());
  for (std::size_t i = 0; i < b.size(); ++i) b[i] = rhs[i] / d[i];
  ties_.project(d, b);
  const LinearResult result = krylov_.solve(b, x.first(b.size()), absolute);
  for (std::size_t i = 0; i < b.size(); ++i) x[i] /= d[i];
  mesh_.halo.update(x, 4);
  return result;
}

double LinearSolver::norm(std::span<const double> residual) const {
  const auto& d = preconditioner_.scale();
  double sum = 0;
  for (std::size_t i = 0; i < work_.size(); ++i) sum += residual[i] * residual[i] / (d[i] * d[i]);
  MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, mesh_.comm);
  return std::sqrt(sum);
}

}  // namespace tunica::assembly
