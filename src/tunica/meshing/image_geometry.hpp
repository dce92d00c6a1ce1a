// A patient's segmentation as the geometry of a mesh: the lumen from the labels, the wall grown around it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tunica/config/schema.hpp"
#include "tunica/imaging/label_surface.hpp"
#include "tunica/meshing/grown_wall.hpp"

namespace tunica::meshing {

struct ImageGeometry {
  std::filesystem::path file;
  imaging::SurfaceSettings surface;
  std::vector<std::string> aorta_ends;  ///< openings besides the inlet where the aorta itself is cut
  GrowthSettings wall;

  static config::Schema<ImageGeometry> schema();
};

/// What its openings are.
VesselRoles roles_of(const ImageGeometry& geometry);

struct ImageSurfaces {
  PatientSurfaces surfaces;
  int lumen_parts = 1;  ///< 2: true and false lumen are apart
};

/// Reads the image and makes lumen and outer surface of it. Errors as of `read_label_image`, `surface_of` and
/// `meshing::with_grown_wall`; InputError for an opening nearly as wide as the inlet that is no end of the aorta.
ImageSurfaces surfaces_from_image(const ImageGeometry& geometry, const ComplexOptions& options);

}  // namespace tunica::meshing
