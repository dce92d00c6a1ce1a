// A square duct of 1 mm cells for tests: wall one cell thick around a lumen, which a flap of one cell divides into a
// true lumen (small x) and a false one (large x), closed at both ends and joined to the true one by one hole.
#pragma once

#include <map>
#include <string>
#include <utility>

#include "tunica/geometry/openings.hpp"
#include "tunica/geometry/tetrahedra.hpp"
#include "tunica/mesh/generate.hpp"
#include "tunica/meshing/surface_complex.hpp"

namespace tunica::meshing::test {

struct BlockVessel {
  int across = 9, along = 24;          ///< cells
  int flap_at = 4, from = 6, to = 18;  ///< cell of the flap in x, and its extent in z
  bool hole = true;
};

/// Labels by the cell that the centroid lies in.
inline int block_label(const BlockVessel& v, int i, int j, int k) {
  if (i == 0 || j == 0 || i == v.across - 1 || j == v.across - 1) return geometry::wall_label;
  if (k < v.from || k >= v.to || i < v.flap_at) return geometry::lumen_label;
  const bool hole = v.hole && k >= 8 && k < 10 && j >= 4 && j < 6;
  if (i == v.flap_at) return hole ? geometry::lumen_label : geometry::wall_label;
  return k == v.from || k == v.to - 1 ? geometry::wall_label : geometry::lumen_label;
}

inline geometry::Tetrahedra block_vessel(const BlockVessel& v) {
  const double h = 1e-3;
  const auto box =
      mesh::box(v.across, v.across, v.along, {{v.across * h, v.across * h, v.along * h}}, mesh::RegionKind::wall);
  geometry::Tetrahedra mesh;
  mesh.points = box.points;
  mesh.elements = box.tetrahedra;
  for (const auto& t : mesh.elements) {
    geometry::Point c{{0, 0, 0}};
    for (const auto n : t) c = c + 0.25 * mesh.points[n];
    mesh.labels.push_back(
        block_label(v, static_cast<int>(c[0] / h), static_cast<int>(c[1] / h), static_cast<int>(c[2] / h)));
  }
  mesh.on_curve.assign(mesh.points.size(), false);
  return mesh;
}

/// The two ends; `outer_radius` covers the corners of the square.
inline std::vector<geometry::Opening> block_openings(const BlockVessel& v) {
  const double middle = v.across * 0.5e-3, radius = v.across * 0.72e-3;
  return {{"inlet", {{middle, middle, 0}}, {{0, 0, -1}}, 0, radius, {}, {}, 0},
          {"outlet", {{middle, middle, v.along * 1e-3}}, {{0, 0, 1}}, 0, radius, {}, {}, 0}};
}

/// The surfaces of a mesh as a complex to be filled: one patch for each pair of labels that meet.
inline SurfaceComplex complex_of(const geometry::Tetrahedra& mesh) {
  SurfaceComplex complex{mesh.points, {}, {}, {}, {}};
  std::map<std::pair<int, int>, std::int32_t> number;
  for (const auto& t : geometry::surface_triangles(mesh)) {
    const auto [patch, is_new] = number.emplace(std::pair(t.label, t.neighbour_label), std::ssize(complex.patches));
    if (is_new)
      complex.patches.push_back({"patch_" + std::to_string(patch->second),
                                 t.neighbour_label == geometry::wall_label ? PatchKind::interface
                                 : t.label == geometry::lumen_label        ? PatchKind::lumen_cap
                                                                           : PatchKind::outer_wall,
                                 static_cast<Label>(t.label), static_cast<Label>(t.neighbour_label)});
    complex.triangles.push_back(t.nodes);
    complex.patch_of.push_back(patch->second);
  }
  geometry::TriangleSurface used{complex.points, complex.triangles};
  geometry::drop_unused_points(used);
  complex.points = used.points;
  complex.triangles = used.triangles;
  return complex;
}

inline double volume(const geometry::Tetrahedra& mesh, int label) {
  double sum = 0;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    if (mesh.labels[e] != label) continue;
    const auto& t = mesh.elements[e];
    const geometry::Point& a = mesh.points[t[0]];
    sum += dot(mesh.points[t[1]] - a, cross(mesh.points[t[2]] - a, mesh.points[t[3]] - a)) / 6;
  }
  return sum;
}

}  // namespace tunica::meshing::test
