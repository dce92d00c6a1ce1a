#include "tunica/assembly/linear_solver.hpp"

#include <algorithm>
#include <cmath>

#include "tunica/base/error.hpp"

namespace tunica::assembly {

namespace {

double dot(const RankOne& outlet, const double* x) {
  double sum = 0;
  for (std::size_t k = 0; k < outlet.nodes.size(); ++k) {
    const double* v = x + 4 * static_cast<std::size_t>(outlet.nodes[k]);
    for (int c = 0; c < 3; ++c) sum += outlet.s[k][c] * v[c];
  }
  return sum;
}

void add_scaled(const RankOne& outlet, double factor, double* y) {
  for (std::size_t k = 0; k < outlet.nodes.size(); ++k)
    for (int c = 0; c < 3; ++c) y[4 * static_cast<std::size_t>(outlet.nodes[k]) + c] += factor * outlet.s[k][c];
}

// s_k^T x for every outlet, summed over ranks in one message.
std::vector<double> flows(MPI_Comm comm, const std::vector<RankOne>& outlets, const double* x) {
  std::vector<double> q;
  q.reserve(outlets.size());
  for (const auto& outlet : outlets) q.push_back(dot(outlet, x));
  MPI_Allreduce(MPI_IN_PLACE, q.data(), static_cast<int>(q.size()), MPI_DOUBLE, MPI_SUM, comm);
  return q;
}

// Inverse of a small dense matrix by Gauss-Jordan elimination with row pivoting; n is the number of outlets.
std::vector<double> dense_inverse(std::vector<double> a, std::size_t n) {
  std::vector<double> inverse(n * n, 0.0);
  for (std::size_t i = 0; i < n; ++i) inverse[i * n + i] = 1;
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < n; ++i)
      if (std::abs(a[i * n + k]) > std::abs(a[pivot * n + k])) pivot = i;
    if (a[pivot * n + k] == 0.0) throw SolverError("The outlets' capacitance matrix is singular.");
    for (std::size_t j = 0; j < n; ++j) {
      std::swap(a[k * n + j], a[pivot * n + j]);
      std::swap(inverse[k * n + j], inverse[pivot * n + j]);
    }
    const double scale = 1.0 / a[k * n + k];
    for (std::size_t j = 0; j < n; ++j) a[k * n + j] *= scale, inverse[k * n + j] *= scale;
    for (std::size_t i = 0; i < n; ++i) {
      const double factor = a[i * n + k];
      if (i == k || factor == 0.0) continue;
      for (std::size_t j = 0; j < n; ++j) {
        a[i * n + j] -= factor * a[k * n + j];
        inverse[i * n + j] -= factor * inverse[k * n + j];
      }
    }
  }
  return inverse;
}

}  // namespace

LinearSolver::LinearSolver(const distributed::DistributedMesh& mesh, const BlockPattern& pattern, Isa isa,
                           KrylovSettings settings)
    : mesh_(mesh),
      isa_(isa),
      preconditioner_(mesh, pattern, isa),
      halo_(4 * static_cast<std::size_t>(pattern.columns_count)),
      work_(4 * static_cast<std::size_t>(pattern.rows)),
      krylov_(
          mesh.comm, 4 * pattern.rows, settings, [this](const double* x, double* y) { multiply(x, y); },
          [this](const double* r, double* z) { precondition(r, z); }) {}

void LinearSolver::update_preconditioner(const BlockMatrix& matrix, const std::vector<RankOne>& outlets) {
  preconditioner_.update(matrix);
  const std::size_t n = outlets.size();
  preconditioned_outlets_ = outlets;
  preconditioned_.assign(n, std::vector<double>(work_.size()));
  std::vector<double> capacitance(n * n);
  for (std::size_t k = 0; k < n; ++k) {
    std::fill(work_.begin(), work_.end(), 0.0);
    add_scaled(outlets[k], 1.0, work_.data());
    preconditioner_.apply(work_, preconditioned_[k]);
    const auto column = flows(mesh_.comm, outlets, preconditioned_[k].data());
    for (std::size_t i = 0; i < n; ++i)
      capacitance[i * n + k] = (i == k ? 1.0 : 0.0) + outlets[i].coefficient * column[i];
  }
  capacitance_inverse_ = dense_inverse(std::move(capacitance), n);
}

// In the scaled variables x^ = d x, r^ = r / d.
void LinearSolver::multiply(const double* x, double* y) {
  const auto& d = preconditioner_.scale();
  const std::size_t n = work_.size();
  for (std::size_t i = 0; i < n; ++i) halo_[i] = x[i] / d[i];
  mesh_.halo.update(halo_, 4);
  matrix_->multiply(isa_, halo_, {y, n});
  if (!outlets_->empty()) {
    const auto q = flows(mesh_.comm, *outlets_, halo_.data());
    for (std::size_t k = 0; k < q.size(); ++k) add_scaled((*outlets_)[k], (*outlets_)[k].coefficient * q[k], y);
  }
  for (std::size_t i = 0; i < n; ++i) y[i] /= d[i];
}

void LinearSolver::precondition(const double* r, double* z) {
  const auto& d = preconditioner_.scale();
  const std::size_t n = work_.size();
  for (std::size_t i = 0; i < n; ++i) work_[i] = r[i] * d[i];
  preconditioner_.apply(work_, {z, n});
  const std::size_t outlets = preconditioned_.size();
  if (outlets > 0) {
    auto q = flows(mesh_.comm, preconditioned_outlets_, z);
    for (std::size_t k = 0; k < outlets; ++k) q[k] *= preconditioned_outlets_[k].coefficient;
    for (std::size_t k = 0; k < outlets; ++k) {
      double factor = 0;
      for (std::size_t j = 0; j < outlets; ++j) factor += capacitance_inverse_[k * outlets + j] * q[j];
      for (std::size_t i = 0; i < n; ++i) z[i] -= factor * preconditioned_[k][i];
    }
  }
  for (std::size_t i = 0; i < n; ++i) z[i] *= d[i];
}

LinearResult LinearSolver::solve(const BlockMatrix& matrix, const std::vector<RankOne>& outlets,
                                 std::span<const double> rhs, std::span<double> x, double absolute) {
  matrix_ = &matrix;
  outlets_ = &outlets;
  const auto& d = preconditioner_.scale();
  std::vector<double> b(work_.size());
  for (std::size_t i = 0; i < b.size(); ++i) b[i] = rhs[i] / d[i];
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
