#include "tunica/imaging/flap.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tunica/base/error.hpp"
#include "tunica/imaging/distance.hpp"
#include "tunica/imaging/gaussian.hpp"

namespace tunica::imaging {

namespace {

constexpr double facing = 2.5e-3;         // m; lumens nearer to the surface between them have a flap there
constexpr std::ptrdiff_t many_small = 5;  // so many small contacts are no accident

FlapSides box_about_false_lumen(const LumenMask& mask) {
  const auto& frame = mask.frame;
  const auto margin = 2 + static_cast<std::int64_t>(2 * facing / frame.largest_spacing());
  Size3 low = frame.size, high{-1, -1, -1};
  for (std::int64_t i = 0; i < frame.count(); ++i) {
    if (mask.kinds[i] != Kind::false_lumen) continue;
    const auto v = frame.voxel(i);
    for (int d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], v[d]);
      high[d] = std::max(high[d], v[d]);
    }
  }
  FlapSides box{frame, {}, {}, {}, 0};
  for (int d = 0; d < 3; ++d) {
    box.low[d] = std::max<std::int64_t>(0, low[d] - margin);
    box.frame.size[d] = std::min(frame.size[d] - 1, high[d] + margin) + 1 - box.low[d];
  }
  box.frame.origin = frame.place(box.low);
  return box;
}

VoxelSet voxels_in(const LumenMask& mask, const FlapSides& box, Kind kind) {
  VoxelSet set(box.frame.count());
  for (std::int64_t i = 0; i < std::ssize(set); ++i) {
    const auto v = box.frame.voxel(i);
    set[i] = mask.kinds[mask.frame.index(v[0] + box.low[0], v[1] + box.low[1], v[2] + box.low[2])] == kind;
  }
  return set;
}

/// How wide the lumens are open at the contacts.
std::vector<OpenPlace> places_of(const LumenMask& mask, const std::vector<Contact>& contacts) {
  const auto box = box_about_false_lumen(mask);
  auto blood = voxels_in(mask, box, Kind::true_lumen);
  const auto of_false = voxels_in(mask, box, Kind::false_lumen);
  for (std::size_t i = 0; i < blood.size(); ++i) blood[i] |= of_false[i];
  const auto to_blood = signed_distance(box.frame, blood);
  std::vector<OpenPlace> places;
  for (const auto& contact : contacts) {
    auto& place = places.emplace_back(OpenPlace{contact.area, 0});
    for (const auto i : contact.voxels) {
      const auto v = mask.frame.voxel(i);
      const auto b = box.frame.index(v[0] - box.low[0], v[1] - box.low[1], v[2] - box.low[2]);
      place.radius = std::max(place.radius, -double{to_blood[b]});
    }
  }
  return places;
}

struct SortedContacts {
  std::vector<Contact> tears, closed;
  std::vector<OpenPlace> of_tears, of_closed;
  double noise = 0;  ///< m^2; 0: the labels are clean
};

void list(const SortedContacts& contacts, const TearBounds& bounds, const Log& log) {
  for (const auto& tear : contacts.tears)
    log(fmt::format("tear of {:.0f} mm^2 at {}: there true and false lumen touch", 1e6 * tear.area,
                    in_mm(tear.centre)));
  for (std::size_t i = 0; i < std::min(contacts.closed.size(), most_listed); ++i) {
    const bool small = contacts.closed[i].area < bounds.at_least();
    log(fmt::format("contact of {:.2f} mm^2, {:.1f} mm wide, at {} closed: {}", 1e6 * contacts.closed[i].area,
                    2e3 * contacts.of_closed[i].radius, in_mm(contacts.closed[i].centre),
                    small ? fmt::format("smaller than `smallest_tear`, {:.0f} mm^2", 1e6 * bounds.at_least())
                          : "like what noise opens elsewhere"));
  }
  if (contacts.closed.size() > most_listed)
    log(fmt::format("and {} smaller ones", contacts.closed.size() - most_listed));
  warn_of_closed(contacts.of_closed, "contacts of the lumens", bounds, log);
  for (std::size_t i = 0; i < contacts.tears.size(); ++i)
    if (contacts.noise > 0 && contacts.of_tears[i].size() < 2 * contacts.noise)
      log(
          fmt::format("warning: the labels are rough, and the tear of {:.0f} mm^2 at {} may be noise: if so, give "
                      "`smallest_tear`",
                      1e6 * contacts.tears[i].area, in_mm(contacts.tears[i].centre)));
}

