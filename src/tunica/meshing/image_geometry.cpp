#include "tunica/meshing/image_geometry.hpp"

namespace tunica::meshing {

config::Schema<ImageGeometry> ImageGeometry::schema() {
  config::Schema<ImageGeometry> schema("image", "A segmented image: a label for each voxel of true and false lumen.");
  schema.file("file", &ImageGeometry::file, "NRRD (.nrrd, .nhdr), MetaImage (.mha, .mhd) or NIfTI (.nii, .nii.gz)");
  config::Schema<imaging::SurfaceSettings> surface("surface", "Labels and vessel ends.");
  imaging::SurfaceSettings::add_to(surface);
  schema.include(&ImageGeometry::surface, surface);
  schema
      .texts("aorta_ends", &ImageGeometry::aorta_ends,
             "Openings besides the inlet where the aorta itself is cut; all others end branches")
      .by_default("[]");
  schema.section("wall", &ImageGeometry::wall, GrowthSettings::schema(), "How the wall is grown").by_default();
  return schema;
}

VesselRoles roles_of(const ImageGeometry& geometry) { return {geometry.surface.inlet, geometry.aorta_ends, {}, {}}; }

PatientSurfaces surfaces_from_image(const ImageGeometry& geometry, const ComplexOptions& options) {
  const auto made = imaging::surface_of(imaging::read_label_image(geometry.file), geometry.surface, options.log);
  std::vector<geometry::NamedPlace> names;
  for (const auto& [name, opening] : geometry.surface.openings) names.push_back({name, made.ends[names.size()].centre});
  return with_grown_wall(made.lumen, names, geometry.wall, roles_of(geometry), options);
}

}  // namespace tunica::meshing
