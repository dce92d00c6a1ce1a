#include "tunica/meshing/mesh_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <unordered_set>

#include "tunica/mesh/boundary.hpp"
#include "tunica/mesh/quality.hpp"

namespace tunica::meshing {

namespace {

constexpr int dihedral_bins = 15, ratio_bins = 10;
constexpr double dihedral_bin = 5;  // degrees

using Edge = std::array<geometry::Index, 2>;
using Triangle = std::array<geometry::Index, 3>;

Edge edge(geometry::Index a, geometry::Index b) { return a < b ? Edge{a, b} : Edge{b, a}; }

double area(const std::vector<geometry::Point>& points, const std::vector<Triangle>& triangles) {
  double sum = 0;
  for (const auto& t : triangles) sum += norm(mesh::area_vector(points, t));
  return sum;
}

void sort_unique(std::vector<Edge>& edges) {
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
}

nlohmann::json to_json(const Shapes& s) {
  return {{"elements", s.elements},
          {"smallest_dihedral_deg", s.smallest_dihedral},
          {"dihedral_of_worst_0.01_percent_deg", s.dihedral_quantile},
          {"dihedral_histogram_5_deg", s.dihedral_histogram},
          {"smallest_radius_ratio", s.smallest_radius_ratio},
          {"radius_ratio_histogram_0.1", s.radius_ratio_histogram},
          {"edge_mm",
           {{"shortest", s.shortest_edge * 1e3}, {"mean", s.mean_edge * 1e3}, {"longest", s.longest_edge * 1e3}}}};
}

double volume(const mesh::MeshData& data, const mesh::RegionData& region) {
  double sum = 0;
  for (auto e = region.first_element; e < region.end_element; ++e) sum += mesh::volume(data.points, data.tetrahedra[e]);
  return sum;
}

nlohmann::json to_json(const geometry::AcrossPart& part) {
  return {{"name", part.name},
          {"least", part.least},
          {"median", part.median},
          {"diameter_mm", part.diameter * 1e3},
          {"place_mm", {part.place[0] * 1e3, part.place[1] * 1e3, part.place[2] * 1e3}}};
}

/// The whole boundary of the regions of one kind.
std::vector<Triangle> boundary(const mesh::MeshData& data, mesh::RegionKind kind) {
  std::vector<Triangle> triangles;
  for (const auto& face : data.faces)
    if (data.regions[face.region].kind == kind)
      triangles.insert(triangles.end(), face.triangles.begin(), face.triangles.end());
  return triangles;
}

nlohmann::json to_json(const Topology& t) { return {{"parts", t.parts}, {"genus", t.genus}, {"manifold", t.manifold}}; }

/// Percentiles over the points of the lumen surface, of flap and wall.
nlohmann::json to_json(const geometry::Thickness& thickness) {
  std::map<std::string, std::vector<double>> values;
  for (std::size_t p = 0; p < thickness.value.size(); ++p)
    if (std::isfinite(thickness.value[p])) values[thickness.flap[p] ? "flap" : "wall"].push_back(thickness.value[p]);
  nlohmann::json result = nlohmann::json::object();
  for (auto& [name, list] : values) {
    std::sort(list.begin(), list.end());
    const auto at = [&, &all = list](double share) {
      return 1e3 * all[static_cast<std::size_t>(share * static_cast<double>(all.size() - 1))];
    };
    result[name] = {{"5_percent", at(0.05)}, {"median", at(0.5)}, {"95_percent", at(0.95)}};
  }
  return result;
}

/// Volumes and distances against the surfaces given.
nlohmann::json to_json(const Fidelity& fidelity, const mesh::MeshData& data) {
  double lumen = 0, wall = 0;
  for (const auto& region : data.regions)
    (region.kind == mesh::RegionKind::lumen ? lumen : wall) += volume(data, region);
  const auto percent = [](double is, double was) { return 100 * (is / was - 1); };
  return {{"lumen_volume_percent", percent(lumen, fidelity.lumen_volume)},
          {"wall_volume_percent", percent(wall, fidelity.wall_volume)},
          {"lumen_distance_mm", 1e3 * fidelity.lumen.largest_distance},
          {"lumen_distance_per_edge", fidelity.lumen.largest_per_edge},
          {"outer_distance_mm", 1e3 * fidelity.outer.largest_distance},
          {"outer_distance_per_edge", fidelity.outer.largest_per_edge}};
}

}  // namespace

Shapes shapes(const mesh::MeshData& data, geometry::Index first_element, geometry::Index end_element) {
  Shapes s;
  s.elements = end_element - first_element;
  s.dihedral_histogram.assign(dihedral_bins, 0);
  s.radius_ratio_histogram.assign(ratio_bins, 0);
  s.smallest_radius_ratio = 1;
  s.shortest_edge = 1e300;
  std::vector<double> dihedrals;
  double edge_sum = 0;
  for (auto e = first_element; e < end_element; ++e) {
    const auto& t = data.tetrahedra[e];
    const std::array<geometry::Point, 4> x = {data.points[t[0]], data.points[t[1]], data.points[t[2]],
                                              data.points[t[3]]};
    const auto q = mesh::quality(x);
    // An inverted element has no angle to speak of.
    dihedrals.push_back(q.volume > 0 ? q.smallest_dihedral : 0);
    const auto bin = [](double value, int bins) { return std::clamp(static_cast<int>(value), 0, bins - 1); };
    ++s.dihedral_histogram[bin(dihedrals.back() / dihedral_bin, dihedral_bins)];
    ++s.radius_ratio_histogram[bin(q.radius_ratio * ratio_bins, ratio_bins)];
    s.smallest_radius_ratio = std::min(s.smallest_radius_ratio, q.radius_ratio);
    for (int a = 0; a < 4; ++a)
      for (int b = a + 1; b < 4; ++b) {
        const double length = norm(x[a] - x[b]);
        edge_sum += length / 6;
        s.shortest_edge = std::min(s.shortest_edge, length);
        s.longest_edge = std::max(s.longest_edge, length);
      }
  }
  if (dihedrals.empty()) return s;
  s.mean_edge = edge_sum / static_cast<double>(s.elements);
  std::sort(dihedrals.begin(), dihedrals.end());
  s.smallest_dihedral = dihedrals.front();
  s.dihedral_quantile = dihedrals[dihedrals.size() / 10000];
  return s;
}

Topology topology(const std::vector<Triangle>& triangles) {
  std::map<geometry::Index, geometry::Index> parent;  // of each node, towards the representative of its part
  const auto find = [&](geometry::Index n) {
    while (parent[n] != n) n = parent[n] = parent[parent[n]];
    return n;
  };
  std::vector<Edge> edges;
  for (const auto& t : triangles) {
    for (const auto n : t) parent.emplace(n, n);
    parent[find(t[0])] = find(t[1]);
    parent[find(t[1])] = find(t[2]);
    for (int a = 0; a < 3; ++a) edges.push_back(edge(t[a], t[(a + 1) % 3]));
  }
  Topology result;
  std::sort(edges.begin(), edges.end());
  geometry::Index distinct = 0;
  for (std::size_t i = 0; i < edges.size(); ++distinct) {
    std::size_t j = i;
    while (j < edges.size() && edges[j] == edges[i]) ++j;
    result.manifold = result.manifold && j - i == 2;
    i = j;
  }
  for (const auto& [node, up] : parent)
    if (node == up) ++result.parts;
  const geometry::Index euler = std::ssize(parent) - distinct + std::ssize(triangles);
  result.genus = (2 * result.parts - euler) / 2;
  return result;
}

WallLayers wall_layers(const geometry::Tetrahedra& mesh, const std::vector<Triangle>& sides) {
  std::vector<bool> on_side(mesh.points.size(), false);
  std::vector<Edge> side_edges;
  for (const auto& t : sides)
    for (int a = 0; a < 3; ++a) {
      on_side[t[a]] = true;
      side_edges.push_back(edge(t[a], t[(a + 1) % 3]));
    }
  sort_unique(side_edges);
  WallLayers layers;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    if (mesh.labels[e] != geometry::wall_label) continue;
    const auto& t = mesh.elements[e];
    for (int a = 0; a < 4; ++a)
      for (int b = a + 1; b < 4; ++b)
        if (on_side[t[a]] && on_side[t[b]]) layers.bridges.push_back(edge(t[a], t[b]));
  }
  sort_unique(layers.bridges);
  std::erase_if(layers.bridges,
                [&](const Edge& e) { return std::binary_search(side_edges.begin(), side_edges.end(), e); });
  std::vector<bool> bridged(mesh.points.size(), false);
  for (const auto& e : layers.bridges) bridged[e[0]] = bridged[e[1]] = true;
  for (std::size_t n = 0; n < on_side.size(); ++n) {
    layers.surface_nodes += on_side[n];
    layers.bridged_nodes += bridged[n];
  }
  return layers;
}

