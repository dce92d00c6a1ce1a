// svFSI's .inp files: `Key: value`, `Key: value { ... }`, # before a comment. Keys get the names of solver.xml.
#include <fmt/format.h>

#include <array>
#include <cctype>
#include <optional>
#include <utility>

#include "tunica/base/error.hpp"
#include "tunica/base/text.hpp"
#include "tunica/peer_cases/entry.hpp"

namespace tunica::peer_cases {

namespace {

/// Keys whose names in solver.xml are others than theirs with underscores, letters of the other case aside.
constexpr auto other_names = std::to_array<std::pair<const char*, const char*>>({
    {"LS_type", "LS"},
    {"Shear_rate_tensor_multipler", "Shear_rate_tensor_multiplier"},
});

/// "Power-law index (n)" -> "Power_law_index".
std::string key_name(std::string_view written) {
  std::string key;
  for (std::size_t i = 0; i < written.size(); ++i) {
    if (written[i] == '(') {
      const auto close = written.find(')', i);
      if (close == std::string_view::npos) break;
      i = close;
      continue;
    }
    const char c = written[i] == '-' || written[i] == '\t' ? ' ' : written[i];
    if (c == ' ' && (key.empty() || key.back() == '_')) continue;
    key += c == ' ' ? '_' : c;
  }
  while (!key.empty() && key.back() == '_') key.pop_back();
  for (const auto& [theirs, ours] : other_names)
    if (key == theirs) return ours;
  return key;
}

class InpParser {
 public:
  InpParser(std::string_view text, const std::filesystem::path& path)
      : text_(text), path_(path.string()), name_(path.filename().string()) {}

  std::vector<Entry> parse() {
    auto entries = statements(0);
    if (at_ < text_.size()) refuse("a } closes nothing", "remove it, or open its section with {");
    return entries;
  }

 private:
  [[noreturn]] void refuse(const std::string& what, const std::string& remedy) const {
    throw InputError(fmt::format("{}:{}", path_, line_), what, remedy);
  }

  char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  void advance() { line_ += text_[at_++] == '\n'; }

  /// Blanks, ends of lines and comments.
  void skip() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '#')
        while (at_ < text_.size() && text_[at_] != '\n') ++at_;
      else if (c == ' ' || c == '\t' || c == '\r' || c == '\n')
        advance();
      else
        return;
    }
  }

  /// Up to one of `stops`, the end of the line or a comment; without blanks around.
  std::string_view until(std::string_view stops) {
    const auto begin = at_;
    while (at_ < text_.size() && text_[at_] != '\n' && text_[at_] != '#' &&
           stops.find(text_[at_]) == std::string_view::npos)
      ++at_;
    auto found = text_.substr(begin, at_ - begin);
    while (!found.empty() && (found.back() == '\r' || found.back() == ' ' || found.back() == '\t'))
      found.remove_suffix(1);
    while (!found.empty() && (found.front() == ' ' || found.front() == '\t')) found.remove_prefix(1);
    return found;
  }

  /// `{1.0, 2.0, 0.0}` in the place of a value: braces on one line without a key between them.
  std::optional<std::string_view> vector_in_braces() {
    const auto close = text_.find_first_of("}:#\n", at_ + 1);
    if (close == std::string_view::npos || text_[close] != '}' || close == at_ + 1) return std::nullopt;
    const auto inside = text_.substr(at_ + 1, close - at_ - 1);
    if (inside.find_first_not_of(" \t") == std::string_view::npos) return std::nullopt;
    at_ = close + 1;
    return inside;
  }

  std::vector<Entry> statements(std::size_t depth) {
    if (depth > deepest_section) refuse("has more than 32 sections in each other", "close sections with }");
    std::vector<Entry> entries;
    for (skip(); at_ < text_.size() && peek() != '}'; skip()) entries.push_back(statement(depth));
    return entries;
  }

  Entry statement(std::size_t depth) {
    if (++count_ > most_entries) refuse("has more than 100 000 keys", "give the input file of one case");
    Entry entry{.key = {}, .label = {}, .value = {}, .file = name_, .line = line_};
    const auto written = until(":{}");
    if (peek() != ':')
      refuse(fmt::format("`{}` has no colon behind it", text::printable(written)), "write `Key: value`");
    entry.key = key_name(written);
    if (entry.key.empty()) refuse("a colon has no key before it", "write `Key: value`");
    ++at_;
    entry.value = until("{}");
    if (peek() == '{')
      if (const auto vector = vector_in_braces()) {
        entry.value = *vector;
        return entry;
      }
    const auto at = at_;
    const int line = line_;
    skip();
    if (peek() != '{') {
      at_ = at;
      line_ = line;
      return entry;
    }
    open_section(entry, depth);
    return entry;
  }

  void open_section(Entry& entry, std::size_t depth) {
    const int opened = line_;
    ++at_;
    entry.section = true;
    entry.label = std::exchange(entry.value, {});
    entry.entries = statements(depth + 1);
    if (peek() != '}')
      refuse(fmt::format("the section {} that is opened in line {} is not closed", text::printable(entry.key), opened),
             "close it with }");
    ++at_;
  }

  std::string_view text_;
  std::string path_, name_;
  std::size_t at_ = 0, count_ = 0;
  int line_ = 1;
};

