#include "tunica/flow_imaging/inlet_profile.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "tunica/bc/inflow.hpp"
#include "tunica/bc/waveform.hpp"
#include "tunica/files/atomic_file.hpp"

namespace tunica::flow_imaging {

double OpeningMesh::outflow(std::span<const Vec3<double>> velocities) const {
  double sum = 0;
  for (std::size_t k = 0; k < triangles.size(); ++k) {
    const auto& t = triangles[k];
    const auto x = [&](std::size_t i) { return points[static_cast<std::size_t>(t[i])]; };
    const Vec3<double> area = 0.5 * cross(x(1) - x(0), x(2) - x(0));
    // Quadratic shape functions of corners have no integral, those of edges a third of the area.
    for (const auto node : edges.empty() ? t : edges[k])
      sum += dot(area, velocities[static_cast<std::size_t>(node)]) / 3;
  }
  return sum;
}

OpeningMesh opening_mesh(const mesh::MeshData& data, const mesh::FaceData& face) {
  OpeningMesh opening{.name = face.name, .points = {}, .triangles = {}, .edges = {}};
  std::map<std::int64_t, std::int32_t> number;
  const auto local = [&](const std::array<std::int64_t, 3>& nodes) {
    bc::Triangle result;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [found, is_new] = number.emplace(nodes[i], static_cast<std::int32_t>(opening.points.size()));
      if (is_new) opening.points.push_back(data.points[static_cast<std::size_t>(nodes[i])]);
      result[i] = found->second;
    }
    return result;
  };
  for (const auto& t : face.triangles) opening.triangles.push_back(local(t));
  for (const auto& e : face.edges) opening.edges.push_back(local(e));
  return opening;
}

NodalCourse profile_at_nodes(const VelocitySeries& series, const ProfileFit& fit, const OpeningMesh& opening,
                             std::span<const double> outflow) {
  const auto unit = bc::inflow_profile(opening.face(), bc::Profile::parabolic);  // checks the face as well
  const auto rim = bc::rim_nodes(opening.face());
  NodalCourse course{.times = series.times, .period = series.period, .values = {}};
  course.values.assign(series.frames(), std::vector<Vec3<double>>(opening.points.size(), Vec3<double>{}));
  for (std::size_t n = 0; n < opening.points.size(); ++n) {
    if (rim[n]) continue;
    const auto velocities = fit.velocities(opening.points[n]);
    for (std::size_t frame = 0; frame < series.frames(); ++frame) course.values[frame][n] = velocities[frame];
  }
  for (std::size_t frame = 0; frame < series.frames(); ++frame) {
    auto& v = course.values[frame];
    // inflow_profile's phi carries one unit along the normal.
    const double lacks = outflow[frame] - opening.outflow(v);
    for (std::size_t n = 0; n < v.size(); ++n) v[n] = v[n] + (lacks * unit.phi[n]) * unit.normal;
  }
  return course;
}

NodalCourse resampled(const NodalCourse& course, std::size_t count) {
  NodalCourse result{.times = {}, .period = course.period, .values = {}};
  for (std::size_t k = 0; k < count; ++k)
    result.times.push_back(course.period * static_cast<double>(k) / static_cast<double>(count));
  const auto nodes = course.values.front().size();
  result.values.assign(count, std::vector<Vec3<double>>(nodes, Vec3<double>{}));
  const bc::TableOptions options{.interpolation = bc::Interpolation::spline, .periodic = true, .period = course.period};
  for (std::size_t n = 0; n < nodes; ++n)
    for (int d = 0; d < 3; ++d) {
      bc::Table table{.times = course.times, .values = {}, .modes = 0};
      for (const auto& v : course.values) table.values.push_back(v[n][d]);
      const auto spline = bc::Waveform::table(table, options, "measured profile");
      for (std::size_t k = 0; k < count; ++k) result.values[k][n][d] = spline.value(result.times[k]);
    }
  return result;
}

void write_nodal_table(std::span<const Vec3<double>> points, const NodalCourse& course, const char* components,
                       const std::filesystem::path& file) {
  std::string text = fmt::format("t,x,y,z,{}\n", components);
  for (std::size_t k = 0; k < course.times.size(); ++k)
    for (std::size_t n = 0; n < points.size(); ++n) {
      const auto &x = points[n], &v = course.values[k][n];
      text +=
          fmt::format("{:.12g},{},{},{},{:.7g},{:.7g},{:.7g}\n", course.times[k], x[0], x[1], x[2], v[0], v[1], v[2]);
    }
  files::write_atomically(file, text);
}

}  // namespace tunica::flow_imaging
