// For the tools of this folder: a surface with holes as a body.
#pragma once

#include "tunica/geometry/triangle_surface.hpp"

namespace tunica::test {

/// Closed by fans about the middles of its rims.
inline geometry::TriangleSurface closed(geometry::TriangleSurface surface) {
  for (const auto& loop : geometry::boundary_loops(surface)) {
    geometry::Point centre{{0, 0, 0}};
    for (const auto p : loop) centre = centre + (1.0 / static_cast<double>(loop.size())) * surface.points[p];
    surface.points.push_back(centre);
    for (std::size_t i = 0; i < loop.size(); ++i)
      surface.triangles.push_back({loop[(i + 1) % loop.size()], loop[i], std::ssize(surface.points) - 1});
  }
  return surface;
}

}  // namespace tunica::test
