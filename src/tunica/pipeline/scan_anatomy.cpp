#include "tunica/pipeline/scan_anatomy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "tunica/artifacts/load_mesh.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/limits.hpp"
#include "tunica/config/units.hpp"
#include "tunica/geometry/parametric_dissection.hpp"
#include "tunica/mesh/boundary.hpp"
#include "tunica/mesh/lumen_fields.hpp"
#include "tunica/mesh_io/vtk_files.hpp"
#include "tunica/parallel/agree.hpp"
#include "tunica/pipeline/figures.hpp"
#include "tunica/stages/vessel_of_case.hpp"

namespace tunica::pipeline {

namespace {

namespace fs = std::filesystem;
using base::nan;
/// Of stations that tell the elements of the aorta from those of branches [m].
constexpr double fine_spacing = 1e-3;
/// Share of the radius in a direction from which on the edge of the lumens is that of the wall, and no flap.
constexpr double at_edge = 0.9;

/// The lumen and the wall of the mesh, whichever of them the case computes.
analysis::RunDescription describe(const Chain& chain, const case_file::MeshSettings& meshes) {
  case_file::Case c = chain.settings;
  c.meshes = meshes;
  auto run = case_file::describe(c);
  run.fluid = meshes.has_lumen();
  run.wall = meshes.has_wall();
  return run;
}

std::vector<std::array<std::int64_t, 3>> edge_triangles(const analysis::Vessel& vessel,
                                                        const analysis::Anatomy& anatomy) {
  std::vector<std::array<std::int64_t, 3>> triangles;
  for (const auto& t : vessel.inside) {
    const bool at_wall = std::all_of(t.begin(), t.end(), [&](std::int64_t node) {
      const auto& at = anatomy.nodes[static_cast<std::size_t>(node)];
      return std::isfinite(at.radius) && at.radius > at_edge * anatomy.inner_radius(at.s, at.angle);
    });
    if (at_wall) triangles.push_back(t);
  }
  return triangles;
}

/// Gives nodes that no element of the lumen has the mean of those neighbours that are nearer to the lumen.
void extend_from_lumen(const mesh::MeshData& data, std::vector<double>& values) {
  std::vector<std::uint8_t> known(data.points.size(), 0);
  const auto* lumen = analysis::lumen_region(data);
  for (auto e = lumen->first_element; e < lumen->end_element; ++e)
    for (const auto node : data.tetrahedra[static_cast<std::size_t>(e)]) known[static_cast<std::size_t>(node)] = 1;
  for (const auto& [wall, host] : data.twins) {
    values[static_cast<std::size_t>(wall)] = values[static_cast<std::size_t>(host)];
    known[static_cast<std::size_t>(wall)] = 1;
  }
  for (bool more = true; more;) {
    std::map<std::int64_t, std::pair<double, int>> next;
    for (const auto& nodes : data.tetrahedra)
      for (const auto to : nodes)
        for (const auto from : nodes)
          if (known[static_cast<std::size_t>(to)] == 0 && known[static_cast<std::size_t>(from)] != 0) {
            next[to].first += values[static_cast<std::size_t>(from)];
            ++next[to].second;
          }
    for (const auto& [node, sum] : next) {
      values[static_cast<std::size_t>(node)] = sum.first / sum.second;
      known[static_cast<std::size_t>(node)] = 1;
    }
    more = !next.empty();
  }
}

// --- loads ----------------------------------------------------------------------------------------------------------

/// Means of what lies nearest to each of the stations, between the first and the last.
class StationMeans {
 public:
  StationMeans(const analysis::Anatomy& anatomy, const std::vector<double>& stations)
      : anatomy_(anatomy), stations_(stations), sum_(stations.size(), 0), weight_(stations.size(), 0) {}

  /// `place` in m. What lies in the flap, in branches or elsewhere is left out.
  void add(const Vec3<double>& place, double value, double weight) {
    if (!std::isfinite(value)) return;
    const auto at = anatomy_.line.coordinates(place);
    const double inner = anatomy_.inner_radius(at.s, at.angle), outer = anatomy_.outer_radius(at.s, at.angle);
    if (at.radius < at_edge * inner || at.radius > outer + (1 - at_edge) * inner) return;
    const auto next = std::lower_bound(stations_.begin(), stations_.end(), at.s);
    if (next == stations_.begin() || next == stations_.end()) return;
    const auto k = static_cast<std::size_t>(next - stations_.begin()) - (at.s - next[-1] < *next - at.s ? 1 : 0);
    sum_[k] += weight * value;
    weight_[k] += weight;
  }
  std::vector<double> means() const {
    std::vector<double> means;
    for (std::size_t k = 0; k < sum_.size(); ++k) means.push_back(weight_[k] > 0 ? sum_[k] / weight_[k] : nan);
    return means;
  }

