#include "tunica/geometry/openings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <set>
#include <sstream>

#include "tunica/base/error.hpp"
#include "tunica/mesh_io/extent.hpp"

namespace tunica::geometry {

namespace {

constexpr std::size_t longest_line = 10'000;  ///< bytes, of a table of openings
constexpr double planar_within = 0.2;         ///< of the radius of the opening

struct RimShape {
  Point centre;
  Vec3<double> area;  ///< out of the vessel
};

RimShape shape(const TriangleSurface& surface, const Loop& loop) {
  RimShape rim{{{0, 0, 0}}, {{0, 0, 0}}};
  double length = 0;
  const auto point = [&](std::size_t i) { return surface.points[loop[i % loop.size()]]; };
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const double l = norm(point(i + 1) - point(i));
    rim.centre = rim.centre + (0.5 * l) * (point(i) + point(i + 1));
    length += l;
  }
  rim.centre = (1 / length) * rim.centre;
  // The loop follows the triangles beside it, and so runs clockwise around the outward normal.
  for (std::size_t i = 0; i < loop.size(); ++i)
    rim.area = rim.area - 0.5 * cross(point(i) - rim.centre, point(i + 1) - rim.centre);
  return rim;
}

std::string in_mm(const Point& p) { return list_places_mm(std::vector<Point>{p}); }

double largest_distance(const TriangleSurface& surface, const Loop& loop, const Point& origin, const Vec3<double>& n) {
  double largest = 0;
  for (const auto p : loop) largest = std::max(largest, std::abs(dot(surface.points[p] - origin, n)));
  return largest;
}

/// Winding number of the projected loop around x is not zero.
bool surrounds(const TriangleSurface& surface, const Loop& loop, const Point& x, const Vec3<double>& n) {
  double turn = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    auto a = surface.points[loop[i]] - x, b = surface.points[loop[(i + 1) % loop.size()]] - x;
    a = a - dot(a, n) * n;
    b = b - dot(b, n) * n;
    turn += std::atan2(dot(cross(a, b), n), dot(a, b));
  }
  return std::abs(turn) > M_PI;
}

void add_wall_rims(const TriangleSurface& lumen, const TriangleSurface& outer, std::vector<Opening>& openings,
                   std::vector<Problem>& problems) {
  std::vector<bool> taken(openings.size(), false);
  for (const auto& loop : boundary_loops(outer)) {
    const auto rim = shape(outer, loop);
    const auto nearest = std::min_element(openings.begin(), openings.end(), [&](const Opening& a, const Opening& b) {
      return norm(a.centre - rim.centre) < norm(b.centre - rim.centre);
    });
    const double radius = std::sqrt(norm(rim.area) / M_PI);
    if (nearest == openings.end() || norm(nearest->centre - rim.centre) > radius || taken[nearest - openings.begin()]) {
      problems.push_back({"outer surface", fmt::format("the rim at {} has no lumen rim inside it", in_mm(rim.centre)),
                          "cut lumen and outer surface at the same places, or close this hole"});
      continue;
    }
    taken[nearest - openings.begin()] = true;
    nearest->wall = loop;
    nearest->normal = nearest->area * nearest->normal + rim.area;
    nearest->normal = (1 / norm(nearest->normal)) * nearest->normal;
    // Weighted by length, the plane lies between both rims.
    nearest->centre = nearest->centre + (0.5 * dot(rim.centre - nearest->centre, nearest->normal)) * nearest->normal;
  }
  for (std::size_t i = 0; i < openings.size(); ++i) {
    const auto& opening = openings[i];
    if (!taken[i]) {
      problems.push_back({"lumen surface",
                          fmt::format("the rim at {} has no rim of the outer surface around it", in_mm(opening.centre)),
                          "cut lumen and outer surface at the same places, or close this hole"});
      continue;
    }
    for (const auto p : opening.lumen)
      if (!surrounds(outer, opening.wall, lumen.points[p], opening.normal)) {
        problems.push_back(
            {"lumen surface",
             fmt::format("the rim reaches beyond the rim of the outer surface at {}", in_mm(lumen.points[p])),
             "make the wall thicker there, or cut the vessel elsewhere"});
        break;
      }
  }
}

