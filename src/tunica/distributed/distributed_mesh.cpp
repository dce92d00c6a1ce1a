#include "tunica/distributed/distributed_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <limits>
#include <numeric>
#include <span>

#include "tunica/base/error.hpp"
#include "tunica/distributed/partition.hpp"
#include "tunica/mesh/ordering.hpp"
#include "tunica/parallel/agree.hpp"
#include "tunica/parallel/message.hpp"

// Rank 0 holds the whole mesh once: the file formats are serial streams, and reading and cutting take a second or two
// per million elements. Nothing else ever gathers the mesh.

namespace tunica::distributed {

namespace {

/// Rows of item numbers, one row per rank or per group.
struct Rows {
  std::vector<std::int64_t> begin, items;
  std::span<const std::int64_t> of(std::size_t row) const {
    return std::span(items).subspan(static_cast<std::size_t>(begin[row]),
                                    static_cast<std::size_t>(begin[row + 1] - begin[row]));
  }
};

/// Nodes that move as one: a host followed by its twins. Groups are what is partitioned and ordered, so that twins stay
/// with their host and next to it.
struct Groups {
  std::vector<std::int32_t> of_node;
  std::vector<std::int64_t> host;  ///< of each node: itself, or the node that carries its motion
  Rows members;
};

/// Where each node goes. New global numbers are contiguous per rank.
struct Numbering {
  std::vector<std::int32_t> owner;   ///< rank of each node
  std::vector<std::int64_t> new_id;  ///< of each node
  std::vector<std::int64_t> node;    ///< with each new number
  std::vector<std::int64_t> first;   ///< first new number of each rank, and the total
};

Groups group_twins(const mesh::MeshData& data) {
  const std::size_t nodes = data.points.size();
  Groups groups;
  groups.host.resize(nodes);
  std::iota(groups.host.begin(), groups.host.end(), 0);
  for (const auto& [twin, host] : data.twins) groups.host[twin] = host;
  for (const auto& [twin, host] : data.twins)
    assert(groups.host[twin] == host && groups.host[host] == host && "one host per twin, and no host is a twin");

  groups.of_node.resize(nodes);
  std::int32_t count = 0;
  for (std::size_t n = 0; n < nodes; ++n)
    if (groups.host[n] == static_cast<std::int64_t>(n)) groups.of_node[n] = count++;
  for (const auto& [twin, host] : data.twins) groups.of_node[twin] = groups.of_node[host];

  auto& begin = groups.members.begin;
  begin.assign(static_cast<std::size_t>(count) + 1, 0);
  for (const std::int32_t group : groups.of_node) ++begin[group + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  groups.members.items.resize(nodes);
  std::vector<std::int64_t> next(begin.begin(), begin.end() - 1);
  for (std::size_t n = 0; n < nodes; ++n)
    if (groups.host[n] == static_cast<std::int64_t>(n))
      groups.members.items[next[groups.of_node[n]]++] = static_cast<std::int64_t>(n);
  for (std::size_t n = 0; n < nodes; ++n)
    if (groups.host[n] != static_cast<std::int64_t>(n))
      groups.members.items[next[groups.of_node[n]]++] = static_cast<std::int64_t>(n);
  return groups;
}

void check_size(const mesh::MeshData& data) {
  const std::size_t most = std::numeric_limits<std::int32_t>::max();
  if (data.points.empty() || data.tetrahedra.empty())
    throw InputError("mesh", fmt::format("{} nodes and {} tetrahedra", data.points.size(), data.tetrahedra.size()),
                     "give a mesh with at least one tetrahedron");
  if (std::max(data.points.size(), data.tetrahedra.size()) > most)
    throw InputError("mesh",
                     fmt::format("{} nodes and {} tetrahedra, at most {} of each can be distributed",
                                 data.points.size(), data.tetrahedra.size(), most),
                     "use a coarser mesh");
}

/// Nodes of an element or of a triangle: corners, then those on its edges.
template <std::size_t N>
struct CellNodes {
  std::array<std::int64_t, N> nodes;
  std::size_t count;

  auto begin() const { return nodes.begin(); }
  auto end() const { return nodes.begin() + static_cast<std::ptrdiff_t>(count); }
};

CellNodes<10> element_nodes(const mesh::MeshData& data, std::int64_t e) {
  CellNodes<10> cell{{}, 4};
  std::copy_n(data.tetrahedra[e].begin(), 4, cell.nodes.begin());
  if (data.edges.empty()) return cell;
  std::copy_n(data.edges[e].begin(), 6, cell.nodes.begin() + 4);
  cell.count = 10;
  return cell;
}

CellNodes<6> triangle_nodes(const mesh::FaceData& face, std::int64_t t) {
  CellNodes<6> cell{{}, 3};
  std::copy_n(face.triangles[t].begin(), 3, cell.nodes.begin());
  if (face.edges.empty()) return cell;
  std::copy_n(face.edges[t].begin(), 3, cell.nodes.begin() + 3);
  cell.count = 6;
  return cell;
}

template <std::size_t N>
mesh::Graph graph_of_groups(const mesh::MeshData& data, const Groups& groups, std::vector<std::int32_t>& weights) {
  std::vector<std::array<std::int32_t, N>> elements(data.tetrahedra.size());
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const auto nodes = element_nodes(data, static_cast<std::int64_t>(e));
    for (std::size_t a = 0; a < N; ++a) {
      elements[e][a] = groups.of_node[nodes.nodes[a]];
      ++weights[elements[e][a]];
    }
  }
  return mesh::graph_of_elements(static_cast<std::int32_t>(weights.size()), elements);
}

Numbering number_nodes(const mesh::MeshData& data, const Groups& groups, int ranks) {
  std::vector<std::int32_t> weights(groups.members.begin.size() - 1, 0);
  const mesh::Graph graph =
      data.edges.empty() ? graph_of_groups<4>(data, groups, weights) : graph_of_groups<10>(data, groups, weights);
  const std::vector<std::int32_t> part = partition(graph, weights, ranks);

  Numbering numbering;
  numbering.owner.resize(data.points.size());
  numbering.new_id.resize(data.points.size());
  numbering.node.reserve(data.points.size());
  numbering.first.assign(static_cast<std::size_t>(ranks) + 1, 0);
  for (const std::int32_t group : mesh::reverse_cuthill_mckee(graph, part, ranks))
    for (const std::int64_t node : groups.members.of(group)) {
      numbering.owner[node] = part[group];
      numbering.new_id[node] = static_cast<std::int64_t>(numbering.node.size());
      numbering.node.push_back(node);
      ++numbering.first[part[group] + 1];
    }
  std::partial_sum(numbering.first.begin(), numbering.first.end(), numbering.first.begin());
  return numbering;
}

/// Cells (elements or triangles) that touch a node of each rank, ascending. `nodes_of(c)`: their nodes.
template <class NodesOf>
Rows cells_by_rank(std::size_t cells, const NodesOf& nodes_of, const std::vector<std::int32_t>& owner, int ranks) {
  const auto for_each_rank = [&](auto&& visit) {
    for (std::size_t c = 0; c < cells; ++c) {
      const auto nodes = nodes_of(static_cast<std::int64_t>(c));
      for (auto a = nodes.begin(); a != nodes.end(); ++a) {
        const std::int32_t rank = owner[*a];
        if (std::none_of(nodes.begin(), a, [&](std::int64_t b) { return owner[b] == rank; }))
          visit(rank, static_cast<std::int64_t>(c));
      }
    }
  };
  Rows rows;
  rows.begin.assign(static_cast<std::size_t>(ranks) + 1, 0);
  for_each_rank([&](std::int32_t rank, std::int64_t) { ++rows.begin[rank + 1]; });
  std::partial_sum(rows.begin.begin(), rows.begin.end(), rows.begin.begin());
  rows.items.resize(static_cast<std::size_t>(rows.begin.back()));
  std::vector<std::int64_t> next(rows.begin.begin(), rows.begin.end() - 1);
  for_each_rank([&](std::int32_t rank, std::int64_t cell) { rows.items[next[rank]++] = cell; });
  return rows;
}

/// Cuts the mesh on rank 0 into what each rank gets.
class Cutter {
 public:
  Cutter(const mesh::MeshData& data, int ranks)
      : data_(data),
        groups_(group_twins(data)),
        numbering_(number_nodes(data, groups_, ranks)),
        elements_(cells_by_rank(
            data.tetrahedra.size(), [&](std::int64_t e) { return element_nodes(data, e); }, numbering_.owner, ranks)),
        local_(data.points.size(), absent) {
    for (const auto& face : data.faces)
      triangles_.push_back(cells_by_rank(
          face.triangles.size(), [&](std::int64_t t) { return triangle_nodes(face, t); }, numbering_.owner, ranks));
  }

