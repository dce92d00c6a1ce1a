#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "tunica/geometry/remesh.hpp"

namespace tunica::geometry {

std::vector<Segment> find_creases(const TriangleSurface& surface) {
  const double sharp = std::cos(50 * M_PI / 180);
  struct Sharp {
    double cosine;
    Segment edge;
  };
  std::vector<Sharp> found;
  for (const auto& edge : edges(surface)) {
    if (edge.triangles.size() != 2) continue;
    const auto n = area_vector(surface, surface.triangles[edge.triangles[0]]);
    const auto m = area_vector(surface, surface.triangles[edge.triangles[1]]);
    if (const double size = norm(n) * norm(m); dot(n, m) < sharp * size)
      found.push_back({dot(n, m) / size, {edge.a, edge.b}});
  }
  // Lines do not branch: of the edges at a point the two sharpest stay, so that a narrow crest becomes one line.
  std::sort(found.begin(), found.end(), [](const Sharp& a, const Sharp& b) { return a.cosine < b.cosine; });
  std::vector<Segment> all;
  std::map<std::int64_t, int> used;
  for (const auto& [cosine, edge] : found) {
    if (used[edge[0]] == 2 || used[edge[1]] == 2) continue;
    ++used[edge[0]];
    ++used[edge[1]];
    all.push_back(edge);
  }
  std::vector<std::int64_t> group(surface.points.size());
  std::iota(group.begin(), group.end(), 0);
  const auto root = [&](std::int64_t p) {
    while (group[p] != p) p = group[p] = group[group[p]];
    return p;
  };
  for (const auto& [a, b] : all) group[root(a)] = root(b);
  std::map<std::int64_t, int> members;
  for (const auto& [a, b] : all) ++members[root(a)];
  std::erase_if(all, [&](const Segment& s) { return members[root(s[0])] < 3; });
  return all;
}

}  // namespace tunica::geometry
