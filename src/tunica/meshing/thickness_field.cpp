#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tunica/base/error.hpp"
#include "tunica/geometry/surface_file.hpp"
#include "tunica/geometry/triangle_tree.hpp"
#include "tunica/mesh_io/vtk_files.hpp"
#include "tunica/meshing/wall_growth.hpp"

namespace tunica::meshing {

namespace {

constexpr double thinnest_wall = 0.3e-3, thickest_wall = 6e-3;  // m

/// Values of the field [m]; NaN where it has none.
std::vector<double> values_of(const ThicknessField& field) {
  const auto file = mesh_io::read_vtk_surface(field.file, {field.array});
  std::vector<double> values = file.node_fields.front().values;
  for (std::size_t p = 0; p < values.size(); ++p) {
    values[p] *= field.metres_per_value;
    if (!std::isnan(values[p]) && !(values[p] >= thinnest_wall && values[p] <= thickest_wall))
      throw InputError(
          field.file.string(),
          fmt::format("`{}` is {:.4g} mm at point {}, no thickness of a wall", field.array, 1e3 * values[p], p + 1),
          "give 0.3 to 6 mm, or nan where the rule shall hold; is `unit` that of the values?");
  }
  return values;
}

/// Interpolated in a triangle; a corner that lies opposite to the place has no say, so that a border of nan is where it
/// was painted.
double value_at(const geometry::TriangleTree& tree, const geometry::SurfacePoint& at,
                const std::vector<double>& values) {
  const auto& corners = tree.surface().triangles[static_cast<std::size_t>(at.triangle)];
  double sum = 0;
  for (int a = 0; a < 3; ++a)
    if (at.barycentric[a] > 1e-6) sum += at.barycentric[a] * values[static_cast<std::size_t>(corners[a])];
  return sum;
}

}  // namespace

config::Schema<ThicknessField> ThicknessField::schema() {
  using T = ThicknessField;
  return config::Schema<T>("thickness", "Thickness of the wall at the points of a surface that lies on the lumen.")
      .file("file", &T::file, "Surface (.vtp) with the array; the one that is named as `lumen` may be it")
      .text("array", &T::array, "Array at its points; nan where the rule shall hold")
      .unit("length_unit", &T::metres_per_unit, config::dimension::length, "Unit of its coordinates")
      .unit("unit", &T::metres_per_value, config::dimension::length, "Unit of the values")
      .quantity("reach", &T::reach, config::dimension::length, config::range(0.1e-3, 20e-3),
                "How far from the lumen that surface may lie; the rule holds beyond")
      .by_default();
}

void check_thickness(const ThicknessField& field) {
  const auto values = values_of(field);
  if (std::all_of(values.begin(), values.end(), [](double v) { return std::isnan(v); }))
    throw InputError(field.file.string(), fmt::format("`{}` is nan at all points", field.array),
                     "give the thickness where it was measured, or leave out `thickness`");
}

std::size_t take_thickness(const ThicknessField& field, const std::vector<geometry::Point>& points,
                           std::vector<double>& thickness) {
  const auto values = values_of(field);
  const geometry::TriangleTree tree(geometry::read_surface(field.file, field.metres_per_unit));
  std::size_t taken = 0;
  for (std::size_t p = 0; p < points.size(); ++p) {
    const auto nearest = tree.nearest(points[p]);
    if (!(nearest.distance <= field.reach)) continue;
    const double value = value_at(tree, nearest, values);
    if (std::isnan(value)) continue;
    thickness[p] = value;
    ++taken;
  }
  if (taken == 0)
    throw InputError(field.file.string(),
                     fmt::format("no point of the lumen is within {:.3g} mm of a triangle with values of `{}`",
                                 1e3 * field.reach, field.array),
                     "is `length_unit` that of its coordinates, and does it lie on the lumen? `reach` may be larger");
  return taken;
}

}  // namespace tunica::meshing