  /// Fills what belongs to `rank` into a mesh with regions and faces already named. Cells are not sorted yet.
  void cut(int rank, DistributedMesh& mesh) {
    const std::vector<std::int64_t> nodes = collect_nodes(rank);
    mesh.first_global = numbering_.first[rank];
    mesh.owned_nodes = static_cast<std::int32_t>(numbering_.first[rank + 1] - mesh.first_global);
    for (std::size_t i = 0; i < nodes.size(); ++i) local_[nodes[i]] = static_cast<std::int32_t>(i);
    mesh.points.resize(nodes.size());
    mesh.global_ids.resize(nodes.size());
    mesh.host.resize(nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      mesh.points[i] = data_.points[nodes[i]];
      mesh.global_ids[i] = numbering_.new_id[nodes[i]];
      mesh.host[i] = local_[groups_.host[nodes[i]]];
    }
    for (std::size_t f = 0; f < data_.node_fields.size(); ++f) {
      auto& values = mesh.node_fields[f].values;
      values.clear();
      for (const auto node : nodes) values.push_back(data_.node_fields[f].values[node]);
    }
    cut_elements(rank, mesh);
    cut_faces(rank, mesh);
    for (const std::int64_t node : nodes) local_[node] = absent;
    mesh.original_ids = nodes;
  }