/// A unit that is wrong by a factor of ten leaves a size that is still possible, but no aorta is that narrow or wide.
void refuse_unlikely_diameter(const TriangleSurface& lumen, const std::vector<Opening>& openings) {
  constexpr double narrowest = 4e-3, widest = 150e-3;  // m
  double area = 0;
  for (const auto& opening : openings) area = std::max(area, opening.area);
  const double diameter = 2 * std::sqrt(area / M_PI);
  if (diameter >= narrowest && diameter <= widest) return;
  throw InputError(
      "lumen surface",
      fmt::format("its largest opening is {:.3g} mm wide, and its size is {}; an aorta is {:g} to {:g} mm wide",
                  1e3 * diameter, mesh_io::size_text(lumen.points), 1e3 * narrowest, 1e3 * widest),
      "correct length_unit, or the coordinates in the file");
}

void give_names(std::vector<Opening>& openings, const std::vector<NamedPlace>& names, std::vector<Problem>& problems) {
  std::sort(openings.begin(), openings.end(), [](const Opening& a, const Opening& b) { return a.area > b.area; });
  if (names.empty()) {
    for (std::size_t i = 0; i < openings.size(); ++i) openings[i].name = i == 0 ? "inlet" : fmt::format("outlet_{}", i);
    return;
  }
  std::vector<Opening> sorted;
  for (const auto& [name, place] : names) {
    const auto found = std::min_element(
        openings.begin(), openings.end(),
        [&, at = place](const Opening& a, const Opening& b) { return norm(a.centre - at) < norm(b.centre - at); });
    if (found == openings.end() || norm(found->centre - place) > 2 * std::sqrt(found->area / M_PI) ||
        !found->name.empty()) {
      problems.push_back({"opening " + name,
                          fmt::format("there is no opening of its own within two radii of {}", in_mm(place)),
                          "correct its centre, or leave it out"});
      continue;
    }
    found->name = name;
  }
  for (const auto& opening : openings)
    if (opening.name.empty())
      problems.push_back({"lumen surface", fmt::format("the opening at {} has no name", in_mm(opening.centre)),
                          "name every vessel end, or close the hole"});
  for (const auto& [name, place] : names)
    for (const auto& opening : openings)
      if (opening.name == name) sorted.push_back(opening);
  openings = sorted;
}

}  // namespace

bool lies_in(const Opening& opening, const Point& x) {
  const auto d = x - opening.centre;
  return std::abs(dot(d, opening.normal)) < 1e-3 * opening.reach && norm(d) < 1.1 * opening.reach;
}

std::vector<NamedPlace> read_opening_names(const std::filesystem::path& path, double metres_per_unit) {
  const std::string remedy = "write a table with the columns name, centre_x, centre_y, centre_z";
  std::ifstream file(path);
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored) || !file)
    throw InputError(path.string(), "cannot be read", "check the path");
  const auto cells = [](const std::string& line) {
    std::vector<std::string> result;
    std::istringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) {
      while (!cell.empty() && std::isspace(static_cast<unsigned char>(cell.back()))) cell.pop_back();
      result.push_back(cell);
    }
    return result;
  };
  std::vector<NamedPlace> names;
  std::vector<std::string> header;
  std::set<std::string> seen;
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    if (line.size() > longest_line || line.find('\0') != std::string::npos)
      throw InputError(fmt::format("{}, line {}", path.string(), number), "is no line of a table", remedy);
    if (line.find_first_not_of(" \t\r") == std::string::npos || line[0] == '#') continue;
    if (header.empty()) {
      header = cells(line);
      continue;
    }
    const auto row = cells(line);
    const auto value = [&](const std::string& column) {
      const auto at = std::find(header.begin(), header.end(), column) - header.begin();
      if (at == std::ssize(header)) throw InputError(path.string(), "has no column " + column, remedy);
      return at < std::ssize(row) ? row[at] : std::string();
    };
    NamedPlace named{value("name"), {}};
    for (int d = 0; d < 3; ++d) {
      const std::string text = value(std::string("centre_") + "xyz"[d]);
      double x = 0;
      const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
      if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(x))
        throw InputError(fmt::format("{}, line {}", path.string(), number), "'" + text + "' is no number", remedy);
      named.place[d] = metres_per_unit * x;
    }
    if (named.name.empty() || !seen.insert(named.name).second)
      throw InputError(fmt::format("{}, line {}", path.string(), number),
                       fmt::format("the name '{}' is empty or there already", named.name),
                       "give each opening a name of its own");
    names.push_back(std::move(named));
  }
  if (names.empty()) throw InputError(path.string(), "names no opening", remedy);
  return names;
}

