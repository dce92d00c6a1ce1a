#include "tunica/peer_cases/translate.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>

#include "temporary_folder.hpp"
#include "tunica/base/error.hpp"

namespace tunica::peer_cases {

namespace {

using test::message_of;
using test::TemporaryFolder;

/// The parts of a small flow problem that tests replace.
struct FlowParts {
  std::string general =
      "<Number_of_time_steps>2</Number_of_time_steps><Time_step_size>0.005</Time_step_size>"
      "<Spectral_radius_of_infinite_time_step>0.5</Spectral_radius_of_infinite_time_step>";
  std::string mesh = "";
  std::string equation =
      "<Density>1.06</Density><Viscosity model=\"Constant\"><Value>0.04</Value></Viscosity>"
      "<Tolerance>1e-5</Tolerance><Max_iterations>5</Max_iterations>";
  std::string inlet = "<Type>Dir</Type><Value>-10</Value><Impose_flux>true</Impose_flux>";
  std::string outlet = "<Type>Neu</Type><Time_dependence>Resistance</Time_dependence><Value>1212</Value>";
  std::string more = "";
};

std::string flow(const FlowParts& p) {
  return "<svMultiPhysicsFile><GeneralSimulationParameters>" + p.general +
         "</GeneralSimulationParameters>\n<Add_mesh name=\"msh\"><Mesh_file_path>m/volume.vtu</Mesh_file_path>\n"
         "<Add_face name=\"in\"><Face_file_path>m/in.vtp</Face_file_path></Add_face>\n"
         "<Add_face name=\"out\"><Face_file_path>m/out.vtp</Face_file_path></Add_face>\n"
         "<Add_face name=\"side\"><Face_file_path>m/side.vtp</Face_file_path></Add_face>" +
         p.mesh + "</Add_mesh>\n<Add_equation type=\"fluid\">" + p.equation + "<Add_BC name=\"in\">" + p.inlet +
         "</Add_BC>\n<Add_BC name=\"out\">" + p.outlet +
         "</Add_BC>\n<Add_BC name=\"side\"><Type>Dir</Type><Value>0.0</Value></Add_BC>" + p.more +
         "</Add_equation></svMultiPhysicsFile>";
}

/// A block of wall that is held at X0 and loaded at X1.
std::string wall(const std::string& equation, const std::string& load, const std::string& type = "struct",
                 const std::string& mesh = "") {
  return "<svMultiPhysicsFile><GeneralSimulationParameters><Number_of_time_steps>2</Number_of_time_steps>"
         "<Time_step_size>0.1</Time_step_size></GeneralSimulationParameters><Add_mesh name=\"msh\">"
         "<Mesh_file_path>b/volume.vtu</Mesh_file_path>"
         "<Add_face name=\"X0\"><Face_file_path>b/X0.vtp</Face_file_path></Add_face>"
         "<Add_face name=\"X1\"><Face_file_path>b/X1.vtp</Face_file_path></Add_face>"
         "<Add_face name=\"side\"><Face_file_path>b/side.vtp</Face_file_path></Add_face>" +
         mesh + "</Add_mesh><Add_equation type=\"" + type + "\">" + equation +
         "<Add_BC name=\"X0\"><Type>Dir</Type><Value>0</Value><Effective_direction>(1, 0, 1)</Effective_direction>"
         "</Add_BC><Add_BC name=\"X1\">" +
         load + "</Add_BC></Add_equation></svMultiPhysicsFile>";
}
constexpr const char* elastic =
    "<Density>1.2</Density><Elasticity_modulus>1e6</Elasticity_modulus><Poisson_ratio>0.3</Poisson_ratio>";
constexpr const char* pressure = "<Type>Neu</Type><Value>100.0</Value>";

/// Blood in a wall, with more keys of the mesh of the wall.
std::string coupled(const std::string& wall_mesh) {
  const auto face = [](const std::string& name) {
    return "<Add_face name=\"" + name + "\"><Face_file_path>" + name + ".vtp</Face_file_path></Add_face>";
  };
  return "<svMultiPhysicsFile><GeneralSimulationParameters><Number_of_time_steps>2</Number_of_time_steps>"
         "<Time_step_size>0.1</Time_step_size></GeneralSimulationParameters>"
         "<Add_mesh name=\"lumen\"><Mesh_file_path>l.vtu</Mesh_file_path>" +
         face("in") + face("out") + face("side") + "<Domain>0</Domain></Add_mesh>" +
         "<Add_mesh name=\"wall\"><Mesh_file_path>w.vtu</Mesh_file_path>" + face("inner") + face("outer") +
         face("ends") + "<Domain>1</Domain>" + wall_mesh +
         "</Add_mesh><Add_projection name=\"inner\"><Project_from_face>side</Project_from_face></Add_projection>"
         "<Add_equation type=\"FSI\"><Domain id=\"0\"><Equation>fluid</Equation><Density>1.06</Density>"
         "<Viscosity model=\"Constant\"><Value>0.04</Value></Viscosity></Domain><Domain id=\"1\"><Equation>struct"
         "</Equation><Density>1</Density><Elasticity_modulus>1e6</Elasticity_modulus></Domain>"
         "<Add_BC name=\"in\"><Type>Dir</Type><Value>-10</Value><Impose_flux>true</Impose_flux></Add_BC>"
         "<Add_BC name=\"ends\"><Type>Dir</Type><Value>0</Value></Add_BC></Add_equation>"
         "<Add_equation type=\"mesh\"/></svMultiPhysicsFile>";
}

Translation translated(const std::string& xml, const std::string& units = "cgs") {
  return translate(read_xml(xml, "case/solver.xml"), unit_system(units), "case");
}
std::string refused(const std::string& xml, const std::string& units = "cgs") {
  return message_of<InputError>([&] { translated(xml, units); });
}

/// The lines of the case without comments and head.
std::string plain(const Translation& translation) {
  std::string text;
  std::istringstream lines(translation.yaml);
  for (std::string line; std::getline(lines, line);) {
    line = line.substr(0, line.find('#'));
    while (!line.empty() && line.back() == ' ') line.pop_back();
    if (!line.empty()) text += line + "\n";
  }
  return text;
}

testing::AssertionResult has(const std::string& text, const std::string& part) {
  if (text.find(part) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "`" << part << "` is not in\n" << text;
}
std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const auto& line : lines) text += line + "\n";
  return text;
}

TEST(Translate, WritesAFlow) {
  const auto translation = translated(flow({}));
  EXPECT_EQ(
      plain(translation),
      "title: solver.xml\nelements: linear\nanalysis: flow\nmeshes:\n  length_unit: cm\n  lumen:\n    volume: "
      "m/volume.vtu\n"
      "    faces:\n      in: m/in.vtp\n      out: m/out.vtp\n      side: m/side.vtp\nfluid:\n"
      "  density: 1.06 g/cm^3\n  viscosity:\n    newtonian:\n      viscosity: 0.04 dyn s/cm^2\n  stabilisation: "
      "vms_classic\nboundary:\n"
      "  in:\n    flow:\n      value: -10 cm^3/s\n      positive: outflow\n      profile: flat\n"
      "  out:\n    resistance:\n      resistance: 1212 dyn s/cm^5\n  side:\n    no_slip: {}\n"
      "time:\n  step: 0.005 s\n  steps: 2\n  rho_infinity: 0.5\n  loads: end\nnewton:\n  relative_tolerance: 1e-05\n"
      "output:\n  instant: end\n  units:\n    length: cm\n    velocity: cm/s\n    pressure: dyn/cm^2\n    "
      "stress: dyn/cm^2\n"
      "    flow: cm^3/s\n");
  EXPECT_TRUE(has(translation.yaml, "density: 1.06 g/cm^3                          # solver.xml:6 Density"));
  EXPECT_TRUE(has(joined(translation.remarks.dropped), "Max_iterations"));
  EXPECT_TRUE(has(joined(translation.remarks.defaults), "Backflow_stabilization_coefficient: 0.2"));
  EXPECT_EQ(translation.warnings.size(), 4u);  // four files that are not there
}

TEST(Translate, ListsWhatHasNoEffect) {
  const auto listed = [](const FlowParts& parts) { return joined(translated(flow(parts)).remarks.dropped); };
  EXPECT_EQ(listed({}).find("without effect here"), std::string::npos) << listed({});
  FlowParts parts;
  parts.general += "<Convert_BIN_to_VTK_format>false</Convert_BIN_to_VTK_format>";
  parts.equation += "<Use_taylor_hood_type_basis>false</Use_taylor_hood_type_basis><Poisson_ratio>0.3</Poisson_ratio>";
  parts.inlet =
      "<Type>Dir</Type><Time_dependence>Unsteady</Time_dependence><Temporal_values_file_path>in.flow"
      "</Temporal_values_file_path><Value>3</Value><Impose_flux>true</Impose_flux>";
  parts.outlet += "<RCR_values><Capacitance>1</Capacitance></RCR_values>";
  const auto all = listed(parts);
  EXPECT_TRUE(has(all, "switched off, and not in tunica: Convert_BIN_to_VTK_format:1"));
  for (const char* key : {"Use_taylor_hood_type_basis:", "Poisson_ratio:", "Value:", "RCR_values:"})
    EXPECT_TRUE(has(all.substr(all.find("without effect here")), key));
  EXPECT_EQ(all.find("Capacitance"), std::string::npos) << all;
  EXPECT_TRUE(has(translated(flow(parts)).yaml, "without effect here:"));
}

TEST(Translate, WarnsOfAnInletThatIsAWall) {
  FlowParts parts;
  parts.inlet = "<Type>Dir</Type><Temporal_values_file_path>in.flow</Temporal_values_file_path>";
  const auto steady = translated(flow(parts));
  EXPECT_TRUE(has(joined(steady.warnings), "the face is a wall that blood does not pass; write Unsteady"));
  EXPECT_TRUE(has(joined(steady.remarks.dropped), "Temporal_values_file_path:"));
  parts.inlet = "<Type>Dir</Type>";
  EXPECT_TRUE(has(joined(translated(flow(parts)).warnings), "in has no Value, which svMultiPhysics takes for 0"));
}

TEST(Translate, TakesCountsInDigitsAlone) {
  const auto of = [](const char* steps) {
    FlowParts parts;
    parts.general =
        fmt::format("<Number_of_time_steps>{}</Number_of_time_steps><Time_step_size>0.005</Time_step_size>", steps);
    return refused(flow(parts));
  };
  EXPECT_TRUE(has(of("1e3"), "svMultiPhysics reads 1"));
  const auto two = of("1600 100");
  EXPECT_TRUE(has(two, "`1600 100` is no number"));
  EXPECT_EQ(two.find("has no Number_of_time_steps"), std::string::npos) << two;
}

TEST(Translate, TakesUnitsFromTheSystem) {
  FlowParts parts;
  parts.equation = "<Density>1.06e-3</Density><Viscosity model=\"Newtonian\"><Value>0.004</Value></Viscosity>";
  const auto mm = plain(translated(flow(parts), "mmgs"));
  for (const char* line : {"length_unit: mm", "density: 1.06e-3 g/mm^3", "viscosity: 0.004 Pa s", "-10 mm^3/s",
                           "1212 Pa s/mm^3", "pressure: Pa"})
    EXPECT_TRUE(has(mm, line));
  EXPECT_TRUE(has(refused(flow(parts), "cgs"), "with --units mmgs it is 1060"));
  parts.mesh = "<Mesh_scale_factor>10</Mesh_scale_factor>";
  EXPECT_TRUE(has(plain(translated(flow(parts), "mmgs")), "length_unit: cm"));
  parts.mesh = "<Mesh_scale_factor>2.54</Mesh_scale_factor>";
  EXPECT_TRUE(has(plain(translated(flow(parts), "mmgs")), "length_unit: mm\n  scale: 2.54"));
}

TEST(Translate, DoesNotInheritUnusableDefaults) {
  FlowParts parts;
  parts.equation = "<Viscosity model=\"Constant\"><Value>0.04</Value></Viscosity>";
  const auto translation = translated(flow(parts));
  const auto text = plain(translation), defaults = joined(translation.remarks.defaults);
  EXPECT_EQ(text.find("density"), std::string::npos);
  EXPECT_EQ(text.find("relative_tolerance"), std::string::npos);
  EXPECT_TRUE(has(defaults, "Density: 1060 kg/m^3, the default of tunica; svMultiPhysics would take 0.5"));
  EXPECT_TRUE(has(defaults, "Tolerance: 1e-4, the default of tunica; svMultiPhysics would take 0.5"));
  EXPECT_TRUE(has(defaults, "Max_iterations: 12"));
  const auto robin = translated(wall(elastic, "<Type>Robin</Type><Stiffness>1e4</Stiffness>"));
  EXPECT_TRUE(has(plain(robin), "stiffness: 1e4 dyn/cm^3\n      damping: 0 dyn s/cm^3"));
  EXPECT_TRUE(has(joined(robin.remarks.defaults), "Damping: 0; svMultiPhysics would take 1"));
  const auto light = translated(wall("<Elasticity_modulus>1e6</Elasticity_modulus>", pressure));
  EXPECT_TRUE(has(plain(light), "density: 1000 kg/m^3\n"));
  EXPECT_TRUE(has(joined(light.remarks.defaults), "svMultiPhysics would take 0.5"));
  EXPECT_TRUE(has(refused(wall("<Density>1</Density>", pressure)), "has no Elasticity_modulus"));
  parts.equation = "<Density>1.06</Density>";
  EXPECT_TRUE(has(refused(flow(parts)), "has no Viscosity"));
}

TEST(Translate, ReadsTimeCourses) {
  FlowParts parts;
  parts.inlet =
      "<Type>Dir</Type><Time_dependence>Unsteady</Time_dependence>"
      "<Temporal_values_file_path>in.flow</Temporal_values_file_path><Profile>Parabolic</Profile>"
      "<Impose_flux>true</Impose_flux>";
  EXPECT_TRUE(
      has(plain(translated(flow(parts))),
          "  in:\n    flow:\n      table:\n        file: in.flow\n        format: simvascular\n        time_unit: s\n"
          "        unit: cm^3/s\n        interpolation: fourier\n        trend: true\n      positive: outflow\n"
          "      profile: parabolic\n"));
  parts.inlet =
      "<Type>Neu</Type><Time_dependence>Unsteady</Time_dependence>"
      "<Temporal_values_file_path>p.dat</Temporal_values_file_path><Ramp_function>true</Ramp_function>";
  EXPECT_TRUE(has(plain(translated(flow(parts))),
                  "pressure:\n      table:\n        file: p.dat\n        format: "
                  "simvascular\n        time_unit: s\n        unit: dyn/cm^2\n        "
                  "interpolation: ramp\n"));
  parts.inlet =
      "<Type>Dir</Type><Time_dependence>Unsteady</Time_dependence>"
      "<Fourier_coefficients_file_path>in.fcs</Fourier_coefficients_file_path>";
  EXPECT_TRUE(
      has(plain(translated(flow(parts))),
          "profile:\n      speed: \"-1\"\n      unit: cm/s\n      length_unit: cm\n      waveform:\n        table:\n "
          "         file: in.fcs\n          format: fourier\n          time_unit: s\n"));
  parts.inlet = "<Type>Dir</Type><Time_dependence>Unsteady</Time_dependence>";
  EXPECT_TRUE(has(refused(flow(parts)), "Unsteady without a file"));
}

TEST(Translate, ReadsOutlets) {
  FlowParts parts;
  parts.outlet =
      "<Type>Neu</Type><Time_dependence>RCR</Time_dependence><RCR_values><Capacitance>1.5e-5</Capacitance>"
      "<Distal_resistance>1212</Distal_resistance><Proximal_resistance>121</Proximal_resistance>"
      "<Distal_pressure>5</Distal_pressure></RCR_values>";
  EXPECT_TRUE(
      has(plain(translated(flow(parts))),
          "rcr:\n      proximal: 121 dyn s/cm^5\n      capacitance: 1.5e-5 cm^5/dyn\n      distal: 1212 dyn s/cm^5\n"
          "      distal_pressure: 5 dyn/cm^2\n      initial_pressure: 0 dyn/cm^2\n"));
  parts.outlet = "<Type>Neu</Type><Value>2.5</Value>";
  EXPECT_TRUE(has(plain(translated(flow(parts))), "out:\n    pressure:\n      value: 2.5 dyn/cm^2\n"));
}

TEST(Translate, ReadsZeroDimensionalOutlets) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "zerod.json")
      << R"({"boundary_conditions": [{"bc_name": "R1", "bc_type": "RCR", "bc_values": {"Rp": 1, "C": 2, "Rd": 3}},
            {"bc_name": "R2", "bc_type": "PRESSURE", "bc_values": {}}], "external_solver_coupling_blocks":
            [{"name": "a", "connected_block": "R1"}, {"name": "b", "connected_block": "R2"}]})";
  FlowParts parts;
  parts.equation += "<svZeroDSolver_interface><Configuration_file>" + (folder.path() / "zerod.json").string() +
                    "</Configuration_file></svZeroDSolver_interface>";
  const auto with_block = [&](const std::string& block) {
    parts.outlet =
        "<Type>Neu</Type><Time_dependence>Coupled</Time_dependence><Coupling_interface><svZeroDSolver_block>" + block +
        "</svZeroDSolver_block></Coupling_interface>";
    auto file = read_xml(flow(parts), "solver.xml");
    return translate(std::move(file), unit_system("cgs"), ".");
  };
  EXPECT_TRUE(has(plain(with_block("a")), "proximal: 1 dyn s/cm^5\n      capacitance: 2 cm^5/dyn\n      distal: 3"));
  EXPECT_TRUE(has(message_of<InputError>([&] { with_block("b"); }), "`PRESSURE`"));
  EXPECT_TRUE(has(message_of<InputError>([&] { with_block("c"); }), "`c`"));
}