 private:
  static constexpr std::int32_t absent = -1, present = -2;

  /// Nodes that `rank` sees, in local order: owned ones, then ghosts by new global number, which sorts by owner too.
  std::vector<std::int64_t> collect_nodes(int rank) {
    std::vector<std::int64_t> nodes(numbering_.node.begin() + numbering_.first[rank],
                                    numbering_.node.begin() + numbering_.first[rank + 1]);
    const auto owned = static_cast<std::ptrdiff_t>(nodes.size());
    for (const std::int64_t node : nodes) local_[node] = present;
    const auto add = [&](std::int64_t node) {
      if (local_[node] != absent) return;
      local_[node] = present;
      nodes.push_back(node);
    };
    const auto add_cell = [&](const auto& cell) {
      for (const std::int64_t node : cell) {
        add(node);
        add(groups_.host[node]);
      }
    };
    for (const std::int64_t e : elements_.of(rank)) add_cell(element_nodes(data_, e));
    for (std::size_t f = 0; f < triangles_.size(); ++f)
      for (const std::int64_t t : triangles_[f].of(rank)) add_cell(triangle_nodes(data_.faces[f], t));
    std::sort(nodes.begin() + owned, nodes.end(),
              [&](std::int64_t a, std::int64_t b) { return numbering_.new_id[a] < numbering_.new_id[b]; });
    return nodes;
  }