std::vector<Opening> find_openings(const TriangleSurface& lumen, const TriangleSurface* outer,
                                   const std::vector<NamedPlace>& names) {
  std::vector<Opening> openings;
  std::vector<Problem> problems;
  for (const auto& loop : boundary_loops(lumen)) {
    const auto rim = shape(lumen, loop);
    const double size = norm(rim.area);
    openings.push_back({"", rim.centre, (1 / size) * rim.area, size, 0, loop, {}, 0});
  }
  if (openings.empty())
    throw InputError("lumen surface", fmt::format("has no openings; its size is {}", mesh_io::size_text(lumen.points)),
                     "cut it open at the inlet and the outlets, or correct length_unit when that is not its size");
  refuse_unlikely_diameter(lumen, openings);
  if (outer) add_wall_rims(lumen, *outer, openings, problems);
  for (auto& opening : openings) {
    opening.out_of_plane = largest_distance(lumen, opening.lumen, opening.centre, opening.normal);
    if (outer)
      opening.out_of_plane =
          std::max(opening.out_of_plane, largest_distance(*outer, opening.wall, opening.centre, opening.normal));
    for (const auto p : opening.lumen) opening.reach = std::max(opening.reach, norm(lumen.points[p] - opening.centre));
    for (const auto p : opening.wall) opening.reach = std::max(opening.reach, norm(outer->points[p] - opening.centre));
    if (const double radius = std::sqrt(opening.area / M_PI); opening.out_of_plane > planar_within * radius)
      problems.push_back(
          {"opening at " + in_mm(opening.centre),
           fmt::format("its rims leave their common plane by {:.2f} mm, allowed is a fifth of its radius of {:.2f} mm",
                       1e3 * opening.out_of_plane, 1e3 * radius),
           "cut lumen and outer surface by the same plane, or close the hole"});
  }
  give_names(openings, names, problems);
  if (!problems.empty()) throw InputError(std::move(problems));
  return openings;
}

void flatten_rims(TriangleSurface& surface, const std::vector<Opening>& openings, Loop Opening::*rim) {
  for (const auto& opening : openings) {
    const auto& loop = opening.*rim;
    double largest = 0;
    for (const auto p : loop)
      largest = std::max(largest, std::abs(dot(surface.points[p] - opening.centre, opening.normal)));
    if (largest == 0) continue;
    // The motion fades over this distance; six times the motion bends triangles by 15 degrees at most.
    const double reach = 6 * largest;
    std::vector<Point> rim_points;
    for (const auto p : loop) rim_points.push_back(surface.points[p]);
    for (auto& x : surface.points) {
      if (std::abs(dot(x - opening.centre, opening.normal)) > reach + largest) continue;
      double nearest = reach, height = 0;
      for (const auto& r : rim_points)
        if (const double distance = norm(x - r); distance < nearest) {
          nearest = distance;
          height = dot(r - opening.centre, opening.normal);
        }
      const double s = 1 - nearest / reach;
      x = x - (height * s * s * (3 - 2 * s)) * opening.normal;
    }
  }
}

}  // namespace tunica::geometry
