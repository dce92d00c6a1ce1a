#include "tunica/imaging/vessel_ends.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <set>

#include "tunica/base/disjoint_sets.hpp"

namespace tunica::imaging {

namespace {

constexpr double shortest_branch = 5e-3;  // m; what reaches less far out of its surroundings is no vessel
constexpr double widest = 80e-3;          // m; no cross-section of a vessel is wider
constexpr double steepest = 0.85;         // tan of the angle between an end's normal and the axis of the vessel
constexpr double flat_share = 0.5;        // of a flat end, this much lies in a plane
constexpr double whole_share = 0.88;      // of the area farther back that a section before an uneven end has
constexpr double roundest = 0.45;         // share of the circle about it that the section of a vessel fills

/// Ways through the lumen [m] from one voxel to all others.
std::vector<float> ways_from(std::int64_t start, const LumenMask& mask) {
  std::vector<float> way(mask.kinds.size(), std::numeric_limits<float>::infinity());
  using Entry = std::pair<float, std::int64_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  const auto matrix = mask.frame.matrix();
  float length[3][3][3];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k)
        length[i][j][k] = static_cast<float>(norm(matrix * Vec3<double>{{i - 1.0, j - 1.0, k - 1.0}}));
  way[start] = 0;
  queue.emplace(0.0F, start);
  while (!queue.empty()) {
    const auto [at, index] = queue.top();
    queue.pop();
    if (at > way[index]) continue;
    for_each_neighbour(mask.frame, index, [&](std::int64_t other, const Size3& step) {
      if (!mask.is_lumen(other)) return;
      const float there = at + length[step[0] + 1][step[1] + 1][step[2] + 1];
      if (there >= way[other]) return;
      way[other] = there;
      queue.emplace(there, other);
    });
  }
  return way;
}

std::int64_t farthest(const std::vector<float>& way) {
  std::int64_t best = 0;
  float most = -1;
  for (std::int64_t i = 0; i < std::ssize(way); ++i)
    if (std::isfinite(way[i]) && way[i] > most) {
      most = way[i];
      best = i;
    }
  return best;
}

/// Places from which each way on leads back, for at least the length of the shortest branch: maxima of the way with
/// this persistence.
std::vector<std::int64_t> tips(const std::vector<float>& way, const LumenMask& mask) {
  std::vector<std::int64_t> order;
  for (std::int64_t i = 0; i < std::ssize(way); ++i)
    if (std::isfinite(way[i])) order.push_back(i);
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return way[a] > way[b]; });
  std::vector<std::int32_t> part(way.size(), -1);  // of voxels that were seen
  base::DisjointSets parts;
  std::vector<std::int64_t> peak, result;
  for (const auto i : order) {
    std::int64_t mine = -1;
    for_each_neighbour(mask.frame, i, [&](std::int64_t other, const Size3&) {
      if (part[other] < 0) return;
      auto theirs = parts.set_of(part[other]);
      if (mine < 0) mine = theirs;
      if (mine == theirs) return;
      if (way[peak[mine]] < way[peak[theirs]]) std::swap(mine, theirs);
      if (way[peak[theirs]] - way[i] > shortest_branch) result.push_back(peak[theirs]);
      parts.join(theirs, mine);
    });
    if (mine < 0) {
      mine = parts.add();
      peak.push_back(i);
    }
    part[i] = static_cast<std::int32_t>(mine);
  }
  if (!order.empty()) result.push_back(order.front());
  return result;
}

/// The lumen behind a tip: voxels up to some way from it.
struct Stub {
  std::vector<std::int64_t> voxels;
  std::vector<double> depth;  ///< way back from the tip [m]
};

template <class Depth>
Stub stub_behind(std::int64_t tip, double length, const LumenMask& mask, const Depth& depth) {
  Stub stub{{tip}, {depth(tip)}};
  std::vector<std::int64_t> seen{tip};
  std::vector<bool> taken(mask.kinds.size(), false);
  taken[tip] = true;
  for (std::size_t next = 0; next < stub.voxels.size(); ++next)
    for_each_neighbour(mask.frame, stub.voxels[next], [&](std::int64_t other, const Size3&) {
      if (taken[other] || !mask.is_lumen(other) || !(depth(other) < length)) return;
      taken[other] = true;
      stub.voxels.push_back(other);
      stub.depth.push_back(depth(other));
    });
  return stub;
}

