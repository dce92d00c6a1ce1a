#include "tunica/analysis/growth.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tunica/base/limits.hpp"

namespace tunica::analysis {

namespace {

using base::nan;
constexpr double same_tear = 25e-3;  ///< within which tears of two dates are one [m]

using Scans = std::vector<const Anatomy*>;

std::array<double, 2> common_range(const std::vector<ScanMap>& maps) {
  std::array<double, 2> range = {0, std::numeric_limits<double>::infinity()};
  for (const auto& map : maps) {
    range[0] = std::max(range[0], map.range()[0]);
    range[1] = std::min(range[1], map.range()[1]);
  }
  return range;
}

std::vector<GrowthSegment> make_segments(const Growth& growth, const Scans& scans) {
  std::vector<std::string> names = {"inlet"};
  std::vector<double> places = {growth.range[0]};
  const auto& first = growth.maps.back();  // scans have the same branches, and those of any map are anchors of all
  for (std::size_t k = 0; k < first.anchors().size(); ++k) {
    if (first.anchor_arcs()[k] <= growth.range[0] || first.anchor_arcs()[k] >= growth.range[1]) continue;
    names.push_back(first.anchors()[k]);
    places.push_back(first.anchor_arcs()[k]);
  }
  names.emplace_back("end");
  places.push_back(growth.range[1]);
  std::vector<GrowthSegment> segments;
  for (std::size_t k = 1; k < places.size(); ++k) {
    GrowthSegment segment{names[k - 1], names[k], places[k - 1], places[k], {}, {}};
    for (std::size_t i = 0; i < scans.size(); ++i) {
      const double from = growth.maps[i].arc(segment.begin), to = growth.maps[i].arc(segment.end);
      segment.length.push_back(to - from);
      segment.volume.push_back(scans[i]->volume(from, to));
    }
    segments.push_back(std::move(segment));
  }
  return segments;
}

std::vector<TearHistory> match_tears(const Growth& growth, const Scans& scans) {
  std::vector<TearHistory> tears;
  for (std::size_t i = 0; i < scans.size(); ++i)
    for (const auto& tear : scans[i]->tears) {
      const double s = growth.maps[i].back(tear.s);
      TearHistory* nearest = nullptr;
      for (auto& t : tears) {
        const bool free = std::isnan(t.area[i]) && std::abs(t.s - s) < same_tear;
        if (free && (!nearest || std::abs(t.s - s) < std::abs(nearest->s - s))) nearest = &t;
      }
      if (!nearest) nearest = &tears.emplace_back(TearHistory{s, std::vector<double>(scans.size(), nan)});
      nearest->area[i] = tear.area;
    }
  std::stable_sort(tears.begin(), tears.end(), [](const auto& a, const auto& b) { return a.s < b.s; });
  return tears;
}

}  // namespace

Growth find_growth(const Scans& scans) {
  Growth growth;
  for (const auto* scan : scans) growth.maps.emplace_back(*scans[0], *scan);
  growth.range = common_range(growth.maps);
  for (const auto& section : scans[0]->sections)
    if (section.s >= growth.range[0] && section.s <= growth.range[1]) growth.stations.push_back(section.s);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    auto& sections = growth.sections.emplace_back();
    for (const double s : growth.stations) sections.push_back(scans[i]->at(growth.maps[i].arc(s)));
  }
  growth.segments = make_segments(growth, scans);
  growth.tears = match_tears(growth, scans);
  return growth;
}

double radial_growth(const Growth& growth, const Scans& scans, std::size_t earlier, std::size_t later,
                     const LineCoordinates& at) {
  return scans[0]->inner_radius(at.s, at.angle) *
         (growth.maps[later].stretch(at.s, at.angle) - growth.maps[earlier].stretch(at.s, at.angle));
}

}  // namespace tunica::analysis
