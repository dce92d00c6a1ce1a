#include "tunica/stages/meshing/mesh_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tunica/base/error.hpp"
#include "tunica/mesh/series_file.hpp"
#include "tunica/mesh/simvascular.hpp"
#include "tunica/stages/load_mesh.hpp"
#include "tunica/stages/manifest.hpp"
#include "tunica/stages/meshing/assemble.hpp"
#include "tunica/stages/meshing/fidelity.hpp"
#include "tunica/stages/meshing/improve.hpp"
#include "tunica/stages/meshing/layers.hpp"
#include "tunica/stages/meshing/mesh_page.hpp"
#include "tunica/stages/meshing/mesh_report.hpp"
#include "tunica/stages/meshing/projection.hpp"
#include "tunica/stages/meshing/tetrahedralise.hpp"
#include "tunica/stages/meshing/wall_regions.hpp"
#include "tunica/stages/phases.hpp"

namespace tunica::stages::meshing {

namespace {

using config::Schema;

Schema<Size> size_schema() {
  return Schema<Size>("size", "How fine the mesh is; numbers of tetrahedra are those of the usual dissection.")
      .one_of()
      .alternative(Schema<Coarse>("coarse", "About 70 000 tetrahedra."))
      .alternative(Schema<Medium>("medium", "About 300 000."))
      .alternative(Schema<Full>("full", "About 1.3 million."))
      .quantity("edge", config::emplace<double>, config::dimension::length, config::range(0.2 * mm, 10 * mm),
                "Edge length on the surfaces of lumen and wall");
}

/// A coarse mesh saves elements where the lumen is wide.
FillSettings fill_settings(double edge) {
  FillSettings settings;
  settings.in_lumen = std::clamp(1 + 0.25 * (edge / mm - 2), 1.0, 2.5);
  return settings;
}

WallLayers find_layers(const Tetrahedra& mesh, SurfaceFaces faces) {
  faces.interface.insert(faces.interface.end(), faces.outer.begin(), faces.outer.end());
  return wall_layers(mesh, faces.interface);
}

}  // namespace

double edge_length(const Size& size) {
  if (std::holds_alternative<Coarse>(size)) return 7 * mm;
  if (std::holds_alternative<Medium>(size)) return 3.2 * mm;
  if (std::holds_alternative<Full>(size)) return 2.0 * mm;
  return std::get<double>(size);
}

SizeSettings size_settings(double edge) {
  SizeSettings settings;
  settings.largest = edge;
  settings.per_radius = std::min(0.8, 0.17 * edge / mm);
  settings.per_thickness = std::min(2.0, 0.35 * edge / mm);
  settings.smallest = std::min(0.6 * mm, 0.2 * edge);
  return settings;
}

Schema<MeshCase> MeshCase::schema() {
  return Schema<MeshCase>("tunica mesh", "File of `tunica mesh`, in YAML like a case file.")
      .text("title", &MeshCase::title, "Free text for logs and reports")
      .by_default()
      .section("geometry", &MeshCase::geometry, geometry_schema(), "What is meshed")
      .section("size", &MeshCase::size, size_schema(), "How fine")
      .by_default("medium")
      .integer("elements_through_wall", &MeshCase::elements_through_wall, config::range(1, 2),
               "Elements that wall and flap are thick, at least")
      .by_default()
      .section("boundary_layers", &MeshCase::boundary_layers, BoundaryLayers::schema(),
               "Thin layers at the wall of the lumen; `{}` for three, none when left out")
      .optional()
      .path("output", &MeshCase::output, "Folder of the mesh, relative to that of this file")
      .by_default("mesh");
}

config::Parsed<MeshCase> read_mesh_case(const std::filesystem::path& file) {
  return config::parse_file(MeshCase::schema(), file);
}

MadeMesh make_mesh(const MeshCase& mesh_case, const Say& say) {
  Phases phases(say);
  const auto tell = [&](const std::string& state) { phases.tell(state); };
  ComplexOptions options;
  const double edge = edge_length(mesh_case.size);
  options.sizes = size_settings(edge);
  // Improving shapes takes a little of the 0.5 mm that are allowed in the end.
  options.accuracy.absolute = 0.45e-3;
  options.log = tell;
  options.spots = mesh_case.output / "problems.vtp";
  phases.begin("surfaces");
  const auto geometry = surfaces_of(mesh_case.geometry, options);
  options.lumen_parts = geometry.lumen_parts;
  phases.begin("remeshing");
  const auto prepared = patient_complex(geometry.surfaces, options);
  const auto openings = with_inlet_first(prepared.openings, geometry.roles);

  phases.begin("tetrahedra");
  Tetrahedra mesh = tetrahedralise(prepared.complex, prepared.sizes, fill_settings(edge));
  tell(fmt::format("{} elements", mesh.elements.size()));
  phases.begin("shapes");
  const auto project = projection(prepared);
  improve(mesh, project, {}, tell);
  if (mesh_case.elements_through_wall > 1) {
    phases.begin("layers");
    tell(fmt::format("{} nodes added", double_layers(mesh, find_layers(mesh, sort_surface(mesh, openings)).bridges)));
    improve(mesh, project, {.keep_layers = true}, tell);
  }

  if (mesh_case.boundary_layers) {
    phases.begin("boundary layers");
    const auto made = add_boundary_layers(mesh, *mesh_case.boundary_layers);
    tell(fmt::format("{:.2f} to {:.2f} mm thick, median {:.2f} mm", 1e3 * made.smallest, 1e3 * made.largest,
                     1e3 * made.median));
  }
  phases.begin("regions and faces");
  const auto faces = sort_surface(mesh, openings);
  const auto regions = wall_regions(mesh, faces, openings, geometry.roles);
  auto data = assemble(mesh, openings, faces, regions);
  phases.begin("report");
  const auto fidelity = meshing::fidelity(mesh, faces.interface, faces.outer, prepared);
  const auto layers = find_layers(mesh, faces);
  const auto tears = find_tears(mesh, regions.side);
  phases.end();
  const auto report = mesh_report({data, layers, fidelity, prepared.thickness, tears, phases.seconds, peak_memory()});
  return {std::move(data), report.dump(2) + "\n", report_text(report),
          mesh_page({mesh_case.title, mesh, regions, tears, prepared, report})};
}

std::string mesh_to_files(const MeshCase& mesh_case, bool overwrite, const Say& say) {
  const auto& folder = mesh_case.output;
  const auto report_file = folder / "report.json";
  if (!overwrite && std::filesystem::exists(report_file))
    throw InputError(folder.string(), "holds a mesh already", "give --overwrite, or another `output`");
  const MadeMesh made = make_mesh(mesh_case, say);
  mesh::write_simvascular(folder / "lumen", made.data, mesh::RegionKind::lumen, mm);
  const auto regions = mesh::write_simvascular(folder / "wall", made.data, mesh::RegionKind::wall, mm);
  mesh::write_atomically(folder / "meshes.yaml",
                         meshes_section(regions, InterfaceSettings{{lumen_interface}, {wall_interface}}));
  mesh::write_atomically(folder / "report.html", made.report_page);
  mesh::write_atomically(report_file, made.report_json);
  return made.report_text;
}

}  // namespace tunica::stages::meshing
