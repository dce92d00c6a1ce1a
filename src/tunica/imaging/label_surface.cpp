#include "tunica/imaging/label_surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "tunica/base/error.hpp"
#include "tunica/imaging/smooth_field.hpp"
#include "tunica/imaging/surface_smoothing.hpp"
#include "tunica/mesh/names.hpp"

namespace tunica::imaging {

namespace {

using geometry::TriangleSurface;

constexpr int sweeps = 80;
constexpr double continued = 6;  // voxels beyond an end

std::string in_mm(const Point& p) {
  return fmt::format("({:.1f}, {:.1f}, {:.1f}) mm", 1e3 * p[0], 1e3 * p[1], 1e3 * p[2]);
}

std::int64_t margin_for(const ImageFrame& frame) {
  const double smallest = std::min({norm(frame.steps[0]), norm(frame.steps[1]), norm(frame.steps[2])});
  return 4 + static_cast<std::int64_t>(std::ceil((continued + 2) * frame.largest_spacing() / smallest));
}

VesselEnd given_end(const std::string& name, const ImageOpening& opening, const SmoothField& field,
                    const std::vector<VesselEnd>& found, std::vector<Problem>& problems) {
  const std::string where = "opening " + name;
  if (opening.normal) {
    const auto normal = (1 / norm(*opening.normal)) * *opening.normal;
    if (const auto end = end_at(field, opening.centre, normal)) return *end;
    problems.push_back({where, "there is no cross-section of a vessel about " + in_mm(opening.centre),
                        "give a centre inside the vessel and a normal along it"});
    return {};
  }
  const VesselEnd* nearest = nullptr;
  for (const auto& end : found)
    if (norm(end.centre - opening.centre) < 2 * end.radius &&
        (!nearest || norm(end.centre - opening.centre) < norm(nearest->centre - opening.centre)))
      nearest = &end;
  if (nearest) return *nearest;
  std::string list;
  for (const auto& end : found) list += (list.empty() ? "" : ", ") + in_mm(end.centre);
  problems.push_back({where,
                      fmt::format("no vessel ends in a flat face within two radii of {}; flat faces are at {}",
                                  in_mm(opening.centre), list.empty() ? "no place" : list),
                      "correct the centre, or give a normal: the vessel is then cut there"});
  return {};
}

std::vector<VesselEnd> choose_ends(const LumenMask& mask, const SmoothField& field, const SurfaceSettings& settings,
                                   const Log& log) {
  const auto& openings = settings.openings;
  std::vector<VesselEnd> found;
  if (openings.empty() || std::any_of(openings.begin(), openings.end(), [](const auto& o) { return !o.second.normal; }))
    found = find_ends(mask, field);
  if (openings.empty()) {
    if (found.empty())
      throw InputError("image", "no vessel ends in a flat face", "give `openings` with centres and normals");
    return found;
  }
  std::vector<Problem> problems;
  std::vector<VesselEnd> ends;
  for (const auto& [name, opening] : openings) ends.push_back(given_end(name, opening, field, found, problems));
  for (std::size_t i = 0; problems.empty() && i < ends.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (norm(ends[i].centre - ends[j].centre) < 0.5 * std::max(ends[i].radius, ends[j].radius))
        problems.push_back({"opening " + openings[i].first, "is at the same end as " + openings[j].first,
                            "correct one of the centres"});
  if (!problems.empty()) throw InputError(std::move(problems));
  for (const auto& end : found)
    if (std::none_of(ends.begin(), ends.end(), [&](const auto& e) { return norm(e.centre - end.centre) < e.radius; }))
      log(fmt::format("the vessel end at {} stays closed: no opening names it", in_mm(end.centre)));
  return ends;
}

/// Where an image ends, vessels are to be cut.
void check_border(const LumenMask& mask, const std::vector<VesselEnd>& ends) {
  const double voxel = mask.frame.largest_spacing();
  std::vector<Point> places;
  for (std::int64_t i = 0; i < std::ssize(mask.kinds); ++i) {
    if (!mask.is_lumen(i) || !mask.at_image_border(i)) continue;
    const Point p = mask.frame.place(mask.frame.voxel(i));
    const bool cut = std::any_of(ends.begin(), ends.end(), [&](const VesselEnd& end) {
      const double height = dot(p - end.centre, end.normal);
      return height > -3 * voxel && norm(p - end.centre - height * end.normal) < end.radius + 4 * voxel;
    });
    if (!cut) places.push_back(p);
  }
  if (places.size() > 9)
    throw InputError(
        "image",
        "the lumen runs out of the image, and no vessel end was found there: " + geometry::list_places_mm(places),
        "give an opening with centre and normal there, which cuts the vessel off inside the image");
}

void check_inlet(const LumenMask& mask, const VesselEnd& inlet) {
  std::int64_t true_lumen = 0, all = 0;
  const double voxel = mask.frame.largest_spacing();
  for (std::int64_t i = 0; i < std::ssize(mask.kinds); ++i) {
    if (!mask.is_lumen(i)) continue;
    const auto way = mask.frame.place(mask.frame.voxel(i)) - inlet.centre;
    const double height = dot(way, inlet.normal);
    if (height > 0 || height < -2 * voxel || norm(way - height * inlet.normal) > inlet.radius) continue;
    ++all;
    true_lumen += mask.kinds[i] == Kind::true_lumen;
  }
  if (true_lumen == 0 || all == 0)
    throw InputError("inlet at " + in_mm(inlet.centre), "there is no true lumen",
                     "exchange the labels of the lumens, or name another opening as `inlet`");
}

const VesselEnd& inlet_of(const std::vector<VesselEnd>& ends, const SurfaceSettings& settings) {
  if (settings.openings.empty())
    return *std::max_element(ends.begin(), ends.end(),
                             [](const auto& a, const auto& b) { return a.radius < b.radius; });
  for (std::size_t i = 0; i < ends.size(); ++i)
    if (settings.openings[i].first == settings.inlet) return ends[i];
  return ends.front();
}

TriangleSurface largest_part(const TriangleSurface& surface) {
  const auto part = geometry::components(surface);
  std::map<std::int64_t, std::int64_t> counts;
  for (const auto p : part) ++counts[p];
  const auto most =
      std::max_element(counts.begin(), counts.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  TriangleSurface result{surface.points, {}};
  for (std::size_t t = 0; t < part.size(); ++t)
    if (part[t] == most->first) result.triangles.push_back(surface.triangles[t]);
  geometry::drop_unused_points(result);
  return result;
}

TriangleSurface cut_open(TriangleSurface surface, const std::vector<VesselEnd>& ends, double voxel) {
  for (auto end : ends) {
    end.radius += 4 * voxel;
    surface = geometry::cut_end(surface, end);
  }
  surface = largest_part(surface);
  const auto loops = geometry::boundary_loops(surface).size();
  if (loops != ends.size())
    throw SolverError(fmt::format(
        "the lumen of the image is open at {} places after {} vessel ends were cut: planes of ends meet, or a vessel "
        "hangs on the rest only beyond one of them; move the openings",
        loops, ends.size()));
  return surface;
}

void log_shape(const LabelSurface& result, bool dissected, const Log& log) {
  for (const auto& end : result.ends)
    log(fmt::format("vessel end at {}, normal ({:.3f}, {:.3f}, {:.3f}), radius up to {:.1f} mm", in_mm(end.centre),
                    end.normal[0], end.normal[1], end.normal[2], 1e3 * end.radius));
  for (const auto& tear : result.tears)
    log(fmt::format("tear of {:.0f} mm^2 at {}: there true and false lumen touch", 1e6 * tear.area,
                    in_mm(tear.centre)));
  const auto genus = geometry::genus(result.lumen, std::ssize(result.ends));
  log(fmt::format("lumen surface: {} triangles, {} openings, genus {}", result.lumen.triangles.size(),
                  result.ends.size(), genus));
  if (const auto expected = std::max<std::int64_t>(0, std::ssize(result.tears) - 1); dissected && genus != expected)
    log(fmt::format(
        "warning: {} tears make a surface of genus {}, this one has {}. The flap has holes that the labels do "
        "not have, a tear was closed, or vessels touch: look at the mesh, and correct the labels or give "
        "another `smoothing`",
        result.tears.size(), expected, genus));
}

}  // namespace

config::Schema<ImageOpening> ImageOpening::schema() {
  using namespace config;
  return Schema<ImageOpening>("opening", "A vessel end.")
      .quantities("centre", &ImageOpening::centre, dimension::length, anything(),
                  "In patient axes: x to the left, y to the back, z to the head")
      .quantities("normal", &ImageOpening::normal, dimension::none, anything(),
                  "Out of the vessel. With it the vessel is cut there; without, the flat face nearest to the centre is "
                  "the opening")
      .check([](const ImageOpening& o, Problems& problems) {
        if (o.normal && !(norm(*o.normal) > 0)) problems.add("normal", "is zero", "give a direction");
      });
}

void SurfaceSettings::add_to(config::Schema<SurfaceSettings>& schema) {
  using S = SurfaceSettings;
  using namespace config;
  schema
      .integer(
          "true_lumen", [](S& s) -> int& { return s.labels.true_lumen; }, range(-32768, 32767),
          "Label of the true lumen and all vessels that are not dissected")
      .by_default()
      .integer(
          "false_lumen", [](S& s) -> std::optional<int>& { return s.labels.false_lumen; }, range(-32768, 32767),
          "Label of the false lumen; there is none when left out")
      .number("smoothing", &S::smoothing, range(0.5, 2),
              "Standard deviation of the filter on the labels, in voxels: more closes gaps that are thinner")
      .by_default()
      .map("openings", &S::openings, ImageOpening::schema(),
           "Vessel ends by name. When left out, all flat ends are opened and called inlet (the widest), outlet_1, ...")
      .by_default()
      .text("inlet", &S::inlet, "Name of the inlet; when left out, the first of the openings")
      .optional()
      .check([](const S& s, Problems& problems) {
        const auto named = [&](const auto& o) { return o.first == s.inlet; };
        if (!s.inlet.empty() && std::none_of(s.openings.begin(), s.openings.end(), named))
          problems.add("inlet", "no opening is called '" + s.inlet + "'", "name the vessel ends in `openings`");
        std::vector<mesh::PlacedName> names;
        for (const auto& [name, opening] : s.openings) names.push_back({name, "openings." + name});
        for (auto& problem : mesh::check_opening_names(names)) problems.errors.push_back(std::move(problem));
      });
}

LabelSurface surface_of(const LabelImage& image, const SurfaceSettings& settings, const Log& log) {
  auto mask = lumen_mask(image, settings.labels, margin_for(image.frame), log);
  const double voxel = mask.frame.largest_spacing();
  LabelSurface result;
  result.tears = find_contacts(mask, 4 * voxel * voxel);
  result.ends = choose_ends(mask, smooth_field(mask, settings.smoothing), settings, log);
  check_border(mask, result.ends);
  check_inlet(mask, inlet_of(result.ends, settings));
  for (const auto& end : result.ends) continue_beyond(end, continued * voxel, mask);
  auto surface = largest_part(boundary(smooth_field(mask, settings.smoothing)));
  smooth_surface(surface, sweeps);
  result.lumen = cut_open(std::move(surface), result.ends, voxel);
  log_shape(result, settings.labels.false_lumen.has_value(), log);
  return result;
}

}  // namespace tunica::imaging
