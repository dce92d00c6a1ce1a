#include "tunica/geometry/triangle_surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <unordered_map>

namespace tunica::geometry {

Vec3<double> area_vector(const TriangleSurface& surface, const Triangle& t) {
  const auto& p = surface.points;
  return 0.5 * cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]);
}

double area(const TriangleSurface& surface) {
  double sum = 0;
  for (const auto& t : surface.triangles) sum += norm(area_vector(surface, t));
  return sum;
}

double enclosed_volume(const TriangleSurface& surface) {
  if (surface.points.empty()) return 0;
  // Far from the origin the terms would be large and cancel.
  Point centre{{0, 0, 0}};
  for (const auto& p : surface.points) centre = centre + (1.0 / static_cast<double>(surface.points.size())) * p;
  double sum = 0;
  for (const auto& t : surface.triangles) sum += dot(surface.points[t[0]] - centre, area_vector(surface, t));
  return sum / 3;
}

double smallest_angle(const TriangleSurface& surface, const Triangle& t) {
  double smallest = M_PI;
  for (int i = 0; i < 3; ++i) {
    const auto& corner = surface.points[t[i]];
    const auto a = surface.points[t[(i + 1) % 3]] - corner, b = surface.points[t[(i + 2) % 3]] - corner;
    smallest = std::min(smallest, std::atan2(norm(cross(a, b)), dot(a, b)));
    if (norm(a) == 0) return 0;
  }
  return smallest;
}

std::vector<Vec3<double>> point_normals(const TriangleSurface& surface) {
  std::vector<Vec3<double>> normals(surface.points.size(), {{0, 0, 0}});
  for (const auto& t : surface.triangles) {
    const auto n = area_vector(surface, t);
    for (const auto corner : t) normals[corner] = normals[corner] + n;
  }
  for (auto& n : normals)
    if (const double length = norm(n); length > 0) n = (1 / length) * n;
  return normals;
}

std::vector<SurfaceEdge> edges(const TriangleSurface& surface) {
  struct Use {
    std::int64_t a, b, triangle;
  };
  std::vector<Use> uses;
  uses.reserve(3 * surface.triangles.size());
  for (std::int64_t t = 0; t < std::ssize(surface.triangles); ++t)
    for (int i = 0; i < 3; ++i) {
      const auto a = surface.triangles[t][i], b = surface.triangles[t][(i + 1) % 3];
      uses.push_back({std::min(a, b), std::max(a, b), t});
    }
  std::sort(uses.begin(), uses.end(),
            [](const Use& x, const Use& y) { return std::tie(x.a, x.b, x.triangle) < std::tie(y.a, y.b, y.triangle); });
  std::vector<SurfaceEdge> result;
  for (const auto& use : uses) {
    if (result.empty() || result.back().a != use.a || result.back().b != use.b) result.push_back({use.a, use.b, {}});
    result.back().triangles.push_back(use.triangle);
  }
  return result;
}

std::vector<Loop> boundary_loops(const TriangleSurface& surface) {
  std::map<std::int64_t, std::int64_t> next;
  for (const auto& edge : edges(surface)) {
    if (edge.triangles.size() != 1) continue;
    const auto& t = surface.triangles[edge.triangles[0]];
    for (int i = 0; i < 3; ++i)
      if (std::minmax(t[i], t[(i + 1) % 3]) == std::minmax(edge.a, edge.b)) next[t[i]] = t[(i + 1) % 3];
  }
  std::vector<Loop> loops;
  while (!next.empty()) {
    Loop loop;
    for (auto point = next.begin()->first;;) {
      const auto step = next.find(point);
      if (step == next.end()) break;
      loop.push_back(point);
      point = step->second;
      next.erase(step);
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

std::vector<std::int64_t> components(const TriangleSurface& surface) {
  std::vector<std::int64_t> parent(surface.triangles.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](std::int64_t t) {
    while (parent[t] != t) t = parent[t] = parent[parent[t]];
    return t;
  };
  for (const auto& edge : edges(surface))
    for (const auto t : edge.triangles) parent[root(t)] = root(edge.triangles[0]);
  std::unordered_map<std::int64_t, std::int64_t> number;
  std::vector<std::int64_t> result(parent.size());
  for (std::int64_t t = 0; t < std::ssize(parent); ++t)
    result[t] = number.emplace(root(t), std::ssize(number)).first->second;
  return result;
}

std::int64_t genus(const TriangleSurface& surface, std::int64_t loops, int parts) {
  std::vector<bool> used(surface.points.size(), false);
  for (const auto& t : surface.triangles)
    for (const auto corner : t) used[corner] = true;
  const auto euler =
      std::count(used.begin(), used.end(), true) - std::ssize(edges(surface)) + std::ssize(surface.triangles) + loops;
  return (2 * parts - euler) / 2;
}

void average_over_neighbours(const TriangleSurface& surface, int sweeps, std::vector<double>& values) {
  const auto all = edges(surface);
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    auto sum = values;
    std::vector<double> count(values.size(), 1);
    for (const auto& edge : all) {
      sum[edge.a] += values[edge.b];
      sum[edge.b] += values[edge.a];
      ++count[edge.a];
      ++count[edge.b];
    }
    for (std::size_t p = 0; p < values.size(); ++p) values[p] = sum[p] / count[p];
  }
}

std::vector<std::int64_t> drop_unused_points(TriangleSurface& surface) {
  std::vector<std::int64_t> number(surface.points.size(), -1);
  for (const auto& t : surface.triangles)
    for (const auto corner : t) number[corner] = 0;
  std::int64_t kept = 0;
  for (std::int64_t p = 0; p < std::ssize(number); ++p)
    if (number[p] == 0) {
      surface.points[kept] = surface.points[p];
      number[p] = kept++;
    }
  surface.points.resize(kept);
  for (auto& t : surface.triangles)
    for (auto& corner : t) corner = number[corner];
  return number;
}

void append(TriangleSurface& surface, const TriangleSurface& part) {
  const auto shift = std::ssize(surface.points);
  surface.points.insert(surface.points.end(), part.points.begin(), part.points.end());
  for (auto t : part.triangles) {
    for (auto& corner : t) corner += shift;
    surface.triangles.push_back(t);
  }
}

std::string list_places_mm(std::span<const Point> places) {
  constexpr std::size_t shown = 3;
  std::string text;
  for (std::size_t i = 0; i < std::min(shown, places.size()); ++i)
    text += fmt::format("{}({:.2f}, {:.2f}, {:.2f}) mm", i ? ", " : "", 1e3 * places[i][0], 1e3 * places[i][1],
                        1e3 * places[i][2]);
  if (places.size() > shown) text += fmt::format(" and {} more", places.size() - shown);
  return text;
}

}  // namespace tunica::geometry
