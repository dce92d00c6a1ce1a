#include "tunica/analysis/anatomy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tunica/base/limits.hpp"
#include "tunica/mesh/boundary.hpp"

namespace tunica::analysis {

namespace {

using base::nan;
/// What bends on shorter lengths is taken for noise of the centroids, as at the mouths of branches.
constexpr double line_smoothing = 60e-3;

enum Part { true_lumen, false_lumen, flap_part, wall_part };

using Flat = std::array<double, 2>;  ///< in the plane of a section, along e1 and e2 [m]

struct FlatPolygon {
  Part part;
  std::vector<Flat> corners;
};

double direction(int k) { return 2 * M_PI * k / section_directions; }

// --- the mesh along the line ----------------------------------------------------------------------------------------

/// Elements of the aorta with their arc lengths.
class CutMesh {
 public:
  CutMesh(const mesh::MeshData& data, const Vessel& vessel, const AortaParts& parts, const AortaLine& line,
          const std::string& flap)
      : data_(data), vessel_(vessel), line_(line), nodes_(data.points.size(), LineCoordinates{.radius = INFINITY}) {
    for (std::size_t e = 0; e < data.tetrahedra.size(); ++e)
      if (parts.in_aorta[e] != 0)
        for (const auto node : data.tetrahedra[e])
          if (std::isinf(nodes_[at(node)].radius)) nodes_[at(node)] = line.coordinates(data.points[at(node)]);
    for (const auto& region : data.regions)
      for (auto e = region.first_element; e < region.end_element; ++e) {
        if (parts.in_aorta[at(e)] == 0) continue;
        elements_.push_back(e);
        const bool lumen = region.kind == mesh::RegionKind::lumen;
        parts_.push_back(lumen ? true_lumen : region.name == flap ? flap_part : wall_part);
      }
  }

  const std::vector<LineCoordinates>& nodes() const { return nodes_; }
  std::array<double, 4> arcs(std::int64_t e) const {
    std::array<double, 4> s;
    for (int a = 0; a < 4; ++a) s[a] = nodes_[at(data_.tetrahedra[at(e)][a])].s;
    return s;
  }

  std::vector<FlatPolygon> section(double s) const {
    const auto frame = line_.frame(s);
    std::vector<FlatPolygon> polygons;
    for (std::size_t k = 0; k < elements_.size(); ++k) {
      auto values = arcs(elements_[k]);
      const auto [low, high] = std::minmax_element(values.begin(), values.end());
      if (*low > s || *high <= s || *high - *low > longest) continue;
      const auto cut = cut_element(values, s);
      const auto& nodes = data_.tetrahedra[at(elements_[k])];
      if (parts_[k] != true_lumen || vessel_.side.empty()) {
        add(frame, nodes, cut, parts_[k], polygons);
        continue;
      }
      const auto side = values_at(vessel_.side, nodes);
      add(frame, nodes, clip(cut, side, true), true_lumen, polygons);
      add(frame, nodes, clip(cut, side, false), false_lumen, polygons);
    }
    return polygons;
  }

 private:
  /// Beyond the centre of a bend neighbours can be far apart along the line.
  static constexpr double longest = 30e-3;

  void add(const LineFrame& frame, const Element& nodes, const Polygon& polygon, Part part,
           std::vector<FlatPolygon>& all) const {
    if (polygon.size() < 3) return;
    FlatPolygon flat{part, {}};
    for (const auto& b : polygon) {
      Vec3<double> x{{0, 0, 0}};
      for (int a = 0; a < 4; ++a) x = x + b[a] * data_.points[at(nodes[a])];
      flat.corners.push_back({dot(x - frame.origin, frame.e1), dot(x - frame.origin, frame.e2)});
    }
    all.push_back(std::move(flat));
  }

