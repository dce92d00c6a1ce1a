#include "tunica/mesh/reassign.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <span>

#include "tunica/base/disjoint_sets.hpp"
#include "tunica/base/error.hpp"
#include "tunica/mesh/boundary.hpp"

namespace tunica::mesh {

namespace {

using Index = std::int64_t;
using Triangle = std::array<Index, 3>;

std::size_t at(Index k) { return static_cast<std::size_t>(k); }

/// Sides of an element, seen from outside.
std::array<Triangle, 4> sides(const std::array<Index, 4>& t) {
  std::array<Triangle, 4> result;
  for (std::size_t f = 0; f < 4; ++f)
    for (std::size_t i = 0; i < 3; ++i) result[f][i] = t[at(tetrahedron_faces[f][i])];
  return result;
}

using Owner = std::pair<Triangle, Index>;

constexpr int in_lumen = 0, in_wall = 1;

class Reassigner {
 public:
  Reassigner(const MeshData& data, const Reassignment& to) : data_(data), to_(to) {
    merge_twins();
    find_old_kinds();
    find_owners();
  }

  MeshData result() {
    take_elements();
    take_nodes();
    take_faces();
    take_fields();
    for (Index m = 0; m < std::ssize(data_.points); ++m)
      if (number_[in_lumen][at(m)] >= 0 && number_[in_wall][at(m)] >= 0)
        new_.twins.emplace_back(number_[in_wall][at(m)], number_[in_lumen][at(m)]);
    return std::move(new_);
  }

 private:
  /// The node of the lumen stands for both.
  void merge_twins() {
    merged_.resize(data_.points.size());
    std::iota(merged_.begin(), merged_.end(), Index{0});
    wall_node_ = merged_;
    for (const auto& [on_wall, on_lumen] : data_.twins) {
      merged_[at(on_wall)] = on_lumen;
      wall_node_[at(on_lumen)] = on_wall;
    }
  }
  template <std::size_t N>
  std::array<Index, N> merged(std::array<Index, N> nodes) const {
    for (auto& n : nodes) n = merged_[at(n)];
    return nodes;
  }

  void find_old_kinds() {
    old_kind_.resize(data_.tetrahedra.size());
    for (const auto& region : data_.regions)
      for (auto e = region.first_element; e < region.end_element; ++e)
        old_kind_[at(e)] = region.kind == RegionKind::lumen ? in_lumen : in_wall;
  }
  /// Of an element that is kept.
  int kept_kind(Index e) const {
    return to_.regions[at(to_.of_element[at(e)])].second == RegionKind::lumen ? in_lumen : in_wall;
  }
  /// -1: taken away.
  int new_kind(Index e) const { return to_.of_element[at(e)] < 0 ? -1 : kept_kind(e); }

  void find_owners() {
    owners_.reserve(4 * data_.tetrahedra.size());
    for (Index e = 0; e < std::ssize(data_.tetrahedra); ++e)
      for (const auto& side : sides(merged(data_.tetrahedra[at(e)]))) owners_.emplace_back(sorted(side), e);
    std::sort(owners_.begin(), owners_.end());
  }
  /// The one or two elements at a triangle.
  std::span<const Owner> owners(const Triangle& t) const {
    const Triangle key = sorted(t);
    const auto first = std::lower_bound(owners_.begin(), owners_.end(), Owner{key, -1});
    auto last = first;
    while (last != owners_.end() && last->first == key) ++last;
    return {first, last};
  }

  void take_elements() {
    for (std::size_t r = 0; r < to_.regions.size(); ++r) {
      const Index first = std::ssize(elements_);
      for (Index e = 0; e < std::ssize(data_.tetrahedra); ++e)
        if (to_.of_element[at(e)] == static_cast<std::int32_t>(r)) elements_.push_back(e);
      if (std::ssize(elements_) == first) continue;
      region_[to_.regions[r].second == RegionKind::lumen ? in_lumen : in_wall] =
          static_cast<std::int32_t>(new_.regions.size());
      new_.regions.push_back({to_.regions[r].first, to_.regions[r].second, first, std::ssize(elements_)});
    }
  }

  /// Lumen first, each side in the old order.
  void take_nodes() {
    for (auto& number : number_) number.assign(data_.points.size(), -1);
    for (const auto e : elements_)
      for (const auto m : merged(data_.tetrahedra[at(e)])) number_[kept_kind(e)][at(m)] = 0;
    for (const int kind : {in_lumen, in_wall})
      for (Index m = 0; m < std::ssize(data_.points); ++m) {
        auto& number = number_[kind][at(m)];
        if (number < 0) continue;
        number = std::ssize(new_.points);
        new_.points.push_back(data_.points[at(m)]);
        source_.push_back(kind == in_wall ? wall_node_[at(m)] : m);
      }
    for (const auto e : elements_) {
      auto& t = new_.tetrahedra.emplace_back(merged(data_.tetrahedra[at(e)]));
      for (auto& n : t) n = number_[kept_kind(e)][at(n)];
    }
  }

