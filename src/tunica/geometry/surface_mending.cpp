#include "tunica/geometry/surface_mending.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "tunica/base/error.hpp"
#include "tunica/geometry/self_intersections.hpp"
#include "tunica/geometry/triangle_tree.hpp"

namespace tunica::geometry {

namespace {

/// Problems with their places, thrown together in the end.
class Complaints {
 public:
  Complaints(std::string where, std::filesystem::path file) : where_(std::move(where)), file_(std::move(file)) {}

  void add(const std::string& what, const std::vector<Point>& places, const std::string& remedy) {
    if (places.empty()) return;
    problems_.push_back({where_, fmt::format("{} {}: {}", places.size(), what, list_places_mm(places)), remedy});
    for (const auto& place : places) spots_.push_back({place, what});
  }
  void throw_any() {
    if (problems_.empty()) return;
    if (!file_.empty()) {
      // Usually in the folder of a mesh that will not be; if it cannot be made, writing says so.
      std::error_code ignored;
      if (file_.has_parent_path()) std::filesystem::create_directories(file_.parent_path(), ignored);
      try {
        write_spots(spots_, file_);
        problems_.back().remedy += fmt::format(" (all places are in {})", file_.string());
      } catch (const SolverError& error) {  // the problems are what counts
        problems_.back().remedy += fmt::format(" (the file of all places is missing: {})", error.what());
      }
    }
    throw InputError(problems_);
  }

 private:
  std::string where_;
  std::filesystem::path file_;
  std::vector<Problem> problems_;
  std::vector<Spot> spots_;
};

Point centre(const TriangleSurface& s, const Triangle& t) {
  return (1.0 / 3) * (s.points[t[0]] + s.points[t[1]] + s.points[t[2]]);
}

double diagonal(const TriangleSurface& surface) {
  Point low = surface.points[0], high = low;
  for (const auto& p : surface.points)
    for (int d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], p[d]);
      high[d] = std::max(high[d], p[d]);
    }
  return norm(high - low);
}

void refuse_not_finite(const TriangleSurface& surface, const std::string& name) {
  std::vector<std::int64_t> bad;
  for (const auto& t : surface.triangles)
    for (const auto p : t)
      if (const auto& x = surface.points[p]; !(std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2])))
        bad.push_back(p);
  if (!bad.empty())
    throw InputError(name,
                     fmt::format("points with coordinates that are not finite; the first is number {}", bad[0] + 1),
                     "export the surface again");
}

/// Merges points closer than a ten-millionth of the extent: formats such as STL repeat them for each triangle.
std::int64_t merge_points(TriangleSurface& surface) {
  const double tolerance = 1e-7 * diagonal(surface);
  const auto& points = surface.points;
  std::vector<std::int64_t> order(points.size()), target(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::iota(target.begin(), target.end(), 0);
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return points[a][0] < points[b][0]; });
  std::int64_t merged = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (target[order[i]] != order[i]) continue;
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      if (points[order[j]][0] - points[order[i]][0] > tolerance) break;
      if (target[order[j]] != order[j] || norm(points[order[j]] - points[order[i]]) > tolerance) continue;
      target[order[j]] = order[i];
      ++merged;
    }
  }
  for (auto& t : surface.triangles)
    for (auto& p : t) p = target[p];
  return merged;
}

/// Drops triangles that repeat a point, and all but the first of those with the same points.
std::int64_t drop_degenerate(TriangleSurface& surface) {
  const auto before = std::ssize(surface.triangles);
  std::set<Triangle> seen;
  std::erase_if(surface.triangles, [&](const Triangle& t) {
    Triangle sorted = t;
    std::sort(sorted.begin(), sorted.end());
    return sorted[0] == sorted[1] || sorted[1] == sorted[2] || !seen.insert(sorted).second;
  });
  return before - std::ssize(surface.triangles);
}

std::int64_t drop_fragments(TriangleSurface& surface) {
  const auto part = components(surface);
  std::map<std::int64_t, double> areas;
  double total = 0;
  for (std::size_t t = 0; t < part.size(); ++t) {
    const double a = norm(area_vector(surface, surface.triangles[t]));
    areas[part[t]] += a;
    total += a;
  }
  std::vector<Triangle> kept;
  for (std::size_t t = 0; t < part.size(); ++t)
    if (areas[part[t]] >= 0.01 * total) kept.push_back(surface.triangles[t]);
  surface.triangles = kept;
  return std::count_if(areas.begin(), areas.end(), [&](const auto& a) { return a.second < 0.01 * total; });
}

bool same_way(const Triangle& s, const Triangle& t, std::int64_t a, std::int64_t b) {
  const auto forward = [&](const Triangle& x) {
    for (int i = 0; i < 3; ++i)
      if (x[i] == a && x[(i + 1) % 3] == b) return true;
    return false;
  };
  return forward(s) == forward(t);
}

