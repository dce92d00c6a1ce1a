#include "tunica/meshing/resolution.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace tunica::meshing {

namespace {

/// Triangles of the lumen's wall, and whether a branch's wall is behind each.
struct LumenWall {
  std::vector<geometry::Triangle> triangles;
  std::vector<bool> branch;
};

LumenWall lumen_wall(const geometry::Tetrahedra& mesh, const WallRegions& regions) {
  LumenWall wall;
  for (const auto& t : geometry::surface_triangles(mesh))
    if (t.neighbour_label == geometry::wall_label) {
      wall.triangles.push_back(t.nodes);
      wall.branch.push_back(regions.of_element[t.neighbour] == WallRegion::branches);
    }
  return wall;
}

std::size_t nearest_opening(const std::vector<geometry::Opening>& openings, const geometry::Point& x) {
  return std::min_element(openings.begin(), openings.end(),
                          [&](const auto& a, const auto& b) { return norm(a.centre - x) < norm(b.centre - x); }) -
         openings.begin();
}

}  // namespace

std::vector<geometry::AcrossPart> resolution(const geometry::Tetrahedra& mesh,
                                             const std::vector<geometry::Opening>& openings, const SurfaceFaces& faces,
                                             const WallRegions& regions, const std::vector<Tear>& tears) {
  std::vector<std::array<geometry::Index, 4>> elements;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    if (mesh.labels[e] == geometry::lumen_label) elements.push_back(mesh.elements[e]);
  const auto wall = lumen_wall(mesh, regions);
  const auto across = geometry::elements_across(mesh.points, elements, wall.triangles);

  std::vector<geometry::AcrossPart> parts;
  const auto add = [&](const std::string& name, const std::function<bool(geometry::Index)>& belongs) {
    if (auto part = geometry::across_part(name, mesh.points, across, belongs)) parts.push_back(std::move(*part));
  };
  for (std::size_t i = 0; i < openings.size(); ++i) {
    std::set<geometry::Index> nodes;
    for (const auto& t : faces.caps[i]) nodes.insert(t.begin(), t.end());
    add("lumen_" + openings[i].name, [&](geometry::Index n) { return nodes.contains(n); });
  }
  for (std::size_t i = 0; i < tears.size(); ++i) {
    std::set<geometry::Index> nodes;
    for (const auto e : tears[i].elements) nodes.insert(mesh.elements[e].begin(), mesh.elements[e].end());
    add(fmt::format("tear_{}", i + 1), [&](geometry::Index n) { return nodes.contains(n); });
  }
  const auto in_branch = [&](geometry::Index n) { return across.wall[n] >= 0 && wall.branch[across.wall[n]]; };
  const bool two = std::any_of(regions.side.begin(), regions.side.end(), [](double s) { return s < 0; });
  add(two ? "true_lumen" : "lumen", [&](geometry::Index n) { return regions.side[n] > 0 && !in_branch(n); });
  if (two) add("false_lumen", [&](geometry::Index n) { return regions.side[n] < 0 && !in_branch(n); });
  for (std::size_t i = 0; i < openings.size(); ++i)
    add(openings[i].name,
        [&](geometry::Index n) { return in_branch(n) && nearest_opening(openings, mesh.points[n]) == i; });
  return parts;
}

}  // namespace tunica::meshing
