#include <fmt/format.h>

#include "tunica/geometry/surface_formats.hpp"
#include "tunica/geometry/text_lines.hpp"

namespace tunica::geometry {

namespace {

/// "7", "7/2", "7//3" or "-1/2/3": the point, from 0; negative numbers count back from the last point so far.
std::int64_t corner(const TextLines& lines, std::string_view word, std::int64_t points) {
  const auto number = lines.integer(word.substr(0, word.find('/')));
  const auto place = number < 0 ? points + number : number - 1;
  if (place < 0 || place >= points)
    lines.refuse(fmt::format("a face names point {}, but there are {} points up to here", number, points));
  return place;
}

}  // namespace

TriangleSurface read_obj(const std::string& content, const std::string& where) {
  TriangleSurface surface;
  std::int64_t others = 0;
  TextLines lines(content, where);
  while (lines.next()) {
    const auto& words = lines.words();
    if (words.empty()) continue;
    if (words[0] == "v") surface.points.push_back({{lines.real(1), lines.real(2), lines.real(3)}});
    if (words[0] != "f") continue;
    if (words.size() < 4) lines.refuse("a face has fewer than three corners");
    Triangle triangle{};
    for (std::size_t i = 1; i < words.size(); ++i) {
      const auto point = corner(lines, words[i], std::ssize(surface.points));
      if (i <= 3) triangle[i - 1] = point;
    }
    if (words.size() == 4)
      surface.triangles.push_back(triangle);
    else
      ++others;
  }
  if (others > 0) refuse_polygons(where, others, others + std::ssize(surface.triangles));
  return surface;
}

}  // namespace tunica::geometry