TEST(Translate, SquaresCassonsParameters) {
  FlowParts parts;
  parts.equation =
      "<Density>1.06</Density><Viscosity model=\"Cassons\"><Asymptotic_viscosity_parameter>0.5"
      "</Asymptotic_viscosity_parameter><Yield_stress_parameter>0.25</Yield_stress_parameter></Viscosity>";
  EXPECT_TRUE(has(plain(translated(flow(parts))),
                  "casson:\n      viscosity_at_high_shear: 0.25 dyn s/cm^2\n      yield_stress: 0.0625 dyn/cm^2\n"
                  "      regularising_shear_rate: 0.5 1/s\n"));
}

TEST(Translate, WritesAWall) {
  const auto text = plain(translated(wall(elastic, pressure)));
  for (const char* part : {"analysis: wall\n", "element: displacement\n  density: 1.2 g/cm^3\n",
                           "neo_hooke:\n      young_modulus: 1e6 dyn/cm^2\n      poisson_ratio: 0.3\n",
                           "volumetric_energy: simo_taylor\n", "X0:\n    fixed:\n      directions: [x, z]\n",
                           "X1:\n    pressure:\n      value: 100 dyn/cm^2\n      follower: false\n", "side: free\n"})
    EXPECT_TRUE(has(text, part));
  EXPECT_TRUE(has(plain(translated(wall(elastic, pressure, "ustruct"))), "element: mixed\n"));
  EXPECT_TRUE(has(plain(translated(wall(elastic,
                                        "<Type>Neu</Type><Value>1</Value><Follower_pressure_load>true"
                                        "</Follower_pressure_load>"))),
                  "follower: true\n"));
  const std::string massless =
      "<Density>0</Density><Elasticity_modulus>1e6</Elasticity_modulus><Poisson_ratio>0.3</Poisson_ratio>";
  const auto statics = plain(translated(wall(massless, pressure)));
  EXPECT_TRUE(has(statics, "static_wall:\n    load_steps: 1\n    load_time: 0.2 s\n"));
  EXPECT_EQ(statics.find("time:\n  step"), std::string::npos);
}

