#include "tunica/analysis/stations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <queue>

#include "tunica/base/error.hpp"
#include "tunica/mesh/boundary.hpp"

namespace tunica::analysis {

namespace {

constexpr int centreline_points = 300;
constexpr double least_share = 0.01;  ///< of a section that is a lumen
constexpr double sizeable = 0.2;      ///< share of the largest piece

/// Pieces of one lumen at one level.
struct Pieces {
  std::vector<Element> elements;
  std::vector<Polygon> polygons;
};

/// The pieces of each level and lumen: [level][lumen]. One pass over the elements, each of which meets few levels.
std::vector<std::array<Pieces, 2>> cut_levels(const mesh::MeshData& data, const Vessel& vessel,
                                              const std::vector<double>& levels) {
  std::vector<std::array<Pieces, 2>> result(levels.size());
  const auto* lumen = lumen_region(data);
  for (auto e = lumen->first_element; e < lumen->end_element; ++e) {
    const auto& nodes = data.tetrahedra[static_cast<std::size_t>(e)];
    const auto along = values_at(vessel.along, nodes);
    const auto [low, high] = std::minmax_element(along.begin(), along.end());
    const auto first = std::lower_bound(levels.begin(), levels.end(), *low);
    for (auto level = first; level != levels.end() && *level < *high; ++level) {
      auto& pieces = result[static_cast<std::size_t>(level - levels.begin())];
      const auto polygon = cut_element(along, *level);
      const auto add = [&](std::size_t which, const Polygon& part) {
        if (part.empty()) return;
        pieces[which].elements.push_back(nodes);
        pieces[which].polygons.push_back(part);
      };
      if (vessel.side.empty()) {
        add(0, polygon);
        continue;
      }
      const auto side = values_at(vessel.side, nodes);
      add(0, clip(polygon, side, true));
      add(1, clip(polygon, side, false));
    }
  }
  return result;
}

/// The connected piece that lies in the aorta. A branch that left upstream has pieces of the same value; among those of
/// a size the one nearest to the end counts.
std::vector<CutTriangle> piece_of_aorta(const mesh::MeshData& data, const Vessel& vessel, const Pieces& pieces) {
  const auto group = connected_groups(pieces.elements);
  std::map<int, std::vector<CutTriangle>> surfaces;
  for (std::size_t k = 0; k < group.size(); ++k)
    append_triangles(pieces.polygons[k], pieces.elements[k], values_at(vessel.along, pieces.elements[k]), data.points,
                     surfaces[group[k]]);
  std::map<int, SurfaceFigures> figures;
  double largest = 0;
  for (const auto& [number, surface] : surfaces) {
    // As the pressure on the surface: its mean is all that is asked for.
    figures[number] = evaluate(surface, {.points = &data.points, .pressure = vessel.towards_end});
    largest = std::max(largest, figures[number].size);
  }
  std::vector<CutTriangle> chosen;
  double nearest = -1;
  for (auto& [number, surface] : surfaces)
    if (figures[number].size >= sizeable * largest && figures[number].mean_pressure > nearest) {
      nearest = figures[number].mean_pressure;
      chosen = std::move(surface);
    }
  return chosen;
}

Station make_station(const mesh::MeshData& data, const Vessel& vessel, const std::array<Pieces, 2>& pieces) {
  Station station;
  std::array<SurfaceFigures, 2> figures;
  for (std::size_t k = 0; k < 2; ++k) {
    station.sections[k] = piece_of_aorta(data, vessel, pieces[k]);
    figures[k] = evaluate(station.sections[k], {.points = &data.points});
  }
  const double total = figures[0].size + figures[1].size;
  if (total == 0) return station;
  station.centre = (1 / total) * (figures[0].size * figures[0].centre + figures[1].size * figures[1].centre);
  for (std::size_t k = 0; k < 2; ++k)
    if (figures[k].size < least_share * total) station.sections[k].clear();
  return station;
}

std::vector<Station> stations_at(const mesh::MeshData& data, const Vessel& vessel, const std::vector<double>& levels) {
  std::vector<Station> stations;
  for (const auto& pieces : cut_levels(data, vessel, levels)) stations.push_back(make_station(data, vessel, pieces));
  return stations;
}

/// Value at the end of the aorta, where all of an opening have the same.
double end_value(const mesh::MeshData& data, const Vessel& vessel) {
  return vessel.along[static_cast<std::size_t>(data.faces[vessel.end].triangles[0][0])];
}

/// Values of the potential before the end of the aorta that share out the nodes of the lumen evenly.
std::vector<double> even_levels(const mesh::MeshData& data, const Vessel& vessel) {
  const auto& along = vessel.along;
  const double end = end_value(data, vessel);
  const auto* lumen = lumen_region(data);
  std::vector<std::int64_t> nodes;
  for (auto e = lumen->first_element; e < lumen->end_element; ++e)
    for (const auto node : data.tetrahedra[static_cast<std::size_t>(e)]) nodes.push_back(node);
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  std::vector<double> values;
  for (const auto node : nodes)
    if (const double v = along[static_cast<std::size_t>(node)]; v > 0 && v < end) values.push_back(v);
  std::sort(values.begin(), values.end());
  std::vector<double> levels;
  for (int k = 1; k <= centreline_points && !values.empty(); ++k) {
    // Off the value of any node, where a section would be ragged.
    const auto at = values.size() * static_cast<std::size_t>(k) / (centreline_points + 1);
    const double level = at + 1 < values.size() ? 0.5 * (values[at] + values[at + 1]) : values[at];
    if (levels.empty() || level > levels.back()) levels.push_back(level);
  }
  return levels;
}

Vec3<double> middle(const mesh::MeshData& data, std::size_t face) {
  Vec3<double> sum{{0, 0, 0}};
  double total = 0;
  for (const auto& t : data.faces[face].triangles) {
    const double area = norm(mesh::area_vector(data.points, t));
    sum = sum + area * mesh::centroid(data.points, t);
    total += area;
  }
  return (1 / total) * sum;
}

/// Length of the edges of the lumen's mesh from the nodes of a face to every node.
std::vector<double> distances_from(const mesh::MeshData& data, std::size_t face) {
  std::vector<std::vector<std::int64_t>> neighbours(data.points.size());
  const auto* lumen = lumen_region(data);
  for (auto e = lumen->first_element; e < lumen->end_element; ++e)
    for (const auto a : data.tetrahedra[static_cast<std::size_t>(e)])
      for (const auto b : data.tetrahedra[static_cast<std::size_t>(e)])
        if (a != b) neighbours[static_cast<std::size_t>(a)].push_back(b);
  std::vector<double> distance(data.points.size(), std::numeric_limits<double>::infinity());
  using Entry = std::pair<double, std::int64_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (const auto& t : data.faces[face].triangles)
    for (const auto node : t) {
      distance[static_cast<std::size_t>(node)] = 0;
      queue.emplace(0.0, node);
    }
  while (!queue.empty()) {
    const auto [d, node] = queue.top();
    queue.pop();
    if (d > distance[static_cast<std::size_t>(node)]) continue;
    for (const auto other : neighbours[static_cast<std::size_t>(node)]) {
      const double next =
          d + norm(data.points[static_cast<std::size_t>(other)] - data.points[static_cast<std::size_t>(node)]);
      if (next >= distance[static_cast<std::size_t>(other)]) continue;
      distance[static_cast<std::size_t>(other)] = next;
      queue.emplace(next, other);
    }
  }
  return distance;
}

}  // namespace

std::size_t farthest_opening(const mesh::MeshData& data, const Vessel& vessel) {
  const auto distance = distances_from(data, vessel.inlet);
  std::size_t farthest = vessel.inlet;
  double longest = 0;
  for (const auto& opening : vessel.openings) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& t : data.faces[opening.face].triangles)
      for (const auto node : t) nearest = std::min(nearest, distance[static_cast<std::size_t>(node)]);
    if (nearest > longest) {
      longest = nearest;
      farthest = opening.face;
    }
  }
  if (farthest == vessel.inlet)
    throw InputError("post.inlet", "the lumen has no other opening", "give a lumen with an inlet and an outlet");
  return farthest;
}

