#include "tunica/stages/import/nodal_velocities.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "tunica/base/error.hpp"
#include "tunica/config/units.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/files/csv_file.hpp"
#include "tunica/mesh_io/vtk_files.hpp"

namespace tunica::stages {

namespace {

constexpr const char* remedy = "write the file for this mesh anew";

/// The words of a text file, one after another, with the line of each.
class Words {
 public:
  explicit Words(const std::filesystem::path& file) : file_(file.string()) {
    for (const auto& line : files::read_lines(file, remedy)) {
      std::istringstream words{std::string(line.text)};
      for (std::string word; words >> word;) words_.emplace_back(word, line.number);
    }
  }

  bool done() const { return next_ == words_.size(); }
  double number(const char* what) {
    if (done()) throw InputError(file_, fmt::format("ends where {} is due", what), remedy);
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
  [[noreturn]] void refuse(const std::string& what) const { throw InputError(where(), what, remedy); }

 private:
  std::string where() const { return fmt::format("{}:{}", file_, line_); }

  std::string file_;
  std::vector<std::pair<std::string, int>> words_;
  std::size_t next_ = 0;
  int line_ = 1;
};

const mesh::FaceData& face_of(const mesh::MeshData& lumen, const std::string& name) {
  const auto at =
      std::find_if(lumen.faces.begin(), lumen.faces.end(), [&](const auto& face) { return face.name == name; });
  if (at == lumen.faces.end()) throw InputError("boundary." + name, "is no face of the lumen", "name one of its faces");
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
std::size_t place_of_next(const VelocityTable& table, int first_node, Words& words) {
  const auto written = words.node(), node = written - first_node;
  const auto at = std::lower_bound(table.nodes.begin(), table.nodes.end(), node);
  if (at == table.nodes.end() || *at != node)
    words.refuse(fmt::format("names node {}, which is not on the face", written));
  return static_cast<std::size_t>(at - table.nodes.begin());
}

void check_times(const std::vector<double>& times, const std::string& file) {
  if (times.size() < 2 || times.front() != 0)
    throw InputError(file, times.empty() ? "has no times" : "does not begin at the time 0, or has one time alone",
                     remedy);
  for (std::size_t k = 1; k < times.size(); ++k)
    if (!(times[k] > times[k - 1]))
      throw InputError(file, fmt::format("has the time {:.9g} behind {:.9g}", times[k], times[k - 1]), remedy);
}

void read_text(const peer_cases::NodalVelocities& wanted, double unit, VelocityTable& table) {
  Words words(wanted.file);
  const auto components = words.count("a number of components"), times = words.count("a number of times"),
             nodes = words.count("a number of nodes");
  if (components != 3) words.refuse(fmt::format("has {} components, a velocity has three", components));
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
      for (int i = 0; i < 3; ++i) of_time[place][i] = unit * words.number("a component of a velocity");
  }
  if (!words.done()) words.refuse("has numbers behind those of its last node");
}

void read_bct(const peer_cases::NodalVelocities& wanted, const mesh::MeshData& lumen, double metres, double unit,
              VelocityTable& table) {
  const std::string prefix = "velocity_", file = wanted.file.string();
  const auto surface = mesh_io::read_vtk_surface_series(wanted.file, prefix);
  // By place: GlobalNodeID is right in some files only.
  std::vector<std::size_t> point_of;
  double size = 0;
  for (const auto node : table.nodes) size = std::max(size, norm(lumen.points[static_cast<std::size_t>(node)]));
  for (const auto node : table.nodes) {
    const auto& x = lumen.points[static_cast<std::size_t>(node)];
    const auto nearest =
        std::min_element(surface.points.begin(), surface.points.end(),
                         [&](const auto& a, const auto& b) { return norm(metres * a - x) < norm(metres * b - x); });
    if (nearest == surface.points.end() || !(norm(metres * *nearest - x) <= 1e-5 * size))
      throw InputError(file, fmt::format("has no point at node {} of the face {}", node + 1, wanted.face), remedy);
    point_of.push_back(static_cast<std::size_t>(nearest - surface.points.begin()));
  }
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
}

/// Sizes along the outward normals of the nodes, which are means by the areas around them.
void read_shape(const peer_cases::NodalVelocities& wanted, const mesh::MeshData& lumen, double metres, double unit,
                VelocityTable& table) {
  Words words(wanted.file);
  std::vector<double> sizes(table.nodes.size(), 0.0);
  for (std::size_t n = 0; n < table.nodes.size(); ++n) {
    const auto place = place_of_next(table, wanted.first_node, words);
    sizes[place] = words.number("the size there");
  }
  std::vector<Vec3<double>> normals(table.nodes.size(), Vec3<double>{});
  std::map<std::pair<std::int32_t, std::int32_t>, int> edges;
  std::vector<std::pair<double, std::array<std::size_t, 3>>> triangles;
  for (const auto& t : face_of(lumen, wanted.face).triangles) {
    const auto x = [&](int i) { return lumen.points[static_cast<std::size_t>(t[static_cast<std::size_t>(i)])]; };
    const Vec3<double> area = 0.5 * cross(x(1) - x(0), x(2) - x(0));
    std::array<std::size_t, 3> places;
    for (std::size_t i = 0; i < 3; ++i) {
      places[i] = static_cast<std::size_t>(std::lower_bound(table.nodes.begin(), table.nodes.end(), t[i]) -
                                           table.nodes.begin());
      normals[places[i]] = normals[places[i]] + area;
      ++edges[std::minmax(t[i], t[(i + 1) % 3])];
    }
    triangles.emplace_back(norm(area) / (metres * metres), places);
  }
  if (wanted.zero_rim)
    for (const auto& [edge, count] : edges)
      for (const auto node : {edge.first, edge.second})
        if (count == 1)
          sizes[static_cast<std::size_t>(std::lower_bound(table.nodes.begin(), table.nodes.end(), node) -
                                         table.nodes.begin())] = 0;
  double flow = 1.0;
  if (wanted.unit_flow) {
    flow = 0;
    for (const auto& [area, places] : triangles)
      for (const auto place : places) flow += area / 3 * sizes[place];
    if (!(std::abs(flow) > 0)) words.refuse("has a profile without any flow");
  }
  auto& values = table.values.emplace_back();
  for (std::size_t n = 0; n < sizes.size(); ++n)
    values.push_back((unit * sizes[n] / (flow * norm(normals[n]))) * normals[n]);
}

}  // namespace

VelocityTable read_nodal_velocities(const peer_cases::NodalVelocities& wanted, const mesh::MeshData& lumen,
                                    double metres, const peer_cases::UnitSystem& units) {
  const double unit = config::unit_factor(units.velocity, config::dimension::velocity);
  VelocityTable table{.nodes = nodes_of(face_of(lumen, wanted.face)), .times = {}, .values = {}};
  switch (wanted.kind) {
    case peer_cases::NodalVelocities::Kind::bct:
      read_bct(wanted, lumen, metres, unit, table);
      break;
    case peer_cases::NodalVelocities::Kind::in_time:
      read_text(wanted, unit, table);
      break;
    case peer_cases::NodalVelocities::Kind::shape:
      read_shape(wanted, lumen, units.metres, unit, table);
      break;
  }
  return table;
}

void write_velocity_table(const VelocityTable& table, const mesh::MeshData& lumen,
                          const std::filesystem::path& target) {
  std::string text = table.times.empty() ? "x,y,z,vx,vy,vz\n" : "t,x,y,z,vx,vy,vz\n";
  for (std::size_t k = 0; k < table.values.size(); ++k)
    for (std::size_t n = 0; n < table.nodes.size(); ++n) {
      const auto& x = lumen.points[static_cast<std::size_t>(table.nodes[n])];
      const auto& v = table.values[k][n];
      if (!table.times.empty()) text += fmt::format("{},", table.times[k]);
      text += fmt::format("{},{},{},{},{},{}\n", x[0], x[1], x[2], v[0], v[1], v[2]);
    }
  files::write_atomically(target, text);
}

}  // namespace tunica::stages
