#include "tunica/viewer/simplify.hpp"

#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tunica/geometry/triangle_tree.hpp"

namespace tunica::viewer {

namespace {

constexpr auto none = std::numeric_limits<std::uint32_t>::max();

std::vector<float> places_of(const Body& body) {
  std::vector<float> places;
  for (const auto& x : body.points)
    for (int c = 0; c < 3; ++c) places.push_back(static_cast<float>(x[c]));
  return places;
}

unsigned int* indices_of(Body& body, const Group& group) { return body.triangles[group.first].data(); }

/// Blocks of points between the ends of all quantities.
std::vector<std::size_t> block_ends(const Body& body) {
  std::vector<std::size_t> ends{0, body.points.size()};
  for (const auto& q : body.quantities) ends.insert(ends.end(), {q.first, q.first + q.count});
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  return ends;
}

/// Old numbers of the points in their new order: within each block as the triangles meet them.
std::vector<std::uint32_t> met_in_order(const Body& body, const std::vector<std::size_t>& ends,
                                        std::vector<std::size_t>& new_ends) {
  std::vector<std::vector<std::uint32_t>> blocks(ends.size() - 1);
  std::vector<bool> met(body.points.size(), false);
  for (const auto& triangle : body.triangles)
    for (const auto node : triangle) {
      if (met[node]) continue;
      met[node] = true;
      const auto block = std::upper_bound(ends.begin(), ends.end(), node) - ends.begin() - 1;
      blocks[static_cast<std::size_t>(block)].push_back(node);
    }
  std::vector<std::uint32_t> old;
  new_ends = {0};
  for (const auto& block : blocks) {
    old.insert(old.end(), block.begin(), block.end());
    new_ends.push_back(old.size());
  }
  return old;
}

void renumber(Quantity& q, const std::vector<std::uint32_t>& old, std::size_t first, std::size_t end) {
  const auto n = static_cast<std::size_t>(q.components);
  for (auto& frame : q.frames) {
    std::vector<float> values;
    values.reserve(n * (end - first));
    for (std::size_t i = first; i < end; ++i)
      for (std::size_t c = 0; c < n; ++c) values.push_back(frame[n * (old[i] - q.first) + c]);
    frame = std::move(values);
  }
  q.first = first;
  q.count = end - first;
}

geometry::TriangleSurface surface_of(const Body& body) {
  geometry::TriangleSurface surface;
  surface.points = body.points;
  for (const auto& t : body.triangles) surface.triangles.push_back({t[0], t[1], t[2]});
  return surface;
}

/// Triangles of a group that are left, in place; returns how many.
std::size_t simplified(Body& body, const Group& group, const std::vector<float>& places, double share,
                       double distance) {
  const float scale = meshopt_simplifyScale(places.data(), body.points.size(), 3 * sizeof(float));
  const auto target = static_cast<std::size_t>(3 * std::floor(share * static_cast<double>(group.count)));
  std::vector<unsigned int> left(3 * group.count);
  const std::size_t count =
      meshopt_simplify(left.data(), indices_of(body, group), 3 * group.count, places.data(), body.points.size(),
                       3 * sizeof(float), target, static_cast<float>(distance) / scale, meshopt_SimplifyLockBorder);
  std::copy(left.begin(), left.begin() + static_cast<std::ptrdiff_t>(count), indices_of(body, group));
  return count / 3;
}

void set_deviations(const Body& before, std::vector<std::vector<float>> differences, Simplification& result) {
  for (std::size_t k = 0; k < before.quantities.size(); ++k) {
    float low = std::numeric_limits<float>::max(), high = std::numeric_limits<float>::lowest();
    for (const auto& frame : before.quantities[k].frames)
      for (const float v : frame) low = std::min(low, v), high = std::max(high, v);
    result.deviations.push_back(
        deviation_of(std::move(differences[k]), static_cast<double>(high) - static_cast<double>(low)));
  }
}

/// Where the points that are gone come to lie, and what is read there in place of their values.
void measure(const Body& before, const Body& after, Simplification& result) {
  std::vector<bool> left(before.points.size(), false);
  for (const auto& t : after.triangles)
    for (const auto node : t) left[node] = true;
  const geometry::TriangleTree tree(surface_of(after));
  std::vector<std::vector<float>> differences(before.quantities.size());
  for (std::size_t i = 0; i < before.points.size(); ++i) {
    if (left[i]) continue;
    const auto at = tree.nearest(before.points[i]);
    result.distance = std::max(result.distance, at.distance);
    const auto& t = after.triangles[static_cast<std::size_t>(at.triangle)];
    for (std::size_t k = 0; k < before.quantities.size(); ++k) {
      const auto& q = before.quantities[k];
      const auto covers = [&](std::size_t node) { return node >= q.first && node < q.first + q.count; };
      if (!covers(i) || !covers(t[0]) || !covers(t[1]) || !covers(t[2])) continue;
      const auto n = static_cast<std::size_t>(q.components);
      for (const auto& frame : q.frames)
        for (std::size_t c = 0; c < n; ++c) {
          double value = 0;
          for (int a = 0; a < 3; ++a)
            value += at.barycentric[a] * static_cast<double>(frame[n * (t[static_cast<std::size_t>(a)] - q.first) + c]);
          differences[k].push_back(static_cast<float>(value) - frame[n * (i - q.first) + c]);
        }
    }
  }
  set_deviations(before, std::move(differences), result);
}

/// Halfway between the corners of the triangles that have taken the place of their parts.
void measure_between(const Body& before, Simplification& result) {
  std::vector<std::vector<float>> differences(before.quantities.size());
  for (std::size_t k = 0; k < before.quantities.size(); ++k) {
    const auto& q = before.quantities[k];
    const auto n = static_cast<std::size_t>(q.components);
    const auto covers = [&](std::size_t point) { return point >= q.first && point < q.first + q.count; };
    for (const auto& joined : before.joined)
      for (std::size_t e = 0; e < 3; ++e) {
        const std::size_t a = joined.corners[e], b = joined.corners[(e + 1) % 3], m = joined.between[e];
        if (!covers(a) || !covers(b) || !covers(m)) continue;
        for (const auto& frame : q.frames)
          for (std::size_t c = 0; c < n; ++c) {
            const auto value = [&](std::size_t point) { return frame[n * (point - q.first) + c]; };
            differences[k].push_back(0.5F * (value(a) + value(b)) - value(m));
          }
      }
  }
  set_deviations(before, std::move(differences), result);
}

/// About `most_triangles` are left, group by group.
void thin_out(Body& body, std::size_t most_triangles, double distance) {
  const auto places = places_of(body);
  const double share = static_cast<double>(most_triangles) / static_cast<double>(body.triangles.size());
  std::vector<std::array<std::uint32_t, 3>> kept;
  for (auto& group : body.groups) {
    const std::size_t count = group.count == 0 ? 0 : simplified(body, group, places, share, distance);
    const auto first = body.triangles.begin() + static_cast<std::ptrdiff_t>(group.first);
    group.first = kept.size();
    group.count = count;
    kept.insert(kept.end(), first, first + static_cast<std::ptrdiff_t>(count));
  }
  body.triangles = std::move(kept);
}

}  // namespace

void order(Body& body) {
  for (const auto& group : body.groups)
    if (group.count > 0)
      meshopt_optimizeVertexCacheStrip(indices_of(body, group), indices_of(body, group), 3 * group.count,
                                       body.points.size());
  const auto ends = block_ends(body);
  std::vector<std::size_t> new_ends;
  const auto old = met_in_order(body, ends, new_ends);
  std::vector<std::uint32_t> number(body.points.size(), none);
  std::vector<Vec3<double>> points;
  for (std::size_t i = 0; i < old.size(); ++i) {
    number[old[i]] = static_cast<std::uint32_t>(i);
    points.push_back(body.points[old[i]]);
  }
  const auto moved = [&](std::size_t end) {
    return new_ends[static_cast<std::size_t>(std::lower_bound(ends.begin(), ends.end(), end) - ends.begin())];
  };
  for (auto& q : body.quantities) renumber(q, old, moved(q.first), moved(q.first + q.count));
  for (auto& t : body.triangles)
    for (auto& node : t) node = number[node];
  body.points = std::move(points);
}

Simplification simplify(Body& body, std::size_t most_triangles, double distance) {
  Simplification result{body.triangles.size(), body.triangles.size(), 0, {}};
  const std::size_t least = body.joined.empty() ? body.triangles.size() : body.joined.size();
  if (body.joined.empty() && (least <= most_triangles || distance <= 0)) return result;
  const Body before = body;
  if (!body.joined.empty()) {
    body.triangles.clear();
    for (const auto& joined : body.joined) body.triangles.push_back(joined.corners);
    body.joined.clear();
    for (auto& group : body.groups) group.first /= 4, group.count /= 4;
  }
  const bool thin = least > most_triangles && distance > 0;
  if (thin) thin_out(body, most_triangles, distance);
  result.triangles = body.triangles.size();
  if (thin)
    measure(before, body, result);
  else
    measure_between(before, result);
  return result;
}

}  // namespace tunica::viewer
