#include "tunica/bc/face_shape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "tunica/base/error.hpp"

namespace tunica::bc {

namespace {

constexpr double planar_enough = 0.99, out_of_plane_limit = 0.05, normal_exists = 0.1;

std::string place(const Vec3<double>& x) { return fmt::format("({:.6g}, {:.6g}, {:.6g}) m", x[0], x[1], x[2]); }

}  // namespace

FaceShape face_shape(const FaceMesh& face) {
  FaceShape shape;
  for (const auto& t : face.triangles) {
    const auto &a = face.points[t[0]], &b = face.points[t[1]], &c = face.points[t[2]];
    const Vec3<double> area_vector = 0.5 * cross(b - a, c - a);
    const double area = norm(area_vector);
    shape.area += area;
    shape.area_vector = shape.area_vector + area_vector;
    shape.centroid = shape.centroid + (area / 3.0) * (a + b + c);
  }
  if (!(shape.area > 0.0) || !std::isfinite(shape.area))
    throw InputError("face " + face.name,
                     fmt::format("{} triangles with a total area of {} m^2", face.triangles.size(), shape.area),
                     "check the face in the mesh file and the declared length unit");
  shape.centroid = (1.0 / shape.area) * shape.centroid;
  const double projected = norm(shape.area_vector);
  shape.planarity = projected / shape.area;
  if (projected <= 1e-12 * shape.area) return shape;  // closed: no normal
  shape.normal = (1.0 / projected) * shape.area_vector;
  double farthest = 0.0;
  for (const auto& t : face.triangles)
    for (const auto node : t)
      farthest = std::max(farthest, std::abs(dot(face.points[node] - shape.centroid, shape.normal)));
  shape.out_of_plane = farthest / std::sqrt(shape.area / std::numbers::pi);
  return shape;
}

std::optional<std::string> planarity_warning(const std::string& name, const FaceShape& shape) {
  if (shape.planarity >= planar_enough && shape.out_of_plane <= out_of_plane_limit) return std::nullopt;
  return fmt::format(
      "face {} is not planar: projected over true area {:.3f} (>= {} expected), nodes up to {:.1f} % of its radius off "
      "the mean plane (<= {:.0f} % expected); its mean normal is ({:.3f}, {:.3f}, {:.3f})",
      name, shape.planarity, planar_enough, 100 * shape.out_of_plane, 100 * out_of_plane_limit, shape.normal[0],
      shape.normal[1], shape.normal[2]);
}

Vec3<double> mean_normal(const std::string& name, const FaceShape& shape) {
  if (shape.planarity < normal_exists)
    throw InputError("face " + name,
                     fmt::format("it has no meaningful mean normal: projected over true area is {:.3g} (>= {} needed)",
                                 shape.planarity, normal_exists),
                     "use a condition that needs no normal, or split the face");
  return shape.normal;
}

std::vector<bool> rim_nodes(const FaceMesh& face, const SymmetryMarks& symmetry) {
  struct Edge {
    int forward = 0, backward = 0;  // triangles that run through it from the lower to the higher node, and back
  };
  std::map<std::pair<std::int32_t, std::int32_t>, Edge> edges;
  for (const auto& t : face.triangles)
    for (int k = 0; k < 3; ++k) {
      const auto a = t[k], b = t[(k + 1) % 3];
      auto& edge = edges[std::minmax(a, b)];
      ++(a < b ? edge.forward : edge.backward);
    }
  const auto on_symmetry = [&](std::int32_t a, std::int32_t b) {
    return std::any_of(symmetry.begin(), symmetry.end(), [&](const auto& on) { return on[a] && on[b]; });
  };
  std::vector<bool> rim(face.points.size(), false);
  for (const auto& [nodes, edge] : edges) {
    if (edge.forward + edge.backward > 2)
      throw InputError("face " + face.name,
                       fmt::format("{} triangles share the edge from {}", edge.forward + edge.backward,
                                   place(face.points[nodes.first])),
                       "remove repeated triangles or the fold from the face in the mesh");
    if (edge.forward > 1 || edge.backward > 1)
      throw InputError("face " + face.name,
                       "neighbouring triangles are oriented against each other at " + place(face.points[nodes.first]),
                       "orient all triangles of the face outward");
    if (edge.forward + edge.backward == 1 && !on_symmetry(nodes.first, nodes.second))
      rim[nodes.first] = rim[nodes.second] = true;
  }
  for (std::size_t t = 0; t < face.edges.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const auto a = face.triangles[t][k], b = face.triangles[t][(k + 1) % 3];
      const auto& edge = edges.at(std::minmax(a, b));
      if (edge.forward + edge.backward == 1 && !on_symmetry(a, b)) rim[face.edges[t][k]] = true;
    }
  return rim;
}

}  // namespace tunica::bc
