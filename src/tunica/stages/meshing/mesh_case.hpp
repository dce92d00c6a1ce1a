// The file of `tunica mesh`: what is meshed, how finely, and where the result goes.
#pragma once

#include <filesystem>
#include <string>
#include <variant>

#include "tunica/config/schema.hpp"
#include "tunica/mesh/mesh_data.hpp"
#include "tunica/stages/meshing/boundary_layers.hpp"
#include "tunica/stages/meshing/geometry.hpp"
#include "tunica/stages/phases.hpp"

namespace tunica::stages::meshing {

struct Coarse {};
struct Medium {};
struct Full {};
using Size = std::variant<Coarse, Medium, Full, double>;  ///< a number: largest edge length [m]
double edge_length(const Size& size);                     ///< m
/// What follows from the largest edge: a coarse mesh is also coarser than the wall is thick.
SizeSettings size_settings(double edge);

struct MeshCase {
  std::string title;
  Geometry geometry;
  Size size = Medium{};
  int elements_through_wall = 1;
  std::optional<BoundaryLayers> boundary_layers;
  std::filesystem::path output;

  static config::Schema<MeshCase> schema();
};

/// Throws InputError with all problems.
config::Parsed<MeshCase> read_mesh_case(const std::filesystem::path& file);

struct MadeMesh {
  mesh::MeshData data;
  std::string report_json, report_text;  ///< see mesh_report.hpp
  std::string report_page;               ///< see mesh_page.hpp
};

/// Throws SolverError when the mesh does not become what it has to be.
MadeMesh make_mesh(const MeshCase& mesh_case, const Say& say);

/// Makes the mesh and writes lumen/ and wall/ (SimVascular's layout, mm), report.json, report.html and meshes.yaml, the
/// section for a case file. Returns the report as text. Throws InputError when there is a mesh already and `overwrite`
/// is false.
std::string mesh_to_files(const MeshCase& mesh_case, bool overwrite, const Say& say);

}  // namespace tunica::stages::meshing