/// The voxels between the lumens within the circle of a given tear.
std::vector<Contact> given_tears(const LumenMask& mask, const std::vector<GivenTear>& given) {
  const auto sides = flap_sides(mask, {});
  const double voxel = mask.frame.largest_spacing();
  std::vector<Contact> tears;
  std::vector<Problem> problems;
  for (const auto& tear : given) {
    Contact contact{tear.centre, 0.25 * M_PI * tear.diameter * tear.diameter, {}, 0};
    const double radius = 0.5 * tear.diameter - width_of_rim(voxel);
    for (std::int64_t i = 0; i < std::ssize(sides.side); ++i) {
      const auto v = sides.frame.voxel(i);
      if (std::abs(sides.side[i]) > voxel || norm(sides.frame.place(v) - tear.centre) > std::max(radius, voxel))
        continue;
      contact.voxels.push_back(mask.frame.index(v[0] + sides.low[0], v[1] + sides.low[1], v[2] + sides.low[2]));
    }
    if (contact.voxels.empty())
      problems.push_back({"flap.tears", "there is no surface between the lumens at " + in_mm(tear.centre),
                          "give a place where the labels of both lumens meet"});
    tears.push_back(std::move(contact));
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  return tears;
}

}  // namespace

double OpenPlace::size() const { return std::sqrt(area * M_PI) * radius; }

double TearBounds::noise_among(const std::vector<OpenPlace>& places, double voxel) const {
  constexpr double widest_speck = 1.8;  // voxels; half the width that noise opens easily
  std::vector<double> sizes;
  std::ptrdiff_t small = 0;
  double noise = 0;
  for (const auto& place : places) {
    sizes.push_back(place.size());
    small += place.area < at_least();
    if (place.area < at_least() || place.radius < widest_speck * voxel) noise = std::max(noise, place.size());
  }
  if (smallest || small < many_small) return 0;
  // What noise opens has sizes whose tail falls about exponentially: of n in a tail of mean m beyond a size, one is
  // larger than that by m (ln n + 6) once in four hundred times. Then it is a tear, and so are all that are larger.
  constexpr std::ptrdiff_t of_tail = 30;
  constexpr double apart = 6;
  std::sort(sizes.begin(), sizes.end());
  auto next = std::upper_bound(sizes.begin(), sizes.end(), noise);
  for (; next != sizes.end() && *next < largest_noise(); ++next) {
    const auto first = next - std::min(of_tail, next - sizes.begin() - 1);
    const auto n = static_cast<double>(next - first);
    const double mean = std::accumulate(first, next, 0.0) / n - *(first - 1);
    if (*next > *(first - 1) + mean * (std::log(n) + apart)) return *next;
  }
  return largest_noise();
}

void warn_of_closed(const std::vector<OpenPlace>& closed, const std::string& what, const TearBounds& bounds,
                    const Log& log) {
  std::int64_t count = 0;
  double largest = 0;
  for (const auto& place : closed) {
    count += place.area >= bounds.at_least();
    largest = std::max(largest, place.area);
  }
  if (count > 0)
    log(fmt::format(
        "warning: the labels are rough, and {} {} of {:.0f} to {:.0f} mm^2 were taken for noise and closed; "
        "if there are tears among them, give `smallest_tear`",
        count, what, 1e6 * bounds.at_least(), 1e6 * largest));
}

config::Schema<GivenTear> GivenTear::schema() {
  using namespace config;
  return Schema<GivenTear>("tear", "A round tear.")
      .quantities("centre", &GivenTear::centre, dimension::length, anything(), "In patient axes")
      .quantity("diameter", &GivenTear::diameter, dimension::length, range(1e-3, 60e-3), "Of the opening");
}

config::Schema<FlapSettings> FlapSettings::schema() {
  using namespace config;
  return Schema<FlapSettings>("flap", "For labels without a flap: true and false lumen touch all along.")
      .quantity("insert", &FlapSettings::insert, dimension::length, range(0.5e-3, 5e-3),
                "A flap of at least this thickness is put between the lumens, in the middle; it ends where the labels "
                "end. Where the lumens touch is then no tear")
      .list("tears", &FlapSettings::tears, GivenTear::schema(),
            "Where that flap is open; with none the lumens are apart")
      .by_default();
}

