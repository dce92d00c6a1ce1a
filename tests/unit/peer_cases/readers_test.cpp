// Both formats become the same tree.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>

#include "temporary_folder.hpp"
#include "tunica/base/error.hpp"
#include "tunica/peer_cases/entry.hpp"
#include "tunica/peer_cases/vocabulary.hpp"

namespace tunica::peer_cases {

namespace {

using test::message_of;
using test::TemporaryFolder;

std::string keys(const Entry& entry) {
  std::string text = entry.key;
  if (!entry.label.empty()) text += fmt::format("[{}]", entry.label);
  if (!entry.value.empty()) text += fmt::format("={}", entry.value);
  if (!entry.entries.empty()) {
    text += "(";
    for (const Entry& below : entry.entries) text += fmt::format("{}{}", text.back() == '(' ? "" : " ", keys(below));
    text += ")";
  }
  return text;
}

std::string xml(const std::string& text) {
  return keys(read_xml("<svMultiPhysicsFile>" + text + "</svMultiPhysicsFile>", "solver.xml").root);
}
std::string inp(const std::string& text) { return keys(read_inp(text, "svFSI.inp").root); }

TEST(ReadXml, KeepsKeysLabelsAndValues) {
  EXPECT_EQ(xml("<Add_mesh name=\" msh \"><Domain> 1 </Domain><!-- <x> --></Add_mesh>"),
            "svMultiPhysicsFile(Add_mesh[msh](Domain=1))");
  const auto file = read_xml("<svMultiPhysicsFile>\n\n<Density>1.0\n</Density></svMultiPhysicsFile>", "a/solver.xml");
  EXPECT_EQ(file.root.entries[0].where(), "solver.xml:3 Density");
}

TEST(ReadXml, RefusesWhatIsNoXmlWithItsLine) {
  const auto wrong = [](const std::string& text) {
    return message_of<InputError>([&] { read_xml(text, "solver.xml"); });
  };
  EXPECT_NE(wrong("<svMultiPhysicsFile>\n<a>\n</b>").find("solver.xml:3"), std::string::npos);
  EXPECT_NE(wrong("<svMultiPhysicsFile><a>text<b>1</b></a></svMultiPhysicsFile>").find("between the keys"),
            std::string::npos);
  EXPECT_NE(wrong("<a/>").find("svMultiPhysicsFile"), std::string::npos);
  EXPECT_NE(wrong("<!DOCTYPE x [<!ENTITY a \"b\">]><svMultiPhysicsFile/>").find("document type"), std::string::npos);
  EXPECT_NE(wrong("").find("no XML"), std::string::npos);
}

TEST(ReadXml, PutsIncludedKeysInTheirPlace) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "domain.xml") << "<svMultiPhysicsFile><Density>2</Density></svMultiPhysicsFile>";
  std::ofstream(folder.path() / "solver.xml")
      << "<svMultiPhysicsFile><Domain id=\"1\"><Include_xml> domain.xml </Include_xml></Domain></svMultiPhysicsFile>";
  const auto file = read_peer_file(folder.path());
  EXPECT_EQ(keys(file.root), "svMultiPhysicsFile(Domain[1](Density=2))");
  EXPECT_EQ(file.root.entries[0].entries[0].where(), "domain.xml:1 Density");
  std::ofstream(folder.path() / "domain.xml")
      << "<svMultiPhysicsFile><Include_xml>domain.xml</Include_xml></svMultiPhysicsFile>";
  EXPECT_THROW(read_peer_file(folder.path()), InputError);
}

TEST(ReadInp, GivesKeysTheNamesOfSolverXml) {
  EXPECT_EQ(inp("# comment\nTime step size: 1e-4  # [s]\nAdd mesh: msh {\n  Domain: 0\n}"),
            "(GeneralSimulationParameters(Time_step_size=1e-4) Add_mesh[msh](Domain=0))");
  EXPECT_EQ(inp("Add equation: fluid {Viscosity: Constant {Value: 0.04}\nLS type: NS\n{\nNS-GM tolerance: 1D-3}}"),
            "(GeneralSimulationParameters Add_equation[fluid](Viscosity[Constant](Value=0.04) "
            "LS[NS](NS_GM_tolerance=1D-3)))");
  EXPECT_EQ(inp("Add equation: struct {Constitutive model: nHK\nPower-law index (n): 1\nAdd BC:a {Value: {1, 2, 3}}}"),
            "(GeneralSimulationParameters Add_equation[struct](Constitutive_model[nHK] Power_law_index=1 "
            "Add_BC[a](Value=1, 2, 3)))");
}

TEST(ReadInp, GathersWindkessels) {
  EXPECT_EQ(inp("Add equation: fluid {Add BC: out {RCR values: (121.0, 1.5D-5, 1212.0)\nDistal pressure: 1.0}}"),
            "(GeneralSimulationParameters Add_equation[fluid](Add_BC[out](RCR_values(Proximal_resistance=121.0 "
            "Capacitance=1.5D-5 Distal_resistance=1212.0 Distal_pressure=1.0))))");
  EXPECT_EQ(inp("Add equation: fluid {Add BC: out {RCR values: \"1, 2, 3\"}}"),
            "(GeneralSimulationParameters Add_equation[fluid](Add_BC[out](RCR_values(Proximal_resistance=1 "
            "Capacitance=2 Distal_resistance=3))))");
}

