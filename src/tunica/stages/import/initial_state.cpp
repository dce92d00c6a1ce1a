#include "tunica/stages/import/initial_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <variant>

#include "tunica/artifacts/load_mesh.hpp"
#include "tunica/artifacts/start_file.hpp"
#include "tunica/base/error.hpp"
#include "tunica/config/units.hpp"
#include "tunica/mesh_io/vtk_files.hpp"

namespace tunica::stages {

namespace fs = std::filesystem;

namespace {

constexpr const char* field_remedy = "give the field on the points of the mesh, or remove the key";

/// A field of one mesh, [point][component], in SI units.
std::vector<double> read_field(const fs::path& file, const char* name, int components, double factor,
                               std::span<const Vec3<double>> points, double metres) {
  auto cells = mesh_io::read_vtk_volume(file, {}, {name});
  check_points(file, cells.points, points, metres, field_remedy);
  auto& field = cells.point_fields.at(0);
  if (field.components != components)
    throw InputError(file.string(),
                     fmt::format("`{}` has {} components, {} are expected", name, field.components, components),
                     field_remedy);
  for (double& value : field.values) {
    if (!std::isfinite(value)) throw InputError(file.string(), fmt::format("`{}` is not finite", name), field_remedy);
    value *= factor;
  }
  return std::move(field.values);
}

struct Fill {
  const mesh::MeshData& data;
  const peer_cases::UnitSystem& units;
  double metres;
  coupling::State& state;

  double factor(const char* unit, const config::Dimension& dimension) const {
    return config::unit_factor(unit, dimension);
  }

  /// The points of a mesh are those from `first` on.
  void take(const peer_cases::InitialFiles& files, std::size_t first, std::size_t count, bool wall) {
    const auto points = std::span(data.points).subspan(first, count);
    const auto spread = [&](const std::vector<double>& from, int components, int at, std::vector<double>& to) {
      const auto n = static_cast<std::size_t>(components);
      for (std::size_t i = 0; i < count; ++i)
        for (std::size_t c = 0; c < n; ++c) to[4 * (first + i) + static_cast<std::size_t>(at) + c] = from[n * i + c];
    };
    if (files.velocity) {
      const auto v = read_field(*files.velocity, "Velocity", 3, factor(units.velocity, config::dimension::velocity),
                                points, metres);
      spread(v, 3, 0, state.velocity_pressure);
      if (wall) spread(v, 3, 0, state.displacement_rate);
    }
    if (files.pressure)
      spread(read_field(*files.pressure, "Pressure", 1, factor(units.pressure, config::dimension::pressure), points,
                        metres),
             1, 3, state.velocity_pressure);
    if (files.displacement)
      spread(read_field(*files.displacement, "Displacement", 3, factor(units.length, config::dimension::length), points,
                        metres),
             3, 0, state.displacement);
  }

