#include "tunica/geometry/thickness.hpp"

namespace tunica::geometry {

double thickness_at(const TriangleTree& surface, const Point& x, const Vec3<double>& normal, double most) {
  constexpr double same_side = 0.5, settled = 1e-3;  // cosine of 60 degrees; relative
  constexpr int most_balls = 50;
  const auto bounds = [&](const SurfacePoint& p) { return dot(surface.normal(p.triangle), normal) < same_side; };
  double radius = most / 2;
  for (int ball = 0; ball < most_balls; ++ball) {
    const Point centre = x - radius * normal;
    const SurfacePoint touched = surface.nearest_if(centre, radius * (1 - settled), bounds);
    if (!touched) break;
    const Vec3<double> chord = x - touched.place;
    const double next = dot(chord, chord) / (2 * dot(normal, chord));
    if (!(next > 0 && next < radius)) break;
    radius = next;
  }
  return 2 * radius;
}

}  // namespace tunica::geometry
