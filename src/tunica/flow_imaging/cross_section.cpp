#include "tunica/flow_imaging/cross_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "tunica/analysis/cuts.hpp"
#include "tunica/base/error.hpp"
#include "tunica/mesh/boundary.hpp"

namespace tunica::flow_imaging {

namespace {

using Edge = std::array<std::int64_t, 2>;

/// Centre, area and rim follow from points and triangles.
void complete(CrossSection& s) {
  std::map<std::array<std::int32_t, 2>, int> edges;
  s.area = 0;
  s.centre = {};
  for (const auto& t : s.triangles) {
    const double area = norm(mesh::area_vector(s.points, t));
    s.area += area;
    for (std::size_t i = 0; i < 3; ++i) {
      s.centre = s.centre + (area / 3) * s.points[static_cast<std::size_t>(t[i])];
      const auto [low, high] = std::minmax({t[i], t[(i + 1) % 3]});
      ++edges[{low, high}];
    }
  }
  if (s.area > 0) s.centre = (1 / s.area) * s.centre;
  for (const auto& [edge, count] : edges)
    if (count == 1) s.rim.push_back(edge);
}

/// One connected piece of the cut.
struct Piece {
  CrossSection section;
  std::map<Edge, std::int32_t> number;  ///< of the point on an edge of the mesh
};

std::int32_t point_on(Piece& piece, const mesh::MeshData& data, const std::array<std::int64_t, 4>& nodes,
                      const analysis::Barycentric& at) {
  Edge edge{-1, -1};
  Vec3<double> x{};
  for (std::size_t a = 0; a < 4; ++a) {
    if (at[a] == 0) continue;
    (edge[0] < 0 ? edge[0] : edge[1]) = nodes[a];
    x = x + at[a] * data.points[static_cast<std::size_t>(nodes[a])];
  }
  if (edge[1] < 0) edge[1] = edge[0];
  if (edge[0] > edge[1]) std::swap(edge[0], edge[1]);
  const auto [found, is_new] = piece.number.emplace(edge, static_cast<std::int32_t>(piece.section.points.size()));
  if (is_new) {
    const auto &a = data.points[static_cast<std::size_t>(edge[0])], &b = data.points[static_cast<std::size_t>(edge[1])];
    const double length = dot(b - a, b - a);
    piece.section.points.push_back(x);
    piece.section.on_mesh.push_back({edge[0], edge[1], length > 0 ? dot(x - a, b - a) / length : 0.0});
  }
  return found->second;
}

void add_polygon(Piece& piece, const mesh::MeshData& data, const std::array<std::int64_t, 4>& nodes,
                 const analysis::Polygon& polygon) {
  std::vector<std::int32_t> corners;
  for (const auto& at : polygon) corners.push_back(point_on(piece, data, nodes, at));
  for (std::size_t k = 2; k < corners.size(); ++k) {
    std::array<std::int32_t, 3> t{corners[0], corners[k - 1], corners[k]};
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    if (dot(mesh::area_vector(piece.section.points, t), piece.section.normal) < 0) std::swap(t[1], t[2]);
    piece.section.triangles.push_back(t);
  }
}

const mesh::RegionData* lumen_of(const mesh::MeshData& data) {
  for (const auto& region : data.regions)
    if (region.kind == mesh::RegionKind::lumen) return &region;
  return nullptr;
}

double distance_to(const CrossSection& s, const Vec3<double>& place) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& t : s.triangles) {
    Vec3<double> middle{};
    for (const auto n : t) middle = middle + (1.0 / 3) * s.points[static_cast<std::size_t>(n)];
    nearest = std::min(nearest, norm(middle - place));
  }
  return nearest;
}

double cross2(const std::array<double, 2>& a, const std::array<double, 2>& b, const std::array<double, 2>& p) {
  return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
}

}  // namespace

