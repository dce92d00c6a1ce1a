#include "tunica/meshing/patient_complex.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tunica/base/error.hpp"
#include "tunica/geometry/caps.hpp"
#include "tunica/geometry/surface_mending.hpp"

namespace tunica::meshing {

namespace {

/// Rims of a remeshed surface in the order of the openings, as positions in its points.
std::vector<geometry::Loop> rims_of(const geometry::TriangleSurface& surface,
                                    const std::vector<geometry::Opening>& openings) {
  std::vector<geometry::Loop> rims(openings.size());
  for (auto& loop : geometry::boundary_loops(surface)) {
    geometry::Point centre{{0, 0, 0}};
    for (const auto p : loop) centre = centre + (1.0 / static_cast<double>(loop.size())) * surface.points[p];
    const auto nearest =
        std::min_element(openings.begin(), openings.end(), [&](const geometry::Opening& a, const geometry::Opening& b) {
          return norm(a.centre - centre) < norm(b.centre - centre);
        });
    rims[nearest - openings.begin()] = std::move(loop);
  }
  return rims;
}

class Assembly {
 public:
  void add(const geometry::TriangleSurface& surface, const std::vector<std::int64_t>& number, const Patch& patch) {
    for (auto t : surface.triangles) {
      for (auto& corner : t) corner = number[corner];
      complex.triangles.push_back(t);
      complex.patch_of.push_back(static_cast<std::int32_t>(complex.patches.size()));
    }
    complex.patches.push_back(patch);
  }
  std::int64_t add_point(const geometry::Point& p) {
    complex.points.push_back(p);
    return std::ssize(complex.points) - 1;
  }
  void add_surface(const geometry::TriangleSurface& surface, const Patch& patch) {
    std::vector<std::int64_t> number;
    for (const auto& p : surface.points) number.push_back(add_point(p));
    add(surface, number, patch);
  }
  /// A plane piece between chains of points that are there already.
  void add_cap(const geometry::Loop& outer, const geometry::Loop& inner, const Vec3<double>& normal,
               const Patch& patch) {
    const auto places = [&](const geometry::Loop& loop) {
      std::vector<geometry::Point> result;
      for (const auto p : loop) result.push_back(complex.points[p]);
      return result;
    };
    const auto cap = geometry::plane_cap(places(outer), places(inner), normal);
    std::vector<std::int64_t> number = outer;
    number.insert(number.end(), inner.begin(), inner.end());
    while (number.size() < cap.points.size()) number.push_back(add_point(cap.points[number.size()]));
    add(cap, number, patch);
  }
  SurfaceComplex complex;
};

geometry::Loop shifted(geometry::Loop loop, std::int64_t by) {
  for (auto& p : loop) p += by;
  return loop;
}

void log_complex(const SurfaceComplex& complex, const Log& log) {
  double angle = M_PI;
  const geometry::TriangleSurface all{complex.points, complex.triangles};
  for (const auto& t : all.triangles) angle = std::min(angle, geometry::smallest_angle(all, t));
  log(fmt::format("complex: {} triangles, smallest angle {:.1f} degrees, lumen {:.2f} ml, wall {:.2f} ml",
                  all.triangles.size(), angle * 180 / M_PI, 1e6 * volume(complex, Label::lumen),
                  1e6 * volume(complex, Label::wall)));
}

/// A wrong unit is found out here: meshing metres as millimetres would fill the memory first.
void check_scale(const std::vector<geometry::Opening>& openings) {
  double area = 0;
  for (const auto& o : openings) area = std::max(area, o.area);
  constexpr double smallest = 1e-3, largest = 100e-3;  // m
  const double radius = std::sqrt(area / M_PI);
  if (radius < smallest || radius > largest)
    throw InputError("lumen surface",
                     fmt::format("its largest opening has a radius of {:.3g} mm; expected are {:g} to {:g} mm",
                                 1e3 * radius, 1e3 * smallest, 1e3 * largest),
                     "check `length_unit`");
}

/// Before anything that takes time: another genus means a hole in the flap, or vessels that touch.
void check_genus(const geometry::TriangleSurface& lumen, const ComplexOptions& options) {
  if (!options.genus) return;
  const auto genus = geometry::genus(lumen, std::ssize(geometry::boundary_loops(lumen)), options.lumen_parts);
  if (genus != *options.genus)
    throw InputError(
        "lumen surface",
        fmt::format("has genus {}, asked for is {}: every tear beyond the first makes one", genus, *options.genus),
        "look for holes in the flap, closed tears and vessels that touch, or correct `genus`");
}

/// No sheet is coarser than the other one allows at a distance.
void agree_on_sizes(std::vector<Sheet>& sheets, const geometry::SizeSettings& settings) {
  if (sheets.size() < 2) return;
  for (const auto& [from, to] : {std::pair{0, 1}, std::pair{1, 0}}) {
    const geometry::SizeField field(sheets[from].original.tree.surface(), sheets[from].original.sizes,
                                    settings.gradation, settings.largest);
    const auto& points = sheets[to].original.tree.surface().points;
    for (std::size_t p = 0; p < points.size(); ++p)
      sheets[to].original.sizes[p] = std::min(sheets[to].original.sizes[p], field(points[p]));
    geometry::limit_gradation(sheets[to].original.tree.surface(), settings.gradation, sheets[to].original.sizes);
  }
}

/// Edge length from both surfaces at once.
geometry::SizeField size_field(const std::vector<Sheet>& sheets, const geometry::SizeSettings& settings) {
  geometry::TriangleSurface all;
  std::vector<double> sizes;
  for (const auto& sheet : sheets) {
    geometry::append(all, sheet.original.tree.surface());
    sizes.insert(sizes.end(), sheet.original.sizes.begin(), sheet.original.sizes.end());
  }
  return {std::move(all), std::move(sizes), settings.gradation, settings.largest};
}

}  // namespace

geometry::TriangleSurface mended(const geometry::TriangleSurface& surface, const std::string& name, int parts,
                                 const ComplexOptions& options) {
  geometry::MendOptions mend;
  mend.name = name;
  mend.parts = parts;
  mend.spots = options.spots;
  auto result = geometry::mend_surface(surface, mend);
  for (const auto& line : result.report) options.log(name + ": " + line);
  return std::move(result.surface);
}

SurfaceComplex close_at_openings(const geometry::TriangleSurface& lumen, const geometry::TriangleSurface* outer,
                                 const std::vector<geometry::Opening>& openings) {
  const auto behind = outer ? Label::wall : Label::outside;
  Assembly assembly;
  assembly.add_surface(lumen, {"interface", PatchKind::interface, Label::lumen, behind});
  if (outer) assembly.add_surface(*outer, {"wall_outer", PatchKind::outer_wall, Label::wall, Label::outside});
  const auto lumen_rims = rims_of(lumen, openings);
  const auto wall_rims = outer ? rims_of(*outer, openings) : std::vector<geometry::Loop>(openings.size());
  for (std::size_t i = 0; i < openings.size(); ++i) {
    const auto& name = openings[i].name;
    const auto& normal = openings[i].normal;
    assembly.complex.rims.push_back({"lumen_" + name, lumen_rims[i]});
    assembly.add_cap(lumen_rims[i], {}, normal, {"lumen_" + name, PatchKind::lumen_cap, Label::lumen, Label::outside});
    if (!outer) continue;
    const auto rim = shifted(wall_rims[i], std::ssize(lumen.points));
    assembly.complex.rims.push_back({"wall_" + name, rim});
    assembly.add_cap(rim, lumen_rims[i], normal, {"wall_" + name, PatchKind::wall_ring, Label::wall, Label::outside});
  }
  return std::move(assembly.complex);
}

PreparedSurfaces patient_complex(const PatientSurfaces& surfaces, const ComplexOptions& options) {
  auto lumen = mended(surfaces.lumen, "lumen surface", options.lumen_parts, options);
  check_genus(lumen, options);
  std::optional<geometry::TriangleSurface> outer;
  if (surfaces.outer) {
    outer = mended(*surfaces.outer, "outer surface", 1, options);
    geometry::check_nesting(lumen, *outer, options.clearance, options.spots);
  }
  const auto openings = geometry::find_openings(lumen, outer ? &*outer : nullptr, surfaces.names);
  check_scale(openings);
  for (const auto& o : openings)
    options.log(fmt::format("opening {}: {:.1f} mm^2, rims flattened by at most {:.2f} mm", o.name, 1e6 * o.area,
                            1e3 * o.out_of_plane));
  geometry::flatten_rims(lumen, openings, &geometry::Opening::lumen);
  if (outer) geometry::flatten_rims(*outer, openings, &geometry::Opening::wall);

  std::vector<Sheet> sheets;
  sheets.push_back({{geometry::TriangleTree(lumen), geometry::find_creases(lumen), {}}, {}, {}});
  if (outer) sheets.push_back({{geometry::TriangleTree(*outer), geometry::find_creases(*outer), {}}, {}, {}});
  auto thickness = geometry::wall_thickness(sheets[0].original.tree, outer ? &sheets[1].original.tree : nullptr,
                                            options.thickness_reach);
  std::optional<geometry::SizeField> inside;
  std::vector<double> diameter;
  if (options.sizes.across) {
    diameter = geometry::lumen_diameter(sheets[0].original.tree, options.diameter_reach).value;
    inside.emplace(lumen, geometry::lumen_sizes(lumen, diameter, options.sizes), options.sizes.gradation,
                   options.sizes.largest);
  }
  sheets[0].original.sizes = geometry::surface_sizes(lumen, thickness.value, diameter, options.sizes);
  if (outer) sheets[1].original.sizes = geometry::surface_sizes(*outer, {}, {}, options.sizes);
  agree_on_sizes(sheets, options.sizes);
  remesh_together(sheets, options.accuracy, options.sizes.gradation, options.log);
  for (std::size_t s = 0; s < sheets.size(); ++s)
    options.log(fmt::format("{}: within {:.3f} mm and {:.2f} edge lengths of the original",
                            s == 0 ? "lumen surface" : "outer surface", 1e3 * sheets[s].distance, sheets[s].relative));

  auto complex = close_at_openings(sheets[0].mesh.surface, outer ? &sheets[1].mesh.surface : nullptr, openings);
  verify(complex);
  log_complex(complex, options.log);
  auto sizes = size_field(sheets, options.sizes);
  std::optional<geometry::TriangleTree> outer_tree;
  if (outer) outer_tree = std::move(sheets[1].original.tree);
  return {std::move(complex),    std::move(sizes),     std::move(sheets[0].original.tree),
          std::move(outer_tree), std::move(thickness), openings,
          std::move(inside)};
}

}  // namespace tunica::meshing
