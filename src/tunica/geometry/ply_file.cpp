#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

#include "tunica/base/error.hpp"
#include "tunica/geometry/surface_formats.hpp"
#include "tunica/geometry/text_lines.hpp"

namespace tunica::geometry {

namespace {

enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
enum class Form { ascii, little_endian, big_endian };

struct Property {
  std::string name;
  Type type;
  std::optional<Type> length;  ///< of a list: the type of its length
};

struct Element {
  std::string name;
  std::int64_t count = 0;
  std::vector<Property> properties;
};

struct Head {
  Form form = Form::ascii;
  std::vector<Element> elements;
  std::size_t end = 0;  ///< where the data begin
};

std::size_t bytes_of(Type type) {
  constexpr std::size_t bytes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return bytes[static_cast<std::size_t>(type)];
}

Type type_of(const TextLines& lines, std::size_t word) {
  constexpr std::pair<std::string_view, Type> names[] = {
      {"char", Type::int8},     {"int8", Type::int8},       {"uchar", Type::uint8},    {"uint8", Type::uint8},
      {"short", Type::int16},   {"int16", Type::int16},     {"ushort", Type::uint16},  {"uint16", Type::uint16},
      {"int", Type::int32},     {"int32", Type::int32},     {"uint", Type::uint32},    {"uint32", Type::uint32},
      {"float", Type::float32}, {"float32", Type::float32}, {"double", Type::float64}, {"float64", Type::float64}};
  const auto& words = lines.words();
  for (const auto& [name, type] : names)
    if (word < words.size() && words[word] == name) return type;
  lines.refuse(fmt::format("'{}' is no type of a property", word < words.size() ? shown(words[word]) : ""));
}

Property property_of(const TextLines& lines) {
  const auto& words = lines.words();
  const bool list = words.size() > 1 && words[1] == "list";
  if (words.size() != (list ? 5u : 3u)) lines.refuse("a property has a type and a name");
  if (!list) return {std::string(words[2]), type_of(lines, 1), std::nullopt};
  return {std::string(words[4]), type_of(lines, 3), type_of(lines, 2)};
}

Form form_of(const TextLines& lines) {
  const std::string_view name = lines.words().size() > 1 ? lines.words()[1] : "";
  if (name == "ascii") return Form::ascii;
  if (name == "binary_little_endian") return Form::little_endian;
  if (name == "binary_big_endian") return Form::big_endian;
  lines.refuse(fmt::format("'{}' is no format of a PLY file", shown(name)));
}

Head read_head(const std::string& content, const std::string& where) {
  Head head;
  TextLines lines(content, where);
  if (!lines.next() || lines.words().empty() || lines.words()[0] != "ply") lines.refuse("is no PLY file");
  bool has_form = false;
  while (lines.next()) {
    if (lines.words().empty()) continue;
    const auto& word = lines.words()[0];
    if (word == "end_header") {
      if (!has_form) lines.refuse("the head has no line `format`");
      head.end = lines.place();
      return head;
    }
    if (word == "format") {
      head.form = form_of(lines);
      has_form = true;
    } else if (word == "element") {
      const auto count = lines.integer(2);
      if (count < 0) lines.refuse(fmt::format("there cannot be {} of an element", count));
      head.elements.push_back({std::string(lines.words()[1]), count, {}});
    } else if (word == "property") {
      if (head.elements.empty()) lines.refuse("a property belongs to no element");
      head.elements.back().properties.push_back(property_of(lines));
    } else if (word != "comment" && word != "obj_info") {
      lines.refuse(fmt::format("'{}' is no word of the head of a PLY file", shown(word)));
    }
  }
  lines.refuse("the file ends before `end_header`");
}

/// The numbers behind the head.
class Values {
 public:
  Values(const std::string& content, const Head& head, const std::string& where)
      : content_(content), form_(head.form), at_(head.end), where_(where) {}

  double next(Type type) { return form_ == Form::ascii ? text() : binary(type); }
  /// Throws when `count` items of at least one number or that many bytes each cannot follow.
  void expect(std::int64_t count, std::size_t bytes, const std::string& what) const {
    const auto each = form_ == Form::ascii ? 2 : std::max<std::size_t>(bytes, 1);
    const auto left = content_.size() - at_ + 1;  // the last number of a text may end without a space
    if (static_cast<std::uint64_t>(count) > left / each)
      refuse(fmt::format("{} {} are announced, but only {} bytes follow", count, what, left - 1));
  }
  /// Of the next list.
  std::int64_t length(const Property& list) {
    const double n = next(*list.length);
    if (!(n >= 0 && n == std::floor(n) && n < 1e9)) refuse(fmt::format("a list cannot have {} items", n));
    expect(static_cast<std::int64_t>(n), bytes_of(list.type), "items in a list");
    return static_cast<std::int64_t>(n);
  }
  [[noreturn]] void refuse(const std::string& what) const {
    const auto end = content_.begin() + static_cast<std::ptrdiff_t>(at_);
    const auto place = form_ == Form::ascii ? fmt::format("{}:{}", where_, 1 + std::count(content_.begin(), end, '\n'))
                                            : fmt::format("{}, byte {}", where_, at_);
    throw InputError(place, what, "export or copy the surface again");
  }

