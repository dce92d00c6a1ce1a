#include "tunica/imaging/label_surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "tunica/base/error.hpp"
#include "tunica/imaging/chosen_ends.hpp"
#include "tunica/imaging/lumen_topology.hpp"
#include "tunica/imaging/resampling.hpp"
#include "tunica/imaging/smooth_field.hpp"
#include "tunica/imaging/surface_smoothing.hpp"
#include "tunica/imaging/tear_size.hpp"
#include "tunica/mesh/names.hpp"

namespace tunica::imaging {

namespace {

using geometry::TriangleSurface;

constexpr int smoothing_sweeps = 80;
constexpr double roughest = 0.15;      // voxels of noise that a surface may have
constexpr double thinnest_wall = 0.4;  // voxels; smoothing leaves no less of a flap
constexpr double farthest_way = 3;     // of the noise; what is farther off is shape
constexpr double continued = 6;        // voxels beyond an end
constexpr double thinnest_flap = 1.3;  // voxels; thinner sheets fall between the samples of the field

double smallest_spacing(const ImageFrame& frame) {
  return std::min({norm(frame.steps[0]), norm(frame.steps[1]), norm(frame.steps[2])});
}

/// In voxels of the shortest side; longer ones will be divided.
std::int64_t margin_for(const ImageFrame& frame) {
  const double smallest = smallest_spacing(frame), largest = std::min(frame.largest_spacing(), 4.0 / 3 * smallest);
  return 4 + static_cast<std::int64_t>(std::ceil((continued + 2) * largest / smallest));
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

/// The largest parts, as many as asked for.
TriangleSurface largest_parts(const TriangleSurface& surface, int count) {
  const auto part = geometry::components(surface);
  std::map<std::int64_t, std::int64_t> counts;
  for (const auto p : part) ++counts[p];
  std::vector<std::pair<std::int64_t, std::int64_t>> order;
  for (const auto& [p, triangles] : counts) order.emplace_back(triangles, p);
  std::sort(order.rbegin(), order.rend());
  if (std::ssize(order) > count) order.resize(static_cast<std::size_t>(count));
  TriangleSurface result{surface.points, {}};
  for (std::size_t t = 0; t < part.size(); ++t)
    if (std::any_of(order.begin(), order.end(), [&](const auto& o) { return o.second == part[t]; }))
      result.triangles.push_back(surface.triangles[t]);
  geometry::drop_unused_points(result);
  return result;
}

/// Takes what is left of the voxels, and what is noise of the labels. Triangles may cross afterwards.
void take_noise(TriangleSurface& surface, double voxel, const Log& log) {
  smooth_surface(surface, smoothing_sweeps);
  const double rough = roughness(surface);
  log(fmt::format("roughness of the surface: {:.2f} voxels", rough / voxel));
  if (rough <= roughest * voxel) return;
  smooth_rough_surface(surface, farthest_way * rough);
  log(fmt::format("the labels are rough: noise of {:.2f} mm is taken from the surface, which then has {:.2f} mm",
                  1e3 * rough, 1e3 * roughness(surface)));
}

/// Where triangles cross, points go back towards those of the `contour`.
void keep_apart(TriangleSurface& surface, const std::vector<Point>& contour, double voxel, const Log& log) {
  if (const auto moved = untangle(surface, contour, thinnest_wall * voxel); moved > 0)
    log(fmt::format("{} points are kept where the labels have them, since triangles would cross", moved));
}

TriangleSurface cut_open(TriangleSurface surface, const std::vector<VesselEnd>& ends, double voxel, int parts) {
  for (auto end : ends) {
    end.radius += 4 * voxel;
    surface = geometry::cut_end(surface, end);
  }
  surface = largest_parts(surface, parts);
  const auto loops = geometry::boundary_loops(surface).size();
  if (loops != ends.size())
    throw SolverError(fmt::format(
        "the lumen of the image is open at {} places after {} vessel ends were cut: planes of ends meet, or a vessel "
        "hangs on the rest only beyond one of them; move the openings",
        loops, ends.size()));
  return surface;
}

void log_shape(const LabelSurface& result, const Log& log) {
  for (const auto& end : result.ends)
    log(fmt::format("vessel end at {}, normal ({:.3f}, {:.3f}, {:.3f}), radius up to {:.1f} mm", in_mm(end.centre),
                    end.normal[0], end.normal[1], end.normal[2], 1e3 * end.radius));
}

/// Every tear beyond the first makes a handle, and nothing else does.
void check_genus(const LabelSurface& result, std::int64_t expected, const Log& log) {
  const auto genus = geometry::genus(result.lumen, std::ssize(result.ends), result.parts);
  log(fmt::format("lumen surface: {} triangles, {} openings, genus {}", result.lumen.triangles.size(),
                  result.ends.size(), genus));
  if (genus == expected) return;
  std::string places;
  for (const auto& tear : result.tears) places += (places.empty() ? "" : ", ") + in_mm(tear.centre);
  throw SolverError(
      fmt::format("the lumen surface has genus {}, expected is {} ({} tears{}). The flap has holes that the labels do "
                  "not have, or a tear was closed: correct the labels there, give another `smoothing` or "
                  "`smallest_tear`, or say `genus: {}` if the surface is right",
                  genus, expected, result.tears.size(), places.empty() ? "" : " at " + places, genus));
}

/// What is left of a vessel behind the tissue with which its continuation ends.
void drop_beyond_ends(LumenMask& mask) {
  for (const auto kind : {Kind::true_lumen, Kind::false_lumen}) {
    auto set = voxels_of(mask.kinds, kind);
    keep_largest_part(mask.frame, set);
    for (std::size_t i = 0; i < set.size(); ++i)
      if (mask.kinds[i] == kind && !set[i]) mask.kinds[i] = Kind::tissue;
  }
}

/// Whether the lumen nearest to each point of the surface is of a kind.
std::vector<std::uint8_t> points_at(Kind kind, const LumenMask& mask, const TriangleSurface& surface) {
  const double reach = 3 * mask.frame.largest_spacing();
  std::vector<std::uint8_t> result;
  for (const auto& p : surface.points) {
    double nearest = 1;
    bool found = false;
    for_each_voxel_near(mask.frame, p, reach, [&](std::int64_t i) {
      const double distance = norm(mask.frame.place(mask.frame.voxel(i)) - p);
      if (!mask.is_lumen(i) || distance >= nearest) return;
      nearest = distance;
      found = mask.kinds[i] == kind;
    });
    result.push_back(found);
  }
  return result;
}

/// Standard deviation of the filter [m].
double filter_width(const ImageFrame& frame, const SurfaceSettings& settings) {
  const double side = smallest_spacing(frame);
  if (!settings.smoothing_length) return settings.smoothing * side;
  const double length = *settings.smoothing_length;
  if (length < 0.5 * side || length > 2 * side)
    throw InputError("smoothing_length",
                     fmt::format("is {:.2f} mm, with voxels of {:.2f} mm", 1e3 * length, 1e3 * side),
                     fmt::format("give {:.2f} to {:.2f} mm", 0.5e3 * side, 2e3 * side));
  return length;
}

/// The surface of lumen and thrombus together, cut where the lumen is.
TriangleSurface around_thrombus(const LabelImage& image, const SurfaceSettings& settings,
                                const std::vector<VesselEnd>& ends, const Log& log) {
  auto joined = image;
  const int blood = settings.labels.true_lumen;
  for (auto& label : joined.labels) {
    const bool within = label == blood || label == settings.labels.thrombus || label == settings.labels.false_lumen;
    label = static_cast<std::int16_t>(within ? blood : 0);
  }
  // The labels were checked with the lumen. What is not whole here is a clot apart from the vessel, or a flap, which
  // looks like missing slices between lumens that are one.
  const Repairs repairs{{true, true, false}};
  const auto silent = [](const std::string&) {};
  const auto say = [&](const std::string& line) { log("lumen and thrombus: " + line); };
  auto mask = with_even_voxels(lumen_mask(joined, {blood, std::nullopt}, margin_for(image.frame), silent, repairs));
  const double voxel = mask.frame.largest_spacing();
  for (const auto& end : ends) continue_beyond(end, continued * voxel, mask);
  drop_beyond_ends(mask);
  auto surface = largest_parts(
      boundary(smooth_field(mask, filter_width(image.frame, settings) / smallest_spacing(mask.frame))), 1);
  const auto contour = surface.points;
  take_noise(surface, voxel, say);
  keep_apart(surface, contour, voxel, say);
  return cut_open(std::move(surface), ends, voxel, 1);
}

/// None where both lumens have one label.
std::optional<FlapSides> sides_of(const LumenMask& mask, const SurfaceSettings& settings,
                                  const std::vector<Contact>& tears) {
  if (!settings.labels.false_lumen) return {};
  std::vector<std::int64_t> open;
  for (const auto& tear : tears) open.insert(open.end(), tear.voxels.begin(), tear.voxels.end());
  return flap_sides(mask, open);
}

/// The smooth field, with the topology of the labels. `sides`: none where both lumens have one label.
SmoothField lumen_field(const LumenMask& mask, const SurfaceSettings& settings, double sigma,
                        const std::optional<FlapSides>& sides, const std::vector<Contact>& tears, std::int64_t rings,
                        const Log& log) {
  auto field = smooth_field(mask, sigma);
  if (sides) {
    const double voxel = mask.frame.largest_spacing();
    const double gap = std::max(settings.flap.insert.value_or(0), thinnest_flap * voxel);
    // Of 2 G - G * G across a plane.
    const double slope = (2 - std::sqrt(0.5)) / std::sqrt(2 * M_PI) / (sigma * voxel);
    hold_apart(*sides, gap, slope, mask.frame, field);
  }
  settle(sides ? &*sides : nullptr, tears, rings, field, log);
  return field;
}

/// The areas that the labels have: in voxels that were divided the edges of a thin flap have drawn back.
void take_areas(const std::vector<Contact>& contacts, std::vector<Contact>& tears) {
  for (auto& tear : tears) {
    const double radius = std::sqrt(tear.area / M_PI);
    double sum = 0;
    for (const auto& contact : contacts)
      if (norm(contact.centre - tear.centre) < radius) sum += contact.area;
    if (sum > 0) tear.area = sum;
  }
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
      .quantities(
          "tissue", [](S& s) -> std::vector<double>& { return s.labels.tissue; }, dimension::none, range(-32768, 32767),
          "Labels of what is no flowing blood: thrombus, wall, other organs. It becomes wall where the wall grows "
          "there, and lies outside the mesh elsewhere")
      .by_default("[]")
      .integer(
          "thrombus", [](S& s) -> std::optional<int>& { return s.labels.thrombus; }, range(-32768, 32767),
          "Label of clotted blood in the vessel: it becomes wall, and the wall that is grown goes around it")
      .optional()
      .number("smoothing", &S::smoothing, range(0.5, 2),
              "Standard deviation of the filter on the labels, in voxels: more closes gaps that are thinner")
      .by_default()
      .quantity("smoothing_length", &S::smoothing_length, dimension::length, range(0.1e-3, 4e-3),
                "The same as a length, in place of `smoothing`; 0.5 to 2 times the shortest side of a voxel")
      .optional()
      .map("openings", &S::openings, ImageOpening::schema(),
           "Vessel ends by name. When left out, all ends are opened and called inlet (the widest), outlet_1, ...")
      .by_default()
      .text("inlet", &S::inlet, "Name of the inlet; when left out, the first of the openings")
      .optional()
      .section("flap", &S::flap, FlapSettings::schema(), "A flap for labels that have none")
      .by_default()
      .quantity(
          "smallest_tear", [](S& s) -> std::optional<double>& { return s.tears.smallest; }, dimension::area,
          range(0, 1e-3),
          "Smaller contacts of true and false lumen are closed, and listed. When left out, 10 mm^2; where five are "
          "smaller, so that the labels are rough, larger ones are closed too, up to 60 mm^2, but where one stands "
          "apart from what noise opens")
      .number(
          "most_open", [](S& s) -> double& { return s.tears.most_open; }, range(0, 1),
          "Share of the surface between the lumens that tears may take; with more, the labels have no flap")
      .by_default()
      .any_of(
          "repair", [](S& s) -> std::array<bool, 3>& { return s.repairs.asked; }, {"slices", "pieces", "bridges"},
          "Faults of the segmentation that are mended and not refused: missing slices are interpolated, separate "
          "pieces above 1 ml dropped, bridges between vessels cut")
      .by_default()
      .integer("genus", &S::genus, range(0, 100),
               "Handles of the lumen surface; when left out, one less than there are tears")
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
  const bool dissected = settings.labels.false_lumen.has_value();
  LabelSurface result;
  result.parts = settings.flap.insert && settings.flap.tears.empty() ? 2 : 1;
  const double filter = filter_width(image.frame, settings);
  auto mask = lumen_mask(image, settings.labels, margin_for(image.frame), log, settings.repairs, result.parts == 2);
  const auto contacts = dissected ? find_contacts(mask, 0) : std::vector<Contact>();
  mask = with_even_voxels(std::move(mask));
  const double voxel = mask.frame.largest_spacing();
  if (voxel < 0.99 * image.frame.largest_spacing())
    log(fmt::format("voxels of {:.2f} mm by shape-based interpolation", 1e3 * voxel));
  const double sigma = filter / smallest_spacing(mask.frame);
  if (dissected) result.tears = find_tears(mask, settings.flap, settings.tears, log);
  if (!settings.flap.insert) take_areas(contacts, result.tears);
  const auto rings = open_rings(mask, settings, log);
  result.ends = choose_ends(mask, smooth_field(mask, sigma), settings, log);
  check_border(mask, result.ends);
  check_inlet(mask, inlet_of(result.ends, settings));
  for (const auto& end : result.ends) continue_beyond(end, continued * voxel, mask);
  drop_beyond_ends(mask);
  const auto sides = sides_of(mask, settings, result.tears);
  auto surface =
      largest_parts(boundary(lumen_field(mask, settings, sigma, sides, result.tears, rings, log)), result.parts);
  auto contour = surface.points;
  take_noise(surface, voxel, log);
  if (!result.tears.empty()) result.tear_areas = narrow_tears(*sides, result.tears, surface, contour, log);
  keep_apart(surface, contour, voxel, log);
  result.lumen = cut_open(std::move(surface), result.ends, voxel, result.parts);
  result.of_false_lumen = points_at(Kind::false_lumen, mask, result.lumen);
  log_shape(result, log);
  const auto tears = std::ssize(result.tears);
  check_genus(result, settings.genus ? *settings.genus : std::max<std::int64_t>(0, tears - 1) + rings, log);
  if (settings.labels.thrombus) result.with_thrombus = around_thrombus(image, settings, result.ends, log);
  return result;
}

}  // namespace tunica::imaging
