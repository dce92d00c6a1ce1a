#include "tunica/analysis/vessel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "tunica/analysis/stations.hpp"
#include "tunica/base/error.hpp"
#include "tunica/distributed/distributed_mesh.hpp"
#include "tunica/frames/laplace.hpp"
#include "tunica/frames/tears.hpp"
#include "tunica/mesh/boundary.hpp"
#include "tunica/mesh/lumen_fields.hpp"
#include "tunica/parallel/agree.hpp"
#include "tunica/parallel/gather.hpp"

namespace tunica::analysis {

namespace {

using mesh::RegionKind;

bool has_wall_region(const mesh::MeshData& data, const std::string& name) {
  return std::any_of(data.regions.begin(), data.regions.end(),
                     [&](const auto& r) { return r.kind == RegionKind::wall && r.name == name; });
}

void sort_faces(const RunDescription& run, const mesh::MeshData& data, Vessel& vessel) {
  const std::set<std::string> sticks(run.sticking_faces.begin(), run.sticking_faces.end());
  for (std::size_t f = 0; f < data.faces.size(); ++f) {
    const auto& face = data.faces[f];
    if (data.regions[static_cast<std::size_t>(face.region)].kind != RegionKind::lumen) continue;
    if (sticks.contains(face.name))
      vessel.inside.insert(vessel.inside.end(), face.triangles.begin(), face.triangles.end());
    else
      vessel.openings.push_back({face.name, f});
  }
}

/// Index in data.faces; adds a problem when there is no such opening.
std::size_t opening_face(const Vessel& vessel, const std::string& name, const std::string& key,
                         std::vector<Problem>& problems) {
  std::vector<std::string> names;
  for (const auto& o : vessel.openings) {
    if (o.name == name) return o.face;
    names.push_back(o.name);
  }
  problems.push_back(
      {"post." + key, fmt::format("the lumen has no opening '{}'", name), "use one of: " + mesh::list_names(names)});
  return 0;
}

void check_regions(const PostSettings& settings, const mesh::MeshData& data, std::vector<Problem>& problems) {
  if (!settings.lumens) return;
  std::vector<std::string> known;
  for (const auto& region : data.regions)
    if (region.kind == RegionKind::wall) known.push_back(region.name);
  const auto look_up = [&](const std::string& key, const std::vector<std::string>& names) {
    for (const auto& name : names)
      if (!has_wall_region(data, name))
        problems.push_back({"post.lumens." + key, fmt::format("the wall has no region '{}'", name),
                            "use one of: " + mesh::list_names(known)});
  };
  look_up("true_lumen", settings.lumens->true_lumen);
  look_up("false_lumen", settings.lumens->false_lumen);
}

/// Faces and regions that the settings name. Throws InputError with all that the mesh does not have.
void find_ends(const RunDescription& run, const PostSettings& settings, const mesh::MeshData& data, Vessel& vessel) {
  std::vector<Problem> problems;
  vessel.inlet = opening_face(vessel, inlet_name(run, settings), "inlet", problems);
  if (settings.end) vessel.end = opening_face(vessel, *settings.end, "end", problems);
  check_regions(settings, data, problems);
  if (!problems.empty()) throw InputError(std::move(problems));
  if (!settings.end) vessel.end = farthest_opening(data, vessel);
  if (vessel.end == vessel.inlet)
    throw InputError("post.end", "is the inlet", "name the opening at the other end of the aorta");
}

/// A nodal field of the distributed mesh as a whole on all ranks, in the order of MeshData.
std::vector<double> everywhere(const distributed::DistributedMesh& mesh, const std::vector<double>& values) {
  auto field = parallel::gather_by_original_id(
      {mesh.comm, std::span(mesh.original_ids).first(static_cast<std::size_t>(mesh.owned_nodes)), mesh.global_nodes},
      values, 1);
  parallel::broadcast(mesh.comm, field);
  return field;
}

/// Regions by which the lumens are told apart.
std::optional<frames::LumenWalls> lumen_walls(const RunDescription& run, const PostSettings& settings,
                                              const mesh::MeshData& data) {
  if (settings.lumens && run.interface) return settings.lumens;
  const frames::LumenWalls usual{{"true_lumen_wall"}, {"false_lumen_wall"}};
  const bool named = has_wall_region(data, usual.true_lumen[0]) && has_wall_region(data, usual.false_lumen[0]);
  if (named && run.interface) return usual;
  return std::nullopt;
}

/// Says what is left out where nothing tells the lumens apart.
void leave_lumens_out(const RunDescription& run, Vessel& vessel) {
  const std::string why =
      run.interface ? "the wall has no regions true_lumen_wall and false_lumen_wall; name those along the "
                      "lumens in post.lumens"
                    : "there is no wall, whose regions tell the lumens apart, and the mesh of the lumen has no point "
                      "array lumen_side, as tunica mesh writes it";
  vessel.left_out.push_back({"lumens", why});
  vessel.left_out.push_back({"tears", why});
}

frames::Domain domain_of(const RunDescription& run) {
  return run.interface ? frames::Domain::lumen_and_wall : frames::Domain::lumen;
}

void prescribe(const distributed::DistributedMesh& mesh, frames::Domain domain, const std::string& face, double value,
               std::vector<double>& at_nodes) {
  for (const auto& t : mesh.face(face).triangles)
    for (const auto node : t) at_nodes[static_cast<std::size_t>(frames::carrier(mesh, domain, node))] = value;
}

/// 0 at the inlet, one value and unit flux on average at each other opening, so that surfaces of one value cross
/// branches as they cross the aorta.
std::vector<double> potential_along(const RunDescription& run, const mesh::MeshData& data,
                                    const distributed::DistributedMesh& mesh, const Vessel& vessel) {
  frames::LaplaceConditions conditions(mesh);
  for (const auto& opening : vessel.openings) {
    if (opening.face == vessel.inlet) continue;
    prescribe(mesh, domain_of(run), opening.name, static_cast<double>(conditions.flux.size()), conditions.group);
    double area = 0;
    for (const auto& t : data.faces[opening.face].triangles) area += norm(mesh::area_vector(data.points, t));
    conditions.flux.push_back(area);
  }
  prescribe(mesh, domain_of(run), data.faces[vessel.inlet].name, 0, conditions.value);
  return everywhere(mesh, frames::solve_laplace(mesh, domain_of(run), conditions, "Stations along the aorta").phi);
}

/// 0 at the inlet, 1 at the end, no flux elsewhere: a branch holds the value that it has where it leaves.
std::vector<double> potential_towards_end(const RunDescription& run, const mesh::MeshData& data,
                                          const distributed::DistributedMesh& mesh, const Vessel& vessel) {
  frames::LaplaceConditions conditions(mesh);
  prescribe(mesh, domain_of(run), data.faces[vessel.inlet].name, 0, conditions.value);
  prescribe(mesh, domain_of(run), data.faces[vessel.end].name, 1, conditions.value);
  return everywhere(mesh,
                    frames::solve_laplace(mesh, domain_of(run), conditions, "The way to the end of the aorta").phi);
}

/// Connected pieces of the surface on which `side` is zero, without those that a rounding of the surface leaves.
std::vector<Tear> find_tears(const mesh::MeshData& data, const std::vector<double>& side) {
  const auto* lumen = lumen_region(data);
  std::vector<Element> elements;
  for (auto e = lumen->first_element; e < lumen->end_element; ++e)
    if (!cut_element(values_at(side, data.tetrahedra[static_cast<std::size_t>(e)]), 0).empty())
      elements.push_back(data.tetrahedra[static_cast<std::size_t>(e)]);
  const auto group = connected_groups(elements);
  std::vector<Tear> tears;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    tears.resize(std::max(tears.size(), static_cast<std::size_t>(group[e]) + 1));
    auto falling = values_at(side, elements[e]);
    for (auto& v : falling) v = -v;
    append_triangles(cut_element(falling, 0), elements[e], falling, data.points, tears[group[e]].surface);
  }
  double largest = 0;
  for (auto& tear : tears) {
    const auto figures = evaluate(tear.surface, {.points = &data.points});
    tear.area = figures.size;
    tear.centre = figures.centre;
    largest = std::max(largest, tear.area);
  }
  constexpr double speck = 1e-3;
  std::erase_if(tears, [&](const Tear& t) { return t.area < speck * largest; });
  return tears;
}

void mark_openings(const mesh::MeshData& data, Vessel& vessel) {
  for (auto& opening : vessel.openings) {
    double sum = 0;
    for (const auto& t : data.faces[opening.face].triangles)
      for (const auto node : t) sum += vessel.side[static_cast<std::size_t>(node)];
    opening.in_false_lumen = sum < 0;
  }
}

/// Zero at the inlet, and at the end as far as a vessel between the two can be long.
void check_distances(const mesh::MeshData& data, const Vessel& vessel, const std::vector<double>& distance) {
  constexpr double most_winding = 20, slack = 0.05;
  const auto first_of = [&](std::size_t face) { return data.faces[face].triangles[0][0]; };
  const auto value_at = [&](std::int64_t node) { return distance[static_cast<std::size_t>(node)]; };
  const double straight = norm(data.points[static_cast<std::size_t>(first_of(vessel.end))] -
                               data.points[static_cast<std::size_t>(first_of(vessel.inlet))]);
  const double begin = value_at(first_of(vessel.inlet)), end = value_at(first_of(vessel.end));
  if (std::abs(begin) <= slack * straight && end >= (1 - slack) * straight - std::abs(begin) &&
      end <= most_winding * straight)
    return;
  throw InputError(fmt::format("the point array {} of the lumen", mesh::distance_along),
                   fmt::format("is {:.4g} at the inlet and {:.4g} at {}, which are {:.4g} m from each other", begin,
                               end, data.faces[vessel.end].name, straight),
                   "give distances from the inlet in metres, or take the array away: they are found then");
}

void place_tears(Vessel& vessel) {
  for (auto& tear : vessel.tears) tear.distance = distance_along(vessel, tear.centre);
  std::stable_sort(vessel.tears.begin(), vessel.tears.end(),
                   [](const Tear& a, const Tear& b) { return a.distance < b.distance; });
  for (std::size_t k = 0; k < vessel.tears.size(); ++k) vessel.tears[k].name = fmt::format("tear_{}", k + 1);
}

}  // namespace

