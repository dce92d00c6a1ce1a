// A patient's segmentation as the geometry of a mesh: the lumen from the labels, the wall grown around it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tunica/config/schema.hpp"
#include "tunica/stages/imaging/label_surface.hpp"
#include "tunica/stages/meshing/grown_wall.hpp"

namespace tunica::stages::imaging {

struct ImageGeometry {
  std::filesystem::path file;
  SurfaceSettings surface;
  std::vector<std::string> aorta_ends;  ///< openings besides the inlet where the aorta itself is cut
  meshing::GrowthSettings wall;

  static config::Schema<ImageGeometry> schema();
};

/// What its openings are.
meshing::VesselRoles roles_of(const ImageGeometry& geometry);

/// Reads the image and makes lumen and outer surface of it. Errors as of `read_label_image`, `surface_of` and
/// `meshing::with_grown_wall`.
meshing::PatientSurfaces surfaces_from_image(const ImageGeometry& geometry, const meshing::ComplexOptions& options);

}  // namespace tunica::stages::imaging
