#include "tunica/stages/import/nodal_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <sstream>

#include "tunica/base/error.hpp"
#include "tunica/bc/waveform.hpp"
#include "tunica/config/units.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/files/csv_file.hpp"
#include "tunica/mesh_io/vtk_files.hpp"

namespace tunica::stages {

namespace {

constexpr const char* mesh_remedy = "write the file for this mesh anew";

/// Columns of the file of a table.
using NodalQuantity = peer_cases::NodalValues::Quantity;

const char* column_names(NodalQuantity quantity) {
  switch (quantity) {
    case NodalQuantity::velocity:
      return "vx,vy,vz";
    case NodalQuantity::displacement:
      return "ux,uy,uz";
    case NodalQuantity::traction:
      return "tx,ty,tz";
    case NodalQuantity::factor:
      break;
  }
  return "factor";
}

/// Which components the numbers of a text are.
std::vector<int> due_components(const peer_cases::NodalValues& wanted) {
  if (wanted.quantity == NodalQuantity::factor) return {0};
  return wanted.axes.empty() ? std::vector<int>{0, 1, 2} : wanted.axes;
}

/// The words of a text file, one after another, with the line of each.
class Words {
 public:
  explicit Words(const std::filesystem::path& file) : file_(file.string()) {
    for (const auto& line : files::read_lines(file, mesh_remedy)) {
      std::istringstream words{std::string(line.text)};
      for (std::string word; words >> word;) words_.emplace_back(word, line.number);
    }
  }

  bool done() const { return next_ == words_.size(); }
  double number(const char* what) {
    if (done()) throw InputError(file_, fmt::format("ends where {} is due", what), mesh_remedy);
    const auto& [word, line] = words_[next_++];
    line_ = line;
    return files::parse_number(word, where(), what);
  }
  std::size_t count(const char* what) {
    const double value = number(what);
    if (!(value >= 1 && value < 1e9) || value != static_cast<double>(static_cast<std::size_t>(value)))
      refuse(fmt::format("has {} of {:.9g}", what, value));
    return static_cast<std::size_t>(value);
  }
  /// Number of a node as the file counts them.
  std::int64_t node() {
    const double value = number("a node");
    if (!(value >= 0 && value < 1e9) || value != std::floor(value)) refuse(fmt::format("has the node {:.9g}", value));
    return static_cast<std::int64_t>(value);
  }
  [[noreturn]] void refuse(const std::string& what) const { throw InputError(where(), what, mesh_remedy); }

 private:
  std::string where() const { return fmt::format("{}:{}", file_, line_); }

