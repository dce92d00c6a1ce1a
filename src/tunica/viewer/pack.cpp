#include "tunica/viewer/pack.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "tunica/base/error.hpp"
#include "tunica/base/units.hpp"
#include "tunica/drawing/page.hpp"

namespace tunica::viewer {

namespace {

using nlohmann::json;
using unit::mm;
constexpr double most_of_uint16 = 65535;

/// Arrays of whole numbers one after the other, each as differences of neighbours, small ones with small bytes, all
/// low bytes before the next ones.
class Store {
 public:
  /// `width`: bytes of a value, of which higher bits are dropped; differences are taken modulo them.
  json add(const std::vector<std::int64_t>& values, int width) {
    const std::uint32_t mask = width == 4 ? 0xFFFFFFFFU : (1U << (8 * width)) - 1, top = 1U << (8 * width - 1);
    const json place = {{"o", bytes_.size()}, {"n", values.size()}, {"w", width}};
    std::vector<std::uint32_t> folded;
    folded.reserve(values.size());
    std::uint32_t before = 0;
    for (const auto v : values) {
      const auto now = static_cast<std::uint32_t>(v) & mask, difference = (now - before) & mask;
      folded.push_back((difference & top ? ~(difference << 1) : difference << 1) & mask);
      before = now;
    }
    for (int b = 0; b < width; ++b)
      for (const auto f : folded) bytes_.push_back(static_cast<unsigned char>(f >> (8 * b)));
    return place;
  }

  std::string deflated() const {
    uLongf size = compressBound(bytes_.size());
    std::vector<std::uint8_t> packed(size);
    if (compress2(packed.data(), &size, bytes_.data(), bytes_.size(), Z_DEFAULT_COMPRESSION) != Z_OK)
      throw SolverError("the view cannot be packed: there is not enough memory");
    packed.resize(size);
    return drawing::page::base64(packed);
  }

 private:
  std::vector<std::uint8_t> bytes_;
};

/// Component after component, so that neighbours are values of one kind; the narrowest width that holds all.
json add_values(Store& store, const std::vector<std::int16_t>& values, int components) {
  const auto n = static_cast<std::size_t>(components);
  std::vector<std::int64_t> sorted;
  sorted.reserve(values.size());
  bool narrow = true;
  for (std::size_t c = 0; c < n; ++c)
    for (std::size_t i = c; i < values.size(); i += n) {
      sorted.push_back(values[i]);
      narrow = narrow && values[i] >= -128 && values[i] <= 127;
    }
  return store.add(sorted, narrow ? 1 : 2);
}

json vector_of(const Vec3<double>& x, double unit) { return {x[0] / unit, x[1] / unit, x[2] / unit}; }

/// Ends of the colours: half a per cent of the values lies beyond each, and the least and the largest of all.
json range_of(const Quantity& q) {
  std::vector<float> values;
  const auto n = static_cast<std::size_t>(q.components);
  for (const auto& frame : q.frames)
    for (std::size_t i = 0; i < frame.size(); i += n) {
      double squares = 0;
      for (std::size_t c = 0; c < n; ++c)
        squares += static_cast<double>(frame[i + c]) * static_cast<double>(frame[i + c]);
      values.push_back(n == 1 ? frame[i] : static_cast<float>(std::sqrt(squares)));
    }
  if (values.empty()) return {0, 1, 0, 1};
  const auto ends = std::minmax_element(values.begin(), values.end());
  const float least = *ends.first, largest = *ends.second;
  const auto at = [&](double share) {
    const auto place = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + place, values.end());
    return values[static_cast<std::size_t>(place)];
  };
  return {at(0.005), at(0.995), least, largest};
}

void refuse_what_is_not_finite(const Body& body, const Quantity& q) {
  for (const auto& frame : q.frames)
    for (const float v : frame)
      if (!std::isfinite(v))
        throw SolverError(
            fmt::format("the view of {} cannot be made: `{}` has values that are not finite; look at the "
                        "fields of the run",
                        body.name, q.name));
}

json packed_quantity(Store& store, const Quantity& q, double tolerance, PackedQuantity& made) {
  const Modes m = find_modes(q.frames, tolerance);
  made.modes = m.modes.size();
  made.compression = m.deviation;
  json modes = json::array();
  for (const auto& mode : m.modes) {
    json weights = json::array();
    for (const double w : mode.weights) weights.push_back(std::round(1e7 * w) / 1e7);
    modes.push_back({{"v", add_values(store, mode.values, q.components)}, {"s", mode.step}, {"c", weights}});
  }
  return {{"name", q.name},
          {"unit", q.unit},
          {"of", q.of},
          {"components", q.components},
          {"first", q.first},
          {"count", q.count},
          {"range", range_of(q)},
          {"mean", add_values(store, m.mean, q.components)},
          {"ms", m.mean_step},
          {"modes", modes},
          {"most", m.deviation.most},
          {"largest", m.deviation.largest}};
}

json packed_shape(Store& store, const Body& body, double step, const Vec3<double>& low) {
  std::vector<std::int64_t> places, nodes;
  for (int c = 0; c < 3; ++c)
    for (const auto& x : body.points) places.push_back(std::lround((x[c] - low[c]) / step));
  for (const auto& t : body.triangles) nodes.insert(nodes.end(), t.begin(), t.end());
  json groups = json::array();
  for (const auto& g : body.groups)
    groups.push_back({{"kind", g.kind}, {"name", g.name}, {"first", 3 * g.first}, {"count", 3 * g.count}});
  return {
      {"name", body.name}, {"points", store.add(places, 2)}, {"triangles", store.add(nodes, 4)}, {"groups", groups}};
}

void corners_of(const std::vector<Body>& bodies, Vec3<double>& low, Vec3<double>& high) {
  low = Vec3<double>{{1e30, 1e30, 1e30}};
  high = (-1.0) * low;
  for (const auto& body : bodies)
    for (const auto& x : body.points)
      for (int c = 0; c < 3; ++c) low[c] = std::min(low[c], x[c]), high[c] = std::max(high[c], x[c]);
}

/// Number of the nearest point for each place: points in the order of x, looked through both ways until x alone is
/// farther than what was found.
std::vector<std::int64_t> nearest_points(const std::vector<Vec3<double>>& points,
                                         const std::vector<Vec3<double>>& places) {
  std::vector<std::int64_t> order(points.size()), nearest;
  std::iota(order.begin(), order.end(), 0);
  const auto x = [&](std::int64_t i) { return points[static_cast<std::size_t>(i)][0]; };
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return x(a) < x(b); });
  for (const auto& place : places) {
    const auto from =
        std::lower_bound(order.begin(), order.end(), place[0], [&](auto i, double v) { return x(i) < v; });
    std::int64_t best = -1;
    double distance = 1e30;
    const auto look = [&](std::int64_t i) {
      if (std::abs(x(i) - place[0]) >= distance) return false;
      if (const double d = norm(points[static_cast<std::size_t>(i)] - place); d < distance) distance = d, best = i;
      return true;
    };
    for (auto i = from; i != order.end() && look(*i); ++i) {
    }
    for (auto i = from; i != order.begin() && look(*(i - 1)); --i) {
    }
    nearest.push_back(best);
  }
  return nearest;
}

