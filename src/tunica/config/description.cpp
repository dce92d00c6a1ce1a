#include "tunica/config/description.hpp"

#include <fmt/format.h>

#include <fstream>
#include <set>
#include <sstream>

#include "tunica/config/schema.hpp"

namespace tunica::config {

bool Range::contains(double value) const {
  return (low_open ? value > low : value >= low) && (high_open ? value < high : value <= high);
}

bool Range::bounded() const {
  return low > -std::numeric_limits<double>::infinity() || high < std::numeric_limits<double>::infinity();
}

std::string Range::text(const Dimension& dimension) const {
  const bool from = low > -std::numeric_limits<double>::infinity(), to = high < std::numeric_limits<double>::infinity();
  const std::string lower = fmt::format("{} {}", low_open ? ">" : ">=", in_si(low, dimension));
  const std::string upper = fmt::format("{} {}", high_open ? "<" : "<=", in_si(high, dimension));
  if (from && to) return fmt::format("{} and {}", lower, upper);
  return from ? lower : to ? upper : "any";
}

std::string read_text(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  std::error_code ignored;  // not there, not readable and too long a name come to the same
  if (!std::filesystem::is_regular_file(file, ignored) || !(text << stream.rdbuf()))
    throw InputError(file.string(), "file does not exist, is empty or cannot be read",
                     "check its name and permissions");
  return text.str();
}

namespace detail {

std::string yaml_of(const std::vector<double>& values, const Dimension& dimension) {
  std::string text;
  for (double value : values) text += (text.empty() ? "[" : ", ") + in_si(value, dimension);
  return text + "]";
}

}  // namespace detail

namespace {

void audit(const Description& d, const std::string& path, std::vector<std::string>& slips, std::set<std::string>& keys);

void audit_field(const Description& d, const Field& f, const std::string& path, std::vector<std::string>& slips,
                 std::set<std::string>& keys) {
  const std::string where = path + "." + f.key;
  if (f.help.empty()) slips.push_back(where + ": no help text");
  if (!keys.insert(f.key).second) slips.push_back(where + ": declared twice");
  if (d.one_of && f.default_text) slips.push_back(where + ": an alternative cannot have a default");
  if (f.nested) {
    std::set<std::string> own;
    audit(*f.nested, where, slips, own);
  }
}

void audit(const Description& d, const std::string& path, std::vector<std::string>& slips,
           std::set<std::string>& keys) {
  if (d.help.empty()) slips.push_back(path + ": no help text");
  for (const Field& f : d.fields) audit_field(d, f, path, slips, keys);
  for (const Include& i : d.includes) audit(*i.nested, path, slips, keys);
  if (!d.shorthand.empty() && !keys.contains(d.shorthand)) slips.push_back(path + ": shorthand for an unknown key");
}

/// The same keys, with nothing stored anywhere.
Description hollow(const Description& d);

Field hollow(Field f) {
  f.store = [](void*, const Value&) {};
  f.open = [](void*, const std::string&) -> void* { return nullptr; };
  if (f.nested) f.nested = std::make_shared<Description>(hollow(*f.nested));
  return f;
}

Description hollow(const Description& d) {
  Description h;
  h.one_of = d.one_of;
  h.shorthand = d.shorthand;
  for (const Field& f : d.fields) h.fields.push_back(hollow(f));
  for (const Include& i : d.includes)
    h.includes.push_back({[](void*) -> void* { return nullptr; }, std::make_shared<Description>(hollow(*i.nested))});
  return h;
}

void audit_defaults(const Description& d, const std::string& path, std::vector<std::string>& slips) {
  for (const Field& f : d.fields) {
    const std::string where = path + "." + f.key;
    if (f.default_text) {
      Description alone;
      alone.fields.push_back(hollow(f));
      alone.fields.back().default_text.reset();
      try {
        const auto warnings =
            parse(alone, nullptr, fmt::format("{}: {}", f.key, *f.default_text), {.check_files = false});
        if (!warnings.empty()) slips.push_back(where + ": the default is not plausible");
      } catch (const std::exception& error) {
        slips.push_back(fmt::format("{}: the default does not read: {}", where, error.what()));
      }
    }
    if (f.nested) audit_defaults(*f.nested, where, slips);
  }
  for (const Include& i : d.includes) audit_defaults(*i.nested, path, slips);
}

}  // namespace

std::vector<std::string> audit(const Description& description) {
  std::vector<std::string> slips;
  std::set<std::string> keys;
  audit(description, description.name, slips, keys);
  audit_defaults(description, description.name, slips);
  return slips;
}

}  // namespace tunica::config