Point centroid(const Stub& stub, double from, double to, const ImageFrame& frame) {
  Point sum{{0, 0, 0}};
  double count = 0;
  for (std::size_t i = 0; i < stub.voxels.size(); ++i) {
    if (stub.depth[i] < from || stub.depth[i] >= to) continue;
    sum = sum + frame.place(frame.voxel(stub.voxels[i]));
    ++count;
  }
  return (1 / std::max(count, 1.0)) * sum;
}

/// Cross-section of the lumen in a plane.
struct Section {
  Point asked;                                ///< where it was asked for
  Vec3<double> u, v;                          ///< axes in the plane
  std::vector<std::array<double, 2>> places;  ///< along u and v, from the point it was asked for [m]
  double step;                                ///< between them [m]
  Point centre;
  double radius;  ///< of the largest distance from the centre [m]
};

/// Part of the lumen in the plane that hangs together with `at`; empty where that lies in the wall.
Section section(const SmoothField& field, const Point& at, const Vec3<double>& normal) {
  const Vec3<double> other = std::abs(normal[0]) < 0.7 ? Vec3<double>{{1, 0, 0}} : Vec3<double>{{0, 1, 0}};
  Section result;
  result.asked = at;
  result.u = cross(normal, other);
  result.u = (1 / norm(result.u)) * result.u;
  result.v = cross(normal, result.u);
  result.step = 0.7 * field.frame.largest_spacing();
  result.radius = 0;
  const int half = static_cast<int>(widest / result.step), width = 2 * half + 1;
  const auto place = [&](int i, int j) { return at + (i * result.step) * result.u + (j * result.step) * result.v; };
  std::vector<bool> seen(static_cast<std::size_t>(width) * width, false);
  std::vector<std::array<int, 2>> stack;
  const auto push = [&](int i, int j) {
    if (std::abs(i) > half || std::abs(j) > half) return;
    const auto index = static_cast<std::size_t>(i + half) + static_cast<std::size_t>(width) * (j + half);
    if (seen[index] || field.at(place(i, j)) >= 0) return;
    seen[index] = true;
    stack.push_back({i, j});
  };
  for (int ring = 0; ring <= 3 && stack.empty(); ++ring)  // the nearest sample in the lumen
    for (int i = -ring; i <= ring; ++i)
      for (int j = -ring; j <= ring; ++j) push(i, j);
  Point sum{{0, 0, 0}};
  while (!stack.empty()) {
    const auto [i, j] = stack.back();
    stack.pop_back();
    result.places.push_back({i * result.step, j * result.step});
    sum = sum + place(i, j);
    push(i + 1, j);
    push(i - 1, j);
    push(i, j + 1);
    push(i, j - 1);
  }
  result.centre = (1.0 / std::max<double>(1, static_cast<double>(result.places.size()))) * sum;
  for (const auto& [x, y] : result.places)
    result.radius = std::max(result.radius, norm(at + x * result.u + y * result.v - result.centre));
  return result;
}

/// How far it is from a place in the lumen to its end along `direction`; infinite if more than `limit` [m].
double way_out(const SmoothField& field, const Point& from, const Vec3<double>& direction, double limit) {
  const double step = 0.4 * field.frame.largest_spacing();
  double before = field.at(from);
  for (double s = step; s < limit; s += step) {
    const double value = field.at(from + s * direction);
    if (value >= 0) return s - step * value / (value - before);
    before = value;
  }
  return std::numeric_limits<double>::infinity();
}