nlohmann::json mesh_report(const ReportInput& input) {
  const auto& data = input.data;
  nlohmann::json report = {{"points", data.points.size() - data.twins.size()},
                           {"tetrahedra", data.tetrahedra.size()},
                           {"interface_nodes", data.twins.size()}};
  report["shapes"] = to_json(shapes(data, 0, std::ssize(data.tetrahedra)));
  for (const auto& region : data.regions) {
    auto entry = to_json(shapes(data, region.first_element, region.end_element));
    entry["name"] = region.name;
    entry["volume_ml"] = volume(data, region) * 1e6;
    report["regions"].push_back(std::move(entry));
  }
  for (const auto& face : data.faces)
    report["faces"].push_back({{"name", face.name},
                               {"triangles", face.triangles.size()},
                               {"area_mm2", area(data.points, face.triangles) * 1e6}});
  report["lumen_boundary"] = to_json(topology(boundary(data, mesh::RegionKind::lumen)));
  report["wall_boundary"] = to_json(topology(boundary(data, mesh::RegionKind::wall)));
  const auto& layers = input.layers;
  report["wall_one_element_thick_percent"] = 100.0 * static_cast<double>(layers.bridged_nodes) /
                                             static_cast<double>(std::max<geometry::Index>(1, layers.surface_nodes));
  report["fidelity"] = to_json(input.fidelity, data);
  report["thickness_mm"] = to_json(input.thickness);
  report["size"] = input.size;
  report["elements_across"] = nlohmann::json::array();
  for (const auto& part : input.across) report["elements_across"].push_back(to_json(part));
  const auto thin = geometry::too_few_across(input.across, geometry::enough_quadratic);
  report["too_few_across"] = thin ? *thin : "";
  report["tears"] = nlohmann::json::array();
  for (const auto& tear : input.tears)
    report["tears"].push_back({{"area_mm2", tear.area * 1e6},
                               {"centre_mm", {tear.centre[0] * 1e3, tear.centre[1] * 1e3, tear.centre[2] * 1e3}}});
  double total = 0;
  for (const auto& [phase, seconds] : input.seconds) {
    report["seconds"][phase] = seconds;
    total += seconds;
  }
  report["seconds"]["total"] = total;
  report["peak_memory_MB"] = input.peak_memory / 1e6;
  return report;
}

