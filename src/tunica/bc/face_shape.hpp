// Geometry of a triangulated face: area, mean normal, how far from planar, its rim.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tunica/base/tensor.hpp"

namespace tunica::bc {

using Triangle = std::array<std::int32_t, 3>;  ///< local nodes, counter-clockwise seen from outside the region

/// A whole face (all ranks' triangles), nodes numbered from 0.
struct FaceMesh {
  std::string name;                      ///< for messages
  std::span<const Vec3<double>> points;  ///< m
  std::span<const Triangle> triangles;
  std::span<const Triangle> edges{};  ///< of each triangle: nodes on its edges 01 12 20; empty for linear elements
};

struct FaceShape {
  double area = 0.0;           ///< m^2, sum of the triangles
  Vec3<double> area_vector{};  ///< m^2, sum of the triangles' outward area vectors
  Vec3<double> normal{};       ///< outward unit vector along area_vector; zero where that vanishes (closed surface)
  Vec3<double> centroid{};     ///< m
  double planarity = 0.0;      ///< |area_vector| / area: 1 for a plane, 0 for a closed surface
  double out_of_plane = 0.0;   ///< largest distance of a node from the mean plane over sqrt(area / pi)
};

/// Throws InputError for a face without triangles or with zero area.
FaceShape face_shape(const FaceMesh& face);

/// Text to show when a condition that needs one normal (`fixed: normal`, a flow profile) sits on a face that is far
/// from planar (planarity < 0.99 or nodes further than 5 % of the equivalent radius from the mean plane), else none.
std::optional<std::string> planarity_warning(const std::string& name, const FaceShape& shape);

/// Unit normal for a condition that needs one. Throws InputError where none exists (planarity < 0.1: a tube's side).
Vec3<double> mean_normal(const std::string& name, const FaceShape& shape);

/// For each plane of symmetry that a face meets and each of its nodes: does the node lie on that plane?
using SymmetryMarks = std::vector<std::vector<char>>;

/// For each node: does it lie on the rim (an edge that belongs to one triangle)? Edges on a plane of symmetry are no
/// rim: the opening goes on behind it. Throws InputError when an edge belongs to more than two triangles or two
/// neighbours are oriented against each other.
std::vector<bool> rim_nodes(const FaceMesh& face, const SymmetryMarks& symmetry = {});

/// How far from planar a face may be that a condition takes for a plane: distance from the mean plane over the radius
/// of a circle of its area.
inline constexpr double plane_tolerance = 1e-4;

}  // namespace tunica::bc
