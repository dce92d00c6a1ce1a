#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "temporary_folder.hpp"
#include "tunica/base/error.hpp"
#include "tunica/peer_cases/svsolver_files.hpp"
#include "tunica/peer_cases/translate.hpp"

namespace tunica::peer_cases {

namespace {

using test::message_of;
using test::TemporaryFolder;

/// A simulation with a Windkessel and a resistance in a SimVascular project.
class SvSolver : public testing::Test {
 protected:
  std::string presolver =
      "mesh_and_adjncy_vtu mesh-complete/mesh-complete.mesh.vtu\n"
      "set_surface_id_vtp mesh-complete/mesh-complete.exterior.vtp 1\n"
      "set_surface_id_vtp mesh-complete/mesh-surfaces/inflow.vtp 2\n"
      "set_surface_id_vtp mesh-complete/mesh-surfaces/left.vtp 3\n"
      "set_surface_id_vtp mesh-complete/mesh-surfaces/right.vtp 4\n"
      "fluid_density 1.06\nfluid_viscosity 0.04\ninitial_pressure 80\ninitial_velocity 0.0001 0.0001 0.0001\n"
      "prescribed_velocities_vtp mesh-complete/mesh-surfaces/inflow.vtp\n"
      "bct_analytical_shape parabolic\nbct_period 1.1\nbct_point_number 201\nbct_fourier_mode_number 10\n"
      "bct_create mesh-complete/mesh-surfaces/inflow.vtp inflow.flow\nbct_write_dat bct.dat\nbct_write_vtp bct.vtp\n"
      "pressure_vtp mesh-complete/mesh-surfaces/left.vtp 0\npressure_vtp mesh-complete/mesh-surfaces/right.vtp 0\n"
      "noslip_vtp mesh-complete/walls_combined.vtp\nwrite_geombc geombc.dat.1\nwrite_restart restart.0.1\n";
  std::string solver =
      "Density: 1.06\nViscosity: 0.04\n\n# steps\nNumber of Timesteps: 200\nTime Step Size: 0.001\n"
      "Number of Timesteps between Restarts: 10\nTime Varying Boundary Conditions From File: True\n"
      "Step Construction: 0 1 0 1\nNumber of RCR Surfaces: 1\nList of RCR Surfaces: 4\nRCR Values From File: True\n"
      "Number of Resistance Surfaces: 1\nList of Resistance Surfaces: 3\nResistance Values: 1500\n"
      "Backflow Stabilization Coefficient: 0.2\nResidual Criteria: 0.01\nsvLS Type: NS\n";
  std::string windkessels = "2\n2\n121\n1.5e-5\n1212\n0.0 7\n1.0 7\n";
  TemporaryFolder project;

  std::filesystem::path folder() const { return project.path() / "Simulations" / "rest"; }
  void write() const {
    std::filesystem::create_directories(folder());
    const auto put = [&](const std::filesystem::path& file, const std::string& text) { std::ofstream(file) << text; };
    put(project.path() / "aorta.svproj", "<projectDescription version=\"1.0\"/>");
    put(folder() / "rest.svpre", presolver);
    put(folder() / "solver.inp", solver);
    put(folder() / "rcrt.dat", windkessels);
  }
  std::string text() const {
    write();
    return translate(read_peer_file(project.path()), unit_system("cgs"), folder()).yaml;
  }
  std::string refusal() const {
    return message_of<InputError>([&] { text(); });
  }
};

testing::AssertionResult states(const std::string& text, const std::string& part) {
  std::string plain;  // without comments
  for (std::size_t at = 0; at < text.size();) {
    const auto end = std::min(text.find('\n', at), text.size());
    auto line = text.substr(at, end - at);
    at = end + 1;
    if (const auto comment = line.find(" #"); comment != std::string::npos)
      line.resize(line.find_last_not_of(' ', comment) + 1);
    plain += line + "\n";
  }
  if (plain.find(part) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "`" << part << "` is not in\n" << plain;
}

TEST_F(SvSolver, ReadsASimulationOfAProject) {
  const auto yaml = text();
  EXPECT_TRUE(states(yaml, "volume: mesh-complete/mesh-complete.mesh.vtu\n"));
  EXPECT_TRUE(states(yaml, "walls_combined: mesh-complete/walls_combined.vtp\n"));
  EXPECT_TRUE(states(yaml, "density: 1.06 g/cm^3\n"));
  EXPECT_TRUE(
      states(yaml, "inflow:\n    flow:\n      table:\n        file: inflow.flow\n        format: simvascular\n"));
  EXPECT_TRUE(states(yaml, "interpolation: fourier\n        period: 1.1 s\n        modes: 10\n"));
  EXPECT_TRUE(states(yaml, "profile: parabolic\n"));
  EXPECT_TRUE(states(yaml, "left:\n    resistance:\n      resistance: 1500 dyn s/cm^5\n"));
  EXPECT_TRUE(states(yaml,
                     "right:\n    rcr:\n      proximal: 121 dyn s/cm^5\n      capacitance: 1.5e-5 cm^5/dyn\n"
                     "      distal: 1212 dyn s/cm^5\n      distal_pressure: 7 dyn/cm^2\n"
                     "      initial_pressure: 80 dyn/cm^2\n"));
  EXPECT_TRUE(states(yaml, "walls_combined:\n    no_slip: {}\n"));
  EXPECT_TRUE(states(yaml, "step: 0.001 s\n  steps: 200\n"));
  EXPECT_TRUE(states(yaml, "every: 10\n"));
}

TEST_F(SvSolver, NamesWhatIsMissing) {
  solver += "Deformable Wall: True\n";
  EXPECT_TRUE(states(refusal(), "coupled momentum"));
}

TEST_F(SvSolver, RefusesSlips) {
  solver += "Tau Martix: Diagonal\n";
  EXPECT_TRUE(states(refusal(), "did you mean Tau Matrix"));
  solver = solver.substr(0, solver.find("Tau Martix")) + "Density: 1.05\n";
  EXPECT_TRUE(states(refusal(), "stands in line 1"));
  solver = "Number of RCR Surfaces 1\n";
  EXPECT_TRUE(states(refusal(), "has no colon"));
}

TEST_F(SvSolver, RefusesWindkesselsThatDoNotFit) {
  windkessels += "2\n1\n1\n1\n0 0\n1 0\n";
  EXPECT_TRUE(states(refusal(), "holds 2 Windkessels, solver.inp lists 1 surfaces"));
  windkessels = "2\n2\n121\n1.5e-5\n1212\n0.0 7\n1.0 8\n";
  EXPECT_TRUE(states(refusal(), "a distal pressure that changes in time"));
  windkessels = "2\n2\n121\n";
  EXPECT_TRUE(states(refusal(), "ends within a Windkessel"));
  windkessels = "2\n2\n121\n1.5e-5\n1212\n0.0 7\n1.0 7\n";
  presolver.replace(presolver.find("right.vtp 0"), 11, "right.vtp 9");
  EXPECT_TRUE(states(refusal(), "gives a pressure to a face"));
}

TEST_F(SvSolver, ProjectsWithoutASimulationSaySo) {
  write();
  std::filesystem::remove_all(folder());
  EXPECT_TRUE(states(message_of<InputError>([&] { read_peer_file(project.path()); }), "without a simulation"));
}

}  // namespace
}  // namespace tunica::peer_cases
