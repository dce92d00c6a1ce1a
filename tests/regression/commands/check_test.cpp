// `tunica check` finds what `tunica run` refuses: the same exit code and the same words, before any stage is done.
#include "program.hpp"

namespace tunica::test {
namespace {

struct Flaw {
  const char *from, *to;  ///< what is put in the place of what, in the case below
  const char* message;    ///< of both commands
};

class Check : public Program {
 protected:
  void expect_refused(const std::string& name, const std::string& message) const {
    for (const char* command : {"check ", "run "}) {
      EXPECT_EQ(tunica(command + name), 2) << command << message << "\n" << printed();
      EXPECT_NE(printed().find(message), std::string::npos) << command << message << "\nnot in\n" << printed();
    }
  }
  void expect_refused(const std::string& text, const Flaw& flaw) const {
    std::string flawed = text;
    const auto at = flawed.find(flaw.from);
    ASSERT_NE(at, std::string::npos) << flaw.from;
    write("flawed.yaml", flawed.replace(at, std::string(flaw.from).size(), flaw.to));
    expect_refused("flawed.yaml", flaw.message);
    EXPECT_FALSE(fs::exists(folder_ / "results")) << flaw.message;
  }
};

const std::string tube =
    "analysis: fsi\nelements: linear\n"
    "meshes:\n"
    "  tube: {radius: 5 mm, length: 20 mm, wall_thickness: 1 mm, cells_around: 8, cells_radial: 1, cells_along: 4}\n"
    "  interface: {lumen: lumen_wall, wall: wall_inner}\n"
    "fluid: {}\n"
    "wall:\n"
    "  density: 1100 kg/m^3\n"
    "  material: {hgo: {shear_modulus: 40 kPa, poisson_ratio: 0.49, families: [{k1: 60 kPa, k2: 5, mean_angle: 35 "
    "deg}]}}\n"
    "  fibre_frame: {cylindrical: {}}\n"
    "boundary:\n"
    "  lumen_inlet: {flow: 20 ml/s}\n"
    "  lumen_outlet: {resistance: 5e8 Pa s/m^3}\n"
    "  \"wall_*\": fixed\n"
    "  wall_outer: {support: {stiffness: 1e7 N/m^3}}\n"
    "time: {step: 1 ms, steps: 2}\n"
    "output: {directory: results}\n";

TEST_F(Check, FindsWhatARunRefuses) {
  write("a_file", "no folder");
  for (const Flaw& flaw : {
           Flaw{"  lumen_outlet: {resistance: 5e8 Pa s/m^3}\n", "", "boundary.lumen_outlet: this lumen face has no"},
           Flaw{"lumen_inlet:", "lumen_inflow:", "boundary.lumen_inflow: the mesh has no such face"},
           Flaw{"time:", "start: nowhere.checkpoint\ntime:", "start (nowhere.checkpoint): cannot be opened"},
           Flaw{"time:", "start: a_file\ntime:", "start (a_file): is no tunica checkpoint"},
           Flaw{"  density", "  prestress: nowhere.vtu\n  density", "nowhere.vtu"},
           Flaw{"  density",
                "  smoothing_length: 1 mm\n"
                "  regions: {flop: {material: {neo_hooke: {young_modulus: 1 MPa, poisson_ratio: 0.4}}}}\n  density",
                "wall.regions.flop: the mesh has no wall region"},
           Flaw{"cylindrical: {}", "mesh: {e1: e1, e2: e2}", "brings no element values called 'e"},
           Flaw{"cylindrical: {}", "constant: {e1: [1, 0, 0], e2: [2, 0, 0]}", "parallel"},
           Flaw{"directory: results", "directory: a_file/results", "cannot be made"},
       })
    expect_refused(tube, flaw);
  write("case.yaml", tube);
  EXPECT_EQ(tunica("check case.yaml"), 0) << printed();
  EXPECT_FALSE(fs::exists(folder_ / "results"));
  EXPECT_EQ(tunica("run case.yaml"), 0) << printed();
  EXPECT_EQ(tunica("check case.yaml"), 0) << printed();
  EXPECT_NE(printed().find("holds results (completed, 2 steps)"), std::string::npos) << printed();
}

TEST_F(Check, FindsAStartOfAnotherMesh) {
  write("other.yaml", std::string(tube).replace(tube.find("cells_along: 4"), 14, "cells_along: 5"));
  ASSERT_EQ(tunica("run other.yaml --output other"), 0) << printed();
  expect_refused(
      tube,
      {"time:", "start: other/checkpoints/step_00000002.checkpoint\ntime:", "belongs to another mesh than the case"});
}

TEST_F(Check, FindsWhatAnyStageRefusesBeforeTheFirstOne) {
  std::string chain = tube;
  chain.replace(chain.find("  fibre_frame: {cylindrical: {}}\n"), 33, "");
  chain +=
      "fibres: {inlet: [wall_inlet, lumen_inlet], outer: wall_outer, mean_angle: 35 deg}\n"
      "prestress: {flow: {pressure: 80 mmHg, inflow: 20 ml/s, step: 1 ms, steps: 20}}\n"
      "post: {}\nreport: {pictures: false}\n";
  write("case.yaml", chain);
  EXPECT_EQ(tunica("check case.yaml"), 0) << printed();
  for (const Flaw& flaw : {
           Flaw{"  lumen_outlet: {resistance: 5e8 Pa s/m^3}\n", "", "boundary.lumen_outlet: this lumen face has no"},
           Flaw{"lumen_inlet:", "lumen_inflow:", "boundary.lumen_inflow: the mesh has no such face"},
           Flaw{"inlet: [wall_inlet", "inlet: [wall_inflow", "fibres.inlet: the mesh has no face 'wall_inflow'"},
           Flaw{", inflow: 20 ml/s", "", "prestress.flow.inflow: is missing"},
           Flaw{"post: {}", "post: {end: lumen_femoral}", "lumen_femoral"},
           Flaw{"post: {}", "post: {period: 0.8 s}", "do not cover the window"},
           Flaw{"post: {}", "post: {lumens: {true_lumen: [x], false_lumen: [y]}}", "post.lumens.true_lumen"},
           Flaw{"steps: 20}}", "steps: 20}, exclude: [flap]}", "prestress.exclude: the mesh has no wall region flap"},
       })
    expect_refused(chain, flaw);
  // Depths of layers are made with the directions.
  std::string layered = chain;
  layered.replace(layered.find("wall:\n"), 6,
                  "wall:\n  layers: {depth: depth, blending: 0.2, outwards: [{beyond: 0.6, material: {neo_hooke: "
                  "{young_modulus: 0.5 MPa, poisson_ratio: 0.45}}}]}\n");
  write("layered.yaml", layered);
  EXPECT_EQ(tunica("check layered.yaml"), 0) << printed();
  const std::string tuned = chain + "outlets: {systolic: 125 mmHg, diastolic: 75 mmHg, fractions: {lumen_outlet: 1}}\n";
  expect_refused(
      tuned, {"  lumen_outlet: {resistance: 5e8 Pa s/m^3}\n", "", "boundary.lumen_inlet: the flow is not periodic"});
}

/// Openings by their table; the surface itself is not looked at before the mesh is made.
TEST_F(Check, KnowsTheOpeningsOfAMeshToCome) {
  write("lumen.stl", "solid\nendsolid\n");
  write("openings.csv", "name,centre_x,centre_y,centre_z\ninlet,0,0,0\niliac,0,0,100\n");
  const std::string rest =
      "fluid: {}\n"
      "wall: {density: 1100 kg/m^3, material: {neo_hooke: {young_modulus: 1 MPa, poisson_ratio: 0.45}}}\n"
      "boundary: {lumen_inlet: {flow: 20 ml/s}, lumen_iliac: {resistance: 1e8 Pa s/m^3}, \"wall_*\": fixed}\n"
      "time: {step: 1 ms, steps: 2}\n";
  const std::string named =
      "analysis: fsi\nelements: linear\nmesh: {geometry: {surfaces: {lumen: lumen.stl, length_unit: mm, openings: "
      "openings.csv}}, size: coarse}\n" +
      rest;
  write("case.yaml", named);
  EXPECT_EQ(tunica("check case.yaml"), 0) << printed();
  expect_refused(named, {"lumen_inlet:", "lumen_inflow:", "boundary.lumen_inflow: the mesh has no such face"});
  expect_refused(named,
                 {"lumen_iliac: {resistance: 1e8 Pa s/m^3}, ", "", "boundary.lumen_iliac: this lumen face has no"});
  expect_refused(named, {"length_unit: mm,", "length_unit: mm, inlet: root,", "root"});
  // Without the table they are counted: an inlet and some outlets.
  std::string counted = named;
  counted.replace(counted.find(", openings: openings.csv"), 24, "");
  counted.replace(counted.find("lumen_iliac"), 11, "lumen_outlet_1");
  write("case.yaml", counted);
  EXPECT_EQ(tunica("check case.yaml"), 0) << printed();
  expect_refused(counted, {"lumen_inlet:", "lumen_inflow:", "boundary.lumen_inflow: the mesh has no such face"});
}

TEST_F(Check, OfAMeshToComeFlowAloneTakesTheLumen) {
  const std::string rigid =
      "analysis: flow\nelements: linear\nmesh: {geometry: {parametric: {}}, size: coarse}\n"
      "fluid: {}\n"
      "boundary: {lumen_inlet: {flow: 90 ml/s}, lumen_wall: no_slip, \"lumen_*\": {resistance: 4e8 Pa s/m^3}}\n"
      "time: {step: 1 ms, steps: 2}\n";
  write("case.yaml", rigid);
  EXPECT_EQ(tunica("check case.yaml"), 0) << printed();
  expect_refused(rigid, {"lumen_wall: no_slip", "lumen_wall: no_slip, wall_outer: free",
                         "boundary.wall_outer: the mesh has no such face"});
}

}  // namespace
}  // namespace tunica::test
