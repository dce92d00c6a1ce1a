#include "tunica/flow_imaging/plane_series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tunica/base/error.hpp"
#include "tunica/bc/inflow.hpp"
#include "tunica/flow_imaging/disk_map.hpp"
#include "tunica/flow_imaging/read_series.hpp"
#include "tunica/mesh/boundary.hpp"
#include "tunica/mesh_io/vtk_files.hpp"

namespace tunica::flow_imaging {

namespace {

namespace dimension = config::dimension;

/// One frame; the first one gives points and triangles.
void take_frame(const std::string& file, const PlaneFiles& files, PlaneSeries& series) {
  const auto surface = mesh_io::read_vtk_surface_series(file, files.array);
  const auto field = std::find_if(surface.point_fields.begin(), surface.point_fields.end(),
                                  [&](const auto& f) { return f.name == files.array; });
  if (field == surface.point_fields.end() || field->components != 3)
    throw InputError(file, fmt::format("has no point array {} of three components", files.array),
                     "name its array of velocities by `array`");
  std::vector<Vec3<double>> points;
  for (const auto& x : surface.points) points.push_back(files.length_unit * x);
  if (series.velocity.empty()) {
    series.points = points;
    for (std::size_t c = 0; c + 1 < surface.offsets.size(); ++c) {
      const auto begin = static_cast<std::size_t>(surface.offsets[c]),
                 end = static_cast<std::size_t>(surface.offsets[c + 1]);
      for (auto k = begin + 2; k < end; ++k)
        series.triangles.push_back({static_cast<std::int32_t>(surface.connectivity[begin]),
                                    static_cast<std::int32_t>(surface.connectivity[k - 1]),
                                    static_cast<std::int32_t>(surface.connectivity[k])});
    }
    if (series.triangles.empty())
      throw InputError(file, "has points and no triangles", "triangulate it, for example by ParaView's Delaunay 2D");
  }
  double size = 0;
  for (const auto& x : points) size = std::max(size, norm(x - points.front()));
  bool same = points.size() == series.points.size();
  for (std::size_t n = 0; n < points.size() && same; ++n) same = norm(points[n] - series.points[n]) <= 1e-4 * size;
  if (!same)
    throw InputError(file, "has other points than the first frame",
                     "give all frames on the same points in the same order");
  auto& velocity = series.velocity.emplace_back();
  for (std::size_t n = 0; n < points.size(); ++n) {
    const double* v = field->values.data() + 3 * n;
    velocity.push_back({{files.unit * v[0], files.unit * v[1], files.unit * v[2]}});
  }
}

void find_normal(PlaneSeries& series, const std::string& where) {
  double area = 0;
  for (const auto& t : series.triangles) {
    const auto a = mesh::area_vector(series.points, t);
    series.normal = series.normal + a;
    area += norm(a);
  }
  if (!(norm(series.normal) > 0.95 * area))
    throw InputError(where, "is no plane: its triangles look different ways", "give velocities on a flat section");
  series.normal = (1 / norm(series.normal)) * series.normal;
  double mean = 0;
  const auto weights = frame_weights(series.times, series.period);
  for (std::size_t k = 0; k < series.times.size(); ++k) mean += weights[k] * series.flow(k);
  if (mean >= 0) return;
  series.normal = -1.0 * series.normal;
  for (auto& t : series.triangles) std::swap(t[1], t[2]);
}

/// Turns `from` into `to`, both unit, the shortest way.
Mat3<double> rotation_between(const Vec3<double>& from, const Vec3<double>& to) {
  const Vec3<double> axis = cross(from, to);
  const double c = dot(from, to);
  if (c < -1 + 1e-12) {  // any half turn
    Vec3<double> other = std::abs(from[0]) < 0.8 ? Vec3<double>{{1, 0, 0}} : Vec3<double>{{0, 1, 0}};
    other = other - dot(other, from) * from;
    other = (1 / norm(other)) * other;
    Mat3<double> half{};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) half(i, j) = 2 * other[i] * other[j] - (i == j ? 1 : 0);
    return half;
  }
  const Mat3<double> k{{{0, -axis[2], axis[1]}, {axis[2], 0, -axis[0]}, {-axis[1], axis[0], 0}}};
  return identity<double>() + k + (1 / (1 + c)) * (k * k);
}

Mat3<double> turn_about(const Vec3<double>& n, double angle) {
  const Mat3<double> k{{{0, -n[2], n[1]}, {n[2], 0, -n[0]}, {-n[1], n[0], 0}}};
  return identity<double>() + std::sin(angle) * k + (1 - std::cos(angle)) * (k * k);
}

}  // namespace