void turn_into_distances(const mesh::MeshData& data, Vessel& vessel) {
  // From the middle of the inlet through the centres of sections to the middle of the end.
  std::vector<double> potential{0}, length{0};
  Vec3<double> last = middle(data, vessel.inlet);
  const auto add = [&](double value, const Vec3<double>& centre) {
    potential.push_back(value);
    length.push_back(length.back() + norm(centre - last));
    last = centre;
  };
  const auto levels = even_levels(data, vessel);
  const auto line = stations_at(data, vessel, levels);
  for (std::size_t k = 0; k < levels.size(); ++k) add(levels[k], line[k].centre);
  add(end_value(data, vessel), middle(data, vessel.end));
  for (auto& value : vessel.along) {
    if (std::isnan(value)) continue;
    const auto above = std::upper_bound(potential.begin() + 1, potential.end() - 1, value);
    const auto k = static_cast<std::size_t>(above - potential.begin());
    const double t = (value - potential[k - 1]) / (potential[k] - potential[k - 1]);
    value = (1 - t) * length[k - 1] + t * length[k];
  }
}

std::vector<Station> make_stations(const mesh::MeshData& data, const Vessel& vessel, double spacing) {
  const double total = end_value(data, vessel);
  std::vector<double> distances;
  for (double s = spacing; s < total - 0.5 * spacing; s += spacing) distances.push_back(s);
  if (distances.empty())
    throw InputError("post.spacing", fmt::format("leaves no station on an aorta of {:.3g} mm", 1e3 * total),
                     "take a smaller one");
  auto stations = stations_at(data, vessel, distances);
  for (std::size_t k = 0; k < stations.size(); ++k) stations[k].distance = distances[k];
  std::erase_if(stations, [](const Station& s) { return s.sections[0].empty() && s.sections[1].empty(); });
  return stations;
}

}  // namespace tunica::analysis