FlapSides flap_sides(const LumenMask& mask, const std::vector<std::int64_t>& open) {
  auto box = box_about_false_lumen(mask);
  const auto to_true = signed_distance(box.frame, voxels_in(mask, box, Kind::true_lumen));
  const auto to_false = signed_distance(box.frame, voxels_in(mask, box, Kind::false_lumen));
  const double voxel = box.frame.largest_spacing();
  std::int64_t between = 0;
  for (std::size_t i = 0; i < to_true.size(); ++i) {
    const float side = 0.5F * (to_false[i] - to_true[i]);
    box.side.push_back(std::clamp(side, -1.0F, 1.0F));  // m; without a true lumen in the box it is infinite
    // One layer of voxels, also where the lumens touch and those on both sides are half a voxel away.
    between += side > -0.45 * voxel && side < 0.55 * voxel && to_true[i] < facing && to_false[i] < facing;
  }
  box.area = box.frame.voxel_volume() / voxel * static_cast<double>(between);
  // Distances jump with the voxels: the flap goes on smoothly where they leave none.
  blur(box.frame, 1, box.side);
  VoxelSet tears(box.side.size(), 0);
  for (const auto i : open) {
    const auto v = mask.frame.voxel(i);
    const Size3 w{v[0] - box.low[0], v[1] - box.low[1], v[2] - box.low[2]};
    if (box.frame.holds(w[0], w[1], w[2])) tears[box.frame.index(w[0], w[1], w[2])] = 1;
  }
  box.to_tear = distance_to(box.frame, tears);
  return box;
}

std::vector<Contact> find_tears(const LumenMask& mask, const FlapSettings& flap, const TearBounds& bounds,
                                const Log& log) {
  if (flap.insert) {
    auto tears = given_tears(mask, flap.tears);
    log(fmt::format("a flap of at least {:.1f} mm is put between the lumens, with {} given tears", 1e3 * *flap.insert,
                    tears.size()));
    if (tears.empty()) log("warning: no tear joins true and false lumen: give `flap.tears` where there are some");
    return tears;
  }
  auto contacts = find_contacts(mask, 0);
  const auto places = places_of(mask, contacts);
  SortedContacts sorted;
  sorted.noise = bounds.noise_among(places, mask.frame.largest_spacing());
  double open = 0;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    open += contacts[i].touching;
    const bool tear = bounds.is_tear(places[i], sorted.noise);
    (tear ? sorted.tears : sorted.closed).push_back(std::move(contacts[i]));
    (tear ? sorted.of_tears : sorted.of_closed).push_back(places[i]);
  }
  const auto& tears = sorted.tears;
  const double share = open / std::max(flap_sides(mask, {}).area, open);
  if (share > bounds.most_open)
    throw InputError(
        "flap",
        fmt::format("true and false lumen touch over {:.0f} mm^2 about {}, {:.0f} % of the surface between "
                    "them: the labels have no flap",
                    1e6 * open, tears.empty() ? "the false lumen" : in_mm(tears.front().centre), 100 * share),
        "put one between them by `flap: {insert: 1.8 mm, tears: [{centre: [x mm, y mm, z mm], diameter: 10 "
        "mm}]}`; if these are tears, raise `most_open`");
  if (tears.empty())
    throw InputError("flap",
                     fmt::format("no tear joins true and false lumen: the largest contact has {:.2f} mm^2",
                                 sorted.closed.empty() ? 0.0 : 1e6 * sorted.closed.front().area),
                     "lower `smallest_tear`, or label the blood in the tears as lumen");
  list(sorted, bounds, log);
  return sorted.tears;
}

void hold_apart(const FlapSides& sides, double gap, double slope, const ImageFrame& frame, SmoothField& field) {
  const double rim = width_of_rim(frame.largest_spacing());
  for (std::int64_t i = 0; i < std::ssize(sides.side); ++i) {
    const double half = std::min(0.5 * gap, sides.to_tear[i] - rim);
    const double value = slope * (half - std::abs(sides.side[i]));
    if (value <= -0.5) continue;
    const auto v = sides.frame.voxel(i);
    auto& there = field.values[frame.index(v[0] + sides.low[0], v[1] + sides.low[1], v[2] + sides.low[2])];
    there = std::max(there, static_cast<float>(std::min(0.5, value)));
  }
}

}  // namespace tunica::imaging
