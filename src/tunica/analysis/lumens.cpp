#include "tunica/analysis/lumens.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "tunica/analysis/cuts.hpp"
#include "tunica/analysis/vessel.hpp"
#include "tunica/distributed/element_shape.hpp"
#include "tunica/frames/laplace.hpp"
#include "tunica/frames/tears.hpp"
#include "tunica/mesh/lumen_fields.hpp"
#include "tunica/parallel/agree.hpp"

namespace tunica::analysis {

namespace {

using distributed::DistributedMesh;
using mesh::RegionKind;

/// Shared by the ranks: an element across a tear.
struct Crossing {
  std::int64_t id;        ///< of the element, in MeshData
  Element nodes;          ///< in MeshData
  double area, along;     ///< of the cut [m^2]; potential from the inlet
  Vec3<double> centre;    ///< of the cut [m]
  Vec3<double> centroid;  ///< m
};

bool has_wall(const DistributedMesh& mesh, const std::string& name) {
  return std::any_of(mesh.regions.begin(), mesh.regions.end(),
                     [&](const auto& r) { return r.kind == RegionKind::wall && r.name == name; });
}

/// > 0 in the true lumen [local node]; empty where nothing tells.
std::vector<double> sides(const DistributedMesh& mesh, const RunDescription& run, const PostSettings& settings) {
  const frames::LumenWalls usual{{"true_lumen_wall"}, {"false_lumen_wall"}};
  if (run.interface && settings.lumens) return frames::lumen_sides(mesh, *settings.lumens).phi;
  if (run.interface && has_wall(mesh, usual.true_lumen[0]) && has_wall(mesh, usual.false_lumen[0]))
    return frames::lumen_sides(mesh, usual).phi;
  const auto* side = mesh::values_named(mesh.node_fields, mesh::lumen_side);
  return side == nullptr ? std::vector<double>() : *side;
}

/// Rises from the inlet towards all other openings; zero where the mesh does not say which is which.
std::vector<double> potential(const DistributedMesh& mesh, const RunDescription& run, const PostSettings& settings) {
  const std::string inlet = inlet_name(run, settings);
  frames::LaplaceConditions conditions(mesh);
  bool from = false, to = false;
  const auto prescribe = [&](const distributed::Face& face, double value) {
    for (const auto& triangle : face.triangles)
      for (const auto node : triangle) conditions.value[node] = value;
  };
  const auto sticks = [&](const std::string& name) {
    return std::find(run.sticking_faces.begin(), run.sticking_faces.end(), name) != run.sticking_faces.end();
  };
  for (const auto& face : mesh.faces)
    if (mesh.regions[face.region].kind == RegionKind::lumen && face.name != inlet && !sticks(face.name)) {
      prescribe(face, 1);
      to = true;
    }
  for (const auto& face : mesh.faces)
    if (face.name == inlet) {
      prescribe(face, 0);
      from = true;
    }
  if (!from || !to) return std::vector<double>(static_cast<std::size_t>(mesh.nodes()), 0.0);
  return frames::solve_laplace(mesh, frames::Domain::lumen, conditions, "Order of the tears").phi;
}

std::array<double, 4> values_of(const std::vector<double>& field, const std::array<std::int32_t, 4>& element) {
  return {field[element[0]], field[element[1]], field[element[2]], field[element[3]]};
}

bool crosses(const std::array<double, 4>& in_false) {
  return std::any_of(in_false.begin(), in_false.end(), [&](double q) { return q != in_false[0]; });
}

/// The owned element where `side` changes its sign.
Crossing crossing(const DistributedMesh& mesh, const distributed::Region& region, std::int32_t e,
                  const std::vector<double>& side, const std::vector<double>& along) {
  const auto& element = region.elements[e];
  Crossing c{.id = region.element_ids[e],
             .nodes = {},
             .area = 0,
             .along = 0,
             .centre = {{0, 0, 0}},
             .centroid = distributed::centroid(mesh, element)};
  for (int a = 0; a < 4; ++a) {
    c.nodes[a] = mesh.original_ids[element[a]];
    c.along += 0.25 * along[element[a]];
  }
  std::vector<Vec3<double>> corners;
  for (const auto& b : cut_element(values_of(side, element), 0)) {
    Vec3<double> x{{0, 0, 0}};
    for (int a = 0; a < 4; ++a) x = x + b[a] * mesh.points[element[a]];
    corners.push_back(x);
  }
  for (const auto& x : corners) c.centre = c.centre + (1 / static_cast<double>(corners.size())) * x;
  for (std::size_t k = 2; k < corners.size(); ++k)
    c.area += 0.5 * norm(cross(corners[k - 1] - corners[0], corners[k] - corners[0]));
  return c;
}

/// Those of all ranks, in the order of the mesh. Written reason: tears hang together across ranks, and they are some
/// hundred elements of a million.
std::vector<Crossing> everywhere(MPI_Comm comm, const std::vector<Crossing>& mine) {
  std::vector<int> sizes(static_cast<std::size_t>(parallel::size(comm))), begins(sizes.size(), 0);
  const int bytes = static_cast<int>(mine.size() * sizeof(Crossing));
  MPI_Allgather(&bytes, 1, MPI_INT, sizes.data(), 1, MPI_INT, comm);
  std::partial_sum(sizes.begin(), sizes.end() - 1, begins.begin() + 1);
  std::vector<Crossing> all(static_cast<std::size_t>(begins.back() + sizes.back()) / sizeof(Crossing));
  MPI_Allgatherv(mine.data(), bytes, MPI_BYTE, all.data(), sizes.data(), begins.data(), MPI_BYTE, comm);
  std::sort(all.begin(), all.end(), [](const Crossing& a, const Crossing& b) { return a.id < b.id; });
  return all;
}

struct Tears {
  std::vector<TearPlace> places;
  std::vector<int> of_crossing;
};

/// Area and centre of each of so many groups, and where along the vessel it lies.
std::vector<std::pair<double, TearPlace>> measured(const std::vector<Crossing>& crossings,
                                                   const std::vector<int>& group, std::size_t count) {
  std::vector<std::pair<double, TearPlace>> tears(count);
  for (std::size_t k = 0; k < crossings.size(); ++k) {
    auto& [along, tear] = tears[group[k]];
    along += crossings[k].area * crossings[k].along;
    tear.area += crossings[k].area;
    tear.centre = tear.centre + crossings[k].area * crossings[k].centre;
  }
  for (auto& [along, tear] : tears) {
    if (tear.area == 0) continue;  // a corner that touches the surface
    along /= tear.area;
    tear.centre = (1 / tear.area) * tear.centre;
  }
  return tears;
}

/// Number of the nearest group that is no speck, for each group.
std::vector<int> without_specks(const std::vector<std::pair<double, TearPlace>>& tears,
                                const std::vector<Crossing>& crossings, const std::vector<int>& group) {
  constexpr double speck = 1e-3;
  double largest = 0;
  for (const auto& [along, tear] : tears) largest = std::max(largest, tear.area);
  std::vector<double> nearest(tears.size(), std::numeric_limits<double>::infinity());
  std::vector<int> joins(tears.size(), 0);
  for (std::size_t k = 0; k < crossings.size(); ++k)
    for (std::size_t t = 0; t < tears.size(); ++t) {
      if (tears[t].second.area < speck * largest) continue;
      const auto g = static_cast<std::size_t>(group[k]);
      const double distance = g == t ? -1 : norm(crossings[k].centroid - tears[t].second.centre);
      if (distance >= nearest[g]) continue;
      nearest[g] = distance;
      joins[g] = static_cast<int>(t);
    }
  return joins;
}

Tears make_tears(const std::vector<Crossing>& crossings) {
  if (crossings.empty()) return {};
  std::vector<Element> elements;
  for (const auto& c : crossings) elements.push_back(c.nodes);
  std::vector<int> group = connected_groups(elements);
  const auto count = static_cast<std::size_t>(*std::max_element(group.begin(), group.end())) + 1;
  const auto joins = without_specks(measured(crossings, group, count), crossings, group);
  for (auto& g : group) g = joins[g];
  auto tears = measured(crossings, group, count);
  std::vector<int> order;
  for (std::size_t t = 0; t < count; ++t)
    if (joins[t] == static_cast<int>(t)) order.push_back(static_cast<int>(t));
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    if (std::abs(tears[a].first - tears[b].first) > 1e-6) return tears[a].first < tears[b].first;
    return tears[a].second.area > tears[b].second.area;
  });
  Tears result{{}, std::vector<int>(group.size(), 0)};
  std::vector<int> number(count, 0);
  for (const int t : order) {
    number[t] = static_cast<int>(result.places.size());
    result.places.push_back(tears[t].second);
    result.places.back().name = fmt::format("tear_{}", result.places.size());
  }
  for (std::size_t k = 0; k < group.size(); ++k) result.of_crossing[k] = number[group[k]];
  return result;
}