TEST(Translate, TakesThePenaltyForTheBulkModulus) {
  const std::string e =
      "<Density>1</Density><Elasticity_modulus>3e6</Elasticity_modulus><Poisson_ratio>0.5</Poisson_ratio>";
  EXPECT_TRUE(has(refused(wall(e, pressure)), "incompressible, which struct cannot be"));
  EXPECT_TRUE(has(plain(translated(wall(e, pressure, "ustruct"))), "poisson_ratio: 0.5\n"));
  const std::string penalty = e +
                              "<Penalty_parameter>4e9</Penalty_parameter>"
                              "<Dilational_penalty_model>M94</Dilational_penalty_model>";
  EXPECT_TRUE(has(plain(translated(wall(penalty, pressure))),
                  "shear_modulus: 1000000 dyn/cm^2\n      bulk_modulus: 4e9 dyn/cm^2\n  volumetric_energy: miehe\n"));
}

TEST(Translate, WritesLawsWithFibres) {
  const std::string mesh =
      "<Fiber_direction>(0.0, 0.0, 2.0)</Fiber_direction><Fiber_direction>(1, 0, 0)</Fiber_direction>";
  const auto guccione = plain(translated(
      wall(std::string(elastic) + "<Constitutive_model type=\"Gucci\"><c>100.0</c><bf>8</bf><bt>6</bt><bfs>12</bfs>"
                                  "</Constitutive_model>",
           pressure, "struct", mesh)));
  EXPECT_TRUE(
      has(guccione,
          "fung:\n      c: 100.0 dyn/cm^2\n      b_cc: 8\n      b_ll: 6\n      b_rr: 6\n      b_cl: 0\n      b_lr: 0\n"
          "      b_rc: 0\n      g_cl: 24\n      g_lr: 12\n      g_rc: 24\n      bulk_modulus: "));
  EXPECT_TRUE(has(guccione, "fibre_frame:\n    constant:\n      e1: [0, 0, 2]\n      e2: [1, 0, 0]\n"));
  const std::string hgo = std::string(elastic) +
                          "<Constitutive_model type=\"HGO\"><a4>1e5</a4><b4>5</b4><a6>2e5</a6>"
                          "<b6>6</b6><kappa>0.1</kappa></Constitutive_model>";
  const auto text = plain(translated(wall(hgo, pressure, "ustruct", mesh)));
  EXPECT_TRUE(has(text, "exclusion: none\n      fibre_energy: isochoric\n"));
  EXPECT_TRUE(
      has(text, fmt::format("mean_angle: {} rad\n          kappa: 0.1\n          k1: 2e5 dyn/cm^2\n          k2: 6\n",
                            std::acos(0.0))));
  EXPECT_TRUE(has(refused(wall(hgo, pressure)), "has 0 fibre directions"));
}

