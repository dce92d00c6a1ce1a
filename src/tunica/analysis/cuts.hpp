// Surfaces inside the lumen on which a piecewise linear function has one value, cut once in the reference mesh into
// triangles whose corners are weights of mesh nodes: they move with the mesh, and any nodal field can be taken on them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tunica/base/tensor.hpp"

namespace tunica::analysis {

using Element = std::array<std::int64_t, 4>;
using Barycentric = std::array<double, 4>;  ///< coordinates in an element; they add up to one

/// Values of a nodal field at the corners of an element.
inline std::array<double, 4> values_at(const std::vector<double>& field, const Element& nodes) {
  std::array<double, 4> values;
  for (int a = 0; a < 4; ++a) values[a] = field[static_cast<std::size_t>(nodes[a])];
  return values;
}

/// Corners in order of a flat piece within an element.
using Polygon = std::vector<Barycentric>;

/// Where the linear function with these values at the corners has the value `level`: a triangle, a quadrangle, or
/// nothing. A corner with just that value counts as below.
Polygon cut_element(const std::array<double, 4>& values, double level);

/// The part of a polygon on which the function is positive, or the part on which it is not.
Polygon clip(const Polygon& polygon, const std::array<double, 4>& values, bool positive);

/// Share of the element's volume on which the function is negative. Affine motion does not change it.
double negative_share(const std::array<double, 4>& values);

struct CutTriangle {
  Element nodes;
  std::array<Barycentric, 3> corners;
};

/// The polygon in triangles, turned so that their normals point to where the function with `values` rises; `points`:
/// of the mesh [m].
void append_triangles(const Polygon& polygon, const Element& nodes, const std::array<double, 4>& values,
                      const std::vector<Vec3<double>>& points, std::vector<CutTriangle>& triangles);

/// Groups `elements` that hang together across faces of tetrahedra. Returns the number of the group of each; groups
/// are numbered from 0 in the order of their first elements.
std::vector<int> connected_groups(std::span<const Element> elements);

/// What passes through a surface and what acts on it at one instant.
struct SurfaceFigures {
  Vec3<double> area{{0, 0, 0}};  ///< sum of the triangles' area vectors [m^2]
  double size = 0;               ///< sum of their areas [m^2]
  double flow = 0;               ///< volume flow along the normals relative to the moving surface [m^3/s]
  double mean_pressure = 0;      ///< [Pa]
  Vec3<double> centre{{0, 0, 0}};
};

/// Nodal fields in the order of MeshData, [node][3] and [node]; empty ones are zero.
struct NodalFields {
  const std::vector<Vec3<double>>* points = nullptr;  ///< reference [m]
  std::span<const double> displacement{}, velocity{}, mesh_velocity{}, pressure{};
};
SurfaceFigures evaluate(std::span<const CutTriangle> surface, const NodalFields& fields);

/// Position of a point of an element that moves with its nodes [m].
Vec3<double> position(const Element& nodes, const Barycentric& at, const NodalFields& fields);

}  // namespace tunica::analysis
