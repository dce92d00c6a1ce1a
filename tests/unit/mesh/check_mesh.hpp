// Checks that every mesh must pass, shared by the tests of this folder.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "tunica/fe/tetrahedron.hpp"
#include "tunica/mesh/boundary.hpp"
#include "tunica/mesh/mesh_data.hpp"

namespace tunica::mesh::testing {

inline double volume(const MeshData& mesh, std::int64_t element) {
  Vec3<double> x[4];
  for (int a = 0; a < 4; ++a) x[a] = mesh.points[mesh.tetrahedra[element][a]];
  return fe::gradients(x).volume;
}

inline double volume(const MeshData& mesh, const RegionData& region) {
  double sum = 0;
  for (auto e = region.first_element; e < region.end_element; ++e) sum += volume(mesh, e);
  return sum;
}

inline Vec3<double> area_vector(const MeshData& mesh, const std::array<std::int64_t, 3>& t) {
  const auto& p = mesh.points[t[0]];
  return 0.5 * cross(mesh.points[t[1]] - p, mesh.points[t[2]] - p);
}

inline const FaceData& face(const MeshData& mesh, const std::string& name) {
  for (const auto& f : mesh.faces)
    if (f.name == name) return f;
  throw std::runtime_error("no face " + name);
}

inline double area(const MeshData& mesh, const std::string& name) {
  double sum = 0;
  for (const auto& t : face(mesh, name).triangles) sum += norm(area_vector(mesh, t));
  return sum;
}

/// Positive elements, and a boundary that is closed, outward and covered exactly once by the faces as they stand.
inline void expect_sound(const MeshData& mesh) {
  double smallest = 1;
  for (std::int64_t e = 0; e < std::ssize(mesh.tetrahedra); ++e) smallest = std::min(smallest, volume(mesh, e));
  EXPECT_GT(smallest, 0.0);
  const Boundary boundary(mesh.tetrahedra, std::ssize(mesh.points), "test mesh");
  auto oriented = mesh;
  EXPECT_NO_THROW(orient_and_check_faces(oriented, boundary, "test mesh"));
  for (const auto kind : {RegionKind::lumen, RegionKind::wall}) {  // walls may share nodes: together they are closed
    Vec3<double> closure{{0, 0, 0}};
    double enclosed = 0, total = 0, expected = 0;
    for (const auto& r : mesh.regions)
      if (r.kind == kind) expected += volume(mesh, r);
    for (const auto& f : mesh.faces)
      if (mesh.regions[f.region].kind == kind)
        for (const auto& t : f.triangles) {
          const auto a = area_vector(mesh, t);
          closure = closure + a;
          enclosed += dot(a, mesh.points[t[0]]) / 3;  // divergence theorem: only right if all point outward
          total += norm(a);
        }
    EXPECT_LE(norm(closure), 1e-12 * total);
    EXPECT_NEAR(enclosed, expected, 1e-10 * expected);
  }
}

}  // namespace tunica::mesh::testing
