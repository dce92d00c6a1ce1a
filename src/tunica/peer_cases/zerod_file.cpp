#include "tunica/peer_cases/zerod_file.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "tunica/base/error.hpp"
#include "tunica/base/text.hpp"

namespace tunica::peer_cases {

namespace {

using nlohmann::json;

class Reader {
 public:
  explicit Reader(const std::filesystem::path& file) : where_(file.string()) {
    const std::string content = text::read(file);
    content_ = json::parse(content, nullptr, false);
    if (content_.is_discarded() || !content_.is_object()) refuse("is no JSON object", "restore the file");
  }

  [[noreturn]] void refuse(const std::string& what, const std::string& remedy) const {
    throw InputError(where_, what, remedy);
  }

  /// The object in a list whose `key` is `name`.
  const json& find(const char* list, const char* key, const std::string& name) const {
    const auto at = content_.find(list);
    if (at != content_.end() && at->is_array())
      for (const json& item : *at)
        if (item.is_object() && text_of(item, key) == name) return item;
    refuse(fmt::format("has no {} of the name `{}` under {}", key, text::printable(name), list), "correct the name");
  }

  static std::string text_of(const json& object, const char* key) {
    const auto at = object.find(key);
    return at != object.end() && at->is_string() ? at->get<std::string>() : std::string();
  }

  double number(const json& values, const char* key, bool required) const {
    const auto at = values.find(key);
    if (at != values.end() && at->is_number()) return at->get<double>();
    if (required || at != values.end()) refuse(fmt::format("has no number {}", key), "write it under bc_values");
    return 0.0;
  }

 private:
  std::string where_;
  json content_;
};

}  // namespace

ZeroDOutlet read_zerod_outlet(const std::filesystem::path& file, const std::string& block) {
  const Reader reader(file);
  const json& coupling = reader.find("external_solver_coupling_blocks", "name", block);
  const std::string connected = Reader::text_of(coupling, "connected_block");
  const json& condition = reader.find("boundary_conditions", "bc_name", connected);
  const std::string type = Reader::text_of(condition, "bc_type");
  const auto values = condition.find("bc_values");
  if (values == condition.end() || !values->is_object())
    reader.refuse(fmt::format("{} has no bc_values", connected), "write them");
  ZeroDOutlet outlet{.name = connected};
  if (type == "RCR") {
    outlet.rcr = true;
    outlet.proximal = reader.number(*values, "Rp", true);
    outlet.capacitance = reader.number(*values, "C", true);
    outlet.distal = reader.number(*values, "Rd", true);
  } else if (type == "RESISTANCE") {
    outlet.proximal = reader.number(*values, "R", true);
  } else {
    reader.refuse(fmt::format("{} is of the type `{}`; tunica has RCR and RESISTANCE at an outlet", connected,
                              text::printable(type)),
                  "use one of these");
  }
  outlet.distal_pressure = reader.number(*values, "Pd", false);
  return outlet;
}

}  // namespace tunica::peer_cases
