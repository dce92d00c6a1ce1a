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
struct Fine {};
struct Full {};
/// Edges by the local diameter of the lumen.
struct Across {
  double count = 4;                  ///< elements across
  double longest = 10e-3;            ///< edge [m]
  std::optional<double> shortest{};  ///< edge [m]; none: 2 mm / count
};
using Size = std::variant<Coarse, Medium, Fine, Full, double, Across>;  ///< a number: largest edge length [m]
/// How many elements a size puts across the lumen; none where it is an edge length.
std::optional<Across> across(const Size& size);
double edge_length(const Size& size);  ///< the largest one [m]
/// What follows from the size: a coarse mesh is also coarser than the wall is thick.
geometry::SizeSettings size_settings(const Size& size);
/// The size in words, for reports.
std::string describe(const Size& size);

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
