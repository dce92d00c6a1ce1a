#include "tunica/mesh_io/msh_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>
#include <new>
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
  /// How many items follow, of that many numbers each and, where the file is binary, that many bytes; more than the
  /// file has room for means that it is damaged.
  std::int64_t count(std::int64_t numbers, std::int64_t bytes) {
    return checked_count(size(), binary ? bytes : 2 * numbers);
  }
  /// The same in sections that are text in binary files, too.
  int text_count(std::int64_t numbers) { return static_cast<int>(checked_count(text<int>(), 2 * numbers)); }
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
  /// What was counted must be all that the section holds.
  void expect_end_of(const std::string& section) {
    const auto begin = at_;
    if (word() == "$End" + section) return;
    at_ = begin;
    damaged("it holds more, or less, than its counts say");
  }
  std::size_t place() const { return at_; }
  void go_to(std::size_t place) { at_ = place; }
  bool at_end() {
    skip_space();
    return at_ >= bytes_.size();
  }
  void begin_section(std::string name) { section_ = std::move(name); }
  [[noreturn]] void damaged(const std::string& what) const {
    throw InputError(where_, fmt::format("section ${} is damaged at byte {}: {}", section_, at_, what),
                     "write the file again from Gmsh, as version 4.1");
  }
  [[noreturn]] void out_of_range(const std::string& what, std::int64_t value) const {
    damaged(fmt::format("{} {} is out of range", what, value));
  }
  [[noreturn]] void refuse(const std::string& what, const std::string& remedy) const {
    throw InputError(where_, what, remedy);
  }

  std::int64_t checked_count(std::int64_t n, std::int64_t bytes_each) const {
    const auto left = static_cast<std::int64_t>(bytes_.size() - at_);
    // The last item of a text may lack the space after its last number.
    if (n < 0 || n > (left + 1) / bytes_each)
      damaged(fmt::format("a count of {} does not fit in the {} bytes that follow", n, left));
    return n;
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

/// The number without the sign, which is the orientation.
int group_number(const Source& in, int number) {
  if (number == std::numeric_limits<int>::min()) in.out_of_range("the physical group", number);
  return std::abs(number);
}

void read_physical_names(Source& in, MshFile& file) {
  for (int n = in.text_count(3); n > 0; --n) {
    const int dimension = in.text<int>(), tag = in.text<int>();
    file.physical_names[{dimension, group_number(in, tag)}] = in.quoted();
  }
}

void read_entities(Source& in, MshFile& file) {
  std::int64_t counts[4];
  for (auto& n : counts) n = in.count(5, 36);  // a point is the shortest: tag, position, number of groups
  for (int dimension = 0; dimension < 4; ++dimension)
    for (std::int64_t i = 0; i < counts[dimension]; ++i) {
      const int tag = in.integer();
      for (int d = 0; d < (dimension == 0 ? 3 : 6); ++d) in.real();  // position or bounding box
      auto& physical = file.physical_tags[{dimension, tag}];
      for (auto n = in.count(1, 4); n > 0; --n) physical.push_back(group_number(in, in.integer()));
      if (dimension > 0)
        for (auto n = in.count(1, 4); n > 0; --n) in.integer();  // bounding entities
    }
}

using Positions = std::unordered_map<std::int64_t, std::int64_t>;

Positions read_nodes(Source& in, MshFile& file) {
  Positions positions;
  const auto blocks = in.count(4, 20), total = in.count(4, 32);
  in.size();  // smallest and
  in.size();  // largest tag
  file.points.reserve(total);
  positions.reserve(total);
  for (std::int64_t b = 0; b < blocks; ++b) {
    const int dimension = in.integer();
    if (dimension < 0 || dimension > 3) in.out_of_range("the dimension", dimension);
    in.integer();  // entity
    const bool parametric = in.integer() != 0;
    const auto n = in.count(4, 32);
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

/// Returns the position of each tetrahedron by its tag, for element data; -1 for a tag that several have.
Positions read_elements(Source& in, MshFile& file, const Positions& positions) {
  Positions tetrahedra;
  constexpr int triangle = 2, tetrahedron = 4;
  const auto node = [&] {
    const auto found = positions.find(in.size());
    if (found == positions.end()) in.damaged("an element names a node that does not exist");
    return found->second;
  };
  const auto blocks = in.count(4, 20), total = in.count(2, 16);
  std::int64_t read = 0;
  for (int i = 0; i < 2; ++i) in.size();  // smallest and largest tag
  for (std::int64_t b = 0; b < blocks; ++b) {
    const int dimension = in.integer(), entity = in.integer(), type = in.integer();
    const auto n = in.count(2, 16);
    read += n;
    for (std::int64_t i = 0; i < n; ++i) {
      const auto tag = in.size();
      if (type == triangle) {
        file.triangles.push_back({{node(), node(), node()}, entity});
      } else if (type == tetrahedron) {
        if (!tetrahedra.emplace(tag, std::ssize(file.tetrahedra)).second) tetrahedra[tag] = -1;
        file.tetrahedra.push_back({{node(), node(), node(), node()}, entity});
      } else {
        for (int k = nodes_of_skipped(in, dimension, type); k > 0; --k) in.size();
      }
    }
  }
  if (read != total) in.damaged(fmt::format("its head says {} elements, {} are there", total, read));
  return tetrahedra;
}

/// Reads the one that `wanted` names, in a section whose head is text in binary files, too.
void read_element_data(Source& in, MshFile& file, const Positions& tetrahedra, const std::vector<std::string>& wanted) {
  std::string name;
  for (int n = in.text_count(1), i = 0; i < n; ++i) {
    const auto tag = in.quoted();
    if (i == 0) name = tag;
  }
  if (std::find(wanted.begin(), wanted.end(), name) == wanted.end()) return;
  for (int n = in.text_count(1); n > 0; --n) in.text<double>();  // the first is the time
  std::int64_t components = 0, count = 0;
  for (int n = in.text_count(1), i = 0; i < n; ++i) {  // time step, components, elements, partition
    const auto tag = in.text<std::int64_t>();
    if (i == 1) components = tag;
    if (i == 2) count = tag;
  }
  if (components < 1 || components > 9) in.out_of_range("the number of components", components);
  in.end_of_line();
  count = in.checked_count(count, in.binary ? 4 + 8 * components : 2 + 2 * components);
  const auto known =
      std::find_if(file.fields.begin(), file.fields.end(), [&](const auto& f) { return f.name == name; });
  if (known != file.fields.end()) in.refuse("holds element data " + name + " twice", "write one time step only");
  mesh::ElementField field{name, static_cast<int>(components), {}};
  field.values.assign(file.tetrahedra.size() * static_cast<std::size_t>(components), std::nan(""));
  for (std::int64_t k = 0; k < count; ++k) {
    const int tag = in.integer();
    const auto found = tetrahedra.find(tag);
    if (found != tetrahedra.end() && found->second < 0)
      in.damaged(fmt::format("it names element {}, but several elements have this number", tag));
    for (int c = 0; c < components; ++c) {
      const double value = in.real();
      if (found != tetrahedra.end()) field.values[static_cast<std::size_t>(found->second * components + c)] = value;
    }
  }
  in.expect_end_of("ElementData");
  file.fields.push_back(std::move(field));
}

void require_fields(const Source& in, const MshFile& file, const std::vector<std::string>& wanted) {
  for (const auto& name : wanted)
    if (std::none_of(file.fields.begin(), file.fields.end(), [&](const auto& f) { return f.name == name; }))
      in.refuse("there is no $ElementData called " + name, "write it to the file, or correct the name");
}

std::string whole_file(const std::filesystem::path& path) {
  std::error_code error;
  std::ifstream stream(path, std::ios::binary);
  if (!std::filesystem::is_regular_file(path, error) || !stream)
    throw InputError(path.string(), "there is no such file, or it cannot be read", "give the path of a Gmsh mesh");
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Where the content of each section begins, in the order of the file.
using Sections = std::vector<std::pair<std::string, std::size_t>>;

Sections find_sections(Source& in) {
  constexpr const char* once[] = {"PhysicalNames", "Entities", "Nodes", "Elements"};
  Sections sections;
  while (!in.at_end()) {
    const auto header = in.word();
    if (header[0] != '$') in.damaged("the next section is expected");
    const auto section = header.substr(1);
    in.begin_section(section);
    if (section == "PartitionedEntities")
      in.refuse("the mesh is partitioned", "save it unpartitioned, tunica partitions it itself");
    const bool again = std::any_of(sections.begin(), sections.end(), [&](const auto& s) { return s.first == section; });
    if (again && std::find(std::begin(once), std::end(once), section) != std::end(once))
      in.refuse(fmt::format("section ${} is there twice", section), "keep one mesh in the file");
    in.end_of_line();
    sections.emplace_back(section, in.place());
    in.skip_to_end_of(section);
  }
  return sections;
}

/// Calls `read` at the begin of every section of this name.
template <class Read>
void each_section(Source& in, const Sections& sections, const std::string& name, const Read& read) {
  for (const auto& [section, begin] : sections) {
    if (section != name) continue;
    in.begin_section(name);
    in.go_to(begin);
    read();
  }
}

/// The sections in the order in which they need each other, whatever their order in the file is.
MshFile read_sections(Source& in, const std::vector<std::string>& fields) {
  MshFile file;
  Positions positions, tetrahedra;
  if (in.at_end()) in.refuse("is empty", "write the mesh again from Gmsh");
  if (in.word() != "$MeshFormat") in.refuse("does not begin with $MeshFormat", "give a Gmsh mesh (.msh)");
  read_format(in);
  in.expect_end_of("MeshFormat");
  const auto sections = find_sections(in);
  const auto each = [&](const std::string& name, const auto& read) {
    each_section(in, sections, name, [&] {
      read();
      in.expect_end_of(name);
    });
  };
  each("PhysicalNames", [&] { read_physical_names(in, file); });
  each("Entities", [&] { read_entities(in, file); });
  each("Nodes", [&] { positions = read_nodes(in, file); });
  each("Elements", [&] { tetrahedra = read_elements(in, file, positions); });
  each_section(in, sections, "ElementData", [&] { read_element_data(in, file, tetrahedra, fields); });
  require_fields(in, file, fields);
  return file;
}

}  // namespace

MshFile read_msh(const std::filesystem::path& path, const std::vector<std::string>& fields) {
  try {
    Source in(whole_file(path), path.string());
    return read_sections(in, fields);
  } catch (const std::bad_alloc&) {
    throw InputError(path.string(), "needs more memory than this machine has",
                     "give a coarser mesh, or a larger machine");
  }
}

}  // namespace tunica::mesh_io
