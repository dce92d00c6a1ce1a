#include "tunica/analysis/aorta_parts.hpp"

#include <algorithm>
#include <map>
#include <queue>
#include <set>

#include "tunica/mesh/boundary.hpp"

namespace tunica::analysis {

namespace {

using Nodes = std::vector<std::int64_t>;

/// Elements of the lumen that a section cuts.
std::vector<std::uint8_t> cut_elements(const mesh::MeshData& data, const Vessel& vessel) {
  std::set<Element> cut;
  for (const auto& station : vessel.stations)
    for (const auto& section : station.sections)
      for (const auto& triangle : section) cut.insert(triangle.nodes);
  std::vector<std::uint8_t> result(data.tetrahedra.size(), 0);
  const auto* lumen = lumen_region(data);
  for (auto e = lumen->first_element; e < lumen->end_element; ++e)
    result[at(e)] = cut.contains(data.tetrahedra[at(e)]) ? 1 : 0;
  return result;
}

/// The number of the face at an opening other than inlet and end, for each of its nodes; -1 elsewhere.
std::vector<int> branch_of_node(const mesh::MeshData& data, const Vessel& vessel) {
  std::vector<int> branch(data.points.size(), -1);
  for (const auto& opening : vessel.openings)
    if (opening.face != vessel.inlet && opening.face != vessel.end)
      for (const auto& t : data.faces[opening.face].triangles)
        for (const auto node : t) branch[at(node)] = static_cast<int>(opening.face);
  return branch;
}

/// Of each element of the lumen: the face at the end of its branch, -1 in the aorta; 0 of elements of the wall.
std::vector<int> lumen_parts(const mesh::MeshData& data, const Vessel& vessel) {
  const auto cut = cut_elements(data, vessel);
  const auto of_node = branch_of_node(data, vessel);
  const auto* lumen = lumen_region(data);
  std::vector<std::int64_t> rest;
  std::vector<Element> elements;
  for (auto e = lumen->first_element; e < lumen->end_element; ++e)
    if (cut[at(e)] == 0) {
      rest.push_back(e);
      elements.push_back(data.tetrahedra[at(e)]);
    }
  const auto group = connected_groups(elements);
  std::map<int, int> end_of_group;
  for (std::size_t k = 0; k < elements.size(); ++k)
    for (const auto node : elements[k])
      if (of_node[at(node)] >= 0) end_of_group[group[k]] = of_node[at(node)];
  std::vector<int> part(data.tetrahedra.size(), -1);
  for (std::size_t k = 0; k < rest.size(); ++k)
    if (const auto end = end_of_group.find(group[k]); end != end_of_group.end()) part[at(rest[k])] = end->second;
  return part;
}

/// Twins as one: the node of the lumen.
Nodes hosts(const mesh::MeshData& data) {
  Nodes host(data.points.size());
  for (std::size_t n = 0; n < host.size(); ++n) host[n] = static_cast<std::int64_t>(n);
  for (const auto& [wall, lumen] : data.twins) host[at(wall)] = lumen;
  return host;
}

/// Elements of the wall take the part of the lumen that fewest elements lie between.
void spread_to_walls(const mesh::MeshData& data, std::vector<int>& part) {
  const auto host = hosts(data);
  const auto* lumen = lumen_region(data);
  std::vector<std::vector<std::int64_t>> elements_of(data.points.size());
  for (std::size_t e = 0; e < data.tetrahedra.size(); ++e)
    for (const auto node : data.tetrahedra[e]) elements_of[at(host[at(node)])].push_back(static_cast<std::int64_t>(e));
  std::vector<std::uint8_t> known(data.tetrahedra.size(), 0);
  std::queue<std::int64_t> queue;
  for (auto e = lumen->first_element; e < lumen->end_element; ++e) {
    known[at(e)] = 1;
    queue.push(e);
  }
  while (!queue.empty()) {
    const auto e = queue.front();
    queue.pop();
    for (const auto node : data.tetrahedra[at(e)])
      for (const auto other : elements_of[at(host[at(node)])]) {
        if (known[at(other)] != 0) continue;
        known[at(other)] = 1;
        part[at(other)] = part[at(e)];
        queue.push(other);
      }
  }
}

/// Centre of the triangles between a branch and the aorta [m], by the face at the branch's end.
std::map<int, Vec3<double>> mouths(const mesh::MeshData& data, const std::vector<int>& part) {
  const auto* lumen = lumen_region(data);
  std::map<std::array<std::int64_t, 3>, int> open;  // sides of elements of branches
  const auto sides = [&](std::int64_t e, const auto& visit) {
    for (const auto& corners : mesh::tetrahedron_faces) {
      std::array<std::int64_t, 3> side;
      for (int i = 0; i < 3; ++i) side[i] = data.tetrahedra[at(e)][corners[i]];
      std::sort(side.begin(), side.end());
      visit(side);
    }
  };
  for (auto e = lumen->first_element; e < lumen->end_element; ++e)
    if (part[at(e)] >= 0) sides(e, [&](const auto& side) { open[side] = part[at(e)]; });
  std::map<int, std::pair<double, Vec3<double>>> sums;
  for (auto e = lumen->first_element; e < lumen->end_element; ++e) {
    if (part[at(e)] >= 0) continue;
    sides(e, [&](const auto& side) {
      const auto found = open.find(side);
      if (found == open.end()) return;
      const double area = norm(mesh::area_vector(data.points, side));
      auto& [total, sum] = sums.try_emplace(found->second, 0.0, Vec3<double>{{0, 0, 0}}).first->second;
      total += area;
      sum = sum + area * mesh::centroid(data.points, side);
    });
  }
  std::map<int, Vec3<double>> centres;
  for (const auto& [face, sum] : sums) centres[face] = (1 / sum.first) * sum.second;
  return centres;
}

/// Mean of the potential towards the end on each section.
std::vector<double> potential_at_stations(const mesh::MeshData& data, const Vessel& vessel) {
  std::vector<double> mean;
  for (const auto& station : vessel.stations) {
    double sum = 0, size = 0;
    for (const auto& section : station.sections) {
      const auto figures = evaluate(section, {.points = &data.points, .pressure = vessel.towards_end});
      sum += figures.size * figures.mean_pressure;
      size += figures.size;
    }
    mean.push_back(size > 0 ? sum / size : mean.empty() ? 0 : mean.back());
  }
  return mean;
}

/// Where the mean of the potential on the sections reaches a value.
double distance_of(double value, const std::vector<double>& mean, const Vessel& vessel) {
  for (std::size_t k = 1; k < mean.size(); ++k) {
    if (mean[k] < value) continue;
    const double t = mean[k] > mean[k - 1] ? std::clamp((value - mean[k - 1]) / (mean[k] - mean[k - 1]), 0.0, 1.0) : 0;
    return (1 - t) * vessel.stations[k - 1].distance + t * vessel.stations[k].distance;
  }
  return vessel.stations.back().distance;
}

double mean_on_face(const mesh::FaceData& face, const std::vector<double>& field) {
  double sum = 0;
  for (const auto& t : face.triangles)
    for (const auto node : t) sum += field[at(node)];
  return sum / (3.0 * static_cast<double>(face.triangles.size()));
}

}  // namespace

AortaParts aorta_parts(const mesh::MeshData& data, const Vessel& vessel) {
  AortaParts parts;
  auto part = lumen_parts(data, vessel);
  const auto mean = potential_at_stations(data, vessel);
  for (const auto& [face, centre] : mouths(data, part)) {
    const auto& end = data.faces[static_cast<std::size_t>(face)];
    parts.origins.push_back({end.name, distance_of(mean_on_face(end, vessel.towards_end), mean, vessel), centre});
  }
  std::sort(parts.origins.begin(), parts.origins.end(),
            [](const auto& a, const auto& b) { return a.distance < b.distance; });
  spread_to_walls(data, part);
  for (const int p : part) parts.in_aorta.push_back(p < 0 ? 1 : 0);
  for (const auto& station : vessel.stations) {
    const bool cut = !station.sections[0].empty() || !station.sections[1].empty();
    if (cut) parts.centres.push_back(station.centre);
  }
  return parts;
}

}  // namespace tunica::analysis
