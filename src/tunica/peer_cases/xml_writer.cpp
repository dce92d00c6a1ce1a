#include "tunica/peer_cases/xml_writer.hpp"

#include <fmt/format.h>

#include <utility>

namespace tunica::peer_cases {

namespace {

/// Name of the attribute that holds the label of a section.
const char* attribute_of(const std::string& key) {
  constexpr std::pair<const char*, const char*> attributes[] = {
      {"Add_equation", "type"}, {"Constitutive_model", "type"}, {"LS", "type"},   {"Linear_algebra", "type"},
      {"Output", "type"},       {"Viscosity", "model"},         {"Domain", "id"}, {"svMultiPhysicsFile", "version"}};
  for (const auto& [section, attribute] : attributes)
    if (key == section) return attribute;
  return "name";
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  return result;
}

void write(const Entry& entry, int depth, std::string& text) {
  const std::string indent(static_cast<std::size_t>(2 * depth), ' ');
  if (!entry.section) {
    text += fmt::format("{}<{}> {} </{}>\n", indent, entry.key, escaped(entry.value), entry.key);
    return;
  }
  const std::string label =
      entry.label.empty() ? "" : fmt::format(" {}=\"{}\"", attribute_of(entry.key), escaped(entry.label));
  text += fmt::format("{}<{}{}>\n", indent, entry.key, label);
  for (const Entry& below : entry.entries) write(below, depth + 1, text);
  text += fmt::format("{}</{}>\n", indent, entry.key);
}

}  // namespace

void add_key(Entry& section, std::string key, std::string value) {
  section.entries.push_back({.key = std::move(key), .label = {}, .value = std::move(value)});
}

Entry& add_section(Entry& section, std::string key, std::string label) {
  section.entries.push_back({.key = std::move(key), .label = std::move(label), .value = {}, .section = true});
  return section.entries.back();
}

std::string xml_text(const Entry& root) {
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\" ?>\n";
  write(root, 0, text);
  return text;
}

}  // namespace tunica::peer_cases