  void cut_elements(int rank, DistributedMesh& mesh) const {
    const auto ids = elements_.of(rank);
    std::size_t used = 0;
    for (std::size_t r = 0; r < data_.regions.size(); ++r) {
      const auto begin = std::lower_bound(ids.begin(), ids.end(), data_.regions[r].first_element);
      const auto end = std::lower_bound(begin, ids.end(), data_.regions[r].end_element);
      auto& region = mesh.regions[r];
      region.element_ids.assign(begin, end);
      region.elements.resize(region.element_ids.size());
      for (std::size_t e = 0; e < region.elements.size(); ++e)
        for (int a = 0; a < 4; ++a) region.elements[e][a] = local_[data_.tetrahedra[region.element_ids[e]][a]];
      if (!data_.edges.empty()) {
        region.edges.resize(region.element_ids.size());
        for (std::size_t e = 0; e < region.edges.size(); ++e)
          for (int a = 0; a < 6; ++a) region.edges[e][a] = local_[data_.edges[region.element_ids[e]][a]];
      }
      used += region.elements.size();
      for (std::size_t f = 0; f < data_.fields.size(); ++f) {
        const mesh::ElementField& all = data_.fields[f];
        auto& values = region.fields[f].values;
        values.clear();
        for (const auto id : region.element_ids) {
          const auto first = all.values.begin() + static_cast<std::ptrdiff_t>(id) * all.components;
          values.insert(values.end(), first, first + all.components);
        }
      }
    }
    assert(used == ids.size() && "the regions cover all elements");
  }

  void cut_faces(int rank, DistributedMesh& mesh) const {
    for (std::size_t f = 0; f < triangles_.size(); ++f) {
      auto& triangles = mesh.faces[f].triangles;
      auto& edges = mesh.faces[f].edges;
      triangles.clear();
      edges.clear();
      for (const std::int64_t t : triangles_[f].of(rank)) {
        const auto nodes = triangle_nodes(data_.faces[f], t).nodes;
        triangles.push_back({local_[nodes[0]], local_[nodes[1]], local_[nodes[2]]});
        if (!data_.edges.empty()) edges.push_back({local_[nodes[3]], local_[nodes[4]], local_[nodes[5]]});
      }
    }
  }

