#include "tunica/mesh/submesh.hpp"

namespace tunica::mesh {

namespace {

using Index = std::int64_t;

/// Regions and elements of the part, with the nodes of the whole; marks these nodes with 0.
void take_elements(const MeshData& whole, RegionKind kind, Submesh& part, std::vector<Index>& number) {
  for (const auto& region : whole.regions) {
    if (region.kind != kind) continue;
    const Index first = std::ssize(part.elements);
    for (Index e = region.first_element; e < region.end_element; ++e) {
      const auto& corners = whole.tetrahedra[static_cast<std::size_t>(e)];
      part.elements.push_back(e);
      part.data.tetrahedra.push_back(corners);
      for (const auto n : corners) number[static_cast<std::size_t>(n)] = 0;
      if (whole.edges.empty()) continue;
      part.data.edges.push_back(whole.edges[static_cast<std::size_t>(e)]);
      for (const auto n : part.data.edges.back()) number[static_cast<std::size_t>(n)] = 0;
    }
    part.data.regions.push_back({region.name, kind, first, std::ssize(part.elements)});
  }
}

void take_fields(const MeshData& whole, Submesh& part) {
  for (const auto& field : whole.fields) {
    auto& taken = part.data.fields.emplace_back(ElementField{field.name, field.components, {}});
    for (const auto e : part.elements)
      for (int c = 0; c < field.components; ++c)
        taken.values.push_back(field.values[static_cast<std::size_t>(e * field.components + c)]);
  }
}

}  // namespace

Submesh submesh(const MeshData& whole, RegionKind kind) {
  Submesh part;
  std::vector<Index> number(whole.points.size(), -1);
  take_elements(whole, kind, part, number);
  for (std::size_t n = 0; n < number.size(); ++n) {
    if (number[n] < 0) continue;
    number[n] = std::ssize(part.nodes);
    part.nodes.push_back(static_cast<Index>(n));
    part.data.points.push_back(whole.points[n]);
  }
  const auto renumber = [&](auto& cells) {
    for (auto& nodes : cells)
      for (auto& n : nodes) n = number[static_cast<std::size_t>(n)];
  };
  renumber(part.data.tetrahedra);
  renumber(part.data.edges);
  std::vector<std::int32_t> region_of(whole.regions.size(), -1);
  for (std::size_t r = 0, next = 0; r < whole.regions.size(); ++r)
    if (whole.regions[r].kind == kind) region_of[r] = static_cast<std::int32_t>(next++);
  for (auto face : whole.faces) {
    if (region_of[static_cast<std::size_t>(face.region)] < 0) continue;
    face.region = region_of[static_cast<std::size_t>(face.region)];
    renumber(face.triangles);
    renumber(face.edges);
    part.data.faces.push_back(std::move(face));
  }
  take_fields(whole, part);
  for (const auto& field : whole.node_fields) {
    auto& taken = part.data.node_fields.emplace_back(NodeField{field.name, {}});
    for (const auto n : part.nodes) taken.values.push_back(field.values[static_cast<std::size_t>(n)]);
  }
  return part;
}

}  // namespace tunica::mesh
