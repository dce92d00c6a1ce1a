// A triangulated surface and what can be said about it without any geometry library.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tunica/base/tensor.hpp"

namespace tunica::geometry {

using Point = Vec3<double>;
using Triangle = std::array<std::int64_t, 3>;

struct TriangleSurface {
  std::vector<Point> points;        ///< m
  std::vector<Triangle> triangles;  ///< the normal of (a, b, c) is (b - a) x (c - a)
};

/// A closed chain of points along an open edge, in the order of the triangles beside it.
using Loop = std::vector<std::int64_t>;

/// An edge with the triangles that share it.
struct SurfaceEdge {
  std::int64_t a, b;                    ///< a < b
  std::vector<std::int64_t> triangles;  ///< one: open edge; more than two: not manifold
};

/// Half the cross product of two sides: its norm is the area [m^2].
Vec3<double> area_vector(const TriangleSurface& surface, const Triangle& triangle);
/// Sum of the triangle areas [m^2].
double area(const TriangleSurface& surface);
/// Volume [m^3] enclosed by a closed surface with outward normals (Gauss's theorem, from the centre of its points).
double enclosed_volume(const TriangleSurface& surface);
/// Smallest angle [rad] of a triangle; 0 where two corners coincide.
double smallest_angle(const TriangleSurface& surface, const Triangle& triangle);
/// Area-weighted unit normals of the points; zero at points without a triangle.
std::vector<Vec3<double>> point_normals(const TriangleSurface& surface);

/// All edges, sorted by their points.
std::vector<SurfaceEdge> edges(const TriangleSurface& surface);
/// Chains of open edges. Each point must lie on at most one of them (see check_surface), else a chain may pass it
/// twice.
std::vector<Loop> boundary_loops(const TriangleSurface& surface);
/// Number of the connected component (joined by edges) of each triangle, from 0.
std::vector<std::int64_t> components(const TriangleSurface& surface);
/// Genus of a manifold surface of `parts` connected ones, their sum, after its `loops` open ends are closed by discs.
std::int64_t genus(const TriangleSurface& surface, std::int64_t loops, int parts = 1);

/// Gives each point the mean of its own and its neighbours' values, `sweeps` times.
void average_over_neighbours(const TriangleSurface& surface, int sweeps, std::vector<double>& values);

/// Drops the points that no triangle uses; returns the new number of each old point, -1 for dropped ones.
std::vector<std::int64_t> drop_unused_points(TriangleSurface& surface);

/// Adds triangles and points of `part`, without merging any.
void append(TriangleSurface& surface, const TriangleSurface& part);

/// "(x, y, z) mm" of the first few places and how many more there are.
std::string list_places_mm(std::span<const Point> places);

}  // namespace tunica::geometry
