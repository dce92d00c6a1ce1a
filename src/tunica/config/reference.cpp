// The reference of the case file, in Markdown.
#include <fmt/format.h>

#include <map>

#include "tunica/config/description.hpp"

namespace tunica::config {
namespace {

std::string names_of(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += fmt::format("{}`{}`", text.empty() ? "" : ", ", name);
  return text;
}

std::string form_of(const Field& f) {
  const std::string number =
      f.dimension == dimension::none ? "number" : fmt::format("{} [{}]", name_of(f.dimension), si_unit(f.dimension));
  switch (f.kind) {
    case Kind::quantity:
      return number;
    case Kind::quantities:
      return fmt::format("list{}: {}", f.count ? fmt::format(" of {}", f.count) : "", number);
    case Kind::unit:
      return "unit of " + number;
    case Kind::integer:
      return "whole number";
    case Kind::flag:
      return "`true`, `false`";
    case Kind::choice:
      return names_of(f.names);
    case Kind::any_of:
      return "list of " + names_of(f.names);
    case Kind::text:
      return "text";
    case Kind::texts:
      return "text or list of texts";
    case Kind::file:
      return "file";
    case Kind::folder:
      return "folder";
    case Kind::path:
      return "path";
    case Kind::section:
      return "section";
    case Kind::map:
      return fmt::format("`<name>:` {}", f.nested->name);
    case Kind::list:
      return fmt::format("list: {}", f.nested->name);
  }
  return "";
}

std::string range_of(const Field& f) {
  std::string text;
  if (f.allowed.bounded() && f.kind != Kind::unit &&
      !(f.kind == Kind::integer && f.allowed.high > 2e9 && f.allowed.low < -2e9)) {
    Range shown = f.allowed;
    if (f.kind == Kind::integer && shown.high > 2e9) shown.high = std::numeric_limits<double>::infinity();
    text = shown.text(f.dimension);
  }
  if (f.plausible) text += fmt::format("{}usually {}", text.empty() ? "" : "; ", f.plausible_text);
  return text;
}

std::string default_of(const Description& d, const Field& f) {
  if (d.one_of) return "";
  if (f.required) return "**required**";
  if (!f.default_text) return "none";
  return *f.default_text == "{}" ? "its defaults" : fmt::format("`{}`", *f.default_text);
}

std::string row(std::initializer_list<std::string> cells) {
  std::string text = "|";
  for (const std::string& cell : cells) {
    text += ' ';
    for (char c : cell) {
      if (c == '|') text += '\\';
      text += c;
    }
    text += " |";
  }
  return text + "\n";
}

/// All keys on one level, in the order of the declaration.
std::string table(const Description& d) {
  std::string rows;
  if (!d.fields.empty()) {
    rows = d.one_of ? fmt::format("Exactly one of these keys ({}):\n\n", d.name) : "";
    rows += "| key | value | allowed | default | meaning |\n|---|---|---|---|---|\n";
  }
  for (const Field& f : d.fields)
    rows += row({fmt::format("`{}`", f.key), form_of(f), range_of(f), default_of(d, f), f.help});
  if (!d.shorthand.empty())
    rows += fmt::format("\nA plain value in place of this section stands for `{}`.\n", d.shorthand);
  for (const Include& include : d.includes) {
    if (!rows.empty()) rows += '\n';
    rows += table(*include.nested);
  }
  return rows;
}

/// What the key is for, and what kind of thing it holds, unless they say the same.
std::string both_helps(const Description& d, const Field& f) {
  const std::string& general = f.nested->help;
  if (d.one_of || general.starts_with(f.help)) return general;
  return fmt::format("{}. {}", f.help, general);
}

class Reference {
 public:
  void write(const Description& d, const std::string& path, const std::string& help) {
    const std::string heading = path.empty() ? "Keys of the case file" : fmt::format("`{}`", path);
    text_ += fmt::format("{} {}\n\n{}\n\n", path.empty() ? "#" : "##", heading, help);
    const std::string keys = table(d);
    if (keys.empty()) {
      text_ += "No keys.\n\n";
      return;
    }
    const auto [before, first] = written_.emplace(d.help + keys, path);
    if (!first) {
      text_ += fmt::format("Keys as in `{}`.\n\n", before->second);
      return;
    }
    text_ += keys + "\n";
    nested(d, path);
  }

  std::string text() && { return std::move(text_); }

 private:
  void nested(const Description& d, const std::string& path) {
    for (const Field& f : d.fields) {
      if (!f.nested) continue;
      std::string below = path.empty() ? f.key : path + "." + f.key;
      if (f.kind == Kind::map) below += ".<name>";
      if (f.kind == Kind::list) below += "[]";
      write(*f.nested, below, both_helps(d, f));
    }
    for (const Include& include : d.includes) nested(*include.nested, path);
  }

  std::string text_;
  std::map<std::string, std::string> written_;  // keys of a section -> where they stand
};

}  // namespace

std::string markdown(const Description& description) {
  Reference reference;
  reference.write(description, "", description.help);
  return std::move(reference).text();
}

}  // namespace tunica::config
