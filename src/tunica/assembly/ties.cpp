#include "tunica/assembly/ties.hpp"

namespace tunica::assembly {

namespace {

/// `weight` of an entry of the vector.
template <class Weight>
void project_with(MPI_Comm comm, const std::vector<std::vector<std::int32_t>>& sets, const Weight& weight,
                  std::span<double> x) {
  std::vector<double> sums(6 * sets.size(), 0.0);  // of each set: w . x, then w . w
  for (std::size_t s = 0; s < sets.size(); ++s)
    for (const auto node : sets[s])
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t k = 4 * static_cast<std::size_t>(node) + i;
        sums[6 * s + i] += weight(k) * x[k];
        sums[6 * s + 3 + i] += weight(k) * weight(k);
      }
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM, comm);
  for (std::size_t s = 0; s < sets.size(); ++s)
    for (const auto node : sets[s])
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t k = 4 * static_cast<std::size_t>(node) + i;
        x[k] = weight(k) * sums[6 * s + i] / sums[6 * s + 3 + i];
      }
}

}  // namespace

void Ties::project(std::span<const double> w, std::span<double> x) const {
  if (!empty())
    project_with(
        comm_, sets_, [&](std::size_t k) { return w[k]; }, x);
}

void Ties::average(std::span<double> x) const {
  if (!empty())
    project_with(
        comm_, sets_, [](std::size_t) { return 1.0; }, x);
}

}  // namespace tunica::assembly
