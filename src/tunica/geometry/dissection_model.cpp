#include "tunica/geometry/dissection_model.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tunica::geometry {

namespace {

constexpr double pi = std::numbers::pi, far = 1.0;  // m

/// std::hypot without its care for overflow, which takes most of the time of a label.
double length_of(double x, double y) { return std::sqrt(x * x + y * y); }

/// Union and intersection of two bodies, the edge between them replaced by an arc of radius r.
double rounded_union(double a, double b, double r) {
  if (std::max(a, b) >= r) return std::min(a, b);
  return std::max(r, std::min(a, b)) - length_of(r - a, r - b);
}
double rounded_intersection(double a, double b, double r) { return -rounded_union(-a, -b, r); }

/// Fillet of the outer surface that lies parallel to the one of the lumen.
double outer_fillet(double fillet, double thickness) { return std::max(fillet - thickness, 0.8 * mm); }

double smooth_step(double x) {
  x = std::clamp(x, 0.0, 1.0);
  return x * x * (3 - 2 * x);
}

Centreline make_centreline(const AortaShape& a) {
  // x to the left, y to the back, z to the head. The aorta rises, arches back and to the left, and descends.
  const Point up{{0, 0, 1}};
  const Point back{{std::cos(a.arch_direction), std::sin(a.arch_direction), 0}};
  const Point out = -1.0 * back;
  Centreline line({{{0, 0, 0}}, up, out, cross(up, out)});
  line.append(a.ascending_length);
  line.append(a.arch_bend_radius * a.arch_angle, a.arch_angle, pi);
  // e1 has turned from the front to the back; the descending aorta bends forward again.
  line.append(a.descending_length, a.descending_bend, pi);
  return line;
}

double aorta_radius_at(const ParametricDissection& shape, double s) {
  const auto& a = shape.aorta;
  const auto& f = shape.flap;
  const double knots[][2] = {{a.ascending_length, a.ascending_radius},
                             {f.start, a.arch_radius},
                             {f.start + f.taper, a.dissected_radius},
                             {f.start + f.length - f.taper, a.dissected_radius},
                             {f.start + f.length, 0.5 * (a.dissected_radius + a.abdominal_radius)},
                             {shape.length(), a.abdominal_radius}};
  if (s <= knots[0][0]) return knots[0][1];
  for (std::size_t k = 1; k < std::size(knots); ++k)
    if (s <= knots[k][0])
      return std::lerp(knots[k - 1][1], knots[k][1],
                       smooth_step((s - knots[k - 1][0]) / (knots[k][0] - knots[k - 1][0])));
  return a.abdominal_radius;
}

/// 1 where the flap has its full distance from the wall, 0 where it has joined it.
double flap_weight(const FlapShape& f, double s) {
  return smooth_step((s - f.start) / f.taper) * smooth_step((f.start + f.length - s) / f.taper);
}

double flap_turn(const FlapShape& f, double s) {
  return f.true_lumen_direction + 2 * pi * f.turns * (s - f.start) / f.length;
}

}  // namespace

