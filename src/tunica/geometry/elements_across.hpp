// How many elements a mesh has across its lumen, by which one can tell whether flow is resolved: the local diameter
// over what an edge extends in its direction.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tunica/geometry/triangle_surface.hpp"

namespace tunica::geometry {

/// What flow needs (docs/meshing.md).
inline constexpr double enough_quadratic = 4, enough_linear = 10;

struct ElementsAcross {
  std::vector<double> count;         ///< at each node; infinity outside the lumen and where no wall faces another
  std::vector<double> diameter;      ///< of the lumen there [m]
  std::vector<double> volume;        ///< a quarter of all elements around the node [m^3]
  std::vector<std::int64_t> facing;  ///< triangle of the wall on the other side; -1 likewise
  std::vector<std::int64_t> wall;    ///< triangle of the wall nearest to the node; -1: none is, or outside the lumen
};

/// `elements`: tetrahedra of the lumen; `wall`: its boundary but for the openings, seen from outside counter-clockwise;
/// both by nodes of `points`. The diameter at a node is `lumen_diameter` where the wall is nearest to it. Edges of the
/// elements around the node, whose extent along the direction to that place is on average half their length where they
/// have no preferred direction, count with twice that extent: flat elements count by their height.
ElementsAcross elements_across(const std::vector<Point>& points, std::span<const std::array<std::int64_t, 4>> elements,
                               std::vector<Triangle> wall);

/// A part of the lumen in one line.
struct AcrossPart {
  std::string name;
  double least, median;  ///< elements across that 5 and 50 % of the volume stay below
  double diameter;       ///< where the least is [m]
  Point place;           ///< m
};

/// Of the nodes that `belongs` accepts; none where no node has a count.
std::optional<AcrossPart> across_part(const std::string& name, const std::vector<Point>& points,
                                      const ElementsAcross& across, const std::function<bool(std::int64_t)>& belongs);

/// Which parts have fewer elements across than `enough`, and where; none when all have enough. A mesh that was asked
/// for `enough` varies about it: what a part is judged by is its median, and its least only below two thirds.
std::optional<std::string> too_few_across(const std::vector<AcrossPart>& parts, double enough);

}  // namespace tunica::geometry
