#include "tunica/stages/beat.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

#include "tunica/analysis/cycle.hpp"
#include "tunica/analysis/field_series.hpp"
#include "tunica/artifacts/load_mesh.hpp"
#include "tunica/base/units.hpp"
#include "tunica/geometry/thickness.hpp"
#include "tunica/mesh/boundary.hpp"
#include "tunica/mesh/edge_nodes.hpp"
#include "tunica/mesh/lumen_fields.hpp"
#include "tunica/stages/beat_fibres.hpp"
#include "tunica/stages/vessel_plane.hpp"
#include "tunica/viewer/surface.hpp"

namespace tunica::stages {

namespace {

using mesh::MeshData;
using mesh::RegionKind;
using Names = std::vector<std::string>;
using viewer::PointSource;
using viewer::Quantity;
using viewer::Skeleton;

/// Sections across the aorta that a page holds at most, besides those at tears.
constexpr std::size_t most_sections = 12;

Vec3<double> place_of(const nlohmann::json& centre_mm) {
  return {{unit::mm * centre_mm.at(0).get<double>(), unit::mm * centre_mm.at(1).get<double>(),
           unit::mm * centre_mm.at(2).get<double>()}};
}

// --- planes and labels ----------------------------------------------------------------------------------------------

double area_of(const nlohmann::json& station) {
  double area = 0;
  for (const char* lumen : {"true_lumen", "false_lumen"})
    if (station.contains(lumen)) area += station[lumen].at("area").at("mean_mm2").get<double>() * unit::mm * unit::mm;
  return area;
}

std::vector<viewer::CutPlane> planes_of(const nlohmann::json& post, viewer::Beat& beat) {
  std::vector<viewer::CutPlane> planes;
  if (!post.is_object() || !post.contains("stations")) return planes;
  std::vector<Vec3<double>> centres;
  for (const auto& station : post["stations"]) centres.push_back(place_of(station.at("centre_mm")));
  if (const auto plane = plane_of(centres)) {
    planes.push_back({"along the aorta", plane->centre, plane->normal, 0});
    if (std::abs(plane->normal[2]) > 0.9) beat.up = {{0, 1, 0}};
    beat.view = plane->normal + 0.35 * beat.up;  // a little from above, so that sections across are no lines
  }
  if (centres.size() < 2) return planes;
  const std::size_t every = (centres.size() + most_sections - 1) / most_sections;
  for (std::size_t s = 0; s < centres.size(); s += every) {
    const auto& station = post["stations"][s];
    // A section that is not round reaches farther than a circle of its area.
    const double radius = 1.6 * std::sqrt(area_of(station) / M_PI) + 5 * unit::mm;
    planes.push_back({fmt::format("{:.0f} mm from the inlet", station.at("distance_mm").get<double>()), centres[s],
                      direction_at(centres, s), radius});
  }
  return planes;
}

/// Mean of the lumen's nodes on either side of the flap, in the middle of where both lumens are.
void add_lumen_labels(const MeshData& data, const nlohmann::json& post, viewer::Beat& beat) {
  const auto* side = mesh::values_named(data.node_fields, mesh::lumen_side);
  if (side == nullptr || !post.is_object() || !post.contains("stations")) return;
  std::vector<Vec3<double>> both;
  for (const auto& station : post["stations"])
    if (station.contains("true_lumen") && station.contains("false_lumen"))
      both.push_back(place_of(station.at("centre_mm")));
  if (both.empty()) return;
  const auto& middle = both[both.size() / 2];
  std::array<Vec3<double>, 2> sum{};
  std::array<double, 2> count{};
  for (std::size_t n = 0; n < data.points.size(); ++n) {
    const double value = (*side)[n];
    if (std::isnan(value) || norm(data.points[n] - middle) > 25 * unit::mm) continue;
    const std::size_t lumen = value > 0 ? 0 : 1;
    sum[lumen] = sum[lumen] + data.points[n];
    count[lumen] += 1;
  }
  for (std::size_t lumen = 0; lumen < 2; ++lumen)
    if (count[lumen] > 0)
      beat.labels.push_back({lumen == 0 ? "true lumen" : "false lumen", "lumen", (1 / count[lumen]) * sum[lumen]});
}

std::string shown_name(std::string name) {
  if (name.starts_with("lumen_")) name = name.substr(6);
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

void add_labels(const MeshData& data, const Skeleton& surface, const nlohmann::json& post, viewer::Beat& beat) {
  for (const auto& group : surface.body.groups) {
    if (group.kind != "opening" || group.count == 0) continue;
    Vec3<double> sum{};
    for (std::size_t t = group.first; t < group.first + group.count; ++t)
      for (const auto node : surface.body.triangles[t])
        sum = sum + (1.0 / (3.0 * static_cast<double>(group.count))) * surface.body.points[node];
    beat.labels.push_back({shown_name(group.name), "opening", sum});
  }
  if (post.is_object() && post.contains("tears"))
    for (const auto& tear : post["tears"])
      beat.labels.push_back({(tear.value("entry", false) ? "entry " : "") + shown_name(tear.value("name", "tear")),
                             "tear", place_of(tear.at("centre_mm"))});
  add_lumen_labels(data, post, beat);
}

// --- quantities -----------------------------------------------------------------------------------------------------

float blend(const std::vector<double>& nodal, const PointSource& s, std::size_t components, std::size_t c,
            double unit) {
  const double a = nodal[components * static_cast<std::size_t>(s.a) + c],
               b = nodal[components * static_cast<std::size_t>(s.b) + c];
  return static_cast<float>(((1 - s.t) * a + s.t * b) / unit);
}

/// Volumes of the wall's elements around its nodes, by which values of elements become values of nodes.
class NodalMean {
 public:
  explicit NodalMean(const MeshData& data) : data_(data) {
    for (const auto& t : data.tetrahedra) volumes_.push_back(mesh::volume(data.points, t));
  }
  /// NaN at nodes without an element that has a value.
  std::vector<double> operator()(const std::vector<double>& of_elements) const {
    std::vector<double> sum(data_.points.size(), 0.0), weight(data_.points.size(), 0.0);
    for (const auto& region : data_.regions) {
      if (region.kind != RegionKind::wall) continue;
      for (auto e = static_cast<std::size_t>(region.first_element); e < static_cast<std::size_t>(region.end_element);
           ++e) {
        if (std::isnan(of_elements[e])) continue;
        for (const auto node : data_.tetrahedra[e]) {
          sum[static_cast<std::size_t>(node)] += volumes_[e] * of_elements[e];
          weight[static_cast<std::size_t>(node)] += volumes_[e];
        }
      }
    }
    for (std::size_t n = 0; n < sum.size(); ++n) sum[n] = weight[n] > 0 ? sum[n] / weight[n] : std::nan("");
    return sum;
  }

 private:
  const MeshData& data_;
  std::vector<double> volumes_;
};

/// A quantity of a body that grows frame by frame. One number of a vector is its size.
struct Filled {
  Skeleton* skeleton;
  Quantity quantity;
  const std::vector<PointSource>* sources;
  std::size_t offset;  ///< of the first point's source

  void add(const std::vector<double>& nodal, double unit) {
    const auto n = static_cast<std::size_t>(quantity.components);
    auto& frame = quantity.frames.emplace_back();
    frame.reserve(n * quantity.count);
    for (std::size_t i = 0; i < quantity.count; ++i)
      for (std::size_t c = 0; c < n; ++c) frame.push_back(blend(nodal, (*sources)[offset + i], n, c, unit));
  }
  void add_size(const std::vector<double>& vectors, double unit) {
    auto& frame = quantity.frames.emplace_back();
    frame.reserve(quantity.count);
    for (std::size_t i = 0; i < quantity.count; ++i) {
      const auto component = [&](std::size_t c) { return blend(vectors, (*sources)[offset + i], 3, c, unit); };
      frame.push_back(std::hypot(component(0), component(1), component(2)));
    }
  }
};

Filled of_wall(Skeleton& s, const std::string& name, const std::string& unit) {
  return {&s, {name, unit, "wall", 1, 0, s.wall_end, {}}, &s.wall, 0};
}
Filled of_blood(Skeleton& s, const std::string& name, const std::string& unit) {
  return {&s, {name, unit, "blood", 1, s.blood_first, s.blood_end - s.blood_first, {}}, &s.blood, 0};
}
Filled of_inside(Skeleton& s, const std::string& name, const std::string& unit) {
  return {&s, {name, unit, "inside", 1, s.blood_first, s.inside_end - s.blood_first, {}}, &s.blood, 0};
}

/// All that is collected while the fields are read one after the other.
class Collector {
 public:
  Collector(const MeshData& data, const analysis::RunDescription& run, std::vector<std::string> stresses,
            Skeleton& surface, Skeleton& sections)
      : data_(data), mean_(data), stresses_(std::move(stresses)) {
    for (auto* s : {&surface, &sections}) {
      if (run.wall) displacement_.push_back(motion_of(*s));
      if (run.wall && s->wall_end > 0)
        for (std::size_t q = 0; q < stresses_.size(); ++q) stress_.emplace_back(q, of_wall(*s, stresses_[q], "kPa"));
      if (run.fluid && s->blood_end > s->blood_first) pressure_.push_back(of_blood(*s, "pressure", "mmHg"));
    }
    if (run.fluid && surface.inside_end > surface.blood_first) shear_ = of_inside(surface, "wall shear stress", "Pa");
    if (run.fluid && sections.blood_end > sections.blood_first) velocity_ = of_blood(sections, "velocity", "m/s");
    integrals_.assign(4 * data.points.size(), 0.0);
  }

  void integrate(const analysis::FieldFrame& frame, double weight) {
    if (!shear_) return;
    for (std::size_t n = 0; n < data_.points.size(); ++n) {
      const double* s = frame.wall_shear.data() + 3 * n;
      integrals_[4 * n] += weight * std::sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]);
      for (std::size_t c = 0; c < 3; ++c) integrals_[4 * n + 1 + c] += weight * s[c];
    }
  }

