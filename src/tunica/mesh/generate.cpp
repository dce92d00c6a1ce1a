#include "tunica/mesh/generate.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "tunica/base/error.hpp"
#include "tunica/mesh/section.hpp"

namespace tunica::mesh {

namespace {

using section::add_cut;
using section::add_quadrilateral;
using section::extrude;
using section::Index;
using section::require_size;
using section::Section;
using std::numbers::pi;

/// Square core of m x m cells and `rings` of 4 m cells around it. The outermost ring takes the last 4 m point numbers,
/// from the direction (-1, -1) counter-clockwise.
Section butterfly(double radius, int m, int rings) {
  Section s;
  const double core = radius * 0.5 * m / (0.5 * m + rings);
  constexpr double roundness = 0.5;  // of the core's outline: 0 a square, 1 a circle
  const auto core_point = [&](int i, int j) -> std::array<double, 2> {
    // Equiangular spacing, so that the core's outline meets the rings at equal angles.
    const double u = std::tan(pi / 4 * (2.0 * i / m - 1)), v = std::tan(pi / 4 * (2.0 * j / m - 1));
    const double side = std::max(std::abs(u), std::abs(v)), distance = std::hypot(u, v);
    if (distance == 0) return {0, 0};
    const double scale = core * ((1 - roundness) * 0.85 + roundness * side / distance);
    return {scale * u, scale * v};
  };
  for (int j = 0; j <= m; ++j)
    for (int i = 0; i <= m; ++i) s.points.push_back(core_point(i, j));
  std::vector<Index> ring;  // the outline of the core
  for (int i = 0; i < m; ++i) ring.push_back(i);
  for (int j = 0; j < m; ++j) ring.push_back(j * (m + 1) + m);
  for (int i = m; i > 0; --i) ring.push_back(m * (m + 1) + i);
  for (int j = m; j > 0; --j) ring.push_back(j * (m + 1));
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < m; ++i) {
      const Index a = j * (m + 1) + i;
      add_quadrilateral(s, a, a + 1, a + m + 2, a + m + 1);
    }
  const auto outline = ring;
  for (int k = 1; k <= rings; ++k) {
    const double t = static_cast<double>(k) / rings;
    auto next = ring;
    for (int i = 0; i < 4 * m; ++i) {
      const double angle = -0.75 * pi + 2 * pi * i / (4 * m);
      const auto p = s.points[outline[i]];
      next[i] = std::ssize(s.points);
      s.points.push_back(
          {(1 - t) * p[0] + t * radius * std::cos(angle), (1 - t) * p[1] + t * radius * std::sin(angle)});
    }
    for (int i = 0; i < 4 * m; ++i) {
      const int j = (i + 1) % (4 * m);
      add_quadrilateral(s, ring[i], next[i], next[j], ring[j]);
    }
    ring = next;
  }
  section::Edges rim{"lumen_wall", {}};
  for (int i = 0; i < 4 * m; ++i) rim.edges.push_back({ring[i], ring[(i + 1) % (4 * m)]});
  s.boundary.push_back(std::move(rim));
  return s;
}

struct Annulus {
  double inner, outer, first_angle, angle;
  int cells_radial, cells_around;
  bool closed;
};

/// Rings of points from the inner to the outer radius; the inner one takes the first numbers.
Section annulus(const Annulus& a) {
  Section s;
  const int per_ring = a.cells_around + (a.closed ? 0 : 1);
  for (int k = 0; k <= a.cells_radial; ++k) {
    const double r = a.inner + (a.outer - a.inner) * k / a.cells_radial;
    for (int i = 0; i < per_ring; ++i) {
      const double angle = a.first_angle + a.angle * i / a.cells_around;
      s.points.push_back({r * std::cos(angle), r * std::sin(angle)});
    }
  }
  section::Edges inner{"wall_inner", {}}, outer{"wall_outer", {}};
  const Index last = static_cast<Index>(a.cells_radial) * per_ring;
  for (int i = 0; i < a.cells_around; ++i) {
    const int j = (i + 1) % per_ring;
    for (int k = 0; k < a.cells_radial; ++k) {
      const Index low = static_cast<Index>(k) * per_ring, high = low + per_ring;
      add_quadrilateral(s, low + i, high + i, high + j, low + j);
    }
    inner.edges.push_back({j, i});
    outer.edges.push_back({last + i, last + j});
  }
  s.boundary = {std::move(inner), std::move(outer)};
  if (!a.closed) {
    section::Edges begin{"symmetry_y", {}}, end{"symmetry_x", {}};
    for (int k = 0; k < a.cells_radial; ++k) {
      const Index low = static_cast<Index>(k) * per_ring, high = low + per_ring;
      begin.edges.push_back({low, high});
      end.edges.push_back({high + a.cells_around, low + a.cells_around});
    }
    s.boundary.push_back(std::move(begin));
    s.boundary.push_back(std::move(end));
  }
  return s;
}

}  // namespace

