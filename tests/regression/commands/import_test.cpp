// Cases of svMultiPhysics and svFSI on the command line.
#include <cstdlib>
#include <filesystem>
#include <initializer_list>

#include "program.hpp"

namespace tunica {

namespace {

constexpr const char* flow =
    "<svMultiPhysicsFile><GeneralSimulationParameters><Number_of_time_steps>1</Number_of_time_steps>\n"
    "<Time_step_size>0.01</Time_step_size></GeneralSimulationParameters>\n"
    "<Add_mesh name=\"msh\"><Mesh_file_path>none.vtu</Mesh_file_path>\n"
    "<Add_face name=\"side\"><Face_file_path>none.vtp</Face_file_path></Add_face></Add_mesh>\n"
    "<Add_equation type=\"fluid\"><Density>1.06</Density><Viscosity "
    "model=\"Constant\"><Value>0.04</Value></Viscosity>\n"
    "<Add_BC name=\"side\"><Type>Dir</Type><Value>0</Value></Add_BC></Add_equation></svMultiPhysicsFile>\n";

class Import : public test::Program {
 protected:
  testing::AssertionResult printed_has(const std::string& part) const {
    const std::string text = printed();
    if (text.find(part) != std::string::npos) return testing::AssertionSuccess();
    return testing::AssertionFailure() << "`" << part << "` is not in\n" << text;
  }
};

TEST_F(Import, WritesACaseFileAndListsWhatItChanged) {
  write("solver.xml", flow);
  EXPECT_EQ(tunica("import solver.xml -o case.yaml --units cgs"), 0) << printed();
  EXPECT_TRUE(printed_has("Tolerance: 1e-4, the default of tunica; svMultiPhysics would take 0.5"));
  EXPECT_TRUE(printed_has("none.vtu is not there"));
  EXPECT_NE(read("case.yaml").find("density: 1.06 g/cm^3"), std::string::npos) << read("case.yaml");
  EXPECT_EQ(tunica("import . -o case.yaml --units cgs"), 0) << printed();
  EXPECT_TRUE(printed_has("as it was"));
  write("case.yaml", "title: mine\n");
  EXPECT_EQ(tunica("import solver.xml -o case.yaml --units cgs"), 2);
  EXPECT_EQ(read("case.yaml"), "title: mine\n");
  EXPECT_EQ(tunica("import solver.xml -o case.yaml --units cgs --overwrite"), 0) << printed();
}

TEST_F(Import, WrongValuesAreToldByTheirPlaceInThePeersFile) {
  std::string negative = flow;
  negative.replace(negative.find("1.06"), 4, "-1.06");
  write("solver.xml", negative);
  EXPECT_EQ(tunica("import solver.xml -o case.yaml --units cgs"), 2);
  EXPECT_TRUE(printed_has("solver.xml:5 Density: fluid.density (case.yaml:"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "case.yaml"));
}

TEST_F(Import, DoesNotWriteOverItsInput) {
  write("solver.xml", flow);
  EXPECT_EQ(tunica("import solver.xml -o solver.xml --units cgs --overwrite"), 2);
  EXPECT_TRUE(printed_has("the case file would overwrite"));
  EXPECT_EQ(read("solver.xml"), flow);
}

TEST_F(Import, AsksForUnitsAndRefusesWrongOnes) {
  write("solver.xml", flow);
  EXPECT_EQ(tunica("import solver.xml -o case.yaml"), 2);
  EXPECT_TRUE(printed_has("--units cgs"));
  EXPECT_EQ(tunica("import solver.xml -o case.yaml --units si"), 2);
  EXPECT_TRUE(printed_has("no density of blood; with --units cgs it is 1060"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "case.yaml"));
}

TEST_F(Import, RefusesTablesWithExponentsAfterD) {
  std::string loaded = flow;
  loaded.replace(loaded.find("<Type>Dir</Type><Value>0</Value>"), 32,
                 "<Type>Neu</Type><Time_dependence>Unsteady</Time_dependence><Ramp_function>true</Ramp_function>"
                 "<Temporal_values_file_path>load.dat</Temporal_values_file_path>");
  write("solver.xml", loaded);
  write("load.dat", "2 1\n0.0 0.0\n1.0 5e3\n");
  EXPECT_EQ(tunica("import solver.xml -o case.yaml --units cgs"), 0) << printed();
  EXPECT_NE(read("case.yaml").find("file: load.dat"), std::string::npos) << read("case.yaml");
  EXPECT_NE(read("case.yaml").find("loads: end"), std::string::npos) << read("case.yaml");
  write("load.dat", "2 1\n0.0 0.0\n1.0 5D3\n");
  EXPECT_EQ(tunica("import solver.xml -o case.yaml --units cgs --overwrite"), 2);
  EXPECT_TRUE(printed_has("of which svMultiPhysics reads 1.5"));
}

TEST_F(Import, RunsInOneGo) {
  write("solver.xml", flow);
  EXPECT_EQ(tunica("run solver.xml"), 2);
  EXPECT_TRUE(printed_has("--units"));
  EXPECT_EQ(tunica("run solver.xml --units cgs"), 2);  // the mesh is not there
  EXPECT_TRUE(printed_has("none.vtu"));
  EXPECT_NE(read("solver.yaml").find("analysis: flow"), std::string::npos);
  write("case.yaml", "title: none\n");
  EXPECT_EQ(tunica("run case.yaml --units cgs"), 2);
  EXPECT_TRUE(printed_has("a case file says its units itself"));
}

/// A tube of blood in a wall on meshes that `tunica export` has written into `peer`.
class ImportedTube : public Import {
 protected:
  static constexpr const char* exported =
      "analysis: fsi\nelements: linear\nmeshes:\n"
      "  tube: {radius: 5 mm, length: 2 cm, wall_thickness: 1 mm, cells_around: 8, cells_radial: 1, cells_along: 4}\n"
      "  interface: {lumen: lumen_wall, wall: wall_inner}\nfluid: {}\n"
      "wall: {density: 1 g/cm^3, material: {neo_hooke: {young_modulus: 1 MPa, poisson_ratio: 0.3}}}\n"
      "boundary: {lumen_inlet: {pressure: 1 kPa}, lumen_outlet: {pressure: 0 Pa}, \"wall_*\": fixed, wall_outer: "
      "free}\n"
      "time: {step: 1 ms, steps: 1}\n";
  void SetUp() override {
    write("tube.yaml", exported);
    ASSERT_EQ(tunica("export tube.yaml -o peer --units cgs"), 0) << printed();
  }
  /// solver.xml of it; `of_wall`: more keys of the mesh of the wall, `outer`: the condition outside.
  static std::string solver(const std::string& of_wall, const std::string& outer) {
    const auto faces = [](const std::string& mesh, std::initializer_list<const char*> names) {
      std::string text = "<Mesh_file_path>peer/mesh/" + mesh + "/mesh-complete.mesh.vtu</Mesh_file_path>";
      for (const std::string name : names)
        text += "<Add_face name=\"" + name + "\"><Face_file_path>peer/mesh/" + mesh + "/mesh-surfaces/" + name +
                ".vtp</Face_file_path></Add_face>\n";
      return text;
    };
    const std::string held = "<Type>Dir</Type><Value>0</Value></Add_BC>\n";
    return "<svMultiPhysicsFile><GeneralSimulationParameters><Number_of_time_steps>3</Number_of_time_steps>"
           "<Time_step_size>0.001</Time_step_size><Spectral_radius_of_infinite_time_step>0.5"
           "</Spectral_radius_of_infinite_time_step></GeneralSimulationParameters>\n<Add_mesh name=\"lumen\">" +
           faces("lumen", {"lumen_inlet", "lumen_outlet", "lumen_wall"}) +
           "<Domain>0</Domain></Add_mesh>\n<Add_mesh name=\"wall\">" +
           faces("wall", {"wall_inlet", "wall_outlet", "wall_inner", "wall_outer"}) + "<Domain>1</Domain>" + of_wall +
           "</Add_mesh>\n<Add_projection name=\"wall_inner\"><Project_from_face>lumen_wall</Project_from_face>"
           "</Add_projection>\n<Add_equation type=\"FSI\"><Tolerance>1e-6</Tolerance><Max_iterations>9</Max_iterations>"
           "<Domain id=\"0\"><Equation>fluid</Equation><Density>1.06</Density><Viscosity model=\"Constant\"><Value>0.04"
           "</Value></Viscosity></Domain>\n<Domain id=\"1\"><Equation>struct</Equation><Density>1.1</Density>"
           "<Elasticity_modulus>1e7</Elasticity_modulus><Poisson_ratio>0.3</Poisson_ratio></Domain>\n"
           "<Add_BC name=\"lumen_inlet\"><Type>Neu</Type><Value>10000</Value></Add_BC>\n"
           "<Add_BC name=\"lumen_outlet\"><Type>Neu</Type><Time_dependence>Resistance</Time_dependence><Value>500"
           "</Value></Add_BC>\n<Add_BC name=\"wall_inlet\">" +
           held + "<Add_BC name=\"wall_outlet\">" + held + outer +
           "</Add_equation>\n<Add_equation type=\"mesh\"><Poisson_ratio>0.3</Poisson_ratio></Add_equation>"
           "</svMultiPhysicsFile>\n";
  }
  /// Histories and fields of one folder of results that are not those of the other one, byte by byte.
  std::size_t files_that_differ(const std::string& one, const std::string& other) const {
    std::size_t same = 0, different = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_ / one)) {
      const auto ending = entry.path().extension();
      const std::string name = entry.path().filename().string();
      if ((ending != ".csv" && ending != ".hdf") || name.find("tim") != std::string::npos || name == "steps.csv")
        continue;
      const auto there = folder_ / other / std::filesystem::relative(entry.path(), folder_ / one);
      (test::slurp(entry.path()) == test::slurp(there) ? same : different) += 1;
    }
    EXPECT_GT(same + different, 3u);
    return different;
  }
};