  void keep(const analysis::FieldFrame& frame) {
    for (auto& d : displacement_) d.add(frame.displacement, unit::mm);
    std::vector<std::optional<std::vector<double>>> nodal(stresses_.size());
    for (auto& [q, filled] : stress_) {
      if (!nodal[q]) nodal[q] = mean_(frame.stress[q]);
      filled.add(*nodal[q], unit::kPa);
    }
    for (auto& p : pressure_) p.add(frame.pressure, unit::mmHg);
    if (shear_) shear_->add_size(frame.wall_shear, 1);
    if (velocity_) velocity_->add_size(frame.velocity, 1);
  }

  /// Quantities into the bodies; what some region does not have is left out, with a remark.
  void finish(double duration, std::vector<std::string>& remarks) {
    const auto put = [](Filled& f) { f.skeleton->body.quantities.push_back(std::move(f.quantity)); };
    for (auto& d : displacement_) put(d);
    for (auto& [q, filled] : stress_) {
      const auto& first = filled.quantity.frames.front();
      if (std::any_of(first.begin(), first.end(), [](float v) { return std::isnan(v); })) {
        remarks.push_back(fmt::format("{} is not shown: not every region of the wall has it", stresses_[q]));
        continue;
      }
      put(filled);
    }
    for (auto& p : pressure_) put(p);
    if (shear_) add_shear_figures(duration);
    if (velocity_) put(*velocity_);
  }

