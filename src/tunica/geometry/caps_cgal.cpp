#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <map>
#include <tuple>

#include "tunica/base/error.hpp"
#include "tunica/geometry/caps.hpp"
#include "tunica/geometry/remesh.hpp"

namespace tunica::geometry {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::int64_t, Kernel>;
using FaceBase =
    CGAL::Constrained_triangulation_face_base_2<Kernel, CGAL::Triangulation_face_base_with_info_2<int, Kernel>>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>,
                                               CGAL::No_constraint_intersection_tag>;

/// Number of constraints between a face and infinity, as its info.
void count_constraints(Triangulation& triangulation) {
  for (const auto face : triangulation.all_face_handles()) face->info() = -1;
  std::vector<std::pair<Triangulation::Face_handle, int>> stack{{triangulation.infinite_face(), 0}}, next;
  for (int level = 0; !stack.empty(); ++level) {
    while (!stack.empty()) {
      const auto face = stack.back().first;
      stack.pop_back();
      if (face->info() >= 0) continue;
      face->info() = level;
      for (int i = 0; i < 3; ++i)
        if (face->neighbor(i)->info() < 0)
          (face->is_constrained(i) ? next : stack).emplace_back(face->neighbor(i), level);
    }
    std::swap(stack, next);
  }
}

/// Edge length at each point of the chains: the mean of the two edges beside it.
void add_sizes(std::span<const Point> chain, std::vector<double>& sizes) {
  const auto n = chain.size();
  for (std::size_t i = 0; i < n; ++i)
    sizes.push_back(0.5 * (norm(chain[i] - chain[(i + 1) % n]) + norm(chain[i] - chain[(i + n - 1) % n])));
}

TriangleSurface triangulate(std::span<const Point> outer, std::span<const Point> inner, const Vec3<double>& normal) {
  TriangleSurface surface;
  surface.points.assign(outer.begin(), outer.end());
  surface.points.insert(surface.points.end(), inner.begin(), inner.end());
  const auto first = std::abs(normal[0]) < 0.6 ? Vec3<double>{{1, 0, 0}} : Vec3<double>{{0, 1, 0}};
  auto u = cross(normal, first);
  u = (1 / norm(u)) * u;
  const auto v = cross(normal, u);
  Triangulation triangulation;
  std::vector<Triangulation::Vertex_handle> vertices;
  for (const auto& p : surface.points) {
    vertices.push_back(triangulation.insert({dot(p - outer[0], u), dot(p - outer[0], v)}));
    vertices.back()->info() = std::ssize(vertices) - 1;
  }
  const auto constrain = [&](std::size_t begin, std::size_t n) {
    for (std::size_t i = 0; i < n; ++i)
      triangulation.insert_constraint(vertices[begin + i], vertices[begin + (i + 1) % n]);
  };
  constrain(0, outer.size());
  constrain(outer.size(), inner.size());
  count_constraints(triangulation);
  for (const auto face : triangulation.finite_face_handles())
    if (face->info() == 1)
      surface.triangles.push_back({face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
  return surface;
}

}  // namespace

TriangleSurface plane_cap(std::span<const Point> outer, std::span<const Point> inner, const Vec3<double>& normal) {
  TriangleSurface plain;
  try {
    plain = triangulate(outer, inner, normal);
  } catch (const Triangulation::Intersection_of_constraints_exception&) {
    throw SolverError("the rims of the opening at " + list_places_mm(outer.first(1)) + " cross");
  }
  std::vector<double> sizes;
  add_sizes(outer, sizes);
  add_sizes(inner, sizes);
  RemeshOptions options;
  options.keep_boundary = true;
  const auto cap = remesh({plain, {}}, {TriangleTree(plain), {}, sizes}, options).surface;

  // Remeshing renumbers the points; those of the chains kept their coordinates to the last bit.
  const auto key = [](const Point& p) { return std::make_tuple(p[0], p[1], p[2]); };
  std::map<std::tuple<double, double, double>, std::int64_t> chain;
  for (const auto& p : plain.points) chain.emplace(key(p), std::ssize(chain));
  TriangleSurface result{plain.points, cap.triangles};
  std::vector<std::int64_t> number;
  for (const auto& p : cap.points) {
    const auto found = chain.find(key(p));
    number.push_back(found != chain.end() ? found->second : std::ssize(result.points));
    if (found == chain.end()) result.points.push_back(p);
  }
  for (auto& t : result.triangles)
    for (auto& corner : t) corner = number[corner];
  return result;
}

}  // namespace tunica::geometry