TEST(ReadInp, RefusesWhatIsNotClosed) {
  const auto wrong = [](const std::string& text) {
    return message_of<InputError>([&] { read_inp(text, "svFSI.inp"); });
  };
  EXPECT_NE(wrong("Add mesh: a {\nDomain: 1\n").find("opened in line 1"), std::string::npos);
  EXPECT_NE(wrong("Verbose: 1\n}").find("svFSI.inp:2"), std::string::npos);
  EXPECT_NE(wrong("Verbose 1\n").find("no colon"), std::string::npos);
  EXPECT_NE(wrong(": 1\n").find("no key"), std::string::npos);
}

TEST(ReadPeerFile, WantsOneFileInAFolder) {
  const TemporaryFolder folder;
  EXPECT_THROW(read_peer_file(folder.path()), InputError);
  std::ofstream(folder.path() / "a.inp") << "Verbose: 1\n";
  EXPECT_EQ(read_peer_file(folder.path()).dialect, Dialect::inp);
  std::ofstream(folder.path() / "b.inp") << "Verbose: 1\n";
  EXPECT_NE(message_of<InputError>([&] { read_peer_file(folder.path()); }).find("a.inp, b.inp"), std::string::npos);
  EXPECT_THROW(read_peer_file(folder.path() / "none.xml"), InputError);
}

std::vector<Problem> problems_of(PeerFile file) {
  std::vector<Problem> problems;
  check_vocabulary(file, problems);
  return problems;
}

TEST(Vocabulary, KnowsKeysByTheirPlace) {
  const auto wrong = [](const std::string& text) {
    std::string all;
    for (const auto& p : problems_of(read_xml("<svMultiPhysicsFile>" + text + "</svMultiPhysicsFile>", "s.xml")))
      all += format(p) + "\n";
    return all;
  };
  EXPECT_EQ(wrong("<Add_mesh name=\"a\"><Domain>1</Domain></Add_mesh>"), "");
  EXPECT_NE(wrong("<Add_mesh name=\"a\"><Domian>1</Domian></Add_mesh>").find("did you mean Domain"), std::string::npos);
  EXPECT_NE(wrong("<Add_mesh name=\"a\"><Density>1</Density></Add_mesh>").find("no key of Add_mesh"),
            std::string::npos);
  EXPECT_NE(wrong("<Add_mesh name=\"a\"><Domain>1</Domain><Domain>2</Domain></Add_mesh>")
                .find("stands in line 1 of Add_mesh, too"),
            std::string::npos);
  EXPECT_EQ(wrong("<Add_mesh name=\"a\"><Domain>1</Domain><Domain>1</Domain></Add_mesh>"), "");
  EXPECT_NE(wrong("<Add_mesh name=\"a\"><Domain>1.5</Domain></Add_mesh>").find("whole number"), std::string::npos);
  EXPECT_NE(wrong("<Add_equation type=\"fluid\"><Force_z>981</Force_z></Add_equation>").find("gravity"),
            std::string::npos);
  EXPECT_EQ(wrong("<Add_equation type=\"fluid\"><Force_z>0.0</Force_z></Add_equation>"), "");
  EXPECT_NE(wrong("<Add_equation type=\"fluid\"><Tolerance>1D-3</Tolerance></Add_equation>").find("is read as 1 "),
            std::string::npos);
}

TEST(Vocabulary, HoldsValuesAgainstTheirKinds) {
  const auto wrong = [](const std::string& section, const std::string& text) {
    std::string all;
    for (const auto& p : problems_of(read_xml(
             "<svMultiPhysicsFile><Add_equation type=\"fluid\">" + section + text + "</svMultiPhysicsFile>", "s.xml")))
      all += format(p) + "\n";
    return all;
  };
  const auto direction = [&](const std::string& value) {
    return wrong("<Add_BC name=\"in\"><Effective_direction>" + value + "</Effective_direction></Add_BC>",
                 "</Add_equation>");
  };
  EXPECT_EQ(direction("(0, 0, 1)"), "");
  EXPECT_EQ(direction("0 -1 0"), "");
  EXPECT_NE(direction("(0, 0, 0.5)").find("`0.5` is no whole number"), std::string::npos) << direction("(0, 0, 0.5)");
  EXPECT_NE(direction("(0, 1)").find("has 2 components"), std::string::npos) << direction("(0, 1)");
  EXPECT_NE(direction("(0, 0, 1, 0)").find("has 4 components"), std::string::npos);
  const auto key = [&](const std::string& text) { return wrong(text, "</Add_equation>"); };
  EXPECT_NE(key("<Tolerance>-1</Tolerance>").find("`-1` is below 0"), std::string::npos);
  EXPECT_NE(key("<Max_iterations>-5</Max_iterations>").find("`-5` is below 0"), std::string::npos);
  EXPECT_NE(key("<LS type=\"NS\"><Tolerance>-1</Tolerance></LS>").find("`-1` is below 0"), std::string::npos);
  EXPECT_NE(key("<Output type=\"Spatial\"><WSS>yes</WSS></Output>").find("neither true nor false"), std::string::npos);
  EXPECT_EQ(key("<Output type=\"Spatial\"><WSS>true</WSS></Output>"), "");
  EXPECT_EQ(key("<Output type=\"Alias\"><Displacement>FS_Displacement</Displacement></Output>"), "");
}

TEST(Vocabulary, IsBlindToCaseInInpFiles) {
  EXPECT_TRUE(problems_of(read_inp("verbose: t\nAdd equation: fluid {force_x: 0}", "s.inp")).empty());
}

}  // namespace

}  // namespace tunica::peer_cases
