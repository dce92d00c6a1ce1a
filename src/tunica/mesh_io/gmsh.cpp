#include "tunica/mesh_io/gmsh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "tunica/base/error.hpp"
#include "tunica/mesh/boundary.hpp"
#include "tunica/mesh/quality.hpp"
#include "tunica/mesh_io/extent.hpp"
#include "tunica/mesh_io/msh_file.hpp"

namespace tunica::mesh_io {

namespace {

using Index = std::int64_t;
using Triangle = std::array<Index, 3>;

/// Name of the one physical group of an elementary entity.
std::string physical_name(const MshFile& file, int dimension, int entity, const std::string& where) {
  const std::string what = fmt::format("elementary {} {}", dimension == 3 ? "volume" : "surface", entity);
  const auto tags = file.physical_tags.find({dimension, entity});
  const auto n = tags == file.physical_tags.end() ? 0 : tags->second.size();
  if (n != 1)
    throw InputError(where, fmt::format("{} is in {} physical groups, it must be in exactly 1", what, n),
                     "put each volume and boundary surface into one named physical group");
  const auto name = file.physical_names.find({dimension, tags->second[0]});
  if (name == file.physical_names.end())
    throw InputError(where, fmt::format("{} is in physical group {}, which has no name", what, tags->second[0]),
                     "name the physical groups");
  return name->second;
}

void check_options(const GmshOptions& options, const std::string& where) {
  if (!(options.metres_per_unit > 0 && std::isfinite(options.metres_per_unit)))
    throw InputError(where, fmt::format("length unit of {} m, must be positive", options.metres_per_unit),
                     "declare the length unit of the mesh");
  const auto lumens = std::count_if(options.regions.begin(), options.regions.end(),
                                    [](const GmshRegion& r) { return r.kind == mesh::RegionKind::lumen; });
  if (lumens > 1)
    throw InputError(where, fmt::format("{} lumen regions, at most 1 is possible", lumens),
                     "put all lumen volumes into one physical volume");
}

/// Tetrahedra grouped by region in the declared order, on the nodes of the file.
void fill_regions(const MshFile& file, const GmshOptions& options, const std::string& where, mesh::MeshData& data) {
  std::vector<std::string> declared;
  for (const auto& r : options.regions) declared.push_back(r.physical_volume);
  std::map<int, std::size_t> region_of;  // by elementary volume
  std::vector<std::vector<std::array<Index, 4>>> grouped(declared.size());
  std::vector<std::vector<std::size_t>> members(declared.size());  // positions in the file
  for (std::size_t e = 0; e < file.tetrahedra.size(); ++e) {
    const auto& [nodes, entity] = file.tetrahedra[e];
    auto found = region_of.find(entity);
    if (found == region_of.end()) {
      const auto name = physical_name(file, 3, entity, where);
      const auto r = std::find(declared.begin(), declared.end(), name) - declared.begin();
      if (r == std::ssize(declared))
        throw InputError(
            where,
            fmt::format("physical volume {} is not declared; declared are: {}", name, mesh::list_names(declared)),
            "declare every physical volume as lumen or wall, or leave it out of the mesh");
      found = region_of.emplace(entity, r).first;
    }
    grouped[found->second].push_back(nodes);
    members[found->second].push_back(e);
  }
  for (std::size_t r = 0; r < grouped.size(); ++r) {
    if (grouped[r].empty())
      throw InputError(where, fmt::format("there are no tetrahedra in a physical volume called {}", declared[r]),
                       "correct the name, or mesh the volume");
    const Index first = std::ssize(data.tetrahedra);
    data.tetrahedra.insert(data.tetrahedra.end(), grouped[r].begin(), grouped[r].end());
    data.regions.push_back({declared[r], options.regions[r].kind, first, std::ssize(data.tetrahedra)});
  }
  for (const auto& field : file.fields) {
    auto& sorted = data.fields.emplace_back(mesh::ElementField{field.name, field.components, {}});
    for (const auto& region : members)
      for (const auto e : region)
        for (int c = 0; c < field.components; ++c)
          sorted.values.push_back(field.values[e * static_cast<std::size_t>(field.components) + c]);
  }
}

/// Takes over the nodes that tetrahedra use; returns the new position of each node of the file, -1 where unused.
std::vector<Index> fill_points(const MshFile& file, double metres_per_unit, const std::string& where,
                               mesh::MeshData& data) {
  std::vector<Index> position(file.points.size(), -1);
  for (const auto& t : data.tetrahedra)
    for (const auto n : t) position[n] = 0;
  for (std::size_t n = 0; n < position.size(); ++n) {
    if (position[n] < 0) continue;
    const auto x = metres_per_unit * file.points[n];
    if (!(std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2])))
      throw InputError(where, fmt::format("the coordinates of node {} in file order are not finite", n + 1),
                       "write the mesh again");
    position[n] = std::ssize(data.points);
    data.points.push_back(x);
  }
  refuse_unlikely_size(data.points, metres_per_unit, where);
  for (auto& t : data.tetrahedra)
    for (auto& n : t) n = position[n];
  return position;
}

