#include "tunica/config/document.hpp"

#include <gtest/gtest.h>

#include <map>
#include <variant>

#include "text.hpp"
#include "tunica/base/error.hpp"

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

const std::string sheet_text =
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
  const auto found = settings(sheet_text);
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
  Document whole(sheet_text);
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
  Document document(sheet_text + "output: /tmp/there\n");
  move_paths(document, *Sheet::schema().description(), "cases", "cases/results/run");
  EXPECT_EQ(document.text("table"), "../../data/curve.csv");
  EXPECT_EQ(document.text("output"), "/tmp/there");
}

TEST(Document, TheCommentedTextSaysTheSame) {
  const std::string again = commented_yaml(Document(sheet_text), *Sheet::schema().description());
  EXPECT_NE(again.find("thickness: 2 mm  # Across it\n"), std::string::npos) << again;
  EXPECT_EQ(settings(again), settings(sheet_text)) << again;
}

// --- texts that no tree can or should be built of -------------------------------------------------------------------

std::string refusal(const std::string& yaml) {
  return test::message_of<InputError>([&] { Document document(yaml, "a.yaml"); });
}

void expect_refused(const std::string& yaml, const std::string& where, const std::string& why) {
  const std::string message = refusal(yaml);
  EXPECT_NE(message.find(where), std::string::npos) << message.substr(0, 500);
  EXPECT_NE(message.find(why), std::string::npos) << message.substr(0, 500);
  EXPECT_LT(message.size(), 1000u) << message.substr(0, 500);
}

TEST(Document, RefusesWhatContainsItself) {
  const std::string why = "which would contain itself";
  expect_refused("&a [*a]", "a.yaml:1:5", why);
  expect_refused("title: &a [*a]", "a.yaml:1:12", why);
  expect_refused("wall: &w\n  material: {law: *w}\n", "a.yaml:2:19", why);
  expect_refused("wall: &w\n  <<: *w\n  density: 1\n", "a.yaml:2:7", why);
  expect_refused("a: &a {b: &b [1, {c: *a}]}\nd: *b\n", "a.yaml:1:22", why);
  expect_refused("a: &a {? *a : 1}", "a.yaml:1:10", why);
  // The inner alias means the newer anchor of its name.
  expect_refused("a: &x {b: 1}\nc: &x {d: *x}\n", "a.yaml:2:11", why);
  EXPECT_EQ(Document("a: &x {b: 1 m}\nc: *x\nd: [*x, *x]\n").text("c.b"), "1 m");
}

TEST(Document, RefusesAliasesThatMultiply) {
  std::string bomb = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 10; ++i) {
    bomb += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [";
    for (int k = 0; k < 10; ++k) bomb += (k > 0 ? ", *a" : "*a") + std::to_string(i - 1);
    bomb += "]\n";
  }
  expect_refused(bomb, "a.yaml:5:", "more than 100000 values");
}

TEST(Document, RefusesWhatIsNestedWithoutEnd) {
  for (const std::string& level : {std::string("["), std::string("{a: "), std::string("- "), std::string("? ")}) {
    std::string nested;
    for (int i = 0; i < 100000; ++i) nested += level;
    EXPECT_NE(refusal(nested), "") << level;
    EXPECT_LT(refusal(nested).size(), 1000u) << level;
  }
  std::string allowed(40, '[');
  EXPECT_EQ(refusal(allowed + std::string(40, ']')), "");
}

TEST(Document, RefusesWhatIsNoText) {
  expect_refused(std::string("title: a\nb: \0x", 14), "a.yaml:2", "zero byte");
  expect_refused(std::string(900, 'k') + ": 1", "a.yaml:1:1", "a key of 900 bytes");
  expect_refused(std::string(20 << 20, ' '), "a.yaml", "at most 16777216 are read");
  EXPECT_EQ(refusal(""), "");
}

TEST(Document, NothingIsSetBelowAValue) {
  Document document("time: {step: 1 ms}\nlist: [1, 2]\n");
  const auto why = [&](const char* path) { return test::message_of<InputError>([&] { document.set(path, "1"); }); };
  EXPECT_NE(why("time.step.unit").find("`unit` can be no key of a value"), std::string::npos);
  EXPECT_NE(why("list.0").find("`0` can be no key of a list"), std::string::npos);
}

TEST(Document, EntriesOfListsHaveNumbers) {
  Document document("families: [{k1: 1 kPa, k2: 5}, {k1: 2 kPa}]\nnested: [[1, 2], [3]]\n");
  EXPECT_EQ(document.text("families[2].k1"), "2 kPa");
  EXPECT_EQ(document.text("nested[1]"), "");
  EXPECT_TRUE(document.has("families[1].k2") && !document.has("families[2].k2") && !document.has("families[0].k1"));
  EXPECT_FALSE(document.has("families[3]") || document.has("families[x]") || document.has("families[]"));
  const Document before = document;
  document.set("families[2].k1", "3 kPa");
  document.set("families[2].k2", "7");
  EXPECT_EQ(document.text("families[2].k1") + document.text("families[2].k2"), "3 kPa7");
  EXPECT_EQ(document.text("families[1].k1") + before.text("families[2].k1"), "1 kPa2 kPa");
  const auto why = test::message_of<InputError>([&] { document.set("families[3].k1", "1"); });
  EXPECT_NE(why.find("its entries are [1] to [2]"), std::string::npos) << why;
}

TEST(Document, RefusesNamesThatNoFileCanHave) {
  const auto why = [](const std::string& output) {
    return test::message_of<InputError>([&] {
      parse_text(Sheet::schema(), "thickness: 2 mm\ntable: a\nplace: [1 m]\noutput: " + output + "\n",
                 {.check_files = false});
    });
  };
  EXPECT_NE(why(std::string(300, 'd')).find("output (case.yaml:4): a file or folder name of 300 bytes"),
            std::string::npos)
      << why(std::string(300, 'd'));
  EXPECT_NE(why("out/" + std::string(300, 'd') + "/x").find("name of 300 bytes"), std::string::npos);
  std::string deep = "d";
  for (int i = 0; i < 2000; ++i) deep += "/d";
  EXPECT_NE(why(deep).find("at most 3800 are possible"), std::string::npos) << why(deep);
  EXPECT_LT(why(std::string(100000, 'd')).size(), 1000u);
  EXPECT_NE(why("\"a\\x07b\"").find("control characters"), std::string::npos) << why("\"a\\x07b\"");
  EXPECT_NE(why("\"a\\0b\"").find("control characters"), std::string::npos) << why("\"a\\0b\"");
  EXPECT_EQ(why(std::string(255, 'd')), "");
}

}  // namespace
}  // namespace tunica::config
