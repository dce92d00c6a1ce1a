#include "tunica/motion_imaging/extension.hpp"

#include <fmt/format.h>

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <numeric>

#include "tunica/base/disjoint_sets.hpp"
#include "tunica/base/error.hpp"

namespace tunica::motion_imaging {

namespace {

using Edge = std::array<std::int64_t, 2>;

/// Of the tetrahedra, each once, between the nodes that carry the motion.
std::vector<Edge> edges_of(const mesh::MeshData& data, const std::vector<std::int64_t>& carrier) {
  std::vector<Edge> edges;
  for (const auto& t : data.tetrahedra)
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t b = a + 1; b < 4; ++b) {
        const auto p = carrier[static_cast<std::size_t>(t[a])], q = carrier[static_cast<std::size_t>(t[b])];
        edges.push_back({std::min(p, q), std::max(p, q)});
      }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

/// Nodes whose motion is looked for: they carry their own, and hang together with one that is given. Their numbers, -1
/// for all others, and how many there are.
std::pair<std::vector<int>, int> unknowns_of(const std::vector<std::int64_t>& carrier, const std::vector<bool>& known,
                                             const std::vector<Edge>& edges) {
  const auto count = std::ssize(carrier);
  base::DisjointSets pieces(count);
  for (const auto& [a, b] : edges) pieces.join(a, b);
  std::vector<bool> reached(carrier.size());
  for (std::int64_t n = 0; n < count; ++n)
    if (known[static_cast<std::size_t>(n)]) reached[static_cast<std::size_t>(pieces.set_of(n))] = true;
  std::vector<int> unknown(carrier.size(), -1);
  int size = 0;
  for (std::int64_t n = 0; n < count; ++n) {
    const auto at = static_cast<std::size_t>(n);
    if (!known[at] && carrier[at] == n && reached[static_cast<std::size_t>(pieces.set_of(n))]) unknown[at] = size++;
  }
  return {std::move(unknown), size};
}

/// Solves for the unknown rows of `values`.
void fill_unknown(const std::vector<Edge>& edges, const std::vector<int>& unknown, int size, Eigen::MatrixXd& values) {
  using Sparse = Eigen::SparseMatrix<double>;
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(size, 3);
  for (const auto& edge : edges)
    for (const auto& [a, b] : {std::pair{edge[0], edge[1]}, {edge[1], edge[0]}}) {
      const int i = unknown[static_cast<std::size_t>(a)], j = unknown[static_cast<std::size_t>(b)];
      if (i < 0) continue;
      entries.emplace_back(i, i, 1.0);
      if (j >= 0)
        entries.emplace_back(i, j, -1.0);
      else
        right.row(i) += values.row(b);
    }
  Sparse matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::ConjugateGradient<Sparse, Eigen::Lower | Eigen::Upper> solver;
  solver.setTolerance(1e-6);
  solver.compute(matrix);
  const Eigen::MatrixXd found = solver.solve(right);
  if (solver.info() != Eigen::Success)
    throw SolverError(
        fmt::format("the motion of the wall was not carried into the mesh: {} iterations leave an error "
                    "of {:.2g}. Check the mesh with `tunica check`",
                    solver.iterations(), solver.error()));
  for (std::size_t n = 0; n < unknown.size(); ++n)
    if (unknown[n] >= 0) values.row(static_cast<Eigen::Index>(n)) = found.row(unknown[n]);
}

}  // namespace

std::vector<double> extended(const mesh::MeshData& data,
                             const std::vector<std::pair<std::int64_t, Vec3<double>>>& given) {
  const auto count = data.points.size();
  std::vector<std::int64_t> carrier(count);
  std::iota(carrier.begin(), carrier.end(), std::int64_t{0});
  for (const auto& [wall, lumen] : data.twins) carrier[static_cast<std::size_t>(wall)] = lumen;
  Eigen::MatrixXd values = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(count), 3);
  std::vector<bool> known(count);
  for (const auto& [node, displacement] : given) {
    const auto at = carrier[static_cast<std::size_t>(node)];
    known[static_cast<std::size_t>(at)] = true;
    for (int d = 0; d < 3; ++d) values(at, d) = displacement[d];
  }
  const auto edges = edges_of(data, carrier);
  const auto [unknown, size] = unknowns_of(carrier, known, edges);
  if (size > 0) fill_unknown(edges, unknown, size, values);
  std::vector<double> result;
  result.reserve(3 * count);
  for (const auto node : carrier)
    for (int d = 0; d < 3; ++d) result.push_back(values(node, d));
  return result;
}

}  // namespace tunica::motion_imaging