 private:
  /// All points move: those of the wall, then those of the blood alone.
  Filled motion_of(Skeleton& s) {
    auto& sources = moving_[&s];
    sources = s.wall;
    sources.insert(sources.end(), s.blood.end() - static_cast<std::ptrdiff_t>(s.body.points.size() - s.wall.size()),
                   s.blood.end());
    return {&s, {"displacement", "mm", "wall", 3, 0, s.body.points.size(), {}}, &sources, 0};
  }

  void add_shear_figures(double duration) {
    auto& body = shear_->skeleton->body;
    std::array<Quantity, 3> cycle = {Quantity{"TAWSS", "Pa", "inside", 1, 0, 0, {{}}},
                                     Quantity{"OSI", "", "inside", 1, 0, 0, {{}}},
                                     Quantity{"RRT", "1/Pa", "inside", 1, 0, 0, {{}}}};
    for (std::size_t i = 0; i < shear_->quantity.count; ++i) {
      const double* s = integrals_.data() + 4 * static_cast<std::size_t>((*shear_->sources)[i].a);
      const auto figures = analysis::shear_figures(s[0], {{s[1], s[2], s[3]}}, duration);
      for (const auto& [k, value] : {std::pair{0, figures.tawss}, {1, figures.osi}, {2, figures.rrt}})
        cycle[static_cast<std::size_t>(k)].frames[0].push_back(static_cast<float>(value));
    }
    limit(cycle[2].frames[0], areas(*shear_));
    body.quantities.push_back(std::move(shear_->quantity));
    for (auto& q : cycle) {
      q.first = body.quantities.back().first;
      q.count = q.frames[0].size();
      body.quantities.push_back(std::move(q));
    }
  }

  /// Of the surface around each point of a quantity, a third of its triangles [m^2].
  static std::vector<double> areas(const Filled& filled) {
    const auto& body = filled.skeleton->body;
    std::vector<double> of_points(body.points.size(), 0.0);
    for (const auto& group : body.groups)
      if (group.kind == "inner")
        for (std::size_t t = group.first; t < group.first + group.count; ++t) {
          const auto& [a, b, c] = body.triangles[t];
          const double third = norm(cross(body.points[b] - body.points[a], body.points[c] - body.points[a])) / 6;
          for (const auto point : {a, b, c}) of_points[point] += third;
        }
    const auto first = of_points.begin() + static_cast<std::ptrdiff_t>(filled.quantity.first);
    return {first, first + static_cast<std::ptrdiff_t>(filled.quantity.count)};
  }

