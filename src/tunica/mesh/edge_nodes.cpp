#include "tunica/mesh/edge_nodes.hpp"

#include <algorithm>
#include <cassert>
#include <unordered_map>

#include "tunica/fe/quadratic_tetrahedron.hpp"
#include "tunica/mesh/boundary.hpp"

namespace tunica::mesh {

namespace {

using Ends = std::array<std::int64_t, 2>;

struct HashEnds {
  std::size_t operator()(const Ends& e) const {
    return static_cast<std::size_t>(e[0]) * 0x9E3779B97F4A7C15U ^ static_cast<std::size_t>(e[1]);
  }
};

class EdgeNodes {
 public:
  explicit EdgeNodes(MeshData& data) : data_(data), first_(static_cast<std::int64_t>(data.points.size())) {
    node_.reserve(2 * data.tetrahedra.size());
  }

  std::int64_t add(std::int64_t a, std::int64_t b) {
    const auto next = first_ + static_cast<std::int64_t>(ends_.size());
    const auto [it, is_new] = node_.try_emplace(key(a, b), next);
    if (is_new) ends_.push_back({a, b});
    return it->second;
  }
  /// -1 where no element has that edge.
  std::int64_t find(std::int64_t a, std::int64_t b) const {
    const auto it = node_.find(key(a, b));
    return it == node_.end() ? -1 : it->second;
  }
  const std::vector<Ends>& ends() const { return ends_; }

 private:
  static Ends key(std::int64_t a, std::int64_t b) { return {std::min(a, b), std::max(a, b)}; }

  MeshData& data_;
  std::int64_t first_;
  std::unordered_map<Ends, std::int64_t, HashEnds> node_;
  std::vector<Ends> ends_;
};

using Triangle = std::array<std::int64_t, 3>;

/// Triangles of lumen faces, sorted.
std::vector<Triangle> lumen_triangles(const MeshData& data) {
  std::vector<Triangle> list;
  for (const auto& face : data.faces)
    if (data.regions[static_cast<std::size_t>(face.region)].kind == RegionKind::lumen)
      for (const auto& t : face.triangles) list.push_back(sorted(t));
  std::sort(list.begin(), list.end());
  return list;
}

void add_twins(MeshData& data, const EdgeNodes& edges) {
  if (data.twins.empty()) return;
  std::unordered_map<std::int64_t, std::int64_t> host(data.twins.begin(), data.twins.end());
  const auto lumen = lumen_triangles(data);
  std::unordered_map<std::int64_t, std::int64_t> edge_host;
  for (const auto& face : data.faces) {
    if (data.regions[static_cast<std::size_t>(face.region)].kind != RegionKind::wall) continue;
    for (std::size_t k = 0; k < face.triangles.size(); ++k) {
      const auto& t = face.triangles[k];
      if (!std::all_of(t.begin(), t.end(), [&](std::int64_t node) { return host.contains(node); })) continue;
      const Triangle hosts{host[t[0]], host[t[1]], host[t[2]]};
      if (!std::binary_search(lumen.begin(), lumen.end(), sorted(hosts))) continue;
      for (std::size_t i = 0; i < 3; ++i) {
        const auto node = edges.find(hosts[i], hosts[(i + 1) % 3]);
        if (edge_host.try_emplace(face.edges[k][i], node).second) data.twins.emplace_back(face.edges[k][i], node);
      }
    }
  }
}

}  // namespace

void add_edge_nodes(MeshData& data) {
  assert(data.edges.empty());
  EdgeNodes edges(data);
  data.edges.resize(data.tetrahedra.size());
  for (std::size_t e = 0; e < data.tetrahedra.size(); ++e)
    for (std::size_t k = 0; k < 6; ++k)
      data.edges[e][k] = edges.add(data.tetrahedra[e][static_cast<std::size_t>(fe::edge_ends[k][0])],
                                   data.tetrahedra[e][static_cast<std::size_t>(fe::edge_ends[k][1])]);
  for (auto& face : data.faces) {
    face.edges.clear();
    for (const auto& t : face.triangles)
      face.edges.push_back({edges.find(t[0], t[1]), edges.find(t[1], t[2]), edges.find(t[2], t[0])});
  }
  data.points.reserve(data.points.size() + edges.ends().size());
  for (const auto& [a, b] : edges.ends())
    data.points.push_back(0.5 * (data.points[static_cast<std::size_t>(a)] + data.points[static_cast<std::size_t>(b)]));
  for (auto& field : data.node_fields)
    for (const auto& [a, b] : edges.ends())
      field.values.push_back(0.5 *
                             (field.values[static_cast<std::size_t>(a)] + field.values[static_cast<std::size_t>(b)]));
  add_twins(data, edges);
}

MeshData subdivided(const MeshData& data) {
  assert(!data.edges.empty());
  MeshData fine;
  fine.points = data.points;
  fine.node_fields = data.node_fields;
  fine.twins = data.twins;
  fine.regions = data.regions;
  for (auto& region : fine.regions) {
    region.first_element *= 8;
    region.end_element *= 8;
  }
  fine.tetrahedra.reserve(8 * data.tetrahedra.size());
  for (std::size_t e = 0; e < data.tetrahedra.size(); ++e) {
    const auto node = [&](int a) {
      const auto k = static_cast<std::size_t>(a);
      return k < 4 ? data.tetrahedra[e][k] : data.edges[e][k - 4];
    };
    for (const auto& [a, b, c, d] : parts_of_tetrahedron)
      fine.tetrahedra.push_back({node(a), node(b), node(c), node(d)});
  }
  for (const auto& field : data.fields) {
    const auto n = static_cast<std::size_t>(field.components);
    auto& to = fine.fields.emplace_back(ElementField{field.name, field.components, {}});
    to.values.reserve(8 * field.values.size());
    for (std::size_t e = 0; e < data.tetrahedra.size(); ++e)
      for (int part = 0; part < 8; ++part)
        for (std::size_t c = 0; c < n; ++c) to.values.push_back(field.values[n * e + c]);
  }
  for (const auto& face : data.faces) {
    auto& to = fine.faces.emplace_back(FaceData{face.name, face.region, {}, {}});
    for (std::size_t t = 0; t < face.triangles.size(); ++t) {
      const auto& [a, b, c] = face.triangles[t];
      const auto& [ab, bc, ca] = face.edges[t];
      for (const auto& part : {Triangle{a, ab, ca}, Triangle{ab, b, bc}, Triangle{ca, bc, c}, Triangle{ab, bc, ca}})
        to.triangles.push_back(part);
    }
  }
  return fine;
}

}  // namespace tunica::mesh
