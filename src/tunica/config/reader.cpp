// YAML into the members that a Description names.
#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <type_traits>

#include "tunica/base/digits.hpp"
#include "tunica/config/document.hpp"
#include "tunica/config/file_names.hpp"
#include "tunica/config/nearest.hpp"

namespace tunica::config {
namespace {

namespace fs = std::filesystem;

struct Entry {
  std::string key;
  YAML::Node node;
  int line;
};

/// A description and the object that it fills; an included description stands on the same level of the text.
struct Level {
  const Description* description;
  void* object;
};

const char* form_of(const YAML::Node& node) {
  return node.IsSequence() ? "a list"
         : node.IsMap()    ? "a section with keys"
         : node.IsScalar() ? "a single value"
                           : "empty";
}

std::string join(const std::vector<std::string>& names, const char* separator = ", ") {
  std::string text;
  for (const std::string& name : names) text.append(text.empty() ? "" : separator).append(name);
  return text;
}

class Reader {
 public:
  /// `settings`: receives every value that was read, unless it is null.
  Reader(const Origin& origin, std::vector<Setting>* settings) : origin_(origin), settings_(settings) {}

  std::vector<Problem> errors, warnings;

  void read(const Description& description, void* object, YAML::Node node, const std::string& path, int line) {
    const std::size_t errors_before = errors.size();
    std::vector<Level> levels;
    collect(description, object, levels);
    const auto entries = entries_of(description, node, path, line);
    if (!entries) return;
    const bool all_known = refuse_unknown(*entries, levels, path);
    for (const Level& level : levels) {
      if (level.description->one_of)
        read_one_of(level, *entries, path, line, all_known);
      else
        read_fields(level, *entries, path, line);
    }
    if (errors.size() != errors_before) return;
    for (const Level& level : levels) run_checks(level, *entries, path, line);
  }

 private:
  static void collect(const Description& description, void* object, std::vector<Level>& levels) {
    levels.push_back({&description, object});
    for (const Include& include : description.includes) collect(*include.nested, include.open(object), levels);
  }

  std::string where(const std::string& path, int line) const {
    return fmt::format("{} ({}:{})", path.empty() ? "top level" : path, origin_.name, line);
  }
  void error(const std::string& path, int line, std::string what, std::string remedy) {
    errors.push_back({where(path, line), std::move(what), std::move(remedy)});
  }
  static std::string below(const std::string& path, const std::string& key) {
    return path.empty() ? key : path + "." + key;
  }

  // --- sections -----------------------------------------------------------------------------------------------------

  std::optional<std::vector<Entry>> entries_of(const Description& description, const YAML::Node& node,
                                               const std::string& path, int line) {
    if (!node || node.IsNull()) return std::vector<Entry>{};
    if (node.IsMap()) return map_entries(node, path);
    if (!description.shorthand.empty()) return std::vector<Entry>{{description.shorthand, node, line}};
    if (node.IsScalar() && description.one_of) return std::vector<Entry>{{node.Scalar(), YAML::Node(), line}};
    error(path, line, fmt::format("is {}; a section with keys is due", form_of(node)),
          "write `key: value` lines below it");
    return std::nullopt;
  }

  /// yaml-cpp keeps both of two equal keys, so that they can be told here.
  std::vector<Entry> map_entries(const YAML::Node& node, const std::string& path) {
    std::vector<Entry> entries;
    for (const auto& pair : node) {
      const YAML::Node& key = pair.first;
      const int line = key.Mark().line + 1;
      if (!key.IsScalar()) {
        error(path, line, fmt::format("a key is {}", form_of(key)), "keys are plain words");
        continue;
      }
      const auto same =
          std::find_if(entries.begin(), entries.end(), [&](const Entry& e) { return e.key == key.Scalar(); });
      if (same == entries.end())
        entries.push_back({key.Scalar(), pair.second, line});
      else
        error(below(path, key.Scalar()), line, fmt::format("stands twice, first in line {}", same->line),
              "keep one of them");
    }
    return entries;
  }

