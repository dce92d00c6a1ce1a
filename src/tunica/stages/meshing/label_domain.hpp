// A body to be meshed, given by a function that says what each point belongs to.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "tunica/base/tensor.hpp"

namespace tunica::stages::meshing {

using Point = Vec3<double>;  ///< m

struct Box {
  Point low{{0, 0, 0}}, high{{0, 0, 0}};
};

/// Labels by convention: what the engine itself needs is only that 0 is outside.
inline constexpr int outside = 0, lumen_label = 1, wall_label = 2;

/// Surfaces between labels are smooth but for `curves`, and only there do more than two labels meet.
struct LabelDomain {
  std::function<int(const Point&)> label;  ///< 0 outside; called tens of millions of times
  Box box;                                 ///< holds every point whose label is not 0, with room around it
  std::vector<std::vector<Point>> curves;  ///< sharp edges as closed polylines (first point = last), kept as edges
  std::function<double(const Point&)> surface_size;      ///< edge length on surfaces and curves [m], > 0
  std::function<double(const Point&, int)> volume_size;  ///< edge length within a label [m], > 0
  std::function<double(const Point&)> surface_distance;  ///< of the triangles from the surface [m], > 0
};

}  // namespace tunica::stages::meshing
