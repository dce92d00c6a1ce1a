#include "tunica/case/mesh_settings.hpp"

#include <algorithm>

#include "tunica/case/descriptions.hpp"
#include "tunica/geometry/parametric_dissection.hpp"
#include "tunica/meshing/geometry.hpp"

namespace tunica::case_file {

using geometry::mm;

namespace {

using config::Schema;

Schema<case_file::Size> size_schema() {
  return Schema<case_file::Size>("size",
                                 "How fine the mesh is; numbers of tetrahedra are those of the usual dissection.")
      .one_of()
      .alternative(Schema<case_file::Coarse>("coarse", "About 70 000 tetrahedra."))
      .alternative(Schema<case_file::Medium>("medium", "About 300 000."))
      .alternative(Schema<case_file::Full>("full", "About 1.3 million."))
      .quantity("edge", config::emplace<double>, config::dimension::length, config::range(0.2 * mm, 10 * mm),
                "Edge length on the surfaces of lumen and wall");
}

}  // namespace

double edge_length(const case_file::Size& size) {
  if (std::holds_alternative<case_file::Coarse>(size)) return 7 * mm;
  if (std::holds_alternative<case_file::Medium>(size)) return 3.2 * mm;
  if (std::holds_alternative<case_file::Full>(size)) return 2.0 * mm;
  return std::get<double>(size);
}

geometry::SizeSettings size_settings(double edge) {
  geometry::SizeSettings settings;
  settings.largest = edge;
  settings.per_radius = std::min(0.8, 0.17 * edge / mm);
  settings.per_thickness = std::min(2.0, 0.35 * edge / mm);
  settings.smallest = std::min(0.6 * mm, 0.2 * edge);
  return settings;
}

Schema<case_file::MeshCase> case_file::MeshCase::schema() {
  return Schema<case_file::MeshCase>("tunica mesh", "File of `tunica mesh`, in YAML like a case file.")
      .text("title", &case_file::MeshCase::title, "Free text for logs and reports")
      .by_default()
      .section("geometry", &case_file::MeshCase::geometry, meshing::geometry_schema(), "What is meshed")
      .required()
      .section("size", &case_file::MeshCase::size, size_schema(), "How fine")
      .by_default("medium")
      .integer("elements_through_wall", &case_file::MeshCase::elements_through_wall, config::range(1, 2),
               "Elements that wall and flap are thick, at least")
      .by_default()
      .section("boundary_layers", &case_file::MeshCase::boundary_layers, meshing::BoundaryLayers::schema(),
               "Thin layers at the wall of the lumen; `{}` for three, none when left out")
      .optional()
      .path("output", &case_file::MeshCase::output, "Folder of the mesh, relative to that of this file")
      .by_default("mesh");
}

config::Parsed<case_file::MeshCase> read_mesh_case(const std::filesystem::path& file) {
  return config::parse_file(case_file::MeshCase::schema(), file);
}

std::shared_ptr<const config::Description> mesh_description() { return MeshCase::schema().description(); }

}  // namespace tunica::case_file