  /// Returns whether there are none.
  bool refuse_unknown(const std::vector<Entry>& entries, const std::vector<Level>& levels, const std::string& path) {
    std::vector<std::string> known;
    for (const Level& level : levels)
      for (const Field& field : level.description->fields) known.push_back(field.key);
    bool all_known = true;
    for (const Entry& entry : entries) {
      if (std::find(known.begin(), known.end(), entry.key) != known.end()) continue;
      const std::string meant = nearest(entry.key, known);
      std::string remedy = known.empty() ? "this section has no keys" : "keys here: " + join(known);
      if (!meant.empty()) remedy = fmt::format("did you mean `{}`?", meant);
      all_known = false;
      error(below(path, entry.key), entry.line, fmt::format("`{}` is not known here", entry.key), remedy);
    }
    return all_known;
  }

  static const Entry* find(const std::vector<Entry>& entries, const std::string& key) {
    const auto at = std::find_if(entries.begin(), entries.end(), [&](const Entry& e) { return e.key == key; });
    return at == entries.end() ? nullptr : &*at;
  }

  /// An unknown key was reported already; that none of the known ones is there then needs no second message.
  void read_one_of(const Level& level, const std::vector<Entry>& entries, const std::string& path, int line,
                   bool all_known) {
    std::vector<std::string> all, present;
    for (const Field& field : level.description->fields) {
      all.push_back(field.key);
      if (find(entries, field.key)) present.push_back(field.key);
    }
    if (present.size() > 1 || (present.empty() && all_known)) {
      error(path, line,
            present.empty() ? fmt::format("lacks its {}", level.description->name)
                            : fmt::format("has {} of {} that exclude each other: {}", present.size(),
                                          level.description->name, join(present)),
            fmt::format("give exactly one of: {}", join(all)));
    }
    if (present.empty()) return;
    if (settings_) settings_->push_back({path, present.front(), Kind::choice});
    for (const Field& field : level.description->fields) {
      if (field.key != present.front()) continue;
      const Entry& entry = *find(entries, field.key);
      read_field(field, level.object, entry.node, below(path, field.key), entry.line);
    }
  }

  void read_fields(const Level& level, const std::vector<Entry>& entries, const std::string& path, int line) {
    for (const Field& field : level.description->fields) {
      if (const Entry* entry = find(entries, field.key))
        read_field(field, level.object, entry->node, below(path, field.key), entry->line);
      else if (field.default_text)
        read_default(field, level.object, path);
      else if (field.required)
        report_missing(field, path, line);
    }
  }

  /// A default that does not read is a slip in the description: Description audits find it.
  void read_default(const Field& field, void* object, const std::string& path) {
    const Origin unchecked{.name = "default", .folder = origin_.folder, .check_files = false};
    Reader reader(unchecked, settings_);
    reader.read_field(field, object, YAML::Load(*field.default_text), below(path, field.key), 1);
    if (!reader.errors.empty()) throw std::logic_error("bad default: " + format(reader.errors.front()));
  }

  void report_missing(const Field& field, const std::string& path, int line) {
    std::string example = "...";
    if (field.kind == Kind::quantity || field.kind == Kind::quantities)
      example = field.dimension == dimension::none ? "<number>" : fmt::format("<number> {}", si_unit(field.dimension));
    if (field.kind == Kind::choice || field.kind == Kind::any_of) example = join(field.names, " | ");
    std::string what = fmt::format("`{}` is missing: {}", field.key, field.help);
    if (field.allowed.bounded()) what += fmt::format(" ({})", field.allowed.text(field.dimension));
    error(path, line, what, fmt::format("add `{}: {}`", field.key, example));
  }

  /// Line of a key of a map, or of the map.
  static int line_below(const Entry& entry, const std::string& key) {
    if (entry.node.IsMap())
      for (const auto& pair : entry.node)
        if (pair.first.IsScalar() && pair.first.Scalar() == key) return pair.first.Mark().line + 1;
    return entry.line;
  }