/// z = a + b x + c y through points (least squares), from those with a weight.
std::array<double, 3> fitted_plane(const std::vector<std::array<double, 3>>& points, const std::vector<bool>& used) {
  Mat3<double> m{};
  Vec3<double> right{{0, 0, 0}};
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!used[i]) continue;
    const double row[3] = {1, points[i][0], points[i][1]};
    for (int r = 0; r < 3; ++r) {
      right[r] += row[r] * points[i][2];
      for (int c = 0; c < 3; ++c) m(r, c) += row[r] * row[c];
    }
  }
  const auto solution = inverse(m) * right;
  return {solution[0], solution[1], solution[2]};
}

/// The end in a plane: its centre is that of two cross-sections before it, carried on along the vessel.
std::optional<VesselEnd> centred(const SmoothField& field, const Point& in_plane, const Vec3<double>& normal,
                                 double radius) {
  const double step = 1.5 * field.frame.largest_spacing();
  const auto near = section(field, in_plane - step * normal, normal);
  if (near.places.empty()) return {};
  const auto far = section(field, near.centre - step * normal, normal);
  if (far.places.empty() || far.radius > 2 * radius) return {};
  const Point centre = 2.0 * near.centre - far.centre;
  return VesselEnd{centre + dot(in_plane - centre, normal) * normal, normal, near.radius};
}

/// The flat face in which a vessel ends ahead of a point on its axis; none where it ends in another way.
std::optional<VesselEnd> flat_face(const SmoothField& field, const Point& behind, const Vec3<double>& axis) {
  const auto cut = section(field, behind, axis);
  if (cut.places.size() < 12) return {};
  std::vector<std::array<double, 3>> points;  // of the face, over the section
  for (const auto& [x, y] : cut.places)
    points.push_back({x, y, way_out(field, behind + x * cut.u + y * cut.v, axis, 4 * cut.radius)});
  const double near = 0.75 * field.frame.largest_spacing();
  std::vector<bool> used;
  for (const auto& p : points) used.push_back(std::isfinite(p[2]));
  std::array<double, 3> plane{};
  std::size_t within = 0;
  // Points at the rounded rim are left out step by step.
  for (const double tolerance : {8 * near, 4 * near, 2 * near, near, near}) {
    if (std::count(used.begin(), used.end(), true) < 9) return {};
    plane = fitted_plane(points, used);
    within = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double off = points[i][2] - (plane[0] + plane[1] * points[i][0] + plane[2] * points[i][1]);
      used[i] = std::abs(off) < tolerance;
      within += used[i];
    }
  }
  if (static_cast<double>(within) < flat_share * static_cast<double>(points.size())) return {};
  if (std::hypot(plane[1], plane[2]) > steepest) return {};
  auto normal = axis - plane[1] * cut.u - plane[2] * cut.v;
  normal = (1 / norm(normal)) * normal;
  return centred(field, behind + plane[0] * axis, normal, cut.radius);
}

/// Nearly twice as long as the vessel is wide. A stub starts at the rim of the end, so it does not show the width
/// before it is that long.
template <class Depth>
double length_of_stub(std::int64_t tip, const LumenMask& mask, const Depth& depth) {
  double length = 6 * mask.frame.largest_spacing();
  while (length < widest) {
    const auto voxels = static_cast<double>(stub_behind(tip, length, mask, depth).voxels.size());
    const double area = mask.frame.voxel_volume() * voxels / length;
    const double wanted = std::min(widest, 3.5 * std::sqrt(area / M_PI));
    if (wanted <= length) break;
    length = wanted;
  }
  return length;
}

template <class Depth>
std::optional<VesselEnd> end_of_stub(std::int64_t tip, double length, const LumenMask& mask, const SmoothField& field,
                                     const Depth& depth) {
  const auto& frame = mask.frame;
  const auto stub = stub_behind(tip, length, mask, depth);
  auto axis = centroid(stub, 0, 0.4 * length, frame) - centroid(stub, 0.6 * length, length, frame);
  if (!(norm(axis) > 0)) return {};
  axis = (1 / norm(axis)) * axis;
  auto face = flat_face(field, centroid(stub, 0.4 * length, 0.6 * length, frame), axis);
  // Again along its own normal: the stub may be bent, or end obliquely.
  const double least = 3 * frame.largest_spacing();
  for (int i = 0; i < 2 && face; ++i)
    face = flat_face(field, face->centre - std::max(least, 0.3 * face->radius) * face->normal, face->normal);
  return face;
}

