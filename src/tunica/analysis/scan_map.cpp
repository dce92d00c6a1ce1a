#include "tunica/analysis/scan_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tunica/mesh/boundary.hpp"

namespace tunica::analysis {

namespace {

constexpr int fill_passes = 200, smooth_passes = 12;
constexpr double least_gap = 10e-3;               // of branches that the map is anchored at [m]
constexpr double allowed_distance = 15e-3;        // by which branches may have moved apart [m]
constexpr double allowed_share = 0.25;            // of their distance
constexpr double allowed_turn = 70 * M_PI / 180;  // of a branch against the one before

double wrapped(double angle) { return std::remainder(angle, 2 * M_PI); }

const Landmark* find(const Anatomy& anatomy, const std::string& name) {
  const auto found = std::find_if(anatomy.landmarks.begin(), anatomy.landmarks.end(),
                                  [&](const Landmark& l) { return l.name == name; });
  return found == anatomy.landmarks.end() ? nullptr : &*found;
}

std::vector<std::pair<const Landmark*, const Landmark*>> common(const Anatomy& first, const Anatomy& second) {
  std::vector<std::pair<const Landmark*, const Landmark*>> pairs;
  for (const auto& l : first.landmarks)
    if (const auto* other = find(second, l.name)) pairs.emplace_back(&l, other);
  return pairs;
}

/// Value at x of the line through the knots; beyond them straight on with this slope.
double interpolate(const std::vector<double>& x, const std::vector<double>& y, double at, double slope_beyond) {
  if (at <= x.front()) return y.front() + slope_beyond * (at - x.front());
  if (at >= x.back()) return y.back() + slope_beyond * (at - x.back());
  const auto k = static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), at) - x.begin());
  return y[k - 1] + (y[k] - y[k - 1]) * (at - x[k - 1]) / (x[k] - x[k - 1]);
}

/// A direction in the mouth of a branch has no wall.
bool in_mouth(const Anatomy& anatomy, const AortaSection& section, double s, double angle) {
  constexpr double least_share = 0.4;  // of the mean thickness
  const double thickness = anatomy.outer_radius(s, angle) - anatomy.inner_radius(s, angle);
  return anatomy.wall && thickness < least_share * section.wall_thickness;
}

/// Entries to the mean of their neighbours and themselves, weights 1 4 1 in both directions; only unknown ones, which
/// do not count themselves, with `fill`.
void relax(std::vector<std::vector<double>>& grid, const std::vector<std::vector<std::uint8_t>>& known, bool fill) {
  const auto old = grid;
  const std::size_t rows = grid.size(), columns = grid[0].size();
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t c = 0; c < columns; ++c) {
      if (fill && known[r][c] != 0) continue;
      const double around = old[r == 0 ? 0 : r - 1][c] + old[std::min(r + 1, rows - 1)][c] + old[r][(c + 1) % columns] +
                            old[r][(c + columns - 1) % columns];
      grid[r][c] = fill ? around / 4 : (4 * old[r][c] + around) / 8;
    }
}

}  // namespace

ScanMap::ScanMap(const Anatomy& from, const Anatomy& to) : from_(&from), to_(&to) {
  for (const auto& [a, b] : common(from, to)) {
    const bool near = !anchors_.empty() && (a->s < from_arcs_.back() + least_gap || b->s < to_arcs_.back() + least_gap);
    if (near) continue;
    const double turn = wrapped(b->angle - a->angle);
    turns_.push_back(turns_.empty() ? turn : turns_.back() + wrapped(turn - turns_.back()));
    anchors_.push_back(a->name);
    from_arcs_.push_back(a->s);
    to_arcs_.push_back(b->s);
  }
  if (anchors_.empty())
    throw InputError("scans", "have no branch of the aorta in common, and branches are what places are told by",
                     "keep at least one branch in the surfaces, and call it the same in all scans");
  find_stretches();
}

double ScanMap::arc(double s) const { return interpolate(from_arcs_, to_arcs_, s, 1); }
double ScanMap::back(double s) const { return interpolate(to_arcs_, from_arcs_, s, 1); }
double ScanMap::turn(double s) const { return interpolate(from_arcs_, turns_, s, 0); }

void ScanMap::find_stretches() {
  const double step = 2 * M_PI / section_directions;
  std::vector<std::vector<std::uint8_t>> known;
  for (const auto& section : from_->sections) {
    auto& row = stretches_.emplace_back(static_cast<std::size_t>(section_directions), 1.0);
    auto& known_row = known.emplace_back(static_cast<std::size_t>(section_directions), 1);
    const double s = arc(section.s);
    for (int d = 0; d < section_directions; ++d) {
      const double angle = d * step, there = angle + turn(section.s);
      const auto k = static_cast<std::size_t>(d);
      row[k] = to_->inner_radius(s, there) / from_->inner_radius(section.s, angle);
      if (in_mouth(*from_, section, section.s, angle) || in_mouth(*to_, to_->at(s), s, there)) known_row[k] = 0;
    }
  }
  for (int pass = 0; pass < fill_passes; ++pass) relax(stretches_, known, true);
  for (int pass = 0; pass < smooth_passes; ++pass) relax(stretches_, known, false);
}

