#include "tunica/viewer/surface.hpp"

#include <algorithm>
#include <map>
#include <unordered_map>

#include "tunica/mesh/boundary.hpp"

namespace tunica::viewer {

namespace {

using mesh::MeshData;
using mesh::RegionKind;
using Nodes = std::array<std::int64_t, 3>;

Nodes sorted(Nodes nodes) {
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

/// Faces whose triangles touch the interface are rings at the ends of the wall; its outside does not.
std::set<std::string> rings_of(const MeshData& data, const FaceRoles& roles) {
  std::vector<bool> at_blood(data.points.size(), false);
  for (const auto& [wall, lumen] : data.twins) at_blood[static_cast<std::size_t>(wall)] = true;
  std::set<std::string> rings;
  for (const auto& face : data.faces) {
    if (data.regions[static_cast<std::size_t>(face.region)].kind != RegionKind::wall ||
        roles.wall_interface.contains(face.name))
      continue;
    const auto touching = std::count_if(face.triangles.begin(), face.triangles.end(), [&](const Nodes& t) {
      return std::any_of(t.begin(), t.end(), [&](auto node) { return at_blood[static_cast<std::size_t>(node)]; });
    });
    if (10 * touching > std::ssize(face.triangles)) rings.insert(face.name);
  }
  return rings;
}

bool has_wall(const MeshData& data) {
  return std::any_of(data.regions.begin(), data.regions.end(),
                     [](const auto& r) { return r.kind == RegionKind::wall; });
}

using Groups = std::map<std::pair<std::string, std::string>, std::vector<Nodes>>;  ///< by kind and name

/// Triangles by the group that they belong to; those of the wall where blood and wall meet.
Groups sort_triangles(const MeshData& data, const FaceRoles& roles) {
  std::map<Nodes, const std::string*> face_of;
  for (const auto& face : data.faces)
    for (const auto& t : face.triangles) face_of[sorted(t)] = &face.name;
  const auto rings = rings_of(data, roles);
  const bool rigid = !has_wall(data);
  Groups result;
  const mesh::Boundary boundary(data.tetrahedra, std::ssize(data.points), "the mesh");
  for (const auto& t : boundary.triangles()) {
    const auto& region = region_of(data, t.element);
    const auto found = face_of.find(sorted(t.nodes));
    const std::string face = found == face_of.end() ? "" : *found->second;
    if (region.kind == RegionKind::wall) {
      const char* kind = roles.wall_interface.contains(face) ? "inner" : rings.contains(face) ? "end" : "outer";
      result[{kind, kind == std::string("end") ? face : region.name}].push_back(t.nodes);
    } else if (!roles.lumen_interface.contains(face)) {
      const bool wall = rigid && roles.sticking.contains(face);
      result[{wall ? "inner" : "opening", wall ? region.name : face}].push_back(t.nodes);
    }
  }
  return result;
}

/// Points of the surface: a pair of coinciding nodes of lumen and wall is one.
class Points {
 public:
  explicit Points(const MeshData& data) : data_(data), rigid_(!has_wall(data)) {
    for (const auto& [wall, lumen] : data.twins) lumen_of_[wall] = lumen, wall_of_[lumen] = wall;
  }

  /// Blocks: 0 wall alone, 1 blood at the wall, 2 blood alone.
  void meet(std::int64_t node, bool opening, bool inner) {
    const std::int64_t key = primary(node);
    const int block = wall_of_.contains(key) || (rigid_ && inner) ? 1 : opening ? 2 : 0;
    const auto [at, is_new] = block_.emplace(key, block);
    if (!is_new) at->second = at->second == 2 ? block : at->second;  // the rim of an opening lies at the wall
  }

  void number(Skeleton& s) {
    std::array<std::vector<std::int64_t>, 3> blocks;
    for (const auto& [key, block] : block_) blocks[static_cast<std::size_t>(block)].push_back(key);
    for (auto& block : blocks) {
      std::sort(block.begin(), block.end());
      for (const auto key : block) {
        number_[key] = static_cast<std::uint32_t>(s.body.points.size());
        s.body.points.push_back(data_.points[static_cast<std::size_t>(key)]);
      }
    }
    s.blood_first = blocks[0].size();
    s.inside_end = s.blood_first + blocks[1].size();
    s.blood_end = s.body.points.size();
    s.wall_end = rigid_ ? 0 : s.inside_end;
    for (std::size_t block = 0; block < 3; ++block)
      for (const auto key : blocks[block]) {
        const auto twin = wall_of_.find(key);
        const auto wall = twin == wall_of_.end() ? key : twin->second;
        if (block < 2 && !rigid_) s.wall.push_back({wall, wall, 0});
        if (block > 0) s.blood.push_back({key, key, 0});
      }
  }

  std::uint32_t operator()(std::int64_t node) const { return number_.at(primary(node)); }

 private:
  std::int64_t primary(std::int64_t node) const {
    const auto twin = lumen_of_.find(node);
    return twin == lumen_of_.end() ? node : twin->second;
  }

  const MeshData& data_;
  bool rigid_;  ///< blood alone
  std::unordered_map<std::int64_t, std::int64_t> lumen_of_, wall_of_;
  std::unordered_map<std::int64_t, int> block_;
  std::unordered_map<std::int64_t, std::uint32_t> number_;
};

/// Crossings of one plane with the edges of elements of one kind.
class Cut {
 public:
  Cut(const MeshData& data, const CutPlane& plane) : data_(data), plane_(plane) {}

  void add(const mesh::RegionData& region) {
    for (auto e = region.first_element; e < region.end_element; ++e) {
      const auto& nodes = data_.tetrahedra[static_cast<std::size_t>(e)];
      if (plane_.radius > 0 && norm(mesh::centroid(data_.points, nodes) - plane_.centre) > plane_.radius) continue;
      std::array<double, 4> height;
      for (std::size_t a = 0; a < 4; ++a)
        height[a] = dot(data_.points[static_cast<std::size_t>(nodes[a])] - plane_.centre, plane_.normal);
      add_element(nodes, height);
    }
  }

  std::vector<PointSource> sources;
  std::vector<std::array<std::uint32_t, 3>> triangles;

 private:
  void add_element(const std::array<std::int64_t, 4>& nodes, const std::array<double, 4>& height) {
    std::array<std::size_t, 4> above{}, below{};
    std::size_t n = 0, m = 0;
    for (std::size_t a = 0; a < 4; ++a) (height[a] > 0 ? above[n++] : below[m++]) = a;
    // To and fro, so that the corners go round.
    std::vector<std::uint32_t> polygon;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < m; ++j) {
        const auto a = above[i], b = below[i % 2 == 0 ? j : m - 1 - j];
        polygon.push_back(crossing(nodes[a], nodes[b], height[a] / (height[a] - height[b])));
      }
    for (std::size_t k = 2; k < polygon.size(); ++k) add_triangle({polygon[0], polygon[k - 1], polygon[k]});
  }

  std::uint32_t crossing(std::int64_t a, std::int64_t b, double t) {
    if (a > b) std::swap(a, b), t = 1 - t;
    const auto [at, is_new] = known_.emplace(std::pair{a, b}, static_cast<std::uint32_t>(sources.size()));
    if (is_new) sources.push_back({a, b, t});
    return at->second;
  }

  Vec3<double> place(std::uint32_t i) const {
    const auto& s = sources[i];
    return (1 - s.t) * data_.points[static_cast<std::size_t>(s.a)] + s.t * data_.points[static_cast<std::size_t>(s.b)];
  }

  /// Seen from where the normal points to counter-clockwise.
  void add_triangle(std::array<std::uint32_t, 3> t) {
    const auto a = place(t[0]);
    if (dot(cross(place(t[1]) - a, place(t[2]) - a), plane_.normal) < 0) std::swap(t[1], t[2]);
    triangles.push_back(t);
  }

  const MeshData& data_;
  const CutPlane& plane_;
  std::map<std::pair<std::int64_t, std::int64_t>, std::uint32_t> known_;
};

void append(const MeshData& data, const Cut& cut, const std::string& kind, const std::string& name,
            std::vector<PointSource>& sources, Body& body) {
  const auto shift = static_cast<std::uint32_t>(body.points.size());
  for (const auto& s : cut.sources) {
    sources.push_back(s);
    body.points.push_back((1 - s.t) * data.points[static_cast<std::size_t>(s.a)] +
                          s.t * data.points[static_cast<std::size_t>(s.b)]);
  }
  body.groups.push_back({kind, name, body.triangles.size(), cut.triangles.size()});
  for (const auto& t : cut.triangles) body.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
}

}  // namespace

const mesh::RegionData& region_of(const MeshData& data, std::int64_t element) {
  return *std::find_if(data.regions.begin(), data.regions.end(),
                       [&](const auto& r) { return element >= r.first_element && element < r.end_element; });
}

Skeleton surface_of(const MeshData& data, const FaceRoles& roles) {
  const auto groups = sort_triangles(data, roles);
  Points points(data);
  for (const auto& [group, triangles] : groups)
    for (const auto& t : triangles)
      for (const auto node : t) points.meet(node, group.first == "opening", group.first == "inner");
  Skeleton s;
  s.body.name = "surface";
  points.number(s);
  for (const auto& [group, triangles] : groups) {
    s.body.groups.push_back({group.first, group.second, s.body.triangles.size(), triangles.size()});
    for (const auto& t : triangles) s.body.triangles.push_back({points(t[0]), points(t[1]), points(t[2])});
  }
  return s;
}

std::vector<Joined> joined_triangles(const Skeleton& surface, std::int64_t corners) {
  const auto is_corner = [&](std::uint32_t point) {
    const auto& source = point < surface.wall_end ? surface.wall[point] : surface.blood[point - surface.blood_first];
    return source.a < corners;
  };
  using Edge = std::pair<std::uint32_t, std::uint32_t>;
  std::vector<Joined> joined;
  for (const auto& group : surface.body.groups) {
    // Of the four parts three have a corner each, opposite to an edge of the one in the middle.
    std::map<Edge, std::uint32_t> corner_at;
    for (std::size_t t = group.first; t < group.first + group.count; ++t)
      for (std::size_t k = 0; k < 3; ++k)
        if (const auto& p = surface.body.triangles[t]; is_corner(p[k]))
          corner_at[{p[(k + 1) % 3], p[(k + 2) % 3]}] = p[k];
    for (std::size_t t = group.first; t < group.first + group.count; ++t) {
      const auto& p = surface.body.triangles[t];
      if (is_corner(p[0]) || is_corner(p[1]) || is_corner(p[2])) continue;
      // Its edges run the other way in the parts beside it.
      joined.push_back(
          {{corner_at.at({p[1], p[0]}), corner_at.at({p[2], p[1]}), corner_at.at({p[0], p[2]})}, {p[1], p[2], p[0]}});
    }
  }
  return joined;
}

Skeleton sections_of(const MeshData& data, const std::vector<CutPlane>& planes) {
  Skeleton s;
  s.body.name = "sections";
  for (const auto kind : {RegionKind::wall, RegionKind::lumen}) {
    const bool wall = kind == RegionKind::wall;
    if (!wall) s.wall_end = s.blood_first = s.inside_end = s.body.points.size();
    for (const auto& plane : planes) {
      Cut cut(data, plane);
      for (const auto& region : data.regions)
        if (region.kind == kind) cut.add(region);
      if (!cut.triangles.empty())
        append(data, cut, wall ? "wall section" : "section", plane.name, wall ? s.wall : s.blood, s.body);
    }
  }
  s.blood_end = s.body.points.size();
  return s;
}

}  // namespace tunica::viewer