std::string report_text(const nlohmann::json& r) {
  std::string text = fmt::format("{} tetrahedra, {} points\n\n{:<20}{:>12}{:>12}{:>14}{:>16}{:>12}\n",
                                 r["tetrahedra"].get<geometry::Index>(), r["points"].get<geometry::Index>(), "region",
                                 "elements", "volume ml", "min dihedral", "0.01 % quantile", "mean edge");
  const auto line = [&](const std::string& name, const nlohmann::json& s, const std::string& volume) {
    text += fmt::format("{:<20}{:>12}{:>12}{:>13.2f}°{:>15.2f}°{:>9.3f} mm\n", name,
                        s["elements"].get<geometry::Index>(), volume, s["smallest_dihedral_deg"].get<double>(),
                        s["dihedral_of_worst_0.01_percent_deg"].get<double>(), s["edge_mm"]["mean"].get<double>());
  };
  for (const auto& region : r["regions"])
    line(region["name"], region, fmt::format("{:.2f}", region["volume_ml"].get<double>()));
  line("all", r["shapes"], "");
  text += "\nsmallest dihedral angle, elements in bins of 5°:";
  for (const auto& n : r["shapes"]["dihedral_histogram_5_deg"]) text += fmt::format(" {}", n.get<geometry::Index>());
  text += fmt::format("\n\n{:<32}{:>10}{:>14}\n", "face", "triangles", "area mm^2");
  for (const auto& face : r["faces"])
    text += fmt::format("{:<32}{:>10}{:>14.1f}\n", face["name"].get<std::string>(),
                        face["triangles"].get<geometry::Index>(), face["area_mm2"].get<double>());
  text += fmt::format("\nsize: {}\n{:<32}{:>8}{:>8}{:>14}\n", r["size"].get<std::string>(), "elements across", "least",
                      "median", "diameter mm");
  for (const auto& part : r["elements_across"])
    text += fmt::format("{:<32}{:>8.1f}{:>8.1f}{:>14.1f}\n", part["name"].get<std::string>(),
                        part["least"].get<double>(), part["median"].get<double>(), part["diameter_mm"].get<double>());
  if (const auto thin = r["too_few_across"].get<std::string>(); !thin.empty()) text += "warning: " + thin + "\n";
  const auto& lumen = r["lumen_boundary"];
  text +=
      fmt::format("\nlumen boundary: {} part(s), genus {}, {}\n", lumen["parts"].get<geometry::Index>(),
                  lumen["genus"].get<geometry::Index>(), lumen["manifold"].get<bool>() ? "manifold" : "not manifold");
  const auto& f = r["fidelity"];
  text += fmt::format(
      "against the surfaces given: lumen volume {:+.2f} %, wall volume {:+.2f} %; distance of the lumen surface up to "
      "{:.2f} mm or {:.2f} edge lengths, of the outer one {:.2f} mm or {:.2f}\n",
      f["lumen_volume_percent"].get<double>(), f["wall_volume_percent"].get<double>(),
      f["lumen_distance_mm"].get<double>(), f["lumen_distance_per_edge"].get<double>(),
      f["outer_distance_mm"].get<double>(), f["outer_distance_per_edge"].get<double>());
  text += "tears:";
  for (const auto& tear : r["tears"]) text += fmt::format(" {:.0f} mm^2;", tear["area_mm2"].get<double>());
  for (const auto& [name, values] : r["thickness_mm"].items())
    text += fmt::format(" {} {:.2f} mm thick (5 to 95 %: {:.2f} to {:.2f});", name, values["median"].get<double>(),
                        values["5_percent"].get<double>(), values["95_percent"].get<double>());
  text += fmt::format("\nwall only one element thick at {:.1f} % of its surface nodes\n",
                      r["wall_one_element_thick_percent"].get<double>());
  for (const auto& [phase, seconds] : r["seconds"].items())
    text += fmt::format("{}: {:.1f} s; ", phase, seconds.get<double>());
  text += fmt::format("peak memory {:.0f} MB\n", r["peak_memory_MB"].get<double>());
  return text;
}

}  // namespace tunica::meshing