double ScanMap::stretch(double s, double angle) const {
  const double step = from_->sections[1].s - from_->sections[0].s;
  const double x = std::clamp(s / step, 0.0, static_cast<double>(stretches_.size() - 1));
  const auto k = std::min(static_cast<std::size_t>(x), stretches_.size() - 2);
  const double t = x - static_cast<double>(k);
  double y = angle / (2 * M_PI) * section_directions;
  y -= section_directions * std::floor(y / section_directions);
  const auto a = static_cast<std::size_t>(y) % section_directions, b = (a + 1) % section_directions;
  const double u = y - std::floor(y);
  const auto in_row = [&](const std::vector<double>& row) { return (1 - u) * row[a] + u * row[b]; };
  return (1 - t) * in_row(stretches_[k]) + t * in_row(stretches_[k + 1]);
}

LineCoordinates ScanMap::coordinates(const LineCoordinates& at) const {
  LineCoordinates there{.s = arc(at.s), .angle = wrapped(at.angle + turn(at.s))};
  const double inner = from_->inner_radius(at.s, at.angle), edge = inner * stretch(at.s, at.angle);
  if (at.radius <= inner) {
    there.radius = at.radius * edge / inner;
    return there;
  }
  const double wall = from_->at(at.s).wall_thickness, new_wall = to_->at(there.s).wall_thickness;
  there.radius = edge + (at.radius - inner) * (wall > 0 && new_wall > 0 ? new_wall / wall : 1);
  return there;
}

std::array<double, 2> ScanMap::range() const {
  return {std::max(0.0, back(0)), std::min(from_->line.length(), back(to_->line.length()))};
}

std::vector<Problem> check_match(const Anatomy& first, const Anatomy& second, const std::string& where,
                                 const std::string& name_of_first) {
  std::vector<Problem> problems;
  const std::string remedy =
      fmt::format("is it a scan of the same patient as {}, and are its branches named alike?", name_of_first);
  const auto miss = [&](const Anatomy& in, const Anatomy& other, const std::string& a, const std::string& b) {
    for (const auto& l : in.landmarks)
      if (!find(other, l.name))
        problems.push_back({where, fmt::format("{} leaves the aorta in {} and not in {}", l.name, a, b),
                            "give both the same openings with the same names, and `post.end` the same one"});
  };
  miss(first, second, name_of_first, "this scan");
  miss(second, first, "this scan", name_of_first);
  const auto pairs = common(first, second);
  for (std::size_t k = 1; k < pairs.size(); ++k)
    for (std::size_t i = 0; i < k; ++i) {
      const auto& [a, b] = pairs[i];
      const auto& [c, d] = pairs[k];
      const double before = norm(c->place - a->place), after = norm(d->place - b->place);
      if (std::abs(after - before) > std::max(allowed_distance, allowed_share * before))
        problems.push_back({where,
                            fmt::format("the mouths of {} and {} are {:.0f} mm apart, and {:.0f} mm in {}", a->name,
                                        c->name, 1e3 * after, 1e3 * before, name_of_first),
                            remedy});
      if (c->s - a->s > least_gap && d->s < b->s)
        problems.push_back({where,
                            fmt::format("{} leaves before {}, and {:.0f} mm after it in {}", c->name, a->name,
                                        1e3 * (c->s - a->s), name_of_first),
                            remedy});
      const double turn = wrapped((d->angle - b->angle) - (c->angle - a->angle));
      if (i + 1 == k && std::abs(turn) > allowed_turn)
        problems.push_back({where,
                            fmt::format("{} leaves {:.0f} degrees further about the aorta, against {}, than in {}",
                                        c->name, turn * 180 / M_PI, a->name, name_of_first),
                            remedy + " Is one of the surfaces mirrored?"});
    }
  return problems;
}

Folds count_folds(const mesh::MeshData& data, const Anatomy& from, const ScanMap& map) {
  const auto range = map.range();
  std::vector<std::uint8_t> reached(data.points.size(), 0);
  std::vector<Vec3<double>> points(data.points);
  for (std::size_t n = 0; n < points.size(); ++n) {
    const auto& at = from.nodes[n];
    if (std::isinf(at.radius) || at.s < range[0] || at.s > range[1]) continue;
    reached[n] = 1;
    points[n] = map.point(at);
  }
  Folds folds{.least_jacobian = std::numeric_limits<double>::infinity()};
  for (std::size_t e = 0; e < data.tetrahedra.size(); ++e) {
    const auto& t = data.tetrahedra[e];
    const auto is_reached = [&](std::int64_t node) { return reached[static_cast<std::size_t>(node)] != 0; };
    if (from.in_aorta[e] == 0 || !std::all_of(t.begin(), t.end(), is_reached)) continue;
    const double quotient = mesh::volume(points, t) / mesh::volume(data.points, t);
    ++folds.elements;
    if (!(quotient > 0)) ++folds.folded;
    folds.least_jacobian = std::min(folds.least_jacobian, quotient);
  }
  return folds;
}

}  // namespace tunica::analysis
