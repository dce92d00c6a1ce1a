#include "tunica/imaging/tear_size.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tunica/geometry/triangle_tree.hpp"
#include "tunica/imaging/distance.hpp"

namespace tunica::imaging {

namespace {

constexpr double reach_of_change = 6e-3;               // m about a tear that give way
constexpr double least_scale = 0.7, most_scale = 1.2;  // of its diameter

/// The open part of the surface between the lumens.
struct Open {
  Point centre{{0, 0, 0}};
  Vec3<double> area{{0, 0, 0}};  ///< towards the true lumen, as that of a contact [m^2]
};

std::size_t nearest(const std::vector<Contact>& tears, const Point& place) {
  const auto found = std::min_element(tears.begin(), tears.end(), [&](const Contact& a, const Contact& b) {
    return norm(a.centre - place) < norm(b.centre - place);
  });
  return static_cast<std::size_t>(found - tears.begin());
}

/// Integrals over the surface `side` = 0 in the lumen with a delta function of width 2 w, (1 + cos(pi s / w)) / 2 w.
std::vector<Open> open_parts(const FlapSides& sides, const std::vector<Contact>& tears,
                             const geometry::TriangleTree& lumen) {
  const auto& frame = sides.frame;
  const double width = 1.5 * frame.largest_spacing();
  const auto to_metres = transpose(inverse(frame.matrix()));
  const std::int64_t stride[3] = {1, frame.size[0], frame.size[0] * frame.size[1]};
  std::vector<Open> parts(tears.size());
  std::vector<double> weights(tears.size(), 0.0);
  for (std::int64_t i = 0; i < std::ssize(sides.side); ++i) {
    if (std::abs(sides.side[i]) >= width || sides.to_tear[i] > reach_of_change) continue;
    const auto v = frame.voxel(i);
    bool inner = true;
    for (int d = 0; d < 3; ++d) inner = inner && v[d] > 0 && v[d] + 1 < frame.size[d];
    if (!inner) continue;
    Vec3<double> slope{{0, 0, 0}};
    for (int d = 0; d < 3; ++d) slope[d] = 0.5 * (sides.side[i + stride[d]] - sides.side[i - stride[d]]);
    slope = to_metres * slope;
    // Beside a thin flap there is lumen: what counts is the surface between, below this place.
    const Point place = frame.place(v) - (sides.side[i] / std::max(dot(slope, slope), 0.25)) * slope;
    if (!lumen.contains(place)) continue;
    const double weight = (1 + std::cos(M_PI * sides.side[i] / width)) / (2 * width) * frame.voxel_volume();
    const auto tear = nearest(tears, place);
    parts[tear].area = parts[tear].area + weight * slope;
    parts[tear].centre = parts[tear].centre + weight * place;
    weights[tear] += weight;
  }
  for (std::size_t t = 0; t < parts.size(); ++t)
    if (weights[t] > 0) parts[t].centre = (1 / weights[t]) * parts[t].centre;
  return parts;
}

/// 1 in the tear, 0 from `reach_of_change` on, without steps in the slope.
double share_of(double distance) {
  const double s = std::clamp(1 - distance / reach_of_change, 0.0, 1.0);
  return s * s * (3 - 2 * s);
}

/// How far a place is drawn towards the middle of the tear that it is nearest to.
Vec3<double> way_about(const Point& p, const SmoothField& to_tear, const std::vector<Contact>& tears,
                       const std::vector<Open>& open) {
  const Vec3<double> v = to_tear.to_voxels * (p - to_tear.frame.origin);
  for (int d = 0; d < 3; ++d)
    if (v[d] < 0 || v[d] >= static_cast<double>(to_tear.frame.size[d] - 1)) return {};
  const double share = share_of(to_tear.at(p));
  const auto t = nearest(tears, p);
  const double area = norm(open[t].area);
  if (share == 0 || area == 0) return {};
  const double scale = std::clamp(std::sqrt(tears[t].area / area), least_scale, most_scale);
  const Vec3<double> normal = (1 / area) * open[t].area, way = p - open[t].centre;
  return (share * (scale - 1)) * (way - dot(way, normal) * normal);
}

}  // namespace

std::vector<double> narrow_tears(const FlapSides& sides, const std::vector<Contact>& tears,
                                 geometry::TriangleSurface& surface, std::vector<Point>& contour, const Log& log) {
  const auto before = open_parts(sides, tears, geometry::TriangleTree(surface));
  const SmoothField distance{sides.frame, inverse(sides.frame.matrix()), sides.to_tear};
  for (auto* points : {&surface.points, &contour})
    for (auto& p : *points) p = p + way_about(p, distance, tears, before);
  std::vector<double> result;
  for (const auto& part : open_parts(sides, tears, geometry::TriangleTree(surface))) result.push_back(norm(part.area));
  for (std::size_t t = 0; t < tears.size(); ++t)
    log(
        fmt::format("tear at {}: {:.0f} mm^2 as in the labels, {:.0f} mm^2 in the surface, {:.0f} mm^2 before its rim "
                    "was moved",
                    in_mm(tears[t].centre), 1e6 * tears[t].area, 1e6 * result[t], 1e6 * norm(before[t].area)));
  return result;
}

}  // namespace tunica::imaging
