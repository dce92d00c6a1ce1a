#include "tunica/meshing/conforming_surfaces.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tunica/base/error.hpp"
#include "tunica/geometry/self_intersections.hpp"
#include "tunica/geometry/size_field.hpp"

namespace tunica::meshing {

namespace {

/// Points of the original where its mesh has to be finer.
using Spots = std::vector<std::int64_t>;

std::int64_t nearest_corner(const geometry::TriangleTree& tree, const geometry::SurfacePoint& at) {
  const auto& t = tree.surface().triangles[at.triangle];
  return t[std::max_element(at.barycentric.x, at.barycentric.x + 3) - at.barycentric.x];
}

/// Measures both ways: middles of mesh edges and triangles to the original, points of the original to the mesh.
Spots far_places(Sheet& sheet, const Accuracy& accuracy) {
  const auto& original = sheet.original.tree.surface();
  const geometry::TriangleTree mesh(sheet.mesh.surface);
  sheet.distance = sheet.relative = 0;
  Spots spots;
  const auto judge = [&](double distance, double size, std::int64_t point) {
    sheet.distance = std::max(sheet.distance, distance);
    sheet.relative = std::max(sheet.relative, distance / size);
    if (distance > accuracy.absolute || distance > accuracy.per_edge * size) spots.push_back(point);
  };
  const auto measure = [&](const geometry::Point& x) {
    const auto at = sheet.original.tree.nearest(x);
    judge(at.distance, sheet.original.tree.interpolate(sheet.asked, at), nearest_corner(sheet.original.tree, at));
  };
  for (const auto& edge : geometry::edges(sheet.mesh.surface))
    measure(0.5 * (sheet.mesh.surface.points[edge.a] + sheet.mesh.surface.points[edge.b]));
  for (const auto& t : sheet.mesh.surface.triangles)
    measure((1.0 / 3) *
            (sheet.mesh.surface.points[t[0]] + sheet.mesh.surface.points[t[1]] + sheet.mesh.surface.points[t[2]]));
  for (std::int64_t p = 0; p < std::ssize(original.points); ++p)
    judge(mesh.nearest(original.points[p]).distance, sheet.asked[p], p);
  return spots;
}

/// Adds to `spots` of each sheet the places where its triangles cross others; returns how many pairs there are.
std::int64_t add_crossings(const std::vector<Sheet>& sheets, std::vector<Spots>& spots) {
  geometry::TriangleSurface all;
  std::vector<std::size_t> sheet_of;
  for (std::size_t s = 0; s < sheets.size(); ++s) {
    geometry::append(all, sheets[s].mesh.surface);
    sheet_of.resize(all.triangles.size(), s);
  }
  const auto pairs = geometry::crossing_triangles(all);
  for (const auto& pair : pairs)
    for (const auto t : {pair.first, pair.second})
      for (const auto corner : all.triangles[t]) {
        const auto& sheet = sheets[sheet_of[t]];
        spots[sheet_of[t]].push_back(
            nearest_corner(sheet.original.tree, sheet.original.tree.nearest(all.points[corner])));
      }
  return std::ssize(pairs);
}

/// Lowers the sizes at the spots and at the points next to them.
void refine(Sheet& sheet, Spots spots, double gradation) {
  constexpr double finer = 0.6;
  std::sort(spots.begin(), spots.end());
  spots.erase(std::unique(spots.begin(), spots.end()), spots.end());
  const auto& surface = sheet.original.tree.surface();
  std::vector<double> lowered = sheet.original.sizes;
  for (const auto& t : surface.triangles)
    for (int i = 0; i < 3; ++i)
      if (std::binary_search(spots.begin(), spots.end(), t[i]))
        for (const auto p : t) lowered[p] = std::min(lowered[p], finer * sheet.original.sizes[t[i]]);
  sheet.original.sizes = std::move(lowered);
  geometry::limit_gradation(surface, gradation, sheet.original.sizes);
}

double largest_distance(const std::vector<Sheet>& sheets) {
  double result = 0;
  for (const auto& sheet : sheets) result = std::max(result, sheet.distance);
  return result;
}

/// Of points that lie together, such as all that are measured at one spike, the first.
std::vector<geometry::Point> apart(const std::vector<geometry::Point>& points) {
  constexpr double together = 4e-3;  // m
  std::vector<geometry::Point> result;
  for (const auto& p : points)
    if (std::none_of(result.begin(), result.end(), [&](const auto& other) { return norm(p - other) < together; }))
      result.push_back(p);
  return result;
}

/// A few places beyond the bounds are no reason to have no mesh.
bool may_stay(const std::vector<Sheet>& sheets, const std::vector<geometry::Point>& far, std::int64_t crossings,
              const Accuracy& accuracy) {
  constexpr std::size_t measured_at_each = 20;
  const auto few = static_cast<std::size_t>(accuracy.few);
  return crossings == 0 && far.size() <= measured_at_each * few && apart(far).size() <= few &&
         largest_distance(sheets) <= accuracy.farthest;
}

/// Whether finer edges have not helped for two rounds: `counts` of places and crossings after each round.
bool stalls(const std::vector<std::int64_t>& counts) {
  constexpr double hardly_fewer = 0.85;
  const auto n = counts.size();
  return n >= 3 && static_cast<double>(counts[n - 1]) > hardly_fewer * static_cast<double>(counts[n - 3]);
}

[[noreturn]] void give_up(int round, std::int64_t far, std::int64_t crossings,
                          const std::vector<geometry::Point>& places) {
  throw SolverError(fmt::format(
      "after {} rounds of remeshing {} places are too far from the original surface and {} pairs of triangles "
      "cross, near {}: look there for walls or vessels that nearly touch, and part them or give a finer "
      "`size`",
      round, far, crossings, geometry::list_places_mm(places)));
}

}  // namespace

void remesh_together(std::vector<Sheet>& sheets, const Accuracy& accuracy, double gradation, const Log& log) {
  for (auto& sheet : sheets) {
    sheet.mesh = {sheet.original.tree.surface(), sheet.original.creases};
    sheet.asked = sheet.original.sizes;
  }
  std::vector<bool> due(sheets.size(), true);
  std::vector<std::int64_t> counts;
  int worse = 0;  // rounds in a row that left more places than the one before
  for (int round = 1;; ++round) {
    std::vector<Spots> spots(sheets.size());
    std::int64_t triangles = 0;
    for (std::size_t s = 0; s < sheets.size(); ++s) {
      geometry::RemeshOptions options;
      if (round > 1) options.sweeps = 4;
      if (due[s]) sheets[s].mesh = geometry::remesh(sheets[s].mesh, sheets[s].original, options);
      spots[s] = far_places(sheets[s], accuracy);
      triangles += std::ssize(sheets[s].mesh.surface.triangles);
    }
    std::int64_t far = 0;
    for (const auto& s : spots) far += std::ssize(s);
    const auto crossings = add_crossings(sheets, spots);
    log(fmt::format("remeshing, round {}: {} triangles, {} places too far from the original, {} crossings", round,
                    triangles, far, crossings));
    if (far + crossings == 0) return;
    std::vector<geometry::Point> places;
    for (std::size_t s = 0; s < sheets.size(); ++s)
      for (const auto p : spots[s]) places.push_back(sheets[s].original.tree.surface().points[p]);
    worse = !counts.empty() && far + crossings > counts.back() ? worse + 1 : 0;
    counts.push_back(far + crossings);
    const bool few = may_stay(sheets, places, crossings, accuracy), last = round == accuracy.rounds || worse == 2;
    if (last && !few) give_up(round, far, crossings, places);
    if (last || (few && stalls(counts))) {
      const auto spots_left = apart(places);
      log(fmt::format("warning: {} places stay up to {:.2f} mm from the original surface, near {}", spots_left.size(),
                      1e3 * largest_distance(sheets), geometry::list_places_mm(spots_left)));
      return;
    }
    for (std::size_t s = 0; s < sheets.size(); ++s) {
      due[s] = !spots[s].empty();
      if (due[s]) refine(sheets[s], spots[s], gradation);
    }
  }
}

}  // namespace tunica::meshing