TEST(Translate, WritesTheLawOfHolzapfelAndOgden) {
  const std::string mesh = "<Fiber_direction>(0, 0, 2)</Fiber_direction><Fiber_direction>(1, 0, 0)</Fiber_direction>";
  const auto with = [&](const std::string& law) {
    return wall(std::string(elastic) + "<Constitutive_model type=\"" + law +
                    "\"><a>590.0</a><b>8.023</b><a4f>184720</a4f><b4f>16.026</b4f><a4s>24810</a4s><b4s>11.12</b4s>"
                    "<afs>2160</afs><bfs>11.436</bfs><k>100</k></Constitutive_model>",
                pressure, "struct", mesh);
  };
  const auto translation = translated(with("HolzapfelOgden"));
  EXPECT_TRUE(has(plain(translation),
                  "holzapfel_ogden:\n      a: 590.0 dyn/cm^2\n      a_f: 184720 dyn/cm^2\n      a_s: 24810 dyn/cm^2\n"
                  "      a_fs: 2160 dyn/cm^2\n      b: 8.023\n      b_f: 16.026\n      b_s: 11.12\n"
                  "      b_fs: 11.436\n      fibre_energy: isochoric\n      bulk_modulus: "));
  EXPECT_TRUE(has(joined(translation.remarks.changed), "not by the smooth switch"));
  EXPECT_TRUE(has(plain(translated(with("HO-ma"))), "fibre_energy: unsplit"));
  EXPECT_TRUE(has(refused(wall(std::string(elastic) + "<Constitutive_model type=\"HO\"/>", pressure, "struct", mesh)),
                  "has no a4f"));
}

TEST(Translate, WritesFacesThatAreMoved) {
  EXPECT_TRUE(has(plain(translated(wall(elastic,
                                        "<Type>Dir</Type><Value>0.1</Value><Zero_out_perimeter>0</Zero_out_perimeter>"
                                        "<Effective_direction>(0, 1, 0)</Effective_direction>"))),
                  "X1:\n    displacement:\n      value: [0 cm, 0.1 cm, 0 cm]\n      directions: [y]\n"));
  const auto unsteady = plain(translated(
      wall(elastic,
           "<Type>Dir</Type><Time_dependence>Unsteady</Time_dependence><Ramp_function>true</Ramp_function>"
           "<Zero_out_perimeter>false</Zero_out_perimeter><Effective_direction>(1, 0, 1)</Effective_direction>"
           "<Temporal_values_file_path>load.dat</Temporal_values_file_path>")));
  EXPECT_TRUE(has(unsteady,
                  "value: [1 cm, 0 cm, 1 cm]\n      directions: [x, z]\n      waveform:\n        table:\n          "
                  "file: load.dat\n"));
  EXPECT_TRUE(has(unsteady, "interpolation: ramp"));
  const char* by_key =
      "<Type>Dir</Type><Value>0.1</Value><Zero_out_perimeter>false</Zero_out_perimeter>"
      "<Effective_direction>(0, 0, 1)</Effective_direction>"
      "<Impose_on_state_variable_integral>true</Impose_on_state_variable_integral>";
  EXPECT_TRUE(has(plain(translated(wall(elastic, by_key, "ustruct"))), "value: [0 cm, 0 cm, 0.1 cm]\n"));
}

TEST(Translate, MovesNodesAlongTheirNormalsWhereNoAxisIsGiven) {
  const auto moved = translated(wall(elastic, "<Type>Dir</Type><Value>0.1</Value>"));
  EXPECT_TRUE(has(plain(moved),
                  "X1:\n    displacement:\n      over_face:\n        table: X1_displacements.csv\n        unit: m\n"
                  "        length_unit: m\n        interpolation: nearest\n      waveform:\n        value: 0.1\n"));
  ASSERT_EQ(moved.nodal.size(), 1u);
  EXPECT_EQ(moved.nodal[0].kind, NodalValues::Kind::flat);
  EXPECT_TRUE(moved.nodal[0].zero_rim && moved.nodal[0].wall && moved.nodal[0].axes.empty());
  const auto parabolic = translated(wall(elastic,
                                         "<Type>Dir</Type><Value>0.1</Value><Profile>Parabolic</Profile>"
                                         "<Effective_direction>(0, 1, 0)</Effective_direction>"
                                         "<Zero_out_perimeter>false</Zero_out_perimeter>"));
  EXPECT_TRUE(has(plain(parabolic), "directions: [y]\n"));
  EXPECT_EQ(parabolic.nodal.at(0).kind, NodalValues::Kind::parabolic);
  EXPECT_EQ(parabolic.nodal[0].axes, std::vector<int>{1});
  EXPECT_FALSE(parabolic.nodal[0].zero_rim);
}