/// Which part of the vessel a point belongs to.
class Parts {
 public:
  Parts(const std::vector<Crossing>& crossings, const Tears& tears) : crossings_(crossings), tears_(tears) {
    for (std::size_t k = 0; k < tears.places.size(); ++k) reach_.push_back(0);
    for (std::size_t k = 0; k < crossings.size(); ++k) {
      const auto t = static_cast<std::size_t>(tears.of_crossing[k]);
      reach_[t] = std::max(reach_[t], norm(crossings[k].centroid - tears.places[t].centre));
    }
  }
  static double diameter(const TearPlace& tear) { return 2 * std::sqrt(tear.area / M_PI); }

  std::vector<std::string> names() const {
    std::vector<std::string> names{"true lumen", "false lumen"};
    for (const auto& tear : tears_.places) names.push_back(tear.name);
    return names;
  }
  std::int32_t at(const Vec3<double>& x, bool in_false) const {
    std::int32_t part = in_false ? 1 : 0;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t t = 0; t < tears_.places.size(); ++t) {
      const auto& tear = tears_.places[t];
      if (norm(x - tear.centre) > reach_[t] + diameter(tear)) continue;
      const double distance = distance_to(x, static_cast<int>(t));
      if (distance > diameter(tear) || distance >= nearest) continue;
      nearest = distance;
      part = static_cast<std::int32_t>(2 + t);
    }
    return part;
  }

 private:
  double distance_to(const Vec3<double>& x, int tear) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < crossings_.size(); ++k)
      if (tears_.of_crossing[k] == tear) least = std::min(least, norm(x - crossings_[k].centroid));
    return least;
  }

  const std::vector<Crossing>& crossings_;
  const Tears& tears_;
  std::vector<double> reach_;  ///< of each tear from its centre [m]
};

