#include "tunica/mesh/section.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include "tunica/base/error.hpp"

namespace tunica::mesh::section {

namespace {

double cosine_at(const Section& s, Index corner, Index a, Index b) {
  const double ax = s.points[a][0] - s.points[corner][0], ay = s.points[a][1] - s.points[corner][1];
  const double bx = s.points[b][0] - s.points[corner][0], by = s.points[b][1] - s.points[corner][1];
  return (ax * bx + ay * by) / (std::hypot(ax, ay) * std::hypot(bx, by));
}

}  // namespace

void require_size(bool good, const char* where, const char* what) {
  if (!good) throw InputError(where, what, "correct the sizes of the generated mesh");
}

void add_cut(Section& s, Index a, Index b, Index c, Index d) {
  s.triangles.push_back({a, b, c});
  s.triangles.push_back({a, c, d});
}

void add_quadrilateral(Section& s, Index a, Index b, Index c, Index d) {
  const double at_ac = std::acos(cosine_at(s, a, b, d)) + std::acos(cosine_at(s, c, b, d));
  if (at_ac >= std::numbers::pi - 1e-9)
    add_cut(s, a, b, c, d);
  else
    add_cut(s, b, c, d, a);
}

void extrude(MeshData& mesh, const Section& section, double length, int layers, const std::string& name,
             RegionKind kind, const std::string& low, const std::string& high) {
  const Index base = std::ssize(mesh.points), n = std::ssize(section.points), first = std::ssize(mesh.tetrahedra);
  const auto region = static_cast<std::int32_t>(mesh.regions.size());
  for (int k = 0; k <= layers; ++k)
    for (const auto& p : section.points) mesh.points.push_back({{p[0], p[1], length * k / layers}});
  mesh.tetrahedra.reserve(first + 3 * layers * section.triangles.size());
  for (int k = 0; k < layers; ++k)
    for (auto t : section.triangles) {
      // Rotate the smallest node to the front; an odd permutation remains when the other two descend.
      while (t[0] > t[1] || t[0] > t[2]) t = {t[1], t[2], t[0]};
      const bool odd = t[1] > t[2];
      if (odd) std::swap(t[1], t[2]);
      const Index a = base + k * n + t[0], b = base + k * n + t[1], c = base + k * n + t[2];
      for (std::array<Index, 4> e :
           {std::array{a, b, c, c + n}, std::array{a, b, c + n, b + n}, std::array{a, b + n, c + n, a + n}}) {
        if (odd) std::swap(e[2], e[3]);
        mesh.tetrahedra.push_back(e);
      }
    }
  mesh.regions.push_back({name, kind, first, std::ssize(mesh.tetrahedra)});
  FaceData bottom{low, region, {}}, top{high, region, {}};
  for (const auto& t : section.triangles) {
    bottom.triangles.push_back({base + t[0], base + t[2], base + t[1]});
    const Index up = base + layers * n;
    top.triangles.push_back({up + t[0], up + t[1], up + t[2]});
  }
  mesh.faces.push_back(std::move(bottom));
  mesh.faces.push_back(std::move(top));
  for (const auto& [side_name, edges] : section.boundary) {
    FaceData side{side_name, region, {}};
    for (int k = 0; k < layers; ++k)
      for (const auto& [from, to] : edges) {
        const Index a = base + k * n + from, b = base + k * n + to;
        // The cut runs from the lower node of smaller number to the upper node of larger number.
        if (from < to) {
          side.triangles.push_back({a, b, b + n});
          side.triangles.push_back({a, b + n, a + n});
        } else {
          side.triangles.push_back({a, b, a + n});
          side.triangles.push_back({b, b + n, a + n});
        }
      }
    mesh.faces.push_back(std::move(side));
  }
}

}  // namespace tunica::mesh::section
