#include "tunica/meshing/geometry.hpp"

#include <algorithm>
#include <memory>

#include "tunica/geometry/surface_file.hpp"
#include "tunica/meshing/dissection_surfaces.hpp"

namespace tunica::meshing {

namespace {

using config::Schema;
namespace dimension = config::dimension;

Schema<geometry::Point> place_schema() {
  return Schema<geometry::Point>("place", "A place in a lumen.")
      .quantities(
          "at", [](geometry::Point& p) -> geometry::Point& { return p; }, dimension::length, config::anything(),
          "x, y, z")
      .shorthand("at");
}

Schema<VesselRoles> roles_schema() {
  using R = VesselRoles;
  return Schema<R>("roles", "What the openings and lumens are.")
      .text("inlet", &R::inlet, "Name of the inlet; when left out, the first one of the table")
      .optional()
      .texts("aorta_ends", &R::aorta_ends,
             "Openings besides the inlet where the aorta itself is cut; all others end branches")
      .by_default("[]")
      .list("true_lumen_at", &R::true_lumen, place_schema(),
            "Places known to lie in the true lumen, as `[\"[10, -20, 5] mm\"]`; when neither these nor those of the "
            "false lumen are given, the lumen at the inlet is the true one")
      .by_default()
      .list("false_lumen_at", &R::false_lumen, place_schema(), "The same for the false lumen")
      .by_default();
}

GeometrySurfaces from(const geometry::ParametricDissection& shape, const ComplexOptions& options, bool) {
  options.log("surfaces of the idealised dissection");
  // The surfaces need to be finer than the mesh, but not much; the thinnest sheets and roundest rims have to be seen.
  const double thinnest = std::min(shape.flap.thickness, shape.flap.false_lumen_wall_thickness);
  const double spacing =
      std::clamp(std::min({0.35 * options.sizes.largest, 0.55 * thinnest, 1.1 * shape.flap.rim_fillet}),
                 0.45 * geometry::mm, 0.9 * geometry::mm);
  VesselRoles roles;
  roles.inlet = "inlet";
  if (!shape.iliacs) roles.aorta_ends = {"abdominal_aorta"};
  const auto model = std::make_shared<const geometry::DissectionModel>(shape);
  GeometrySurfaces result{dissection_surfaces(*model, spacing), 1, roles};
  if (shape.thrombus)
    result.thrombus = {.depth = [model](const geometry::Point& place) { return -model->at(place).vessel; },
                       .tolerance = 0.35 * geometry::mm,
                       .smallest = 5e-9};
  return result;
}

GeometrySurfaces from(const SurfaceFiles& files, const ComplexOptions& options, bool grow) {
  const double unit = files.metres_per_unit;
  GeometrySurfaces result{{{}, {}, {}}, 1, files.roles, files.genus};
  if (!files.openings.empty()) {
    result.surfaces.names = geometry::read_opening_names(files.openings, unit);
    check_names(files.roles, result.surfaces.names);
  }
  result.surfaces.lumen = geometry::read_surface(files.lumen, unit);
  if (!files.false_lumen.empty()) {
    geometry::append(result.surfaces.lumen, geometry::read_surface(files.false_lumen, unit));
    result.lumen_parts = 2;
  }
  if (!files.outer_wall.empty()) {
    result.surfaces.outer = geometry::read_surface(files.outer_wall, unit);
    return result;
  }
  if (!grow) return result;
  auto growing = options;
  growing.lumen_parts = result.lumen_parts;
  result.surfaces = with_grown_wall(result.surfaces.lumen, result.surfaces.names, files.wall.value_or(GrowthSettings{}),
                                    files.roles, growing);
  return result;
}

GeometrySurfaces from(const ImageGeometry& image, const ComplexOptions& options, bool grow) {
  auto made = surfaces_from_image(image, options, grow);
  GeometrySurfaces result{std::move(made.surfaces), made.lumen_parts, roles_of(image), {}, std::move(made.labelled)};
  if (const auto& labelled = result.labelled; labelled.with_thrombus)
    result.thrombus = thrombus_within(*labelled.with_thrombus, labelled.voxel);
  return result;
}

}  // namespace

Schema<SurfaceFiles> SurfaceFiles::schema() {
  using F = SurfaceFiles;
  return Schema<F>("surfaces", "Surfaces of a patient, open at the vessel ends: .vtp, .stl, .ply or .obj files.")
      .file("lumen", &F::lumen, "Surface of the lumen: true and false lumen with the tears between them")
      .file("false_lumen", &F::false_lumen,
            "Surface of a false lumen that is not connected with the lumen; none when left out")
      .optional()
      .file("outer_wall", &F::outer_wall, "Outside of the wall; when left out, the wall is grown around the lumen")
      .optional()
      .unit("length_unit", &F::metres_per_unit, dimension::length, "Unit of the coordinates in all these files")
      .file("openings", &F::openings,
            "Table (.csv) with the columns name, centre_x, centre_y, centre_z; when left out, the largest opening is "
            "the inlet, and the others are called outlet_1, outlet_2, ... by falling area")
      .optional()
      .include(&F::roles, roles_schema())
      .section("wall", &F::wall, GrowthSettings::schema(),
               "How the wall is grown around the lumen; by the defaults when neither this nor `outer_wall` is given")
      .optional()
      .check([](const F& files, config::Problems& problems) {
        if (files.wall && !files.outer_wall.empty())
          problems.add("wall", "says how a wall is grown, but `outer_wall` gives it", "leave one of them out");
      });
}

Schema<Geometry> geometry_schema() {
  return Schema<Geometry>("geometry", "What is meshed.")
      .one_of()
      .alternative(geometry::ParametricDissection::schema())
      .alternative(SurfaceFiles::schema())
      .alternative(ImageGeometry::schema());
}

GeometrySurfaces surfaces_of(const Geometry& geometry, const ComplexOptions& options, bool grow) {
  return std::visit([&](const auto& g) { return from(g, options, grow); }, geometry);
}

}  // namespace tunica::meshing
