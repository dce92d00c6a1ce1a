#include "tunica/mesh/interface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "tunica/base/error.hpp"
#include "tunica/base/text.hpp"
#include "tunica/mesh/boundary.hpp"
#include "tunica/mesh/point_locator.hpp"

namespace tunica::mesh {

namespace {

using Index = std::int64_t;
using Triangle = std::array<Index, 3>;

/// Appends the values of `count` elements that follow the first `present`; NaN where one side has no such values.
void append_fields(std::vector<ElementField>& all, const std::vector<ElementField>& added, Index present, Index count) {
  const auto find = [](auto& fields, const std::string& name) {
    return std::find_if(fields.begin(), fields.end(), [&](const ElementField& f) { return f.name == name; });
  };
  for (const auto& field : added)
    if (find(all, field.name) == all.end())
      all.push_back({field.name, field.components,
                     std::vector<double>(static_cast<std::size_t>(present * field.components), std::nan(""))});
  for (auto& field : all) {
    const auto found = find(added, field.name);
    if (found == added.end())
      field.values.resize(static_cast<std::size_t>((present + count) * field.components), std::nan(""));
    else
      field.values.insert(field.values.end(), found->values.begin(), found->values.end());
  }
}

/// The same for the values of nodes; every field is of one part alone, since it belongs to a face.
void append_node_fields(std::vector<NodeField>& all, const std::vector<NodeField>& added, Index present, Index count) {
  for (const auto& field : added) all.push_back({field.name, std::vector<double>(present, std::nan(""))});
  for (auto& field : all) field.values.resize(present + count, std::nan(""));
  for (std::size_t k = 0; k < added.size(); ++k)
    std::copy(added[k].values.begin(), added[k].values.end(),
              all[all.size() - added.size() + k].values.begin() + present);
}

LoadedMesh concatenate(std::span<const LoadedMesh> parts) {
  LoadedMesh all;
  for (const auto& part : parts) {
    all.ten_node |= part.ten_node;
    const Index node = std::ssize(all.data.points), element = std::ssize(all.data.tetrahedra);
    const auto region = static_cast<std::int32_t>(all.data.regions.size());
    all.data.points.insert(all.data.points.end(), part.data.points.begin(), part.data.points.end());
    for (const auto& t : part.data.tetrahedra)
      all.data.tetrahedra.push_back({t[0] + node, t[1] + node, t[2] + node, t[3] + node});
    for (auto r : part.data.regions) {
      r.first_element += element;
      r.end_element += element;
      all.data.regions.push_back(std::move(r));
    }
    append_fields(all.data.fields, part.data.fields, element, std::ssize(part.data.tetrahedra));
    append_node_fields(all.data.node_fields, part.data.node_fields, node, std::ssize(part.data.points));
    for (auto f : part.data.faces) {
      f.region += region;
      for (auto& t : f.triangles) t = {t[0] + node, t[1] + node, t[2] + node};
      all.data.faces.push_back(std::move(f));
    }
    for (const auto& [wall, lumen] : part.data.twins) all.data.twins.emplace_back(wall + node, lumen + node);
    all.report.insert(all.report.end(), part.report.begin(), part.report.end());
    all.warnings.insert(all.warnings.end(), part.warnings.begin(), part.warnings.end());
  }
  return all;
}

template <class Named>
void require_unique(const std::vector<Named>& items, const char* what, std::vector<Problem>& problems) {
  std::map<std::string, std::string> seen;  // names of files, which are one on some systems
  for (const auto& item : items)
    if (const auto [same, is_new] = seen.emplace(text::lower(item.name), item.name); !is_new)
      problems.push_back({fmt::format("{} {}", what, item.name),
                          same->second == item.name
                              ? "the name appears twice"
                              : fmt::format("the name differs from {} in the case of letters only", same->second),
                          fmt::format("rename one {}, names must be unique over all meshes of a case", what)});
}

void check_names(const MeshData& data) {
  std::vector<Problem> problems;
  require_unique(data.regions, "region", problems);
  require_unique(data.faces, "face", problems);
  const auto lumens = std::count_if(data.regions.begin(), data.regions.end(),
                                    [](const RegionData& r) { return r.kind == RegionKind::lumen; });
  if (lumens > 1)
    problems.push_back({"regions", fmt::format("{} lumen regions, at most 1 is possible", lumens),
                        "merge the lumens into one region or declare the others as walls"});
  if (!problems.empty()) throw InputError(std::move(problems));
}

/// All triangles of the named faces.
std::vector<Triangle> triangles_of(const MeshData& data, const std::vector<std::string>& names, RegionKind kind) {
  std::vector<Triangle> triangles;
  const std::string side = kind == RegionKind::lumen ? "lumen" : "wall";
  if (names.empty())
    throw InputError("interface", fmt::format("no {} face is named", side), "name the faces of both sides");
  for (const auto& name : names) {
    std::vector<std::string> existing;
    const FaceData* face = nullptr;
    for (const auto& f : data.faces) {
      if (data.regions[f.region].kind != kind) continue;
      existing.push_back(f.name);
      if (f.name == name) face = &f;
    }
    if (!face)
      throw InputError("interface", fmt::format("there is no {} face called {}", side, name),
                       fmt::format("use one of: {}", list_names(existing)));
    triangles.insert(triangles.end(), face->triangles.begin(), face->triangles.end());
  }
  return triangles;
}

std::vector<Index> nodes_of(const std::vector<Triangle>& triangles) {
  std::vector<Index> nodes;
  for (const auto& t : triangles) nodes.insert(nodes.end(), t.begin(), t.end());
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

/// Host of each wall node, -1 where the lumen has none within the tolerance.
std::vector<Index> match(const MeshData& data, const std::vector<Triangle>& lumen_triangles,
                         const std::vector<Index>& lumen_nodes, const std::vector<Index>& wall_nodes,
                         double tolerance) {
  const auto edges = shortest_edges(data.points, lumen_triangles);
  std::vector<Vec3<double>> lumen_points;
  double radius = 0;
  for (const auto n : lumen_nodes) {
    lumen_points.push_back(data.points[n]);
    radius = std::max(radius, tolerance * edges[n]);
  }
  const PointLocator locator(lumen_points, radius);
  std::vector<Index> hosts;
  for (const auto n : wall_nodes) {
    const Index found = locator.nearest(data.points[n], radius);
    const bool near = found >= 0 && norm(data.points[n] - lumen_points[found]) <= tolerance * edges[lumen_nodes[found]];
    hosts.push_back(near ? lumen_nodes[found] : -1);
  }
  return hosts;
}

/// Triangles of `a` that are not in `b`, both as sorted node triples.
std::vector<Triangle> missing_in(const std::vector<Triangle>& a, const std::vector<Triangle>& b) {
  std::vector<Triangle> difference;
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(difference));
  return difference;
}

template <class Places>
void report_places(std::vector<Problem>& problems, const std::string& where, const std::string& what,
                   const Places& places, std::size_t total, const std::string& remedy) {
  if (!places.empty())
    problems.push_back(
        {where, fmt::format("{} of {} {}: {}", places.size(), total, what, list_places(places)), remedy});
}

void check_nodes(const MeshData& data, const std::string& where, const std::vector<Index>& lumen_nodes,
                 const std::vector<Index>& wall_nodes, const std::vector<Index>& hosts, double tolerance) {
  std::vector<Vec3<double>> lonely_wall, lonely_lumen;
  for (std::size_t i = 0; i < wall_nodes.size(); ++i)
    if (hosts[i] < 0) lonely_wall.push_back(data.points[wall_nodes[i]]);
  auto used = hosts;
  std::sort(used.begin(), used.end());
  for (const auto n : lumen_nodes)
    if (!std::binary_search(used.begin(), used.end(), n)) lonely_lumen.push_back(data.points[n]);
  const auto remedy = fmt::format(
      "check the length units, mesh lumen and wall with a common surface, or raise the tolerance (now {:g} of the "
      "local "
      "edge length)",
      tolerance);
  std::vector<Problem> problems;
  report_places(problems, where, "wall nodes have no lumen node", lonely_wall, wall_nodes.size(), remedy);
  report_places(problems, where, "lumen nodes have no wall node", lonely_lumen, lumen_nodes.size(), remedy);
  if (!problems.empty()) throw InputError(std::move(problems));
}

void check_triangles(const MeshData& data, const std::string& where, std::vector<Triangle> lumen,
                     std::vector<Triangle> wall) {
  for (auto* side : {&lumen, &wall}) {
    for (auto& t : *side) t = sorted(t);
    std::sort(side->begin(), side->end());
  }
  std::vector<Problem> problems;
  std::vector<Vec3<double>> only_lumen, only_wall;
  for (const auto& t : missing_in(lumen, wall)) only_lumen.push_back(mesh::centroid(data.points, t));
  for (const auto& t : missing_in(wall, lumen)) only_wall.push_back(mesh::centroid(data.points, t));
  const std::string remedy = "mesh lumen and wall with the same triangles on their common surface";
  report_places(problems, where, "lumen triangles are not wall triangles", only_lumen, lumen.size(), remedy);
  report_places(problems, where, "wall triangles are not lumen triangles", only_wall, wall.size(), remedy);
  if (!problems.empty()) throw InputError(std::move(problems));
}

void pair(LoadedMesh& mesh, const Interface& interface, double tolerance) {
  auto& data = mesh.data;
  const auto where =
      fmt::format("interface of {} and {}", list_names(interface.lumen_faces), list_names(interface.wall_faces));
  const auto lumen_triangles = triangles_of(data, interface.lumen_faces, RegionKind::lumen);
  auto wall_triangles = triangles_of(data, interface.wall_faces, RegionKind::wall);
  const auto lumen_nodes = nodes_of(lumen_triangles), wall_nodes = nodes_of(wall_triangles);
  const auto hosts = match(data, lumen_triangles, lumen_nodes, wall_nodes, tolerance);
  check_nodes(data, where, lumen_nodes, wall_nodes, hosts, tolerance);
  for (auto& t : wall_triangles)
    for (auto& n : t) n = hosts[std::lower_bound(wall_nodes.begin(), wall_nodes.end(), n) - wall_nodes.begin()];
  check_triangles(data, where, lumen_triangles, wall_triangles);
  double largest = 0;
  for (std::size_t i = 0; i < wall_nodes.size(); ++i) {
    largest = std::max(largest, norm(data.points[wall_nodes[i]] - data.points[hosts[i]]));
    data.points[wall_nodes[i]] = data.points[hosts[i]];
    data.twins.emplace_back(wall_nodes[i], hosts[i]);
  }
  mesh.report.push_back(fmt::format("{}: {} node pairs, {} triangles, largest distance {:.3g} m", where,
                                    wall_nodes.size(), lumen_triangles.size(), largest));
}

}  // namespace

LoadedMesh join(std::span<const LoadedMesh> parts, std::span<const Interface> interfaces, const JoinOptions& options) {
  if (!(options.tolerance > 0 && options.tolerance < 0.5))
    throw InputError("interface", fmt::format("tolerance {:g} is outside (0, 0.5)", options.tolerance),
                     "give a share of the edge length, for example 1e-3");
  auto mesh = concatenate(parts);
  check_names(mesh.data);
  for (const auto& interface : interfaces) pair(mesh, interface, options.tolerance);
  // Two interfaces may meet at a line; a wall node has one host.
  auto& twins = mesh.data.twins;
  std::sort(twins.begin(), twins.end());
  twins.erase(std::unique(twins.begin(), twins.end()), twins.end());
  return mesh;
}

}  // namespace tunica::mesh