config::Schema<PlaneFiles> PlaneFiles::schema() {
  using F = PlaneFiles;
  return config::Schema<F>("plane", "Velocities on a plane over a heart beat, of this or another vessel.")
      .path("files", &F::files, "One .vtp file of triangles a frame; * stands for its number")
      .text("array", &F::array, "Point array of the velocities, three components")
      .by_default()
      .unit("unit", &F::unit, dimension::velocity, "Of the velocities")
      .unit("length_unit", &F::length_unit, dimension::length, "Of the coordinates")
      .quantity("period", &F::period, dimension::time, config::above(0), "Of the heart beat")
      .plausible("0.3 s", "2 s")
      .quantities("times", &F::times, dimension::time, config::at_least(0),
                  "Of the frames; equal parts of the period when left out")
      .by_default("[]")
      .quantity("turn", &F::turn, dimension::angle, config::anything(),
                "Of the plane about the direction in which it is laid onto the opening")
      .by_default("0 deg");
}

double PlaneSeries::flow(std::size_t frame) const {
  double sum = 0;
  for (const auto& t : triangles)
    for (const auto n : t) sum += dot(mesh::area_vector(points, t), velocity[frame][static_cast<std::size_t>(n)]) / 3;
  return sum;
}

PlaneSeries read_plane_series(const PlaneFiles& files, const std::string& where) {
  PlaneSeries series;
  const auto names = files_of_frames(files.files, where + ".files");
  for (const auto& name : names) take_frame(name, files, series);
  series.period = files.period;
  std::vector<std::string> shown;
  for (const auto& name : names) shown.push_back(std::filesystem::path(name).filename().string());
  if (names.size() < 3)
    throw InputError(where + ".files", fmt::format("stands for {} frames, at least 3 are needed", names.size()),
                     "give all frames of the beat");
  series.times = frame_times(files.times, files.period, shown, where + ".times");
  double fastest = 0;
  for (const auto& v : series.velocity)
    for (const auto& u : v) fastest = std::max(fastest, norm(u));
  if (!(fastest > 0.02 && fastest < 12))
    throw InputError(where + ".unit",
                     fmt::format("makes the largest velocity {:.3g} m/s, which is none of blood", fastest),
                     "correct the unit: m/s, cm/s or mm/s");
  find_normal(series, where + ".files");
  return series;
}

NodalCourse plane_at_nodes(const PlaneSeries& plane, const OpeningMesh& opening, double turn) {
  const auto unit = bc::inflow_profile(opening.face(), bc::Profile::parabolic);
  const auto rim = bc::rim_nodes(opening.face());
  const Vec3<double> inward = -1.0 * unit.normal;
  const auto rotation = turn_about(inward, turn) * rotation_between(plane.normal, inward);
  // The same direction of the opening in both, so that the rims start at corresponding points.
  Vec3<double> start = std::abs(inward[0]) < 0.8 ? Vec3<double>{{1, 0, 0}} : Vec3<double>{{0, 1, 0}};
  start = start - dot(start, inward) * inward;
  const auto from = disk_map(plane.points, plane.triangles, plane.normal, transpose(rotation) * start, "plane");
  double plane_area = 0, opening_area = 0;
  for (const auto& t : plane.triangles) plane_area += norm(mesh::area_vector(plane.points, t));
  for (const auto& t : opening.triangles) opening_area += norm(mesh::area_vector(opening.points, t));
  // Nodes on edges lie on the same map as the corners: between their ends.
  const auto to = disk_map(opening.points, opening.triangles, inward, start, opening.name);
  auto disk = to;
  for (std::size_t k = 0; k < opening.edges.size(); ++k)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto &a = to[static_cast<std::size_t>(opening.triangles[k][i])],
                 &b = to[static_cast<std::size_t>(opening.triangles[k][(i + 1) % 3])];
      disk[static_cast<std::size_t>(opening.edges[k][i])] = {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])};
    }
  NodalCourse course{.times = plane.times, .period = plane.period, .values = {}};
  std::vector<DiskPlace> places;
  for (const auto& p : disk) places.push_back(find_in_disk(p, from, plane.triangles));
  for (std::size_t frame = 0; frame < plane.times.size(); ++frame) {
    auto& v = course.values.emplace_back(opening.points.size(), Vec3<double>{});
    for (std::size_t n = 0; n < v.size(); ++n) {
      if (rim[n]) continue;
      Vec3<double> u{};
      for (std::size_t i = 0; i < 3; ++i)
        u = u + places[n].shares[i] *
                    plane.velocity[frame][static_cast<std::size_t>(plane.triangles[places[n].triangle][i])];
      v[n] = (plane_area / opening_area) * (rotation * u);
    }
    const double lacks = -plane.flow(frame) - opening.outflow(v);
    for (std::size_t n = 0; n < v.size(); ++n) v[n] = v[n] + (lacks * unit.phi[n]) * unit.normal;
  }
  return course;
}

}  // namespace tunica::flow_imaging
