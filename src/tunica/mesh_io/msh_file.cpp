#include "tunica/mesh_io/msh_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <unordered_map>

#include "tunica/base/error.hpp"

namespace tunica::mesh_io {

namespace {

/// Takes numbers from the text or the bytes of a file.
class Source {
 public:
  Source(std::string bytes, std::string where) : bytes_(std::move(bytes)), where_(std::move(where)) {}

  bool binary = false, swapped = false;

  int integer() { return binary ? raw<std::int32_t>() : text<int>(); }
  std::int64_t size() { return binary ? raw<std::int64_t>() : text<std::int64_t>(); }
  double real() { return binary ? raw<double>() : text<double>(); }
  template <class T>
  T text() {
    skip_space();
    T value{};
    const auto [end, error] = std::from_chars(bytes_.data() + at_, bytes_.data() + bytes_.size(), value);
    if (error != std::errc()) damaged("a number is expected");
    at_ = end - bytes_.data();
    return value;
  }
  template <class T>
  T raw() {
    char buffer[sizeof(T)];
    if (bytes_.size() - at_ < sizeof(T)) damaged("the file ends too early");
    std::memcpy(buffer, bytes_.data() + at_, sizeof(T));
    if (swapped) std::reverse(buffer, buffer + sizeof(T));
    at_ += sizeof(T);
    T value;
    std::memcpy(&value, buffer, sizeof(T));
    return value;
  }
  /// How many items follow; more than there are bytes left means that the file is damaged.
  std::int64_t count() {
    const auto n = size();
    if (n < 0 || n > static_cast<std::int64_t>(bytes_.size() - at_)) damaged("a count is out of range");
    return n;
  }
  std::string word() {
    skip_space();
    const auto begin = at_;
    while (at_ < bytes_.size() && !is_space(bytes_[at_])) ++at_;
    return bytes_.substr(begin, at_ - begin);
  }
  std::string quoted() {
    const auto begin = bytes_.find('"', at_), end = begin == std::string::npos ? begin : bytes_.find('"', begin + 1);
    if (end == std::string::npos) damaged("a quoted name is expected");
    at_ = end + 1;
    return bytes_.substr(begin + 1, end - begin - 1);
  }
  void end_of_line() {
    const auto end = bytes_.find('\n', at_);
    at_ = end == std::string::npos ? bytes_.size() : end + 1;
  }
  void skip_to_end_of(const std::string& section) {
    const auto end = bytes_.find("$End" + section, at_);
    if (end == std::string::npos) damaged("its end is missing");
    at_ = end + 4 + section.size();
  }
  bool at_end() {
    skip_space();
    return at_ >= bytes_.size();
  }
  void begin_section(std::string name) { section_ = std::move(name); }
  [[noreturn]] void damaged(const std::string& what) const {
    throw InputError(where_, fmt::format("section ${} is damaged at byte {}: {}", section_, at_, what),
                     "write the file again from Gmsh, as version 4.1");
  }
  [[noreturn]] void refuse(const std::string& what, const std::string& remedy) const {
    throw InputError(where_, what, remedy);
  }

 private:
  static bool is_space(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }
  void skip_space() {
    while (at_ < bytes_.size() && is_space(bytes_[at_])) ++at_;
  }