TEST(Translate, TakesMotionsAndLoadsOfWallsInTime) {
  const std::string general =
      "<Time_dependence>General</Time_dependence><Temporal_and_spatial_values_file_path>v.dat"
      "</Temporal_and_spatial_values_file_path>";
  const auto moved =
      translated(wall(elastic, "<Type>Dir</Type><Effective_direction>(1, 0, 1)</Effective_direction>" + general));
  EXPECT_TRUE(has(plain(moved), "over_face:\n        table: X1_displacements.csv\n"));
  EXPECT_TRUE(has(plain(moved), "directions: [x, z]\n"));
  EXPECT_EQ(moved.nodal.at(0).axes, (std::vector<int>{0, 2}));
  const auto loaded = translated(wall(elastic, "<Type>Neu</Type>" + general));
  EXPECT_TRUE(has(plain(loaded),
                  "pressure:\n      value: 1 dyn/cm^2\n      follower: false\n      over_face:\n"
                  "        table: X1_pressures.csv\n        length_unit: m\n"));
  EXPECT_EQ(loaded.nodal.at(0).scale, -1.0);
  EXPECT_TRUE(has(joined(loaded.remarks.changed), "pressures of the other sign"));
  const auto pulled = translated(wall(elastic, "<Type>Trac</Type>" + general));
  EXPECT_TRUE(has(plain(pulled), "traction:\n      over_face:\n        table: X1_tractions.csv\n        unit: Pa\n"));
  EXPECT_EQ(pulled.nodal.at(0).kind, NodalValues::Kind::in_time);
  EXPECT_TRUE(has(refused(wall(elastic,
                               "<Type>Neu</Type><Time_dependence>General</Time_dependence>"
                               "<Bct_file_path>b.vtp</Bct_file_path>")),
                  "is for velocities of the blood"));
  EXPECT_TRUE(has(refused(wall(elastic, "<Type>Dir</Type>" + general, "ustruct")), "whose velocity is given"));
}

TEST(Translate, TakesTractionsNodeByNodeAndInTime) {
  const auto nodal = translated(wall(elastic,
                                     "<Type>Trac</Type><Traction_values_file_path>t.vtp</Traction_values_file_path>"
                                     "<Traction_multiplier>0.5</Traction_multiplier>"));
  EXPECT_TRUE(has(plain(nodal), "traction:\n      over_face:\n        table: X1_tractions.csv\n        unit: Pa\n"));
  EXPECT_EQ(nodal.nodal.at(0).kind, NodalValues::Kind::traction);
  EXPECT_EQ(nodal.nodal[0].scale, 0.5);
  const auto course = translated(wall(elastic,
                                      "<Type>Trac</Type><Time_dependence>Unsteady</Time_dependence>"
                                      "<Temporal_values_file_path>t.dat</Temporal_values_file_path>"));
  EXPECT_EQ(course.nodal.at(0).kind, NodalValues::Kind::course);
  EXPECT_EQ(course.nodal[0].steps, 2u);
  EXPECT_EQ(course.nodal[0].step, 0.1);
  EXPECT_FALSE(course.nodal[0].coefficients);
  const auto series = translated(wall(elastic,
                                      "<Type>Trac</Type><Time_dependence>Unsteady</Time_dependence>"
                                      "<Fourier_coefficients_file_path>t.fcs</Fourier_coefficients_file_path>"));
  EXPECT_EQ(series.nodal.at(0).kind, NodalValues::Kind::course);
  EXPECT_TRUE(series.nodal[0].coefficients);
  EXPECT_EQ(series.nodal[0].file.filename(), "t.fcs");
  EXPECT_TRUE(has(refused(wall(elastic, "<Type>Trac</Type><Time_dependence>Unsteady</Time_dependence>")),
                  "Unsteady without a file"));
}

TEST(Translate, GivesVelocitiesOfBloodAlongSomeAxes) {
  FlowParts parts;
  parts.inlet =
      "<Type>Dir</Type><Value>-3</Value><Zero_out_perimeter>false</Zero_out_perimeter>"
      "<Effective_direction>(0, 0, 1)</Effective_direction>";
  EXPECT_TRUE(has(plain(translated(flow(parts))),
                  "  in:\n    velocity:\n      value: [0 cm/s, 0 cm/s, -3 cm/s]\n      directions: [z]\n"));
  parts.inlet = "<Type>Dir</Type><Value>0</Value><Effective_direction>(1, 1, 0)</Effective_direction>";
  EXPECT_TRUE(has(plain(translated(flow(parts))),
                  "  in:\n    velocity:\n      value: [0 cm/s, 0 cm/s, 0 cm/s]\n      directions: [x, y]\n"));
  // The perimeter is zero where nothing else is said.
  parts.inlet =
      "<Type>Dir</Type><Time_dependence>Unsteady</Time_dependence><Profile>Parabolic</Profile>"
      "<Temporal_values_file_path>in.flow</Temporal_values_file_path>"
      "<Effective_direction>(0, 0, 1)</Effective_direction>";
  const auto shaped = translated(flow(parts));
  EXPECT_TRUE(has(plain(shaped), "profile:\n      table: in_velocities.csv\n")) << plain(shaped);
  EXPECT_TRUE(has(plain(shaped), "      directions: [z]\n      waveform:\n"));
  EXPECT_EQ(shaped.nodal.at(0).kind, NodalValues::Kind::parabolic);
  EXPECT_EQ(shaped.nodal[0].axes, std::vector<int>{2});
  EXPECT_TRUE(shaped.nodal[0].zero_rim);
  parts.inlet =
      "<Type>Dir</Type><Time_dependence>General</Time_dependence><Effective_direction>(0, 0, 1)</Effective_direction>"
      "<Temporal_and_spatial_values_file_path>v.dat</Temporal_and_spatial_values_file_path>";
  const auto general = translated(flow(parts));
  EXPECT_TRUE(has(plain(general), "directions: [z]\n"));
  EXPECT_EQ(general.nodal.at(0).axes, std::vector<int>{2});
}

TEST(Translate, TakesLoadsWithAProfile) {
  FlowParts parts;
  parts.outlet = "<Type>Neu</Type><Value>5</Value><Profile>Parabolic</Profile><Impose_flux>true</Impose_flux>";
  const auto flow_case = translated(flow(parts));
  EXPECT_TRUE(
      has(plain(flow_case), "pressure:\n      value: 5 dyn/cm^2\n      over_face:\n        table: out_factors.csv\n"));
  EXPECT_TRUE(flow_case.nodal.at(0).unit_flow);
  EXPECT_FALSE(flow_case.nodal[0].zero_rim);
  parts.outlet = "<Type>Neu</Type><Value>5</Value>";
  parts.inlet = "<Type>Dir</Type><Value>-30</Value><Profile>Parabolic</Profile>";
  const auto parabolic = translated(flow(parts));
  EXPECT_TRUE(has(plain(parabolic), "in:\n    profile:\n      table: in_velocities.csv\n      unit: m/s\n"));
  EXPECT_TRUE(has(plain(parabolic), "waveform:\n        value: -30\n"));
  EXPECT_EQ(parabolic.nodal.at(0).kind, NodalValues::Kind::parabolic);
}

