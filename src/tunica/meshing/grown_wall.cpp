#include "tunica/meshing/grown_wall.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tunica/meshing/tetrahedralise.hpp"

namespace tunica::meshing {

namespace {

bool by_region(const GrowthSettings& growth) {
  return growth.true_lumen_wall || growth.false_lumen_wall || growth.branches;
}

/// The region of the wall at each point, from a coarse mesh.
std::vector<WallRegion> regions_at(const std::vector<geometry::Point>& places, const PatientSurfaces& surfaces,
                                   const VesselRoles& roles, const ComplexOptions& options) {
  auto coarse = options;
  coarse.sizes.largest = 5e-3;
  coarse.sizes.per_radius = 0.6;
  coarse.sizes.per_thickness = 1.5;
  coarse.sizes.across.reset();
  coarse.log = [](const std::string&) {};
  const auto prepared = patient_complex(surfaces, coarse);
  const auto openings = with_inlet_first(prepared.openings, roles);
  const auto mesh = tetrahedralise(prepared.complex, prepared.sizes, {.in_lumen = 2, .in_wall = 2});
  const auto faces = sort_surface(mesh, openings);
  const auto regions = wall_regions(mesh, faces, openings, roles);
  std::vector<WallRegion> of_triangle;
  geometry::TriangleSurface interface {
    mesh.points, {}
  };
  for (const auto& t : geometry::surface_triangles(mesh))
    if (t.neighbour_label == geometry::wall_label) {
      interface.triangles.push_back(t.nodes);
      of_triangle.push_back(regions.of_element[t.neighbour]);
    }
  const geometry::TriangleTree tree(std::move(interface));
  std::vector<WallRegion> result;
  for (const auto& p : places) result.push_back(of_triangle[tree.nearest(p).triangle]);
  return result;
}

/// How often values have to be averaged over neighbours to spread over a length [m]: the spread of a random walk grows
/// with the square root of its steps.
int sweeps_over(const geometry::TriangleSurface& surface, double length) {
  const auto all = geometry::edges(surface);
  double mean = 0;
  for (const auto& e : all) mean += norm(surface.points[e.a] - surface.points[e.b]) / static_cast<double>(all.size());
  return std::clamp(static_cast<int>(length * length / (mean * mean)), 2, 60);
}

void log_thickness(const std::vector<double>& thickness, const Log& log) {
  const auto [least, most] = std::minmax_element(thickness.begin(), thickness.end());
  log(fmt::format("wall to be grown: {:.2f} to {:.2f} mm thick", 1e3 * *least, 1e3 * *most));
}

}  // namespace

PatientSurfaces with_grown_wall(const geometry::TriangleSurface& lumen, const std::vector<geometry::NamedPlace>& names,
                                const GrowthSettings& growth, const VesselRoles& roles, const ComplexOptions& options,
                                const geometry::TriangleSurface* body) {
  if (growth.thickness) check_thickness(*growth.thickness);
  PatientSurfaces surfaces{mended(lumen, "lumen surface", options.lumen_parts, options), {}, names};
  auto inner = body ? mended(*body, "surface of lumen and thrombus", 1, options) : surfaces.lumen;
  const auto openings = geometry::find_openings(inner, nullptr, names);
  geometry::flatten_rims(inner, openings, &geometry::Opening::lumen);
  if (!body) surfaces.lumen = inner;
  auto thickness = thickness_by_radius(inner, openings, growth);
  log_thickness(thickness, options.log);
  if (by_region(growth)) {
    surfaces.outer = grow_wall(inner, thickness, openings, growth);
    const auto region = regions_at(inner.points, surfaces, roles, options);
    for (std::size_t p = 0; p < thickness.size(); ++p) {
      const auto& given = region[p] == WallRegion::true_lumen_wall    ? growth.true_lumen_wall
                          : region[p] == WallRegion::false_lumen_wall ? growth.false_lumen_wall
                          : region[p] == WallRegion::branches         ? growth.branches
                                                                      : std::optional<double>();
      if (given) thickness[p] = *given;
    }
    constexpr double transition = 3e-3;  // m
    geometry::average_over_neighbours(inner, sweeps_over(inner, transition), thickness);
    log_thickness(thickness, options.log);
  }
  if (growth.thickness) {
    const auto taken = take_thickness(*growth.thickness, inner.points, thickness);
    options.log(fmt::format("thickness as given at {} of {} points of the lumen", taken, thickness.size()));
    geometry::average_over_neighbours(inner, 2, thickness);  // the thickness of a wall has no steps
    log_thickness(thickness, options.log);
  }
  surfaces.outer = grow_wall(inner, thickness, openings, growth);
  return surfaces;
}

}  // namespace tunica::meshing
