#include "tunica/stages/meshing/mesh_case.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "tunica/mesh/series_file.hpp"
#include "tunica/mesh/simvascular.hpp"
#include "tunica/stages/load_mesh.hpp"
#include "tunica/stages/manifest.hpp"
#include "tunica/stages/meshing/assemble.hpp"
#include "tunica/stages/meshing/dissection_model.hpp"
#include "tunica/stages/meshing/improve.hpp"
#include "tunica/stages/meshing/layers.hpp"
#include "tunica/stages/meshing/mesh_report.hpp"
#include "tunica/stages/meshing/tetrahedralise.hpp"
#include "tunica/stages/meshing/wall_regions.hpp"
#include "tunica/stages/phases.hpp"

namespace tunica::stages::meshing {

namespace {

using config::Schema;

Schema<Size> size_schema() {
  return Schema<Size>("size", "How fine the mesh is; numbers of tetrahedra are those of the usual dissection.")
      .one_of()
      .alternative(Schema<Coarse>("coarse", "About 130 000 tetrahedra: the walls are too thin for fewer."))
      .alternative(Schema<Medium>("medium", "About 280 000."))
      .alternative(Schema<Full>("full", "About 1.2 million."))
      .quantity("edge", config::emplace<double>, config::dimension::length, config::range(0.2 * mm, 10 * mm),
                "Edge length on the surfaces of lumen and wall");
}

Schema<Geometry> geometry_schema() {
  return Schema<Geometry>("geometry", "What is meshed.").one_of().alternative(ParametricDissection::schema());
}

std::vector<Cap> make_caps(const SurfaceFaces& faces, const std::vector<Opening>& openings) {
  std::vector<Cap> caps;
  for (std::size_t o = 0; o < openings.size(); ++o)
    caps.push_back({faces.caps[o], openings[o].name != "inlet" && openings[o].name != "abdominal_aorta"});
  return caps;
}

WallLayers find_layers(const Tetrahedra& mesh, const std::vector<Opening>& openings) {
  auto faces = sort_surface(mesh, openings);
  faces.interface.insert(faces.interface.end(), faces.outer.begin(), faces.outer.end());
  return wall_layers(mesh, faces.interface);
}

}  // namespace

double edge_length(const Size& size) {
  if (std::holds_alternative<Coarse>(size)) return 5 * mm;
  if (std::holds_alternative<Medium>(size)) return 1.85 * mm;
  if (std::holds_alternative<Full>(size)) return 1.0 * mm;
  return std::get<double>(size);
}

Schema<MeshCase> MeshCase::schema() {
  return Schema<MeshCase>("tunica mesh", "File of `tunica mesh`, in YAML like a case file.")
      .text("title", &MeshCase::title, "Free text for logs and reports")
      .by_default()
      .section("geometry", &MeshCase::geometry, geometry_schema(), "What is meshed")
      .section("size", &MeshCase::size, size_schema(), "How fine")
      .by_default("medium")
      .number("at_tears", &MeshCase::at_tears, config::range(0.2, 1),
              "Edge length at the rims of the tears, as a share of that elsewhere")
      .by_default()
      .integer("elements_through_wall", &MeshCase::elements_through_wall, config::range(1, 4),
               "Elements that wall and flap are thick, at least")
      .by_default()
      .path("output", &MeshCase::output, "Folder of the mesh, relative to that of this file")
      .by_default("mesh");
}

config::Parsed<MeshCase> read_mesh_case(const std::filesystem::path& file) {
  return config::parse_file(MeshCase::schema(), file);
}

MadeMesh make_mesh(const MeshCase& mesh_case, const Say& say) {
  const DissectionModel model(std::get<ParametricDissection>(mesh_case.geometry));
  const DissectionSizes sizes{.edge = edge_length(mesh_case.size), .at_tears = mesh_case.at_tears};
  Phases phases(say);
  const auto follow = [&](const std::string& phase, const std::string& state) {
    if (phase != phases.phase())
      phases.begin(phase);
    else
      phases.tell(state);
  };
  const LabelDomain domain = label_domain(model, sizes);
  Tetrahedra mesh = tetrahedralise(domain, follow);
  phases.begin("shapes");
  const auto tell = [&](const std::string& state) { phases.tell(state); };
  improve(mesh, projection(domain), {}, tell);
  if (mesh_case.elements_through_wall > 1) {
    phases.begin("layers");
    tell(fmt::format("{} nodes added", double_layers(mesh, find_layers(mesh, model.openings()).bridges)));
    improve(mesh, projection(domain), {.keep_layers = true}, tell);
  }
  phases.begin("regions and faces");
  const auto faces = sort_surface(mesh, model.openings());
  const auto regions = find_wall_regions(mesh, make_caps(faces, model.openings()), {});
  auto data = assemble(mesh, model.openings(), faces, regions);
  phases.end();
  const auto report = mesh_report({data, find_layers(mesh, model.openings()), phases.seconds, peak_memory()});
  return {std::move(data), report.dump(2) + "\n", report_text(report)};
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
  mesh::write_atomically(report_file, made.report_json);
  return made.report_text;
}

}  // namespace tunica::stages::meshing