TEST(Translate, LetsLoadsActAsThePeerDoes) {
  const auto translation =
      translated(wall(elastic,
                      "<Type>Neu</Type><Time_dependence>Unsteady</Time_dependence><Ramp_function>true</Ramp_function>"
                      "<Temporal_values_file_path>load.dat</Temporal_values_file_path>"));
  EXPECT_TRUE(has(plain(translation), "file: load.dat\n"));
  EXPECT_TRUE(has(plain(translation), "  loads: end\n"));
}

TEST(Translate, TakesAFaceThatMovesAsAWhole) {
  const std::string keys = "<Type>Neu</Type><Value>5</Value><Undeforming_neu_face>true</Undeforming_neu_face>";
  EXPECT_TRUE(has(plain(translated(wall(elastic, keys, "ustruct"))),
                  "pressure:\n      value: 5 dyn/cm^2\n      follower: false\n      undeforming: true\n"));
  const std::string unloaded = "<Type>Neu</Type><Value>0</Value><Undeforming_neu_face>true</Undeforming_neu_face>";
  EXPECT_TRUE(has(plain(translated(wall(elastic, unloaded, "ustruct"))), "undeforming: true\n"));
  const std::string off = "<Type>Neu</Type><Value>5</Value><Undeforming_neu_face>false</Undeforming_neu_face>";
  EXPECT_EQ(plain(translated(wall(elastic, off, "ustruct"))).find("undeforming"), std::string::npos);
  FlowParts parts;
  parts.outlet = keys;
  EXPECT_TRUE(has(refused(flow(parts)), "Undeforming_neu_face: is for walls"));
}

TEST(Translate, TakesTheViscosityOfAWall) {
  const std::string viscous = std::string(elastic) + "<Viscosity model=\"Newtonian\"><Value>50.0</Value></Viscosity>";
  EXPECT_TRUE(has(plain(translated(wall(viscous, pressure))),
                  "  viscosity:\n    value: 50.0 dyn s/cm^2\n    law: newtonian\n"));
  const std::string potential = std::string(elastic) + "<Viscosity model=\"Pot\"><Value>5</Value></Viscosity>";
  EXPECT_TRUE(has(plain(translated(wall(potential, pressure))), "law: potential\n"));
  const std::string none = std::string(elastic) + "<Viscosity model=\"Newtonian\"><Value>0</Value></Viscosity>";
  EXPECT_EQ(plain(translated(wall(none, pressure))).find("viscosity"), std::string::npos);
  const std::string other = std::string(elastic) + "<Viscosity model=\"Cassons\"><Value>5</Value></Viscosity>";
  EXPECT_TRUE(has(refused(wall(other, pressure)), "which svMultiPhysics does not have for walls"));
}

TEST(Translate, TakesVelocitiesNodeByNode) {
  FlowParts parts;
  parts.inlet = "<Type>Dir</Type><Time_dependence>General</Time_dependence><Bct_file_path>bct.vtp</Bct_file_path>";
  const auto bct = translated(flow(parts));
  EXPECT_TRUE(has(plain(bct),
                  "in:\n    profile:\n      table: in_velocities.csv\n      unit: m/s\n      length_unit: m\n      "
                  "interpolation: nearest\n"));
  ASSERT_EQ(bct.nodal.size(), 1u);
  EXPECT_EQ(bct.nodal[0].file, "case/bct.vtp");
  EXPECT_EQ(bct.nodal[0].kind, NodalValues::Kind::bct);
  const auto looked = translate(read_xml(flow(parts), "case/solver.xml"), unit_system("cgs"), "case",
                                {.periods = {{"in_velocities.csv", 0.8}}});
  EXPECT_TRUE(has(plain(looked), "period: 0.8 s\n"));
  parts.inlet =
      "<Type>Dir</Type><Time_dependence>General</Time_dependence>"
      "<Temporal_and_spatial_values_file_path>v.dat</Temporal_and_spatial_values_file_path>";
  EXPECT_EQ(translated(flow(parts)).nodal.at(0).kind, NodalValues::Kind::in_time);
  parts.inlet =
      "<Type>Dir</Type><Value>-3</Value><Profile>User_defined</Profile><Impose_flux>true</Impose_flux>"
      "<Spatial_profile_file_path>shape.dat</Spatial_profile_file_path>";
  const auto shape = translated(flow(parts));
  EXPECT_TRUE(has(plain(shape), "interpolation: nearest\n      waveform:\n        value: -3\n"));
  EXPECT_TRUE(shape.nodal.at(0).unit_flow);
  EXPECT_TRUE(shape.nodal.at(0).zero_rim);
  EXPECT_EQ(shape.nodal.at(0).first_node, 0);
  parts.inlet = "<Type>Dir</Type><Time_dependence>General</Time_dependence>";
  EXPECT_TRUE(has(refused(flow(parts)), "is General without a file"));
  parts.inlet = "<Type>Neu</Type><Time_dependence>General</Time_dependence><Bct_file_path>bct.vtp</Bct_file_path>";
  EXPECT_TRUE(has(refused(flow(parts)), "Bct_file_path: is for velocities of the blood"));
}

TEST(Translate, TakesTheAngleOfFibresInFiles) {
  const std::string law = std::string(elastic) +
                          "<Constitutive_model type=\"HGO\"><a4>1</a4><b4>2</b4><a6>1</a6><b6>2</b6><kappa>0.1</kappa>"
                          "</Constitutive_model>";
  const std::string xml = wall(law, pressure, "struct",
                               "<Fiber_direction_file_path>f1.vtu</Fiber_direction_file_path>"
                               "<Fiber_direction_file_path>f2.vtu</Fiber_direction_file_path>");
  const auto first = translated(xml);
  ASSERT_TRUE(first.fibres.has_value());
  EXPECT_EQ(first.fibres->second, "case/f2.vtu");
  const auto looked = translate(read_xml(xml, "case/solver.xml"), unit_system("cgs"), "case", {.fibre_angles = {1.25}});
  EXPECT_TRUE(has(plain(looked), "mean_angle: 1.25 rad\n"));
  EXPECT_FALSE(looked.regions.has_value());
}

TEST(Translate, GivesEveryClassOfFibreAnglesARegion) {
  const std::string law = std::string(elastic) +
                          "<Constitutive_model type=\"HGO\"><a4>1</a4><b4>2</b4><a6>1</a6><b6>2</b6><kappa>0.1</kappa>"
                          "</Constitutive_model>";
  const std::string xml = wall(law, pressure, "struct",
                               "<Fiber_direction_file_path>f1.vtu</Fiber_direction_file_path>"
                               "<Fiber_direction_file_path>f2.vtu</Fiber_direction_file_path>");
  const auto looked = translate(read_xml(xml, "case/solver.xml"), unit_system("cgs"), "case",
                                {.fibre_angles = {0.5, 1.25}, .fibre_deviation = 0.01});
  const auto text = plain(looked);
  EXPECT_TRUE(has(text, "      REGION:\n        file: solver_regions.vtu\n"));
  EXPECT_TRUE(has(text, "    region_array: REGION\n    regions:\n      fibres_1: 0\n      fibres_2: 1\n"));
  EXPECT_TRUE(has(text, "    fibres_2:\n"));
  EXPECT_TRUE(has(text, "mean_angle: 0.5 rad\n"));
  EXPECT_TRUE(has(text, "mean_angle: 1.25 rad\n"));
  EXPECT_TRUE(has(joined(looked.remarks.changed), "is that of 2 classes of elements"));
  EXPECT_TRUE(
      has(joined(looked.remarks.changed), "solver.xml:1 Fiber_direction_file_path: the regions of the elements"));
  ASSERT_TRUE(looked.regions.has_value());
  EXPECT_TRUE(looked.regions->domains.empty());
}

