#include "tunica/stages/meshing/mesh_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tunica/artifacts/load_mesh.hpp"
#include "tunica/artifacts/manifest.hpp"
#include "tunica/base/error.hpp"
#include "tunica/config/json_text.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/files/heartbeat.hpp"
#include "tunica/files/lock.hpp"
#include "tunica/files/outputs.hpp"
#include "tunica/mesh/boundary.hpp"
#include "tunica/mesh/quality.hpp"
#include "tunica/mesh_io/simvascular.hpp"
#include "tunica/meshing/assemble.hpp"
#include "tunica/meshing/fidelity.hpp"
#include "tunica/meshing/geometry.hpp"
#include "tunica/meshing/improve.hpp"
#include "tunica/meshing/layers.hpp"
#include "tunica/meshing/mesh_report.hpp"
#include "tunica/meshing/projection.hpp"
#include "tunica/meshing/resolution.hpp"
#include "tunica/meshing/tetrahedralise.hpp"
#include "tunica/meshing/wall_regions.hpp"
#include "tunica/stages/meshing/mesh_page.hpp"

namespace tunica::stages {

namespace {

meshing::FillSettings fill_settings(const case_file::Size& size, const meshing::PreparedSurfaces& prepared) {
  meshing::FillSettings settings;
  if (prepared.inside)
    settings.lumen_size = *prepared.inside;
  else  // a coarse mesh saves elements where the lumen is wide
    settings.in_lumen = std::clamp(1 + 0.25 * (case_file::edge_length(size) / geometry::mm - 2), 1.0, 2.5);
  return settings;
}

meshing::WallLayers find_layers(const geometry::Tetrahedra& mesh, meshing::SurfaceFaces faces) {
  faces.interface.insert(faces.interface.end(), faces.outer.begin(), faces.outer.end());
  return meshing::wall_layers(mesh, faces.interface);
}

/// A hole in the flap or a fold taken for one shows here, whatever the geometry came from.
void compare_tears(const geometry::TriangleSurface& lumen, int parts, std::size_t tears, const files::Say& tell) {
  const auto genus = geometry::genus(lumen, std::ssize(geometry::boundary_loops(lumen)), parts);
  if (tears > 0 && static_cast<std::int64_t>(tears) != genus + 1)
    tell(
        fmt::format("warning: {} tears are found in the mesh, but a lumen of genus {} has {}: look at the tears in the "
                    "report",
                    tears, genus, genus + 1));
}

/// Walls that touch leave elements without volume between them, which no exchange of elements mends.
void check_volumes(const geometry::Tetrahedra& mesh) {
  constexpr double flattest = 1e-3;  // degrees
  std::vector<geometry::Point> flat;
  for (const auto& element : mesh.elements) {
    std::array<geometry::Point, 4> corners;
    for (int k = 0; k < 4; ++k) corners[k] = mesh.points[element[k]];
    if (mesh::quality(corners).smallest_dihedral < flattest) flat.push_back(mesh::centroid(mesh.points, element));
  }
  if (!flat.empty())
    throw SolverError(
        fmt::format("{} elements have no volume, at {}: walls touch there, or a flap is thinner than the elements can "
                    "follow; part or thicken it there, or give a finer `size`",
                    flat.size(), geometry::list_places_mm(flat)));
}

std::string summary_of(const geometry::Tetrahedra& mesh, const std::vector<meshing::Tear>& tears) {
  std::string text = fmt::format("{} tetrahedra, {} tears", mesh.elements.size(), tears.size());
  for (std::size_t t = 0; t < tears.size(); ++t)
    text += fmt::format("{}{:.0f}", t == 0 ? " of " : ", ", 1e6 * tears[t].area);
  return tears.empty() ? text : text + " mm^2";
}

}  // namespace

MadeMesh make_mesh(const case_file::MeshCase& mesh_case, const files::Say& say) {
  files::Heartbeat heartbeat(say);  // TetGen and remeshing are silent for minutes on large meshes
  files::Phases phases([&](const std::string& line) { heartbeat.tell(line); });
  const auto tell = [&](const std::string& state) { phases.tell(state); };
  meshing::ComplexOptions options;
  options.sizes = case_file::size_settings(mesh_case.size);
  // Improving shapes takes a little of the 0.5 mm that are allowed in the end.
  options.accuracy.absolute = 0.45e-3;
  options.log = tell;
  options.spots = mesh_case.output / "problems.vtp";
  phases.begin("surfaces");
  const auto geometry = meshing::surfaces_of(*mesh_case.geometry, options);
  options.lumen_parts = geometry.lumen_parts;
  options.genus = geometry.genus;
  phases.begin("remeshing");
  const auto prepared = meshing::patient_complex(geometry.surfaces, options);
  const auto openings = meshing::with_inlet_first(prepared.openings, geometry.roles);

  phases.begin("tetrahedra");
  geometry::Tetrahedra mesh =
      meshing::tetrahedralise(prepared.complex, prepared.sizes, fill_settings(mesh_case.size, prepared));
  tell(fmt::format("{} elements", mesh.elements.size()));
  phases.begin("shapes");
  const auto project = meshing::projection(prepared);
  meshing::improve(mesh, project, {}, tell);
  check_volumes(mesh);
  if (geometry.thrombus) {
    phases.begin("thrombus");
    tell(fmt::format("{} nodes added", meshing::part_thrombus(mesh, *geometry.thrombus, project, tell)));
  }
  if (mesh_case.elements_through_wall > 1) {
    phases.begin("layers");
    tell(fmt::format("{} nodes added",
                     meshing::double_layers(mesh, find_layers(mesh, meshing::sort_surface(mesh, openings)).bridges)));
    meshing::improve(mesh, project, {.keep_layers = true}, tell);
  }

  if (mesh_case.boundary_layers) {
    phases.begin("boundary layers");
    const auto made = meshing::add_boundary_layers(mesh, *mesh_case.boundary_layers);
    tell(fmt::format("{:.2f} to {:.2f} mm thick, median {:.2f} mm", 1e3 * made.smallest, 1e3 * made.largest,
                     1e3 * made.median));
  }
  phases.begin("regions and faces");
  const auto faces = meshing::sort_surface(mesh, openings);
  auto regions = meshing::wall_regions(mesh, faces, openings, geometry.roles);
  if (geometry.thrombus)
    tell(fmt::format("thrombus: {:.2f} ml", 1e6 * meshing::mark_thrombus(mesh, *geometry.thrombus, regions)));
  auto data = meshing::assemble(mesh, openings, faces, regions);
  phases.begin("report");
  const auto fidelity = meshing::fidelity(mesh, faces.interface, faces.outer, prepared);
  const auto layers = find_layers(mesh, faces);
  const auto tears = meshing::find_tears(mesh, regions.side);
  compare_tears(prepared.lumen.surface(), options.lumen_parts, tears.size(), tell);
  const auto across = meshing::resolution(mesh, openings, faces, regions, tears);
  phases.end();
  const auto report = meshing::mesh_report({data, layers, fidelity, prepared.thickness, tears, phases.seconds,
                                            artifacts::peak_memory(), case_file::describe(mesh_case.size), across});
  return {std::move(data), config::json_text(report), meshing::report_text(report),
          mesh_page({mesh_case.title, mesh, regions, tears, prepared, report}), summary_of(mesh, tears)};
}

WrittenMesh mesh_to_files(const case_file::MeshCase& mesh_case, bool overwrite, const files::Say& say,
                          const std::function<void()>& before_work) {
  const auto& folder = mesh_case.output;
  const auto report_file = folder / "report.json";
  const files::FolderLock lock(folder);
  if (!lock.taken_over().empty()) say("warning: " + lock.taken_over());
  if (!overwrite && std::filesystem::exists(report_file))
    throw InputError(folder.string(), "holds a mesh already", "give --overwrite, or another `output`");
  std::vector<std::filesystem::path> planned{"meshes.yaml", "report.json", "report.html"};
  for (const std::filesystem::path part : {"lumen", "wall"})
    planned.insert(planned.end(), {part / "mesh-complete.mesh.vtu", part / "mesh-surfaces/face.vtp"});
  files::try_outputs(folder, planned);
  before_work();
  const MadeMesh made = make_mesh(mesh_case, say);
  mesh_io::write_simvascular(folder / "lumen", made.data, mesh::RegionKind::lumen, geometry::mm);
  const auto regions = mesh_io::write_simvascular(folder / "wall", made.data, mesh::RegionKind::wall, geometry::mm);
  files::write_atomically(folder / "meshes.yaml",
                          artifacts::meshes_section(regions, case_file::InterfaceSettings{{meshing::lumen_interface},
                                                                                          {meshing::wall_interface}}));
  files::write_atomically(folder / "report.html", made.report_page);
  files::write_atomically(report_file, made.report_json);
  return {made.report_text, made.summary};
}

}  // namespace tunica::stages
