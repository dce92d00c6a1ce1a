// Cases of svMultiPhysics and svFSI on the command line.
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

}  // namespace

}  // namespace tunica
