// Text of other systems in case files, tables and names: taken or refused with its line, by `check` and `run` alike,
// and values of files that look like slips.
#include <cmath>
#include <numbers>

#include "program.hpp"

namespace tunica::test {
namespace {

const std::string flow_case =
    "analysis: flow\nelements: linear\n"
    "meshes: {tube: {radius: 5 mm, length: 2 cm, cells_around: 8, cells_radial: 1, cells_along: 5}}\n"
    "fluid: {}\n"
    "boundary: {lumen_inlet: {flow: 5 ml/s}, lumen_outlet: {pressure: 0 Pa}, lumen_wall: no_slip}\n"
    "time: {step: 1 ms, steps: 1}\n";

std::string utf16(const std::string& text) {
  std::string bytes = "\xFF\xFE";
  for (const char c : text) bytes += {c, '\0'};
  return bytes;
}

class Text : public Program {
 protected:
  void expect_printed(const std::string& part) const {
    EXPECT_NE(printed().find(part), std::string::npos) << part << "\n" << printed();
  }
};

TEST_F(Text, CaseFilesInOtherEncodingsAreRefusedByCheckAndRun) {
  write("latin.yaml", flow_case + "# Viskosit\xE4t\n");
  write("wide.yaml", utf16(flow_case));
  for (const char* command : {"check ", "run "}) {
    EXPECT_EQ(tunica(command + std::string("latin.yaml")), 2);
    expect_printed("latin.yaml, line 7, column 11: holds the byte 0xe4");
    EXPECT_EQ(tunica(command + std::string("wide.yaml")), 2);
    expect_printed("wide.yaml: is UTF-16, not UTF-8");
  }
  EXPECT_FALSE(fs::exists(folder_ / "results"));
}

TEST_F(Text, CaseFilesWithMarkAndLettersAreTaken) {
  write("case.yaml", "\xEF\xBB\xBF# Viskosität\r\n" + flow_case);
  EXPECT_EQ(tunica("check case.yaml"), 0) << printed();
  EXPECT_EQ(tunica("run case.yaml"), 0) << printed();
}

TEST_F(Text, NamesOfFilesNeedNotBeUtf8) {
  write("M\xFCller.yaml", flow_case);
  EXPECT_EQ(tunica("check M\xFCller.yaml"), 0) << printed();
  EXPECT_EQ(tunica("run M\xFCller.yaml --output \xE4"), 0) << printed();
  EXPECT_EQ(tunica("run M\xFCller.yaml --output \xE4 --overwrite"), 0) << printed();
  // A case with several stages writes files that name it, which cannot be done with such bytes.
  write("M\xFCller.yaml", flow_case + "report: {pictures: false}\n");
  EXPECT_EQ(tunica("check M\xFCller.yaml"), 2);
  EXPECT_EQ(tunica("run M\xFCller.yaml --output stages"), 2);
  expect_printed("M\\xfcller.yaml: is a path that is not UTF-8");
  EXPECT_FALSE(fs::exists(folder_ / "stages"));
}

TEST_F(Text, MeasuredPointsAsSpreadsheetsWriteThem) {
  write("m.yaml",
        "material: {neo_hooke: {young_modulus: 1 MPa, poisson_ratio: 0.4}}\n"
        "tests: {pull: {uniaxial: {to: 1.2}, data: {file: s.csv, load: stretch, stress: sigma, unit: kPa}}}\n");
  for (const char* table : {"\xEF\xBB\xBFstretch;sigma\r\n1,0;0\r\n", "stretch,sigma\n1.0,\n"}) {
    write("s.csv", table);
    EXPECT_EQ(tunica("material m.yaml"), 2) << table;
    expect_printed("s.csv:2: '");
  }
  write("s.csv", "\xEF\xBB\xBF\"Stretch\";\"sigma\"\r\n1.0;0\r\n+1.1;90\r\n;\r\n");
  EXPECT_EQ(tunica("material m.yaml"), 0) << printed();
  write("s.csv", utf16("stretch,sigma\n1.0,0\n"));
  EXPECT_EQ(tunica("material m.yaml"), 2);
  expect_printed("s.csv: is UTF-16");
}

TEST_F(Text, NamesOfOpeningsAreRefusedBeforeAnyWorkOrServeEverywhere) {
  std::string stl = "solid tube\n";
  const int around = 24, along = 24;
  const auto point = [&](int i, int k) {
    const double a = 2 * std::numbers::pi * i / around;
    return fmt::format("vertex {:.6f} {:.6f} {:.6f}\n", 8 * std::cos(a), 8 * std::sin(a), 60.0 * k / along);
  };
  for (int k = 0; k < along; ++k)
    for (int i = 0; i < around; ++i)
      for (const auto& t :
           {point(i, k) + point(i + 1, k) + point(i + 1, k + 1), point(i, k) + point(i + 1, k + 1) + point(i, k + 1)})
        stl += "facet normal 0 0 0\nouter loop\n" + t + "endloop\nendfacet\n";
  write("lumen.stl", stl + "endsolid tube\n");
  write("mesh.yaml",
        "geometry: {surfaces: {lumen: lumen.stl, length_unit: mm, openings: o.csv}}\nsize: {edge: 8 mm}\n");
  for (const char* name : {"L/R iliac", "../../up", "wall", "out*", "inlet", "Inlet", "<script>", "M\xFCller"}) {
    write("o.csv", fmt::format("name,centre_x,centre_y,centre_z\ninlet,0,0,0\n{},0,0,60\n", name));
    EXPECT_EQ(tunica("mesh mesh.yaml"), 2) << name;
    expect_printed(std::string(name)[0] == 'M' ? "o.csv, line 3" : "o.csv:3");
    EXPECT_EQ(printed().find("remeshing"), std::string::npos) << printed();
  }
  EXPECT_FALSE(fs::exists(folder_ / "mesh/lumen"));

  // The same in a case of several stages, for which a table says what faces there will be.
  const std::string staged =
      "analysis: fsi\nelements: linear\n"
      "mesh: {geometry: {surfaces: {lumen: lumen.stl, length_unit: mm, openings: o.csv}}, size: {edge: 8 mm}}\n"
      "fluid: {}\nwall: {density: 1 g/cm^3, material: {neo_hooke: {young_modulus: 1 MPa, poisson_ratio: 0.4}}}\n"
      "boundary: {lumen_inlet: {flow: 50 ml/s}, lumen_outlet: {resistance: 1e8 Pa s/m^3}, \"wall_*\": fixed, "
      "wall_outer: free}\n"
      "time: {step: 1 ms, steps: 1}\n";
  write("case.yaml", staged);
  for (const auto& [outlet, part] : {std::pair{"out*", "o.csv:3: the name 'out*'"}, {"end", "lumen_end"}}) {
    write("o.csv", fmt::format("name,centre_x,centre_y,centre_z\ninlet,0,0,0\n{},0,0,60\n", outlet));
    for (const char* command : {"check case.yaml", "run case.yaml --dry-run"}) {
      EXPECT_EQ(tunica(command), 2) << outlet;
      expect_printed(part);
    }
  }
  write("o.csv", "name,centre_x,centre_y,centre_z\ninlet,0,0,0\noutlet,0,0,60\n");
  EXPECT_EQ(tunica("check case.yaml"), 0) << printed();

  write("o.csv", "Name;centre_x;centre_y;centre_z\r\ninlet;0;0;0\r\n\"L. iliac außen\";0;0;+60\r\n");
  EXPECT_EQ(tunica("mesh mesh.yaml"), 0) << printed();
  EXPECT_TRUE(fs::exists(folder_ / "mesh/lumen/mesh-surfaces/lumen_L. iliac außen.vtp"));
  write("case.yaml",
        "analysis: flow\nelements: linear\nmeshes: {length_unit: mm, lumen: {simvascular: mesh/lumen}}\nfluid: "
        "{}\nboundary: "
        "{lumen_inlet: {flow: "
        "50 ml/s}, lumen_L. iliac außen: {resistance: 1e8 Pa s/m^3}, lumen_wall: no_slip}\ntime: {step: 1 ms, steps: "
        "1}\n");
  EXPECT_EQ(tunica("check case.yaml"), 0) << printed();
  EXPECT_EQ(tunica("run case.yaml"), 0) << printed();
  EXPECT_EQ(tunica("plot results/faces.csv \"außen pressure\" --output p.svg"), 0) << printed();
}

TEST_F(Text, ImplausibleValuesOfFilesAreWarnedOfByCheckAndInTheLog) {
  write("q.csv", "t,Q\n0,-1200\n390,-4800\n780,-1200\n");
  std::string text = flow_case;
  const std::string typed = "{flow: 5 ml/s}";
  text.replace(text.find(typed), typed.size(), "{flow: {table: {file: q.csv, time_unit: s, unit: ml/s}}}");
  text.replace(text.find("{radius: 5 mm, length: 2 cm"), 27, "{radius: 5 cm, length: 2 m");
  write("case.yaml", text);
  EXPECT_EQ(tunica("check case.yaml"), 0) << printed();
  const char* parts[] = {"reaches 4800 ml/s", "period of the table is 780 s", "3000 ml/s out of the vessel",
                         "the mesh is 2000 mm long"};
  for (const char* part : parts) expect_printed(part);
  tunica("run case.yaml --until 1");
  const std::string log = read("results/run.log");
  for (const char* part : parts) EXPECT_NE(log.find(part), std::string::npos) << log;
}

}  // namespace
}  // namespace tunica::test
