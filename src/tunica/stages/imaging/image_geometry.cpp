#include "tunica/stages/imaging/image_geometry.hpp"

namespace tunica::stages::imaging {

namespace {

config::Schema<meshing::GrowthSettings> growth_schema() {
  using G = meshing::GrowthSettings;
  using namespace config;
  return Schema<G>("wall", "The wall that is grown outward from the lumen.")
      .number("per_radius", &G::per_radius, range(0.02, 0.5), "Thickness over the radius of the vessel")
      .by_default()
      .quantity("thinnest", &G::thinnest, dimension::length, range(0.3e-3, 6e-3), "Thickness of narrow vessels")
      .by_default("1.2 mm")
      .quantity("thickest", &G::thickest, dimension::length, range(0.3e-3, 6e-3), "Thickness of wide vessels")
      .by_default("2 mm")
      .check([](const G& g, Problems& problems) {
        if (g.thinnest > g.thickest)
          problems.add("thinnest", "is above `thickest`", "exchange them, or give equal ones for a uniform wall");
      });
}

}  // namespace

config::Schema<ImageGeometry> ImageGeometry::schema() {
  config::Schema<ImageGeometry> schema("image", "A segmented image: a label for each voxel of true and false lumen.");
  schema.file("file", &ImageGeometry::file, "NRRD (.nrrd, .nhdr), MetaImage (.mha, .mhd) or NIfTI (.nii, .nii.gz)");
  config::Schema<SurfaceSettings> surface("surface", "Labels and vessel ends.");
  SurfaceSettings::add_to(surface);
  schema.include(&ImageGeometry::surface, surface);
  schema.section("wall", &ImageGeometry::wall, growth_schema(), "The wall around the lumen").by_default();
  return schema;
}

meshing::PatientSurfaces surfaces_from_image(const ImageGeometry& geometry, const meshing::ComplexOptions& options) {
  const auto made = surface_of(read_label_image(geometry.file), geometry.surface, options.log);
  std::vector<meshing::NamedPlace> names;
  for (const auto& [name, opening] : geometry.surface.openings) names.push_back({name, made.ends[names.size()].centre});
  return meshing::with_grown_wall(made.lumen, names, geometry.wall, options);
}

}  // namespace tunica::stages::imaging