  std::string bytes_, where_, section_ = "MeshFormat";
  std::size_t at_ = 0;
};

void read_format(Source& in) {
  const auto version = in.word();
  if (version != "4.1")
    in.refuse(fmt::format("MSH version {}, only 4.1 is read", version), "save the mesh with Mesh.MshFileVersion = 4.1");
  const int type = in.text<int>(), data_size = in.text<int>();
  if (type == 0) return;
  in.end_of_line();
  in.binary = true;
  if (data_size != 8)
    in.refuse(fmt::format("integers of {} bytes, only 8 are read", data_size), "save the mesh on a 64-bit system");
  const int one = in.raw<std::int32_t>();
  if (one == 1) return;
  in.swapped = true;
  if (one != 0x01000000) in.damaged("the byte order cannot be told");
}

void read_physical_names(Source& in, MshFile& file) {
  const int n = in.text<int>();  // this section is text in binary files, too
  for (int i = 0; i < n; ++i) {
    const int dimension = in.text<int>(), tag = in.text<int>();
    file.physical_names[{dimension, tag}] = in.quoted();
  }
}

void read_entities(Source& in, MshFile& file) {
  std::int64_t counts[4];
  for (auto& n : counts) n = in.count();
  for (int dimension = 0; dimension < 4; ++dimension)
    for (std::int64_t i = 0; i < counts[dimension]; ++i) {
      const int tag = in.integer();
      for (int d = 0; d < (dimension == 0 ? 3 : 6); ++d) in.real();  // position or bounding box
      auto& physical = file.physical_tags[{dimension, tag}];
      for (auto n = in.count(); n > 0; --n) physical.push_back(in.integer());
      if (dimension > 0)
        for (auto n = in.count(); n > 0; --n) in.integer();  // bounding entities
    }
}

using Positions = std::unordered_map<std::int64_t, std::int64_t>;

Positions read_nodes(Source& in, MshFile& file) {
  Positions positions;
  const auto blocks = in.count(), total = in.count();
  in.size();  // smallest and
  in.size();  // largest tag
  file.points.reserve(total);
  positions.reserve(total);
  for (std::int64_t b = 0; b < blocks; ++b) {
    const int dimension = in.integer();
    in.integer();  // entity
    const bool parametric = in.integer() != 0;
    const auto n = in.count();
    for (std::int64_t i = 0; i < n; ++i) positions.emplace(in.size(), std::ssize(file.points) + i);
    for (std::int64_t i = 0; i < n; ++i) {
      Vec3<double> x;
      for (int d = 0; d < 3; ++d) x[d] = in.real();
      file.points.push_back(x);
      for (int d = 0; parametric && d < dimension; ++d) in.real();
    }
  }
  if (std::ssize(file.points) != total || positions.size() != file.points.size())
    in.damaged("the number of nodes is wrong or a node tag appears twice");
  return positions;
}

/// Nodes per element of the types that are skipped (points and lines up to third order).
int nodes_of_skipped(const Source& in, int dimension, int type) {
  static const std::map<int, int> skipped = {{15, 1}, {1, 2}, {8, 3}, {26, 4}};
  const auto found = skipped.find(type);
  if (found == skipped.end())
    in.refuse(fmt::format("elements of dimension {} and Gmsh type {}, only linear triangles (2) and tetrahedra (4) are "
                          "possible",
                          dimension, type),
              "mesh with first-order triangles and tetrahedra");
  return found->second;
}

/// Returns the position of each tetrahedron by its tag, for element data.
Positions read_elements(Source& in, MshFile& file, const Positions& positions) {
  Positions tetrahedra;
  constexpr int triangle = 2, tetrahedron = 4;
  const auto node = [&] {
    const auto found = positions.find(in.size());
    if (found == positions.end()) in.damaged("an element names a node that does not exist");
    return found->second;
  };
  const auto blocks = in.count();
  for (int i = 0; i < 3; ++i) in.size();  // number of elements, smallest and largest tag
  for (std::int64_t b = 0; b < blocks; ++b) {
    const int dimension = in.integer(), entity = in.integer(), type = in.integer();
    const auto n = in.count();
    for (std::int64_t i = 0; i < n; ++i) {
      const auto tag = in.size();
      if (type == triangle) {
        file.triangles.push_back({{node(), node(), node()}, entity});
      } else if (type == tetrahedron) {
        tetrahedra.emplace(tag, std::ssize(file.tetrahedra));
        file.tetrahedra.push_back({{node(), node(), node(), node()}, entity});
      } else {
        for (int k = nodes_of_skipped(in, dimension, type); k > 0; --k) in.size();
      }
    }
  }
  return tetrahedra;
}

void read_element_data(Source& in, MshFile& file, const Positions& tetrahedra, const std::vector<std::string>& wanted) {
  std::string name;
  for (int n = in.text<int>(), i = 0; i < n; ++i) {
    const auto tag = in.quoted();
    if (i == 0) name = tag;
  }
  for (int n = in.text<int>(); n > 0; --n) in.text<double>();  // the first is the time
  int components = 0;
  std::int64_t count = 0;
  for (int n = in.text<int>(), i = 0; i < n; ++i) {  // time step, components, elements, partition
    const auto tag = in.text<std::int64_t>();
    if (i == 1) components = static_cast<int>(tag);
    if (i == 2) count = tag;
  }
  if (std::find(wanted.begin(), wanted.end(), name) == wanted.end()) return;
  if (components < 1 || components > 9 || count < 0) in.damaged("its integer tags are out of range");
  in.end_of_line();
  const auto known =
      std::find_if(file.fields.begin(), file.fields.end(), [&](const auto& f) { return f.name == name; });
  if (known != file.fields.end()) in.refuse("holds element data " + name + " twice", "write one time step only");
  mesh::ElementField field{name, components, {}};
  field.values.assign(file.tetrahedra.size() * static_cast<std::size_t>(components), std::nan(""));
  for (std::int64_t k = 0; k < count; ++k) {
    const auto found = tetrahedra.find(in.integer());
    for (int c = 0; c < components; ++c) {
      const double value = in.real();
      if (found != tetrahedra.end()) field.values[static_cast<std::size_t>(found->second * components + c)] = value;
    }
  }
  file.fields.push_back(std::move(field));
}

void require_fields(const Source& in, const MshFile& file, const std::vector<std::string>& wanted) {
  for (const auto& name : wanted)
    if (std::none_of(file.fields.begin(), file.fields.end(), [&](const auto& f) { return f.name == name; }))
      in.refuse("there is no $ElementData called " + name, "write it to the file, or correct the name");
}

}  // namespace

MshFile read_msh(const std::filesystem::path& path, const std::vector<std::string>& fields) {
  std::ifstream stream(path, std::ios::binary);
  if (!std::filesystem::is_regular_file(path) || !stream)
    throw InputError(path.string(), "there is no such file, or it cannot be read", "give the path of a Gmsh mesh");
  Source in({std::istreambuf_iterator<char>(stream), {}}, path.string());
  MshFile file;
  Positions positions, tetrahedra;
  if (in.word() != "$MeshFormat") in.refuse("does not begin with $MeshFormat", "give a Gmsh mesh (.msh)");
  read_format(in);
  in.skip_to_end_of("MeshFormat");
  while (!in.at_end()) {
    const auto header = in.word();
    if (header[0] != '$') in.damaged("the next section is expected");
    const auto section = header.substr(1);
    in.begin_section(section);
    in.end_of_line();
    if (section == "PhysicalNames") read_physical_names(in, file);
    if (section == "Entities") read_entities(in, file);
    if (section == "PartitionedEntities")
      in.refuse("the mesh is partitioned", "save it unpartitioned, tunica partitions it itself");
    if (section == "Nodes") positions = read_nodes(in, file);
    if (section == "Elements") tetrahedra = read_elements(in, file, positions);
    if (section == "ElementData" && !fields.empty()) read_element_data(in, file, tetrahedra, fields);
    in.skip_to_end_of(section);
  }
  require_fields(in, file, fields);
  return file;
}

}  // namespace tunica::mesh_io
