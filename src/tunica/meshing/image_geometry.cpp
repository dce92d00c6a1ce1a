#include "tunica/meshing/image_geometry.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tunica/base/error.hpp"
#include "tunica/imaging/chosen_ends.hpp"

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

namespace {

constexpr double as_wide_as_the_aorta = 0.75;  // of the inlet's radius

/// Ends that nothing names are called inlet, outlet_1, ... by falling area.
void check_unnamed_aorta_ends(const ImageGeometry& geometry, const imaging::LabelSurface& made) {
  const double inlet = imaging::inlet_of(made.ends, geometry.surface).radius;
  const auto wide = std::count_if(made.ends.begin(), made.ends.end(),
                                  [&](const auto& end) { return end.radius > as_wide_as_the_aorta * inlet; }) -
                    1;
  if (wide > std::ssize(geometry.aorta_ends))
    throw InputError("aorta_ends",
                     fmt::format("{} openings are about as wide as the inlet, {} are said to be ends of the aorta",
                                 wide, geometry.aorta_ends.size()),
                     "give `aorta_ends: [outlet_1]`, or name the `openings`");
}

/// The aorta taken for a branch would lose its regions of the wall without a word.
void check_aorta_ends(const ImageGeometry& geometry, const imaging::LabelSurface& made) {
  const auto& openings = geometry.surface.openings;
  if (openings.empty()) return check_unnamed_aorta_ends(geometry, made);
  const auto* inlet = &imaging::inlet_of(made.ends, geometry.surface);
  std::vector<Problem> problems;
  for (std::size_t i = 0; i < openings.size(); ++i) {
    const auto& ends = geometry.aorta_ends;
    const auto& name = openings[i].first;
    if (&made.ends[i] == inlet || std::find(ends.begin(), ends.end(), name) != ends.end()) continue;
    if (made.ends[i].radius > as_wide_as_the_aorta * inlet->radius)
      problems.push_back(
          {"aorta_ends",
           fmt::format("the opening {}, of radius {:.1f} mm, is about as wide as the inlet, of {:.1f} mm, "
                       "and counts as the end of a branch",
                       name, 1e3 * made.ends[i].radius, 1e3 * inlet->radius),
           fmt::format("give `aorta_ends: [{}]`", name)});
  }
  if (!problems.empty()) throw InputError(std::move(problems));
}

}  // namespace

VesselRoles roles_of(const ImageGeometry& geometry) { return {geometry.surface.inlet, geometry.aorta_ends, {}, {}}; }

ImageSurfaces surfaces_from_image(const ImageGeometry& geometry, const ComplexOptions& options, bool grow) {
  const auto image = imaging::read_label_image(geometry.file);
  const auto made = imaging::surface_of(image, geometry.surface, options.log);
  check_aorta_ends(geometry, made);
  std::vector<geometry::NamedPlace> names;
  for (const auto& [name, opening] : geometry.surface.openings) names.push_back({name, made.ends[names.size()].centre});
  auto growing = options;
  growing.lumen_parts = made.parts;
  LabelledLumen labelled{made.lumen, made.of_false_lumen, made.tears, made.with_thrombus,
                         image.frame.largest_spacing()};
  if (!grow) return {{made.lumen, {}, names}, made.parts, std::move(labelled)};
  const auto* body = made.with_thrombus ? &*made.with_thrombus : nullptr;
  auto surfaces = with_grown_wall(made.lumen, names, geometry.wall, roles_of(geometry), growing, body);
  return {std::move(surfaces), made.parts, std::move(labelled)};
}

}  // namespace tunica::meshing
