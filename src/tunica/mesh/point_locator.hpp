// Finds points by their coordinates.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tunica/base/tensor.hpp"

namespace tunica::mesh {

/// A hash of the cells of a uniform grid; a look-up takes constant time when few points share a cell.
class PointLocator {
 public:
  /// `radius` [m] > 0: the largest distance that `nearest` will be asked for. Keeps a copy of the points.
  PointLocator(std::span<const Vec3<double>> points, double radius);

  /// Position of the point nearest to `x` at a distance of at most `within` <= radius, -1 if there is none.
  std::int64_t nearest(const Vec3<double>& x, double within) const;

 private:
  std::size_t bucket(std::int64_t i, std::int64_t j, std::int64_t k) const;

  double cell_;
  std::vector<Vec3<double>> points_;
  std::vector<std::int64_t> first_, order_;  ///< points by bucket; the number of buckets is a power of two
};

/// Length of the shortest triangle edge at each of `nodes` points; 0 at points that no triangle uses.
std::vector<double> shortest_edges(std::span<const Vec3<double>> points,
                                   std::span<const std::array<std::int64_t, 3>> triangles);

}  // namespace tunica::mesh
