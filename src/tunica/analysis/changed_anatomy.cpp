#include "tunica/analysis/changed_anatomy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "tunica/analysis/cuts.hpp"
#include "tunica/base/error.hpp"
#include "tunica/mesh/boundary.hpp"
#include "tunica/mesh/lumen_fields.hpp"

namespace tunica::analysis {

namespace {

constexpr double most_filled = 0.01;  ///< of the lumen

class Change {
 public:
  Change(const mesh::MeshData& data, const Anatomy& anatomy, const AnatomyChange& change, const std::string& lumen_face,
         const std::string& wall_face)
      : data_(data), anatomy_(anatomy), change_(change) {
    to_.lumen_face = lumen_face;
    to_.wall_face = wall_face;
    for (const auto& region : data.regions) {
      const auto number = static_cast<std::int32_t>(to_.regions.size());
      to_.regions.emplace_back(region.name, region.kind);
      to_.of_element.insert(to_.of_element.end(), at(region.end_element - region.first_element), number);
      if (region.kind == mesh::RegionKind::lumen) lumen_ = number;
    }
  }

  ChangedMesh result() {
    for (const auto& sleeve : change_.sleeves) put(sleeve);
    for (const auto& name : change_.close_tears) close(tear_named(name), region_of_flap());
    for (const auto& tear : change_.open_tears) open(tear);
    result_.data = mesh::reassign(data_, to_);
    if (fill_pockets()) result_.data = mesh::reassign(data_, to_);
    return std::move(result_);
  }

 private:
  bool has_wall() const {
    return std::any_of(data_.regions.begin(), data_.regions.end(),
                       [](const auto& r) { return r.kind == mesh::RegionKind::wall; });
  }
  std::int32_t region_named(const std::string& name) {
    for (std::size_t r = 0; r < to_.regions.size(); ++r)
      if (to_.regions[r].first == name) return static_cast<std::int32_t>(r);
    to_.regions.emplace_back(name, mesh::RegionKind::wall);
    return static_cast<std::int32_t>(to_.regions.size() - 1);
  }
  /// What closes a tear: -1 without a wall.
  std::int32_t region_of_flap() {
    if (!has_wall()) return -1;
    for (std::size_t r = 0; r < to_.regions.size(); ++r)
      if (to_.regions[r].first == change_.flap) return static_cast<std::int32_t>(r);
    throw InputError("post.flap",
                     fmt::format("the wall has no region '{}' that a closed tear could belong to", change_.flap),
                     "name the region of the flap in `post.flap`");
  }

  // --- closing ------------------------------------------------------------------------------------------------------

  const std::vector<double>& side() const {
    const auto* side = mesh::values_named(data_.node_fields, mesh::lumen_side);
    if (side == nullptr)
      throw InputError("close_tears", "nothing tells true and false lumen of this mesh apart",
                       "see `lumens` in docs/post.md");
    return *side;
  }

  std::size_t tear_named(const std::string& name) const {
    std::vector<std::string> names;
    for (std::size_t k = 0; k < anatomy_.tears.size(); ++k) {
      if (anatomy_.tears[k].name == name) return k;
      names.push_back(anatomy_.tears[k].name);
    }
    throw InputError("close_tears", fmt::format("there is no tear '{}'", name),
                     "use one of: " + mesh::list_names(names));
  }

  /// Elements that reach across a tear, by the tear nearest to the piece that they belong to.
  const std::vector<std::vector<std::int64_t>>& across() {
    if (!across_.empty()) return across_;
    const auto& side = this->side();
    std::vector<Element> elements;
    std::vector<std::int64_t> numbers;
    const auto& region = data_.regions[at(lumen_)];
    for (auto e = region.first_element; e < region.end_element; ++e) {
      const auto values = values_at(side, data_.tetrahedra[at(e)]);
      const auto in_true = std::count_if(values.begin(), values.end(), [](double v) { return v > 0; });
      if (in_true == 0 || in_true == 4) continue;
      elements.push_back(data_.tetrahedra[at(e)]);
      numbers.push_back(e);
    }
    across_.resize(anatomy_.tears.size());
    const auto group = connected_groups(elements);
    std::map<int, std::pair<int, Vec3<double>>> centres;
    for (std::size_t k = 0; k < elements.size(); ++k) {
      auto& [count, sum] = centres.try_emplace(group[k], 0, Vec3<double>{{0, 0, 0}}).first->second;
      ++count;
      sum = sum + mesh::centroid(data_.points, elements[k]);
    }
    for (std::size_t k = 0; k < elements.size(); ++k) {
      const auto& [count, sum] = centres.at(group[k]);
      across_[nearest_tear((1.0 / count) * sum)].push_back(numbers[k]);
    }
    return across_;
  }
  std::size_t nearest_tear(const Vec3<double>& place) const {
    std::size_t nearest = 0;
    for (std::size_t k = 1; k < anatomy_.tears.size(); ++k)
      if (norm(anatomy_.tears[k].centre - place) < norm(anatomy_.tears[nearest].centre - place)) nearest = k;
    return nearest;
  }

