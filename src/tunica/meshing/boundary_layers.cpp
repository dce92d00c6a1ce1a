#include "tunica/meshing/boundary_layers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tunica/base/error.hpp"
#include "tunica/mesh/boundary.hpp"
#include "tunica/meshing/local_mesh.hpp"

namespace tunica::meshing {

namespace {

using Nodes = std::array<geometry::Index, 3>;

/// The interface as the lumen sees it.
struct Interface {
  std::vector<Nodes> triangles;           ///< counter-clockwise from the wall
  std::vector<geometry::Index> nodes;     ///< ascending
  std::vector<geometry::Index> position;  ///< of each node of the mesh in `nodes`; -1: not on the interface
  std::vector<Vec3<double>> inward;       ///< unit, into the lumen; at openings within their plane
  std::vector<double> nearest;            ///< shortest edge at each node [m]
};

void unify(Vec3<double>& v) {
  if (const double length = norm(v); length > 0) v = (1 / length) * v;
}

/// Unit vector along `v` without its part along `normal`, which is unit or zero.
Vec3<double> within(const Vec3<double>& normal, const Vec3<double>& v) {
  auto result = v - dot(v, normal) * normal;
  unify(result);
  return result;
}

/// On rims of tears the mean normal may point away from one of the triangles: turns it towards the worst one, over and
/// over, until it sees all of them.
void face_all_triangles(const geometry::Tetrahedra& mesh, const std::vector<Vec3<double>>& cap, Interface& interface) {
  std::vector<std::vector<Vec3<double>>> around(interface.nodes.size());
  for (const auto& t : interface.triangles) {
    auto inward = -1.0 * mesh::area_vector(mesh.points, t);
    unify(inward);
    for (const auto n : t) around[interface.position[n]].push_back(inward);
  }
  constexpr int turns = 60;
  constexpr double enough = 0.5, step = 0.15;
  for (std::size_t i = 0; i < around.size(); ++i)
    for (int turn = 0; turn < turns; ++turn) {
      auto& direction = interface.inward[i];
      const auto worst = *std::min_element(
          around[i].begin(), around[i].end(),
          [&](const Vec3<double>& a, const Vec3<double>& b) { return dot(a, direction) < dot(b, direction); });
      if (dot(worst, direction) > enough) break;
      direction = within(cap[interface.nodes[i]], direction + step * worst);
    }
}

Interface find_interface(const geometry::Tetrahedra& mesh) {
  Interface result;
  result.position.assign(mesh.points.size(), -1);
  std::vector<Vec3<double>> normal(mesh.points.size(), {{0, 0, 0}}), cap(mesh.points.size(), {{0, 0, 0}});
  for (const auto& t : geometry::surface_triangles(mesh)) {
    if (t.label != geometry::lumen_label) continue;
    const auto area = mesh::area_vector(mesh.points, t.nodes);
    if (t.neighbour_label != geometry::wall_label) {
      for (const auto n : t.nodes) cap[n] = cap[n] + area;
      continue;
    }
    result.triangles.push_back(t.nodes);
    for (const auto n : t.nodes) {
      normal[n] = normal[n] + area;
      result.position[n] = 0;
    }
  }
  for (geometry::Index n = 0; n < std::ssize(mesh.points); ++n) {
    if (result.position[n] < 0) continue;
    result.position[n] = std::ssize(result.nodes);
    result.nodes.push_back(n);
    unify(cap[n]);
    result.inward.push_back(within(cap[n], -1.0 * normal[n]));
  }
  face_all_triangles(mesh, cap, result);
  result.nearest.assign(result.nodes.size(), std::numeric_limits<double>::infinity());
  for (const auto& t : result.triangles)
    for (int k = 0; k < 3; ++k) {
      const double length = norm(mesh.points[t[k]] - mesh.points[t[(k + 1) % 3]]);
      for (const auto n : {t[k], t[(k + 1) % 3]})
        result.nearest[result.position[n]] = std::min(result.nearest[result.position[n]], length);
    }
  return result;
}

/// Places of the nodes within the layers: level 0 is the wall.
class Levels {
 public:
  Levels(const geometry::Tetrahedra& mesh, const Interface& interface, const BoundaryLayers& settings)
      : mesh_(mesh), interface_(interface) {
    double sum = 0, height = 1;
    for (int k = 0; k < settings.layers; ++k, height *= settings.growth) shares_.push_back(sum += height);
    for (auto& share : shares_) share /= sum;
    for (const double edge : interface.nearest) thickness.push_back(std::min(settings.thickness, 0.6 * edge));
  }
  int count() const { return static_cast<int>(shares_.size()); }
  geometry::Point place(geometry::Index node, int level) const {
    const auto i = interface_.position[node];
    if (level == 0 || i < 0) return mesh_.points[node];
    return mesh_.points[node] + (shares_[level - 1] * thickness[i]) * interface_.inward[i];
  }
  /// Of an upright prism on the triangle [m^3].
  double prism_volume(const Nodes& t, int level) const {
    double height = 0;
    for (const auto n : t) height += thickness[interface_.position[n]] / 3;
    return norm(mesh::area_vector(mesh_.points, t)) * height * (shares_[level] - (level > 0 ? shares_[level - 1] : 0));
  }
  std::vector<double> thickness;  ///< at each interface node [m]