template <class Visit>
void for_each_owned(const DistributedMesh& mesh, Visit visit) {
  for (std::size_t r = 0; r < mesh.regions.size(); ++r)
    if (mesh.regions[r].kind == RegionKind::lumen)
      for (std::int32_t e = 0; e < mesh.regions[r].owned_elements; ++e) visit(r, e);
}

}  // namespace

std::optional<Lumens> find_lumens(const DistributedMesh& mesh, const RunDescription& run,
                                  const PostSettings& settings) {
  if (!run.fluid) return std::nullopt;
  const auto side = sides(mesh, run, settings);
  if (side.empty()) return std::nullopt;
  const auto along = potential(mesh, run, settings);
  Lumens lumens;
  auto& map = lumens.map;
  for (const double s : side) map.in_false.push_back(s > 0 ? 0 : 1);
  for (const auto& face : mesh.faces)
    map.sticks.push_back(std::find(run.sticking_faces.begin(), run.sticking_faces.end(), face.name) !=
                         run.sticking_faces.end());
  std::vector<Crossing> mine;
  for_each_owned(mesh, [&](std::size_t r, std::int32_t e) {
    if (crosses(values_of(map.in_false, mesh.regions[r].elements[e])))
      mine.push_back(crossing(mesh, mesh.regions[r], e, side, along));
  });
  const auto crossings = everywhere(mesh.comm, mine);
  const Tears tears = make_tears(crossings);
  lumens.tears = tears.places;
  for (const auto& tear : tears.places) map.tears.push_back(tear.name);
  const Parts parts(crossings, tears);
  map.parts = parts.names();
  map.part_of.resize(mesh.regions.size());
  for_each_owned(mesh, [&](std::size_t r, std::int32_t e) {
    const auto& region = mesh.regions[r];
    const auto q = values_of(map.in_false, region.elements[e]);
    map.part_of[r].push_back(parts.at(distributed::centroid(mesh, region.elements[e]), q[0] + q[1] + q[2] + q[3] > 2));
    if (!crosses(q)) return;
    const auto found = std::lower_bound(crossings.begin(), crossings.end(), region.element_ids[e],
                                        [](const Crossing& c, std::int64_t id) { return c.id < id; });
    map.cuts.push_back({static_cast<std::int32_t>(r), e, tears.of_crossing[found - crossings.begin()], q});
  });
  return lumens;
}

}  // namespace tunica::analysis
