// Files that are damaged or lie about themselves end a command with exit code 2 and a message of the program's own.
#include "program.hpp"

namespace tunica::test {
namespace {

class Readers : public Program {
 protected:
  /// Runs the command, which must refuse its input with this text, and nothing of a library or of MPI.
  void expect_refused(const std::string& arguments, const std::string& why) const {
    EXPECT_EQ(tunica(arguments), 2) << printed();
    EXPECT_NE(printed().find("remedy:"), std::string::npos) << printed();
    EXPECT_NE(printed().find(why), std::string::npos) << printed();
    for (const char* foreign : {"MPI_ABORT", "bad_alloc", "filesystem error", "vtk", "ERR|", "ply_get", "terminate"})
      EXPECT_EQ(printed().find(foreign), std::string::npos) << printed();
    EXPECT_LT(printed().size(), 5000u);
  }
  /// A case of blood and wall in a tube, with other results.
  void write_tube_case(const std::string& output) const {
    write("case.yaml",
          "analysis: fsi\nelements: linear\nmeshes:\n  tube: {radius: 5 mm, length: 2 cm, wall_thickness: 1 mm, "
          "cells_around: 8, "
          "cells_radial: 1, cells_along: 4, cells_through_wall: 1}\n"
          "  interface: {lumen: lumen_wall, wall: wall_inner}\nfluid: {}\n"
          "wall: {density: 1120 kg/m^3, material: {neo_hooke: {young_modulus: 1 MPa, poisson_ratio: 0.49}}}\n"
          "boundary:\n  lumen_inlet: {pressure: 1 kPa}\n  lumen_outlet: {resistance: 1e9 Pa s/m^3}\n"
          "  \"wall_*\": fixed\n  wall_outer: free\ntime: {step: 1 ms, steps: 2}\noutput: {directory: " +
              output + "}\n");
  }
};

TEST_F(Readers, ValuesThatContainThemselves) {
  write_tube_case("out");
  expect_refused("vary case.yaml -o v.yaml --set 'title=&a [*a]'", "would contain itself");
  write("loop.yaml", "analysis: &x {fsi: *x}\n");
  for (const char* command : {"check", "run", "mesh", "fibres"})
    expect_refused(fmt::format("{} loop.yaml", command), "would contain itself");
  expect_refused(fmt::format("vary case.yaml -o {}.yaml", std::string(300, 'v')), "give a name that a file can have");
}

TEST_F(Readers, NamesThatNoFileCanHave) {
  write_tube_case(std::string(300, 'd'));
  for (const char* command : {"check", "run", "prestress", "post"})
    expect_refused(fmt::format("{} case.yaml", command),
                   "output.directory (case.yaml:14): a file or folder name of 300");
  expect_refused(fmt::format("check {}.yaml", std::string(300, 'c')), "File name too long");
}

TEST_F(Readers, SurfacesThatEndTooEarlyOrAreInAnotherUnit) {
  write("l.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 2\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n20 0 0\n0 20 0\n3 0 1 2\n");
  write("mesh.yaml", "geometry: {surfaces: {lumen: l.ply, length_unit: mm}}\nsize: coarse\noutput: mesh\n");
  expect_refused("mesh mesh.yaml", "l.ply:14: the file ends before its last number");
  write("l.stl",
        "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 0.02 0 0\nvertex 0 0.02 0\nendloop\nendfacet\n"
        "endsolid a\n");
  write("mesh.yaml", "geometry: {surfaces: {lumen: l.stl, length_unit: mm}}\nsize: coarse\noutput: mesh\n");
  expect_refused("mesh mesh.yaml", "correct length_unit, it may be m (28.28 mm)");
}

TEST_F(Readers, VolumesThatClaimMoreThanTheyHold) {
  fs::create_directories(folder_ / "sv/mesh-surfaces");
  write("sv/mesh-surfaces/wall.vtp", "");
  for (const char* points : {"1000000000000", "-4", "1e18"}) {
    write("sv/mesh-complete.mesh.vtu",
          fmt::format("<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" "
                      "NumberOfCells=\"1\"></Piece></UnstructuredGrid></VTKFile>\n",
                      points));
    write("case.yaml",
          "analysis: flow\nelements: linear\nmeshes: {length_unit: mm, lumen: {simvascular: sv}}\nfluid: {}\nboundary: "
          "{wall: no_slip}\n"
          "time: {step: 1 ms, steps: 2}\n");
    expect_refused("check case.yaml", "sv/mesh-complete.mesh.vtu:2: cannot be read");
  }
}

}  // namespace
}  // namespace tunica::test
