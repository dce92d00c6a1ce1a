// What can be meshed, and the surfaces that each kind of geometry gives.
#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "tunica/geometry/parametric_dissection.hpp"
#include "tunica/meshing/grown_wall.hpp"
#include "tunica/meshing/image_geometry.hpp"
#include "tunica/meshing/wall_regions.hpp"

namespace tunica::meshing {

/// Surfaces of a patient in files, open at the vessel ends.
struct SurfaceFiles {
  std::filesystem::path lumen, false_lumen, outer_wall, openings;  ///< all but the first may be empty
  double metres_per_unit = 0;
  VesselRoles roles;
  std::optional<GrowthSettings> wall;  ///< for the wall that is grown when there is no outer one
  std::optional<int> genus{};          ///< of the lumen, where it is known

  static config::Schema<SurfaceFiles> schema();
};

/// One of them. A type of its own, so that the case file can hold one without knowing them.
struct Geometry : std::variant<geometry::ParametricDissection, SurfaceFiles, ImageGeometry> {
  using variant::variant;
};
config::Schema<Geometry> geometry_schema();

/// Surfaces of lumen and wall, and what their openings are.
struct GeometrySurfaces {
  PatientSurfaces surfaces;
  int lumen_parts = 1;
  VesselRoles roles;
  std::optional<int> genus{};  ///< that the lumen must have
  LabelledLumen labelled{};    ///< of an image: what its labels say
  std::optional<Thrombus> thrombus{};
};

/// Reads or makes the surfaces; grows the wall where none is given, unless `grow` is false. Errors as of the functions
/// that it calls.
GeometrySurfaces surfaces_of(const Geometry& geometry, const ComplexOptions& options, bool grow = true);

}  // namespace tunica::meshing