double distance_along(const Vessel& vessel, const Vec3<double>& place) {
  double nearest = std::numeric_limits<double>::infinity(), distance = 0;
  for (const auto& station : vessel.stations)
    if (const double d = norm(station.centre - place); d < nearest) {
      nearest = d;
      distance = station.distance;
    }
  return distance;
}

const mesh::RegionData* lumen_region(const mesh::MeshData& data) {
  for (const auto& region : data.regions)
    if (region.kind == RegionKind::lumen) return &region;
  return nullptr;
}

std::string inlet_name(const RunDescription& run, const PostSettings& settings) {
  if (settings.inlet) return *settings.inlet;
  const auto& inflows = run.inflow_faces;
  return inflows.size() == 1 ? inflows[0] : "lumen_inlet";
}

void check_ends(const RunDescription& run, const PostSettings& settings, const mesh::MeshData& data) {
  Vessel vessel;
  if (!run.fluid) return;
  sort_faces(run, data, vessel);
  find_ends(run, settings, data, vessel);
  if (const auto* given = mesh::values_named(data.node_fields, mesh::distance_along))
    check_distances(data, vessel, *given);
}

void tell_lumens_apart(const RunDescription& run, const PostSettings& settings, mesh::MeshData& data, MPI_Comm comm) {
  check_ends(run, settings, data);
  if (!run.fluid) return;
  const auto walls = lumen_walls(run, settings, data);
  if (!walls) return;
  const auto mesh = distributed::distribute(data, comm);
  std::erase_if(data.node_fields, [](const auto& field) { return field.name == mesh::lumen_side; });
  data.node_fields.push_back({mesh::lumen_side, everywhere(mesh, frames::lumen_sides(mesh, *walls).phi)});
}

