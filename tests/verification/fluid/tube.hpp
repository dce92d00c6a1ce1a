// Straight rigid tubes with chosen radial spacing, and what is measured on their cross-sections.
#pragma once

#include <algorithm>

#include "flow_case.hpp"

namespace tunica::verification {

/// The generated tube with its radii moved by `grade`, a map of [0, 1] that multiplies the radius.
inline mesh::MeshData graded_tube(const mesh::TubeSizes& sizes, const std::function<double(double)>& grade) {
  auto data = mesh::tube(sizes);
  for (auto& x : data.points) {
    const double r = std::hypot(x[0], x[1]);
    if (r == 0) continue;
    const double scale = grade(std::min(1.0, r / sizes.radius)) * sizes.radius / r;
    x[0] *= scale;
    x[1] *= scale;
  }
  return data;
}

inline double radius_of(const Vec3<double>& X) { return std::hypot(X[0], X[1]); }

/// Mean over the nodes of the cross-section at z, of entry `c` of [local node][4]. Collective.
inline double section_mean(const distributed::DistributedMesh& mesh, const std::vector<double>& field, int c,
                           double z) {
  std::vector<double> sums(2, 0.0);
  for (std::int32_t i = 0; i < mesh.owned_nodes; ++i)
    if (std::abs(mesh.points[i][2] - z) < 1e-9) {
      sums[0] += field[at(i) + c];
      sums[1] += 1;
    }
  parallel::global_sum(mesh.comm, sums);
  return sums[0] / sums[1];
}

/// Outward volume flow through a face of a mesh at rest [m^3/s]. Collective.
inline double face_flow(const distributed::DistributedMesh& mesh, const std::string& name, const double* velocity) {
  const auto& face = mesh.face(name);
  double flow = 0;
  for (std::int32_t t = 0; t < face.owned_triangles; ++t) {
    const auto& n = face.triangles[t];
    const Vec3<double> area = 0.5 * cross(mesh.points[n[1]] - mesh.points[n[0]], mesh.points[n[2]] - mesh.points[n[0]]);
    for (const auto node : n)
      for (int c = 0; c < 3; ++c) flow += area[c] * velocity[at(node) + c] / 3.0;
  }
  return parallel::global_sum(mesh.comm, flow);
}

/// Mean pressure of a face of a mesh at rest [Pa]. Collective.
inline double face_pressure(const distributed::DistributedMesh& mesh, const std::string& name, const double* values) {
  const auto& face = mesh.face(name);
  std::vector<double> sums(2, 0.0);
  for (std::int32_t t = 0; t < face.owned_triangles; ++t) {
    const auto& n = face.triangles[t];
    const double area = 0.5 * norm(cross(mesh.points[n[1]] - mesh.points[n[0]], mesh.points[n[2]] - mesh.points[n[0]]));
    sums[1] += area;
    for (const auto node : n) sums[0] += area * values[at(node) + 3] / 3.0;
  }
  parallel::global_sum(mesh.comm, sums);
  return sums[0] / sums[1];
}

}  // namespace tunica::verification