CrossSection plane_section(const mesh::MeshData& data, const Vec3<double>& centre, const Vec3<double>& normal,
                           const std::string& name, const std::string& where) {
  const auto in_mm = [](const Vec3<double>& x) {
    return fmt::format("({:.1f}, {:.1f}, {:.1f}) mm", 1e3 * x[0], 1e3 * x[1], 1e3 * x[2]);
  };
  const Vec3<double> n = (1 / norm(normal)) * normal;
  const auto* lumen = lumen_of(data);
  if (!lumen) throw InputError(where, "is a plane through a lumen, and the mesh has none", "give a mesh with a lumen");
  std::vector<analysis::Element> elements;
  std::vector<analysis::Polygon> polygons;
  for (auto e = lumen->first_element; e < lumen->end_element; ++e) {
    const auto& nodes = data.tetrahedra[static_cast<std::size_t>(e)];
    std::array<double, 4> heights;
    for (std::size_t a = 0; a < 4; ++a) heights[a] = dot(n, data.points[static_cast<std::size_t>(nodes[a])] - centre);
    auto polygon = analysis::cut_element(heights, 0);
    if (polygon.empty()) continue;
    elements.push_back(nodes);
    polygons.push_back(std::move(polygon));
  }
  if (elements.empty())
    throw InputError(where, fmt::format("the plane through {} misses the lumen", in_mm(centre)),
                     "give a centre inside the lumen, in the coordinates of the mesh");
  std::map<int, Piece> pieces;
  const auto group = analysis::connected_groups(elements);
  for (std::size_t k = 0; k < group.size(); ++k) {
    auto& piece = pieces[group[k]];
    piece.section.normal = n;
    add_polygon(piece, data, elements[k], polygons[k]);
  }
  double largest = 0;
  for (auto& [number, piece] : pieces) {
    complete(piece.section);
    largest = std::max(largest, piece.section.area);
  }
  CrossSection* nearest = nullptr;
  double distance = std::numeric_limits<double>::infinity();
  for (auto& [number, piece] : pieces) {
    if (piece.section.area < 1e-3 * largest) continue;
    if (const double d = distance_to(piece.section, centre); d < distance) {
      distance = d;
      nearest = &piece.section;
    }
  }
  if (!nearest || distance > 2 * std::sqrt(nearest->area / M_PI))
    throw InputError(
        where,
        fmt::format("its centre {} lies {:.1f} mm away from the lumen in that plane", in_mm(centre), 1e3 * distance),
        "give a centre inside the lumen, in the coordinates of the mesh");
  nearest->name = name;
  return *nearest;
}

CrossSection opening_section(const mesh::MeshData& data, const mesh::FaceData& face) {
  CrossSection s{.name = face.name, .centre = {}, .normal = {}, .area = 0, .points = {}, .triangles = {}};
  std::map<std::int64_t, std::int32_t> number;
  for (const auto& t : face.triangles) {
    std::array<std::int32_t, 3> local;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [found, is_new] = number.emplace(t[i], static_cast<std::int32_t>(s.points.size()));
      if (is_new) {
        s.points.push_back(data.points[static_cast<std::size_t>(t[i])]);
        s.on_mesh.push_back({t[i], t[i], 0.0});
      }
      local[i] = found->second;
    }
    s.triangles.push_back(local);
    s.normal = s.normal + mesh::area_vector(s.points, local);
  }
  complete(s);
  const double flat = norm(s.normal);
  if (!(flat > 0.9 * s.area))
    throw InputError("face " + face.name, "is no opening that a plane could stand for: its triangles look all ways",
                     "name an opening of the lumen");
  s.normal = (1 / flat) * s.normal;
  return s;
}

SectionState state_of(const CrossSection& s, const MeshFields& fields) {
  const auto vector_at = [](std::span<const double> field, const OnEdge& at) {
    Vec3<double> v{};
    if (field.empty()) return v;
    for (int d = 0; d < 3; ++d) {
      const auto i = static_cast<std::size_t>(d);
      v[d] = (1 - at.share) * field[3 * static_cast<std::size_t>(at.a) + i] +
             at.share * field[3 * static_cast<std::size_t>(at.b) + i];
    }
    return v;
  };
  const auto number_at = [](std::span<const double> field, const OnEdge& at) {
    return field.empty() ? 0.0
                         : (1 - at.share) * field[static_cast<std::size_t>(at.a)] +
                               at.share * field[static_cast<std::size_t>(at.b)];
  };
  SectionState state;
  for (const auto& t : s.triangles) {
    Vec3<double> x[3], mean{};
    double pressure = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto n = static_cast<std::size_t>(t[i]);
      const auto& at = s.on_mesh[n];
      x[i] = s.points[n] + vector_at(fields.displacement, at);
      mean = mean + (1.0 / 3) * (vector_at(fields.velocity, at) - vector_at(fields.mesh_velocity, at));
      pressure += number_at(fields.pressure, at) / 3;
    }
    const Vec3<double> area = 0.5 * cross(x[1] - x[0], x[2] - x[0]);
    state.area += norm(area);
    state.flow += dot(area, mean);
    state.pressure += norm(area) * pressure;
  }
  if (state.area > 0) state.pressure /= state.area;
  return state;
}