 private:
  double text() {
    constexpr const char* space = " \t\r\n";
    at_ = std::min(content_.find_first_not_of(space, at_), content_.size());
    if (at_ == content_.size()) refuse("the file ends before its last number");
    const auto end = std::min(content_.find_first_of(space, at_), content_.size());
    const auto word = std::string_view(content_).substr(at_, end - at_);
    const auto value = number_of(word);
    if (!value) refuse(fmt::format("'{}' is no number", shown(word)));
    at_ = end;
    return *value;
  }
  double binary(Type type) {
    const auto size = bytes_of(type);
    if (content_.size() - at_ < size) refuse("the file ends before its last number");
    std::uint64_t bits = 0;
    for (std::size_t k = 0; k < size; ++k) {
      const auto byte = content_[at_ + (form_ == Form::big_endian ? k : size - 1 - k)];
      bits = (bits << 8) | static_cast<unsigned char>(byte);
    }
    at_ += size;
    switch (type) {
      case Type::int8:
        return static_cast<std::int8_t>(bits);
      case Type::int16:
        return static_cast<std::int16_t>(bits);
      case Type::int32:
        return static_cast<std::int32_t>(bits);
      case Type::float32:
        return std::bit_cast<float>(static_cast<std::uint32_t>(bits));
      case Type::float64:
        return std::bit_cast<double>(bits);
      default:
        return static_cast<double>(bits);
    }
  }

  const std::string& content_;
  Form form_;
  std::size_t at_;
  const std::string& where_;
};

std::size_t smallest_bytes(const Element& element) {
  std::size_t bytes = 0;
  for (const auto& p : element.properties) bytes += bytes_of(p.length.value_or(p.type));
  return bytes;
}

void read_vertices(Values& values, const Element& element, TriangleSurface& surface) {
  int axis_of[3] = {-1, -1, -1};
  for (std::size_t p = 0; p < element.properties.size(); ++p)
    for (int d = 0; d < 3; ++d)
      if (element.properties[p].name == std::string(1, "xyz"[d]) && !element.properties[p].length)
        axis_of[d] = static_cast<int>(p);
  for (int d = 0; d < 3; ++d)
    if (axis_of[d] < 0) values.refuse(fmt::format("element vertex has no property {}", "xyz"[d]));
  for (std::int64_t n = 0; n < element.count; ++n) {
    Point x{{0, 0, 0}};
    for (int p = 0; p < static_cast<int>(element.properties.size()); ++p) {
      const auto& property = element.properties[p];
      for (auto items = property.length ? values.length(property) : 1; items > 0; --items) {
        const double value = values.next(property.type);
        for (int d = 0; d < 3; ++d)
          if (axis_of[d] == p) x[d] = value;
      }
    }
    surface.points.push_back(x);
  }
}

/// Returns how many are no triangles.
std::int64_t read_faces(Values& values, const Element& element, std::int64_t points, TriangleSurface& surface) {
  const auto is_corners = [](const Property& p) {
    return p.length && (p.name == "vertex_indices" || p.name == "vertex_index");
  };
  if (element.count > 0 && std::none_of(element.properties.begin(), element.properties.end(), is_corners))
    values.refuse("element face has no list vertex_indices");
  std::int64_t others = 0;
  for (std::int64_t n = 0; n < element.count; ++n)
    for (const auto& property : element.properties) {
      const auto items = property.length ? values.length(property) : 1;
      std::vector<std::int64_t> corners;
      for (std::int64_t i = 0; i < items; ++i) {
        const double value = values.next(property.type);
        if (!is_corners(property)) continue;
        if (!(value >= 0 && value < static_cast<double>(points) && value == std::floor(value)))
          values.refuse(fmt::format("a face names point {}, but there are points 0 to {}", value, points - 1));
        corners.push_back(static_cast<std::int64_t>(value));
      }
      if (!is_corners(property)) continue;
      if (items == 3)
        surface.triangles.push_back({corners[0], corners[1], corners[2]});
      else
        ++others;
    }
  return others;
}

void skip(Values& values, const Element& element) {
  for (std::int64_t n = 0; n < element.count; ++n)
    for (const auto& property : element.properties)
      for (auto items = property.length ? values.length(property) : 1; items > 0; --items) values.next(property.type);
}

}  // namespace

TriangleSurface read_ply(const std::string& content, const std::string& where) {
  const auto head = read_head(content, where);
  std::int64_t points = 0, others = 0;
  for (const auto& element : head.elements)
    if (element.name == "vertex") points += element.count;
  TriangleSurface surface;
  Values values(content, head, where);
  for (const auto& element : head.elements) {
    if (element.properties.empty() && element.count > 0)
      values.refuse(fmt::format("element {} has no properties", element.name));
    values.expect(element.count, smallest_bytes(element), "of element " + element.name);
    if (element.name == "tristrips" && element.count > 0)
      values.refuse("it holds triangle strips, only separate triangles are read");
    if (element.name == "vertex")
      read_vertices(values, element, surface);
    else if (element.name == "face")
      others += read_faces(values, element, points, surface);
    else
      skip(values, element);
  }
  if (others > 0) refuse_polygons(where, others, others + std::ssize(surface.triangles));
  return surface;
}

}  // namespace tunica::geometry
