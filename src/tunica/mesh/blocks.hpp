// Plane sections made of blocks of quadrilaterals that meet node by node.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "tunica/mesh/section.hpp"

namespace tunica::mesh::section {

using Point = std::array<double, 2>;

/// `cells` + 1 numbers from `begin` to `end`, whose last distance is `growth` times the first.
std::vector<double> graded(double begin, double end, int cells, double growth = 1.0);

class Blocks {
 public:
  /// A block of n x m cells with the points point(i, j), i <= n, j <= m; i and j as x and y, or turned, but not
  /// mirrored. Points of blocks that meet have the same coordinates bit for bit.
  void add(int n, int m, const std::function<Point(int, int)>& point);
  /// The same for lines of x and y.
  void add(const std::vector<double>& x, const std::vector<double>& y);

  /// Points sorted by x and y, so that the sections of two regions number their common outline in the same order.
  /// Edges of the outline get the name that `name` gives for their ends. `mirror`: a line y = mirror along edges; where
  /// points lie alike on both sides of it, cells are cut alike too, as are the prisms that are made of them.
  Section finish(const std::function<std::string(const Point&, const Point&)>& name,
                 std::optional<double> mirror = {}) const;

 private:
  std::map<Point, Index> number_;
  std::vector<std::array<Point, 4>> cells_;
};

}  // namespace tunica::mesh::section