/// Gives the walls copies of the nodes that they share with the lumen; returns the wall's node for each node.
std::vector<Index> split_interface(mesh::MeshData& data) {
  const Index shared_range = std::ssize(data.points);
  std::vector<bool> in_lumen(shared_range, false);
  for (const auto& r : data.regions)
    if (r.kind == mesh::RegionKind::lumen)
      for (auto e = r.first_element; e < r.end_element; ++e)
        for (const auto n : data.tetrahedra[e]) in_lumen[n] = true;
  std::vector<Index> wall_node(shared_range);
  for (Index n = 0; n < shared_range; ++n) wall_node[n] = n;
  for (const auto& r : data.regions) {
    if (r.kind == mesh::RegionKind::lumen) continue;
    for (auto e = r.first_element; e < r.end_element; ++e)
      for (auto& n : data.tetrahedra[e]) {
        if (in_lumen[n] && wall_node[n] == n) {
          wall_node[n] = std::ssize(data.points);
          data.points.push_back(Vec3<double>(data.points[n]));
          data.twins.emplace_back(wall_node[n], n);
        }
        n = wall_node[n];
      }
  }
  std::sort(data.twins.begin(), data.twins.end());
  return wall_node;
}

/// The physical surfaces as they bound each region.
class Faces {
 public:
  Faces(const mesh::MeshData& data, const mesh::Boundary& boundary, const std::vector<Index>& wall_node)
      : data_(data), boundary_(boundary), wall_node_(wall_node), named_(boundary.triangles().size(), false) {}

  /// Files `triangle` (on the lumen's nodes where split) under each region that it bounds; false when it bounds none.
  bool add(const std::string& surface, const Triangle& triangle) {
    const Triangle wall = {wall_node_[triangle[0]], wall_node_[triangle[1]], wall_node_[triangle[2]]};
    bool found = add_side(surface, boundary_.find(triangle));
    if (wall != triangle) found |= add_side(surface, boundary_.find(wall));
    return found;
  }
  /// Files the lumen triangles without name whose wall side is without name, too; returns their number.
  Index add_unnamed_interface(const std::string& surface) {
    Index n = 0;
    for (std::size_t i = 0; i < named_.size(); ++i) {
      const auto& [nodes, element] = boundary_.triangles()[i];
      if (named_[i] || data_.regions[region_of(element)].kind != mesh::RegionKind::lumen) continue;
      const auto other = boundary_.find({wall_node_[nodes[0]], wall_node_[nodes[1]], wall_node_[nodes[2]]});
      if (other < 0 || other == static_cast<Index>(i) || named_[other]) continue;
      add_side(surface, static_cast<Index>(i));
      add_side(surface, other);
      ++n;
    }
    return n;
  }
  std::vector<mesh::FaceData> result() const {
    std::vector<mesh::FaceData> faces;
    for (const auto& [surface, by_region] : surfaces_)
      for (const auto& [region, triangles] : by_region)
        faces.push_back(
            {by_region.size() == 1 ? surface : data_.regions[region].name + "_" + surface, region, triangles});
    return faces;
  }