DissectionModel::DissectionModel(const ParametricDissection& shape)
    : shape_(shape),
      centreline_(make_centreline(shape.aorta)),
      radius_(centreline_.length(), [&](double s) { return aorta_radius_at(shape, s); }),
      weight_(centreline_.length(), [&](double s) { return flap_weight(shape.flap, s); }) {
  offset_ = find_offset();
  const auto stretch = [&](const TearShape& tear) {
    const Frame a = centreline_.frame(tear.position - mm), b = centreline_.frame(tear.position + mm);
    const auto at = [&](const Frame& f, double s) {
      const double turn = flap_turn(shape_.flap, s), n = offset_ + shape_.flap.bow, m = tear.across;
      return f.origin + (n * std::cos(turn) - m * std::sin(turn)) * f.e1 +
             (n * std::sin(turn) + m * std::cos(turn)) * f.e2;
    };
    return norm(at(b, tear.position + mm) - at(a, tear.position - mm)) / (2 * mm);
  };
  entry_stretch_ = stretch(shape_.flap.entry);
  exit_stretch_ = stretch(shape_.flap.exit);

  const double length = centreline_.length();
  const Frame first = centreline_.frame(0), last = centreline_.frame(length);
  openings_.push_back(
      {"inlet", first.origin, -1.0 * first.tangent, aorta_radius(0), aorta_radius(0) + shape_.aorta.wall_thickness});
  for (const auto& [name, branch] : shape_.branches()) {
    const Frame f = centreline_.frame(branch.position);
    const Point away = std::cos(branch.angle) * f.e1 + std::sin(branch.angle) * f.e2;
    const Point axis = std::cos(branch.inclination) * away + std::sin(branch.inclination) * f.tangent;
    add_tube(name, f.origin, axis, branch.length + aorta_radius(branch.position) / std::cos(branch.inclination),
             branch.radius, branch.wall_thickness);
  }
  if (shape_.iliacs) {
    // Left and right are along x, whatever the direction of the arch.
    const Point left{{1, 0, 0}};
    Point aside = left - dot(left, last.tangent) * last.tangent;
    aside = (1 / norm(aside)) * aside;
    for (const double sign : {1.0, -1.0}) {
      const Point axis = std::cos(shape_.iliacs->angle) * last.tangent + sign * std::sin(shape_.iliacs->angle) * aside;
      add_tube(sign > 0 ? "left_iliac" : "right_iliac", last.origin, axis, shape_.iliacs->length + aorta_radius(length),
               shape_.iliacs->radius, shape_.iliacs->wall_thickness);
    }
  } else {
    openings_.push_back({"abdominal_aorta", last.origin, last.tangent, aorta_radius(length),
                         aorta_radius(length) + shape_.aorta.wall_thickness});
  }
  find_box();
}

void DissectionModel::add_tube(const std::string& name, const Point& origin, const Point& axis, double length,
                               double radius, double wall_thickness) {
  tubes_.push_back({origin, axis, length, radius, wall_thickness});
  openings_.push_back({name, origin + length * axis, axis, radius, radius + wall_thickness});
}

void DissectionModel::find_box() {
  box_ = {{{1e9, 1e9, 1e9}}, {{-1e9, -1e9, -1e9}}};
  const auto cover = [&](const Point& p, double reach) {
    for (int i = 0; i < 3; ++i) {
      box_.low[i] = std::min(box_.low[i], p[i] - reach);
      box_.high[i] = std::max(box_.high[i], p[i] + reach);
    }
  };
  for (double s = 0; s <= centreline_.length(); s += mm)
    cover(centreline_.frame(s).origin, aorta_radius(s) + shape_.aorta.wall_thickness + 3 * mm);
  for (const auto& o : openings_) cover(o.centre, o.outer_radius + 3 * mm);
}

double DissectionModel::share_of_true_lumen(double offset, double bow) const {
  constexpr int strips = 400;
  const double R = shape_.aorta.dissected_radius;
  double area = 0;
  for (int k = 0; k < strips; ++k) {
    const double m = R * ((k + 0.5) / strips * 2 - 1), top = std::sqrt(R * R - m * m);
    area += top - std::clamp(offset + bow * (1 - m * m / (R * R)), -top, top);
  }
  return area * 2 * R / strips / (pi * R * R);
}

