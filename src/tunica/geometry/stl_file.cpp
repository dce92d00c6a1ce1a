#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cstring>
#include <map>

#include "tunica/base/error.hpp"
#include "tunica/geometry/surface_formats.hpp"
#include "tunica/geometry/text_lines.hpp"

namespace tunica::geometry {

namespace {

constexpr std::size_t head_bytes = 84, triangle_bytes = 50;

/// Collects triangles by the coordinates of their corners.
class Merged {
 public:
  void add(const std::array<Point, 3>& corners) {
    Triangle triangle;
    for (int i = 0; i < 3; ++i) {
      const std::array<double, 3> key = {corners[i][0], corners[i][1], corners[i][2]};
      const auto [at, added] = numbers_.emplace(key, std::ssize(surface.points));
      if (added) surface.points.push_back(corners[i]);
      triangle[i] = at->second;
    }
    surface.triangles.push_back(triangle);
  }
  TriangleSurface surface;

 private:
  /// Bits, not values: not-a-numbers have no order.
  struct Less {
    bool operator()(const std::array<double, 3>& a, const std::array<double, 3>& b) const {
      using Bits = std::array<std::uint64_t, 3>;
      return std::bit_cast<Bits>(a) < std::bit_cast<Bits>(b);
    }
  };
  std::map<std::array<double, 3>, std::int64_t, Less> numbers_;
};

/// Little-endian, as all of the format.
std::uint32_t word_at(const std::string& content, std::size_t place) {
  std::uint32_t value = 0;
  for (int k = 3; k >= 0; --k)
    value = (value << 8) | static_cast<unsigned char>(content[place + static_cast<std::size_t>(k)]);
  return value;
}

TriangleSurface from_binary(const std::string& content, std::size_t triangles) {
  Merged merged;
  for (std::size_t t = 0; t < triangles; ++t) {
    std::array<Point, 3> corners;
    auto place = head_bytes + t * triangle_bytes + 12;  // behind the normal
    for (auto& corner : corners)
      for (int d = 0; d < 3; ++d, place += 4) {
        const double x = std::bit_cast<float>(word_at(content, place));
        corner[d] = x == 0 ? 0 : x;  // both zeros are one place
      }
    merged.add(corners);
  }
  return std::move(merged.surface);
}

std::string lower_case(std::string_view word) {
  std::string text(word);
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

TriangleSurface from_text(const std::string& content, const std::string& where) {
  Merged merged;
  std::array<Point, 3> corners;
  std::size_t found = 0;
  bool in_loop = false, in_solid = false;
  TextLines lines(content, where);
  while (lines.next()) {
    if (lines.words().empty()) continue;
    const auto word = lower_case(lines.words()[0]);
    if (word == "solid" || word == "endsolid") {
      if (in_loop) lines.refuse("a facet does not end");
      in_solid = word == "solid";
    } else if (word == "outer") {
      in_loop = true;
      found = 0;
    } else if (word == "vertex") {
      if (!in_loop || found == 3)
        lines.refuse(in_loop ? "a facet has more than three corners" : "a corner belongs to no facet");
      for (std::size_t d = 0; d < 3; ++d)
        if (corners[found][d] = lines.real(d + 1); corners[found][d] == 0) corners[found][d] = 0;
      ++found;
    } else if (word == "endloop") {
      if (!in_loop || found != 3) lines.refuse(fmt::format("a facet has {} corners, 3 are needed", found));
      merged.add(corners);
      in_loop = false;
    } else if (word != "facet" && word != "endfacet") {
      lines.refuse(fmt::format("'{}' is no word of an STL file", shown(lines.words()[0])));
    }
  }
  if (in_loop || in_solid) lines.refuse("the file ends before `endsolid`");
  return std::move(merged.surface);
}

}  // namespace

TriangleSurface read_stl(const std::string& content, const std::string& where) {
  const auto first = content.find_first_not_of(" \t\r\n");
  const bool solid = first != std::string::npos && lower_case(content.substr(first, 5)) == "solid";
  const bool has_head = content.size() >= head_bytes;
  const std::size_t triangles = has_head ? word_at(content, 80) : 0;
  // Some binary files begin with the word of the text files.
  if (has_head && content.size() == head_bytes + triangle_bytes * triangles) return from_binary(content, triangles);
  if (solid && content.find('\0') == std::string::npos) return from_text(content, where);
  if (!has_head)
    throw InputError(where,
                     fmt::format("{} bytes are no STL file: it begins neither with `solid` nor has a head of {} bytes",
                                 content.size(), head_bytes),
                     "export or copy the surface again");
  throw InputError(where,
                   fmt::format("its head says {} triangles, which are {} bytes, but the file has {}", triangles,
                               head_bytes + triangle_bytes * triangles, content.size()),
                   "export or copy the surface again, as binary or ASCII STL");
}

}  // namespace tunica::geometry