/// A vessel that is shorter than wide shows no direction, but most segmentations end with a slice: the flat face in the
/// slice of the tip.
std::optional<VesselEnd> end_in_slice(std::int64_t tip, const LumenMask& mask, const SmoothField& field) {
  const auto& frame = mask.frame;
  const std::int64_t strides[3] = {1, frame.size[0], frame.size[0] * frame.size[1]};
  for (int d = 0; d < 3; ++d)
    for (const int sign : {-1, 1}) {
      const auto outward = sign * strides[d];
      if (mask.is_lumen(tip + outward)) continue;
      // Voxels of the slice about the tip that end there too.
      std::vector<std::int64_t> face{tip};
      std::set<std::int64_t> seen{tip};
      Point sum{{0, 0, 0}};
      for (std::size_t next = 0; next < face.size(); ++next) {
        sum = sum + frame.place(frame.voxel(face[next]));
        for (int e = 0; e < 3; ++e)
          for (const auto step : {-strides[e], strides[e]}) {
            const auto other = face[next] + step;
            if (e == d || !mask.is_lumen(other) || mask.is_lumen(other + outward) || !seen.insert(other).second)
              continue;
            face.push_back(other);
          }
      }
      const auto of_true =
          std::count_if(face.begin(), face.end(), [&](std::int64_t i) { return mask.kinds[i] == Kind::true_lumen; });
      if (face.size() < 12 || 2 * of_true < std::ssize(face)) continue;
      const auto axis = (sign / norm(frame.steps[d])) * frame.steps[d];
      const Point centre = (1 / static_cast<double>(face.size())) * sum;
      if (const auto end = flat_face(field, centre - 3 * frame.largest_spacing() * axis, axis);
          end && dot(end->normal, axis) > 0.95)
        return end;
    }
  return {};
}

template <class Depth>
std::optional<VesselEnd> end_of_tip(std::int64_t tip, const LumenMask& mask, const SmoothField& field,
                                    const Depth& depth) {
  const double longest = length_of_stub(tip, mask, depth);
  // Vessels that are short or bent show their direction on a shorter stub.
  for (const double share : {1.0, 0.7, 0.5, 0.35})
    if (const auto end = end_of_stub(tip, share * longest, mask, field, depth)) return end;
  return end_in_slice(tip, mask, field);
}

double share_of_true(const Stub& stub, const LumenMask& mask) {
  double count = 0;
  for (const auto i : stub.voxels) count += mask.kinds[i] == Kind::true_lumen;
  return count / static_cast<double>(stub.voxels.size());
}

bool lies_in_true_lumen(const Section& cut, const LumenMask& mask) {
  const auto to_voxels = inverse(mask.frame.matrix());
  std::size_t count = 0;
  for (const auto& [x, y] : cut.places) {
    const auto v = to_voxels * (cut.asked + x * cut.u + y * cut.v - mask.frame.origin);
    const Size3 w{std::lround(v[0]), std::lround(v[1]), std::lround(v[2])};
    count += mask.frame.holds(w[0], w[1], w[2]) && mask.kinds[mask.frame.index(w[0], w[1], w[2])] == Kind::true_lumen;
  }
  return 2 * count > cut.places.size();
}

double area_of(const Section& cut) { return cut.step * cut.step * static_cast<double>(cut.places.size()); }

/// The direction along a vessel: across it the cross-section is smallest.
Vec3<double> direction_along(const SmoothField& field, const Point& at, Vec3<double> axis) {
  double least = area_of(section(field, at, axis));
  for (double tilt = 0.35; tilt > 0.06; tilt *= 0.5)
    for (int tries = 0, found = 1; found && tries < 5; ++tries) {
      found = 0;
      const auto cut = section(field, at, axis);
      for (int k = 0; k < 6; ++k) {
        auto tilted = axis + tilt * (std::cos(k * M_PI / 3) * cut.u + std::sin(k * M_PI / 3) * cut.v);
        tilted = (1 / norm(tilted)) * tilted;
        const double area = area_of(section(field, at, tilted));
        if (area >= least || area == 0) continue;
        least = area;
        axis = tilted;
        found = 1;
      }
    }
  return axis;
}

