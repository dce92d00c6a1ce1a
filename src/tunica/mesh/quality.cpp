#include "tunica/mesh/quality.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tunica/base/error.hpp"
#include "tunica/mesh/boundary.hpp"

namespace tunica::mesh {

namespace {

constexpr double degrees = 180 / std::numbers::pi;
/// Elements flatter than this (scaled Jacobian) cannot be told from inverted ones in double precision.
constexpr double flat = 1e-12;

std::array<Vec3<double>, 4> corners(const MeshData& data, std::int64_t element) {
  const auto& t = data.tetrahedra[element];
  return {data.points[t[0]], data.points[t[1]], data.points[t[2]], data.points[t[3]]};
}

std::string place(const MeshData& data, std::int64_t element) {
  const Vec3<double> c[1] = {mesh::centroid(data.points, data.tetrahedra[element])};
  return list_places(c);
}

constexpr std::array<double, 7> bins = {0, 2, 5, 10, 20, 40, 71};

std::string table(const QualityReport& r, const std::array<std::int64_t, bins.size() - 1>& counts) {
  std::string text = fmt::format(
      "{} elements; smallest: volume {:.3g} m^3, scaled Jacobian {:.3g}, dihedral {:.2f} degrees, radius ratio {:.3g}\n"
      "smallest dihedral [degrees]  elements",
      r.elements, r.smallest_volume, r.smallest_scaled_jacobian, r.smallest_dihedral, r.smallest_radius_ratio);
  for (std::size_t b = 0; b < counts.size(); ++b)
    text += fmt::format("\n{:>12.0f} - {:<12.0f} {:>10} {:>6.2f} %", bins[b], bins[b + 1], counts[b],
                        100.0 * counts[b] / std::max<std::int64_t>(1, r.elements));
  return text;
}

}  // namespace

ElementQuality quality(const std::array<Vec3<double>, 4>& x) {
  const auto edge = [&](int a, int b) { return norm(x[b] - x[a]); };
  const double six_v = dot(x[1] - x[0], cross(x[2] - x[0], x[3] - x[0]));
  ElementQuality q{six_v / 6, 0, 0, 0};

  const double l01 = edge(0, 1), l02 = edge(0, 2), l03 = edge(0, 3), l12 = edge(1, 2), l13 = edge(1, 3),
               l23 = edge(2, 3);
  const double longest = std::max({l01 * l02 * l03, l01 * l12 * l13, l02 * l12 * l23, l03 * l13 * l23});
  if (longest == 0) return q;
  q.scaled_jacobian = std::numbers::sqrt2 * six_v / longest;

  Vec3<double> normal[4];
  double area[4], total = 0;
  for (int f = 0; f < 4; ++f) {
    const auto& t = tetrahedron_faces[f];
    normal[f] = cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]]);
    total += area[f] = norm(normal[f]);
  }
  if (*std::min_element(area, area + 4) == 0) return q;
  double largest_cosine = -1;
  for (int f = 0; f < 4; ++f)
    for (int g = f + 1; g < 4; ++g)
      largest_cosine = std::max(largest_cosine, -dot(normal[f], normal[g]) / (area[f] * area[g]));
  q.smallest_dihedral = std::acos(std::min(1.0, largest_cosine)) * degrees;

  // Inradius 3 V / (sum of areas); circumradius from the products of opposite edges.
  const double a = l01 * l23, b = l02 * l13, c = l03 * l12, s = (a + b + c) / 2;
  const double circumradius_six_v = std::sqrt(std::max(0.0, s * (s - a) * (s - b) * (s - c)));
  const double inradius = six_v / total;
  q.radius_ratio = circumradius_six_v > 0 ? 3 * inradius * six_v / circumradius_six_v : 0;
  return q;
}