constexpr double direction_step = 1.0 / 127;

json packed_lines(Store& store, const Lines& lines, const Body& body, double step, const Vec3<double>& low) {
  std::vector<std::int64_t> places, directions;
  for (int c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < lines.places.size(); ++i) {
      places.push_back(std::lround((lines.places[i][c] - low[c]) / step));
      directions.push_back(std::lround(lines.directions[i][c] / direction_step));
    }
  return {{"name", lines.name},
          {"kind", lines.kind},
          {"region", lines.region},
          {"length", lines.length / mm},
          {"places", store.add(places, 2)},
          {"directions", store.add(directions, 1)},
          {"points", store.add(nearest_points(body.points, lines.places), 4)}};
}

json head_of(const Beat& beat) {
  json labels = json::array(), sections = json::array();
  for (const auto& l : beat.labels)
    labels.push_back({{"text", l.text}, {"kind", l.kind}, {"place", vector_of(l.place, mm)}});
  for (const auto& s : beat.sections)
    sections.push_back({{"name", s.name}, {"centre", vector_of(s.centre, mm)}, {"normal", vector_of(s.normal, 1)}});
  return {{"title", beat.title},
          {"times", beat.times},
          {"labels", labels},
          {"sections", sections},
          {"view", vector_of(beat.view, 1)},
          {"up", vector_of(beat.up, 1)},
          {"start", beat.start}};
}

}  // namespace

PackedBeat pack(Beat beat, const PackOptions& options) {
  PackedBeat packed;
  Store store;
  json head = head_of(beat);
  head["bodies"] = json::array();
  Vec3<double> low, high;
  corners_of(beat.bodies, low, high);
  double size = 1e-6;
  for (int c = 0; c < 3; ++c) size = std::max(size, high[c] - low[c]);
  packed.place_step = size / most_of_uint16;
  head["origin"] = vector_of(low, mm);
  head["step"] = packed.place_step / mm;
  for (auto& body : beat.bodies) {
    for (const auto& q : body.quantities) refuse_what_is_not_finite(body, q);
    const auto simpler = simplify(body, options.most_triangles, options.distance);
    order(body);
    json shape = packed_shape(store, body, packed.place_step, low);
    shape["quantities"] = json::array();
    for (std::size_t k = 0; k < body.quantities.size(); ++k) {
      const auto& q = body.quantities[k];
      PackedQuantity made{
          .body = body.name, .name = q.name, .unit = q.unit, .modes = 0, .compression = {}, .simplification = {}};
      shape["quantities"].push_back(packed_quantity(store, q, options.tolerance, made));
      if (!simpler.deviations.empty()) made.simplification = simpler.deviations[k];
      packed.quantities.push_back(std::move(made));
    }
    head["bodies"].push_back(std::move(shape));
    packed.simplifications.push_back(simpler);
  }
  head["lines"] = json::array();
  for (const auto& lines : beat.lines)
    head["lines"].push_back(packed_lines(store, lines, beat.bodies.front(), packed.place_step, low));
  packed.head = head.dump();
  packed.data = store.deflated();
  return packed;
}

}  // namespace tunica::viewer