std::vector<std::pair<Vec3<double>, double>> quadrature(const CrossSection& s) {
  std::vector<std::pair<Vec3<double>, double>> result;
  for (const auto& t : s.triangles) {
    const double area = dot(mesh::area_vector(s.points, t), s.normal);
    for (std::size_t k = 0; k < 3; ++k) {
      Vec3<double> x{};
      for (std::size_t i = 0; i < 3; ++i)
        x = x + (i == k ? 2.0 / 3 : 1.0 / 6) * s.points[static_cast<std::size_t>(t[i])];
      result.emplace_back(x, area / 3);
    }
  }
  return result;
}

SectionColumn::SectionColumn(const CrossSection& section) : section_(section) {
  const auto& n = section.normal;
  const Vec3<double> other = std::abs(n[0]) < 0.8 ? Vec3<double>{{1, 0, 0}} : Vec3<double>{{0, 1, 0}};
  e1_ = cross(n, other);
  e1_ = (1 / norm(e1_)) * e1_;
  e2_ = cross(n, e1_);
  std::array<double, 2> high{};
  bool first = true;
  for (const auto& t : section.triangles) {
    auto& corners = flat_.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      corners[i] = plane(section.points[static_cast<std::size_t>(t[i])]);
      for (std::size_t d = 0; d < 2; ++d) {
        low_[d] = first ? corners[i][d] : std::min(low_[d], corners[i][d]);
        high[d] = first ? corners[i][d] : std::max(high[d], corners[i][d]);
      }
      first = false;
    }
  }
  for (std::size_t d = 0; d < 2; ++d) step_[d] = std::max((high[d] - low_[d]) / cells_, 1e-12);
  in_cell_.resize(cells_ * cells_);
  for (std::size_t t = 0; t < flat_.size(); ++t) {
    std::size_t from[2], to[2];
    for (std::size_t d = 0; d < 2; ++d) {
      const auto [least, most] = std::minmax({flat_[t][0][d], flat_[t][1][d], flat_[t][2][d]});
      from[d] = cell(least, static_cast<int>(d));
      to[d] = cell(most, static_cast<int>(d));
    }
    for (auto j = from[1]; j <= to[1]; ++j)
      for (auto i = from[0]; i <= to[0]; ++i) in_cell_[i + cells_ * j].push_back(static_cast<std::int32_t>(t));
  }
}

std::size_t SectionColumn::cell(double u, int axis) const {
  const auto d = static_cast<std::size_t>(axis);
  return static_cast<std::size_t>(std::clamp((u - low_[d]) / step_[d], 0.0, static_cast<double>(cells_ - 1)));
}

double SectionColumn::height(const Vec3<double>& place) const { return dot(section_.normal, place - section_.centre); }

std::array<double, 2> SectionColumn::plane(const Vec3<double>& place) const {
  const Vec3<double> d = place - section_.centre;
  return {dot(e1_, d), dot(e2_, d)};
}

bool SectionColumn::holds(const Vec3<double>& place) const {
  const auto p = plane(place);
  for (std::size_t d = 0; d < 2; ++d)
    if (p[d] < low_[d] || p[d] > low_[d] + step_[d] * cells_) return false;
  for (const auto t : in_cell_[cell(p[0], 0) + cells_ * cell(p[1], 1)]) {
    const auto& c = flat_[static_cast<std::size_t>(t)];
    const double a = cross2(c[0], c[1], p), b = cross2(c[1], c[2], p), d = cross2(c[2], c[0], p);
    if ((a >= 0 && b >= 0 && d >= 0) || (a <= 0 && b <= 0 && d <= 0)) return true;
  }
  return false;
}

}  // namespace tunica::flow_imaging
