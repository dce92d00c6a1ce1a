#include "tunica/mesh_io/extent.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "tunica/base/error.hpp"

namespace tunica::mesh_io {

namespace {

constexpr double smallest_extent = 2e-3, largest_extent = 20;  // m, of the diagonal
constexpr double likely_smallest = 2e-2, likely_largest = 2;   // m

Vec3<double> box(std::span<const Vec3<double>> points) {
  if (points.empty()) return {{0, 0, 0}};
  Vec3<double> low = points[0], high = points[0];
  for (const auto& p : points)
    for (int d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], p[d]);
      high[d] = std::max(high[d], p[d]);
    }
  return high - low;
}

/// "m (120 mm)" for each common unit in which a body of this many units is as large as an aorta.
std::string likely_units(double units) {
  std::string text;
  for (const auto& [name, metres] : {std::pair("m", 1.0), {"cm", 1e-2}, {"mm", 1e-3}, {"um", 1e-6}})
    if (const double size = units * metres; size >= likely_smallest && size <= likely_largest)
      text += fmt::format("{}{} ({:.4g} mm)", text.empty() ? "" : " or ", name, 1e3 * size);
  return text;
}

}  // namespace

std::string size_text(std::span<const Vec3<double>> points) {
  const auto size = box(points);
  return fmt::format("{:.4g} mm x {:.4g} mm x {:.4g} mm", 1e3 * size[0], 1e3 * size[1], 1e3 * size[2]);
}

void refuse_unlikely_size(std::span<const Vec3<double>> points, double metres_per_unit, const std::string& where) {
  const double diagonal = norm(box(points));
  if (diagonal >= smallest_extent && diagonal <= largest_extent) return;
  const auto units = likely_units(diagonal / metres_per_unit);
  throw InputError(
      where,
      fmt::format("its size is {} by the declared length unit of {:g} m; vessels between {:g} mm and {:g} m "
                  "are possible",
                  size_text(points), metres_per_unit, 1e3 * smallest_extent, largest_extent),
      units.empty() ? "correct length_unit, or the coordinates in the file"
                    : fmt::format("correct length_unit, it may be {}", units));
}

}  // namespace tunica::mesh_io