Vessel make_vessel(const RunDescription& run, const PostSettings& settings, const mesh::MeshData& data, MPI_Comm comm) {
  Vessel vessel;
  if (!run.fluid) {
    for (const char* part : {"wall_shear", "openings", "lumens", "tears", "stations"})
      vessel.left_out.push_back({part, "the analysis has no flow"});
    return vessel;
  }
  sort_faces(run, data, vessel);
  find_ends(run, settings, data, vessel);
  const auto mesh = distributed::distribute(data, comm);
  vessel.towards_end = potential_towards_end(run, data, mesh, vessel);
  if (const auto* side = mesh::values_named(data.node_fields, mesh::lumen_side)) vessel.side = *side;
  if (vessel.side.empty()) {
    leave_lumens_out(run, vessel);
  } else {
    const auto* lumen = lumen_region(data);
    for (auto e = lumen->first_element; e < lumen->end_element; ++e)
      vessel.false_share.push_back(
          negative_share(values_at(vessel.side, data.tetrahedra[static_cast<std::size_t>(e)])));
    mark_openings(data, vessel);
    vessel.tears = find_tears(data, vessel.side);
    if (vessel.tears.empty()) vessel.left_out.push_back({"tears", "true and false lumen do not communicate"});
  }
  if (const auto* given = mesh::values_named(data.node_fields, mesh::distance_along)) {
    check_distances(data, vessel, *given);
    vessel.along = *given;
  } else {
    vessel.along = potential_along(run, data, mesh, vessel);
    turn_into_distances(data, vessel);
  }
  vessel.stations = make_stations(data, vessel, settings.spacing);
  place_tears(vessel);
  return vessel;
}

}  // namespace tunica::analysis
