#include "tunica/artifacts/resolution.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "tunica/case/plausible.hpp"
#include "tunica/mesh/lumen_fields.hpp"

namespace tunica::artifacts {

namespace {

using geometry::AcrossPart;
using mesh::RegionKind;

bool has_symmetry(const case_file::Case& c) {
  return std::any_of(c.boundary.begin(), c.boundary.end(),
                     [](const auto& b) { return std::holds_alternative<bc::Symmetry>(b.second); });
}

/// Where a coarse flap meets the outer wall at an angle, single nodes have flap on both sides, too. A hole has at least
/// the nodes of its rim.
constexpr int fewest_nodes_of_tear = 8;

bool of_lumen(const mesh::MeshData& data, const mesh::FaceData& face) {
  return data.regions[static_cast<std::size_t>(face.region)].kind == RegionKind::lumen;
}

/// For each node of the lumen at the interface, a wall region beside it: the last where several meet; -1 elsewhere.
std::vector<int> regions_beside(const mesh::MeshData& data) {
  std::vector<int> of_wall_node(data.points.size(), -1), beside(data.points.size(), -1);
  for (std::size_t r = 0; r < data.regions.size(); ++r) {
    if (data.regions[r].kind != RegionKind::wall) continue;
    for (auto e = data.regions[r].first_element; e < data.regions[r].end_element; ++e)
      for (const auto n : data.tetrahedra[e]) of_wall_node[n] = static_cast<int>(r);
  }
  for (const auto& [wall, lumen] : data.twins) beside[lumen] = of_wall_node[wall];
  return beside;
}

/// Sets of marked nodes that hang together along edges, the number of each; -1: not marked.
std::vector<int> connected(std::span<const std::array<std::int64_t, 4>> elements, const std::vector<bool>& marked,
                           int& sets) {
  std::vector<std::int64_t> parent(marked.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](std::int64_t n) {
    while (parent[n] != n) n = parent[n] = parent[parent[n]];
    return n;
  };
  for (const auto& t : elements)
    for (int a = 0; a < 4; ++a)
      for (int b = a + 1; b < 4; ++b)
        if (marked[t[a]] && marked[t[b]]) parent[root(t[a])] = root(t[b]);
  std::vector<int> number(marked.size(), -1);
  sets = 0;
  for (std::int64_t n = 0; n < std::ssize(marked); ++n)
    if (marked[n] && root(n) == n) number[n] = sets++;
  for (std::int64_t n = 0; n < std::ssize(marked); ++n)
    if (marked[n]) number[n] = number[root(n)];
  return number;
}

}  // namespace

std::vector<AcrossPart> resolution(const case_file::Case& c, const mesh::MeshData& data) {
  std::vector<AcrossPart> parts;
  const auto lumen =
      std::find_if(data.regions.begin(), data.regions.end(), [](const auto& r) { return r.kind == RegionKind::lumen; });
  if (!c.solves_fluid() || has_symmetry(c) || lumen == data.regions.end()) return parts;
  std::vector<std::string> names;
  for (const auto& face : data.faces)
    if (of_lumen(data, face)) names.push_back(face.name);
  const auto sticking = case_file::sticking_faces(c, names);
  const auto sticks = [&](const std::string& name) {
    return std::find(sticking.begin(), sticking.end(), name) != sticking.end();
  };
  std::vector<geometry::Triangle> wall;
  for (const auto& face : data.faces)
    if (of_lumen(data, face) && sticks(face.name))
      wall.insert(wall.end(), face.triangles.begin(), face.triangles.end());
  const std::span elements(data.tetrahedra.begin() + lumen->first_element,
                           data.tetrahedra.begin() + lumen->end_element);
  const auto across = geometry::elements_across(data.points, elements, wall);

  const auto add = [&](const std::string& name, const std::function<bool(std::int64_t)>& belongs) {
    if (auto part = geometry::across_part(name, data.points, across, belongs)) parts.push_back(std::move(*part));
  };
  for (const auto& face : data.faces) {
    if (!of_lumen(data, face) || sticks(face.name)) continue;
    std::set<std::int64_t> nodes;
    for (const auto& t : face.triangles) nodes.insert(t.begin(), t.end());
    add(face.name, [&](std::int64_t n) { return nodes.contains(n); });
  }
  const auto beside = regions_beside(data);
  const auto region = [&](std::int64_t n) { return across.wall[n] < 0 ? -1 : beside[wall[across.wall[n]][0]]; };
  if (std::count_if(data.regions.begin(), data.regions.end(),
                    [](const auto& r) { return r.kind == RegionKind::wall; }) < 2)
    add("lumen", [](std::int64_t) { return true; });
  else
    for (std::size_t r = 0; r < data.regions.size(); ++r)
      add("lumen by " + data.regions[r].name, [&](std::int64_t n) { return region(n) == static_cast<int>(r); });

  // A flap faces itself where it is torn.
  const std::string flap = c.post ? c.post->flap : analysis::PostSettings{}.flap;
  const auto is_flap = [&](std::int64_t triangle) {
    const int r = triangle < 0 ? -1 : beside[wall[triangle][0]];
    return r >= 0 && data.regions[r].name == flap;
  };
  std::vector<bool> torn(data.points.size());
  for (std::size_t n = 0; n < torn.size(); ++n) torn[n] = is_flap(across.wall[n]) && is_flap(across.facing[n]);
  int sets = 0, tears = 0;
  const auto set = connected(elements, torn, sets);
  // Where the mesh tells the lumens apart, a tear has both; elsewhere a flap that is curled faces itself, too.
  const auto* side = mesh::values_named(data.node_fields, mesh::lumen_side);
  struct Nodes {
    int all = 0;
    bool true_lumen = false, false_lumen = false;
  };
  std::vector<Nodes> of_set(static_cast<std::size_t>(sets));
  for (std::size_t n = 0; n < set.size(); ++n) {
    if (set[n] < 0) continue;
    auto& nodes = of_set[static_cast<std::size_t>(set[n])];
    ++nodes.all;
    const bool known = side != nullptr && !std::isnan((*side)[n]);
    nodes.true_lumen = nodes.true_lumen || !known || (*side)[n] > 0;
    nodes.false_lumen = nodes.false_lumen || !known || !((*side)[n] > 0);
  }
  for (int k = 0; k < sets; ++k)
    if (const auto& nodes = of_set[static_cast<std::size_t>(k)];
        nodes.all >= fewest_nodes_of_tear && nodes.true_lumen && nodes.false_lumen)
      add(fmt::format("tear {}", ++tears), [&](std::int64_t n) { return set[n] == k; });
  return parts;
}

std::optional<Problem> too_few_across(const case_file::Case& c, const std::vector<AcrossPart>& parts) {
  const auto text = geometry::too_few_across(parts, case_file::enough_across(c));
  if (!text) return std::nullopt;
  return Problem{"meshes", *text, case_file::remedy_across(c)};
}

}  // namespace tunica::artifacts
