#include "tunica/peer_cases/xml_writer.hpp"

#include <gtest/gtest.h>

namespace tunica::peer_cases {

namespace {

void expect_same(const Entry& a, const Entry& b) {
  EXPECT_EQ(a.key, b.key);
  EXPECT_EQ(a.label, b.label);
  EXPECT_EQ(a.value, b.value);
  EXPECT_EQ(a.section, b.section);
  ASSERT_EQ(a.entries.size(), b.entries.size()) << a.key;
  for (std::size_t k = 0; k < a.entries.size(); ++k) expect_same(a.entries[k], b.entries[k]);
}

TEST(XmlWriter, WritesWhatTheReaderReads) {
  Entry root{.key = "svMultiPhysicsFile", .label = "0.1", .value = {}, .section = true};
  Entry& equation = add_section(root, "Add_equation", "fluid");
  add_key(equation, "Density", "1.06");
  add_key(add_section(equation, "Viscosity", "Constant"), "Value", "0.04");
  add_key(add_section(equation, "Domain", "3"), "Equation", "struct");
  Entry& condition = add_section(equation, "Add_BC", "in \"a\" & <b>");
  add_key(condition, "Temporal_values_file_path", "a&b<c>.flow");
  const std::string text = xml_text(root);
  EXPECT_NE(text.find("<Domain id=\"3\">"), std::string::npos) << text;
  EXPECT_NE(text.find("<Viscosity model=\"Constant\">"), std::string::npos);
  expect_same(read_xml(text, "solver.xml").root, root);
}

}  // namespace

}  // namespace tunica::peer_cases
