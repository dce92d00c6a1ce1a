#include "tunica/geometry/surface_file.hpp"

#include <fstream>

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
  refuses(write_text(folder, "damaged.ply", "ply\nformat ascii 1.0\nelement"), 1, "");
  refuses(write_text(folder, "one.obj", "v 0 0 0\nv 2 0 0\nv 0 2 0\nf 1 2 3\n"), 0, "must be positive");
}

TEST(SurfaceFile, SaysWhereItCannotWrite) {
  const auto text = message_of<SolverError>([] { write_spots({{{{1, 2, 3}}, "x"}}, "/nowhere/spots.vtp"); });
  EXPECT_TRUE(says(text, "cannot write /nowhere/spots.vtp: No such file or directory")) << text;
}

}  // namespace
}  // namespace tunica::geometry