bool stands_at_the_top(const Entry& entry) { return entry.key.starts_with("Add_") || entry.key == "Contact"; }

/// Sections that may stand without braces: `Constitutive model: nHK`.
void label_sections(Entry& entry) {
  for (const char* key : {"Constitutive_model", "Viscosity"})
    if (entry.key == key && !entry.section) {
      entry.section = true;
      entry.label = std::exchange(entry.value, {});
    }
  for (Entry& below : entry.entries) label_sections(below);
}

/// `RCR values: (Rp, C, Rd)` with the pressures beside it, as the section of solver.xml.
void gather_rcr(Entry& condition) {
  Entry* rcr = nullptr;
  for (Entry& entry : condition.entries)
    if (entry.key == "RCR_values" && !entry.section) rcr = &entry;
  if (rcr == nullptr) return;
  constexpr const char* names[] = {"Proximal_resistance", "Capacitance", "Distal_resistance"};
  std::string value = std::exchange(rcr->value, {});
  for (char& c : value)
    if (std::string_view("(){},\"").find(c) != std::string_view::npos) c = ' ';
  std::size_t n = 0;
  for (std::size_t at = 0; (at = value.find_first_not_of(" \t", at)) != std::string::npos; ++n) {
    const auto end = std::min(value.find_first_of(" \t", at), value.size());
    Entry part{.key = n < 3 ? names[n] : fmt::format("RCR_values_{}", n + 1),
               .label = {},
               .value = value.substr(at, end - at),
               .file = rcr->file,
               .line = rcr->line};
    rcr->entries.push_back(std::move(part));
    at = end;
  }
  rcr->section = true;
  for (Entry& entry : condition.entries)
    if (entry.key == "Distal_pressure" || entry.key == "Initial_pressure") {
      rcr->entries.push_back(entry);
      entry.key.clear();
    }
  std::erase_if(condition.entries, [](const Entry& entry) { return entry.key.empty(); });
}

void rename(Entry& entry, std::string_view from, const char* to) {
  for (Entry& below : entry.entries)
    if (below.key == from) below.key = to;
}

void rename_parts(Entry& section) {
  for (Entry& entry : section.entries) {
    if (entry.key == "Add_BC") gather_rcr(entry);
    if (entry.key == "Constitutive_model") {  // Guccione's law
      rename(entry, "C", "c");
      rename(entry, "bs", "bt");
    }
    rename_parts(entry);
  }
}

}  // namespace

PeerFile read_inp(const std::string& text, const std::filesystem::path& path) {
  PeerFile file{path, Dialect::inp, {}};
  Entry general{.key = "GeneralSimulationParameters",
                .label = {},
                .value = {},
                .file = path.filename().string(),
                .line = 1,
                .section = true};
  for (Entry& entry : InpParser(text, path).parse()) {
    label_sections(entry);
    (stands_at_the_top(entry) ? file.root : general).entries.push_back(std::move(entry));
  }
  rename_parts(file.root);
  file.root.file = general.file;
  file.root.line = 1;
  file.root.section = true;
  file.root.entries.insert(file.root.entries.begin(), std::move(general));
  return file;
}

}  // namespace tunica::peer_cases
