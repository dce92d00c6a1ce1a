#include "tunica/config/document.hpp"

#include <gtest/gtest.h>

#include <map>
#include <variant>

namespace tunica::config {
namespace {

struct Open {};
struct Rim {
  double width = 0;  // m
};
using Edge = std::variant<Open, Rim>;
struct Sheet {
  double thickness = 0, density = 30;
  std::filesystem::path table, output;
  std::map<std::string, Edge> edges;
  std::vector<double> place;

  static Schema<Sheet> schema() {
    return Schema<Sheet>("sheet", "A sheet.")
        .quantity("thickness", &Sheet::thickness, dimension::length, above(0), "Across it. At rest")
        .quantity("density", &Sheet::density, dimension::density, above(0), "Mass per volume")
        .by_default()
        .file("table", &Sheet::table, "Measured")
        .path("output", &Sheet::output, "Results")
        .by_default("results")
        .map("edges", &Sheet::edges,
             Schema<Edge>("edge", "An edge.")
                 .one_of()
                 .alternative(Schema<Open>("open", "Nothing there."))
                 .alternative(
                     Schema<Rim>("rim", "A rim.").quantity("width", &Rim::width, dimension::length, above(0), "Wide")),
             "By name")
        .by_default()
        .quantities("place", &Sheet::place, dimension::length, anything(), "x, y, z");
  }
};

const std::string text =
    "thickness: 2 mm\ntable: data/curve.csv\nedges: {left: open, right: {rim: {width: 1 cm}}}\n"
    "place: \"[1, 0, 2.5] mm\"\n";

std::map<std::string, std::string> settings(const std::string& yaml) {
  std::vector<Setting> found;
  parse_document(Sheet::schema(), Document(yaml), {.check_files = false}, &found);
  std::map<std::string, std::string> by_path;
  for (const auto& s : found) by_path[s.path] = s.value;
  return by_path;
}

TEST(Document, SettingsDoNotDependOnSpelling) {
  const auto found = settings(text);
  EXPECT_EQ(found.at("thickness"), "0.002");
  EXPECT_EQ(found.at("density"), "30");
  EXPECT_EQ(found.at("edges.left"), "open");
  EXPECT_EQ(found.at("edges.right"), "rim");
  EXPECT_EQ(found.at("edges.right.rim.width"), "0.01");
  EXPECT_EQ(found.at("place"), "0.001, 0, 0.0025");
  EXPECT_EQ(found, settings("place: [1 mm, 0 cm, 2.5 mm]\ndensity: 30 kg/m^3\nthickness: 0.2 cm   # as before\n"
                            "table: data/curve.csv\nedges:\n  right: {rim: {width: 10 mm}}\n  left: {open: {}}\n"));
  EXPECT_NE(found, settings("place: [1 mm, 0 cm, 2.5 mm]\nthickness: 0.2 cm\ntable: data/curve.csv\n"
                            "edges: {left: open, right: open}\n"));
}

TEST(Document, PartsMoveAndCopiesShareNothing) {
  Document whole(text);
  Document copy = whole;
  copy.set("edges.top", "open");
  copy.set("extra.deep.key", "1 mm");
  copy.remove("edges.left");
  copy.remove("nowhere.at.all");
  EXPECT_TRUE(copy.has("edges.top") && copy.has("extra.deep.key") && !copy.has("edges.left"));
  EXPECT_TRUE(!whole.has("edges.top") && !whole.has("extra") && whole.has("edges.left"));
  EXPECT_EQ(copy.part("edges").text("top"), "open");
  EXPECT_EQ(copy.part("edges.right.rim").text("width"), "1 cm");
  EXPECT_EQ(copy.text("edges"), "");
}

TEST(Document, PathsCountFromTheNewFolder) {
  Document document(text + "output: /tmp/there\n");
  move_paths(document, *Sheet::schema().description(), "cases", "cases/results/run");
  EXPECT_EQ(document.text("table"), "../../data/curve.csv");
  EXPECT_EQ(document.text("output"), "/tmp/there");
}

TEST(Document, TheCommentedTextSaysTheSame) {
  const std::string again = commented_yaml(Document(text), *Sheet::schema().description());
  EXPECT_NE(again.find("thickness: 2 mm  # Across it\n"), std::string::npos) << again;
  EXPECT_EQ(settings(again), settings(text)) << again;
}

}  // namespace
}  // namespace tunica::config