  void run_checks(const Level& level, const std::vector<Entry>& entries, const std::string& path, int line) {
    Problems found;
    for (const auto& check : level.description->checks) check(level.object, found);
    const auto locate = [&](Problem& problem) {
      const auto dot = problem.where.find('.');
      const Entry* entry = find(entries, problem.where.substr(0, dot));
      const int at = !entry                     ? line
                     : dot == std::string::npos ? entry->line
                                                : line_below(*entry, problem.where.substr(dot + 1));
      problem.where = where(problem.where.empty() ? path : below(path, problem.where), at);
    };
    std::for_each(found.errors.begin(), found.errors.end(), locate);
    std::for_each(found.warnings.begin(), found.warnings.end(), locate);
    errors.insert(errors.end(), found.errors.begin(), found.errors.end());
    warnings.insert(warnings.end(), found.warnings.begin(), found.warnings.end());
  }

  // --- values -------------------------------------------------------------------------------------------------------

  void read_field(const Field& field, void* object, const YAML::Node& node, const std::string& path, int line) {
    switch (field.kind) {
      case Kind::section:
        return read(*field.nested, field.open(object, ""), node, path, line);
      case Kind::map:
        return read_map(field, object, node, path, line);
      case Kind::list:
        return read_list(field, object, node, path, line);
      default:
        break;
    }
    const std::optional<Value> value = value_of(field, node, path, line);
    if (!value) return;
    field.store(object, *value);
    if (settings_) settings_->push_back({path, text_of(field, *value), field.kind});
  }

  static std::string text_of(const Field& field, const Value& value) {
    const auto text = [&](const auto& v) -> std::string {
      using V = std::decay_t<decltype(v)>;
      if constexpr (std::is_same_v<V, std::string>) {
        return v;
      } else if constexpr (std::is_same_v<V, std::int64_t>) {
        return field.kind == Kind::choice ? field.names[static_cast<std::size_t>(v)] : std::to_string(v);
      } else if constexpr (std::is_same_v<V, std::vector<bool>>) {
        std::string chosen;
        for (std::size_t i = 0; i < v.size(); ++i)
          if (v[i]) chosen += (chosen.empty() ? "" : ", ") + field.names[i];
        return chosen;
      } else if constexpr (std::is_same_v<V, double> || std::is_same_v<V, bool>) {
        return fmt::format("{}", v);
      } else {
        std::string list;
        for (const auto& item : v) list += fmt::format("{}{}", list.empty() ? "" : ", ", item);
        return list;
      }
    };
    return std::visit(text, value);
  }

  void read_map(const Field& field, void* object, const YAML::Node& node, const std::string& path, int line) {
    if (!node.IsMap() && !node.IsNull())
      return error(path, line, fmt::format("is {}; named sections are due", form_of(node)),
                   "write `name: ...` lines below it");
    for (const Entry& entry : map_entries(node, path))
      read(*field.nested, field.open(object, entry.key), entry.node, below(path, entry.key), entry.line);
  }

  void read_list(const Field& field, void* object, const YAML::Node& node, const std::string& path, int line) {
    if (!node.IsSequence())
      return error(path, line, fmt::format("is {}; a list is due", form_of(node)), "begin each item with `- `");
    int number = 0;
    for (const YAML::Node& item : node)
      read(*field.nested, field.open(object, ""), item, fmt::format("{}[{}]", path, ++number), item.Mark().line + 1);
  }

  std::optional<Value> value_of(const Field& field, const YAML::Node& node, const std::string& path, int line) {
    if (field.kind == Kind::quantities) return quantities(field, node, path, line);
    if (field.kind == Kind::texts) return texts(node, path, line);
    if (field.kind == Kind::any_of) return any_of(field, node, path, line);
    if (!node.IsScalar()) {
      error(path, line, fmt::format("is {}; a single value is due: {}", form_of(node), field.help),
            "write `key: value`");
      return std::nullopt;
    }
    const std::string& text = node.Scalar();
    switch (field.kind) {
      case Kind::quantity:
      case Kind::unit:
        return quantity(field, text, path, line);
      case Kind::integer:
        return integer(field, text, path, line);
      case Kind::flag:
        if (text == "true" || text == "false") return text == "true";
        error(path, line, fmt::format("`{}` is neither true nor false", text), "write true or false");
        return std::nullopt;
      case Kind::choice:
        if (const auto index = index_of(field, text, path, line)) return static_cast<std::int64_t>(*index);
        return std::nullopt;
      case Kind::file:
      case Kind::folder:
      case Kind::path:
        return location(field, text, path, line);
      default:
        return text;
    }
  }

