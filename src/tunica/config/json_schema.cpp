// The case file as a JSON Schema, for editors.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "tunica/config/description.hpp"

namespace tunica::config {
namespace {

using Json = nlohmann::ordered_json;

Json object_of(const Description& d);

// A unit begins with no digit, exponent or sign, so that a bare number does not match.
constexpr const char* number_with_unit = "^\\s*[-+]?[0-9.]+([eE][-+]?[0-9]+)?\\s*(1?/\\s*)?[^0-9eE.\\s+/-]";

Json quantity(const Field& f) {
  if (f.dimension != dimension::none)
    return {{"type", "string"}, {"pattern", number_with_unit}, {"examples", {in_si(1.0, f.dimension)}}};
  Json number = {{"type", "number"}};
  if (f.allowed.low > -std::numeric_limits<double>::infinity())
    number[f.allowed.low_open ? "exclusiveMinimum" : "minimum"] = f.allowed.low;
  if (f.allowed.high < std::numeric_limits<double>::infinity())
    number[f.allowed.high_open ? "exclusiveMaximum" : "maximum"] = f.allowed.high;
  return number;
}

Json list_of(const Json& item, std::size_t count) {
  Json list = {{"type", "array"}, {"items", item}};
  if (count) list["minItems"] = list["maxItems"] = count;
  return list;
}

Json json_value_of(const Field& f) {
  switch (f.kind) {
    case Kind::quantity:
      return quantity(f);
    case Kind::quantities:
      return {{"anyOf", {list_of(quantity(f), f.count), Json{{"type", "string"}, {"pattern", "^\\["}}}}};
    case Kind::integer: {
      Json number = quantity(f);
      number["type"] = "integer";
      return number;
    }
    case Kind::flag:
      return {{"type", "boolean"}};
    case Kind::choice:
      return {{"type", "string"}, {"enum", f.names}};
    case Kind::texts:
      return {{"anyOf", {Json{{"type", "string"}}, list_of({{"type", "string"}}, 0)}}};
    case Kind::any_of: {
      const Json name = {{"type", "string"}, {"enum", f.names}};
      return {{"anyOf", {name, list_of(name, 0)}}};
    }
    case Kind::section:
      return object_of(*f.nested);
    case Kind::map:
      return {{"type", "object"}, {"additionalProperties", object_of(*f.nested)}};
    case Kind::list:
      return list_of(object_of(*f.nested), 0);
    default:
      return {{"type", "string"}};
  }
}

std::string described(const Field& f) {
  std::string text = f.help;
  if (f.dimension != dimension::none) text += fmt::format(" [{}: {}]", name_of(f.dimension), usual_units(f.dimension));
  if (f.allowed.bounded() && f.kind != Kind::unit && f.kind != Kind::integer)
    text += fmt::format(" ({})", f.allowed.text(f.dimension));
  return text;
}

void add_level(const Description& d, Json& object, Json& rules) {
  Json alternatives = Json::array();
  for (const Field& f : d.fields) {
    Json value = json_value_of(f);
    value["description"] = described(f);
    if (f.default_text) value["default"] = *f.default_text;
    object["properties"][f.key] = std::move(value);
    if (d.one_of)
      alternatives.push_back({{"required", {f.key}}});
    else if (f.required)
      object["required"].push_back(f.key);
  }
  if (d.one_of) rules.push_back({{"oneOf", std::move(alternatives)}});
  for (const Include& include : d.includes) add_level(*include.nested, object, rules);
}

bool needs_keys(const Description& d) {
  if (d.one_of) return true;
  for (const Field& f : d.fields)
    if (f.required) return true;
  for (const Include& i : d.includes)
    if (needs_keys(*i.nested)) return true;
  return false;
}

const Field* find(const Description& d, const std::string& key) {
  for (const Field& f : d.fields)
    if (f.key == key) return &f;
  for (const Include& i : d.includes)
    if (const Field* f = find(*i.nested, key)) return f;
  return nullptr;
}

Json object_of(const Description& d) {
  Json object = {{"type", needs_keys(d) ? Json("object") : Json({"object", "null"})}}, rules = Json::array();
  object["properties"] = Json::object();
  add_level(d, object, rules);
  object["additionalProperties"] = false;
  if (!rules.empty()) object["allOf"] = std::move(rules);

  Json forms = Json::array({object});
  if (const Field* plain = find(d, d.shorthand)) forms.push_back(json_value_of(*plain));
  if (d.one_of) {
    std::vector<std::string> bare;
    for (const Field& f : d.fields)
      if (f.kind == Kind::section && !needs_keys(*f.nested)) bare.push_back(f.key);
    if (!bare.empty()) forms.push_back({{"enum", bare}});
  }
  if (forms.size() == 1) return object;
  return {{"anyOf", std::move(forms)}};
}

}  // namespace

std::string json_schema(const Description& description) {
  Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                 {"title", description.name},
                 {"description", description.help}};
  schema.update(object_of(description));
  return schema.dump(2) + "\n";
}

}  // namespace tunica::config
