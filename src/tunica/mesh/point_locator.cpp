#include "tunica/mesh/point_locator.hpp"

#include <array>
#include <bit>
#include <cassert>
#include <cmath>

namespace tunica::mesh {

PointLocator::PointLocator(std::span<const Vec3<double>> points, double radius)
    : cell_(2 * radius), points_(points.begin(), points.end()) {
  assert(radius > 0);
  const std::size_t buckets = std::bit_ceil(points.size() + 1);
  first_.assign(buckets + 1, 0);
  order_.resize(points.size());
  std::vector<std::size_t> in(points.size());
  for (std::size_t p = 0; p < points.size(); ++p) {
    const auto& x = points[p];
    in[p] = bucket(std::llround(x[0] / cell_), std::llround(x[1] / cell_), std::llround(x[2] / cell_));
    ++first_[in[p] + 1];
  }
  for (std::size_t b = 0; b < buckets; ++b) first_[b + 1] += first_[b];
  auto next = first_;
  for (std::size_t p = 0; p < points.size(); ++p) order_[next[in[p]]++] = static_cast<std::int64_t>(p);
}

std::size_t PointLocator::bucket(std::int64_t i, std::int64_t j, std::int64_t k) const {
  auto h = static_cast<std::uint64_t>(i) * 0x9e3779b97f4a7c15u;
  h = (h ^ (h >> 29) ^ static_cast<std::uint64_t>(j)) * 0xbf58476d1ce4e5b9u;
  h = (h ^ (h >> 32) ^ static_cast<std::uint64_t>(k)) * 0x94d049bb133111ebu;
  return (h ^ (h >> 31)) & (first_.size() - 2);
}

std::int64_t PointLocator::nearest(const Vec3<double>& x, double within) const {
  assert(2 * within <= cell_ * (1 + 1e-12));
  // The ball reaches at most into two cells per direction.
  std::int64_t low[3], high[3];
  for (int d = 0; d < 3; ++d) {
    low[d] = std::llround((x[d] - within) / cell_);
    high[d] = std::llround((x[d] + within) / cell_);
  }
  std::int64_t best = -1;
  double best_square = within * within;
  for (auto i = low[0]; i <= high[0]; ++i)
    for (auto j = low[1]; j <= high[1]; ++j)
      for (auto k = low[2]; k <= high[2]; ++k) {
        const auto b = bucket(i, j, k);
        for (auto n = first_[b]; n < first_[b + 1]; ++n) {
          const auto d = points_[order_[n]] - x;
          // Ties go to the lower number, so that the answer does not depend on the hash.
          const double square = dot(d, d);
          if (square < best_square || (square == best_square && (best < 0 || order_[n] < best))) {
            best = order_[n];
            best_square = square;
          }
        }
      }
  return best;
}

std::vector<double> shortest_edges(std::span<const Vec3<double>> points,
                                   std::span<const std::array<std::int64_t, 3>> triangles) {
  std::vector<double> shortest(points.size(), 0.0);
  for (const auto& t : triangles)
    for (int i = 0; i < 3; ++i) {
      const auto a = t[i], b = t[(i + 1) % 3];
      const double length = norm(points[b] - points[a]);
      for (const auto n : {a, b})
        if (shortest[n] == 0 || length < shortest[n]) shortest[n] = length;
    }
  return shortest;
}

}  // namespace tunica::mesh
