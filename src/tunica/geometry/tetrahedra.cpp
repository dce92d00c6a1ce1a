#include "tunica/geometry/tetrahedra.hpp"

#include <algorithm>

#include "tunica/mesh/boundary.hpp"

namespace tunica::geometry {

namespace {

struct Side {
  std::array<Index, 3> sorted;
  Index element;
  int face;
};

/// The faces of all elements, equal ones next to each other.
std::vector<Side> sorted_sides(const Tetrahedra& mesh) {
  std::vector<Side> sides;
  sides.reserve(4 * mesh.elements.size());
  for (Index e = 0; e < std::ssize(mesh.elements); ++e)
    for (int f = 0; f < 4; ++f) {
      Side side{face_nodes(mesh, e, f), e, f};
      std::sort(side.sorted.begin(), side.sorted.end());
      sides.push_back(side);
    }
  std::sort(sides.begin(), sides.end(), [&](const Side& a, const Side& b) {
    return a.sorted != b.sorted ? a.sorted < b.sorted : mesh.labels[a.element] < mesh.labels[b.element];
  });
  return sides;
}

}  // namespace

std::array<Index, 3> face_nodes(const Tetrahedra& mesh, Index element, int face) {
  const auto& t = mesh.elements[element];
  const auto& f = mesh::tetrahedron_faces[face];
  return {t[f[0]], t[f[1]], t[f[2]]};
}

std::vector<LabelledTriangle> surface_triangles(const Tetrahedra& mesh) {
  const auto sides = sorted_sides(mesh);
  std::vector<LabelledTriangle> triangles;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const auto& a = sides[i];
    const int label = mesh.labels[a.element];
    if (i + 1 < sides.size() && sides[i + 1].sorted == a.sorted) {
      const Index other = sides[++i].element;
      if (mesh.labels[other] != label)
        triangles.push_back({face_nodes(mesh, a.element, a.face), a.element, other, label, mesh.labels[other]});
    } else {
      triangles.push_back({face_nodes(mesh, a.element, a.face), a.element, -1, label, outside_label});
    }
  }
  return triangles;
}

std::vector<std::array<Index, 4>> neighbours(const Tetrahedra& mesh) {
  const auto sides = sorted_sides(mesh);
  std::vector<std::array<Index, 4>> result(mesh.elements.size(), {-1, -1, -1, -1});
  for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
    const auto &a = sides[i], &b = sides[i + 1];
    if (a.sorted != b.sorted) continue;
    result[a.element][a.face] = b.element;
    result[b.element][b.face] = a.element;
  }
  return result;
}

}  // namespace tunica::geometry
