// Draws shaded triangles without a screen: reports are written where there is no display, which VTK's own renderer
// needs.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "tunica/geometry/triangle_surface.hpp"

namespace tunica::drawing {

using Colour = std::array<std::uint8_t, 3>;  ///< red, green, blue

/// A parallel projection: `centre` is in the middle of the picture, whose height shows `height` [m].
struct Camera {
  geometry::Point centre;
  Vec3<double> towards, up;  ///< from the scene to the camera; need not be unit or orthogonal
  double height;
};

/// From the side that shows the most of a box, its longest side upright.
Camera look_at_all(const std::vector<geometry::Point>& points, double aspect);

class Canvas {
 public:
  Canvas(int width, int height, const Camera& camera);

  /// `lines`: of the sides after each corner, are they drawn? Flat colour when `shaded` is false.
  void add(const std::array<geometry::Point, 3>& corners, Colour colour, std::array<bool, 3> lines = {},
           bool shaded = true);
  /// The picture as a PNG file.
  std::vector<std::uint8_t> png() const;

 private:
  int width_, height_;
  Camera camera_;
  Vec3<double> right_;
  std::vector<float> depth_;
  std::vector<std::uint8_t> pixels_;
};

/// A colour scale from dark blue over green to yellow, for values from 0 to 1.
Colour scale_colour(double value);

}  // namespace tunica::drawing
