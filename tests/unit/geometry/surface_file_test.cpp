#include "tunica/geometry/surface_file.hpp"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <regex>

#include "small_surfaces.hpp"

namespace tunica::geometry {
namespace {

using namespace test;

std::filesystem::path write_text(const Folder& folder, const std::string& name, const std::string& text) {
  std::ofstream(folder.path / name) << text;
  return folder.path / name;
}

TEST(SurfaceFile, WrittenSurfaceIsReadBackInItsUnit) {
  const Folder folder;
  const auto surface = tube(3.0, 5.0, 8, 4);
  write_surface(surface, folder.path / "tube.vtp", {{"h", std::vector<double>(surface.points.size(), 1.0)}});
  const auto read = read_surface(folder.path / "tube.vtp", 1e-3);
  EXPECT_EQ(read.triangles, surface.triangles);
  ASSERT_EQ(read.points.size(), surface.points.size());
  for (std::size_t p = 0; p < read.points.size(); ++p)
    EXPECT_NEAR(norm(read.points[p] - 1e-3 * surface.points[p]), 0, 1e-15);
}

TEST(SurfaceFile, ReadsStlPlyAndObj) {
  const Folder folder;
  const auto stl =
      write_text(folder, "one.STL",
                 "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 2 0 0\nvertex 0 2 0\nendloop\n"
                 "endfacet\nendsolid a\n");
  const auto ply =
      write_text(folder, "one.ply",
                 "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                 "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n2 0 0\n0 2 0\n3 0 1 2\n");
  const auto obj = write_text(folder, "one.obj", "v 0 0 0\nv 2 0 0\nv 0 2 0\nf 1 2 3\n");
  for (const auto& path : {stl, ply, obj}) {
    const auto surface = read_surface(path, 0.5);
    ASSERT_EQ(surface.triangles.size(), 1u) << path;
    EXPECT_NEAR(area(surface), 0.5, 1e-12) << path;
  }
}

TEST(SurfaceFile, SaysWhatCannotBeRead) {
  const Folder folder;
  const auto refuses = [&](const std::filesystem::path& path, double unit, const std::string& why) {
    const auto text = message_of<InputError>([&] { read_surface(path, unit); });
    EXPECT_TRUE(says(text, why)) << text;
  };
  refuses(folder.path / "none.vtp", 1, "there is no such file");
  refuses(write_text(folder, "a.xyz", "1 2 3\n"), 1, "'.xyz' is no known kind");
  refuses(write_text(folder, "quad.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"), 1,
          "1 of 1 cells are no triangles");
  refuses(write_text(folder, "empty.obj", "v 0 0 0\n"), 1, "holds no triangles");
  refuses(write_text(folder, "damaged.ply", "ply\nformat ascii 1.0\nelement"), 1,
          "damaged.ply:3: '' is no whole number");
  refuses(write_text(folder, "one.obj", "v 0 0 0\nv 2 0 0\nv 0 2 0\nf 1 2 3\n"), 0, "must be positive");
}

TEST(SurfaceFile, SaysWhereItCannotWrite) {
  const auto text = message_of<InputError>([] { write_spots({{{{1, 2, 3}}, "x"}}, "/nowhere/spots.vtp"); });
  EXPECT_TRUE(says(text, "cannot be written")) << text;
}

// --- files that are damaged, or lie about themselves ----------------------------------------------------------------

/// What refuses this content under this name; "accepted" when nothing does.
std::string refusal(const std::string& name, const std::string& content, double unit = 1) {
  const Folder folder;
  const auto path = write_text(folder, name, content);
  try {
    read_surface(path, unit);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

void expect_refusal(const std::string& name, const std::string& content, const std::string& why) {
  const auto text = refusal(name, content);
  EXPECT_TRUE(says(text, why)) << name << ": " << text.substr(0, 600) << "\nexpected: " << why;
  EXPECT_TRUE(says(text, name)) << text.substr(0, 600);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

template <class T>
std::string bytes(T value, bool swapped = false) {
  std::string text(reinterpret_cast<const char*>(&value), sizeof(T));
  if (swapped) std::reverse(text.begin(), text.end());
  return text;
}

const std::string ascii_stl =
    "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 2 0 0\nvertex 0 2 0\nendloop\nendfacet\n"
    "facet normal 0 0 1\nouter loop\nvertex 2 0 0\nvertex 2 2 0\nvertex 0 2 0\nendloop\nendfacet\nendsolid a\n";

std::string binary_stl(std::uint32_t claimed = 2, const std::string& title = "solid, as some programs begin") {
  std::string text = title + std::string(80 - title.size(), ' ') + bytes(claimed);
  const float corners[2][9] = {{0, 0, 0, 2, 0, 0, 0, 2, 0}, {2, 0, 0, 2, 2, 0, 0, 2, 0}};
  for (const auto& triangle : corners) {
    for (int i = 0; i < 3; ++i) text += bytes(0.0f);
    for (const float x : triangle) text += bytes(x);
    text += std::string(2, '\0');
  }
  return text;
}

std::string ply_head(const std::string& format, const std::string& faces = "2") {
  return "ply\nformat " + format +
         " 1.0\ncomment of no meaning\nelement vertex 4\nproperty float x\nproperty float y\n"
         "property uchar red\nproperty float z\nelement face " +
         faces +
         "\nproperty uchar flags\nproperty list uchar int vertex_indices\nelement edge 1\nproperty list int8 double w\n"
         "end_header\n";
}
const std::string ascii_ply =
    ply_head("ascii") + "0 0 9 0\n2 0 9 0\n2 2 9 0\n0 2 9 0\n7 3 0 1 3\n7 3 1 2 3\n2 0.5 0.25\n";

std::string binary_ply(bool big) {
  std::string text = ply_head(big ? "binary_big_endian" : "binary_little_endian");
  for (const auto& [x, y] : {std::pair(0.0f, 0.0f), {2.0f, 0.0f}, {2.0f, 2.0f}, {0.0f, 2.0f}})
    text += bytes(x, big) + bytes(y, big) + '\x09' + bytes(0.0f, big);
  for (const auto& t : {std::array{0, 1, 3}, std::array{1, 2, 3}}) {
    text += "\x07\x03";
    for (const int n : t) text += bytes(n, big);
  }
  return text + "\x01" + bytes(0.5, big);
}

TEST(SurfaceFile, ReadsEveryFormOfTheFormats) {
  const Folder folder;
  const std::pair<std::string, std::string> files[] = {
      {"text.stl", ascii_stl},
      {"crlf.stl", std::regex_replace(replaced(ascii_stl, "solid", "  SOLID"), std::regex("\n"), "\r\n")},
      {"binary.stl", binary_stl()},
      {"text.PLY", ascii_ply},
      {"little.ply", binary_ply(false)},
      {"big.ply", binary_ply(true)},
      {"square.obj", "v 0 0 0\nv +2 0 0 1\nv 2 2.0e0 0\nv 0 2 0\nvt 0 0\nf 1/1 2/1/1 \\\n -1\nf 2 3 4\nl 1 2\n"}};
  for (const auto& [name, content] : files) {
    const auto surface = read_surface(write_text(folder, name, content), 0.5);
    EXPECT_EQ(surface.points.size(), 4u) << name;
    ASSERT_EQ(surface.triangles.size(), 2u) << name;
    EXPECT_NEAR(area(surface), 1, 1e-12) << name;
  }
}

TEST(SurfaceFile, RefusesFilesThatEndTooEarlyWhereverTheyDo) {
  const std::pair<std::string, std::string> files[] = {
      {"a.stl", ascii_stl}, {"b.stl", binary_stl()}, {"a.ply", ascii_ply}, {"b.ply", binary_ply(false)}};
  for (const auto& [name, content] : files)
    for (std::size_t length = 0; length + 4 < content.size(); length += 3)
      EXPECT_NE(refusal(name, content.substr(0, length)), "accepted") << name << " " << length;
}

TEST(SurfaceFile, RefusesStlFilesThatAreNotWhatTheySay) {
  for (const std::uint32_t claimed : {1u, 3u, 1000000u, 0xffffffffu})
    expect_refusal("a.stl", binary_stl(claimed), "but the file has 184");
  expect_refusal("a.stl", "", "is empty");
  expect_refusal("a.stl", "hello", "5 bytes are no STL file");
  expect_refusal("a.stl", binary_stl(0).substr(0, 84), "holds no triangles");
  expect_refusal("a.stl", replaced(ascii_stl, "vertex 2 0 0", "vertex 2 0"), "a.stl:5: a number is missing");
  expect_refusal("a.stl", replaced(ascii_stl, "vertex 2 0 0", "vertex 2,5 0 0"), "a.stl:5: '2,5' is no number");
  expect_refusal("a.stl", replaced(ascii_stl, "endloop", "vertex 1 1 1\nendloop"),
                 "a.stl:7: a facet has more than three");
  expect_refusal("a.stl", replaced(ascii_stl, "vertex 2 0 0\n", ""), "a facet has 2 corners");
  expect_refusal("a.stl", replaced(ascii_stl, "outer loop\n", ""), "belongs to no facet");
  expect_refusal("a.stl", replaced(ascii_stl, "endloop", "what"), "a.stl:7: 'what' is no word of an STL file");
  for (const char* value : {"nan", "inf", "-inf"})
    expect_refusal("a.stl", replaced(ascii_stl, "vertex 2 0 0", fmt::format("vertex {} 0 0", value)), "are not finite");
}

TEST(SurfaceFile, RefusesPlyFilesThatAreNotWhatTheySay) {
  for (const char* count : {"3", "1000000000", "4000000000000000000"}) {
    expect_refusal("a.ply", replaced(ascii_ply, "face 2", fmt::format("face {}", count)), "a.ply:");
    expect_refusal("a.ply", replaced(ascii_ply, "vertex 4", fmt::format("vertex {}", count)), "a.ply:");
    EXPECT_NE(refusal("b.ply", replaced(binary_ply(false), "face 2", fmt::format("face {}", count))), "accepted");
    EXPECT_NE(refusal("b.ply", replaced(binary_ply(false), "vertex 4", fmt::format("vertex {}", count))), "accepted");
  }
  expect_refusal("a.ply", replaced(ascii_ply, "face 2", "face 1000000000"), "1000000000 of element face are announced");
  expect_refusal("a.ply", replaced(ascii_ply, "face 2", "face -1"), "there cannot be -1 of an element");
  for (const char* corner : {"4", "-1", "1e300", "nan", "0.5"})
    expect_refusal("a.ply", replaced(ascii_ply, "3 0 1 3", fmt::format("3 0 {} 3", corner)),
                   "but there are points 0 to 3");
  expect_refusal("a.ply", replaced(ascii_ply, "7 3 0 1 3", "7 -3 0 1 3"), "a.ply:19: a list cannot have -3 items");
  expect_refusal("a.ply", replaced(ascii_ply, "7 3 0 1 3", "7 99999 0 1 3"), "99999 items in a list");
  expect_refusal("a.ply", replaced(ascii_ply, "7 3 0 1 3", "7 2 0 1"), "1 of 2 cells are no triangles");
  expect_refusal("a.ply", replaced(ascii_ply, "float z", "float w"), "element vertex has no property z");
  expect_refusal("a.ply", replaced(ascii_ply, "vertex_indices", "indices"), "has no list vertex_indices");
  expect_refusal("a.ply", replaced(ascii_ply, "float x", "flout x"), "a.ply:5: 'flout' is no type");
  expect_refusal("a.ply", replaced(ascii_ply, "format ascii", "format utf8"), "a.ply:2: 'utf8' is no format");
  expect_refusal("a.ply", replaced(ascii_ply, "format ascii 1.0\n", ""), "no line `format`");
  expect_refusal("a.ply", "element vertex 3\n", "is no PLY file");
  expect_refusal("a.ply", "ply\nformat ascii 1.0\nproperty float x\n", "belongs to no element");
  expect_refusal("a.ply", "ply\nformat ascii 1.0\nelement vertex 99999999\nend_header\n", "has no properties");
  expect_refusal("a.ply", replaced(ascii_ply, "2 0 9 0", "2 x 9 0"), "a.ply:16: 'x' is no number");
}

TEST(SurfaceFile, RefusesObjFilesThatAreNotWhatTheySay) {
  const std::string points = "v 0 0 0\nv 2 0 0\nv 0 2 0\n";
  for (const char* corner : {"0", "4", "-4", "9000000000000000000", "-9000000000000000000"})
    expect_refusal("a.obj", points + "f 1 2 " + corner + "\n", fmt::format("a.obj:4: a face names point {}", corner));
  for (const char* corner : {"x", "1.5", "99999999999999999999", "/1", ""})
    EXPECT_NE(refusal("a.obj", points + "f 1 2 " + corner + "\n"), "accepted") << corner;
  expect_refusal("a.obj", "f 1 2 3\n" + points, "but there are 0 points up to here");
  expect_refusal("a.obj", points + "v 1 2\nf 1 2 3\n", "a.obj:4: a number is missing");
  expect_refusal("a.obj", points + "f 1 2\n", "fewer than three corners");
  expect_refusal("a.obj", "v 0 0 0\nv nan 0 0\nv 0 2 0\nf 1 2 3\n", "point 2 are not finite");
}

TEST(SurfaceFile, SaysWhenTheLengthUnitMustBeWrong) {
  // 2 units large: in metres as millimetres, and in millimetres as tens of metres.
  const auto small = refusal("a.stl", ascii_stl, 1e-4);
  EXPECT_TRUE(says(small, "its size is 0.2 mm x 0.2 mm x 0 mm by the declared length unit of 0.0001 m")) << small;
  EXPECT_TRUE(says(small, "correct length_unit, it may be cm (28.28 mm)")) << small;
  EXPECT_TRUE(says(refusal("a.ply", ascii_ply, 1e3), "correct length_unit"));
  EXPECT_TRUE(says(refusal("a.obj", "v 0 0 0\nv 1e300 0 0\nv 0 1e300 0\nf 1 2 3\n"), "correct length_unit"));
}

// Whatever single byte is wrong, the reader must come to an end of its own; sanitizers see the rest.
TEST(SurfaceFile, SurvivesAnyWrongByte) {
  const std::pair<std::string, std::string> files[] = {{"a.stl", ascii_stl},
                                                       {"b.stl", binary_stl()},
                                                       {"a.ply", ascii_ply},
                                                       {"b.ply", binary_ply(true)},
                                                       {"a.obj", "v 0 0 0\nv 2 0 0\nv 0 2 0\nf 1 2 -1\n"}};
  for (const auto& [name, content] : files)
    for (std::size_t i = 0; i < content.size(); i += 3)
      for (const char byte : {'\0', '-', '9', '\xff', '\n'}) {
        auto changed = content;
        changed[i] = byte;
        EXPECT_NE(refusal(name, changed), "");
      }
}

TEST(SurfaceFile, SaysHowToGetRidOfStrayLines) {
  const Folder folder;
  write_spots({{{{1, 2, 3}}, "x"}}, folder.path / "points.vtp");
  const auto why = message_of<InputError>([&] { read_surface(folder.path / "points.vtp", 1e-3); });
  EXPECT_TRUE(says(why, "holds 1 vertices, 0 lines")) << why;
  EXPECT_TRUE(says(why, "remove vertices and lines")) << why;
}

}  // namespace
}  // namespace tunica::geometry
