#include "tunica/meshing/surface_complex.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "tunica/base/error.hpp"
#include "tunica/geometry/self_intersections.hpp"
#include "tunica/geometry/surface_file.hpp"

namespace tunica::meshing {

namespace {

/// +1 where the normal of the patch points out of the label, -1 where it points in, 0 where both or none is the label.
int outward(const Patch& patch, Label label) {
  return static_cast<int>(patch.negative == label) - static_cast<int>(patch.positive == label);
}

/// Middles of edges where the triangles around a label do not close up, each seen from its two neighbours.
std::vector<geometry::Point> gaps(const SurfaceComplex& complex, Label label) {
  std::map<std::pair<std::int64_t, std::int64_t>, int> balance;
  for (std::size_t t = 0; t < complex.triangles.size(); ++t) {
    const int sign = outward(complex.patches[complex.patch_of[t]], label);
    if (sign == 0) continue;
    for (int i = 0; i < 3; ++i) {
      const auto a = complex.triangles[t][i], b = complex.triangles[t][(i + 1) % 3];
      balance[std::minmax(a, b)] += a < b ? sign : -sign;
    }
  }
  std::vector<geometry::Point> places;
  for (const auto& [edge, sum] : balance)
    if (sum != 0) places.push_back(0.5 * (complex.points[edge.first] + complex.points[edge.second]));
  return places;
}

}  // namespace

double volume(const SurfaceComplex& complex, Label label) {
  geometry::TriangleSurface around{complex.points, {}};
  for (std::size_t t = 0; t < complex.triangles.size(); ++t) {
    auto corners = complex.triangles[t];
    const int sign = outward(complex.patches[complex.patch_of[t]], label);
    if (sign < 0) std::swap(corners[1], corners[2]);
    if (sign != 0) around.triangles.push_back(corners);
  }
  return geometry::enclosed_volume(around);
}

double area(const SurfaceComplex& complex, std::int32_t patch) {
  const geometry::TriangleSurface all{complex.points, {}};
  double sum = 0;
  for (std::size_t t = 0; t < complex.triangles.size(); ++t)
    if (complex.patch_of[t] == patch) sum += norm(geometry::area_vector(all, complex.triangles[t]));
  return sum;
}

geometry::TriangleSurface surface_of(const SurfaceComplex& complex, PatchKind kind) {
  geometry::TriangleSurface surface{complex.points, {}};
  for (std::size_t t = 0; t < complex.triangles.size(); ++t)
    if (complex.patches[complex.patch_of[t]].kind == kind) surface.triangles.push_back(complex.triangles[t]);
  geometry::drop_unused_points(surface);
  return surface;
}

void verify(const SurfaceComplex& complex) {
  for (const auto& [label, name] : {std::pair{Label::lumen, "lumen"}, std::pair{Label::wall, "wall"}})
    if (const auto places = gaps(complex, label); !places.empty())
      throw SolverError(
          fmt::format("the surfaces around the {} do not close at {}", name, geometry::list_places_mm(places)));
  std::vector<geometry::Point> places;
  for (const auto& [s, t] : geometry::crossing_triangles({complex.points, complex.triangles}))
    places.push_back(complex.points[complex.triangles[s][0]]);
  if (!places.empty())
    throw SolverError(
        fmt::format("{} pairs of triangles cross, near {}", places.size(), geometry::list_places_mm(places)));
}

void write_complex(const SurfaceComplex& complex, const std::filesystem::path& path) {
  geometry::SurfaceArray patch{"patch", {}}, kind{"kind", {}}, negative{"negative_label", {}},
      positive{"positive_label", {}};
  for (const auto p : complex.patch_of) {
    patch.values.push_back(p);
    kind.values.push_back(static_cast<double>(complex.patches[p].kind));
    negative.values.push_back(static_cast<double>(complex.patches[p].negative));
    positive.values.push_back(static_cast<double>(complex.patches[p].positive));
  }
  std::vector<std::string> names;
  for (const auto& p : complex.patches) names.push_back(p.name);
  geometry::write_surface({complex.points, complex.triangles}, path, {}, {patch, kind, negative, positive}, names);
}

}  // namespace tunica::meshing
