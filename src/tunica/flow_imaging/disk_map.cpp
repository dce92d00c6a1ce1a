#include "tunica/flow_imaging/disk_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "tunica/base/error.hpp"

namespace tunica::flow_imaging {

namespace {

using Triangle = std::array<std::int32_t, 3>;

/// Points of the rim in their order along the triangles.
std::vector<std::int32_t> rim_of(std::span<const Triangle> triangles, const std::string& name) {
  const auto refuse = [&](const std::string& what) {
    throw InputError(name, what, "give one flat patch of triangles without holes");
  };
  std::map<std::pair<std::int32_t, std::int32_t>, int> directed;
  for (const auto& t : triangles)
    for (std::size_t i = 0; i < 3; ++i)
      if (++directed[{t[i], t[(i + 1) % 3]}] > 1) refuse("has two triangles on one side of an edge");
  std::map<std::int32_t, std::int32_t> next;
  for (const auto& [edge, count] : directed)
    if (!directed.contains({edge.second, edge.first}) && !next.emplace(edge.first, edge.second).second)
      refuse("has a rim that touches itself");
  if (next.empty()) refuse("has no rim");
  std::vector<std::int32_t> rim;
  for (auto node = next.begin()->first; rim.empty() || node != rim.front();) {
    rim.push_back(node);
    const auto following = next.find(node);
    if (following == next.end() || rim.size() > next.size()) refuse("has a rim that does not close");
    node = following->second;
  }
  if (rim.size() != next.size()) refuse("has more than one rim");
  return rim;
}

double angle_between(const Vec3<double>& a, const Vec3<double>& b) { return std::atan2(norm(cross(a, b)), dot(a, b)); }

void place_rim(const std::vector<std::int32_t>& rim, std::span<const Vec3<double>> points, const Vec3<double>& start,
               std::vector<DiskPoint>& placed) {
  const auto at = [&](std::size_t k) { return points[static_cast<std::size_t>(rim[k % rim.size()])]; };
  Vec3<double> middle{};
  for (std::size_t k = 0; k < rim.size(); ++k) middle = middle + (1 / static_cast<double>(rim.size())) * at(k);
  std::size_t first = 0;
  std::vector<double> length(rim.size() + 1, 0.0);
  for (std::size_t k = 0; k < rim.size(); ++k)
    if (dot(start, at(k) - middle) > dot(start, at(first) - middle)) first = k;
  for (std::size_t k = 0; k < rim.size(); ++k) length[k + 1] = length[k] + norm(at(first + k + 1) - at(first + k));
  for (std::size_t k = 0; k < rim.size(); ++k) {
    const double angle = 2 * M_PI * length[k] / length.back();
    placed[static_cast<std::size_t>(rim[(first + k) % rim.size()])] = {std::cos(angle), std::sin(angle)};
  }
}

}  // namespace

std::vector<DiskPoint> disk_map(std::span<const Vec3<double>> points, std::span<const Triangle> given,
                                const Vec3<double>& normal, const Vec3<double>& start, const std::string& name) {
  std::vector<Triangle> triangles(given.begin(), given.end());
  const auto x = [&](std::int32_t n) { return points[static_cast<std::size_t>(n)]; };
  Vec3<double> area{};
  for (const auto& t : triangles) area = area + cross(x(t[1]) - x(t[0]), x(t[2]) - x(t[0]));
  if (dot(area, normal) < 0)
    for (auto& t : triangles) std::swap(t[1], t[2]);
  std::vector<DiskPoint> placed(points.size(), DiskPoint{0, 0});
  const auto rim = rim_of(triangles, name);
  place_rim(rim, points, start, placed);
  std::vector<char> fixed(points.size(), 0);
  for (const auto n : rim) fixed[static_cast<std::size_t>(n)] = 1;
  // Weight of neighbour j at i: the tangents of half the angles on both sides of the edge over its length.
  std::vector<std::map<std::int32_t, double>> weights(points.size());
  for (const auto& t : triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto a = t[i], b = t[(i + 1) % 3], c = t[(i + 2) % 3];
      const double half = std::tan(0.5 * angle_between(x(b) - x(a), x(c) - x(a)));
      for (const auto other : {b, c})
        weights[static_cast<std::size_t>(a)][other] += half / std::max(norm(x(other) - x(a)), 1e-300);
    }
  // Gauss and Seidel: some thousand points at most.
  double moved = 1;
  for (int sweep = 0; sweep < 20000 && moved > 1e-10; ++sweep) {
    moved = 0;
    for (std::size_t n = 0; n < points.size(); ++n) {
      if (fixed[n] || weights[n].empty()) continue;
      double sum = 0;
      DiskPoint next{0, 0};
      for (const auto& [other, w] : weights[n]) {
        sum += w;
        for (std::size_t d = 0; d < 2; ++d) next[d] += w * placed[static_cast<std::size_t>(other)][d];
      }
      for (std::size_t d = 0; d < 2; ++d) {
        next[d] /= sum;
        moved = std::max(moved, std::abs(next[d] - placed[n][d]));
      }
      placed[n] = next;
    }
  }
  if (moved > 1e-6)
    throw SolverError(fmt::format("{}: its map onto a disk does not settle; its triangles are too distorted", name));
  return placed;
}

DiskPlace find_in_disk(const DiskPoint& p, std::span<const DiskPoint> points, std::span<const Triangle> triangles) {
  DiskPlace best{0, {1, 0, 0}};
  double inside = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < triangles.size(); ++k) {
    const auto& t = triangles[k];
    const auto &a = points[static_cast<std::size_t>(t[0])], &b = points[static_cast<std::size_t>(t[1])],
               &c = points[static_cast<std::size_t>(t[2])];
    const double size = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    if (size == 0) continue;
    const double v = ((p[0] - a[0]) * (c[1] - a[1]) - (p[1] - a[1]) * (c[0] - a[0])) / size,
                 w = ((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])) / size;
    const std::array<double, 3> shares{1 - v - w, v, w};
    const double least = std::min({shares[0], shares[1], shares[2]});
    if (least <= inside) continue;
    inside = least;
    best = {k, shares};
    if (least >= 0) return best;
  }
  double sum = 0;
  for (auto& s : best.shares) sum += s = std::max(s, 0.0);
  for (auto& s : best.shares) s /= sum;
  return best;
}

}  // namespace tunica::flow_imaging