TEST(Translate, TakesDomainsInAList) {
  const std::string two =
      "<Domain id=\"1\"><Density>1</Density><Elasticity_modulus>1e5</Elasticity_modulus></Domain>"
      "<Domain id=\"2\"><Density>1</Density><Elasticity_modulus>1e8</Elasticity_modulus></Domain>";
  const auto list = translated(wall(two, pressure, "struct", "<Domain_file_path>domains.dat</Domain_file_path>"));
  EXPECT_TRUE(has(plain(list),
                  "file: solver_regions.vtu\n    region_array: REGION\n    regions:\n      domain_1: 1000\n"
                  "      domain_2: 2000\n"));
  EXPECT_EQ(list.regions.value().known, (std::vector<int>{1, 2}));
  const auto file = translated(wall(two, pressure, "struct", "<Domain_file_path>domains.vtu</Domain_file_path>"));
  EXPECT_TRUE(has(plain(file), "file: domains.vtu\n    region_array: DOMAIN_ID\n    regions:\n      domain_1: 1\n"));
  EXPECT_FALSE(file.regions.has_value());
}

TEST(Translate, RefusesDomainsThatThePeersCannotHave) {
  const std::string keys = "<Density>1</Density><Elasticity_modulus>1e5</Elasticity_modulus></Domain>";
  for (const char* id : {"32", "100000000", "-1", "x"})
    EXPECT_TRUE(has(refused(wall("<Domain id=\"" + std::string(id) + "\">" + keys, pressure, "struct",
                                 "<Domain_file_path>domains.dat</Domain_file_path>")),
                    "no whole number from 0 to 31"))
        << id;
}

TEST(Translate, StartsFromADisplacedWallBesideBlood) {
  const auto translation = translate(read_xml(coupled("<Initial_displacements_file_path>u.vtu"
                                                      "</Initial_displacements_file_path>"),
                                              "case/solver.xml"),
                                     unit_system("cgs"), "case");
  EXPECT_TRUE(has(plain(translation), "start: solver_start.checkpoint\n"));
  EXPECT_EQ(translation.initial.value().wall.displacement, "case/u.vtu");
  EXPECT_TRUE(has(joined(translation.remarks.changed), "starts where the displaced wall takes it"));
}

TEST(Translate, WritesALoadByNodes) {
  const std::string load =
      "<Type>Neu</Type><Time_dependence>Spatial</Time_dependence>"
      "<Spatial_values_file_path>p.vtp</Spatial_values_file_path>";
  const auto translation = translated(wall(elastic, load));
  EXPECT_TRUE(has(plain(translation),
                  "X1:\n    pressure:\n      value: 1 dyn/cm^2\n      follower: false\n      over_face:\n"
                  "        table: X1_pressures.csv\n"));
  EXPECT_EQ(translation.nodal.at(0).kind, NodalValues::Kind::pressure);
  EXPECT_TRUE(has(refused(wall(elastic, "<Type>Neu</Type><Time_dependence>Spatial</Time_dependence>")),
                  "is Spatial without a file"));
}

TEST(Translate, AsksForAPrestressWhereThePeerSearchesForOne) {
  const auto text = plain(translated(wall(std::string(elastic) + "<Prestress>true</Prestress>", pressure)));
  EXPECT_TRUE(has(text, "prestress:\n  method: stress\n  update: second_piola\n"));
  EXPECT_TRUE(has(refused(wall(std::string(elastic) + "<Prestress>true</Prestress>", pressure, "struct",
                               "<Prestress_file_path>s.vtu</Prestress_file_path>")),
                  "beside the one of Prestress_file_path"));
}

TEST(Translate, StartsFromInitialFields) {
  FlowParts parts;
  parts.mesh =
      "<Initial_velocities_file_path>i/v.vtu</Initial_velocities_file_path>"
      "<Initial_pressures_file_path>i/p.vtu</Initial_pressures_file_path>";
  parts.equation += "<Initialize_RCR_from_flow>true</Initialize_RCR_from_flow>";
  parts.outlet =
      "<Type>Neu</Type><Time_dependence>RCR</Time_dependence><RCR_values><Capacitance>1e-5</Capacitance>"
      "<Proximal_resistance>121</Proximal_resistance><Distal_resistance>1212</Distal_resistance></RCR_values>";
  const auto translation = translated(flow(parts));
  EXPECT_TRUE(has(plain(translation), "start: solver_start.checkpoint\n"));
  EXPECT_EQ(plain(translation).find("initial_pressure"), std::string::npos);
  ASSERT_TRUE(translation.initial);
  EXPECT_EQ(translation.initial->lumen.velocity, "case/i/v.vtu");
  parts.mesh = "";
  EXPECT_TRUE(has(plain(translated(flow(parts))), "initial_pressure: 0 dyn/cm^2\n"));
  parts.mesh = "<Initial_displacements_file_path>u.vtu</Initial_displacements_file_path>";
  EXPECT_TRUE(has(refused(flow(parts)), "between rigid walls"));
}

TEST(Translate, TakesTenNodeTetrahedraForQuadraticElements) {
  auto xml = flow({});
  xml.replace(xml.find("m/in.vtp"), 8, "m/in.vtu");
  EXPECT_TRUE(has(plain(translated(xml)), "elements: quadratic\n"));
  const auto looked_at =
      translate(read_xml(flow({}), "case/solver.xml"), unit_system("cgs"), "case", {.quadratic = true});
  EXPECT_TRUE(has(plain(looked_at), "elements: quadratic\n"));
}

TEST(Translate, NamesTheFileOfElementsThatIsMadeOfANodalPrestress) {
  const auto translation =
      translated(wall(elastic, pressure, "struct", "<Prestress_file_path>pre/stress.vtu</Prestress_file_path>"));
  EXPECT_TRUE(has(plain(translation), "prestress: stress_of_elements.vtu\n"));
  ASSERT_TRUE(translation.prestress);
  EXPECT_EQ(translation.prestress->file, "case/pre/stress.vtu");
  EXPECT_EQ(translation.prestress->elements_file, "stress_of_elements.vtu");
  EXPECT_TRUE(has(joined(translation.warnings), "stress.vtu is not there"));
}

