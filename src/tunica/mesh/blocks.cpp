#include "tunica/mesh/blocks.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace tunica::mesh::section {

std::vector<double> graded(double begin, double end, int cells, double growth) {
  const double ratio = cells > 1 ? std::pow(growth, 1.0 / (cells - 1)) : 1.0;
  std::vector<double> at{0.0};
  for (int k = 0; k < cells; ++k) at.push_back(at.back() + std::pow(ratio, k));
  for (double& x : at) x = begin + (end - begin) * (x / at.back());
  at.back() = end;
  return at;
}

void Blocks::add(int n, int m, const std::function<Point(int, int)>& point) {
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < n; ++i) {
      cells_.push_back({point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)});
      for (const auto& p : cells_.back()) number_.emplace(p, 0);
    }
}

void Blocks::add(const std::vector<double>& x, const std::vector<double>& y) {
  add(static_cast<int>(x.size()) - 1, static_cast<int>(y.size()) - 1, [&](int i, int j) {
    return Point{x[static_cast<std::size_t>(i)], y[static_cast<std::size_t>(j)]};
  });
}

namespace {

/// By x, then by the distance from the mirror. What differs by rounding alone is the same.
std::vector<Point> sorted(std::vector<Point> points, double mirror) {
  const double grid = 1e-9 * std::abs(points.back()[0] - points.front()[0]);
  const auto key = [&](const Point& p) {
    return std::tuple(std::floor(p[0] / grid + 0.37), std::floor(std::abs(p[1] - mirror) / grid + 0.37), p[1]);
  };
  std::sort(points.begin(), points.end(), [&](const Point& a, const Point& b) { return key(a) < key(b); });
  return points;
}

}  // namespace

Section Blocks::finish(const std::function<std::string(const Point&, const Point&)>& name,
                       std::optional<double> mirror) const {
  Section s;
  auto number = number_;
  for (const auto& [point, index] : number) s.points.push_back(point);
  if (mirror) s.points = sorted(std::move(s.points), *mirror);
  for (Index i = 0; i < std::ssize(s.points); ++i) number.at(s.points[static_cast<std::size_t>(i)]) = i;
  std::map<std::array<Index, 2>, int> edges;  // directed, cells to their left
  for (const auto& cell : cells_) {
    std::array<Index, 4> n{};
    for (std::size_t k = 0; k < 4; ++k) n[k] = number.at(cell[k]);
    std::rotate(n.begin(), std::min_element(n.begin(), n.end()), n.end());  // that is where a tie is cut
    add_quadrilateral(s, n[0], n[1], n[2], n[3]);
    for (std::size_t k = 0; k < 4; ++k) edges[{n[k], n[(k + 1) % 4]}] = 1;
  }
  std::map<std::string, Edges> outline;
  for (const auto& [edge, one] : edges) {
    if (edges.contains({edge[1], edge[0]})) continue;
    const auto face = name(s.points[static_cast<std::size_t>(edge[0])], s.points[static_cast<std::size_t>(edge[1])]);
    auto& list = outline.emplace(face, Edges{face, {}}).first->second;
    list.edges.push_back(edge);
  }
  for (auto& [face, list] : outline) s.boundary.push_back(std::move(list));
  return s;
}

}  // namespace tunica::mesh::section
