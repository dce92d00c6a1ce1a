#include "tunica/quantities/inside.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <variant>

namespace tunica::quantities {

namespace {

std::array<std::int32_t, 3> sorted(std::array<std::int32_t, 3> nodes) {
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

}  // namespace

std::vector<InsideTriangle> inside_of(const coupling::Problem& problem) {
  const auto& mesh = problem.mesh();
  std::set<std::string> inside;
  for (const auto& [lumen, wall] : problem.input().boundary.interfaces) inside.insert(lumen);
  for (const auto& [face, condition] : problem.input().boundary.conditions)
    if (std::holds_alternative<bc::NoSlip>(condition)) inside.insert(face);
  std::vector<InsideTriangle> triangles;
  std::map<std::array<std::int32_t, 3>, std::size_t> wanted;
  for (const auto& face : mesh.faces) {
    if (!inside.contains(face.name)) continue;
    for (const auto& triangle : face.triangles) {
      wanted[sorted(triangle)] = triangles.size();
      triangles.push_back({triangle, {}, {}});
    }
  }
  for (const auto& region : mesh.regions) {
    if (region.kind != mesh::RegionKind::lumen) continue;
    for (std::size_t e = 0; e < region.elements.size(); ++e) {
      const auto& n = region.elements[e];
      for (const auto& side : {sorted({n[1], n[2], n[3]}), sorted({n[0], n[2], n[3]}), sorted({n[0], n[1], n[3]}),
                               sorted({n[0], n[1], n[2]})})
        if (const auto it = wanted.find(side); it != wanted.end()) {
          triangles[it->second].element = n;
          if (mesh.quadratic) triangles[it->second].edges = region.edges[e];
        }
    }
  }
  return triangles;
}

}  // namespace tunica::quantities