/// Turns triangles until neighbours agree; returns the middles of edges where that is impossible.
std::vector<Point> orient(TriangleSurface& surface, std::int64_t& turned) {
  const auto all = edges(surface);
  std::vector<std::vector<std::size_t>> of_triangle(surface.triangles.size());
  for (std::size_t e = 0; e < all.size(); ++e)
    for (const auto t : all[e].triangles) of_triangle[t].push_back(e);
  std::vector<int> state(surface.triangles.size(), 0);  // 1: kept, -1: turned
  std::vector<Point> conflicts;
  for (std::size_t seed = 0; seed < state.size(); ++seed) {
    if (state[seed] != 0) continue;
    std::vector<std::int64_t> stack{static_cast<std::int64_t>(seed)};
    state[seed] = 1;
    while (!stack.empty()) {
      const auto t = stack.back();
      stack.pop_back();
      for (const auto e : of_triangle[t])
        for (const auto other : all[e].triangles) {
          if (other == t || all[e].triangles.size() != 2) continue;
          const int due =
              same_way(surface.triangles[t], surface.triangles[other], all[e].a, all[e].b) ? -state[t] : state[t];
          if (state[other] == 0) {
            state[other] = due;
            stack.push_back(other);
          } else if (state[other] != due) {
            conflicts.push_back(0.5 * (surface.points[all[e].a] + surface.points[all[e].b]));
          }
        }
    }
  }
  turned = 0;
  for (std::size_t t = 0; t < state.size(); ++t)
    if (state[t] < 0) {
      std::swap(surface.triangles[t][1], surface.triangles[t][2]);
      ++turned;
    }
  return conflicts;
}

/// Fans from the middle of each loop: closes the surface well enough to tell inside from outside.
TriangleSurface closed(TriangleSurface surface, const std::vector<Loop>& loops) {
  for (const auto& loop : loops) {
    Point middle{{0, 0, 0}};
    for (const auto p : loop) middle = middle + (1.0 / static_cast<double>(loop.size())) * surface.points[p];
    surface.points.push_back(middle);
    for (std::size_t i = 0; i < loop.size(); ++i)
      surface.triangles.push_back({loop[(i + 1) % loop.size()], loop[i], std::ssize(surface.points) - 1});
  }
  return surface;
}

std::int64_t fill_small_holes(TriangleSurface& surface, double diameter) {
  std::vector<Loop> small;
  for (const auto& loop : boundary_loops(surface)) {
    double length = 0;
    for (std::size_t i = 0; i < loop.size(); ++i)
      length += norm(surface.points[loop[i]] - surface.points[loop[(i + 1) % loop.size()]]);
    if (length <= M_PI * diameter) small.push_back(loop);
  }
  surface = closed(std::move(surface), small);
  return std::ssize(small);
}

/// Turns each part outward, by the sign of the volume it encloses.
void turn_outward(TriangleSurface& surface, std::vector<std::string>& report) {
  auto whole = closed(surface, boundary_loops(surface));
  const auto part = components(whole);
  for (std::int64_t number = 0; number <= *std::max_element(part.begin(), part.end()); ++number) {
    TriangleSurface one{whole.points, {}};
    for (std::size_t t = 0; t < part.size(); ++t)
      if (part[t] == number) one.triangles.push_back(whole.triangles[t]);
    drop_unused_points(one);
    if (enclosed_volume(one) >= 0) continue;
    report.push_back("normals pointed inward, all triangles turned");
    for (std::size_t t = 0; t < surface.triangles.size(); ++t)
      if (part[t] == number) std::swap(surface.triangles[t][1], surface.triangles[t][2]);
  }
}

/// Points whose triangles do not form one fan.
std::vector<Point> touching_points(const TriangleSurface& surface) {
  std::vector<std::vector<std::int64_t>> around(surface.points.size());
  for (std::int64_t t = 0; t < std::ssize(surface.triangles); ++t)
    for (const auto p : surface.triangles[t]) around[p].push_back(t);
  std::vector<Point> places;
  for (std::size_t p = 0; p < around.size(); ++p) {
    if (around[p].empty()) continue;
    auto left = around[p];
    std::vector<std::int64_t> stack{left.back()};
    left.pop_back();
    while (!stack.empty()) {
      const auto t = surface.triangles[stack.back()];
      stack.pop_back();
      std::erase_if(left, [&](std::int64_t other) {
        int shared = 0;
        for (const auto a : t)
          shared += std::count(surface.triangles[other].begin(), surface.triangles[other].end(), a);
        if (shared >= 2) stack.push_back(other);
        return shared >= 2;
      });
    }
    if (!left.empty()) places.push_back(surface.points[p]);
  }
  return places;
}

