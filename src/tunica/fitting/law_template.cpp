#include "tunica/fitting/law_template.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "tunica/base/error.hpp"

namespace tunica::fitting {

namespace dimension = config::dimension;

double Parameter::scaled(double value) const {
  if (logarithmic()) return std::log(value / low) / std::log(high / low);
  return (value - low) / (high - low);
}

double Parameter::value(double scaled) const {
  const double x = std::clamp(scaled, 0.0, 1.0);
  if (logarithmic()) return low * std::exp(x * std::log(high / low));
  return low + x * (high - low);
}

std::string Parameter::unit() const {
  if (dimension == dimension::pressure) return "kPa";
  if (dimension == dimension::angle) return "deg";
  return "";
}

double Parameter::per_unit() const {
  if (dimension == dimension::pressure) return 1e3;
  if (dimension == dimension::angle) return std::numbers::pi / 180.0;
  return 1.0;
}

std::string Parameter::text(double value, int digits) const {
  return fmt::format("{:.{}g}{}{}", value / per_unit(), digits, unit().empty() ? "" : " ", unit());
}

struct LawTemplate::Slot {
  YAML::Node node;  ///< shares its value with the document
  std::size_t parameter;
  double sign;
};

namespace {

/// "$k1" and "-$k1": the name and the sign.
std::optional<std::pair<std::string, double>> reference(const std::string& text) {
  if (text.starts_with("$")) return {{text.substr(1), 1.0}};
  if (text.starts_with("-$")) return {{text.substr(2), -1.0}};
  return std::nullopt;
}

template <class Visit>
void visit_scalars(const YAML::Node& node, const std::string& key, const Visit& visit) {
  if (node.IsScalar()) return visit(node, key);
  if (node.IsSequence())
    for (std::size_t i = 0; i < node.size(); ++i) visit_scalars(node[i], fmt::format("{}[{}]", key, i + 1), visit);
  if (node.IsMap())
    for (const auto& pair : node)
      visit_scalars(pair.second, (key.empty() ? "" : key + ".") + pair.first.Scalar(), visit);
}

}  // namespace

LawTemplate::LawTemplate(const config::Document& material, std::vector<Parameter> parameters, const std::string& where)
    : document_(material),
      parameters_(std::move(parameters)),
      keys_(parameters_.size()),
      where_(where),
      schema_(wall::law_schema()) {
  find_slots();
}

LawTemplate::LawTemplate(const LawTemplate& other)
    : document_(other.document_),
      parameters_(other.parameters_),
      keys_(other.keys_),
      where_(other.where_),
      schema_(other.schema_) {
  // The places are the same; their values are those of the copy.
  std::map<std::string, std::shared_ptr<Slot>> known;
  visit_scalars(other.document_.node(), "", [&](const YAML::Node& node, const std::string& key) {
    for (const auto& slot : other.slots_)
      if (slot->node.is(node)) known[key] = slot;
  });
  visit_scalars(document_.node(), "", [&](const YAML::Node& node, const std::string& key) {
    if (const auto at = known.find(key); at != known.end())
      slots_.push_back(std::make_shared<Slot>(Slot{node, at->second->parameter, at->second->sign}));
  });
}

void LawTemplate::find_slots() {
  std::vector<Problem> problems;
  std::string names;
  for (const Parameter& p : parameters_) names += (names.empty() ? "" : ", ") + p.name;
  visit_scalars(document_.node(), "", [&](const YAML::Node& node, const std::string& key) {
    const auto named = reference(node.Scalar());
    if (!named) return;
    const auto at = std::find_if(parameters_.begin(), parameters_.end(),
                                 [&](const Parameter& p) { return p.name == named->first; });
    if (at == parameters_.end()) {
      problems.push_back(
          {where_ + ".material." + key, fmt::format("`${}` is no parameter", named->first),
           names.empty() ? "add it to `parameters`" : "add it to `parameters`, or use one of: " + names});
      return;
    }
    const std::size_t parameter = static_cast<std::size_t>(at - parameters_.begin());
    slots_.push_back(std::make_shared<Slot>(Slot{node, parameter, named->second}));
    if (keys_[parameter].empty()) keys_[parameter] = key;
  });
  for (std::size_t i = 0; i < parameters_.size(); ++i)
    if (keys_[i].empty())
      problems.push_back(
          {where_ + ".parameters." + parameters_[i].name, "stands nowhere in the material",
           fmt::format("write `${}` in place of the value that is to be found, or remove it", parameters_[i].name)});
  if (!problems.empty()) throw InputError(std::move(problems));
}

void LawTemplate::fill(std::span<const double> values, bool usual_units) const {
  for (const auto& slot : slots_) {
    const Parameter& p = parameters_[slot->parameter];
    const double value = slot->sign * values[slot->parameter];
    slot->node = usual_units ? p.text(value, 7) : config::in_si(value, p.dimension);
  }
}

wall::LawParameters LawTemplate::at(std::span<const double> values) const {
  fill(values, false);
  return config::parse_document(schema_, document_, {.name = where_}).value;
}

config::Document LawTemplate::started() const {
  std::vector<double> starts;
  for (const Parameter& p : parameters_) starts.push_back(p.start);
  fill(starts, false);
  return document_;
}

std::string LawTemplate::yaml(std::span<const double> values) const {
  fill(values, true);
  YAML::Node root;
  root["material"] = YAML::Clone(document_.node());
  YAML::Emitter out;
  out << root;
  return std::string(out.c_str()) + "\n";
}

}  // namespace tunica::fitting