/// Sections across a vessel from a place to its end; none where it goes on for more than `longest` [m].
std::vector<Section> sections_to_end(const SmoothField& field, Point at, const Vec3<double>& axis, double longest) {
  const double step = 0.5 * field.frame.largest_spacing();
  std::vector<Section> sections;
  for (;;) {
    auto cut = section(field, at, axis);
    if (cut.places.size() < 12 || cut.radius >= 0.9 * widest) return sections;
    at = cut.centre + step * axis;
    sections.push_back(std::move(cut));
    if (step * static_cast<double>(sections.size()) > longest) return {};
  }
}

/// The last of the sections that is still whole: as large as those in the first half; 0: none, or they differ by more
/// than the factor `spread`.
std::size_t last_whole(const std::vector<Section>& sections, double spread) {
  if (sections.size() < 5) return 0;
  std::vector<double> areas;
  for (std::size_t k = 0; k < (sections.size() + 1) / 2; ++k) areas.push_back(area_of(sections[k]));
  std::nth_element(areas.begin(), areas.begin() + std::ssize(areas) / 2, areas.end());
  const double whole = areas[areas.size() / 2];
  std::size_t last = sections.size() - 1;
  while (last > 0 && area_of(sections[last]) < whole_share * whole) --last;
  // Along a vessel they are alike; across a corner of something wide, or a ball, they are not.
  double least = whole, most = whole;
  for (std::size_t k = 0; k <= last; ++k) {
    least = std::min(least, area_of(sections[k]));
    most = std::max(most, area_of(sections[k]));
  }
  if (most > spread * least) return 0;
  return last;
}

/// The last section before a tip that is still as wide as those farther back, for vessels that do not end in a face.
/// None for the wedge in which a lumen ends beside the other one.
template <class Depth>
std::optional<VesselEnd> whole_before_tip(std::int64_t tip, const LumenMask& mask, const SmoothField& field,
                                          const Depth& depth) {
  const auto& frame = mask.frame;
  const double longest = length_of_stub(tip, mask, depth);
  // A short vessel leaves a wide one soon, and a steep end is long.
  for (const double share : {0.8, 0.55, 1.2}) {
    const double length = share * longest;
    const auto stub = stub_behind(tip, length, mask, depth);
    if (share_of_true(stub, mask) < 0.5) return {};
    auto axis = centroid(stub, 0, 0.4 * length, frame) - centroid(stub, 0.6 * length, length, frame);
    if (!(norm(axis) > 0)) continue;
    axis = (1 / norm(axis)) * axis;
    const Point start = section(field, centroid(stub, 0.6 * length, length, frame), axis).centre;
    axis = direction_along(field, start, axis);
    auto sections = sections_to_end(field, start, axis, 1.5 * length);
    std::size_t last = last_whole(sections, 1.8);
    if (last == 0) continue;
    // Again from nearer to the end: the vessel may be bent.
    const auto back = static_cast<std::size_t>(2.4 * sections[last].radius / frame.largest_spacing());
    const Point nearer = sections[last > back ? last - back : 0].centre;
    axis = direction_along(field, nearer, axis);
    sections = sections_to_end(field, nearer, axis, 1.5 * length);
    last = last_whole(sections, 1.25);
    if (last == 0) continue;
    const auto& cut = sections[last];
    if (norm(cut.centre - sections.front().centre) < 1.05 * cut.radius) continue;
    if (area_of(cut) < roundest * M_PI * cut.radius * cut.radius) continue;
    if (!lies_in_true_lumen(cut, mask)) continue;
    return VesselEnd{cut.centre, axis, cut.radius};
  }
  return {};
}

}  // namespace