 private:
  const geometry::Tetrahedra& mesh_;
  const Interface& interface_;
  std::vector<double> shares_;
};

double sine(const std::array<geometry::Point, 4>& x) { return worst_sine(x[0], x[1], x[2], x[3]); }

/// Three elements of a prism between two levels, cut so that neighbours agree: diagonals start at the smallest node of
/// the level nearer to the wall.
template <class Visit>
void split_prism(Nodes t, int level, const Visit& visit) {
  std::swap(t[1], t[2]);  // counter-clockwise from the lumen
  while (t[0] > t[1] || t[0] > t[2]) t = {t[1], t[2], t[0]};
  struct Corner {
    geometry::Index node;
    int level;
  };
  const Corner low[3] = {{t[0], level}, {t[1], level}, {t[2], level}};
  const Corner high[3] = {{t[0], level + 1}, {t[1], level + 1}, {t[2], level + 1}};
  const auto give = [&](Corner a, Corner b, Corner c, Corner d) { visit(std::array<Corner, 4>{a, b, c, d}); };
  give(low[0], high[1], high[2], high[0]);
  if (t[1] < t[2]) {
    give(low[0], low[1], low[2], high[2]);
    give(low[0], low[1], high[2], high[1]);
  } else {
    give(low[0], low[1], low[2], high[1]);
    give(low[0], low[2], high[2], high[1]);
  }
}

/// Lowers the thickness where elements or prisms would be bad; false when all are good.
bool lower_where_bad(const geometry::Tetrahedra& mesh, const Interface& interface, Levels& levels) {
  constexpr double finer = 0.8, least = 0.139, part = 0.5;  // sine of 8 degrees
  constexpr double flattest = 0.1;  // volume of an element over that of a third of an upright prism
  std::vector<bool> bad(interface.nodes.size(), false);
  const auto blame = [&](geometry::Index node) {
    if (const auto i = interface.position[node]; i >= 0) bad[i] = true;
  };
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const auto& t = mesh.elements[e];
    const auto on = [&](geometry::Index n) { return interface.position[n] >= 0; };
    if (mesh.labels[e] != geometry::lumen_label || std::none_of(t.begin(), t.end(), on)) continue;
    std::array<geometry::Point, 4> before, after;
    for (int k = 0; k < 4; ++k) {
      before[k] = mesh.points[t[k]];
      after[k] = levels.place(t[k], levels.count());
    }
    if (sine(after) < std::min(least, part * sine(before)))
      for (const auto n : t) blame(n);
  }
  for (const auto& t : interface.triangles)
    for (int level = 0; level < levels.count(); ++level)
      split_prism(t, level, [&](const auto& corners) {
        std::array<geometry::Point, 4> x;
        for (int k = 0; k < 4; ++k) x[k] = levels.place(corners[k].node, corners[k].level);
        const double volume = dot(cross(x[1] - x[0], x[2] - x[0]), x[3] - x[0]) / 6;
        if (volume < flattest * levels.prism_volume(t, level) / 3)
          for (const auto n : t) blame(n);
      });
  // Layers thin out gradually.
  constexpr double steepest = 0.3;
  for (std::size_t i = 0; i < bad.size(); ++i)
    if (bad[i]) levels.thickness[i] *= finer;
  for (const auto& t : interface.triangles)
    for (int k = 0; k < 3; ++k) {
      const geometry::Index a = t[k], b = t[(k + 1) % 3];
      double &ha = levels.thickness[interface.position[a]], &hb = levels.thickness[interface.position[b]];
      const double change = steepest * norm(mesh.points[a] - mesh.points[b]);
      ha = std::min(ha, hb + change);
      hb = std::min(hb, ha + change);
    }
  return std::find(bad.begin(), bad.end(), true) != bad.end();
}

void insert(geometry::Tetrahedra& mesh, const Interface& interface, const Levels& levels) {
  const auto first = std::ssize(mesh.points), nodes = std::ssize(interface.nodes);
  const auto number = [&](geometry::Index node, int level) {
    const auto i = interface.position[node];
    return level == 0 || i < 0 ? node : first + (level - 1) * nodes + i;
  };
  std::vector<geometry::Point> points;
  for (int level = 1; level <= levels.count(); ++level)
    for (const auto n : interface.nodes) {
      points.push_back(levels.place(n, level));
      mesh.on_curve.push_back(false);
    }
  mesh.points.insert(mesh.points.end(), points.begin(), points.end());
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    if (mesh.labels[e] == geometry::lumen_label)
      for (auto& n : mesh.elements[e]) n = number(n, levels.count());
  for (const auto& t : interface.triangles)
    for (int level = 0; level < levels.count(); ++level)
      split_prism(t, level, [&](const auto& corners) {
        auto& element = mesh.elements.emplace_back();
        for (int k = 0; k < 4; ++k) element[k] = number(corners[k].node, corners[k].level);
        mesh.labels.push_back(geometry::lumen_label);
      });
}

}  // namespace

