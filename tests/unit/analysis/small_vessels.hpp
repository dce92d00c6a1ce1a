// Vessels whose figures are known exactly, and nodal fields on them.
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "tunica/analysis/description.hpp"
#include "tunica/mesh/boundary.hpp"
#include "tunica/mesh/generate.hpp"
#include "tunica/mesh/interface.hpp"

namespace tunica::analysis::testing {

template <class F>
std::vector<double> nodal(const mesh::MeshData& data, const F& function) {
  std::vector<double> values;
  for (const auto& x : data.points) values.push_back(function(x));
  return values;
}

/// [node][3].
template <class F>
std::vector<double> nodal_vectors(const mesh::MeshData& data, const F& function) {
  std::vector<double> values;
  for (const auto& x : data.points) {
    const Vec3<double> v = function(x);
    values.insert(values.end(), v.x, v.x + 3);
  }
  return values;
}

/// Turned by `angle` [rad] about an axis of length one through the origin (Rodrigues).
inline Vec3<double> turned(const Vec3<double>& x, const Vec3<double>& axis, double angle) {
  return std::cos(angle) * x + std::sin(angle) * cross(axis, x) + ((1 - std::cos(angle)) * dot(axis, x)) * axis;
}

/// A lumen alone, along z: a prism on the polygon whose corners lie on the circle. Its inner nodes do not lie in planes
/// across it, so that levels between them are anywhere.
inline constexpr double tube_radius = 0.01, tube_length = 0.06;
inline constexpr int tube_corners = 12;
inline mesh::MeshData tube() {
  constexpr int cells = 6;
  auto data = mesh::tube({.radius = tube_radius,
                          .length = tube_length,
                          .cells_around = tube_corners,
                          .cells_radial = 2,
                          .cells_along = cells});
  for (auto& x : data.points)
    if (x[2] > 1e-6 && x[2] < tube_length - 1e-6)
      x[2] += 0.25 * tube_length / cells * std::sin(500 * x[0] + 300 * x[1] + 900 * x[2]);
  return data;
}
inline double polygon_area() {
  return 0.5 * tube_corners * tube_radius * tube_radius * std::sin(2 * M_PI / tube_corners);
}
inline RunDescription flow_in_tube() {
  return {.fluid = true, .sticking_faces = {"lumen_wall"}, .inflow_faces = {"lumen_inlet"}};
}

/// A box along z of section 2 x 1 between two plates: that of the true lumen above y = 1, that of the false one below
/// y = 0. The lumens meet in the plane y = 1/2.
inline mesh::MeshData two_lumens() {
  const auto slab = [](const std::string& name, mesh::RegionKind kind, int layers, double from, double to) {
    mesh::LoadedMesh part{mesh::box(3, layers, 6, {{2, to - from, 4}}, kind), {}};
    for (auto& x : part.data.points) x = x + Vec3<double>{{0, from, 0}};
    part.data.regions[0].name = name;
    for (auto& face : part.data.faces) face.name = name + "_" + face.name;
    return part;
  };
  const std::array parts = {slab("lumen", mesh::RegionKind::lumen, 4, 0, 1),
                            slab("true_lumen_wall", mesh::RegionKind::wall, 1, 1, 1.25),
                            slab("false_lumen_wall", mesh::RegionKind::wall, 1, -0.5, 0)};
  const std::array<mesh::Interface, 2> interfaces = {
      {{{"lumen_y_max"}, {"true_lumen_wall_y_min"}}, {{"lumen_y_min"}, {"false_lumen_wall_y_max"}}}};
  return mesh::join(parts, interfaces, {}).data;
}
inline RunDescription flow_in_two_lumens() {
  return {.fluid = true,
          .wall = true,
          .interface = true,
          .sticking_faces = {"lumen_x_min", "lumen_x_max", "lumen_y_min", "lumen_y_max"},
          .inflow_faces = {"lumen_z_min"}};
}

/// A channel of section 1 x 1 along z, 6 long, with a branch of the same section towards x from z = 2 to 3 that ends
/// at x = 1 + `reach`. Faces: inlet, end, branch, lumen_wall.
inline mesh::MeshData channel_with_branch(int reach) {
  constexpr int n = 3;  // cells along a side of the section
  const auto whole = mesh::box(n * (1 + reach), n, 6 * n, {{1.0 + reach, 1, 6}}, mesh::RegionKind::lumen);
  mesh::MeshData data;
  std::vector<std::int64_t> number(whole.points.size(), -1);
  for (auto t : whole.tetrahedra) {
    const auto c = mesh::centroid(whole.points, t);
    if (c[0] > 1 && (c[2] < 2 || c[2] > 3)) continue;
    for (auto& node : t) {
      auto& mine = number[static_cast<std::size_t>(node)];
      if (mine < 0) {
        mine = std::ssize(data.points);
        data.points.push_back(whole.points[static_cast<std::size_t>(node)]);
      }
      node = mine;
    }
    data.tetrahedra.push_back(t);
  }
  data.regions = {{"lumen", mesh::RegionKind::lumen, 0, std::ssize(data.tetrahedra)}};
  data.faces = {{"inlet", 0, {}}, {"end", 0, {}}, {"branch", 0, {}}, {"lumen_wall", 0, {}}};
  const mesh::Boundary boundary(data.tetrahedra, std::ssize(data.points), "channel");
  for (const auto& t : boundary.triangles()) {
    const auto c = mesh::centroid(data.points, t.nodes);
    const int face = c[2] < 1e-9 ? 0 : c[2] > 6 - 1e-9 ? 1 : c[0] > 1 + reach - 1e-9 ? 2 : 3;
    data.faces[static_cast<std::size_t>(face)].triangles.push_back(t.nodes);
  }
  return data;
}
inline RunDescription flow_in_channel() {
  return {.fluid = true, .sticking_faces = {"lumen_wall"}, .inflow_faces = {"inlet"}};
}

}  // namespace tunica::analysis::testing
