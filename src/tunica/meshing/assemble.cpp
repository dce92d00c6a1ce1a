#include "tunica/meshing/assemble.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tunica/base/error.hpp"
#include "tunica/mesh/boundary.hpp"
#include "tunica/mesh/lumen_fields.hpp"

namespace tunica::meshing {

namespace {

/// The opening in whose plane all nodes of the triangle lie, within its rim; -1: none.
int opening_of(const geometry::Tetrahedra& mesh, const std::array<geometry::Index, 3>& nodes,
               const std::vector<geometry::Opening>& openings) {
  for (std::size_t o = 0; o < openings.size(); ++o) {
    if (std::all_of(nodes.begin(), nodes.end(),
                    [&](geometry::Index n) { return geometry::lies_in(openings[o], mesh.points[n]); }))
      return static_cast<int>(o);
  }
  return -1;
}

/// Numbers of the nodes of one kind of region, in the order of the mesh.
std::vector<geometry::Index> number_nodes(const geometry::Tetrahedra& mesh, bool of_lumen, geometry::Index& next) {
  std::vector<geometry::Index> number(mesh.points.size(), -1);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    if ((mesh.labels[e] == geometry::lumen_label) == of_lumen)
      for (const auto n : mesh.elements[e]) number[n] = 0;
  for (auto& n : number)
    if (n == 0) n = next++;
  return number;
}

template <std::size_t N>
std::array<geometry::Index, N> renumbered(const std::array<geometry::Index, N>& nodes,
                                          const std::vector<geometry::Index>& number) {
  std::array<geometry::Index, N> result;
  for (std::size_t i = 0; i < N; ++i) result[i] = number[nodes[i]];
  return result;
}

std::vector<std::array<geometry::Index, 3>> renumbered(const std::vector<std::array<geometry::Index, 3>>& triangles,
                                                       const std::vector<geometry::Index>& number, bool turn = false) {
  std::vector<std::array<geometry::Index, 3>> result;
  for (auto t : triangles) {
    if (turn) std::swap(t[1], t[2]);
    result.push_back(renumbered(t, number));
  }
  return result;
}

}  // namespace

SurfaceFaces sort_surface(const geometry::Tetrahedra& mesh, const std::vector<geometry::Opening>& openings) {
  SurfaceFaces faces{decltype(faces.caps)(openings.size()), decltype(faces.rings)(openings.size()), {}, {}};
  std::vector<geometry::Point> astray;
  for (const auto& t : geometry::surface_triangles(mesh)) {
    if (t.neighbour_label == geometry::wall_label) {
      faces.interface.push_back(t.nodes);
      continue;
    }
    const int opening = opening_of(mesh, t.nodes, openings);
    if (opening >= 0)
      (t.label == geometry::lumen_label ? faces.caps : faces.rings)[opening].push_back(t.nodes);
    else if (t.label == geometry::wall_label)
      faces.outer.push_back(t.nodes);
    else
      astray.push_back(mesh::centroid(mesh.points, t.nodes));
  }
  if (!astray.empty())
    throw SolverError(
        fmt::format("meshing: {} triangles of the lumen lie on the outside, where there is no opening: {}; "
                    "mesh finer, or give a thicker wall",
                    astray.size(), mesh::list_places(astray)));
  for (std::size_t o = 0; o < openings.size(); ++o)
    if (faces.caps[o].empty() || faces.rings[o].empty())
      throw SolverError(fmt::format("meshing: the opening {} has no {}; mesh finer", openings[o].name,
                                    faces.caps[o].empty() ? "lumen" : "wall"));
  return faces;
}

mesh::MeshData assemble(const geometry::Tetrahedra& mesh, const std::vector<geometry::Opening>& openings,
                        const SurfaceFaces& faces, const WallRegions& regions) {
  mesh::MeshData data;
  geometry::Index nodes = 0;
  const auto lumen = number_nodes(mesh, true, nodes), wall = number_nodes(mesh, false, nodes);
  data.points.resize(nodes);
  for (std::size_t n = 0; n < mesh.points.size(); ++n) {
    if (lumen[n] >= 0) data.points[lumen[n]] = mesh.points[n];
    if (wall[n] >= 0) data.points[wall[n]] = mesh.points[n];
    if (lumen[n] >= 0 && wall[n] >= 0) data.twins.emplace_back(wall[n], lumen[n]);
  }

  const auto add_region = [&](const std::string& name, mesh::RegionKind kind, const auto& belongs) {
    const geometry::Index first = std::ssize(data.tetrahedra);
    const auto& number = kind == mesh::RegionKind::lumen ? lumen : wall;
    for (std::size_t e = 0; e < mesh.elements.size(); ++e)
      if (belongs(e)) data.tetrahedra.push_back(renumbered(mesh.elements[e], number));
    if (std::ssize(data.tetrahedra) > first) data.regions.push_back({name, kind, first, std::ssize(data.tetrahedra)});
  };
  add_region("lumen", mesh::RegionKind::lumen, [&](std::size_t e) { return mesh.labels[e] == geometry::lumen_label; });
  for (std::size_t r = 0; r < wall_region_names.size(); ++r)
    add_region(wall_region_names[r], mesh::RegionKind::wall, [&](std::size_t e) {
      return mesh.labels[e] != geometry::lumen_label && static_cast<std::size_t>(regions.of_element[e]) == r;
    });

  constexpr std::int32_t lumen_region = 0, wall_region = 1;
  for (std::size_t o = 0; o < openings.size(); ++o)
    data.faces.push_back({"lumen_" + openings[o].name, lumen_region, renumbered(faces.caps[o], lumen)});
  data.faces.push_back({lumen_interface, lumen_region, renumbered(faces.interface, lumen)});
  for (std::size_t o = 0; o < openings.size(); ++o)
    data.faces.push_back({"wall_" + openings[o].name, wall_region, renumbered(faces.rings[o], wall)});
  data.faces.push_back({wall_interface, wall_region, renumbered(faces.interface, wall, true)});
  data.faces.push_back({"wall_outer", wall_region, renumbered(faces.outer, wall)});
  if (std::any_of(regions.side.begin(), regions.side.end(), [](double side) { return side < 0; })) {
    auto& side = data.node_fields.emplace_back(
        mesh::NodeField{mesh::lumen_side, std::vector<double>(data.points.size(), std::nan(""))});
    for (std::size_t n = 0; n < mesh.points.size(); ++n)
      if (lumen[n] >= 0) side.values[lumen[n]] = regions.side[n];
  }
  return data;
}

}  // namespace tunica::meshing