  /// RRT is infinite where the mean stress vanishes: no value beyond that of 99 % of the area is told apart.
  static void limit(std::vector<float>& values, const std::vector<double>& areas) {
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](auto a, auto b) { return values[a] < values[b]; });
    const double whole = std::accumulate(areas.begin(), areas.end(), 0.0);
    double below = 0;
    float most = 0;
    for (const auto k : order) {
      if (!std::isfinite(values[k]) || (below += areas[k]) > 0.99 * whole) break;
      most = values[k];
    }
    for (float& v : values) v = std::isfinite(v) ? std::min(v, most) : most;
  }

  const MeshData& data_;
  NodalMean mean_;
  std::map<const Skeleton*, std::vector<PointSource>> moving_;
  std::vector<std::string> stresses_;
  std::vector<Filled> displacement_, pressure_;
  std::vector<std::pair<std::size_t, Filled>> stress_;
  std::optional<Filled> shear_, velocity_;
  std::vector<double> integrals_;  ///< [node][4], over time of |tau| and of tau [Pa s]
};

/// The wall's surfaces, of triangles of the mesh.
geometry::TriangleSurface surfaces_of_wall(const viewer::Body& body) {
  geometry::TriangleSurface wall;
  wall.points = body.points;
  const std::size_t parts = body.joined.empty() ? 1 : 4;
  for (const auto& group : body.groups)
    if (group.kind == "outer" || group.kind == "inner" || group.kind == "end")
      for (std::size_t t = group.first / parts; t < (group.first + group.count) / parts; ++t) {
        const auto& nodes = parts == 1 ? body.triangles[t] : body.joined[t].corners;
        wall.triangles.push_back({nodes[0], nodes[1], nodes[2]});
      }
  return wall;
}

/// At the points of the wall's surfaces; on edges of quadratic elements the mean of their ends.
void add_thickness(Skeleton& surface) {
  constexpr double most = 10 * unit::mm;
  if (surface.wall_end == 0) return;
  const auto& body = surface.body;
  const geometry::TriangleTree tree(surfaces_of_wall(body));
  const auto normals = geometry::point_normals(tree.surface());
  std::vector<char> between(body.points.size(), 0);
  for (const auto& joined : body.joined)
    for (const auto point : joined.between) between[point] = 1;
  Quantity q{"wall thickness", "mm", "wall", 1, 0, surface.wall_end, {std::vector<float>(surface.wall_end, 0.0F)}};
  auto& values = q.frames[0];
  for (std::size_t i = 0; i < surface.wall_end; ++i)
    if (!between[i])
      values[i] = static_cast<float>(geometry::thickness_at(tree, body.points[i], normals[i], most) / unit::mm);
  for (const auto& joined : body.joined)
    for (std::size_t e = 0; e < 3; ++e)
      if (const auto point = joined.between[e]; point < surface.wall_end)
        values[point] = 0.5F * (values[joined.corners[e]] + values[joined.corners[(e + 1) % 3]]);
  surface.body.quantities.push_back(std::move(q));
}

// --- the whole ------------------------------------------------------------------------------------------------------

struct Window {
  std::size_t first = 0, count = 0;
};

/// Frames of the window of the figures, else all.
Window window_of(const std::vector<double>& times, const nlohmann::json& post) {
  if (!post.is_object() || !post.contains("window")) return {0, times.size()};
  const double from = post["window"].at("from_s").get<double>(), until = post["window"].at("until_s").get<double>();
  const double margin = 1e-6 * (until - from);
  const auto first = std::lower_bound(times.begin(), times.end(), from - margin),
             last = std::upper_bound(times.begin(), times.end(), until + margin);
  if (last - first < 1) return {0, times.size()};
  return {static_cast<std::size_t>(first - times.begin()), static_cast<std::size_t>(last - first)};
}

struct BeatMesh {
  MeshData data;                       ///< of linear elements, by which the fields are read
  std::int64_t corners;                ///< nodes before it was subdivided, which come first
  std::optional<MeshData> whole_wall;  ///< subdivided ones: where the wall is as it was meshed
  const MeshData& to_cut() const { return whole_wall ? *whole_wall : data; }
};