  void close(std::size_t tear, std::int32_t region) {
    double volume = 0;
    for (const auto e : across()[tear]) {
      to_.of_element[at(e)] = region;
      volume += mesh::volume(data_.points, data_.tetrahedra[at(e)]);
    }
    result_.remarks.push_back(fmt::format("{} of {:.0f} mm^2 at {:.0f} mm is closed by {} elements, {:.0f} mm^3",
                                          anatomy_.tears[tear].name, 1e6 * anatomy_.tears[tear].area,
                                          1e3 * distance_of_tear(tear), across()[tear].size(), 1e9 * volume));
  }

  // --- a sleeve -----------------------------------------------------------------------------------------------------

  /// As the stations have it, from the inlet [m].
  double distance_along(std::int64_t e) const {
    const auto& distance = *mesh::values_named(data_.node_fields, mesh::distance_along);
    double sum = 0;
    for (const auto node : data_.tetrahedra[at(e)]) sum += 0.25 * distance[at(node)];
    return sum;
  }
  double distance_of_tear(std::size_t tear) {
    double sum = 0;
    for (const auto e : across()[tear]) sum += distance_along(e) / static_cast<double>(across()[tear].size());
    return sum;
  }

  void put(const PlannedSleeve& sleeve) {
    const bool solid = has_wall();
    const std::int32_t number = solid ? region_named(sleeve.name) : -1;
    std::size_t count = 0;
    for (const auto& region : data_.regions) {
      const bool lined = std::find(sleeve.regions.begin(), sleeve.regions.end(), region.name) != sleeve.regions.end();
      if (region.kind != mesh::RegionKind::wall || !lined) continue;
      for (auto e = region.first_element; e < region.end_element; ++e)
        if (const double s = distance_along(e); anatomy_.in_aorta[at(e)] != 0 && s >= sleeve.from && s <= sleeve.to) {
          to_.of_element[at(e)] = number;
          ++count;
        }
    }
    if (solid && count == 0)
      throw InputError("sleeve",
                       fmt::format("no element of {} lies between {:.0f} and {:.0f} mm",
                                   mesh::list_names(sleeve.regions), 1e3 * sleeve.from, 1e3 * sleeve.to),
                       "give places along the aorta as in post/stations.csv, and regions of the wall");
    result_.remarks.push_back(fmt::format("the sleeve from {:.0f} to {:.0f} mm has {} elements of the wall",
                                          1e3 * sleeve.from, 1e3 * sleeve.to, count));
    for (std::size_t k = 0; k < anatomy_.tears.size(); ++k)
      if (const double s = distance_of_tear(k); s >= sleeve.from && s <= sleeve.to) close(k, number);
  }

  // --- opening ------------------------------------------------------------------------------------------------------

  /// Elements of the flap by their distance, across the flap's normal, from its middle at the place.
  void open(const PlannedTear& tear) {
    const auto flap = std::find_if(data_.regions.begin(), data_.regions.end(), [&](const auto& r) {
      return r.kind == mesh::RegionKind::wall && r.name == change_.flap;
    });
    if (flap == data_.regions.end())
      throw InputError("open_tears", fmt::format("the wall has no region '{}'", change_.flap),
                       "a tear is opened in a flap that the mesh has; name it in `post.flap`");
    const auto [middle, normal] = flap_at(*flap, tear.position);
    const double radius = std::sqrt(tear.area / M_PI);
    refuse_overlap(tear, middle, radius);
    std::size_t count = 0;
    for (auto e = flap->first_element; e < flap->end_element; ++e) {
      const auto away = mesh::centroid(data_.points, data_.tetrahedra[at(e)]) - middle;
      const double off = dot(away, normal);
      if (norm(away - off * normal) > radius || std::abs(off) > 2 * radius + 3e-3) continue;
      to_.of_element[at(e)] = lumen_;
      ++count;
    }
    if (count == 0)
      throw InputError("open_tears",
                       fmt::format("no element of the flap is as small as a tear of {:.0f} mm^2 at {:.0f} mm",
                                   1e6 * tear.area, 1e3 * tear.position),
                       "open a larger one, or mesh more finely");
    result_.remarks.push_back(fmt::format("a tear of {:.0f} mm^2 at {:.0f} mm takes {} elements of the flap",
                                          1e6 * tear.area, 1e3 * tear.position, count));
  }

