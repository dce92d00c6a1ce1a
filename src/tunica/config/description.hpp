// What a section of the case file may hold, without the type that it fills: the common root of the parser, the
// reference in Markdown and the JSON schema. Written through Schema<T> (schema.hpp), not by hand.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "tunica/base/error.hpp"
#include "tunica/config/units.hpp"

namespace tunica::config {

/// Allowed values, in SI units.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;
  bool high_open = false;

  bool contains(double value) const;
  bool bounded() const;                                ///< does it exclude any number?
  std::string text(const Dimension& dimension) const;  ///< "> 0 Pa", "0 to 0.5"
};
inline Range anything() { return {}; }
inline Range above(double low) { return {.low = low, .low_open = true}; }
inline Range at_least(double low) { return {.low = low}; }
inline Range below(double high) { return {.high = high, .high_open = true}; }
inline Range at_most(double high) { return {.high = high}; }
inline Range range(double low, double high) { return {.low = low, .high = high}; }  ///< both ends allowed
inline Range between(double low, double high) { return {low, high, true, true}; }   ///< both ends excluded
inline Range from_to_below(double low, double high) { return {.low = low, .high = high, .high_open = true}; }

/// What a check of a whole section finds. `key` is relative to the section ("" for the section itself); the parser
/// turns it into path, file and line.
struct Problems {
  std::vector<Problem> errors, warnings;
  void add(std::string key, std::string what, std::string remedy) {
    errors.push_back({std::move(key), std::move(what), std::move(remedy)});
  }
  void warn(std::string key, std::string what, std::string remedy) {
    warnings.push_back({std::move(key), std::move(what), std::move(remedy)});
  }
};

struct Description;

enum class Kind {
  quantity,    ///< number with unit (without, when dimensionless): double
  quantities,  ///< list of them: vector<double>
  unit,        ///< a unit or a multiple of one ("ms", "0.9 s"), stored as its SI value: double
  integer,     ///< int64
  flag,        ///< true, false: bool
  choice,      ///< one of `names`: its index, int64
  any_of,      ///< list of some of `names`: vector<bool>
  text,        ///< string
  texts,       ///< list of strings, or a single one: vector<string>
  file,        ///< existing file, relative to the folder of the case file: string
  folder,      ///< existing folder, likewise
  path,        ///< file or folder that need not exist, likewise
  section,     ///< a nested description
  map,         ///< names of the user's choice, each with the nested description
  list         ///< list of nested descriptions
};

using Value = std::variant<double, std::int64_t, bool, std::string, std::vector<double>, std::vector<bool>,
                           std::vector<std::string>>;

struct Field {
  std::string key;
  std::string help;
  Kind kind = Kind::text;
  bool required = true;
  std::optional<std::string> default_text;  ///< YAML, read when the key is absent
  std::string initial;                      ///< YAML of the value in T{}
  Dimension dimension{};
  Range allowed{};
  std::optional<Range> plausible;
  std::string plausible_text;                 ///< the same in the units of its declaration
  std::vector<std::string> names;             ///< of choice, any_of
  std::size_t count = 0;                      ///< of quantities: how many; 0: any number
  std::shared_ptr<const Description> nested;  ///< of section, map, list

  std::function<void(void* object, const Value&)> store;             ///< all kinds but the last three
  std::function<void*(void* object, const std::string& name)> open;  ///< section, map, list: where to read into
};

/// Keys of another description that stand on the same level.
struct Include {
  std::function<void*(void* object)> open;
  std::shared_ptr<const Description> nested;
};

struct Description {
  std::string name;
  std::string help;
  std::vector<Field> fields;
  std::vector<Include> includes;
  bool one_of = false;    ///< exactly one of `fields` is present; a scalar names one without required keys
  std::string shorthand;  ///< a scalar or list in place of the section stands for this key
  std::vector<std::function<void(const void* object, Problems&)>> checks;  ///< called when the section read well
};

/// Where a text comes from.
struct Origin {
  std::string name = "case.yaml";      ///< for messages
  std::filesystem::path folder = ".";  ///< that paths in it are relative to
  bool check_files = true;             ///< must files and folders exist?
};

/// Reads `yaml` into `object`, which is of the type that the description was made for. Returns warnings; throws
/// InputError with everything that is wrong.
std::vector<Problem> parse(const Description& description, void* object, const std::string& yaml, const Origin& origin);

/// Whole text of a file, UTF-8. Throws InputError as text::read, and when it is empty.
std::string read_text(const std::filesystem::path& file);

/// Reference of all keys. Sections that are alike are written out once.
std::string markdown(const Description& description);
/// JSON Schema (draft 2020-12), for editors that complete and check YAML.
std::string json_schema(const Description& description);

/// Slips in a description itself, for tests: a default that does not read, a key twice, a missing help text.
std::vector<std::string> audit(const Description& description);

}  // namespace tunica::config
