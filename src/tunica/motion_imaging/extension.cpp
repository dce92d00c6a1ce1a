#include "tunica/motion_imaging/extension.hpp"

#include <fmt/format.h>

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>
#include <utility>

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

}  // namespace

struct Extension::System {
  std::vector<std::int64_t> carrier;  ///< of each node: the one whose motion it has
  std::vector<Edge> edges;
  std::vector<int> unknown;
  Eigen::SparseMatrix<double> matrix;
  Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper> solver;
};

Extension::Extension(const mesh::MeshData& data, std::vector<std::int64_t> given)
    : given_(std::move(given)), system_(std::make_unique<System>()) {
  auto& s = *system_;
  s.carrier.resize(data.points.size());
  std::iota(s.carrier.begin(), s.carrier.end(), std::int64_t{0});
  for (const auto& [wall, lumen] : data.twins) s.carrier[static_cast<std::size_t>(wall)] = lumen;
  std::vector<bool> known(data.points.size());
  for (auto& node : given_) {
    node = s.carrier[static_cast<std::size_t>(node)];
    known[static_cast<std::size_t>(node)] = true;
  }
  s.edges = edges_of(data, s.carrier);
  int size = 0;
  std::tie(s.unknown, size) = unknowns_of(s.carrier, known, s.edges);
  std::vector<Eigen::Triplet<double>> entries;
  for (const auto& edge : s.edges)
    for (const auto& [a, b] : {std::pair{edge[0], edge[1]}, {edge[1], edge[0]}}) {
      const int i = s.unknown[static_cast<std::size_t>(a)], j = s.unknown[static_cast<std::size_t>(b)];
      if (i < 0) continue;
      entries.emplace_back(i, i, 1.0);
      if (j >= 0) entries.emplace_back(i, j, -1.0);
    }
  s.matrix.resize(size, size);
  s.matrix.setFromTriplets(entries.begin(), entries.end());
  s.solver.setTolerance(1e-6);
  if (size > 0) s.solver.compute(s.matrix);
}

Extension::~Extension() = default;

std::vector<double> Extension::of(std::span<const Vec3<double>> displacements) const {
  const auto& s = *system_;
  Eigen::MatrixXd values = Eigen::MatrixXd::Zero(std::ssize(s.carrier), 3);
  for (std::size_t k = 0; k < given_.size(); ++k)
    for (int d = 0; d < 3; ++d) values(given_[k], d) = displacements[k][d];
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(s.matrix.rows(), 3);
  for (const auto& edge : s.edges)
    for (const auto& [a, b] : {std::pair{edge[0], edge[1]}, {edge[1], edge[0]}}) {
      const int i = s.unknown[static_cast<std::size_t>(a)];
      if (i >= 0 && s.unknown[static_cast<std::size_t>(b)] < 0) right.row(i) += values.row(b);
    }
  if (right.rows() > 0) {
    const Eigen::MatrixXd found = s.solver.solve(right);
    if (s.solver.info() != Eigen::Success)
      throw SolverError(
          fmt::format("the motion of the wall was not carried into the mesh: {} iterations leave an error "
                      "of {:.2g}. Check the mesh with `tunica check`",
                      s.solver.iterations(), s.solver.error()));
    for (std::size_t n = 0; n < s.unknown.size(); ++n)
      if (s.unknown[n] >= 0) values.row(static_cast<Eigen::Index>(n)) = found.row(s.unknown[n]);
  }
  std::vector<double> result;
  result.reserve(3 * s.carrier.size());
  for (const auto node : s.carrier)
    for (int d = 0; d < 3; ++d) result.push_back(values(node, d));
  return result;
}

}  // namespace tunica::motion_imaging