double DissectionModel::find_offset() const {
  double low = -shape_.aorta.dissected_radius, high = -low;
  for (int k = 0; k < 50; ++k) {
    const double middle = 0.5 * (low + high);
    (share_of_true_lumen(middle, shape_.flap.bow) > shape_.flap.true_lumen_share ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double DissectionModel::tear_rim(const TearShape& tear, double s, double m, double stretch) const {
  const double b = std::sqrt(tear.area / (pi * tear.aspect)), a = tear.aspect * b;
  const double u = (s - tear.position) * stretch, v = m - tear.across;
  const double k0 = length_of(u / a, v / b), k1 = length_of(u / (a * a), v / (b * b));
  return k1 > 0 ? k0 * (k0 - 1) / k1 : -b;
}

DissectionModel::Sheet DissectionModel::sheet(const Centreline::Closest& c, double radius) const {
  const auto& f = shape_.flap;
  if (c.s < f.start || c.s > f.start + f.length) return {far, far, far, 0};
  const double turn = flap_turn(f, c.s), cosine = std::cos(turn), sine = std::sin(turn);
  const double n = c.x1 * cosine + c.x2 * sine, m = c.x2 * cosine - c.x1 * sine;
  const auto [w, w_slope] = weight_.at(c.s);
  const double joined = -(radius + f.thickness);
  const double bow = f.bow * w, bent = bow * m * m / (radius * radius);
  const double middle = joined + w * (offset_ - joined) + bow - bent;
  // The sheet is level set, not distance: its slopes across and along the vessel are divided out.
  const double slope_m = -2 * bow * m / (radius * radius);
  const double slope_s = w_slope * (offset_ - joined + f.bow) - 2 * pi * f.turns / f.length * m;
  const double side = (n - middle) / std::sqrt(1 + slope_m * slope_m + slope_s * slope_s);
  const double rim = std::min(tear_rim(f.entry, c.s, m, entry_stretch_), tear_rim(f.exit, c.s, m, exit_stretch_));
  return {rounded_intersection(std::abs(side) - 0.5 * f.thickness, -rim, f.rim_fillet), rim, side, w};
}

double DissectionModel::clot_thickness(double s) const {
  if (!shape_.thrombus) return 0;
  const auto& t = *shape_.thrombus;
  return t.thickness * smooth_step((s - t.start) / t.taper) * smooth_step((t.start + t.length - s) / t.taper);
}

void DissectionModel::join_tubes(const Point& p, double beyond, Values& v) const {
  const double fillet = shape_.aorta.branch_fillet;
  double nearest = far;
  for (std::size_t b = 0; b < tubes_.size(); ++b) {
    const Tube& tube = tubes_[b];
    const Point d = p - tube.origin;
    const double along = dot(d, tube.axis);
    const double reach = tube.radius + tube.wall_thickness + fillet;
    const double base = std::min(along, 0.0), squared = dot(d, d) - along * along + base * base;
    if (along > tube.length + beyond || squared > reach * reach) continue;
    const double lumen = std::sqrt(std::max(0.0, squared)) - tube.radius, outer = lumen - tube.wall_thickness;
    if (lumen < v.lumen && lumen < nearest) {
      nearest = lumen;
      v.branch = static_cast<int>(b);
      v.thickness = tube.wall_thickness;
    }
    v.lumen = rounded_union(v.lumen, lumen, fillet);
    v.outer = rounded_union(v.outer, outer, outer_fillet(fillet, tube.wall_thickness));
  }
}

DissectionModel::Values DissectionModel::at(const Point& p, double beyond) const {
  const auto c = centreline_.closest(p);
  const double radius = radius_.at(c.s).value;
  const bool past_cut = c.beyond > 0 && (c.s == 0 || !shape_.iliacs), cut = past_cut && c.beyond > beyond;
  Values v{far, far, far, far, far, far, shape_.aorta.wall_thickness, -1};
  Sheet sheet_values{far, far, far, 0};
  double clot = far, thick = 0;
  if (!cut) {
    v.lumen = (past_cut ? std::hypot(c.x1, c.x2) : c.distance) - radius;
    // Away from the aorta only branches matter.
    if (v.lumen < 2 * shape_.aorta.branch_fillet + shape_.aorta.wall_thickness) {
      sheet_values = sheet(c, radius);
      const double thin =
          sheet_values.weight * smooth_step(0.5 - sheet_values.side / (6 * mm));  // over the false lumen
      v.thickness = std::lerp(shape_.aorta.wall_thickness, shape_.flap.false_lumen_wall_thickness, thin);
      thick = clot_thickness(c.s);
      // In the false lumen, down to this depth from the wall.
      if (thick > 0) clot = std::max(-v.lumen - thick, sheet_values.side);
    }
    v.outer = v.lumen - v.thickness;
  }
  v.flap = sheet_values.flap;
  v.tear = sheet_values.tear;
  v.side = sheet_values.side;
  join_tubes(p, beyond, v);
  if (v.flap < far) {
    if (v.flap < std::abs(v.lumen)) v.thickness = shape_.flap.thickness;
    v.lumen = rounded_intersection(v.lumen, -v.flap, shape_.flap.corner_fillet);
  }
  v.vessel = v.lumen;
  if (clot < far) {
    v.lumen = rounded_intersection(v.lumen, -clot, std::min(shape_.flap.corner_fillet, 0.5 * thick));
  }
  return v;
}

DissectionModel::Axes DissectionModel::aorta_axes(const Point& p) const {
  const auto c = centreline_.closest(p);
  const Frame frame = centreline_.frame(c.s);
  const double radius = radius_.at(c.s).value, inside = radius - c.distance;
  const auto side = [&](const Point& q) {
    const auto near = centreline_.closest(q);
    return sheet(near, radius_.at(near.s).value).side;
  };
  const double here = side(p);
  Axes axes{{}, frame.tangent, 0};
  if (here < far && inside > 0 && std::abs(here) < inside) {
    constexpr double step = 1e-5;
    for (int i = 0; i < 3; ++i) {
      Point before = p, after = p;
      before[i] -= step;
      after[i] += step;
      axes.normal[i] = (side(after) - side(before)) / (2 * step);
    }
    axes.clear = inside;
  } else {
    axes.normal = c.x1 * frame.e1 + c.x2 * frame.e2 - radius_.at(c.s).slope * c.distance * frame.tangent;
    axes.clear = std::max(0.0, here < far ? std::abs(here) - 0.5 * shape_.flap.thickness : far);
  }
  // Beyond the end of the centreline, where the iliac arteries part, there is no direction along the vessel.
  if (c.beyond > 0) axes.clear = 0;
  return axes;
}

DissectionModel::Axes DissectionModel::axes(const Point& p) const {
  Axes axes = aorta_axes(p);
  const auto c = centreline_.closest(p);
  const double from_aorta = c.distance - radius_.at(c.s).value;
  double nearest = std::max(from_aorta, 0.0);
  for (const Tube& tube : tubes_) {
    const Point d = p - tube.origin;
    const double along = std::clamp(dot(d, tube.axis), 0.0, tube.length);
    const Point away = d - along * tube.axis;
    const double from_tube = norm(away) - tube.radius;
    if (from_tube < nearest) {  // a wall belongs to the lumen that it is nearest to
      nearest = std::max(from_tube, 0.0);
      axes = {away, tube.axis, std::max(0.0, from_aorta)};
    } else {
      axes.clear = std::min(axes.clear, std::max(0.0, from_tube));
    }
  }
  axes.normal = (1 / norm(axes.normal)) * axes.normal;
  axes.longitudinal = axes.longitudinal - dot(axes.longitudinal, axes.normal) * axes.normal;
  axes.longitudinal = (1 / norm(axes.longitudinal)) * axes.longitudinal;
  return axes;
}

int DissectionModel::label(const Point& p) const {
  const Values v = at(p);
  return v.outer >= 0 ? outside_label : v.lumen < 0 ? lumen_label : wall_label;
}

double DissectionModel::outside_aorta(const Point& p) const {
  const auto c = centreline_.closest(p);
  return c.distance - radius_.at(c.s).value - shape_.aorta.wall_thickness;
}

double DissectionModel::flap_half_width(double s) const {
  const double R = aorta_radius(s), w = weight_.at(s).value, joined = -(R + shape_.flap.thickness);
  const double middle = joined + w * (offset_ - joined);
  return middle > -R && middle < R ? std::sqrt(R * R - middle * middle) : 0;
}

DissectionModel::Depths DissectionModel::depths(double s) const {
  const double R = aorta_radius(s), w = weight_.at(s).value, joined = -(R + shape_.flap.thickness);
  const double middle = joined + w * (offset_ + shape_.flap.bow - joined), half = 0.5 * shape_.flap.thickness;
  return {R - middle - half, R + middle - half};
}

}  // namespace tunica::geometry
