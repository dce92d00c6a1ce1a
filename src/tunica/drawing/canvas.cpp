#include "tunica/drawing/canvas.hpp"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace tunica::drawing {

namespace {

Vec3<double> unit(const Vec3<double>& v) { return (1 / norm(v)) * v; }

}  // namespace

Camera look_at_all(const std::vector<geometry::Point>& points, double aspect) {
  geometry::Point low = points.at(0), high = low;
  for (const auto& p : points)
    for (int d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], p[d]);
      high[d] = std::max(high[d], p[d]);
    }
  const auto extent = high - low;
  const double* e = extent.x;
  const auto longest = std::max_element(e, e + 3) - e, shortest = std::min_element(e, e + 3) - e;
  Camera camera{0.5 * (low + high), {{0, 0, 0}}, {{0, 0, 0}}, 0};
  camera.up[static_cast<int>(longest)] = 1;
  camera.towards[static_cast<int>(longest == shortest ? (longest + 1) % 3 : shortest)] = -1;
  const double across = extent[static_cast<int>(3 - longest - shortest) % 3];
  camera.height = 1.06 * std::max(extent[static_cast<int>(longest)], across / aspect);
  return camera;
}

Canvas::Canvas(int width, int height, const Camera& camera)
    : width_(width),
      height_(height),
      camera_(camera),
      depth_(static_cast<std::size_t>(width) * height, -std::numeric_limits<float>::infinity()),
      pixels_(3 * static_cast<std::size_t>(width) * height, 255) {
  camera_.towards = unit(camera_.towards);
  right_ = unit(cross(camera_.up, camera_.towards));
  camera_.up = cross(camera_.towards, right_);
}

void Canvas::add(const std::array<geometry::Point, 3>& corners, Colour colour, std::array<bool, 3> lines, bool shaded) {
  const double scale = height_ / camera_.height;
  double x[3], y[3], z[3];
  for (int k = 0; k < 3; ++k) {
    const auto d = corners[k] - camera_.centre;
    x[k] = 0.5 * width_ + scale * dot(d, right_);
    y[k] = 0.5 * height_ + scale * dot(d, camera_.up);
    z[k] = dot(d, camera_.towards);
  }
  const double area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
  if (area == 0) return;
  const auto normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
  const double facing = std::abs(dot(normal, camera_.towards)) / norm(normal);
  const double light = shaded ? 0.35 + 0.65 * facing : 1;
  const auto range = [](const double* v, int size) {
    const auto [least, most] = std::minmax({v[0], v[1], v[2]});
    return std::pair{std::max(0, static_cast<int>(std::ceil(least - 0.5))),
                     std::min(size - 1, static_cast<int>(std::floor(most - 0.5)))};
  };
  const auto [left, right] = range(x, width_);
  const auto [bottom, top] = range(y, height_);
  for (int j = bottom; j <= top; ++j)
    for (int i = left; i <= right; ++i) {
      const double px = i + 0.5, py = j + 0.5;
      // Share of the corner k, and distance from the side opposite to it in pixels.
      double share[3];
      bool inside = true, on_line = false;
      for (int k = 0; k < 3; ++k) {
        const int a = (k + 1) % 3, b = (k + 2) % 3;
        const double twice = (x[b] - x[a]) * (py - y[a]) - (px - x[a]) * (y[b] - y[a]);
        share[k] = twice / area;
        inside = inside && share[k] >= 0;
        on_line = on_line || (lines[a] && std::abs(twice) < 0.6 * std::hypot(x[b] - x[a], y[b] - y[a]));
      }
      if (!inside) continue;
      const auto depth = static_cast<float>(share[0] * z[0] + share[1] * z[1] + share[2] * z[2]);
      const std::size_t at = static_cast<std::size_t>(j) * width_ + i;
      if (depth <= depth_[at]) continue;
      depth_[at] = depth;
      for (int c = 0; c < 3; ++c)
        pixels_[3 * at + c] = static_cast<std::uint8_t>(colour[c] * light * (on_line ? 0.45 : 1));
    }
}

std::vector<std::uint8_t> Canvas::png() const {
  vtkNew<vtkImageData> image;
  image->SetDimensions(width_, height_, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  std::memcpy(image->GetScalarPointer(), pixels_.data(), pixels_.size());
  vtkNew<vtkPNGWriter> writer;
  writer->SetCompressionLevel(9);
  writer->WriteToMemoryOn();
  writer->SetInputData(image);
  writer->Write();
  auto* bytes = writer->GetResult();
  return {bytes->GetPointer(0), bytes->GetPointer(0) + bytes->GetNumberOfValues()};
}

Colour scale_colour(double value) {
  // Five colours of the viridis map of matplotlib (Smith & van der Walt 2015).
  constexpr double stops[5][3] = {{68, 1, 84}, {59, 82, 139}, {33, 145, 140}, {94, 201, 98}, {253, 231, 37}};
  const double at = 4 * std::clamp(value, 0.0, 1.0);
  const int k = std::min(3, static_cast<int>(at));
  Colour colour;
  for (int c = 0; c < 3; ++c) colour[c] = static_cast<std::uint8_t>(std::lerp(stops[k][c], stops[k + 1][c], at - k));
  return colour;
}

}  // namespace tunica::drawing