  const mesh::MeshData& data_;
  const Vessel& vessel_;
  const AortaLine& line_;
  std::vector<LineCoordinates> nodes_;
  std::vector<std::int64_t> elements_;
  std::vector<Part> parts_;
};

// --- figures of a section -------------------------------------------------------------------------------------------

struct Moments {
  double area = 0, x = 0, y = 0;  ///< x and y times the area
  Flat centroid() const { return {x / area, y / area}; }
};

Moments moments(const std::vector<FlatPolygon>& polygons, std::initializer_list<Part> parts) {
  Moments m;
  for (const auto& p : polygons) {
    if (std::find(parts.begin(), parts.end(), p.part) == parts.end()) continue;
    for (std::size_t k = 2; k < p.corners.size(); ++k) {
      const auto &a = p.corners[0], &b = p.corners[k - 1], &c = p.corners[k];
      const double area = 0.5 * std::abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
      m.area += area;
      m.x += area * (a[0] + b[0] + c[0]) / 3;
      m.y += area * (a[1] + b[1] + c[1]) / 3;
    }
  }
  return m;
}

/// Farthest point of a polygon on the ray from the origin in direction (c, s); below 0 where it misses.
double farthest(const std::vector<Flat>& corners, double c, double s) {
  double far = -1;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const auto &a = corners[k], &b = corners[(k + 1) % corners.size()];
    const double at_a = c * a[1] - s * a[0], at_b = c * b[1] - s * b[0];  // across the ray
    if ((at_a > 0) == (at_b > 0)) continue;
    const double t = at_a / (at_a - at_b);
    far = std::max(far, c * (a[0] + t * (b[0] - a[0])) + s * (a[1] + t * (b[1] - a[1])));
  }
  return far;
}

/// Entries below 0 take the mean of the nearest others to both sides.
void fill_gaps(std::vector<double>& radii) {
  const auto given = radii;
  const int n = static_cast<int>(radii.size());
  if (std::all_of(given.begin(), given.end(), [](double r) { return r < 0; })) return;
  for (int k = 0; k < n; ++k) {
    if (given[k] >= 0) continue;
    int before = 1, after = 1;
    while (given[(k - before + n) % n] < 0) ++before;
    while (given[(k + after) % n] < 0) ++after;
    radii[k] = (after * given[(k - before + n) % n] + before * given[(k + after) % n]) / (before + after);
  }
}

/// Farthest points of these parts by direction; below 0 where there are none.
std::vector<double> reach(const std::vector<FlatPolygon>& polygons, std::initializer_list<Part> parts) {
  std::vector<double> radii;
  for (int k = 0; k < section_directions; ++k) {
    const double c = std::cos(direction(k)), s = std::sin(direction(k));
    double far = -1;
    for (const auto& p : polygons)
      if (std::find(parts.begin(), parts.end(), p.part) != parts.end()) far = std::max(far, farthest(p.corners, c, s));
    radii.push_back(far);
  }
  return radii;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Edge of the wall, and of the lumens together with the flap: where that grows out of the wall, its root counts no
/// farther out than the wall is thick.
void find_edges(const std::vector<FlatPolygon>& polygons, AortaSection& section) {
  section.inner = reach(polygons, {true_lumen, false_lumen});
  fill_gaps(section.inner);
  section.outer = reach(polygons, {true_lumen, false_lumen, flap_part, wall_part});
  fill_gaps(section.outer);
  const auto flap = reach(polygons, {flap_part});
  std::vector<double> thickness;
  for (int k = 0; k < section_directions; ++k) thickness.push_back(section.outer[k] - section.inner[k]);
  const double usual = median(thickness);
  for (int k = 0; k < section_directions; ++k)
    section.inner[k] = std::max(section.inner[k], std::min(flap[k], section.outer[k] - usual));
}

double area_within(const std::vector<double>& radii) {
  // Triangles between neighbouring directions.
  double area = 0;
  for (std::size_t k = 0; k < radii.size(); ++k)
    area += 0.5 * radii[k] * radii[(k + 1) % radii.size()] * std::sin(2 * M_PI / section_directions);
  return area;
}

Flat centroid_within(const std::vector<double>& radii) {
  double area = 0, x = 0, y = 0;
  for (int k = 0; k < section_directions; ++k) {
    const double r2 = radii[k] * radii[k] / 2, r3 = radii[k] * radii[k] * radii[k] / 3;
    area += r2;
    x += r3 * std::cos(direction(k));
    y += r3 * std::sin(direction(k));
  }
  return area > 0 ? Flat{x / area, y / area} : Flat{0, 0};
}

double widest(const std::vector<double>& radii) {
  double widest = 0;
  for (int a = 0; a < section_directions; ++a)
    for (int b = 0; b < a; ++b)
      widest = std::max(widest, std::hypot(radii[a] * std::cos(direction(a)) - radii[b] * std::cos(direction(b)),
                                           radii[a] * std::sin(direction(a)) - radii[b] * std::sin(direction(b))));
  return widest;
}

void measure_wall(AortaSection& section) {
  double sum = 0, least = INFINITY;
  int count = 0;
  for (int k = 0; k < section_directions; ++k) {
    const double thickness = section.outer[k] - section.inner[k];
    if (!(thickness > 0)) continue;  // in the mouth of a branch
    sum += thickness;
    least = std::min(least, thickness);
    ++count;
  }
  section.wall_thickness = count > 0 ? sum / count : nan;
  section.least_wall_thickness = count > 0 ? least : nan;
}

void measure_flap(const std::vector<FlatPolygon>& polygons, AortaSection& section) {
  const auto flap = moments(polygons, {flap_part}), in_true = moments(polygons, {true_lumen}),
             in_false = moments(polygons, {false_lumen});
  section.flap_area = flap.area;
  section.flap_position = nan;
  if (!(flap.area > 0 && in_true.area > 0 && in_false.area > 0)) return;
  const auto f = flap.centroid(), t = in_true.centroid(), o = in_false.centroid(), c = centroid_within(section.inner);
  const double x = t[0] - o[0], y = t[1] - o[1];
  section.flap_position = ((f[0] - c[0]) * x + (f[1] - c[1]) * y) / std::hypot(x, y);
}

AortaSection measure(const std::vector<FlatPolygon>& polygons, double s) {
  constexpr double least_share = 0.01;  // of a section that is a lumen
  AortaSection section{.s = s};
  find_edges(polygons, section);
  section.lumen_area = {moments(polygons, {true_lumen}).area, moments(polygons, {false_lumen}).area};
  const double total = section.lumen_area[0] + section.lumen_area[1];
  for (auto& area : section.lumen_area)
    if (area < least_share * total) area = 0;
  section.diameter = std::sqrt(4 * area_within(section.inner) / M_PI);
  section.largest_diameter = widest(section.inner);
  measure_wall(section);
  measure_flap(polygons, section);
  return section;
}

// --- the whole ------------------------------------------------------------------------------------------------------

/// The ends of the line lie in the planes of the openings, where a section is ragged.
double place_of_section(double s, double length) {
  constexpr double margin = 1e-3;
  return std::clamp(s, margin, length - margin);
}

std::vector<AortaSection> measure_all(const CutMesh& mesh, const AortaLine& line, double spacing) {
  const auto count = static_cast<int>(std::lround(line.length() / spacing));
  std::vector<AortaSection> sections;
  for (int k = 0; k <= count; ++k) {
    const double s = line.length() * k / count;
    sections.push_back(measure(mesh.section(place_of_section(s, line.length())), s));
  }
  return sections;
}

/// Through the centroids of the edges of the lumens, which know nothing of how the flap lies.
std::vector<Vec3<double>> centroids(const std::vector<AortaSection>& sections, const AortaLine& line) {
  std::vector<Vec3<double>> places;
  for (const auto& section : sections) {
    const auto f = line.frame(place_of_section(section.s, line.length()));
    const auto c = centroid_within(section.inner);
    places.push_back(f.origin + c[0] * f.e1 + c[1] * f.e2);
  }
  return places;
}

/// Place at a distance along the centres of the stations.
Vec3<double> centre_at(const Vessel& vessel, double distance) {
  const auto& stations = vessel.stations;
  for (std::size_t k = 1; k < stations.size(); ++k) {
    if (stations[k].distance < distance) continue;
    const double t = (distance - stations[k - 1].distance) / (stations[k].distance - stations[k - 1].distance);
    return stations[k - 1].centre + t * (stations[k].centre - stations[k - 1].centre);
  }
  return stations.back().centre;
}

double bilinear(const std::vector<AortaSection>& sections, std::vector<double> AortaSection::*radii, double s,
                double angle) {
  const double step = sections[1].s - sections[0].s;
  const double x = std::clamp(s / step, 0.0, static_cast<double>(sections.size() - 1));
  const auto k = std::min(static_cast<std::size_t>(x), sections.size() - 2);
  const double t = x - static_cast<double>(k);
  double y = angle / (2 * M_PI) * section_directions;
  y -= section_directions * std::floor(y / section_directions);
  const int a = static_cast<int>(y) % section_directions, b = (a + 1) % section_directions;
  const double u = y - std::floor(y);
  const auto at_section = [&](const AortaSection& section) {
    return (1 - u) * (section.*radii)[static_cast<std::size_t>(a)] + u * (section.*radii)[static_cast<std::size_t>(b)];
  };
  return (1 - t) * at_section(sections[k]) + t * at_section(sections[k + 1]);
}

void add_pieces(const mesh::MeshData& data, const Vessel& vessel, const AortaParts& parts, const CutMesh& mesh,
                Anatomy& anatomy) {
  const auto* lumen = lumen_region(data);
  for (auto e = lumen->first_element; e < lumen->end_element; ++e) {
    if (parts.in_aorta[at(e)] == 0) continue;
    const double share = vessel.false_share.empty() ? 0 : vessel.false_share[at(e - lumen->first_element)];
    anatomy.pieces.push_back({mesh.arcs(e), mesh::volume(data.points, data.tetrahedra[at(e)]), share});
  }
}

}  // namespace

double Anatomy::inner_radius(double s, double angle) const {
  return bilinear(sections, &AortaSection::inner, s, angle);
}
double Anatomy::outer_radius(double s, double angle) const {
  return bilinear(sections, &AortaSection::outer, s, angle);
}

AortaSection Anatomy::at(double s) const {
  const double x = std::clamp(s / (sections[1].s - sections[0].s), 0.0, static_cast<double>(sections.size() - 1));
  const auto k = std::min(static_cast<std::size_t>(x), sections.size() - 2);
  const double t = x - static_cast<double>(k);
  const auto &a = sections[k], &b = sections[k + 1];
  // What one of the two does not have counts only where the other is met exactly.
  const auto mixed = [&](double at_a, double at_b) {
    return t == 0 ? at_a : t == 1 ? at_b : (1 - t) * at_a + t * at_b;
  };
  return {.s = s,
          .lumen_area = {mixed(a.lumen_area[0], b.lumen_area[0]), mixed(a.lumen_area[1], b.lumen_area[1])},
          .flap_area = mixed(a.flap_area, b.flap_area),
          .diameter = mixed(a.diameter, b.diameter),
          .largest_diameter = mixed(a.largest_diameter, b.largest_diameter),
          .wall_thickness = mixed(a.wall_thickness, b.wall_thickness),
          .least_wall_thickness = mixed(a.least_wall_thickness, b.least_wall_thickness),
          .flap_position = mixed(a.flap_position, b.flap_position)};
}

std::array<double, 2> Anatomy::volume(double from, double to) const {
  std::array<double, 2> sum{};
  const auto below = [](std::array<double, 4> s, double limit) {
    for (auto& v : s) v -= limit;
    return negative_share(s);
  };
  for (const auto& piece : pieces) {
    const auto [low, high] = std::minmax_element(piece.s.begin(), piece.s.end());
    if (*high <= from || *low >= to) continue;
    const double within = piece.volume * (below(piece.s, to) - below(piece.s, from));
    sum[0] += (1 - piece.false_share) * within;
    sum[1] += piece.false_share * within;
  }
  return sum;
}

Anatomy make_anatomy(const mesh::MeshData& data, const Vessel& vessel, double spacing, const std::string& flap) {
  const auto parts = aorta_parts(data, vessel);
  AortaLine line(parts.centres, spacing, line_smoothing);
  {
    const CutMesh first(data, vessel, parts, line, flap);
    line = AortaLine(centroids(measure_all(first, line, spacing), line), spacing, line_smoothing);
  }
  const CutMesh mesh(data, vessel, parts, line, flap);
  Anatomy anatomy{.line = line,
                  .two_lumens = !vessel.side.empty(),
                  .wall = std::any_of(data.regions.begin(), data.regions.end(),
                                      [](const auto& r) { return r.kind == mesh::RegionKind::wall; }),
                  .sections = measure_all(mesh, line, spacing),
                  .landmarks = {},
                  .tears = {},
                  .pieces = {},
                  .in_aorta = parts.in_aorta,
                  .nodes = mesh.nodes()};
  for (const auto& origin : parts.origins) {
    const double s = line.coordinates(centre_at(vessel, origin.distance)).s;
    const auto f = line.frame(s);
    const auto away = origin.centre - f.origin;
    anatomy.landmarks.push_back({origin.opening, s, std::atan2(dot(away, f.e2), dot(away, f.e1)), origin.centre});
  }
  std::stable_sort(anatomy.landmarks.begin(), anatomy.landmarks.end(),
                   [](const auto& a, const auto& b) { return a.s < b.s; });
  for (const auto& tear : vessel.tears)
    anatomy.tears.push_back({tear.name, line.coordinates(tear.centre).s, tear.area, tear.centre});
  add_pieces(data, vessel, parts, mesh, anatomy);
  return anatomy;
}

}  // namespace tunica::analysis
