#include "tunica/imaging/smooth_field.hpp"

#include <algorithm>
#include <cmath>

#include "tunica/geometry/contour.hpp"
#include "tunica/imaging/gaussian.hpp"

namespace tunica::imaging {

double SmoothField::at(const Point& place) const {
  const Point v = to_voxels * (place - frame.origin);
  std::int64_t first[3];
  double share[3];
  for (int d = 0; d < 3; ++d) {
    const double whole = std::floor(v[d]);
    if (!(whole >= 0 && whole + 1 < static_cast<double>(frame.size[d]))) return 0.5;
    first[d] = static_cast<std::int64_t>(whole);
    share[d] = v[d] - whole;
  }
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    double weight = 1;
    std::int64_t c[3];
    for (int d = 0; d < 3; ++d) {
      const int up = corner >> d & 1;
      weight *= up ? share[d] : 1 - share[d];
      c[d] = first[d] + up;
    }
    sum += weight * values[frame.index(c[0], c[1], c[2])];
  }
  return sum;
}

SmoothField smooth_field(const LumenMask& mask, double sigma) {
  SmoothField field{mask.frame, inverse(mask.frame.matrix()), {}};
  std::vector<float> once(mask.kinds.size());
  for (std::size_t i = 0; i < once.size(); ++i) once[i] = mask.kinds[i] == Kind::tissue ? 0.0F : 1.0F;
  blur(mask.frame, sigma, once);
  auto twice = once;
  blur(mask.frame, sigma, twice);
  field.values = std::move(once);
  for (std::size_t i = 0; i < twice.size(); ++i) field.values[i] = 0.5F - (2 * field.values[i] - twice[i]);
  return field;
}

geometry::TriangleSurface boundary(const SmoothField& field) {
  auto surface = geometry::zero_surface({Point{{0, 0, 0}}, 1, field.frame.size, field.values});
  for (auto& p : surface.points) p = field.frame.place(p);
  // Axes that are left-handed turn the triangles over.
  if (determinant(field.frame.matrix()) < 0)
    for (auto& t : surface.triangles) std::swap(t[1], t[2]);
  return surface;
}

}  // namespace tunica::imaging