  const mesh::MeshData& data_;
  Groups groups_;
  Numbering numbering_;
  Rows elements_;
  std::vector<Rows> triangles_;  ///< of each face
  std::vector<std::int32_t> local_;
};

/// What all ranks know alike: sizes, names and kinds. Collective.
DistributedMesh broadcast_frame(const mesh::MeshData& data, MPI_Comm comm) {
  std::vector<std::string> region_names, face_names;
  std::vector<mesh::RegionKind> kinds;
  std::vector<std::int32_t> face_regions;
  std::vector<std::int64_t> face_sizes;
  std::vector<std::string> field_names, node_field_names;
  std::vector<std::int32_t> field_components;
  std::array<std::int64_t, 3> totals{};
  if (parallel::rank(comm) == 0) {
    for (const auto& region : data.regions) {
      region_names.push_back(region.name);
      kinds.push_back(region.kind);
    }
    for (const auto& face : data.faces) {
      face_names.push_back(face.name);
      face_regions.push_back(face.region);
      face_sizes.push_back(static_cast<std::int64_t>(face.triangles.size()));
    }
    for (const auto& field : data.fields) {
      field_names.push_back(field.name);
      field_components.push_back(field.components);
    }
    for (const auto& field : data.node_fields) node_field_names.push_back(field.name);
    totals = {static_cast<std::int64_t>(data.points.size()), static_cast<std::int64_t>(data.tetrahedra.size()),
              data.edges.empty() ? 0 : 1};
  }
  parallel::broadcast(comm, region_names);
  parallel::broadcast(comm, kinds);
  parallel::broadcast(comm, face_names);
  parallel::broadcast(comm, face_regions);
  parallel::broadcast(comm, face_sizes);
  parallel::broadcast(comm, field_names);
  parallel::broadcast(comm, field_components);
  parallel::broadcast(comm, node_field_names);
  parallel::broadcast(comm, totals);

  DistributedMesh mesh;
  mesh.comm = comm;
  mesh.global_nodes = totals[0];
  mesh.global_elements = totals[1];
  mesh.quadratic = totals[2] != 0;
  for (const auto& name : node_field_names) mesh.node_fields.push_back({name, {}});
  std::vector<mesh::ElementField> fields;
  for (std::size_t f = 0; f < field_names.size(); ++f) fields.push_back({field_names[f], field_components[f], {}});
  for (std::size_t r = 0; r < region_names.size(); ++r)
    mesh.regions.push_back(
        {.name = region_names[r], .kind = kinds[r], .elements = {}, .element_ids = {}, .fields = fields});
  for (std::size_t f = 0; f < face_names.size(); ++f)
    mesh.faces.push_back(
        {.name = face_names[f], .region = face_regions[f], .global_triangles = face_sizes[f], .triangles = {}});
  return mesh;
}

void send_part(MPI_Comm comm, int to, const DistributedMesh& mesh) {
  parallel::send(comm, to, std::vector<std::int64_t>{mesh.first_global, mesh.owned_nodes});
  parallel::send(comm, to, mesh.points);
  parallel::send(comm, to, mesh.global_ids);
  parallel::send(comm, to, mesh.original_ids);
  parallel::send(comm, to, mesh.host);
  for (const auto& field : mesh.node_fields) parallel::send(comm, to, field.values);
  for (const auto& region : mesh.regions) {
    parallel::send(comm, to, region.elements);
    parallel::send(comm, to, region.edges);
    parallel::send(comm, to, region.element_ids);
    for (const auto& field : region.fields) parallel::send(comm, to, field.values);
  }
  for (const auto& face : mesh.faces) {
    parallel::send(comm, to, face.triangles);
    parallel::send(comm, to, face.edges);
  }
}

void receive_part(MPI_Comm comm, DistributedMesh& mesh) {
  const auto header = parallel::receive<std::int64_t>(comm, 0);
  mesh.first_global = header.at(0);
  mesh.owned_nodes = static_cast<std::int32_t>(header.at(1));
  mesh.points = parallel::receive<Vec3<double>>(comm, 0);
  mesh.global_ids = parallel::receive<std::int64_t>(comm, 0);
  mesh.original_ids = parallel::receive<std::int64_t>(comm, 0);
  mesh.host = parallel::receive<std::int32_t>(comm, 0);
  for (auto& field : mesh.node_fields) field.values = parallel::receive<double>(comm, 0);
  for (auto& region : mesh.regions) {
    region.elements = parallel::receive<std::array<std::int32_t, 4>>(comm, 0);
    region.edges = parallel::receive<std::array<std::int32_t, 6>>(comm, 0);
    region.element_ids = parallel::receive<std::int64_t>(comm, 0);
    for (auto& field : region.fields) field.values = parallel::receive<double>(comm, 0);
  }
  for (auto& face : mesh.faces) {
    face.triangles = parallel::receive<std::array<std::int32_t, 3>>(comm, 0);
    face.edges = parallel::receive<std::array<std::int32_t, 3>>(comm, 0);
  }
}

/// Order of `cells`: owned ones first, then by lowest local node. A cell is owned by the rank that owns its node of
/// lowest global number, and since those numbers ascend with the rank, a cell is a ghost here if any of its nodes
/// belongs to a lower rank.
template <std::size_t N, std::size_t M>
std::pair<std::vector<std::int32_t>, std::int32_t> cell_order(const std::vector<std::array<std::int32_t, N>>& cells,
                                                              const std::vector<std::array<std::int32_t, M>>& edges,
                                                              const DistributedMesh& mesh) {
  struct Key {
    bool ghost;
    std::int32_t lowest, cell;
    auto operator<=>(const Key&) const = default;
  };
  std::vector<Key> keys(cells.size());
  std::int32_t owned = 0;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const auto& nodes = cells[c];
    const auto foreign = [&](std::int32_t node) { return mesh.global_ids[node] < mesh.first_global; };
    const bool ghost = std::any_of(nodes.begin(), nodes.end(), foreign) ||
                       (!edges.empty() && std::any_of(edges[c].begin(), edges[c].end(), foreign));
    keys[c] = {ghost, *std::min_element(nodes.begin(), nodes.end()), static_cast<std::int32_t>(c)};
    owned += ghost ? 0 : 1;
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::int32_t> order(cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c) order[c] = keys[c].cell;
  return {std::move(order), owned};
}

template <class T>
void permute(std::vector<T>& values, const std::vector<std::int32_t>& order) {
  std::vector<T> result;
  result.reserve(order.size());
  for (const std::int32_t i : order) result.push_back(values[i]);
  values = std::move(result);
}

void permute(mesh::ElementField& field, const std::vector<std::int32_t>& order) {
  std::vector<double> result;
  result.reserve(field.values.size());
  for (const std::int32_t i : order)
    for (int c = 0; c < field.components; ++c)
      result.push_back(field.values[static_cast<std::size_t>(i) * field.components + c]);
  field.values = std::move(result);
}

void sort_cells(DistributedMesh& mesh) {
  for (auto& region : mesh.regions) {
    const auto [order, owned] = cell_order(region.elements, region.edges, mesh);
    region.owned_elements = owned;
    permute(region.elements, order);
    if (mesh.quadratic) permute(region.edges, order);
    permute(region.element_ids, order);
    for (auto& field : region.fields) permute(field, order);
  }
  for (auto& face : mesh.faces) {
    const auto [order, owned] = cell_order(face.triangles, face.edges, mesh);
    face.owned_triangles = owned;
    permute(face.triangles, order);
    if (mesh.quadratic) permute(face.edges, order);
  }
}

}  // namespace

const mesh::ElementField& Region::field(const std::string& wanted) const {
  std::string names;
  for (const auto& f : fields) {
    if (f.name == wanted) return f;
    names += (names.empty() ? "" : ", ") + f.name;
  }
  throw InputError("region " + name, fmt::format("its mesh brings no element values called '{}'", wanted),
                   names.empty() ? "give a mesh file with cell arrays" : "use one of: " + names);
}

const Face& DistributedMesh::face(const std::string& name) const {
  std::string names;
  for (const auto& face : faces) {
    if (face.name == name) return face;
    names += (names.empty() ? "" : ", ") + face.name;
  }
  throw InputError("mesh", fmt::format("there is no face '{}'", name), "use one of: " + names);
}

const mesh::NodeField& DistributedMesh::node_field(const std::string& name) const {
  std::string names;
  for (const auto& field : node_fields) {
    if (field.name == name) return field;
    names += (names.empty() ? "" : ", ") + field.name;
  }
  throw InputError("mesh", fmt::format("it brings no node values called '{}'", name),
                   names.empty() ? "give a mesh file with point arrays on its faces" : "use one of: " + names);
}

DistributedMesh distribute(const mesh::MeshData& data, MPI_Comm comm) {
  const int ranks = parallel::size(comm);
  auto cutter = parallel::on_root(comm, [&] {
    check_size(data);
    return std::make_optional<Cutter>(data, ranks);
  });
  DistributedMesh mesh = broadcast_frame(data, comm);
  if (cutter) {
    for (int rank = ranks - 1; rank >= 0; --rank) {
      cutter->cut(rank, mesh);
      if (rank > 0) send_part(comm, rank, mesh);
    }
    cutter.reset();
  } else {
    receive_part(comm, mesh);
  }
  sort_cells(mesh);
  mesh.halo = parallel::Halo(comm, mesh.global_ids, mesh.owned_nodes, mesh.first_global);
  return mesh;
}

}  // namespace tunica::distributed
