#include "tunica/config/document.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <charconv>
#include <functional>
#include <optional>

#include "tunica/config/yaml_guard.hpp"

namespace tunica::config {

namespace {

namespace fs = std::filesystem;

/// yaml-cpp takes CR LF for the end of a line, but not CR alone.
std::string with_line_feeds(std::string text) {
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] == '\r' && (i + 1 == text.size() || text[i + 1] != '\n')) text[i] = '\n';
  return text;
}

YAML::Node load(const std::string& given, const std::string& name) {
  const std::string yaml = with_line_feeds(given);
  try {
    refuse_unreadable_yaml(yaml, name);
    const std::vector<YAML::Node> documents = YAML::LoadAll(yaml);
    if (documents.size() > 1)
      throw InputError(name, fmt::format("holds {} YAML documents", documents.size()),
                       "keep one: remove the `---` lines");
    return documents.empty() ? YAML::Node() : documents.front();
  } catch (const YAML::Exception& e) {
    throw InputError(fmt::format("{}:{}:{}", name, e.mark.line + 1, e.mark.column + 1),
                     fmt::format("is not valid YAML: {}", e.msg),
                     "check indentation, colons, quotes and brackets near there");
  }
}

/// "families[2].k1": families, [2], k1.
std::vector<std::string> keys_of(std::string_view path) {
  std::vector<std::string> keys;
  for (std::size_t begin = 0; begin <= path.size() && !path.empty();) {
    const auto end = std::min(path.find('.', begin), path.size());
    const auto key = path.substr(begin, end - begin);
    const auto bracket = key.ends_with(']') ? key.rfind('[') : std::string_view::npos;
    keys.emplace_back(key.substr(0, bracket));
    if (bracket != std::string_view::npos) keys.emplace_back(key.substr(bracket));
    begin = end + 1;
  }
  return keys;
}

/// What "[2]" names in a list: its second entry. None where there are fewer.
std::optional<YAML::Node> entry_of(const YAML::Node& list, const std::string& key) {
  std::size_t number = 0;
  const auto* const last = key.data() + key.size() - 1;
  if (key.size() < 3 || key.front() != '[' || !list.IsSequence()) return std::nullopt;
  if (const auto read = std::from_chars(key.data() + 1, last, number); read.ptr != last) return std::nullopt;
  if (number < 1 || number > list.size()) return std::nullopt;
  return list[number - 1];
}

// The assignment of yaml-cpp's nodes changes what they refer to, so that going down a tree takes reset().
std::optional<YAML::Node> find(const YAML::Node& root, std::string_view path) {
  YAML::Node at;
  at.reset(root);
  for (const auto& key : keys_of(path)) {
    if (const auto entry = entry_of(at, key)) {
      at.reset(*entry);
      continue;
    }
    if (!at.IsMap()) return std::nullopt;
    const YAML::Node& map = at;
    const YAML::Node next = map[key];
    if (!next) return std::nullopt;
    at.reset(next);
  }
  return at;
}

/// What the keys of a section are, those of included descriptions among them.
const Field* field_of(const Description& description, const std::string& key) {
  for (const Field& field : description.fields)
    if (field.key == key) return &field;
  for (const Include& include : description.includes)
    if (const Field* field = field_of(*include.nested, key)) return field;
  return nullptr;
}

using Visit = std::function<void(const Field&, YAML::Node)>;

/// Visits the keys that hold values, as far as the description knows them.
void each_value(const Description& description, YAML::Node node, const Visit& visit);

void each_value_of(const Field& field, YAML::Node node, const Visit& visit) {
  if (field.kind == Kind::section) return each_value(*field.nested, node, visit);
  if (field.kind == Kind::map && node.IsMap())
    for (auto entry : node) each_value(*field.nested, entry.second, visit);
  else if (field.kind == Kind::list && node.IsSequence())
    for (auto item : node) each_value(*field.nested, item, visit);
  else
    visit(field, node);
}

void each_value(const Description& description, YAML::Node node, const Visit& visit) {
  if (!node.IsMap()) {
    if (const Field* field = field_of(description, description.shorthand)) each_value_of(*field, node, visit);
    return;
  }
  for (auto entry : node)
    if (const Field* field = field_of(description, entry.first.Scalar())) each_value_of(*field, entry.second, visit);
}

std::string moved(const std::string& path, const fs::path& from, const fs::path& to) {
  if (fs::path(path).is_absolute()) return path;
  const fs::path full = fs::absolute(from / path).lexically_normal();
  const fs::path base = to.empty() ? fs::current_path() : fs::absolute(to);  // the folder of a bare file name is empty
  return full.lexically_relative(base.lexically_normal()).string();
}

// --- YAML text ------------------------------------------------------------------------------------------------------

void set_flow_style(YAML::Node node) {
  if (node.IsMap() || node.IsSequence()) node.SetStyle(YAML::EmitterStyle::Flow);
  if (node.IsMap())
    for (auto entry : node) set_flow_style(entry.second);
  if (node.IsSequence())
    for (auto item : node) set_flow_style(item);
}