MeshData box(int nx, int ny, int nz, const Vec3<double>& lengths, RegionKind kind) {
  require_size(nx >= 1 && ny >= 1 && nz >= 1, "box", "the numbers of cells must be at least 1");
  require_size(lengths[0] > 0 && lengths[1] > 0 && lengths[2] > 0, "box", "the lengths must be positive");
  Section s;
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i) s.points.push_back({lengths[0] * i / nx, lengths[1] * j / ny});
  const auto node = [&](int i, int j) -> Index { return static_cast<Index>(j) * (nx + 1) + i; };
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) add_cut(s, node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1));
  s.boundary = {{"x_min", {}}, {"x_max", {}}, {"y_min", {}}, {"y_max", {}}};
  for (int j = 0; j < ny; ++j) {
    s.boundary[0].edges.push_back({node(0, j + 1), node(0, j)});
    s.boundary[1].edges.push_back({node(nx, j), node(nx, j + 1)});
  }
  for (int i = 0; i < nx; ++i) {
    s.boundary[2].edges.push_back({node(i, 0), node(i + 1, 0)});
    s.boundary[3].edges.push_back({node(i + 1, ny), node(i, ny)});
  }
  MeshData mesh;
  extrude(mesh, s, lengths[2], nz, kind == RegionKind::lumen ? "lumen" : "wall", kind, "z_min", "z_max");
  return mesh;
}

std::string objection_to_counts(const TubeSizes& z) {
  const int core = z.cells_around / 4;
  const double around = z.cells_around, side = core, lumen = (side + 1) * (side + 1) + around * z.cells_radial,
               wall = z.wall_thickness > 0 ? around * (z.cells_through_wall + 1.0) : 0,
               nodes = (lumen + wall) * (z.cells_along + 1.0);
  constexpr double unknowns = 4;  // of a node
  if (unknowns * nodes > std::numeric_limits<std::int32_t>::max())
    return fmt::format("the mesh would have {:.3g} nodes, at most {:.3g} are possible", nodes,
                       std::numeric_limits<std::int32_t>::max() / unknowns);
  // Six tetrahedra for each node, and nothing else: the least that the rank needs which makes the mesh.
  const double needed = nodes * (sizeof(Vec3<double>) + 6 * sizeof(std::array<Index, 4>));
  const double memory = static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
  if (memory > 0 && needed > memory)
    return fmt::format("the mesh would have {:.3g} nodes and need {:.3g} GB, the memory of this machine is {:.3g} GB",
                       nodes, needed / 1e9, memory / 1e9);
  return {};
}

double polygon_radius(int corners) {
  const double angle = 2 * pi / corners;
  return std::sqrt(angle / std::sin(angle));
}

MeshData tube(const TubeSizes& z) {
  require_size(z.radius > 0 && z.length > 0, "tube", "radius and length must be positive");
  require_size(z.wall_thickness >= 0, "tube", "the wall thickness must not be negative");
  require_size(z.cells_around >= 4 && z.cells_around % 4 == 0, "tube", "cells_around must be a positive multiple of 4");
  require_size(z.cells_radial >= 1 && z.cells_along >= 1 && z.cells_through_wall >= 1, "tube",
               "the numbers of cells must be at least 1");
  const auto objection = objection_to_counts(z);
  require_size(objection.empty(), "tube", objection.c_str());
  MeshData mesh;
  const auto lumen = butterfly(z.radius, z.cells_around / 4, z.cells_radial);
  extrude(mesh, lumen, z.length, z.cells_along, "lumen", RegionKind::lumen, "lumen_inlet", "lumen_outlet");
  if (z.wall_thickness == 0) return mesh;
  const Index lumen_nodes = std::ssize(mesh.points);
  const auto wall =
      annulus({z.radius, z.radius + z.wall_thickness, -0.75 * pi, 2 * pi, z.cells_through_wall, z.cells_around, true});
  extrude(mesh, wall, z.length, z.cells_along, "wall", RegionKind::wall, "wall_inlet", "wall_outlet");
  const Index n_lumen = std::ssize(lumen.points), n_wall = std::ssize(wall.points);
  for (int k = 0; k <= z.cells_along; ++k)
    for (int i = 0; i < z.cells_around; ++i) {
      const Index host = k * n_lumen + n_lumen - z.cells_around + i, twin = lumen_nodes + k * n_wall + i;
      mesh.points[twin] = mesh.points[host];
      mesh.twins.emplace_back(twin, host);
    }
  return mesh;
}

MeshData thick_cylinder(const CylinderSizes& z, Sector sector) {
  require_size(z.inner > 0 && z.outer > z.inner && z.length > 0, "thick cylinder",
               "the radii must satisfy 0 < inner < outer and the length must be positive");
  const bool full = sector == Sector::full;
  require_size(z.cells_radial >= 1 && z.cells_along >= 1 && z.cells_around >= (full ? 3 : 1), "thick cylinder",
               "the numbers of cells must be at least 1, around a full circle 3");
  MeshData mesh;
  auto section = annulus({z.inner, z.outer, 0, full ? 2 * pi : pi / 2, z.cells_radial, z.cells_around, full});
  if (!full)  // cos(pi / 2) is not exactly 0
    for (int k = 0; k <= z.cells_radial; ++k) section.points[k * (z.cells_around + 1) + z.cells_around][0] = 0;
  extrude(mesh, section, z.length, z.cells_along, "wall", RegionKind::wall, "wall_inlet", "wall_outlet");
  return mesh;
}

}  // namespace tunica::mesh