 private:
  std::int32_t region_of(Index element) const {
    std::int32_t r = 0;
    while (element >= data_.regions[r].end_element) ++r;
    return r;
  }
  bool add_side(const std::string& surface, Index i) {
    if (i < 0) return false;
    named_[i] = true;
    const auto& [nodes, element] = boundary_.triangles()[i];
    surfaces_[surface][region_of(element)].push_back(nodes);
    return true;
  }

  const mesh::MeshData& data_;
  const mesh::Boundary& boundary_;
  const std::vector<Index>& wall_node_;
  std::vector<bool> named_;
  std::map<std::string, std::map<std::int32_t, std::vector<Triangle>>> surfaces_;
};

/// Triangles of each physical surface on the nodes of the mesh before splitting.
std::map<std::string, std::vector<Triangle>> named_triangles(const MshFile& file, const std::vector<Index>& position,
                                                             const std::string& where) {
  std::map<int, std::string> names;
  std::map<std::string, std::vector<Triangle>> surfaces;
  for (const auto& [nodes, entity] : file.triangles) {
    auto found = names.find(entity);
    if (found == names.end()) found = names.emplace(entity, physical_name(file, 2, entity, where)).first;
    Triangle t;
    for (int i = 0; i < 3; ++i) t[i] = position[nodes[i]];
    if (*std::min_element(t.begin(), t.end()) < 0)
      throw InputError(where, fmt::format("physical surface {} has triangles away from all volumes", found->second),
                       "leave surfaces that bound no volume out of the mesh");
    surfaces[found->second].push_back(t);
  }
  return surfaces;
}

void fill_faces(const MshFile& file, const std::vector<Index>& position, const std::vector<Index>& wall_node,
                const std::string& where, mesh::LoadedMesh& mesh) {
  auto& data = mesh.data;
  const mesh::Boundary boundary(data.tetrahedra, std::ssize(data.points), where);
  Faces faces(data, boundary, wall_node);
  for (const auto& [surface, triangles] : named_triangles(file, position, where)) {
    std::vector<Vec3<double>> inside;
    for (const auto& t : triangles)
      if (!faces.add(surface, t)) inside.push_back(mesh::centroid(data.points, t));
    if (inside.size() == triangles.size())
      mesh.report.push_back(
          fmt::format("physical surface {}: {} triangles inside the mesh, left out", surface, inside.size()));
    else if (!inside.empty())
      throw InputError(where,
                       fmt::format("{} of {} triangles of physical surface {} do not bound a volume: {}", inside.size(),
                                   triangles.size(), surface, mesh::list_places(inside)),
                       "let a physical surface lie on the boundary as a whole");
  }
  const auto unnamed = faces.add_unnamed_interface("interface");
  if (unnamed > 0)
    mesh.report.push_back(fmt::format("{} interface triangles without physical surface: named interface", unnamed));
  data.faces = faces.result();
  std::set<std::string> names;
  for (const auto& f : data.faces) {
    if (!names.insert(f.name).second)
      throw InputError(where, fmt::format("two faces would be called {}", f.name), "rename the physical surface");
    mesh.report.push_back(
        fmt::format("face {}: {} triangles of {}", f.name, f.triangles.size(), data.regions[f.region].name));
  }
  mesh::orient_and_check_faces(data, boundary, where);
}

}  // namespace

mesh::LoadedMesh read_gmsh(const std::filesystem::path& path, const GmshOptions& options) {
  const auto where = path.string();
  check_options(options, where);
  const auto file = read_msh(path, options.fields);
  mesh::LoadedMesh mesh;
  auto& data = mesh.data;
  fill_regions(file, options, where, data);
  const auto position = fill_points(file, options.metres_per_unit, where, data);
  const auto unused = std::ssize(file.points) - std::ssize(data.points);
  if (auto turned = mesh::orient_elements(data, where); !turned.empty()) mesh.report.push_back(std::move(turned));
  const auto wall_node = split_interface(data);
  mesh.report.push_back(
      fmt::format("{}: {} nodes after splitting {} at the interface, {} tetrahedra, {} regions; {} "
                  "nodes that no tetrahedron uses left out",
                  where, data.points.size(), data.twins.size(), data.tetrahedra.size(), data.regions.size(), unused));
  fill_faces(file, position, wall_node, where, mesh);
  return mesh;
}

}  // namespace tunica::mesh_io
