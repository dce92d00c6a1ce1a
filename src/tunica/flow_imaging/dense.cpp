#include "tunica/flow_imaging/dense.hpp"

#include <fmt/format.h>

#include <cmath>

#include "tunica/base/error.hpp"

namespace tunica::flow_imaging::dense {

void factorise(Matrix& a, const std::string& what) {
  const std::size_t n = a.rows();
  for (std::size_t i = 0; i < n; ++i) {
    const auto row_i = a.row(i);
    for (std::size_t j = 0; j <= i; ++j) {
      const auto row_j = a.row(j);
      double sum = row_i[j];
      for (std::size_t k = 0; k < j; ++k) sum -= row_i[k] * row_j[k];
      if (i != j) {
        row_i[j] = sum / row_j[j];
        continue;
      }
      if (!(sum > 0))
        throw SolverError(fmt::format("{}: the equations do not determine unknown {} of {}", what, i + 1, n));
      row_i[i] = std::sqrt(sum);
    }
  }
}

void solve(const Matrix& factor, std::span<double> b) {
  const std::size_t n = factor.rows();
  for (std::size_t i = 0; i < n; ++i) {
    const auto row = factor.row(i);
    for (std::size_t k = 0; k < i; ++k) b[i] -= row[k] * b[k];
    b[i] /= row[i];
  }
  for (std::size_t i = n; i-- > 0;) {
    b[i] /= factor(i, i);
    for (std::size_t k = 0; k < i; ++k) b[k] -= factor(i, k) * b[i];
  }
}

}  // namespace tunica::flow_imaging::dense