  /// Nodes of wall and lumen on the interface move alike: in the velocity of the lumen where it is given, in the
  /// displacement of the wall.
  void join_twins(bool lumen_leads, bool wall_is_displaced) {
    for (const auto& [wall, lumen] : data.twins) {
      const auto join = [&](bool from_lumen, std::initializer_list<std::vector<double>*> fields) {
        const auto from = static_cast<std::size_t>(from_lumen ? lumen : wall);
        const auto to = static_cast<std::size_t>(from_lumen ? wall : lumen);
        for (auto* field : fields)
          for (std::size_t i = 0; i < 3; ++i) (*field)[4 * to + i] = (*field)[4 * from + i];
      };
      join(lumen_leads, {&state.velocity_pressure, &state.displacement_rate});
      join(!wall_is_displaced, {&state.displacement});
    }
  }
};

/// Flow out of a face [m^3/s] and the mean pressure on it [Pa].
std::array<double, 2> flow_and_pressure(const mesh::MeshData& data, const mesh::FaceData& face,
                                        const coupling::State& state) {
  double flow = 0, force = 0, area = 0;
  for (const auto& t : face.triangles) {
    const auto& x0 = data.points[static_cast<std::size_t>(t[0])];
    const Vec3<double> normal =
        0.5 * cross(data.points[static_cast<std::size_t>(t[1])] - x0, data.points[static_cast<std::size_t>(t[2])] - x0);
    const double size = norm(normal);
    area += size;
    for (const auto node : t) {
      const double* v = &state.velocity_pressure[4 * static_cast<std::size_t>(node)];
      flow += (normal[0] * v[0] + normal[1] * v[1] + normal[2] * v[2]) / 3;
      force += size * v[3] / 3;
    }
  }
  return {flow, area > 0 ? force / area : 0.0};
}

std::vector<bc::Outlet> outlets_of(const case_file::Case& c, const mesh::MeshData& data, const coupling::State& state) {
  std::vector<bc::Outlet> outlets;
  for (const auto& [name, condition] : c.boundary) {
    const auto* rcr = std::get_if<bc::Rcr>(&condition);
    const auto* resistance = std::get_if<bc::Resistance>(&condition);
    const auto face = std::find_if(data.faces.begin(), data.faces.end(), [&](const auto& f) { return f.name == name; });
    if ((rcr == nullptr && resistance == nullptr) || face == data.faces.end()) continue;
    const auto [flow, pressure] = flow_and_pressure(data, *face, state);
    bc::Outlet outlet(name, rcr != nullptr ? std::variant<bc::Resistance, bc::Rcr>(*rcr) : *resistance);
    if (rcr != nullptr)
      outlet.restore(std::array{flow, pressure - rcr->proximal * flow});
    else
      outlet.set_initial_flow(flow);
    outlets.push_back(std::move(outlet));
  }
  return outlets;
}

}  // namespace

void check_points(const fs::path& file, std::span<const Vec3<double>> of_file, std::span<const Vec3<double>> points,
                  double metres, const char* cure) {
  if (of_file.size() != points.size())
    throw InputError(file.string(), fmt::format("has {} points, the mesh {}", of_file.size(), points.size()), cure);
  double size = 0;
  for (const auto& x : points) size = std::max(size, norm(x));
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!(norm(metres * of_file[i] - points[i]) <= 1e-5 * size))
      throw InputError(file.string(), fmt::format("has point {} in another place than the mesh", i + 1), cure);
}

void write_initial_state(const peer_cases::InitialState& initial, const case_file::Case& c,
                         const peer_cases::UnitSystem& units, const fs::path& target) {
  const auto mesh = artifacts::load_mesh(c);
  if (c.elements == case_file::Elements::quadratic)
    throw InputError(target.string(), "would hold initial fields of ten-node tetrahedra, which are not read",
                     "remove the initial fields, or give a mesh of linear tetrahedra");
  const mesh::MeshData& data = mesh.data;
  coupling::State state;
  for (auto* field : {&state.velocity_pressure, &state.acceleration, &state.displacement, &state.displacement_rate})
    field->assign(4 * data.points.size(), 0.0);
  std::size_t lumen_points = 0;  // they come first
  for (const auto& region : data.regions)
    if (region.kind == mesh::RegionKind::lumen)
      for (auto e = region.first_element; e < region.end_element; ++e)
        for (const auto node : data.tetrahedra[static_cast<std::size_t>(e)])
          lumen_points = std::max(lumen_points, static_cast<std::size_t>(node) + 1);
  Fill fill{data, units, c.meshes.metres(), state};
  fill.take(initial.lumen, 0, lumen_points, false);
  fill.take(initial.wall, lumen_points, data.points.size() - lumen_points, true);
  fill.join_twins(initial.lumen.velocity.has_value(), initial.wall.displacement.has_value());
  for (std::size_t n = 0; n < data.points.size(); ++n) state.end_pressure.push_back(state.velocity_pressure[4 * n + 3]);
  state.outlets = outlets_of(c, data, state);
  artifacts::write_start(target, state, artifacts::mesh_hash(data));
}

}  // namespace tunica::stages
