// Symmetric positive definite systems of some hundred unknowns.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace tunica::flow_imaging::dense {

/// Row by row.
class Matrix {
 public:
  Matrix(std::size_t rows, std::size_t columns) : columns_(columns), values_(rows * columns, 0.0) {}
  double& operator()(std::size_t i, std::size_t j) { return values_[i * columns_ + j]; }
  double operator()(std::size_t i, std::size_t j) const { return values_[i * columns_ + j]; }
  std::size_t rows() const { return columns_ == 0 ? 0 : values_.size() / columns_; }
  std::span<double> row(std::size_t i) { return {values_.data() + i * columns_, columns_}; }
  std::span<const double> row(std::size_t i) const { return {values_.data() + i * columns_, columns_}; }

 private:
  std::size_t columns_;
  std::vector<double> values_;
};

/// Puts L of A = L L^T in place of the lower triangle of A. SolverError, naming `what`, where A is not positive
/// definite.
void factorise(Matrix& a, const std::string& what);
/// Solves A x = b with its factor; x takes the place of b.
void solve(const Matrix& factor, std::span<double> b);

}  // namespace tunica::flow_imaging::dense
