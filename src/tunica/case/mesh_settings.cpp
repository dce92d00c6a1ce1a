#include "tunica/case/mesh_settings.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tunica/case/descriptions.hpp"
#include "tunica/geometry/parametric_dissection.hpp"
#include "tunica/meshing/geometry.hpp"

namespace tunica::case_file {

using geometry::mm;

namespace {

using config::Schema;

constexpr double coarse_across = 2.5, medium_across = 4, fine_across = 6, full_edge = 2 * mm;

Schema<Across> across_schema() {
  return Schema<Across>("elements_across",
                        "Edges by the local diameter: so many elements across every vessel, opening and tear. Flow "
                        "needs 4 quadratic ones, or 10 linear ones and boundary layers.")
      .number("count", &Across::count, config::range(1, 40), "Elements across")
      .quantity("longest_edge", &Across::longest, config::dimension::length, config::range(0.2 * mm, 50 * mm),
                "In wide vessels")
      .by_default()
      .quantity("shortest_edge", &Across::shortest, config::dimension::length, config::range(0.05 * mm, 10 * mm),
                "In narrow places; when left out, 2 mm / `count`")
      .optional()
      .shorthand("count")
      .check([](const Across& a, config::Problems& problems) {
        if (a.shortest && *a.shortest > a.longest)
          problems.add("shortest_edge", "is longer than `longest_edge`", "exchange them");
      });
}

Schema<case_file::Size> size_schema() {
  return Schema<case_file::Size>("size", "How fine the mesh is.")
      .one_of()
      .alternative(Schema<case_file::Coarse>("coarse", "2.5 elements across: for trying things, not for results."))
      .alternative(Schema<case_file::Medium>("medium", "4 elements across, what quadratic elements need."))
      .alternative(Schema<case_file::Fine>("fine", "6 elements across."))
      .alternative(Schema<case_file::Full>("full", "Edges of 2 mm everywhere."))
      .quantity("edge", config::emplace<double>, config::dimension::length, config::range(0.2 * mm, 10 * mm),
                "The same edge length on all surfaces of lumen and wall, however narrow the lumen is")
      .alternative(across_schema());
}

/// A coarse mesh is also coarser than the wall is thick.
geometry::SizeSettings settings_by_edge(double edge) {
  geometry::SizeSettings settings;
  settings.largest = edge;
  settings.per_radius = std::min(0.8, 0.17 * edge / mm);
  settings.per_thickness = std::min(2.0, 0.35 * edge / mm);
  settings.smallest = std::min(0.6 * mm, 0.2 * edge);
  return settings;
}

geometry::SizeSettings settings_by_diameter(const Across& a) {
  geometry::SizeSettings settings;
  settings.across = a.count;
  settings.largest = a.longest;
  // Around a tube as across it; elements of wall and flap are at most twice as long as thick.
  settings.per_radius = std::min(0.8, 2 / a.count);
  settings.per_thickness = std::min(2.0, 8 / a.count);
  settings.smallest_across = std::min(a.longest, a.shortest.value_or(2 * mm / a.count));
  settings.smallest = std::min(a.longest, a.shortest.value_or(std::min(0.6 * mm, 2.4 * mm / a.count)));
  return settings;
}

}  // namespace

std::optional<Across> across(const Size& size) {
  if (std::holds_alternative<Coarse>(size)) return Across{.count = coarse_across};
  if (std::holds_alternative<Medium>(size)) return Across{.count = medium_across};
  if (std::holds_alternative<Fine>(size)) return Across{.count = fine_across};
  if (const auto* given = std::get_if<Across>(&size)) return *given;
  return std::nullopt;
}

double edge_length(const Size& size) {
  if (const auto given = across(size)) return given->longest;
  return std::holds_alternative<Full>(size) ? full_edge : std::get<double>(size);
}

geometry::SizeSettings size_settings(const Size& size) {
  if (const auto given = across(size)) return settings_by_diameter(*given);
  return settings_by_edge(edge_length(size));
}

std::string describe(const Size& size) {
  const auto given = across(size);
  if (!given) return fmt::format("edges of up to {:g} mm, however narrow the lumen is", edge_length(size) / mm);
  return fmt::format("{:g} elements across the lumen{}", given->count,
                     std::holds_alternative<Coarse>(size) ? ": `coarse` is for trying things, not for results" : "");
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