void complain_about_topology(const TriangleSurface& surface, const MendOptions& options, Complaints& complaints) {
  std::vector<Point> many;
  for (const auto& edge : edges(surface))
    if (edge.triangles.size() > 2) many.push_back(0.5 * (surface.points[edge.a] + surface.points[edge.b]));
  complaints.add("edges belong to more than two triangles", many,
                 "remove inner walls and double sheets, for example with a Boolean union");
  complaints.add("points where the surface touches itself", touching_points(surface),
                 "separate the sheets there, or merge them");
  const auto part = components(surface);
  std::map<std::int64_t, Point> first;
  for (std::size_t t = 0; t < part.size(); ++t) first.emplace(part[t], centre(surface, surface.triangles[t]));
  std::vector<Point> places;
  for (const auto& [number, place] : first) places.push_back(place);
  if (std::ssize(places) != options.parts)
    complaints.add(fmt::format("separate parts instead of {}", options.parts), places,
                   "join the parts, or remove what does not belong to the vessel");
}

void complain_about_crossings(const TriangleSurface& surface, Complaints& complaints) {
  std::vector<Point> places;
  for (const auto& [s, t] : crossing_triangles(surface))
    places.push_back(0.5 * (centre(surface, surface.triangles[s]) + centre(surface, surface.triangles[t])));
  complaints.add("pairs of triangles cross", places, "smooth or separate the surface there");
}

void note(std::vector<std::string>& report, std::int64_t count, const std::string& what) {
  if (count > 0) report.push_back(fmt::format("{} {}", count, what));
}

}  // namespace

MendedSurface mend_surface(TriangleSurface surface, const MendOptions& options) {
  MendedSurface mended;
  auto& report = mended.report;
  refuse_not_finite(surface, options.name);
  drop_unused_points(surface);
  note(report, merge_points(surface), "points merged with another at the same place");
  note(report, drop_degenerate(surface), "degenerate or double triangles dropped");
  if (surface.triangles.empty()) throw InputError(options.name, "holds no triangles", "export the surface again");
  note(report, drop_fragments(surface), "small fragments dropped");
  drop_unused_points(surface);

  Complaints complaints(options.name, options.spots);
  complain_about_topology(surface, options, complaints);
  complaints.throw_any();
  std::int64_t turned = 0;
  complaints.add("edges where a one-sided surface cannot be turned", orient(surface, turned), "make it two-sided");
  complaints.throw_any();
  if (turned < std::ssize(surface.triangles)) note(report, turned, "triangles turned to the way of their neighbours");
  note(report, fill_small_holes(surface, options.smallest_opening), "small holes filled");
  turn_outward(surface, report);
  complain_about_crossings(surface, complaints);
  complaints.throw_any();

  mended.openings = std::ssize(boundary_loops(surface));
  mended.genus = genus(surface, mended.openings, options.parts);
  for (const auto& t : surface.triangles) mended.slivers += smallest_angle(surface, t) < M_PI / 180;
  report.push_back(fmt::format("{} triangles, {} openings, genus {}, {} slivers", surface.triangles.size(),
                               mended.openings, mended.genus, mended.slivers));
  mended.surface = std::move(surface);
  return mended;
}

void check_nesting(const TriangleSurface& lumen, const TriangleSurface& outer, double clearance,
                   const std::filesystem::path& spots) {
  Complaints complaints("lumen and outer surface", spots);
  auto both = lumen;
  append(both, outer);
  std::vector<Point> crossing, outside, near;
  const auto lumen_triangles = std::ssize(lumen.triangles);
  for (const auto& [s, t] : crossing_triangles(both))
    if (s < lumen_triangles && t >= lumen_triangles) crossing.push_back(centre(both, both.triangles[s]));
  const TriangleTree tree(closed(outer, boundary_loops(outer)));
  const TriangleTree open_tree(outer);
  std::vector<bool> at_rim(lumen.points.size(), false);
  for (const auto& loop : boundary_loops(lumen))
    for (const auto p : loop) at_rim[p] = true;
  for (std::size_t p = 0; p < lumen.points.size(); ++p) {
    const double distance = open_tree.nearest(lumen.points[p]).distance;
    if (!at_rim[p] && distance > clearance && !tree.contains(lumen.points[p])) {
      // Planes of rims differ a little: beyond the fan over an opening is still inside the vessel.
      const auto found = tree.nearest(lumen.points[p]);
      if (found.triangle < std::ssize(outer.triangles)) outside.push_back(lumen.points[p]);
    }
    if (distance <= clearance) near.push_back(lumen.points[p]);
  }
  const std::string remedy = "move the outer surface outward there, or grow the wall from the lumen surface";
  complaints.add("lumen triangles cross the outer surface", crossing, remedy);
  complaints.add("lumen points lie outside the outer surface", outside, remedy);
  complaints.add(fmt::format("lumen points are within {:.3g} mm of the outer surface", 1e3 * clearance), near, remedy);
  complaints.throw_any();
}

}  // namespace tunica::geometry
