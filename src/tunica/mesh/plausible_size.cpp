#include "tunica/mesh/plausible_size.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tunica/mesh/boundary.hpp"

namespace tunica::mesh {

namespace {

constexpr double longest = 0.7, shortest = 5e-3;                 // m
constexpr double likely_longest = 0.6, likely_shortest = 15e-3;  // m: what a slip is taken for
constexpr double most_volume = 1e-3;                             // m^3

/// Longest side of the box around all nodes.
double extent(const MeshData& data) {
  double largest = 0;
  for (int d = 0; d < 3; ++d) {
    const auto [low, high] = std::minmax_element(data.points.begin(), data.points.end(),
                                                 [d](const auto& a, const auto& b) { return a[d] < b[d]; });
    if (low != data.points.end()) largest = std::max(largest, (*high)[d] - (*low)[d]);
  }
  return largest;
}

double lumen_volume(const MeshData& data) {
  double sum = 0;
  for (const auto& region : data.regions)
    if (region.kind == RegionKind::lumen)
      for (auto e = region.first_element; e < region.end_element; ++e) sum += volume(data.points, data.tetrahedra[e]);
  return sum;
}

std::string remedy(double in_unit) {
  for (const auto& [name, metres] : {std::pair{"mm", 1e-3}, {"cm", 1e-2}, {"m", 1.0}, {"um", 1e-6}})
    if (in_unit * metres >= likely_shortest && in_unit * metres <= likely_longest)
      return fmt::format("a slip of the unit? with `length_unit: {}` it would be {:.4g} mm", name,
                         1e3 * in_unit * metres);
  return "check `length_unit`";
}

}  // namespace

std::optional<Problem> implausible_size(const MeshData& data, const std::optional<double>& metres_per_unit) {
  const double length = extent(data), lumen = lumen_volume(data);
  const bool long_or_short = length > longest || length < shortest;
  if (!long_or_short && lumen <= most_volume) return std::nullopt;
  std::string what;
  if (long_or_short)
    what = fmt::format("the mesh is {:.4g} mm long; {:.0f} mm to {:.0f} mm is usual", 1e3 * length, 1e3 * shortest,
                       1e3 * longest);
  if (lumen > most_volume)
    what += fmt::format("{}the lumen holds {:.4g} l; up to {:.0f} l is usual", what.empty() ? "" : ", and ",
                        1e3 * lumen, 1e3 * most_volume);
  return Problem{"meshes", what, metres_per_unit ? remedy(length / *metres_per_unit) : "check the sizes"};
}

}  // namespace tunica::mesh
