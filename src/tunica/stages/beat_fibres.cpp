#include "tunica/stages/beat_fibres.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "tunica/base/error.hpp"
#include "tunica/mesh/boundary.hpp"
#include "tunica/viewer/surface.hpp"

namespace tunica::stages {

namespace {

using mesh::MeshData;
using mesh::RegionKind;

/// Lines of a family on the whole wall, about.
constexpr double most_lines = 2500;

struct Spot {
  std::int64_t element;
  const mesh::RegionData* region;
  bool inner;
  Vec3<double> place;
  double area;
};

/// Where the triangles of a face of the wall lie. Rings at the ends of the wall touch the blood with some of them.
enum class FibreSide { inner, outer, ring };

FibreSide side_of(const mesh::FaceData& face, const std::vector<char>& at_blood) {
  std::size_t touching = 0, all = 0;
  for (const auto& t : face.triangles) {
    const auto blood = std::count_if(t.begin(), t.end(), [&](auto n) { return at_blood[static_cast<std::size_t>(n)]; });
    touching += blood > 0;
    all += blood == 3;
  }
  if (all == face.triangles.size()) return FibreSide::inner;
  return 10 * touching > face.triangles.size() ? FibreSide::ring : FibreSide::outer;
}

/// Triangles of the wall's outside and of its interface with the blood.
std::vector<Spot> spots_of(const MeshData& data) {
  std::vector<char> at_blood(data.points.size(), 0);
  for (const auto& [wall, lumen] : data.twins) at_blood[static_cast<std::size_t>(wall)] = 1;
  std::vector<Spot> spots;
  const mesh::Boundary boundary(data.tetrahedra, std::ssize(data.points), "the mesh");
  for (const auto& face : data.faces) {
    if (data.regions[static_cast<std::size_t>(face.region)].kind != RegionKind::wall) continue;
    const FibreSide side = side_of(face, at_blood);
    if (side == FibreSide::ring) continue;
    for (const auto& t : face.triangles) {
      const auto element = boundary.triangles()[static_cast<std::size_t>(boundary.find(t))].element;
      spots.push_back({element, &viewer::region_of(data, element), side == FibreSide::inner,
                       mesh::centroid(data.points, t), norm(mesh::area_vector(data.points, t))});
    }
  }
  return spots;
}

/// One of each cube of that size, outside and inside apart.
std::vector<Spot> thinned(const std::vector<Spot>& spots, double size) {
  std::set<std::array<std::int64_t, 4>> taken;
  std::vector<Spot> left;
  for (const auto& spot : spots) {
    std::array<std::int64_t, 4> cube{0, 0, 0, spot.inner ? 1 : 0};
    for (int c = 0; c < 3; ++c)
      cube[static_cast<std::size_t>(c)] = static_cast<std::int64_t>(std::floor(spot.place[c] / size));
    if (taken.insert(cube).second) left.push_back(spot);
  }
  return left;
}

/// Fibre frames of elements of the mesh of a page.
class Frames {
 public:
  Frames(const MeshData& data, const wall::FrameSource& source) : data_(data), source_(source) {}

  wall::FibreFrame operator()(const Spot& spot) const {
    if (const auto* constant = std::get_if<wall::ConstantFrame>(&source_)) return constant->frame();
    if (const auto* cylinder = std::get_if<wall::CylindricalFrame>(&source_))
      return cylinder->at(mesh::centroid(data_.points, data_.tetrahedra[static_cast<std::size_t>(spot.element)]));
    const auto& arrays = std::get<wall::MeshFrame>(source_);
    return wall::orthonormal_frame(vector(arrays.e1, spot), vector(arrays.e2, spot),
                                   fmt::format("fibre frame of an element of region {}", spot.region->name));
  }

 private:
  Vec3<double> vector(const std::string& name, const Spot& spot) const {
    const auto field = std::find_if(data_.fields.begin(), data_.fields.end(),
                                    [&](const auto& f) { return f.name == name && f.components == 3; });
    if (field == data_.fields.end())
      throw InputError("wall.fibre_frame.mesh", fmt::format("the mesh has no cell array {} of vectors", name),
                       "name those that `tunica fibres` has written");
    const double* v = field->values.data() + 3 * spot.element;
    return {{v[0], v[1], v[2]}};
  }

  const MeshData& data_;
  const wall::FrameSource& source_;
};

const wall::LawParameters& material_of(const wall::Parameters& wall, const std::string& region) {
  const auto own = wall.regions.find(region);
  return own == wall.regions.end() ? wall.material : own->second.material;
}

}  // namespace

std::vector<viewer::Lines> fibre_lines(const wall::Parameters& wall, const MeshData& data) {
  std::vector<viewer::Lines> result;
  if (!wall.fibre_frame) return result;
  const auto spots = spots_of(data);
  double area = 0;
  for (const auto& spot : spots) area += spot.area;
  const double spacing = std::sqrt(area / most_lines);
  const Frames frames(data, *wall.fibre_frame);
  std::map<std::array<std::string, 3>, viewer::Lines> lines;  // of a family, on a side, in a region
  for (const auto& spot : thinned(spots, spacing)) {
    const auto families = wall::mean_fibre_directions(material_of(wall, spot.region->name));
    if (families.empty()) continue;
    const wall::FibreFrame frame = frames(spot);
    for (std::size_t k = 0; k < families.size(); ++k) {
      const std::string name = fmt::format("family {}", k + 1), kind = spot.inner ? "inner" : "outer";
      auto& set = lines[{name, kind, spot.region->name}];
      set.name = name;
      set.kind = kind;
      set.region = spot.region->name;
      set.length = 0.8 * spacing;
      set.places.push_back(spot.place);
      const auto& m = families[k];
      set.directions.push_back(m[0] * frame.e1 + m[1] * frame.e2 + m[2] * frame.e3);
    }
  }
  for (auto& [key, set] : lines) result.push_back(std::move(set));
  return result;
}

}  // namespace tunica::stages
