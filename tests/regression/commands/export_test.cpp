// A case that goes to svMultiPhysics' format and comes back.
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "program.hpp"

namespace tunica {

namespace {

/// Blood and a wall of fibres, with a load in time, a Windkessel and tissue around the wall.
constexpr const char* coupled =
    "analysis: fsi\nelements: linear\n"
    "meshes:\n"
    "  tube: {radius: 5 mm, length: 2 cm, wall_thickness: 1 mm, cells_around: 8, cells_radial: 1, cells_along: 4, "
    "cells_through_wall: 1}\n"
    "  interface: {lumen: lumen_wall, wall: wall_inner}\n"
    "fluid: {density: 1060 kg/m^3, viscosity: {newtonian: {viscosity: 4 mPa s}}, stabilisation: vms_classic}\n"
    "wall:\n"
    "  element: displacement\n"
    "  density: 1100 kg/m^3\n"
    "  fibre_frame: {cylindrical: {axis: [0, 0, 1]}}\n"
    "  material: {goh: {shear_modulus: 100 kPa, poisson_ratio: 0.4, exclusion: none, families: ["
    "{k1: 20 kPa, k2: 5, mean_angle: 40 deg, kappa: 0.1}, {k1: 20 kPa, k2: 5, mean_angle: -40 deg, kappa: 0.1}]}}\n"
    "boundary:\n"
    "  lumen_inlet: {flow: {value: 10 ml/s, ramp_time: 5 ms}}\n"
    "  lumen_outlet: {rcr: {proximal: 1e7 Pa s/m^3, capacitance: 1e-9 m^3/Pa, distal: 1e8 Pa s/m^3, "
    "initial_pressure: 1 kPa}}\n"
    "  \"wall_*\": fixed\n"
    "  wall_outer: {support: {stiffness: 1e7 N/m^3, damping: 10 N s/m^3}}\n"
    "time: {step: 1 ms, steps: 3, rho_infinity: 0.5}\n"
    "newton: {relative_tolerance: 1e-8}\n"
    "output: {instant: end, units: {length: cm, velocity: cm/s, pressure: dyn/cm^2, stress: dyn/cm^2, flow: cm^3/s}}\n";

class Export : public test::Program {
 protected:
  /// The last line of a table by the names of its columns.
  std::map<std::string, double> last_line(const std::string& file) const {
    std::istringstream lines(read(file));
    std::string head, line, last;
    std::getline(lines, head);
    while (std::getline(lines, line)) last = line;
    std::map<std::string, double> numbers;
    std::istringstream names(head), cells(last);
    for (std::string name, cell; std::getline(names, name, ',') && std::getline(cells, cell, ',');)
      numbers[name] = std::stod(cell);
    return numbers;
  }
};

TEST_F(Export, ComesBackAsTheSameProblem) {
  write("case.yaml", coupled);
  ASSERT_EQ(tunica("export case.yaml -o out --units cgs"), 0) << printed();
  EXPECT_NE(printed().find("lumen_inlet: 513 points and 192 Fourier modes follow the course"), std::string::npos)
      << printed();
  const std::string xml = read("out/solver.xml");
  for (const char* part :
       {"<Density> 1.06 </Density>", "<Proximal_resistance> 100 </Proximal_resistance>",
        "<Project_from_face> lumen_wall </Project_from_face>", "<Stiffness> 1000000 </Stiffness>", "<a4> 200000 </a4>",
        "mesh/fibres_2.vtu", "<Start_saving_after_time_step> 1 </Start_saving_after_time_step>"})
    EXPECT_NE(xml.find(part), std::string::npos) << part << "\n" << xml;
  EXPECT_EQ(printed().find("fluid.stabilisation"), std::string::npos) << printed();
  EXPECT_NE(printed().find("time.loads: svMultiPhysics puts the loads of the end"), std::string::npos) << printed();
  EXPECT_EQ(tunica("export case.yaml -o out --units cgs"), 2);
  EXPECT_NE(printed().find("--overwrite"), std::string::npos);
  std::string bounded = coupled;
  bounded.erase(bounded.find(", stabilisation: vms_classic"), 28);
  write("case.yaml", bounded);
  ASSERT_EQ(tunica("export case.yaml -o out --units cgs --overwrite"), 0) << printed();
  EXPECT_NE(printed().find("fluid.stabilisation: svMultiPhysics has the rate"), std::string::npos) << printed();

  // The families of fibres stand in files, with the same angle everywhere.
  ASSERT_EQ(tunica("import out -o back.yaml --units cgs"), 0) << printed();
  ASSERT_EQ(tunica("run back.yaml --output back"), 0) << printed();
  std::string same = coupled;
  same.replace(same.find("rho_infinity: 0.5"), 17, "rho_infinity: 0.5, loads: end");
  write("case.yaml", same);
  ASSERT_EQ(tunica("run case.yaml --output first"), 0) << printed();
  const auto first = last_line("first/faces.csv"), back = last_line("back/faces.csv");
  ASSERT_EQ(first.size(), back.size());
  for (const auto& [name, value] : first) {
    ASSERT_TRUE(back.contains(name)) << name;
    EXPECT_NEAR(back.at(name), value, 1e-3 * std::abs(value) + 1e-3) << name;
  }
}

TEST_F(Export, TakesViscosityAndFacesThatMoveAsAWholeThereAndBack) {
  write("coupled.yaml", coupled);
  ASSERT_EQ(tunica("export coupled.yaml -o first --units cgs"), 0) << printed();
  write("case.yaml",
        "analysis: wall\nelements: linear\nmeshes: {length_unit: cm, wall: {simvascular: first/mesh/wall}}\n"
        "wall: {density: 1100 kg/m^3, viscosity: 5 Pa s, material: {neo_hooke: {young_modulus: 1 MPa, poisson_ratio: "
        "0.45}}}\n"
        "boundary: {wall_inner: free, wall_outer: free, wall_inlet: fixed, wall_outlet: {pressure: {value: -10 kPa, "
        "undeforming: true}}}\n"
        "time: {step: 1 ms, steps: 2}\n");
  ASSERT_EQ(tunica("export case.yaml -o out --units cgs"), 0) << printed();
  const std::string xml = read("out/solver.xml");
  EXPECT_NE(xml.find("<Undeforming_neu_face> true </Undeforming_neu_face>"), std::string::npos) << xml;
  EXPECT_NE(xml.find("<Viscosity model=\"Newtonian\">"), std::string::npos) << xml;
  ASSERT_EQ(tunica("import out -o back.yaml --units cgs"), 0) << printed();
  const std::string back = read("back.yaml");
  EXPECT_NE(back.find("undeforming: true"), std::string::npos) << back;
  EXPECT_NE(back.find("value: 50 dyn s/cm^2"), std::string::npos) << back;
}

// What the other program reads as a Fourier series goes there as its coefficients, a ramp by its ends: digit by digit.
TEST_F(Export, CoursesComeBackAsTheyWere) {
  write("in.flow", "5 3\n0 -1\n0.2 -8\n0.4 -3.3\n0.7 -1.1\n0.9 -1.7\n");
  write("out.flow", "2 1\n0.001 100\n0.003 250\n");
  write("case.yaml",
        "analysis: flow\nelements: linear\n"
        "meshes: {tube: {radius: 5 mm, length: 2 cm, cells_around: 8, cells_radial: 1, cells_along: 4}}\n"
        "fluid: {density: 1060 kg/m^3, viscosity: {newtonian: {viscosity: 4 mPa s}}, stabilisation: vms_classic}\n"
        "boundary:\n"
        "  lumen_inlet: {flow: {table: {file: in.flow, time_unit: s, unit: cm^3/s}}}\n"
        "  lumen_outlet: {pressure: {table: {file: out.flow, time_unit: s, unit: dyn/cm^2, interpolation: ramp}}}\n"
        "  lumen_wall: no_slip\n"
        "time: {step: 1 ms, steps: 4, rho_infinity: 0.5, loads: end}\n"
        "newton: {relative_tolerance: 1e-9}\n"
        "output: {instant: end, units: {flow: cm^3/s, pressure: dyn/cm^2}}\n");
  ASSERT_EQ(tunica("export case.yaml -o out --units cgs"), 0) << printed();
  EXPECT_EQ(printed().find("follow the course"), std::string::npos) << printed();
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out/lumen_inlet.fcs"));
  ASSERT_EQ(tunica("import out -o back.yaml --units cgs"), 0) << printed();
  ASSERT_EQ(tunica("run back.yaml --output back"), 0) << printed();
  ASSERT_EQ(tunica("run case.yaml --output first"), 0) << printed();
  const auto first = last_line("first/faces.csv"), back = last_line("back/faces.csv");
  for (const char* name : {"lumen_inlet flow [cm^3/s]", "lumen_inlet pressure [dyn/cm^2]"})
    EXPECT_NEAR(back.at(name), first.at(name), 1e-7 * std::abs(first.at(name))) << name;
}

// As a Fourier series over the run it would swing at both its ends.
TEST_F(Export, WhatStepsUpAtTheStartIsAValue) {
  write("case.yaml",
        "analysis: flow\nelements: linear\n"
        "meshes: {tube: {radius: 5 mm, length: 2 cm, cells_around: 8, cells_radial: 1, cells_along: 4}}\n"
        "fluid: {density: 1060 kg/m^3, viscosity: {newtonian: {viscosity: 4 mPa s}}, stabilisation: vms_classic}\n"
        "boundary:\n"
        "  lumen_inlet: {flow: {step: {value: 6 ml/s, end: 10 s}}}\n"
        "  lumen_outlet: {pressure: 0 Pa}\n"
        "  lumen_wall: no_slip\n"
        "time: {step: 1 ms, steps: 4, rho_infinity: 0.5}\n");
  ASSERT_EQ(tunica("export case.yaml -o out --units cgs"), 0) << printed();
  EXPECT_EQ(printed().find("follow the course"), std::string::npos) << printed();
  EXPECT_NE(read("out/solver.xml").find("<Value> -6 </Value>"), std::string::npos) << read("out/solver.xml");
}

TEST_F(Export, WritesResultsAsThePeerDoes) {
  write("case.yaml", coupled);
  EXPECT_EQ(tunica("export case.yaml -o peer --units cgs --results"), 2);  // there are none
  ASSERT_EQ(tunica("run case.yaml"), 0) << printed();
  ASSERT_EQ(tunica("export case.yaml -o peer --units cgs --results"), 0) << printed();
  EXPECT_TRUE(std::filesystem::exists(folder_ / "peer/result_003.vtu"));
  const auto last = last_line("results/faces.csv");
  // The last line of a text file: step, time, then the faces in the order of its line of names.
  const auto of_face = [&](const std::string& file, const std::string& face) {
    std::istringstream lines(read(file));
    std::string line, final;
    std::vector<std::string> names;
    while (std::getline(lines, line)) {
      if (line.starts_with("step")) {
        std::istringstream words(line);
        for (std::string word; words >> word;) names.push_back(word);
      }
      final = line;
    }
    std::istringstream words(final);
    double number = std::nan("");
    for (std::size_t k = 0; k < names.size() && words >> number; ++k)
      if (names[k] == face) return number;
    return std::nan("");
  };
  EXPECT_EQ(of_face("peer/B_FS_Velocity_flux.txt", "step"), 3);
  EXPECT_NEAR(of_face("peer/B_FS_Velocity_flux.txt", "lumen_outlet"), last.at("lumen_outlet flow [cm^3/s]"), 1e-8);
  EXPECT_NEAR(of_face("peer/B_FS_Pressure_average.txt", "lumen_outlet"), last.at("lumen_outlet pressure [dyn/cm^2]"),
              1e-6 * std::abs(last.at("lumen_outlet pressure [dyn/cm^2]")));
  const double mean = of_face("peer/V_FS_Pressure_flux.txt", "lumen");
  EXPECT_GT(mean, 0.5 * last.at("lumen_outlet pressure [dyn/cm^2]"));
  EXPECT_LT(mean, last.at("lumen_inlet pressure [dyn/cm^2]"));
  const double volume = of_face("peer/V_FS_Jacobian_flux.txt", "wall");
  EXPECT_GT(volume, 0.9);
  EXPECT_LT(volume, 1.1);
  EXPECT_NE(volume, 1.0);
}

TEST_F(Export, ResultsOfAnotherCaseAreNotThoseOfThisOne) {
  write("case.yaml", coupled);
  ASSERT_EQ(tunica("run case.yaml --until 1"), 0) << printed();
  std::string changed = coupled;
  changed.replace(changed.find("step: 1 ms"), 10, "step: 2 ms");
  write("case.yaml", changed);
  EXPECT_EQ(tunica("export case.yaml -o peer --units cgs --results"), 2);
  EXPECT_NE(printed().find("holds results of another case"), std::string::npos) << printed();
}

TEST_F(Export, WritesResultsOfQuadraticElementsAtAllTheirNodes) {
  std::string quadratic = coupled;
  quadratic.replace(quadratic.find("elements: linear"), 16, "elements: quadratic");
  quadratic.replace(quadratic.find("steps: 3"), 8, "steps: 1");
  write("case.yaml", quadratic);
  ASSERT_EQ(tunica("run case.yaml"), 0) << printed();
  ASSERT_EQ(tunica("export case.yaml -o peer --units cgs --results"), 0) << printed();
  const std::string head = read("peer/result_001.vtu");
  const auto points = head.find("NumberOfPoints=\"");
  ASSERT_NE(points, std::string::npos);
  const auto nodes = nlohmann::json::parse(read("results/manifest.json"))["mesh"]["nodes"].get<std::int64_t>();
  EXPECT_EQ(std::stol(head.substr(points + 16)), nodes);
}

TEST_F(Export, RefusesWhatThePeerCannotPose) {
  std::string text = coupled;
  const auto exclusion = text.find("exclusion: none");
  text.replace(exclusion, 15, "exclusion: tension_only");
  const auto inlet = text.find("{flow: {value: 10 ml/s, ramp_time: 5 ms}}");
  text.replace(inlet, 41, "{velocity: {value: [0 m/s, 0 m/s, 1 m/s]}}");
  write("case.yaml", text);
  EXPECT_EQ(tunica("export case.yaml -o out --units cgs"), 2);
  EXPECT_NE(printed().find("wall.material.exclusion: is what svMultiPhysics does not have"), std::string::npos)
      << printed();
  EXPECT_NE(printed().find("boundary.lumen_inlet: is what svMultiPhysics does not have"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

}  // namespace

}  // namespace tunica