std::string on_one_line(const YAML::Node& node) {
  YAML::Node copy = YAML::Clone(node);
  set_flow_style(copy);
  YAML::Emitter out;
  out << copy;
  return out.c_str();
}

std::string first_sentence(const std::string& help) {
  const auto end = help.find(". ");
  return end == std::string::npos ? help : help.substr(0, end);
}

class Writer {
 public:
  void section(const Description* description, const YAML::Node& node, int depth) {
    for (const auto& entry : node) {
      const Field* field = description ? field_of(*description, entry.first.Scalar()) : nullptr;
      const bool names = field && field->kind == Kind::map;
      const bool nested = entry.second.IsMap() && entry.second.size() > 0 && field && field->nested;
      const std::string help = field ? fmt::format("  # {}", first_sentence(field->help)) : "";
      if (depth == 0) text += "\n";
      line(depth, entry.first, nested ? "" : fmt::format(" {}", on_one_line(entry.second)), help);
      if (!nested) continue;
      if (names)
        entries(*field->nested, entry.second, depth + 1);
      else
        section(field->nested.get(), entry.second, depth + 1);
    }
  }
  std::string text;

 private:
  void entries(const Description& description, const YAML::Node& node, int depth) {
    for (const auto& entry : node) {
      const bool nested = entry.second.IsMap() && on_one_line(entry.second).size() > 80;
      line(depth, entry.first, nested ? "" : fmt::format(" {}", on_one_line(entry.second)), "");
      if (nested) section(&description, entry.second, depth + 1);
    }
  }
  void line(int depth, const YAML::Node& key, const std::string& value, const std::string& comment) {
    text += std::string(static_cast<std::size_t>(2 * depth), ' ') +
            fmt::format("{}:{}{}\n", on_one_line(key), value, comment);
  }
};

}  // namespace

Document::Document() : node_(std::make_unique<YAML::Node>(YAML::NodeType::Map)) {}
Document::Document(const std::string& yaml, const std::string& name) : node_(std::make_unique<YAML::Node>()) {
  node_->reset(load(yaml, name));
}
Document::Document(const Document& other) : node_(std::make_unique<YAML::Node>()) {
  node_->reset(YAML::Clone(*other.node_));
}
Document& Document::operator=(const Document& other) {
  if (this != &other) node_->reset(YAML::Clone(*other.node_));
  return *this;
}
Document::~Document() = default;

bool Document::has(std::string_view path) const { return find(*node_, path).has_value(); }

std::string Document::text(std::string_view path) const {
  const auto found = find(*node_, path);
  return found && found->IsScalar() ? found->Scalar() : "";
}

Document Document::part(std::string_view path) const {
  Document result;
  if (const auto found = find(*node_, path)) result.node_->reset(YAML::Clone(*found));
  return result;
}

void Document::set(std::string_view path, const Document& value) {
  YAML::Node at;
  at.reset(*node_);
  for (const auto& key : keys_of(path)) {
    if (const auto entry = entry_of(at, key)) {
      at.reset(*entry);
      continue;
    }
    // yaml-cpp would turn a list into a section, and refuse a scalar without a name.
    if (at.IsScalar() || at.IsSequence())
      throw InputError(std::string(path),
                       fmt::format("`{}` can be no key of a {}", key, at.IsScalar() ? "value" : "list"),
                       at.IsScalar() || !key.starts_with('[') ? "give the section or list above it as a whole"
                                                              : fmt::format("its entries are [1] to [{}]", at.size()));
    at.reset(at[key]);
  }
  at = YAML::Clone(*value.node_);
}

void Document::set(std::string_view path, const std::string& scalar) {
  Document value;
  value.node_->reset(YAML::Node(scalar));
  set(path, value);
}

void Document::remove(std::string_view path) {
  const auto dot = path.rfind('.');
  const bool top = dot == std::string_view::npos;
  if (auto parent = find(*node_, top ? "" : path.substr(0, dot)); parent && parent->IsMap())
    parent->remove(std::string(top ? path : path.substr(dot + 1)));
}

void move_paths(Document& document, const Description& description, const fs::path& from, const fs::path& to) {
  YAML::Node root;
  root.reset(document.node());
  each_value(description, root, [&](const Field& field, YAML::Node node) {
    const bool path = field.kind == Kind::file || field.kind == Kind::folder || field.kind == Kind::path;
    if (path && node.IsScalar() && !node.Scalar().empty()) node = moved(node.Scalar(), from, to);
  });
}

std::string commented_yaml(const Document& document, const Description& description) {
  Writer writer;
  writer.section(&description, document.node(), 0);
  return writer.text;
}

std::string one_line(const Document& document) {
  YAML::Emitter emitter;
  emitter << YAML::Flow << document.node();
  std::string text = emitter.c_str();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

}  // namespace tunica::config