/// The parts of the lumen's elements, by which velocity is seen, and the elements of the wall.
MeshData parts_of_lumen(const MeshData& parts, const std::vector<std::array<std::int64_t, 4>>& meshed) {
  MeshData data;
  data.points = parts.points;
  for (auto region : parts.regions) {
    const bool whole = region.kind == RegionKind::wall;
    const auto& from = whole ? meshed : parts.tetrahedra;
    const auto shrunk = [&](std::int64_t element) { return whole ? element / 8 : element; };
    const auto first = from.begin() + shrunk(region.first_element), end = from.begin() + shrunk(region.end_element);
    region.first_element = std::ssize(data.tetrahedra);
    data.tetrahedra.insert(data.tetrahedra.end(), first, end);
    region.end_element = std::ssize(data.tetrahedra);
    data.regions.push_back(region);
  }
  return data;
}

/// With the lines of the fibres, which are of the elements as they were meshed.
BeatMesh mesh_of(const case_file::Case& c, viewer::Beat& beat) {
  const bool has_frame = c.wall && c.wall->fibre_frame;
  MeshData data = artifacts::load_meshes(c.meshes, has_frame ? wall::frame_arrays(*c.wall->fibre_frame) : Names{}).data;
  if (has_frame) beat.lines = fibre_lines(*c.wall, data);
  data.fields.clear();
  const auto corners = std::ssize(data.points);
  if (c.elements != case_file::Elements::quadratic) return {std::move(data), corners, std::nullopt};
  mesh::add_edge_nodes(data);
  MeshData parts = mesh::subdivided(data);
  MeshData whole_wall = parts_of_lumen(parts, data.tetrahedra);
  return {std::move(parts), corners, std::move(whole_wall)};
}

viewer::FaceRoles roles_of(const case_file::Case& c) {
  viewer::FaceRoles roles;
  for (const auto& [lumen, wall] : case_file::interface_pairs(c.meshes)) {
    roles.lumen_interface.insert(lumen);
    roles.wall_interface.insert(wall);
  }
  const auto run = case_file::describe(c);
  roles.sticking.insert(run.sticking_faces.begin(), run.sticking_faces.end());
  return roles;
}

void read_frames(analysis::FieldSeries& series, const nlohmann::json& post, Collector& collector, viewer::Beat& beat) {
  const auto window = window_of(series.times(), post);
  const std::vector<double> times(series.times().begin() + static_cast<std::ptrdiff_t>(window.first),
                                  series.times().begin() + static_cast<std::ptrdiff_t>(window.first + window.count));
  const auto weights = analysis::trapezoid_weights(times);
  const std::size_t every = (times.size() + most_frames - 1) / most_frames;
  const double peak = post.is_object() ? post.value("peak_s", times.front()) : times.front();
  for (std::size_t k = 0; k < times.size(); ++k) {
    const auto frame = series.read(window.first + k);
    collector.integrate(frame, weights[k]);
    if (k % every != 0) continue;
    collector.keep(frame);
    if (std::abs(times[k] - peak) < std::abs((beat.times.empty() ? 1e30 : beat.times[beat.start]) - peak))
      beat.start = beat.times.size();
    beat.times.push_back(times[k]);
  }
  if (every > 1) beat.remarks.push_back(fmt::format("every {}th of {} fields is shown", every, times.size()));
  collector.finish(times.back() - times.front(), beat.remarks);
}

}  // namespace

viewer::Beat collect_beat(const BeatSource& source, const files::Say& say) {
  say("view: mesh and fields");
  const auto c = case_file::read_case(source.case_file).value;
  viewer::Beat beat;
  const BeatMesh beat_mesh = mesh_of(c, beat);
  const MeshData& data = beat_mesh.data;
  beat.title = c.title;
  const auto run = case_file::describe(c);
  analysis::FieldSeries series(run, data, source.results);
  Skeleton surface = viewer::surface_of(data, roles_of(c));
  if (beat_mesh.whole_wall) surface.body.joined = viewer::joined_triangles(surface, beat_mesh.corners);
  const auto planes = planes_of(source.post, beat);
  Skeleton sections = viewer::sections_of(beat_mesh.to_cut(), planes);
  add_labels(data, surface, source.post, beat);
  Collector collector(data, run, series.stresses(), surface, sections);
  read_frames(series, source.post, collector, beat);
  add_thickness(surface);
  beat.bodies.push_back(std::move(surface.body));
  if (sections.body.triangles.empty()) {
    beat.remarks.push_back("there are no sections, and no velocity on them: the figures of the cycle have no stations");
    return beat;
  }
  for (const auto& plane : planes) beat.sections.push_back({plane.name, plane.centre, plane.normal});
  beat.bodies.push_back(std::move(sections.body));
  return beat;
}

}  // namespace tunica::stages
