#include "disturbed_labels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tunica/imaging/distance.hpp"
#include "tunica/imaging/gaussian.hpp"
#include "tunica/imaging/synthetic_scan.hpp"

namespace tunica::imaging::trials {

namespace {

double from(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

geometry::ParametricDissection random_shape(std::mt19937& random) {
  using geometry::mm;
  geometry::ParametricDissection shape;
  shape.aorta.descending_length = 130 * mm;
  shape.flap.start = from(random, 160, 170) * mm;
  shape.flap.length = 115 * mm;
  shape.flap.taper = 25 * mm;
  shape.flap.thickness = from(random, 1.6, 2.1) * mm;
  shape.flap.turns = from(random, 0.1, 0.4);
  shape.flap.entry.position = shape.flap.start + from(random, 34, 38) * mm;
  shape.flap.exit.position = shape.flap.start + from(random, 77, 81) * mm;
  shape.flap.entry.area = from(random, 90, 180) * mm * mm;
  shape.flap.exit.area = from(random, 70, 150) * mm * mm;
  return shape;
}

Disturbed undisturbed(const Body& body, double voxel) {
  Disturbed result{scan(body.model, {.voxel = voxel, .blur = 0, .noise = 0}), {}, Right::mesh, {}};
  result.settings.labels = {scan_true_lumen, scan_false_lumen};
  for (const auto& o : body.model.openings()) result.settings.openings.push_back({o.name, {o.centre, {}}});
  result.what = fmt::format("voxels of {:.2f} mm", 1e3 * voxel);
  return result;
}

double usual_voxel(std::mt19937& random) { return from(random, 0.7e-3, 0.9e-3); }

template <class Change>
void for_each_voxel(Disturbed& d, const Change& change) {
  for (std::int64_t i = 0; i < d.image.frame.count(); ++i)
    change(d.image.labels[i], d.image.frame.place(d.image.frame.voxel(i)), i);
}

/// Moves the border of the lumen by noise of `deviation` voxels, correlated over `length` voxels.
void add_noise(Disturbed& d, const Body& body, double deviation, double length, std::mt19937& random) {
  const auto& frame = d.image.frame;
  VoxelSet lumen;
  for (const auto label : d.image.labels) lumen.push_back(label != 0);
  const auto distance = signed_distance(frame, lumen);
  std::normal_distribution<float> normal;
  std::vector<float> noise(lumen.size());
  for (auto& n : noise) n = normal(random);
  blur(frame, length, noise);
  double square = 0;
  for (const auto n : noise) square += double{n} * n;
  const double scale = deviation * frame.largest_spacing() / std::sqrt(square / static_cast<double>(noise.size()));
  for_each_voxel(d, [&](std::int16_t& label, const Point& p, std::int64_t i) {
    if (distance[i] + scale * noise[i] >= 0)
      label = 0;
    else if (label == 0)
      label = body.model.at(p).side > 0 ? scan_true_lumen : scan_false_lumen;
  });
  d.what += fmt::format(", noise of {:.2f} voxels over {:.1f}", deviation, length);
}

/// Every k-th slice along an axis.
void take_slices(Disturbed& d, int axis, std::int64_t every) {
  const auto old = d.image;
  auto& frame = d.image.frame;
  frame.size[axis] = (old.frame.size[axis] - 1) / every + 1;
  frame.steps[axis] = static_cast<double>(every) * old.frame.steps[axis];
  d.image.labels.clear();
  for (std::int64_t i = 0; i < frame.count(); ++i) {
    auto v = frame.voxel(i);
    v[axis] *= every;
    d.image.labels.push_back(old.labels[old.frame.index(v[0], v[1], v[2])]);
  }
  d.what += fmt::format(", slices of {:.1f} mm across axis {}", 1e3 * norm(frame.steps[axis]), axis + 1);
}

/// A place in the flap, away from its edges and the tears.
Point place_in_flap(const Body& body, const LabelImage& image, std::mt19937& random) {
  std::uniform_int_distribution<std::int64_t> any(0, image.frame.count() - 1);
  for (;;) {
    const auto p = image.frame.place(image.frame.voxel(any(random)));
    const auto v = body.model.at(p);
    if (v.flap < -0.3 * body.shape.flap.thickness && v.tear > 6e-3 && std::abs(v.side) < 0.4e-3) {
      // With blood on both sides.
      int sides = 0;
      for (int axis = 0; axis < 3; ++axis)
        for (const double step : {-2.5e-3, 2.5e-3}) {
          auto q = p;
          q[axis] += step;
          sides |= body.model.at(q).lumen < 0 ? (body.model.at(q).side > 0 ? 1 : 2) : 0;
        }
      if (sides == 3) return p;
    }
  }
}

void open_flap(Disturbed& d, const Body& body, const Point& centre, double radius) {
  for_each_voxel(d, [&](std::int16_t& label, const Point& p, std::int64_t) {
    if (label == 0 && norm(p - centre) < radius) label = body.model.at(p).side > 0 ? scan_true_lumen : scan_false_lumen;
  });
}

bool in_flap(const Body& body, const Point& p) {
  const auto v = body.model.at(p);
  return v.flap < 0 && v.outer < 0 && std::abs(v.side) < 0.7 * body.shape.flap.thickness;
}

/// All of the flap becomes lumen of its nearer side.
void take_flap_away(Disturbed& d, const Body& body) {
  for_each_voxel(d, [&](std::int16_t& label, const Point& p, std::int64_t) {
    if (label == 0 && in_flap(body, p)) label = body.model.at(p).side > 0 ? scan_true_lumen : scan_false_lumen;
  });
}

void thin_flap(Disturbed& d, const Body& body) {
  const auto before = d.image.labels;
  take_flap_away(d, body);
  const auto full = d.image.labels;
  for (std::int64_t i = 0; i < d.image.frame.count(); ++i) {
    if (before[i] != 0 || full[i] != scan_false_lumen) continue;
    bool touches = false;
    for_each_neighbour(d.image.frame, i, [&](std::int64_t other, const Size3& step) {
      touches |= full[other] == scan_true_lumen && std::abs(step[0]) + std::abs(step[1]) + std::abs(step[2]) <= 2;
    });
    if (touches) d.image.labels[i] = 0;
  }
  d.what += ", flap one voxel thin";
}

enum class End { round, ragged, oblique };

void change_ends(Disturbed& d, const Body& body, End kind, std::mt19937& random) {
  for (const auto& o : body.model.openings()) {
    const double height = kind == End::round ? 0.6 * o.lumen_radius : 4 * d.image.frame.largest_spacing();
    const Vec3<double> any{{from(random, -1, 1), from(random, -1, 1), from(random, -1, 1)}};
    auto across = any - dot(any, o.normal) * o.normal;
    across = (1 / norm(across)) * across;
    for_each_voxel(d, [&](std::int16_t& label, const Point& p, std::int64_t) {
      if (label == 0) return;
      const auto way = p - o.centre;
      const double depth = -dot(way, o.normal), off = norm(way + depth * o.normal);
      if (off > o.lumen_radius + 2e-3 || depth > 3 * o.lumen_radius || depth < -1e-3) return;
      double shortened = 0;  // of the vessel here
      if (kind == End::round)
        shortened = height * (1 - std::sqrt(std::max(0.0, 1 - std::pow(off / o.lumen_radius, 2))));
      else if (kind == End::ragged)
        shortened = from(random, 0, height);
      else
        shortened = 1.2 * dot(way, across);  // 50 degrees
      if (depth < shortened) label = 0;
    });
  }
}

Disturbed good(const Body& body, std::mt19937& random) { return undisturbed(body, usual_voxel(random)); }

Disturbed tilted(const Body& body, std::mt19937& random) {
  auto d = undisturbed(body, usual_voxel(random));
  d.image =
      scan(body.model, {.voxel = usual_voxel(random), .blur = 0.8e-3, .noise = 0.1, .tilt = from(random, 0.1, 0.7)});
  d.what = "tilted axes, blur and noise of a scanner";
  return d;
}

Disturbed noise(const Body& body, std::mt19937& random) {
  auto d = undisturbed(body, usual_voxel(random));
  add_noise(d, body, from(random, 0.4, 0.8), from(random, 0.8, 2), random);
  return d;
}

Disturbed slices(const Body& body, std::mt19937& random) {
  auto d = undisturbed(body, from(random, 0.6e-3, 0.8e-3));
  take_slices(d, 2, std::uniform_int_distribution<std::int64_t>(2, 3)(random));
  return d;
}

Disturbed noisy_slices(const Body& body, std::mt19937& random) {
  auto d = undisturbed(body, 0.7e-3);
  add_noise(d, body, 0.4, 1, random);
  take_slices(d, 2, 2);
  return d;
}

Disturbed coarse(const Body& body, std::mt19937& random) { return undisturbed(body, from(random, 1.15e-3, 1.45e-3)); }

Disturbed hole(const Body& body, std::mt19937& random) {
  auto d = undisturbed(body, usual_voxel(random));
  const double radius = from(random, 1, 1.9) * d.image.frame.largest_spacing();
  for (int count = std::uniform_int_distribution<int>(1, 4)(random); count > 0; --count)
    open_flap(d, body, place_in_flap(body, d.image, random), radius);
  d.what += fmt::format(", holes in the flap of radius {:.1f} mm", 1e3 * radius);
  return d;
}

Disturbed islands(const Body& body, std::mt19937& random) {
  auto d = undisturbed(body, usual_voxel(random));
  std::uniform_int_distribution<std::int64_t> any(0, d.image.frame.count() - 1), size(1, 2), label(1, 2);
  for (int n = 0; n < 40; ++n) {
    const auto centre = any(random);
    const auto half = size(random);
    const auto value = static_cast<std::int16_t>(label(random));
    const auto v = d.image.frame.voxel(centre);
    for (std::int64_t k = -half; k <= half; ++k)
      for (std::int64_t j = -half; j <= half; ++j)
        for (std::int64_t i = -half; i <= half; ++i)
          if (d.image.frame.holds(v[0] + i, v[1] + j, v[2] + k)) {
            auto& there = d.image.labels[d.image.frame.index(v[0] + i, v[1] + j, v[2] + k)];
            if (there == 0 && !in_flap(body, d.image.frame.place(Size3{v[0] + i, v[1] + j, v[2] + k}))) there = value;
          }
  }
  d.what += ", 40 islands";
  return d;
}

Disturbed thin(const Body& body, std::mt19937& random) {
  auto d = undisturbed(body, usual_voxel(random));
  thin_flap(d, body);
  return d;
}

Disturbed no_flap(const Body& body, std::mt19937& random) {
  auto d = undisturbed(body, usual_voxel(random));
  take_flap_away(d, body);
  d.right = Right::error;
  d.what += ", no flap";
  return d;
}

/// The tears are where they are in the body.
Disturbed inserted_flap(const Body& body, std::mt19937& random) {
  auto d = undisturbed(body, usual_voxel(random));
  for (const auto& tear : find_contacts(lumen_mask(d.image, d.settings.labels, 2, [](const std::string&) {}), 10e-6))
    d.settings.flap.tears.push_back({tear.centre, 2 * std::sqrt(tear.area / M_PI)});
  take_flap_away(d, body);
  d.settings.flap.insert = 1.8e-3;
  d.what += ", no flap, one is inserted";
  return d;
}

template <End kind>
Disturbed ends(const Body& body, std::mt19937& random) {
  auto d = undisturbed(body, usual_voxel(random));
  change_ends(d, body, kind, random);
  d.what += kind == End::round ? ", round ends" : kind == End::ragged ? ", ragged ends" : ", oblique ends";
  return d;
}

Disturbed missing_slice(const Body& body, std::mt19937& random) {
  auto d = undisturbed(body, usual_voxel(random));
  const auto count = std::uniform_int_distribution<std::int64_t>(1, 2)(random);
  const auto first = static_cast<std::int64_t>(from(random, 0.25, 0.5) * static_cast<double>(d.image.frame.size[2]));
  for_each_voxel(d, [&](std::int16_t& label, const Point&, std::int64_t i) {
    const auto k = d.image.frame.voxel(i)[2];
    if (k >= first && k < first + count) label = 0;
  });
  d.right = Right::error;
  d.what += fmt::format(", {} slices missing at {}", count, first);
  return d;
}

Disturbed mended_slice(const Body& body, std::mt19937& random) {
  auto d = missing_slice(body, random);
  d.right = Right::mesh;
  d.settings.repairs.asked[static_cast<std::size_t>(Repair::slices)] = true;
  return d;
}

Disturbed bridge(const Body& body, std::mt19937& random) {
  auto d = undisturbed(body, usual_voxel(random));
  const auto& tubes = body.model.tubes();
  const double share = from(random, 0.5, 0.8);
  const auto a = tubes[1].origin + share * tubes[1].length * tubes[1].axis;
  const auto b = tubes[2].origin + share * tubes[2].length * tubes[2].axis;
  for_each_voxel(d, [&](std::int16_t& label, const Point& p, std::int64_t) {
    const double along = std::clamp(dot(p - a, b - a) / dot(b - a, b - a), 0.0, 1.0);
    if (norm(p - a - along * (b - a)) < 1.5 * d.image.frame.largest_spacing() && label == 0) label = scan_true_lumen;
  });
  d.right = Right::error;
  d.what += ", a bridge between two branches";
  return d;
}

Disturbed cut_bridge(const Body& body, std::mt19937& random) {
  auto d = bridge(body, random);
  d.right = Right::mesh;
  d.settings.repairs.asked[static_cast<std::size_t>(Repair::bridges)] = true;
  return d;
}

Disturbed thrombus(const Body& body, std::mt19937& random) {
  auto d = undisturbed(body, usual_voxel(random));
  std::vector<double> heights;  // of the false lumen
  for_each_voxel(d, [&](std::int16_t& label, const Point& p, std::int64_t) {
    if (label == scan_false_lumen) heights.push_back(p[2]);
  });
  std::sort(heights.begin(), heights.end());
  const double height =
      heights[static_cast<std::size_t>(from(random, 0.15, 0.45) * static_cast<double>(heights.size()))];
  for_each_voxel(d, [&](std::int16_t& label, const Point& p, std::int64_t) {
    if (label == scan_false_lumen && p[2] < height) label = 3;
  });
  d.right = Right::error;
  d.what += ", thrombus";
  return d;
}

Disturbed named_thrombus(const Body& body, std::mt19937& random) {
  auto d = thrombus(body, random);
  d.right = Right::mesh;
  d.settings.labels.thrombus = 3;
  d.what += " by name";
  return d;
}

Disturbed swapped(const Body& body, std::mt19937& random) {
  auto d = undisturbed(body, usual_voxel(random));
  std::swap(d.settings.labels.true_lumen, *d.settings.labels.false_lumen);
  d.right = Right::error;
  d.what += ", labels swapped";
  return d;
}

}  // namespace

Body::Body(std::mt19937& random) : shape(random_shape(random)), model(shape) {}

const std::map<std::string, Disturb>& kinds() {
  static const std::map<std::string, Disturb> all = {
      {"good", good},
      {"tilted", tilted},
      {"noise", noise},
      {"slices", slices},
      {"noisy_slices", noisy_slices},
      {"coarse", coarse},
      {"hole", hole},
      {"islands", islands},
      {"thin", thin},
      {"no_flap", no_flap},
      {"inserted_flap", inserted_flap},
      {"round_ends", ends<End::round>},
      {"ragged_ends", ends<End::ragged>},
      {"oblique_ends", ends<End::oblique>},
      {"missing_slice", missing_slice},
      {"mended_slice", mended_slice},
      {"bridge", bridge},
      {"cut_bridge", cut_bridge},
      {"thrombus", thrombus},
      {"named_thrombus", named_thrombus},
      {"swapped", swapped},
  };
  return all;
}

}  // namespace tunica::imaging::trials