VesselEnds find_ends(const LumenMask& mask, const SmoothField& field) {
  std::int64_t any = 0;
  while (!mask.is_lumen(any)) ++any;
  const auto first = farthest(ways_from(any, mask));
  const auto way = ways_from(first, mask);
  VesselEnds ends;
  std::vector<std::int64_t> others;
  const auto add = [](const VesselEnd& end, std::vector<VesselEnd>& list) {
    for (const auto& other : list)
      if (norm(other.centre - end.centre) < std::max(other.radius, end.radius)) return;
    list.push_back(end);
  };
  const auto depth_from = [&](std::int64_t tip) {
    return [&way, tip, first](std::int64_t i) {
      return tip == first ? double{way[i]} : double{way[tip]} - double{way[i]};
    };
  };
  auto all = tips(way, mask);
  all.insert(all.begin(), first);
  for (const auto tip : all) {
    if (const auto end = end_of_tip(tip, mask, field, depth_from(tip)))
      add(*end, ends.flat);
    else
      others.push_back(tip);
  }
  for (const auto tip : others) {
    const auto end = whole_before_tip(tip, mask, field, depth_from(tip));
    if (!end) continue;
    const auto near = [&](const VesselEnd& other) {
      return norm(other.centre - end->centre) < 1.5 * std::max(other.radius, end->radius);
    };
    if (std::none_of(ends.flat.begin(), ends.flat.end(), near)) add(*end, ends.uneven);
  }
  return ends;
}

std::optional<VesselEnd> end_near(const SmoothField& field, const Point& place) {
  constexpr int directions = 200;
  constexpr double largest_rest = 0.15;  // of the section before the end, behind it
  const double voxel = field.frame.largest_spacing(), golden = M_PI * (3 - std::sqrt(5.0));
  std::optional<VesselEnd> best;
  double least = largest_rest;
  for (int k = 0; k < directions; ++k) {
    const double z = 1 - (2.0 * k + 1) / directions, r = std::sqrt(1 - z * z);
    const Vec3<double> axis{{r * std::cos(golden * k), r * std::sin(golden * k), z}};
    const auto end = flat_face(field, place - 3 * voxel * axis, axis);
    if (!end || norm(end->centre - place) > std::max(0.7 * end->radius, 3 * voxel)) continue;
    const auto before = section(field, end->centre - 1.5 * voxel * end->normal, end->normal);
    if (before.places.empty() || area_of(before) < roundest * M_PI * before.radius * before.radius) continue;
    const double rest = area_of(section(field, end->centre + 1.5 * voxel * end->normal, end->normal)) / area_of(before);
    if (rest >= least) continue;
    least = rest;
    best = end;
  }
  return best;
}

std::optional<VesselEnd> end_at(const SmoothField& field, const Point& centre, const Vec3<double>& normal) {
  const auto cut = section(field, centre, normal);
  if (cut.places.size() < 4 || cut.radius >= 0.9 * widest) return {};
  return VesselEnd{cut.centre, normal, cut.radius};
}

void continue_beyond(const VesselEnd& end, double reach, LumenMask& mask) {
  const auto& frame = mask.frame;
  const auto to_voxels = inverse(frame.matrix());
  const double voxel = frame.largest_spacing(), worn = 1.5 * voxel;
  const auto before = mask.kinds;
  for_each_voxel_near(frame, end.centre, end.radius + reach + 6 * voxel, [&](std::int64_t i) {
    const auto way = frame.place(frame.voxel(i)) - end.centre;
    const double height = dot(way, end.normal) + worn;
    if (height <= 0 || height > reach + worn + 2 * voxel) return;
    if (norm(way - (height - worn) * end.normal) > end.radius + 2 * voxel) return;
    Kind kind = Kind::tissue;
    if (height <= reach + worn) {
      const Point mirrored = to_voxels * (end.centre + way - 2 * height * end.normal - frame.origin);
      const Size3 v{std::lround(mirrored[0]), std::lround(mirrored[1]), std::lround(mirrored[2])};
      if (frame.holds(v[0], v[1], v[2])) kind = before[frame.index(v[0], v[1], v[2])];
    }
    mask.kinds[i] = kind;
  });
}

}  // namespace tunica::imaging
