#include "tunica/imaging/chosen_ends.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tunica/base/error.hpp"

namespace tunica::imaging {

namespace {

constexpr double wider_than_inlet = 1.1;

/// As an opening of the case file.
std::string as_opening(const VesselEnd& end) {
  return fmt::format("{{centre: [{:.2f} mm, {:.2f} mm, {:.2f} mm], normal: [{:.3f}, {:.3f}, {:.3f}]}}",
                     1e3 * end.centre[0], 1e3 * end.centre[1], 1e3 * end.centre[2], end.normal[0], end.normal[1],
                     end.normal[2]);
}

const VesselEnd* nearest_within(const std::vector<VesselEnd>& ends, const Point& place, double radii) {
  const VesselEnd* nearest = nullptr;
  for (const auto& end : ends)
    if (norm(end.centre - place) < radii * end.radius &&
        (!nearest || norm(end.centre - place) < norm(nearest->centre - place)))
      nearest = &end;
  return nearest;
}

VesselEnd given_end(const std::string& name, const ImageOpening& opening, const SmoothField& field,
                    const VesselEnds& found, std::vector<Problem>& problems, const Log& log) {
  const std::string where = "opening " + name;
  if (opening.normal) {
    const auto normal = (1 / norm(*opening.normal)) * *opening.normal;
    if (const auto end = end_at(field, opening.centre, normal)) return *end;
    problems.push_back({where, "there is no cross-section of a vessel about " + in_mm(opening.centre),
                        "give a centre inside the vessel and a normal along it"});
    return {};
  }
  if (const auto* end = nearest_within(found.flat, opening.centre, 2)) return *end;
  if (const auto* end = nearest_within(found.uneven, opening.centre, 3)) {
    log(fmt::format("opening {}: the vessel does not end in a flat face, and is cut where it is whole: {}", name,
                    as_opening(*end)));
    return *end;
  }
  if (const auto end = end_near(field, opening.centre)) {
    log(fmt::format("opening {}: a short vessel, which ends in a plane at {}", name, as_opening(*end)));
    return *end;
  }
  std::string list;
  for (const auto* ends : {&found.flat, &found.uneven})
    for (const auto& end : *ends) list += (list.empty() ? "" : ", ") + in_mm(end.centre);
  problems.push_back({where,
                      fmt::format("no vessel ends within two radii of {}; ends are at {}", in_mm(opening.centre),
                                  list.empty() ? "no place" : list),
                      "correct the centre, or give a normal: the vessel is then cut there"});
  return {};
}

void check_distinct(const std::vector<VesselEnd>& ends, const SurfaceSettings& settings,
                    std::vector<Problem>& problems) {
  for (std::size_t i = 0; i < ends.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (norm(ends[i].centre - ends[j].centre) < 0.5 * std::max(ends[i].radius, ends[j].radius))
        problems.push_back({"opening " + settings.openings[i].first,
                            "is at the same end as " + settings.openings[j].first, "correct one of the centres"});
}

/// Where no normal is given, the end that was found may be another one.
void warn_of_far(const std::vector<VesselEnd>& ends, const SurfaceSettings& settings, const Log& log) {
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const auto& [name, opening] = settings.openings[i];
    const double away = norm(ends[i].centre - opening.centre);
    if (!opening.normal && away > ends[i].radius)
      log(fmt::format(
          "warning: opening {}: the vessel end nearest to its centre is {:.1f} mm away, more than its radius "
          "of {:.1f} mm: if it is another one, give a `normal`, and the vessel is cut at the centre",
          name, 1e3 * away, 1e3 * ends[i].radius));
  }
}

/// Every end that stays closed is said; the end of the aorta must not be one of them.
void check_closed(const std::vector<VesselEnd>& ends, const VesselEnds& found, const SurfaceSettings& settings,
                  const Log& log) {
  const double inlet = inlet_of(ends, settings).radius;
  std::vector<Problem> problems;
  for (const auto* list : {&found.flat, &found.uneven})
    for (const auto& end : *list) {
      const auto is_end = [&](const auto& e) {
        return norm(e.centre - end.centre) < 1.5 * std::max(e.radius, end.radius);
      };
      if (std::any_of(ends.begin(), ends.end(), is_end)) continue;
      log(fmt::format("the vessel end at {} stays closed: no opening names it; to open it: {}", in_mm(end.centre),
                      as_opening(end)));
      if (end.radius > wider_than_inlet * inlet)
        problems.push_back(
            {"openings",
             fmt::format("the vessel end at {}, of radius {:.1f} mm, is wider than the inlet, of {:.1f} mm, "
                         "and no opening names it",
                         in_mm(end.centre), 1e3 * end.radius, 1e3 * inlet),
             "name it: " + as_opening(end)});
    }
  if (!problems.empty()) throw InputError(std::move(problems));
}

}  // namespace

const VesselEnd& inlet_of(const std::vector<VesselEnd>& ends, const SurfaceSettings& settings) {
  if (settings.openings.empty())
    return *std::max_element(ends.begin(), ends.end(),
                             [](const auto& a, const auto& b) { return a.radius < b.radius; });
  for (std::size_t i = 0; i < ends.size(); ++i)
    if (settings.openings[i].first == settings.inlet) return ends[i];
  return ends.front();
}

std::vector<VesselEnd> choose_ends(const LumenMask& mask, const SmoothField& field, const SurfaceSettings& settings,
                                   const Log& log) {
  const auto& openings = settings.openings;
  const auto found = find_ends(mask, field);
  if (openings.empty()) {
    auto ends = found.flat;
    for (const auto& end : found.uneven) {
      log("a vessel does not end in a flat face, and is cut where it is whole: " + as_opening(end));
      ends.push_back(end);
    }
    if (ends.empty()) throw InputError("image", "no vessel end is found", "give `openings` with centres and normals");
    return ends;
  }
  std::vector<Problem> problems;
  std::vector<VesselEnd> ends;
  for (const auto& [name, opening] : openings) ends.push_back(given_end(name, opening, field, found, problems, log));
  if (problems.empty()) check_distinct(ends, settings, problems);
  if (!problems.empty()) throw InputError(std::move(problems));
  warn_of_far(ends, settings, log);
  check_closed(ends, found, settings, log);
  return ends;
}

}  // namespace tunica::imaging
