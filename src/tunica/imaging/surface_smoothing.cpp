#include "tunica/imaging/surface_smoothing.hpp"

#include <algorithm>
#include <cmath>

#include "tunica/geometry/self_intersections.hpp"

namespace tunica::imaging {

namespace {

using geometry::Point;

/// Moves points by a share of the way to the middle of their neighbours.
class Neighbourhood {
 public:
  explicit Neighbourhood(const geometry::TriangleSurface& surface) : share_(surface.points.size(), 0) {
    for (const auto& edge : geometry::edges(surface)) {
      edges_.emplace_back(edge.a, edge.b);
      ++share_[edge.a];
      ++share_[edge.b];
    }
    for (auto& s : share_) s = 1 / s;
    way_.resize(share_.size());
  }

  void move(double factor, std::vector<Point>& points) {
    std::fill(way_.begin(), way_.end(), Vec3<double>{{0, 0, 0}});
    for (const auto& [a, b] : edges_) {
      const auto across = points[b] - points[a];
      way_[a] = way_[a] + across;
      way_[b] = way_[b] - across;
    }
    for (std::size_t p = 0; p < points.size(); ++p) points[p] = points[p] + (factor * share_[p]) * way_[p];
  }

  /// 2 G - G G of the points, G being `sweeps` half ways to the middle.
  std::vector<Point> passed(const std::vector<Point>& points, int sweeps) {
    auto once = points;
    for (int i = 0; i < sweeps; ++i) move(0.5, once);
    auto twice = once;
    for (int i = 0; i < sweeps; ++i) move(0.5, twice);
    for (std::size_t p = 0; p < once.size(); ++p) once[p] = 2.0 * once[p] - twice[p];
    return once;
  }

  /// Marks the points beside marked ones too.
  void widen(std::vector<bool>& marked) const {
    const auto before = marked;
    for (const auto& [a, b] : edges_)
      if (before[a] || before[b]) marked[a] = marked[b] = true;
  }

 private:
  std::vector<std::pair<std::int64_t, std::int64_t>> edges_;
  std::vector<double> share_;
  std::vector<Vec3<double>> way_;
};

using Pairs = std::vector<std::pair<std::int64_t, std::int64_t>>;

/// Triangles that face away from each other with less than `gap` between them: they cross when both move by half of it.
Pairs too_close(const geometry::TriangleSurface& surface, double gap, const std::vector<bool>& moved) {
  constexpr double opposite = -0.3;
  auto wider = surface;
  const auto normals = geometry::point_normals(surface);
  for (std::size_t p = 0; p < normals.size(); ++p) wider.points[p] = wider.points[p] + (0.5 * gap) * normals[p];
  Pairs result;
  for (const auto& pair : geometry::crossing_triangles(wider, moved)) {
    const auto a = geometry::area_vector(surface, surface.triangles[pair.first]);
    const auto b = geometry::area_vector(surface, surface.triangles[pair.second]);
    if (dot(a, b) < opposite * norm(a) * norm(b)) result.push_back(pair);
  }
  return result;
}

}  // namespace

void smooth_surface(geometry::TriangleSurface& surface, int sweeps) {
  constexpr double towards = 0.5, away = -0.52;  // pass band of (9.3): 1/0.5 - 1/0.52 = 0.077
  Neighbourhood near(surface);
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    near.move(towards, surface.points);
    near.move(away, surface.points);
  }
}

double roughness(const geometry::TriangleSurface& surface) {
  constexpr int sweeps = 20;
  constexpr double deviation_of_median = 1.4826;  // of a normal distribution
  const auto passed = Neighbourhood(surface).passed(surface.points, sweeps);
  const auto normals = geometry::point_normals(surface);
  std::vector<double> off;
  for (std::size_t p = 0; p < passed.size(); ++p)
    off.push_back(std::abs(dot(surface.points[p] - passed[p], normals[p])));
  if (off.empty()) return 0;
  const auto half = off.begin() + std::ssize(off) / 2;
  std::nth_element(off.begin(), half, off.end());
  return deviation_of_median * *half;
}

void smooth_rough_surface(geometry::TriangleSurface& surface, double farthest) {
  constexpr int sweeps = 40;
  const auto passed = Neighbourhood(surface).passed(surface.points, sweeps);
  for (std::size_t p = 0; p < passed.size(); ++p) {
    const auto way = passed[p] - surface.points[p];
    surface.points[p] = surface.points[p] + std::min(1.0, farthest / std::max(norm(way), 1e-300)) * way;
  }
}

std::int64_t untangle(geometry::TriangleSurface& surface, std::span<const Point> before, double gap) {
  constexpr int rounds = 12;
  constexpr double step = 0.25;
  const Neighbourhood near(surface);
  const auto smooth = surface.points;
  std::vector<double> back(smooth.size(), 0);
  std::vector<bool> moved;  // triangles, since the round before; at first all
  for (int round = 0; round < rounds; ++round) {
    auto pairs = geometry::crossing_triangles(surface, moved);
    const auto close = too_close(surface, gap, moved);
    pairs.insert(pairs.end(), close.begin(), close.end());
    if (pairs.empty()) break;
    std::vector<bool> marked(smooth.size(), false);
    for (const auto& pair : pairs)
      for (const auto t : {pair.first, pair.second})
        for (const auto p : surface.triangles[t]) marked[p] = true;
    for (int ring = 0; ring <= 1 + round / 3; ++ring) near.widen(marked);
    for (std::size_t p = 0; p < smooth.size(); ++p) {
      if (!marked[p]) continue;
      back[p] = std::min(1.0, back[p] + step);
      surface.points[p] = (1 - back[p]) * smooth[p] + back[p] * before[p];
    }
    near.widen(marked);  // whose normals have turned
    moved.assign(surface.triangles.size(), false);
    for (std::size_t t = 0; t < moved.size(); ++t)
      for (const auto p : surface.triangles[t]) moved[t] = moved[t] || marked[p];
  }
  return std::ssize(back) - std::count(back.begin(), back.end(), 0.0);
}

}  // namespace tunica::imaging