  std::optional<Value> quantity(const Field& field, const std::string& text, const std::string& path, int line) {
    const bool bare_unit = field.kind == Kind::unit && text.find_first_of("0123456789+-.") != 0;
    const auto parsed = bare_unit ? parse_unit(text, field.dimension) : parse_quantity(text, field.dimension);
    if (const auto* unit_error = std::get_if<UnitError>(&parsed)) {
      error(path, line, unit_error->what, unit_error->remedy);
      return std::nullopt;
    }
    const double value = std::get<double>(parsed);
    if (!field.allowed.contains(value)) {
      out_of_range(field, text, path, line);
      return std::nullopt;
    }
    if (field.plausible && !field.plausible->contains(value)) warn_implausible(field, text, path, line);
    return value;
  }

  void out_of_range(const Field& field, const std::string& text, const std::string& path, int line) {
    const std::string allowed = field.allowed.text(field.dimension);
    error(path, line, fmt::format("`{}` is out of range, allowed: {}", text, allowed),
          fmt::format("give a value {}", allowed));
  }

  void warn_implausible(const Field& field, const std::string& text, const std::string& path, int line) {
    const Range& usual = *field.plausible;
    const std::string meant = likely_meant(text, field.dimension, usual.low, usual.high);
    // Rounded: 26 ms are 0.026 s, not 0.026000000000000002 s.
    const std::string si = in_si(base::without_noise(si_value(field, text)), field.dimension);
    const std::string in_unit = si == text ? "" : " = " + si;
    warnings.push_back(
        {where(path, line), fmt::format("`{}`{} is unusual: {} is expected", text, in_unit, field.plausible_text),
         meant.empty() ? "check value and unit" : fmt::format("a slip of the unit? `{}` would be usual", meant)});
  }
  static double si_value(const Field& field, const std::string& text) {
    return std::get<double>(parse_quantity(text, field.dimension));
  }

  std::optional<Value> integer(const Field& field, const std::string& text, const std::string& path, int line) {
    std::int64_t value = 0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (failure != std::errc() || end != text.data() + text.size()) {
      error(path, line, fmt::format("`{}` is not a whole number", text), "write digits only");
      return std::nullopt;
    }
    if (field.allowed.contains(static_cast<double>(value))) return value;
    out_of_range(field, text, path, line);
    return std::nullopt;
  }

  std::optional<std::size_t> index_of(const Field& field, const std::string& text, const std::string& path, int line) {
    const auto at = std::find(field.names.begin(), field.names.end(), text);
    if (at != field.names.end()) return at - field.names.begin();
    const std::string meant = nearest(text, field.names);
    error(path, line, fmt::format("`{}` is not one of: {}", text, join(field.names)),
          meant.empty() ? "choose one of them" : fmt::format("did you mean `{}`?", meant));
    return std::nullopt;
  }

  std::optional<Value> texts(const YAML::Node& node, const std::string& path, int line) {
    if (node.IsScalar()) return std::vector<std::string>{node.Scalar()};
    std::vector<std::string> list;
    bool good = node.IsSequence();
    for (std::size_t i = 0; good && i < node.size(); ++i) {
      good = node[i].IsScalar();
      if (good) list.push_back(node[i].Scalar());
    }
    if (good) return list;
    error(path, line, fmt::format("is {}; a text or a list of texts is due", form_of(node)), "write `[a, b]`");
    return std::nullopt;
  }

  std::optional<Value> any_of(const Field& field, const YAML::Node& node, const std::string& path, int line) {
    const std::optional<Value> given = texts(node, path, line);
    if (!given) return std::nullopt;
    std::vector<bool> flags(field.names.size(), false);
    bool good = true;
    for (const std::string& text : std::get<std::vector<std::string>>(*given)) {
      const auto index = index_of(field, text, path, line);
      good = good && index;
      if (index) flags[*index] = true;
    }
    return good ? std::optional<Value>(flags) : std::nullopt;
  }

