#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tunica/config/schema.hpp"

namespace tunica::config {
namespace {

struct Ring {
  double width = 2e-3;
  static Schema<Ring> schema() {
    return Schema<Ring>("ring", "A ring.")
        .quantity("width", &Ring::width, dimension::length, above(0), "Width")
        .by_default()
        .plausible("1 mm", "5 mm")
        .shorthand("width");
  }
};
struct Knot {
  static Schema<Knot> schema() { return {"knot", "A knot."}; }
};
using End = std::variant<Ring, Knot>;
struct Rope {
  double share = 0.0;
  int strands = 3;
  End end;
  std::optional<Ring> middle;
  static Schema<Rope> schema() {
    return Schema<Rope>("rope", "A rope.")
        .number("share", &Rope::share, from_to_below(0, 1), "Share")
        .integer("strands", &Rope::strands, at_least(1), "Strands")
        .by_default()
        .section("middle", &Rope::middle, Ring::schema(), "Ring in the middle")
        .include(&Rope::end,
                 Schema<End>("end", "An end.").one_of().alternative(Ring::schema()).alternative(Knot::schema()));
  }
};

TEST(Reference, ListsEveryKeyWithUnitRangeAndDefault) {
  const std::string text = markdown(*Rope::schema().description());
  for (const char* line : {
           "| `share` | number | >= 0 and < 1 | **required** | Share |",
           "| `strands` | whole number | >= 1 | `3` | Strands |",
           "| `middle` | section |  | none | Ring in the middle |",
           "| `width` | length [m] | > 0 m; usually 1 mm to 5 mm | `0.002 m` | Width |",
           "Exactly one of these keys (end):",
           "A plain value in place of this section stands for `width`.",
           "## `ring`\n\nA ring.\n\nKeys as in `middle`.",
           "## `knot`\n\nA knot.\n\nNo keys.",
       })
    EXPECT_NE(text.find(line), std::string::npos) << line << "\nnot in\n" << text;
}

TEST(Reference, JsonSchemaSaysWhatTheParserAccepts) {
  const auto schema = nlohmann::json::parse(json_schema(*Rope::schema().description()));
  EXPECT_EQ(schema["properties"]["share"]["minimum"], 0.0);
  EXPECT_EQ(schema["properties"]["share"]["exclusiveMaximum"], 1.0);
  EXPECT_EQ(schema["properties"]["strands"]["type"], "integer");
  EXPECT_EQ(schema["properties"]["strands"]["default"], "3");
  EXPECT_EQ(schema["required"], nlohmann::json({"share"}));
  EXPECT_EQ(schema["additionalProperties"], false);
  EXPECT_EQ(schema["allOf"][0]["oneOf"].size(), 2u);
  const auto& ring = schema["properties"]["middle"]["anyOf"];
  EXPECT_EQ(ring[0]["properties"]["width"]["type"], "string");
  EXPECT_EQ(ring[1]["type"], "string");
}

}  // namespace
}  // namespace tunica::config