TEST(Translate, JoinsALoadWithDirectionsThatAreHeld) {
  const std::string held = "<Type>Dir</Type><Value>0</Value><Effective_direction>(1, 1, 0)</Effective_direction>",
                    then = "</Add_BC><Add_BC name=\"X1\">";
  const std::string expected =
      "X1:\n    pressure:\n      value: 100 dyn/cm^2\n      follower: false\n      fixed: [x, y]\n";
  EXPECT_TRUE(has(plain(translated(wall(elastic, held + then + pressure))), expected));
  EXPECT_TRUE(has(plain(translated(wall(elastic, pressure + then + held))), expected));
  EXPECT_TRUE(has(plain(translated(wall(elastic, held + then + "<Type>Trac</Type><Value>(0, 0, 5)</Value>"))),
                  "traction:\n      value: [0 dyn/cm^2, 0 dyn/cm^2, 5 dyn/cm^2]\n      fixed: [x, y]\n"));
  const std::string moved =
      "<Type>Dir</Type><Value>0.2</Value><Effective_direction>(0, 0, 1)</Effective_direction>"
      "<Zero_out_perimeter>false</Zero_out_perimeter>";
  for (const auto& both : {held + then + moved, moved + then + held})
    EXPECT_TRUE(has(plain(translated(wall(elastic, both))),
                    "displacement:\n      value: [0 cm, 0 cm, 0.2 cm]\n      directions: [x, y, z]\n"));
  const std::string also = "<Type>Dir</Type><Value>0</Value><Effective_direction>(0, 0, 1)</Effective_direction>";
  EXPECT_TRUE(has(plain(translated(wall(elastic, held + then + also))), "fixed:\n      directions: [x, y, z]\n"));
  const std::string across = "<Type>Dir</Type><Value>1</Value><Effective_direction>(0, 1, 1)</Effective_direction>";
  EXPECT_TRUE(has(refused(wall(elastic, held + then + across)), "a second condition"));
  EXPECT_TRUE(has(refused(wall(elastic, "<Type>Dir</Type><Value>0</Value>" + then + pressure)), "a second condition"));
  EXPECT_TRUE(has(refused(wall(elastic, held + then + pressure + then + pressure)), "a second condition"));
}

TEST(Translate, NamesThePhysicsThatIsMissing) {
  FlowParts parts;
  parts.more = "<Add_BC name=\"side\"><Type>Neu</Type><Value>1</Value></Add_BC>";
  EXPECT_TRUE(has(refused(flow(parts)), "a second condition on the face side beside that of line 8"));
  parts.more = "<Add_BC name=\"sied\"><Type>Neu</Type><Value>1</Value></Add_BC>";
  EXPECT_TRUE(has(refused(flow(parts)), "names the face `sied`"));
  parts.more = "";
  parts.general += "<Number_of_spatial_dimensions>2</Number_of_spatial_dimensions>";
  EXPECT_TRUE(has(refused(flow(parts)), "two dimensions"));
  const auto with_law = [](const std::string& law) {
    return refused(wall(std::string(elastic) + "<Constitutive_model type=\"" + law + "\"/>", pressure));
  };
  EXPECT_TRUE(has(with_law("LS"), "Lee and Sacks"));
  EXPECT_TRUE(has(with_law("CANN"), "neural network"));
  EXPECT_TRUE(has(with_law("nkH"), "`nkH`"));
  const char* moved = "<Type>Dir</Type><Value>0.1</Value><Zero_out_perimeter>false</Zero_out_perimeter>";
  EXPECT_TRUE(has(refused(wall(elastic, moved, "ustruct")), "a face of the wall whose velocity is given"));
  EXPECT_TRUE(has(refused(wall(elastic, "<Type>Neu</Type><Value>(1, 2, 3)</Value>")), "has 3 components"));
  for (const auto& [type, physics] : {std::pair{"heatF", "dye"},
                                      {"CMM", "coupled momentum"},
                                      {"stokes", "inertia"},
                                      {"shell", "shells"},
                                      {"CEP", "electrophysiology"},
                                      {"lElas", "linear elasticity"}})
    EXPECT_TRUE(has(refused(wall(elastic, pressure, type)), physics));
}

TEST(Translate, ReportsMeshesThatAreMissing) {
  std::string xml = wall(std::string(elastic) + "<Constitutive_model type=\"HGO\"/>", pressure);
  const auto begin = xml.find("<Add_mesh"), end = xml.find("</Add_mesh>") + 11;
  EXPECT_TRUE(has(refused(xml.erase(begin, end - begin)), "has no mesh of the wall"));
}

TEST(Translate, RefusesTraps) {
  FlowParts parts;
  parts.equation += "<Backflow_stabilization_coefficient>2D-1</Backflow_stabilization_coefficient>";
  EXPECT_TRUE(has(refused(flow(parts)), "is read as 2 by svMultiPhysics"));
  parts.equation =
      "<Density>1.06</Density><Viscosity model=\"Constant\"><Value>0.04</Value></Viscosity><Tolerence>1"
      "</Tolerence>";
  EXPECT_TRUE(has(refused(flow(parts)), "did you mean Tolerance"));
}

TEST(Translate, GivesTheRestOfTheBoundaryNaturalConditions) {
  const auto translation =
      translate(read_xml(flow({}), "case/solver.xml"), unit_system("cgs"), "case", {.lumen_rest = true});
  EXPECT_TRUE(has(plain(translation), "rest: lumen_rest\n"));
  EXPECT_TRUE(has(plain(translation), "lumen_rest:\n    pressure: 0 dyn/cm^2\n"));
}

TEST(Translate, CountsPathsFromTheCase) {
  const auto translation = translate(read_xml(flow({}), "a/b/solver.xml"), unit_system("cgs"), "a/c");
  EXPECT_TRUE(has(plain(translation), "volume: ../b/m/volume.vtu\n"));
  const auto here = translate(read_xml(flow({}), "solver.xml"), unit_system("cgs"), "");
  EXPECT_TRUE(has(plain(here), "volume: m/volume.vtu\n"));
}

TEST(Translate, ReadsBothFormatsAlike) {
  const char* inp =
      "Number of time steps: 2\nTime step size: 0.005\nSpectral radius of infinite time step: 0.5\n"
      "Add mesh: msh {\nMesh file path: m/volume.vtu\nAdd face: in {Face file path: m/in.vtp}\n"
      "Add face: out {Face file path: m/out.vtp}\nAdd face: side {Face file path: m/side.vtp}\n}\n"
      "Add equation: fluid {\nDensity: 1.06\nViscosity: Constant {Value: 0.04}\nTolerance: 1e-5\nMax iterations: 5\n"
      "Add BC: in {\nType: Dir\nValue: -10\nImpose flux: t\n}\nAdd BC: out {\nType: Neu\nTime dependence: Resistance\n"
      "Value: 1212\n}\nAdd BC: side {\nType: Dir\nValue: 0.0\n}\n}\n";
  const auto one = plain(translated(flow({})));
  const auto other = plain(translate(read_inp(inp, "case/svFSI.inp"), unit_system("cgs"), "case"));
  EXPECT_EQ(one.substr(one.find('\n')), other.substr(other.find('\n')));  // but the title
}

}  // namespace

}  // namespace tunica::peer_cases