 private:
  const analysis::Anatomy& anatomy_;
  const std::vector<double>& stations_;
  std::vector<double> sum_, weight_;
};

const std::vector<double>& values_named(const std::vector<mesh::ElementField>& fields, const std::string& name) {
  return std::find_if(fields.begin(), fields.end(), [&](const auto& f) { return f.name == name; })->values;
}

void add_shear(const fs::path& file, StationMeans& means) {
  constexpr const char* name = "TAWSS [Pa]";
  const auto cells = mesh_io::read_vtk_surface(file, {name});
  const auto& tawss = std::find_if(cells.node_fields.begin(), cells.node_fields.end(), [&](const auto& f) {
                        return f.name == name;
                      })->values;
  for (std::size_t c = 0; c + 1 < cells.offsets.size(); ++c) {
    std::array<std::int64_t, 3> t;
    for (std::size_t i = 0; i < 3; ++i) t[i] = cells.connectivity[static_cast<std::size_t>(cells.offsets[c]) + i];
    double mean = 0;
    for (const auto node : t) mean += tawss[static_cast<std::size_t>(node)] / 3;
    means.add(geometry::mm * mesh::centroid(cells.points, t), mean, norm(mesh::area_vector(cells.points, t)));
  }
}

void add_stress(const fs::path& file, StationMeans& means) {
  constexpr const char* name = "largest von Mises stress [kPa]";
  const auto cells = mesh_io::read_vtk_volume(file, {name});
  const auto& stress = values_named(cells.fields, name);
  for (std::size_t c = 0; c + 1 < cells.offsets.size(); ++c) {
    std::array<std::int64_t, 4> t;
    for (std::size_t i = 0; i < 4; ++i) t[i] = cells.connectivity[static_cast<std::size_t>(cells.offsets[c]) + i];
    means.add(geometry::mm * mesh::centroid(cells.points, t), 1e3 * stress[c], mesh::volume(cells.points, t));
  }
}

/// Of the stations of `post`, linear between them.
std::vector<double> pressure_differences(const fs::path& file, const analysis::Anatomy& anatomy,
                                         const std::vector<double>& stations) {
  std::vector<std::pair<double, double>> given;
  const auto post = read_json(file);
  for (const auto& station : post.value("stations", nlohmann::json::array())) {
    if (!station.contains("true_minus_false_pressure")) continue;
    const auto& centre = station.at("centre_mm");
    const Vec3<double> place{{centre[0].get<double>(), centre[1].get<double>(), centre[2].get<double>()}};
    given.emplace_back(anatomy.line.coordinates(geometry::mm * place).s,
                       config::unit_factor("mmHg", config::dimension::pressure) *
                           station["true_minus_false_pressure"]["mean_mmHg"].get<double>());
  }
  std::sort(given.begin(), given.end());
  std::vector<double> values;
  for (const double s : stations) {
    const auto after =
        std::lower_bound(given.begin(), given.end(), s, [](const auto& pair, double v) { return pair.first < v; });
    if (after == given.begin() || after == given.end()) {
      values.push_back(nan);
      continue;
    }
    const auto before = after - 1;
    const double t = (s - before->first) / (after->first - before->first);
    values.push_back((1 - t) * before->second + t * after->second);
  }
  return values;
}

}  // namespace

case_file::MeshSettings meshes_of(const Chain& chain) {
  if (!chain.settings.mesh) return chain.settings.meshes;
  const fs::path file = folder_of(chain, stage("mesh")) / "meshes.yaml";
  const config::Document document(config::read_text(file), file.string());
  return config::parse_document(case_file::MeshSettings::schema(), document.part("meshes"),
                                {.name = file.string(), .folder = file.parent_path()})
      .value;
}

std::optional<ScanAnatomy> scan_anatomy(const Chain& chain, double spacing, MPI_Comm comm) {
  analysis::RunDescription run;
  analysis::PostSettings settings;
  mesh::MeshData data;
  const bool solves_wall = chain.settings.solves_wall();
  parallel::agree(comm, [&] {
    const auto meshes = meshes_of(chain);
    if (!meshes.has_lumen())
      throw InputError(chain.file.string(), "has a mesh without a lumen", "name the mesh of the blood as well");
    run = describe(chain, meshes);
    settings = stages::post_settings(chain.settings);
    settings.spacing = fine_spacing;
    data = artifacts::load_meshes(meshes, {}).data;
  });
  analysis::tell_lumens_apart(run, settings, data, comm);
  const auto vessel = analysis::make_vessel(run, settings, data, comm);
  auto along = vessel.along;
  if (run.interface && !solves_wall) {
    // Stage `post` sees the lumen alone, whose centreline runs elsewhere than that of lumen and flap.
    run.interface = false;
    along = analysis::make_vessel(run, settings, data, comm).along;
  }
  if (!run.interface || std::any_of(along.begin(), along.end(), [](double s) { return std::isnan(s); }))
    extend_from_lumen(data, along);
  std::erase_if(data.node_fields, [](const auto& field) { return field.name == mesh::distance_along; });
  data.node_fields.push_back({mesh::distance_along, std::move(along)});
  std::optional<ScanAnatomy> result;
  parallel::on_root(comm, [&] {
    auto anatomy = analysis::make_anatomy(data, vessel, spacing, settings.flap);
    auto edge = edge_triangles(vessel, anatomy);
    const std::string end = data.faces[vessel.end].name;
    result.emplace(ScanAnatomy{std::move(data), end, std::move(edge), std::move(anatomy)});
  });
  return result;
}

StationLoads station_loads(const Chain& chain, const ScanAnatomy& scan, const std::vector<double>& stations) {
  const fs::path post = folder_of(chain, stage("post"));
  StationLoads loads;
  StationMeans shear(scan.anatomy, stations), stress(scan.anatomy, stations);
  if (fs::exists(post / "wall_shear.vtp")) add_shear(post / "wall_shear.vtp", shear);
  if (fs::exists(post / "stress.vtu")) add_stress(post / "stress.vtu", stress);
  loads.tawss = shear.means();
  loads.stress = stress.means();
  loads.pressure_difference = pressure_differences(post / "post.json", scan.anatomy, stations);
  return loads;
}

}  // namespace tunica::pipeline