config::Schema<BoundaryLayers> BoundaryLayers::schema() {
  using B = BoundaryLayers;
  return config::Schema<B>("boundary_layers",
                           "Layers of thin elements at the wall of the lumen; thinner where the lumen is narrow.")
      .integer("layers", &B::layers, config::range(1, 10), "How many")
      .by_default()
      .quantity("thickness", &B::thickness, config::dimension::length, config::range(0.01e-3, 5e-3),
                "Of all layers together, at most; 0.6 of the shortest edge nearby bounds it, too")
      .by_default()
      .number("growth", &B::growth, config::range(1, 3), "Thickness of a layer over that of the one nearer to the wall")
      .by_default();
}

MadeLayers add_boundary_layers(geometry::Tetrahedra& mesh, const BoundaryLayers& settings) {
  const auto interface = find_interface(mesh);
  Levels levels(mesh, interface, settings);
  constexpr int most = 40;
  for (int round = 0; lower_where_bad(mesh, interface, levels); ++round)
    if (round == most) {
      const auto thinnest = std::min_element(levels.thickness.begin(), levels.thickness.end());
      const geometry::Point& p = mesh.points[interface.nodes[thinnest - levels.thickness.begin()]];
      throw SolverError(fmt::format("meshing: no boundary layer fits at {}; mesh finer, or ask for none",
                                    geometry::list_places_mm(std::span(&p, 1))));
    }
  insert(mesh, interface, levels);
  auto sorted = levels.thickness;
  std::sort(sorted.begin(), sorted.end());
  return {sorted.front(), sorted[sorted.size() / 2], sorted.back()};
}

}  // namespace tunica::meshing