  /// "[0, 0, 1] m/s" -> "0 m/s", "0 m/s", "1 m/s"; a YAML list as it is.
  static std::optional<std::vector<std::string>> items_of(const YAML::Node& node) {
    std::vector<std::string> items;
    if (node.IsSequence()) {
      for (const YAML::Node& item : node) items.push_back(item.IsScalar() ? item.Scalar() : std::string(form_of(item)));
      return items;
    }
    const std::string text = node.IsScalar() ? node.Scalar() : "";
    const std::size_t close = text.find(']');
    if (!text.starts_with('[') || close == std::string::npos) return std::nullopt;
    for (std::size_t begin = 1; begin <= close;) {
      const std::size_t end = std::min(text.find(',', begin), close);
      items.push_back(text.substr(begin, end - begin) + " " + text.substr(close + 1));
      begin = end + 1;
    }
    return items;
  }

  std::optional<Value> quantities(const Field& field, const YAML::Node& node, const std::string& path, int line) {
    const std::string length = field.count == 0 ? "" : fmt::format("{} ", field.count);
    const auto items = items_of(node);
    if (!items || (field.count != 0 && items->size() != field.count)) {
      error(path, line,
            items ? fmt::format("has {} values; {}are due", items->size(), length)
                  : fmt::format("is {}; a list of {}values is due", form_of(node), length),
            field.dimension == dimension::none ? "write `[1, 2, ...]`"
                                               : fmt::format("write `\"[1, 2, ...] {}\"`", si_unit(field.dimension)));
      return std::nullopt;
    }
    std::vector<double> values;
    for (std::size_t i = 0; i < items->size(); ++i)
      if (const auto value = quantity(field, (*items)[i], fmt::format("{}[{}]", path, i + 1), line))
        values.push_back(std::get<double>(*value));
    if (values.size() != items->size()) return std::nullopt;
    return values;
  }

  std::optional<Value> location(const Field& field, const std::string& text, const std::string& path, int line) {
    const bool folder = field.kind == Kind::folder;
    if (text.empty()) {
      error(path, line, "is empty; a name is due: " + field.help,
            field.default_text || !field.required ? "write a name, or leave the key out" : "write a name");
      return std::nullopt;
    }
    const fs::path full = (origin_.folder / text).lexically_normal();
    if (const std::string what = unusable_name(text, full); !what.empty()) {
      error(path, line, what, "give a shorter, plain name");
      return std::nullopt;
    }
    if (!origin_.check_files || field.kind == Kind::path) return full.string();
    std::error_code failure;
    const auto status = fs::status(full, failure);
    if (folder ? fs::is_directory(status) : fs::is_regular_file(status)) return full.string();
    const std::string due = folder ? "folder" : "file";
    if (const std::string what = other_than_wanted(full, status, failure); !what.empty())
      error(path, line, fmt::format("`{}` {}, a {} is due", text, what, due), fmt::format("name a {}", due));
    else
      error(path, line, fmt::format("{} `{}` does not exist (looked for {})", due, text, full.string()),
            similar_file(full));
    return std::nullopt;
  }

  static std::string similar_file(const fs::path& full) {
    std::vector<std::string> names;
    std::error_code failure;
    for (fs::directory_iterator at(full.parent_path().empty() ? "." : full.parent_path(), failure), end;
         !failure && at != end; at.increment(failure))
      names.push_back(at->path().filename().string());
    std::sort(names.begin(), names.end());
    const std::string meant = nearest(full.filename().string(), names);
    return meant.empty() ? "give its path relative to the folder of the case file"
                         : fmt::format("did you mean `{}`?", meant);
  }

  const Origin& origin_;
  std::vector<Setting>* settings_;
};

}  // namespace

std::vector<Problem> parse(const Description& description, void* object, const Document& document, const Origin& origin,
                           std::vector<Setting>* settings) {
  Reader reader(origin, settings);
  reader.read(description, object, document.node(), "", 1);
  if (!reader.errors.empty()) throw InputError(std::move(reader.errors));
  return std::move(reader.warnings);
}

std::vector<Problem> parse(const Description& description, void* object, const std::string& yaml,
                           const Origin& origin) {
  return parse(description, object, Document(yaml, origin.name), origin);
}

}  // namespace tunica::config