  Triangle numbered(Triangle t, int kind) const {
    for (auto& n : t) n = number_[kind][at(n)];
    return t;
  }

  /// The element of that kind that a face belonged to.
  Index owner(const Triangle& t, int kind) const {
    const auto both = owners(t);
    const auto found =
        std::find_if(both.begin(), both.end(), [&](const Owner& o) { return old_kind_[at(o.second)] == kind; });
    return found->second;  // faces lie on elements
  }
  /// Does the element on the other side of a side have that kind, before or now?
  bool borders(const Triangle& side, Index e, int kind, bool now) const {
    const auto both = owners(side);
    return std::any_of(both.begin(), both.end(), [&](const Owner& o) {
      return o.second != e && (now ? new_kind(o.second) : old_kind_[at(o.second)]) == kind;
    });
  }

  void take_faces() {
    std::set<Triangle> held[2];  // sides that belong to a face already
    for (const auto& face : data_.faces) {
      const int kind = data_.regions[at(face.region)].kind == RegionKind::lumen ? in_lumen : in_wall;
      FaceData taken{face.name, region_[kind], {}, {}};
      for (const auto& triangle : face.triangles) {
        const auto t = merged(triangle);
        const Index e = owner(t, kind);
        const bool between = borders(t, e, 1 - kind, false) || face.name == to_.lumen_face;
        if (new_kind(e) == kind && (!between || !borders(t, e, kind, true))) {
          taken.triangles.push_back(numbered(t, kind));
          held[kind].insert(sorted(t));
        } else if (!between) {
          throw InputError(face.name,
                           fmt::format("is reached by what changes between lumen and wall, at {}",
                                       list_places(std::array{centroid(data_.points, t)})),
                           "choose a place farther away from it");
        }
      }
      new_.faces.push_back(std::move(taken));
    }
    for (const auto e : elements_) {
      const int kind = kept_kind(e);
      for (const auto& side : sides(merged(data_.tetrahedra[at(e)]))) {
        const bool inside = borders(side, e, kind, true) || held[kind].contains(sorted(side));
        if (!inside) face_between(kind).triangles.push_back(numbered(side, kind));
      }
    }
    std::erase_if(new_.faces, [](const auto& face) { return face.triangles.empty(); });
  }
  FaceData& face_between(int kind) {
    const auto& name = kind == in_lumen ? to_.lumen_face : to_.wall_face;
    const auto found =
        std::find_if(new_.faces.begin(), new_.faces.end(), [&](const auto& f) { return f.name == name; });
    if (found == new_.faces.end())
      throw InputError("meshes", fmt::format("have no face '{}' that a new surface could belong to", name),
                       "name the faces between lumen and wall in `meshes.interface`");
    return *found;
  }

  void take_fields() {
    for (const auto& field : data_.fields) {
      auto& taken = new_.fields.emplace_back(ElementField{field.name, field.components, {}});
      for (const auto e : elements_)
        for (int c = 0; c < field.components; ++c) taken.values.push_back(field.values[at(e * field.components + c)]);
    }
    for (const auto& field : data_.node_fields) {
      auto& taken = new_.node_fields.emplace_back(NodeField{field.name, {}});
      for (const auto n : source_) taken.values.push_back(field.values[at(n)]);
    }
  }

  const MeshData& data_;
  const Reassignment& to_;
  MeshData new_;
  std::vector<Index> merged_, wall_node_;  ///< of each node: the one that stands for it; its copy on the wall
  std::vector<int> old_kind_;              ///< of each element
  std::vector<Owner> owners_;              ///< elements at triangles of merged nodes, sorted
  std::vector<Index> elements_;            ///< old numbers in the new order
  std::vector<Index> number_[2];           ///< of a merged node in the new lumen and wall
  std::vector<Index> source_;              ///< of each new node: the old one that its values come from
  std::int32_t region_[2] = {-1, -1};      ///< a region of each kind
};

}  // namespace

MeshData reassign(const MeshData& data, const Reassignment& to) { return Reassigner(data, to).result(); }

std::vector<int> lumen_parts(const MeshData& data) {
  std::vector<Owner> at_sides;
  Index count = 0;
  for (const auto& region : data.regions)
    if (region.kind == RegionKind::lumen)
      for (auto e = region.first_element; e < region.end_element; ++e, ++count)
        for (const auto& side : sides(data.tetrahedra[at(e)])) at_sides.emplace_back(sorted(side), count);
  std::sort(at_sides.begin(), at_sides.end());
  base::DisjointSets parts(count);
  for (std::size_t k = 1; k < at_sides.size(); ++k)
    if (at_sides[k].first == at_sides[k - 1].first) parts.join(at_sides[k].second, at_sides[k - 1].second);
  std::map<Index, int> number;
  std::vector<int> part;
  for (Index k = 0; k < count; ++k)
    part.push_back(number.try_emplace(parts.set_of(k), static_cast<int>(number.size())).first->second);
  return part;
}

}  // namespace tunica::mesh