  std::string file_;
  std::vector<std::pair<std::string, int>> words_;
  std::size_t next_ = 0;
  int line_ = 1;
};

const mesh::FaceData& face_of(const mesh::MeshData& mesh, const std::string& name) {
  const auto at =
      std::find_if(mesh.faces.begin(), mesh.faces.end(), [&](const auto& face) { return face.name == name; });
  if (at == mesh.faces.end()) throw InputError("boundary." + name, "is no face of the mesh", "name one of its faces");
  return *at;
}

std::vector<std::int32_t> nodes_of(const mesh::FaceData& face) {
  std::vector<std::int32_t> nodes;
  for (const auto& t : face.triangles) nodes.insert(nodes.end(), t.begin(), t.end());
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

/// Reads the number of a node and returns its place among those of the face.
std::size_t place_of_next(const NodalTable& table, int first_node, Words& words) {
  const auto written = words.node(), node = written - first_node;
  const auto at = std::lower_bound(table.nodes.begin(), table.nodes.end(), node);
  if (at == table.nodes.end() || *at != node)
    words.refuse(fmt::format("names node {}, which is not on the face", written));
  return static_cast<std::size_t>(at - table.nodes.begin());
}

void check_times(const std::vector<double>& times, const std::string& file) {
  if (times.size() < 2 || times.front() != 0)
    throw InputError(file, times.empty() ? "has no times" : "does not begin at the time 0, or has one time alone",
                     mesh_remedy);
  for (std::size_t k = 1; k < times.size(); ++k)
    if (!(times[k] > times[k - 1]))
      throw InputError(file, fmt::format("has the time {:.9g} behind {:.9g}", times[k], times[k - 1]), mesh_remedy);
}

/// Pairs of places in the table between whose nodes a line of the file lies: each with itself, and the ends of edges.
std::vector<std::pair<std::size_t, std::size_t>> places_of(const NodalTable& table,
                                                           const peer_cases::NodalValues& wanted,
                                                           const mesh::MeshData& mesh, bool ten_node) {
  std::vector<std::pair<std::size_t, std::size_t>> places;
  for (std::size_t n = 0; n < table.nodes.size(); ++n) places.emplace_back(n, n);
  if (!ten_node || table.nodes.size() < 2) return places;
  const auto place = [&](std::int32_t node) {
    return static_cast<std::size_t>(std::lower_bound(table.nodes.begin(), table.nodes.end(), node) -
                                    table.nodes.begin());
  };
  std::set<std::pair<std::size_t, std::size_t>> edges;
  for (const auto& t : face_of(mesh, wanted.face).triangles)
    for (std::size_t i = 0; i < 3; ++i) edges.insert(std::minmax(place(t[i]), place(t[(i + 1) % 3])));
  places.insert(places.end(), edges.begin(), edges.end());
  return places;
}

void read_text(const peer_cases::NodalValues& wanted, double unit, NodalTable& table) {
  Words words(wanted.file);
  const auto components = words.count("a number of components"), times = words.count("a number of times"),
             nodes = words.count("a number of nodes");
  const auto due = due_components(wanted);
  if (components != due.size()) words.refuse(fmt::format("has {} components, {} are expected", components, due.size()));
  if (nodes != table.nodes.size())
    words.refuse(fmt::format("has {} nodes, the face {} has {}", nodes, wanted.face, table.nodes.size()));
  for (std::size_t k = 0; k < times; ++k) table.times.push_back(words.number("a time"));
  check_times(table.times, wanted.file.string());
  table.values.assign(times, std::vector<Vec3<double>>(nodes));
  std::vector<char> given(nodes, 0);
  for (std::size_t n = 0; n < nodes; ++n) {
    const auto place = place_of_next(table, wanted.first_node, words);
    if (given[place]++) words.refuse(fmt::format("names node {} twice", table.nodes[place] + wanted.first_node));
    for (auto& of_time : table.values)
      for (const int i : due) of_time[place][i] = unit * words.number("a component of a value");
  }
  if (!words.done()) words.refuse("has numbers behind those of its last node");
  table.period = table.times.back();
}

/// For each node of the table the point of a surface at its place: GlobalNodeID is right in some files only.
std::vector<std::size_t> match(const NodalTable& table, const mesh::MeshData& mesh,
                               const std::vector<Vec3<double>>& points, double metres,
                               const peer_cases::NodalValues& wanted) {
  std::vector<std::size_t> point_of;
  double size = 0;
  for (const auto node : table.nodes) size = std::max(size, norm(mesh.points[static_cast<std::size_t>(node)]));
  for (const auto node : table.nodes) {
    const auto& x = mesh.points[static_cast<std::size_t>(node)];
    const auto nearest = std::min_element(points.begin(), points.end(), [&](const auto& a, const auto& b) {
      return norm(metres * a - x) < norm(metres * b - x);
    });
    if (nearest == points.end() || !(norm(metres * *nearest - x) <= 1e-5 * size))
      throw InputError(wanted.file.string(),
                       fmt::format("has no point at node {} of the face {}", node + 1, wanted.face), mesh_remedy);
    point_of.push_back(static_cast<std::size_t>(nearest - points.begin()));
  }
  return point_of;
}

void read_bct(const peer_cases::NodalValues& wanted, const mesh::MeshData& mesh, double metres, double unit,
              NodalTable& table) {
  const std::string prefix = "velocity_", file = wanted.file.string();
  const auto surface = mesh_io::read_vtk_surface_series(wanted.file, prefix);
  const auto point_of = match(table, mesh, surface.points, metres, wanted);
  std::vector<std::pair<double, const mesh::ElementField*>> fields;
  for (const auto& field : surface.point_fields) {
    const double time = files::parse_number(field.name.substr(prefix.size()), file, "in the name " + field.name);
    if (field.components != 3)
      throw InputError(file, fmt::format("has {} components in {}", field.components, field.name), "give three");
    fields.emplace_back(time, &field);
  }
  std::sort(fields.begin(), fields.end());
  for (const auto& [time, field] : fields) {
    table.times.push_back(time);
    auto& values = table.values.emplace_back();
    for (const auto point : point_of) {
      const double* v = field->values.data() + 3 * point;
      values.push_back({{unit * v[0], unit * v[1], unit * v[2]}});
    }
  }
  check_times(table.times, file);
  table.period = table.times.back();
}

void read_array(const peer_cases::NodalValues& wanted, const mesh::MeshData& mesh, double metres, double unit,
                NodalTable& table) {
  const bool traction = wanted.kind == peer_cases::NodalValues::Kind::traction;
  const std::string name = traction ? "Traction" : "Pressure";
  const int components = traction ? 3 : 1;
  const auto surface = mesh_io::read_vtk_surface_series(wanted.file, name);
  const auto field = std::find_if(surface.point_fields.begin(), surface.point_fields.end(),
                                  [&](const auto& f) { return f.name == name; });
  if (field == surface.point_fields.end() || field->components != components)
    throw InputError(wanted.file.string(),
                     fmt::format("has no point array {} of {} component{}", name, components, traction ? "s" : ""),
                     mesh_remedy);
  auto& values = table.values.emplace_back();
  for (const auto point : match(table, mesh, surface.points, metres, wanted)) {
    auto& value = values.emplace_back(Vec3<double>{});
    for (int i = 0; i < components; ++i)
      value[i] = unit * field->values[static_cast<std::size_t>(components) * point + static_cast<std::size_t>(i)];
  }
}

/// Three columns behind the time, each of which makes a course. The times of a ramp are those of its ends.
std::vector<bc::Waveform> courses_of_columns(const peer_cases::NodalValues& wanted, double unit,
                                             std::vector<double>& ramp_times) {
  Words words(wanted.file);
  const auto points = words.count("a number of points"), modes = words.count("a number of modes");
  bc::Table columns[3];
  for (std::size_t k = 0; k < points; ++k) {
    const double time = words.number("a time");
    for (auto& column : columns) {
      column.times.push_back(time);
      column.values.push_back(unit * words.number("a component"));
    }
  }
  if (!words.done()) words.refuse("has numbers behind those of its last point");
  if (wanted.ramp) ramp_times = {columns[0].times.front(), columns[0].times.back()};
  std::vector<bc::Waveform> courses;
  for (const auto& column : columns)
    courses.push_back(
        bc::Waveform::table(column,
                            {.interpolation = wanted.ramp ? bc::Interpolation::ramp : bc::Interpolation::fourier,
                             .periodic = true,
                             .modes = wanted.ramp ? 0 : static_cast<int>(modes),
                             .trend = !wanted.ramp},
                            wanted.file.string()));
  return courses;
}

std::vector<bc::Waveform> courses_of_coefficients(const peer_cases::NodalValues& wanted, double unit) {
  std::vector<bc::Waveform> courses;
  for (const auto& series : bc::read_fourier_series({.path = wanted.file, .value_unit = unit}, 3))
    courses.push_back(bc::Waveform::fourier_series(series, wanted.file.string()));
  return courses;
}

void read_course(const peer_cases::NodalValues& wanted, double unit, NodalTable& table) {
  table.nodes.resize(1);
  const auto courses =
      wanted.coefficients ? courses_of_coefficients(wanted, unit) : courses_of_columns(wanted, unit, table.times);
  if (!wanted.ramp)
    for (std::size_t n = 0; n <= wanted.steps; ++n) table.times.push_back(static_cast<double>(n) * wanted.step);
  for (const double t : table.times)
    table.values.push_back({Vec3<double>{{courses[0].value(t), courses[1].value(t), courses[2].value(t)}}});
  if (table.times.size() < 2 || !(table.times[1] > table.times[0]))
    throw InputError(wanted.file.string(), "spans no time", mesh_remedy);
}

/// Outward normals, means by the areas around them, and the triangles with areas [units of the peer^2].
struct FaceGeometry {
  std::vector<Vec3<double>> normals;  ///< of length one
  std::vector<std::pair<double, std::array<std::size_t, 3>>> triangles;
  std::vector<char> rim;  ///< nodes that other faces of the mesh have, too
  Vec3<double> centre{};  ///< m
};

FaceGeometry geometry_of(const NodalTable& table, const mesh::MeshData& mesh, const std::string& name, double metres) {
  FaceGeometry g{.normals = std::vector<Vec3<double>>(table.nodes.size()),
                 .triangles = {},
                 .rim = std::vector<char>(table.nodes.size(), 0)};
  const auto place = [&](std::int32_t node) {
    const auto at = std::lower_bound(table.nodes.begin(), table.nodes.end(), node);
    return at != table.nodes.end() && *at == node ? static_cast<std::size_t>(at - table.nodes.begin())
                                                  : table.nodes.size();
  };
  double whole = 0;
  for (const auto& face : mesh.faces)
    for (const auto& t : face.triangles) {
      if (face.name != name) {
        if (face.name != unnamed_boundary)
          for (const auto node : t)
            if (const auto at = place(node); at < g.rim.size()) g.rim[at] = 1;
        continue;
      }
      const auto x = [&](std::size_t i) { return mesh.points[static_cast<std::size_t>(t[i])]; };
      const Vec3<double> area = 0.5 * cross(x(1) - x(0), x(2) - x(0));
      const std::array<std::size_t, 3> places{place(t[0]), place(t[1]), place(t[2])};
      for (const auto at : places) g.normals[at] = g.normals[at] + area;
      g.triangles.emplace_back(norm(area) / (metres * metres), places);
      whole += norm(area);
      g.centre = g.centre + (norm(area) / 3) * (x(0) + x(1) + x(2));
    }
  g.centre = (1.0 / whole) * g.centre;
  for (auto& normal : g.normals) normal = (1.0 / norm(normal)) * normal;
  return g;
}

/// Sizes of a paraboloid: the rim in the direction of a node is the rim node whose direction is the nearest to it.
std::vector<double> parabolic_sizes(const NodalTable& table, const mesh::MeshData& mesh, const FaceGeometry& g,
                                    const peer_cases::NodalValues& wanted) {
  const auto from_centre = [&](std::size_t n) {
    return mesh.points[static_cast<std::size_t>(table.nodes[n])] - g.centre;
  };
  std::vector<Vec3<double>> rim;
  for (std::size_t n = 0; n < g.rim.size(); ++n)
    if (g.rim[n]) rim.push_back(from_centre(n));
  if (rim.empty())
    throw InputError(wanted.where,
                     fmt::format("asks for a parabola on the face {}, which no other face meets", wanted.face),
                     "give the faces around it, or the profile Flat");
  std::vector<double> sizes;
  for (std::size_t n = 0; n < table.nodes.size(); ++n) {
    const Vec3<double> d = from_centre(n);
    const auto along = [&](const Vec3<double>& r) { return dot(d, r) / norm(r); };
    const auto& nearest =
        *std::max_element(rim.begin(), rim.end(), [&](const auto& a, const auto& b) { return along(a) < along(b); });
    sizes.push_back(1.0 - dot(d, d) / dot(nearest, nearest));
  }
  return sizes;
}

void make_shape(const peer_cases::NodalValues& wanted, const mesh::MeshData& mesh, double metres, double unit,
                NodalTable& table) {
  using Kind = peer_cases::NodalValues::Kind;
  const FaceGeometry g = geometry_of(table, mesh, wanted.face, metres);
  std::vector<double> sizes(table.nodes.size(), 1.0);
  if (wanted.kind == Kind::user) {
    Words words(wanted.file);
    for (std::size_t n = 0; n < table.nodes.size(); ++n) {
      const auto place = place_of_next(table, wanted.first_node, words);
      sizes[place] = words.number("the size there");
    }
  } else if (wanted.kind == Kind::parabolic) {
    sizes = parabolic_sizes(table, mesh, g, wanted);
  }
  for (std::size_t n = 0; n < sizes.size(); ++n)
    if (wanted.zero_rim && g.rim[n]) sizes[n] = 0;
  double integral = 1.0;
  if (wanted.unit_flow) {
    integral = 0;
    for (const auto& [area, places] : g.triangles)
      for (const auto place : places) integral += area / 3 * sizes[place];
    if (!(std::abs(integral) > 0))
      throw InputError(wanted.where,
                       fmt::format("asks for a profile on the face {} whose integral is zero", wanted.face),
                       "give one with an integral, or Impose_flux false");
  }
  auto& values = table.values.emplace_back();
  for (std::size_t n = 0; n < sizes.size(); ++n) {
    const double size = unit * sizes[n] / integral;
    Vec3<double> value = size * g.normals[n];
    if (wanted.quantity == NodalQuantity::factor) value = {{size, 0, 0}};
    if (!wanted.axes.empty()) {
      value = {};
      for (const int axis : wanted.axes) value[axis] = size;
    }
    values.push_back(value);
  }
}

double unit_of(const peer_cases::NodalValues& wanted, const peer_cases::UnitSystem& units) {
  switch (wanted.quantity) {
    case NodalQuantity::velocity:
      return config::unit_factor(units.velocity, config::dimension::velocity);
    case NodalQuantity::displacement:
      return config::unit_factor(units.length, config::dimension::length);
    case NodalQuantity::traction:
      return config::unit_factor(units.pressure, config::dimension::pressure);
    case NodalQuantity::factor:
      break;
  }
  return 1.0;
}

}  // namespace

NodalTable read_nodal_values(const peer_cases::NodalValues& wanted, const mesh::MeshData& mesh, double metres,
                             const peer_cases::UnitSystem& units) {
  using Kind = peer_cases::NodalValues::Kind;
  const double unit = wanted.scale * unit_of(wanted, units);
  NodalTable table{.nodes = nodes_of(face_of(mesh, wanted.face)), .times = {}, .values = {}, .period = {}};
  switch (wanted.kind) {
    case Kind::bct:
      read_bct(wanted, mesh, metres, unit, table);
      break;
    case Kind::in_time:
      read_text(wanted, unit, table);
      break;
    case Kind::pressure:
    case Kind::traction:
      read_array(wanted, mesh, metres, unit, table);
      break;
    case Kind::course:
      read_course(wanted, unit, table);
      break;
    case Kind::user:
    case Kind::flat:
    case Kind::parabolic:
      make_shape(wanted, mesh, units.metres, unit, table);
  }
  return table;
}

void write_nodal_table(const NodalTable& table, const peer_cases::NodalValues& wanted, const mesh::MeshData& mesh,
                       bool ten_node, const std::filesystem::path& target) {
  const auto places = places_of(table, wanted, mesh, ten_node);
  const bool factor = wanted.quantity == NodalQuantity::factor;
  std::string text = fmt::format("{}x,y,z,{}\n", table.times.empty() ? "" : "t,", column_names(wanted.quantity));
  for (std::size_t k = 0; k < table.values.size(); ++k)
    for (const auto& [a, b] : places) {
      const auto place = [&](std::size_t n) { return mesh.points[static_cast<std::size_t>(table.nodes[n])]; };
      const auto x = a == b ? place(a) : 0.5 * (place(a) + place(b));
      const auto& of_time = table.values[k];
      const auto v = a == b ? of_time[a] : 0.5 * (of_time[a] + of_time[b]);
      if (!table.times.empty()) text += fmt::format("{},", table.times[k]);
      text += fmt::format("{},{},{},{}", x[0], x[1], x[2], v[0]);
      text += factor ? "\n" : fmt::format(",{},{}\n", v[1], v[2]);
    }
  files::write_atomically(target, text);
}

}  // namespace tunica::stages