std::string orient_elements(MeshData& data, const std::string& where) {
  std::vector<std::int64_t> negative, zero;
  for (std::int64_t e = 0; e < std::ssize(data.tetrahedra); ++e) {
    const auto q = quality(corners(data, e));
    if (!(std::abs(q.scaled_jacobian) > flat))
      zero.push_back(e);
    else if (q.volume < 0)
      negative.push_back(e);
  }
  const std::int64_t n = std::ssize(data.tetrahedra), positive = n - std::ssize(negative) - std::ssize(zero);
  if (zero.empty() && negative.empty()) return {};
  if (zero.empty() && positive == 0) {
    for (auto& t : data.tetrahedra) std::swap(t[2], t[3]);
    return fmt::format("{}: all {} elements have the opposite node order, turned", where, n);
  }
  // The minority is what is wrong, whichever node order the file uses.
  auto bad = zero;
  if (std::ssize(negative) <= positive) {
    bad.insert(bad.end(), negative.begin(), negative.end());
  } else {
    for (std::int64_t e = 0; e < n; ++e)
      if (quality(corners(data, e)).volume > 0) bad.push_back(e);
  }
  std::vector<Vec3<double>> places;
  for (const auto e : bad) places.push_back(mesh::centroid(data.points, data.tetrahedra[e]));
  throw InputError(where,
                   fmt::format("{} of {} elements are inverted or flat ({} of them flat): element {} at {}", bad.size(),
                               n, zero.size(), bad[0] + 1, list_places(places)),
                   "mesh the region again or repair these elements");
}

QualityReport check_quality(const MeshData& data, std::int32_t region, const QualityLimits& limits,
                            const std::string& where) {
  const std::int64_t first = region < 0 ? 0 : data.regions[region].first_element;
  const std::int64_t end = region < 0 ? std::ssize(data.tetrahedra) : data.regions[region].end_element;
  QualityReport report{.elements = end - first,
                       .smallest_volume = 1e300,
                       .smallest_scaled_jacobian = 1,
                       .smallest_dihedral = 90,
                       .smallest_radius_ratio = 1,
                       .warnings = {},
                       .summary = {}};
  std::array<std::int64_t, bins.size() - 1> counts{};
  std::vector<Vec3<double>> inverted;
  std::vector<std::pair<double, std::int64_t>> slivers;
  for (auto e = first; e < end; ++e) {
    const auto q = quality(corners(data, e));
    if (!(q.scaled_jacobian > flat)) inverted.push_back(mesh::centroid(data.points, data.tetrahedra[e]));
    if (q.smallest_dihedral < limits.sliver_dihedral) slivers.emplace_back(q.smallest_dihedral, e);
    report.smallest_volume = std::min(report.smallest_volume, q.volume);
    report.smallest_scaled_jacobian = std::min(report.smallest_scaled_jacobian, q.scaled_jacobian);
    report.smallest_dihedral = std::min(report.smallest_dihedral, q.smallest_dihedral);
    report.smallest_radius_ratio = std::min(report.smallest_radius_ratio, q.radius_ratio);
    const auto bin = std::upper_bound(bins.begin(), bins.end(), q.smallest_dihedral) - bins.begin() - 1;
    ++counts[std::clamp<std::ptrdiff_t>(bin, 0, counts.size() - 1)];
  }
  if (!inverted.empty())
    throw InputError(where,
                     fmt::format("{} of {} elements have no positive volume: {}", inverted.size(), report.elements,
                                 list_places(inverted)),
                     "mesh the region again or repair these elements");
  report.slivers = std::ssize(slivers);
  if (!slivers.empty()) {
    constexpr std::size_t shown = 3;
    const auto last = slivers.begin() + std::min(shown, slivers.size());
    std::partial_sort(slivers.begin(), last, slivers.end());
    std::string text = fmt::format("{}: {} of {} elements have a dihedral angle below {:g} degrees; worst:", where,
                                   slivers.size(), report.elements, limits.sliver_dihedral);
    for (auto s = slivers.begin(); s != last; ++s)
      text += fmt::format(" element {} {:.3f} degrees at {};", s->second + 1, s->first, place(data, s->second));
    text.pop_back();
    report.warnings.push_back(std::move(text));
  }
  report.summary = table(report, counts);
  return report;
}

}  // namespace tunica::mesh