  /// One tear with another one would be one of another size.
  void refuse_overlap(const PlannedTear& tear, const Vec3<double>& middle, double radius) {
    const auto refuse = [&](const std::string& other) {
      throw InputError(
          "open_tears",
          fmt::format("a tear of {:.0f} mm^2 at {:.0f} mm runs into {}", 1e6 * tear.area, 1e3 * tear.position, other),
          "choose a smaller area or another place");
    };
    for (const auto& other : anatomy_.tears) {
      if (std::find(change_.close_tears.begin(), change_.close_tears.end(), other.name) != change_.close_tears.end())
        continue;
      if (norm(other.centre - middle) < radius + std::sqrt(other.area / M_PI)) refuse(other.name);
    }
    for (const auto& [centre, other_radius] : opened_)
      if (norm(centre - middle) < radius + other_radius) refuse("another one that is to be opened");
    opened_.emplace_back(middle, radius);
  }

  /// Middle of the flap at a place, and the direction from false to true lumen there.
  std::pair<Vec3<double>, Vec3<double>> flap_at(const mesh::RegionData& flap, double s) const {
    constexpr double near = 5e-3;
    const auto& side = this->side();
    Vec3<double> sum{{0, 0, 0}}, in_true{{0, 0, 0}}, in_false{{0, 0, 0}};
    double volume = 0, true_volume = 0, false_volume = 0;
    for (std::int64_t e = 0; e < std::ssize(data_.tetrahedra); ++e) {
      const bool of_flap = e >= flap.first_element && e < flap.end_element;
      const auto& lumen = data_.regions[at(lumen_)];
      const bool of_lumen = e >= lumen.first_element && e < lumen.end_element;
      if (anatomy_.in_aorta[at(e)] == 0 || (!of_flap && !of_lumen) || std::abs(distance_along(e) - s) > near) continue;
      const double v = mesh::volume(data_.points, data_.tetrahedra[at(e)]);
      const auto c = mesh::centroid(data_.points, data_.tetrahedra[at(e)]);
      const auto values = values_at(side, data_.tetrahedra[at(e)]);
      auto& to = of_flap ? sum : values[0] > 0 ? in_true : in_false;
      (of_flap ? volume : values[0] > 0 ? true_volume : false_volume) += v;
      to = to + v * c;
    }
    if (volume == 0 || true_volume == 0 || false_volume == 0)
      throw InputError("open_tears", fmt::format("there is no flap between two lumens at {:.0f} mm", 1e3 * s),
                       "choose a place between those of the tears in post.json");
    const auto across = (1 / true_volume) * in_true - (1 / false_volume) * in_false;
    return {(1 / volume) * sum, (1 / norm(across)) * across};
  }

  // --- what has no opening left -------------------------------------------------------------------------------------

  /// Is there anything to fill? Those elements are of the flap then.
  bool fill_pockets() {
    const auto part = mesh::lumen_parts(result_.data);
    const auto& data = result_.data;
    const auto* lumen = lumen_region(data);
    std::vector<std::uint8_t> at_opening(data.points.size(), 0);
    for (const auto& face : data.faces)
      if (data.regions[at(face.region)].kind == mesh::RegionKind::lumen && face.name != to_.lumen_face)
        for (const auto& t : face.triangles)
          for (const auto node : t) at_opening[at(node)] = 1;
    std::map<int, double> volume;
    std::set<int> open;
    double total = 0;
    for (auto e = lumen->first_element; e < lumen->end_element; ++e) {
      const auto& t = data.tetrahedra[at(e)];
      const int p = part[at(e - lumen->first_element)];
      const double v = mesh::volume(data.points, t);
      volume[p] += v;
      total += v;
      if (std::any_of(t.begin(), t.end(), [&](std::int64_t n) { return at_opening[at(n)] != 0; })) open.insert(p);
    }
    double closed = 0;
    for (const auto& [p, v] : volume)
      if (!open.contains(p)) closed += v;
    if (closed == 0) return false;
    if (closed > most_filled * total)
      throw InputError("close_tears", fmt::format("leaves {:.1f} ml of blood without any opening", 1e6 * closed),
                       "leave one tear of the false lumen open: blood that is shut in has no pressure of its own");
    const std::int32_t filled = region_of_flap();
    std::size_t k = 0;
    for (std::size_t e = 0; e < to_.of_element.size(); ++e)
      if (to_.of_element[e] == lumen_ && !open.contains(part[k++])) to_.of_element[e] = filled;
    result_.remarks.push_back(fmt::format("{:.1f} mm^3 of the lumen without an opening are filled", 1e9 * closed));
    return true;
  }

  const mesh::MeshData& data_;
  const Anatomy& anatomy_;
  const AnatomyChange& change_;
  mesh::Reassignment to_;
  std::int32_t lumen_ = -1;
  std::vector<std::vector<std::int64_t>> across_;
  std::vector<std::pair<Vec3<double>, double>> opened_;  ///< middles and radii [m]
  ChangedMesh result_;
};

}  // namespace

ChangedMesh change_anatomy(const mesh::MeshData& data, const Anatomy& anatomy, const AnatomyChange& change,
                           const std::string& lumen_face, const std::string& wall_face) {
  return Change(data, anatomy, change, lumen_face, wall_face).result();
}

}  // namespace tunica::analysis
