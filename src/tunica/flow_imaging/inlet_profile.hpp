// Measured velocities as the condition of an opening: three components at the nodes of its mesh, in time.
#pragma once

#include <filesystem>
#include <vector>

#include "tunica/bc/face_shape.hpp"
#include "tunica/flow_imaging/flow_curves.hpp"

namespace tunica::flow_imaging {

/// An opening with nodes numbered from 0; those on edges follow the corners where elements are quadratic.
struct OpeningMesh {
  std::string name;
  std::vector<Vec3<double>> points;
  std::vector<bc::Triangle> triangles, edges;

  bc::FaceMesh face() const { return {name, points, triangles, edges}; }
  /// Flow of the interpolated velocities of the nodes along the outward normals [m^3/s].
  double outflow(std::span<const Vec3<double>> velocities) const;
};
OpeningMesh opening_mesh(const mesh::MeshData& data, const mesh::FaceData& face);

/// Vectors at the nodes of a face over the beat.
struct NodalCourse {
  std::vector<double> times;                      ///< within one period, ascending from 0 [s]
  double period = 0;                              ///< s
  std::vector<std::vector<Vec3<double>>> values;  ///< [time][node]: velocities [m/s], displacements [m]
};

/// The fitted profile at the nodes, zero on the rim. Its flow at each frame is made that of `outflow` [m^3/s] by a
/// share of the profile of steady flow in the opening, which leaves the rim as it is.
NodalCourse profile_at_nodes(const VelocitySeries& series, const ProfileFit& fit, const OpeningMesh& opening,
                             std::span<const double> outflow);

/// The same course at `count` equal times by periodic cubic splines through the times that it has, at least three.
NodalCourse resampled(const NodalCourse& course, std::size_t count);

/// Writes a table with the columns t, x, y, z and those of `components`, in SI units: "vx,vy,vz" for
/// `profile: {table: ..., period: ..., interpolation: nearest}`, "ux,uy,uz" for `over_face` of a `displacement`.
void write_nodal_table(std::span<const Vec3<double>> points, const NodalCourse& course, const char* components,
                       const std::filesystem::path& file);

}  // namespace tunica::flow_imaging