TEST_F(ImportedTube, GivesTheResultsOfTheCaseByHandBitForBit) {
  write("solver.xml", solver("", ""));
  ASSERT_EQ(tunica("import solver.xml -o imported.yaml --units cgs"), 0) << printed();
  ASSERT_EQ(tunica("run imported.yaml --output imported"), 0) << printed();
  write("hand.yaml",
        "analysis: fsi\nelements: linear\nmeshes:\n  length_unit: cm\n  lumen: {simvascular: peer/mesh/lumen}\n"
        "  wall: {simvascular: peer/mesh/wall}\n  interface: {lumen: lumen_wall, wall: wall_inner}\n"
        "fluid: {density: 1.06 g/cm^3, viscosity: {newtonian: {viscosity: 0.04 dyn s/cm^2}}, "
        "stabilisation: vms_classic}\n"
        "wall:\n  element: displacement\n  density: 1.1 g/cm^3\n  volumetric_energy: simo_taylor\n"
        "  material: {neo_hooke: {young_modulus: 1e7 dyn/cm^2, poisson_ratio: 0.3}}\n"
        "mesh_motion: {poisson_ratio: 0.3}\n"
        "boundary:\n  lumen_inlet: {pressure: 10000 dyn/cm^2}\n  lumen_outlet: {resistance: 500 dyn s/cm^5}\n"
        "  wall_inlet: fixed\n  wall_outlet: fixed\n  wall_outer: free\n"
        "time: {step: 1 ms, steps: 3, rho_infinity: 0.5, loads: end}\nnewton: {relative_tolerance: 1e-6}\n"
        "output: {instant: end, units: {length: cm, velocity: cm/s, pressure: dyn/cm^2, stress: dyn/cm^2, "
        "flow: cm^3/s}}\n");
  ASSERT_EQ(tunica("run hand.yaml --output hand"), 0) << printed();
  EXPECT_EQ(files_that_differ("imported", "hand"), 0u);
}

