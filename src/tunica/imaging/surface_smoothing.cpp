#include "tunica/imaging/surface_smoothing.hpp"

namespace tunica::imaging {

void smooth_surface(geometry::TriangleSurface& surface, int sweeps) {
  constexpr double towards = 0.5, away = -0.52;  // pass band of (9.3): 1/0.5 - 1/0.52 = 0.077
  auto& points = surface.points;
  const auto all = geometry::edges(surface);
  std::vector<double> share(points.size(), 0);
  for (const auto& edge : all) {
    ++share[edge.a];
    ++share[edge.b];
  }
  for (auto& s : share) s = 1 / s;
  std::vector<Vec3<double>> way(points.size());
  for (int half_sweep = 0; half_sweep < 2 * sweeps; ++half_sweep) {
    std::fill(way.begin(), way.end(), Vec3<double>{{0, 0, 0}});
    for (const auto& edge : all) {
      const auto across = points[edge.b] - points[edge.a];
      way[edge.a] = way[edge.a] + across;
      way[edge.b] = way[edge.b] - across;
    }
    const double factor = half_sweep % 2 == 0 ? towards : away;
    for (std::size_t p = 0; p < points.size(); ++p) points[p] = points[p] + (factor * share[p]) * way[p];
  }
}

}  // namespace tunica::imaging
