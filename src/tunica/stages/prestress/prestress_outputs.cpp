// What a prestress leaves in its folder, and what it says on the way.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tunica/artifacts/checkpoint.hpp"
#include "tunica/artifacts/fields.hpp"
#include "tunica/artifacts/prestress_file.hpp"
#include "tunica/base/digits.hpp"
#include "tunica/config/json_text.hpp"
#include "tunica/coupling/nodal.hpp"
#include "tunica/drawing/plot.hpp"
#include "tunica/field_io/array_name.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/files/hash.hpp"
#include "tunica/mesh/boundary.hpp"
#include "tunica/mesh_io/simvascular.hpp"
#include "tunica/parallel/agree.hpp"
#include "tunica/stages/prestress/prestress_run.hpp"
#include "tunica/wall/parameters.hpp"

namespace tunica::stages {

using coupling::at;
using mesh::RegionKind;
using nlohmann::ordered_json;

const char* name_of(coupling::PrestressSettings::Method method) {
  using Method = coupling::PrestressSettings::Method;
  return method == Method::stress ? "stress" : method == Method::stretch ? "stretch" : "inverse";
}

parallel::NodeOrder node_order(const distributed::DistributedMesh& mesh) {
  return {mesh.comm, std::span(mesh.original_ids).first(static_cast<std::size_t>(mesh.owned_nodes)), mesh.global_nodes};
}

// Force over area at a node, for the eye. Forces on corners of quadratic triangles are differences that say little:
// they show the mean of the edges beside them.
void PrestressRun::write_traction(const coupling::Problem& problem) {
  std::vector<double> area(static_cast<std::size_t>(wall_.nodes()), 0.0);
  for (const auto& face : wall_.faces) {
    if (std::find(wall_interface_.begin(), wall_interface_.end(), face.name) == wall_interface_.end()) continue;
    for (std::size_t k = 0; k < face.triangles.size(); ++k) {
      const double third = norm(mesh::area_vector(wall_.points, face.triangles[k])) / 3.0;
      for (const auto node : wall_.quadratic ? face.edges[k] : face.triangles[k])
        area[static_cast<std::size_t>(node)] += third;
    }
  }
  wall_.halo.update(area, 1);
  std::vector<double> traction(local_forces_.size(), 0.0);
  for (std::size_t k = 0; k < traction.size(); ++k)
    if (area[k / 4] > 0) traction[k] = local_forces_[k] / area[k / 4];
  if (wall_.quadratic) set_corners_to_mean(traction);
  const std::string unit = case_.output.units.stress;
  const distributed::NodalArray array{.name = field_io::array_name("traction", unit),
                                      .components = 3,
                                      .values = traction,
                                      .stride = 4,
                                      .factor = per_si(unit, config::dimension::pressure)};
  distributed::ResultsWriter writer(problem.mesh(), results_in("traction"));
  writer.write(0, 0.0, std::span(&array, 1), {});
}

// Mean of the edges of the interface that meet at a corner, [local node][4].
void PrestressRun::set_corners_to_mean(std::vector<double>& traction) const {
  std::vector<double> count(static_cast<std::size_t>(wall_.nodes()), 0.0);
  for (const auto& name : wall_interface_) {
    const auto& face = wall_.face(name);
    for (std::size_t k = 0; k < face.triangles.size(); ++k)
      for (std::size_t i = 0; i < 3; ++i)
        for (const auto corner : {face.triangles[k][i], face.triangles[k][(i + 1) % 3]}) {
          count[static_cast<std::size_t>(corner)] += 1;
          for (std::size_t c = 0; c < 3; ++c) {
            double& value = traction[at(corner) + c];
            value = count[static_cast<std::size_t>(corner)] > 1 ? value : 0.0;
            value += traction[at(face.edges[k][i]) + c];
          }
        }
  }
  for (std::size_t k = 0; k < traction.size(); ++k)
    if (count[k / 4] > 0) traction[k] /= count[k / 4];
  wall_.halo.update(traction, 4);
}

void PrestressRun::follow(const coupling::PrestressRecord& r) {
  const std::string unit = case_.output.units.length;
  const double displacement = r.displacement * per_si(unit, config::dimension::length);
  const Vec3<double> place = per_si(unit, config::dimension::length) * r.place;
  const std::string found = r.failure.empty() ? fmt::format("{:.3e} {} near ({:.4g}, {:.4g}, {:.4g})", displacement,
                                                            unit, place[0], place[1], place[2])
                                              : fmt::format("no equilibrium ({})", r.failure);
  const std::string line =
      fmt::format("iteration {}: {}; {:.3g} of the update, load {:.3g}, newton {}, linear {}, {:.2f} s", r.iteration,
                  found, r.relaxation, r.load, r.newton, r.linear, r.seconds);
  // Nobody knows how many there will be: on a terminal the last one stands in the place of a bar.
  if (log_->on_terminal()) {
    log_->detail(line);
    log_->status(fmt::format("prestress, {}", line.substr(0, line.find('\n')))
                     .substr(0, static_cast<std::size_t>(log_->columns() - 1)));
  } else {
    log_->info(line);
  }
  parallel::on_root(comm_, [&] {
    history_->append(r.iteration, std::array{displacement, r.relaxation, r.load, static_cast<double>(r.newton),
                                             static_cast<double>(r.linear), r.seconds});
  });
}

void PrestressRun::plot_history(const std::vector<coupling::PrestressRecord>& history) {
  const std::string unit = case_.output.units.length;
  const double factor = per_si(unit, config::dimension::length);
  drawing::Series displacement{.name = "largest displacement", .x = {}, .y = {}, .markers = true},
      asked{.name = "asked", .x = {}, .y = {}, .dashed = true};
  for (const auto& r : history) {
    displacement.x.push_back(r.iteration), displacement.y.push_back(factor * r.displacement);
    asked.x.push_back(r.iteration), asked.y.push_back(factor * settings().fixed_point.tolerance);
  }
  parallel::on_root(comm_, [&] {
    drawing::write_plot((folder_ / "fixed_point.svg").string(), {displacement, asked},
                        {.title = "Fixed point of the prestress",
                         .x_label = "iteration",
                         .y_label = fmt::format("displacement under the load [{}]", unit),
                         .log_y = true});
  });
}

void PrestressRun::write_prestress_file(const coupling::WallPrestress& prestress) {
  const int n = wall::components(prestress.kind) * coupling::prestress_points(wall_.quadratic);
  std::vector<std::int64_t> ids;
  std::vector<double> values;
  for (std::size_t r = 0; r < wall_.regions.size(); ++r) {
    const auto owned = static_cast<std::ptrdiff_t>(wall_.regions[r].owned_elements);
    ids.insert(ids.end(), wall_.regions[r].element_ids.begin(), wall_.regions[r].element_ids.begin() + owned);
    values.insert(values.end(), prestress.values[r].begin(), prestress.values[r].begin() + n * owned);
  }
  const auto all = parallel::gather_by_original_id({comm_, ids, wall_.global_elements}, values, n);
  parallel::on_root(comm_,
                    [&] { artifacts::write_prestress(folder_ / "wall.vtu", wall_part_.data, prestress.kind, all); });
}

// A mesh like any other: what a case or a mesher that wants the wall without its load reads.
void PrestressRun::write_unloaded(const std::vector<double>& unloading) {
  const auto U = parallel::gather_by_original_id(
      node_order(wall_), std::span(unloading).first(3 * static_cast<std::size_t>(wall_.owned_nodes)), 3);
  const double metres_per_unit = config::unit_factor(case_.output.units.length, config::dimension::length);
  parallel::on_root(comm_, [&] {
    mesh::MeshData unloaded = wall_part_.data;
    for (std::size_t i = 0; i < unloaded.points.size(); ++i)
      for (std::size_t c = 0; c < 3; ++c) unloaded.points[i][static_cast<int>(c)] -= U[3 * i + c];
    unloaded.fields.clear();  // directions of fibres are those of the image
    mesh_io::write_simvascular(folder_ / "unloaded", unloaded, RegionKind::wall, metres_per_unit);
  });
}

void PrestressRun::write_stress(const coupling::Problem& problem, const coupling::State& state) {
  artifacts::OutputFields fields(problem, wall_case(case_, wall_faces_));
  distributed::ResultsWriter writer(wall_, results_in("wall"));
  fields.write(writer, 0, 0.0, state);
}

void PrestressRun::write_start(const coupling::State& wall) {
  const auto of_wall = parallel::gather_by_original_id(node_order(wall_), wall.velocity_pressure, 4);
  std::vector<double> of_lumen, all;
  if (case_.solves_fluid()) of_lumen = parallel::gather_by_original_id(node_order(lumen_), flow_.velocity_pressure, 4);
  parallel::on_root(comm_, [&] {
    all.assign(4 * whole_.data.points.size(), 0.0);
    for (std::size_t k = 0; k < wall_part_.nodes.size(); ++k)
      all[4 * static_cast<std::size_t>(wall_part_.nodes[k]) + 3] = of_wall[4 * k + 3];
    for (std::size_t k = 0; k < lumen_part_.nodes.size(); ++k)
      for (std::size_t c = 0; c < 4; ++c)
        all[4 * static_cast<std::size_t>(lumen_part_.nodes[k]) + c] = of_lumen[4 * k + c];
  });
  const auto mesh = distributed::distribute(whole_.data, comm_);
  artifacts::Checkpoint start;
  start.mesh_hash = mesh_hash_;
  for (auto* field : {&start.state.velocity_pressure, &start.state.acceleration, &start.state.displacement,
                      &start.state.displacement_rate})
    field->assign(at(mesh.nodes()), 0.0);
  parallel::scatter_by_original_id(node_order(mesh), all, start.state.velocity_pressure, 4);
  mesh.halo.update(start.state.velocity_pressure, 4);
  for (std::size_t k = 3; k < start.state.velocity_pressure.size(); k += 4)
    start.state.end_pressure.push_back(start.state.velocity_pressure[k]);
  start.state.outlets = flow_.outlets;
  artifacts::write_checkpoint(folder_ / "start.checkpoint", mesh, start);
}

void PrestressRun::write_report(const coupling::PrestressResult& result) {
  ordered_json json;
  json["program"] = {{"version", request_.program.version}, {"commit", request_.program.commit}};
  json["case_file"] = request_.case_file.string();
  json["case"] = text_;
  json["mesh_hash"] = files::hex(mesh_hash_);
  json["status"] = result.converged ? "completed" : "failed";
  json["converged"] = result.converged;
  if (!result.converged) json["failure"] = result.failure;
  json["method"] = name_of(result.method);
  if (!result.inverse_failure.empty()) json["no_unloaded_shape"] = result.inverse_failure;
  json["iterations"] = result.history.size();
  json["largest_displacement_m"] = result.history.empty() ? 0.0 : result.history.back().displacement;
  if (case_.solves_fluid())
    json["steady_flow"] = {{"steps", steady_.step},
                           {"time_s", base::without_noise(steady_.time)},
                           {"change_of_velocity_in_the_last_step", steady_.velocity_change},
                           {"change_of_pressure_in_the_last_step", steady_.pressure_change}};
  json["seconds"] = MPI_Wtime() - started_;
  parallel::on_root(comm_, [&] { files::write_atomically(folder_ / prestress_report_file, config::json_text(json)); });
}

}  // namespace tunica::stages