TEST_F(ImportedTube, StartsFromADisplacedWallAndTakesTractionsNodeByNode) {
  // Every node of the wall is moved outward by a hundredth of its distance from the axis.
  write("make.py",
        "import sys\nimport vtk\nfrom vtk.util.numpy_support import vtk_to_numpy, numpy_to_vtk\n"
        "def add(reader, writer, source, target, name, factor):\n"
        "  reader.SetFileName(source); reader.Update(); grid = reader.GetOutput()\n"
        "  x = vtk_to_numpy(grid.GetPoints().GetData()).astype(float) * factor\n  x[:, 2] = 0\n"
        "  array = numpy_to_vtk(x, deep=True); array.SetName(name); grid.GetPointData().AddArray(array)\n"
        "  writer.SetFileName(target); writer.SetInputData(grid); writer.Write()\n"
        "add(vtk.vtkXMLUnstructuredGridReader(), vtk.vtkXMLUnstructuredGridWriter(), "
        "'peer/mesh/wall/mesh-complete.mesh.vtu', 'start.vtu', 'Displacement', 0.01)\n"
        "add(vtk.vtkXMLPolyDataReader(), vtk.vtkXMLPolyDataWriter(), "
        "'peer/mesh/wall/mesh-surfaces/wall_outer.vtp', 'load.vtp', 'Traction', 1000.0)\n");
  if (std::system(("cd " + folder_.string() + " && /usr/bin/python3 make.py").c_str()) != 0)
    GTEST_SKIP() << "no vtk for Python";
  write("solver.xml", solver("<Initial_displacements_file_path>start.vtu</Initial_displacements_file_path>",
                             "<Add_BC name=\"wall_outer\"><Type>Trac</Type><Traction_values_file_path>load.vtp"
                             "</Traction_values_file_path></Add_BC>\n"));
  ASSERT_EQ(tunica("import solver.xml -o imported.yaml --units cgs"), 0) << printed();
  EXPECT_TRUE(printed_has("the mesh of the blood starts where the displaced wall takes it"));
  EXPECT_NE(read("wall_outer_tractions.csv").find("x,y,z,tx,ty,tz\n"), std::string::npos);
  ASSERT_EQ(tunica("run imported.yaml --output imported"), 0) << printed();
}

}  // namespace

}  // namespace tunica
