// The file of `tunica mesh`: what is meshed, how finely, and where the result goes.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>

#include "tunica/base/boxed.hpp"
#include "tunica/config/schema.hpp"
#include "tunica/geometry/size_field.hpp"
#include "tunica/meshing/boundary_layers.hpp"

namespace tunica::meshing {
struct Geometry;  // meshing/geometry.hpp
}

namespace tunica::case_file {

struct Coarse {};
struct Medium {};
struct Full {};
using Size = std::variant<Coarse, Medium, Full, double>;  ///< a number: largest edge length [m]
double edge_length(const Size& size);                     ///< m
/// What follows from the largest edge: a coarse mesh is also coarser than the wall is thick.
geometry::SizeSettings size_settings(double edge);

struct MeshCase {
  std::string title;
  Boxed<meshing::Geometry> geometry;
  Size size = Medium{};
  int elements_through_wall = 1;
  std::optional<meshing::BoundaryLayers> boundary_layers;
  std::filesystem::path output;

  static config::Schema<MeshCase> schema();
};

/// Throws InputError with all problems.
config::Parsed<MeshCase> read_mesh_case(const std::filesystem::path& file);

}  // namespace tunica::case_file
