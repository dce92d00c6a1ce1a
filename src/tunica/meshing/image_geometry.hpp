// A patient's segmentation as the geometry of a mesh: the lumen from the labels, the wall grown around it.
#pragma once

#include <filesystem>
#include <optional>
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

/// What the labels say of a lumen before there is a mesh.
struct LabelledLumen {
  geometry::TriangleSurface lumen{};           ///< as the labels give it
  std::vector<std::uint8_t> of_false_lumen{};  ///< is each point of it at the false lumen?
  std::vector<imaging::Contact> tears{};
  std::optional<geometry::TriangleSurface> with_thrombus{};  ///< around lumen and thrombus, where there is some
  double voxel = 0;                                          ///< longest side of one [m]
};

struct ImageSurfaces {
  PatientSurfaces surfaces;
  int lumen_parts = 1;  ///< 2: true and false lumen are apart
  LabelledLumen labelled;
};

/// Reads the image and makes lumen and outer surface of it. Errors as of `read_label_image`, `surface_of` and
/// `meshing::with_grown_wall`; InputError for an opening nearly as wide as the inlet that is no end of the aorta.
/// `grow`: without it the lumen has no wall around it.
ImageSurfaces surfaces_from_image(const ImageGeometry& geometry, const ComplexOptions& options, bool grow = true);

}  // namespace tunica::meshing
