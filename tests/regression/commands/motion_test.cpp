// A tube that widens, imaged and found again.
#include <cmath>
#include <sstream>
#include <vector>

#include "program.hpp"

namespace tunica {

namespace {

constexpr const char* tube =
    "analysis: fsi\nelements: linear\n"
    "meshes:\n"
    "  tube: {radius: 8 mm, length: 30 mm, wall_thickness: 1.5 mm, cells_around: 24, cells_radial: 2, cells_along: 12, "
    "cells_through_wall: 1}\n"
    "  interface: {lumen: lumen_wall, wall: wall_inner}\n"
    "fluid: {}\n"
    "wall: {density: 1100 kg/m^3, material: {neo_hooke: {young_modulus: 300 kPa, poisson_ratio: 0.45}}}\n"
    "boundary:\n"
    "  lumen_inlet: {pressure: {value: 4 kPa, ramp_time: 30 ms}}\n"
    "  lumen_outlet: {pressure: {value: 4 kPa, ramp_time: 30 ms}}\n"
    "  wall_inlet: {fixed: [z]}\n"
    "  wall_outlet: {fixed: [z]}\n"
    "  wall_outer: {support: {stiffness: 1e5 N/m^3}}\n"
    "time: {step: 5 ms, steps: 8}\n"
    "output: {directory: run, every: 1}\n";

constexpr const char* plane = "planes: {middle: {centre: [0 mm, 0 mm, 15 mm], normal: [0, 0, 1]}}\n";

class MotionCommand : public test::Program {
 protected:
  /// A column of a table by its name.
  std::vector<double> column(const std::string& file, const std::string& name) const {
    std::istringstream lines(read(file));
    std::string line, cell;
    std::getline(lines, line);
    std::istringstream head(line);
    std::size_t at = 0;
    while (std::getline(head, cell, ',') && cell != name) ++at;
    std::vector<double> values;
    while (std::getline(lines, line)) {
      std::istringstream cells(line);
      for (std::size_t k = 0; k <= at; ++k) std::getline(cells, cell, ',');
      values.push_back(std::stod(cell));
    }
    return values;
  }
};

TEST_F(MotionCommand, FindsTheAreasOfPhasesThatWereImaged) {
  write("case.yaml", tube);
  ASSERT_EQ(tunica("run case.yaml"), 0) << printed();
  write("scan.yaml", std::string("case: case.yaml\nperiod: 40 ms\nphases: 4\nscan: {voxel: 0.8 mm}\n") + plane);
  ASSERT_EQ(tunica("synthesise --motion scan.yaml"), 0) << printed();
  EXPECT_NE(printed().find("phases: {labels: phases/labels_*.nrrd, true_lumen: 1, period: 0.04 s}"), std::string::npos)
      << printed();
  const std::string motion = std::string("case: case.yaml\nphases: {labels: phases/labels_*.nrrd, period: 40 ms}\n") +
                             plane + "points: {wall: [8 mm, 0 mm, 15 mm]}\nrings: [wall_inlet]\n";
  write("motion.yaml", motion);
  ASSERT_EQ(tunica("motion motion.yaml"), 0) << printed();
  const auto truth = column("phases/truth.csv", "middle [mm^2]"), found = column("motion/curves.csv", "middle [mm^2]");
  ASSERT_EQ(truth.size(), 4U);
  ASSERT_EQ(found.size(), 4U);
  EXPECT_GT(truth[3] - truth[0], 10);
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_NEAR(found[k] - found[0], truth[k] - truth[0], 0.01 * truth[0]) << "phase " << k;
  // The nodes of the ring are a table that a case reads.
  auto moved = std::string(tube);
  moved.replace(moved.find("wall_inlet: {fixed: [z]}"), 24,
                "wall_inlet: {displacement: {over_face: {table: motion/ring_wall_inlet.csv, period: 40 ms, unit: m, "
                "length_unit: m, interpolation: nearest}}}");
  write("moved.yaml", moved);
  EXPECT_EQ(tunica("check moved.yaml"), 0) << printed();
  for (const char* file : {"stations.csv", "motion.pvd", "motion_003.vtp", "motion.json", "curves.svg"})
    EXPECT_TRUE(std::filesystem::exists(folder_ / "motion" / file)) << file;
  // What is there is not replaced unasked, and what cannot be is said before an image is read.
  EXPECT_EQ(tunica("motion motion.yaml"), 2);
  EXPECT_NE(printed().find("--overwrite"), std::string::npos) << printed();
  const std::pair<const char*, const char*> faults[] = {
      {"mesh_at: 7 ms\n", "is the time of no phase"},
      {"ends: [lumen_side]\n", "the lumen has no opening 'lumen_side'"},
      {"smoothing: 4\n", "unit"},
  };
  for (const auto& [more, message] : faults) {
    write("wrong.yaml", motion + more);
    EXPECT_EQ(tunica("motion wrong.yaml --overwrite"), 2) << more;
    EXPECT_NE(printed().find(message), std::string::npos) << printed();
  }
  // An earlier motion leaves nothing beside the next one.
  write("fewer.yaml", "case: case.yaml\nphases: {labels: fewer/labels_*.nrrd, period: 40 ms}\noutput: motion\n");
  write("scan.yaml", "case: case.yaml\nperiod: 40 ms\nphases: 2\nscan: {voxel: 0.8 mm}\noutput: fewer\n");
  ASSERT_EQ(tunica("synthesise --motion scan.yaml"), 0) << printed();
  ASSERT_EQ(tunica("motion fewer.yaml --overwrite"), 0) << printed();
  for (const char* file : {"motion_002.vtp", "ring_wall_inlet.csv"})
    EXPECT_FALSE(std::filesystem::exists(folder_ / "motion" / file)) << file;
  // Surfaces are phases, too; what is read is not replaced, and what somebody else has written neither.
  write("surfaces.yaml", "case: case.yaml\nphases: {surfaces: motion/motion_*.vtp, length_unit: m, period: 40 ms}\n");
  EXPECT_EQ(tunica("motion surfaces.yaml -o again"), 0) << printed();
  EXPECT_EQ(tunica("motion surfaces.yaml -o motion --overwrite"), 2);
  EXPECT_NE(printed().find("is the folder of the phases"), std::string::npos) << printed();
  std::filesystem::create_directory(folder_ / "foreign");
  write("foreign/curves.csv", "mine");
  EXPECT_EQ(tunica("motion surfaces.yaml -o foreign"), 2);
  EXPECT_EQ(read("foreign/curves.csv"), "mine");

  auto other = motion;
  other.replace(other.find("wall: [8 mm"), 4, "'a,b'");
  write("wrong.yaml", other);
  EXPECT_EQ(tunica("motion wrong.yaml --overwrite"), 2);
  EXPECT_NE(printed().find("points.a,b"), std::string::npos) << printed();
  other = motion;
  other.replace(other.find("centre: [0 mm"), 13, "centre: [90 mm");
  write("wrong.yaml", other);
  EXPECT_EQ(tunica("motion wrong.yaml --overwrite"), 2);
  EXPECT_NE(printed().find("planes.middle"), std::string::npos) << printed();
  other = motion;
  other.replace(other.find("labels_*.nrrd,"), 14, "labels_*.nrrd, true_lumen: 5,");
  write("wrong.yaml", other);
  EXPECT_EQ(tunica("motion wrong.yaml --overwrite"), 2);
  EXPECT_NE(printed().find("no voxel of label 5"), std::string::npos) << printed();
}

}  // namespace
}  // namespace tunica
