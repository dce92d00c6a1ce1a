#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "tunica/base/text.hpp"
#include "tunica/config/nearest.hpp"
#include "tunica/peer_cases/svsolver_files.hpp"
#include "tunica/peer_cases/values.hpp"
#include "tunica/peer_cases/vocabulary.hpp"

namespace tunica::peer_cases {

namespace {

class Check {
 public:
  Check(Dialect dialect, std::vector<Problem>& problems) : dialect_(dialect), problems_(problems) {}

  void section(Entry& entry, const SectionRule& rule) {
    std::map<std::string, const Entry*> seen;
    for (Entry& below : entry.entries) {
      const KeyRule* found = find(rule, below.key);
      if (found == nullptr) {
        if (!rule.loose) unknown(below, entry, rule);
        continue;
      }
      below.key = found->key;
      const auto [first, is_new] = seen.emplace(below.key, &below);
      if (!is_new && !found->repeats && (found->kind == Kind::section || first->second->value != below.value))
        problems_.push_back(
            {below.where(),
             fmt::format("stands in line {} of {}, too, with another value", first->second->line, entry.key),
             "keep the one that is meant"});
      key(below, *found);
    }
  }

  std::vector<Dropped> dropped;

 private:
  const KeyRule* find(const SectionRule& rule, const std::string& key) const {
    for (const KeyRule& known : rule.keys)
      if (key == known.key) return &known;
    if (dialect_ == Dialect::inp)
      for (const KeyRule& known : rule.keys)
        if (text::lower(key) == text::lower(known.key)) return &known;
    return nullptr;
  }

  void unknown(const Entry& entry, const Entry& above, const SectionRule& rule) {
    std::vector<std::string> names;
    for (const KeyRule& known : rule.keys) names.emplace_back(known.key);
    const std::string meant = config::nearest(entry.key, names);
    problems_.push_back({entry.where(),
                         fmt::format("is no key of {}", above.key.empty() ? std::string("the file") : above.key),
                         meant.empty() ? "remove it, or correct its name" : fmt::format("did you mean {}?", meant)});
  }

  void key(Entry& entry, const KeyRule& rule) {
    if (rule.kind == Kind::section) {
      if (rule.use == Use::refused) return missing(entry, rule.why);
      if (!entry.section && !entry.value.empty())
        problems_.push_back({entry.where(),
                             fmt::format("`{}` stands where a section is due", text::printable(entry.value)),
                             "write its keys below it"});
      const SectionRule& below = *rule.below;
      return section(entry, below.other != nullptr && entry.label == below.other_label ? *below.other : below);
    }
    if (!entry.entries.empty()) {
      problems_.push_back({entry.where(), "has keys below it where a value is due", "write the value"});
      return;
    }
    if (rule.use != Use::dropped || !entry.value.empty()) value(entry, rule);
    if (rule.use == Use::dropped) dropped.push_back({&entry, rule.why});
  }

  /// Of a value: what is wrong with it, and is it 0, false or empty?
  struct Reading {
    std::optional<ValueError> error = {};
    bool off = false;
  };

  Reading number(const Entry& entry, Kind kind) const {
    const bool whole = kind == Kind::integer || kind == Kind::count;
    const ReadNumber number = whole ? read_integer(entry.value, dialect_) : read_number(entry.value, dialect_);
    if (!number.error && number.value < 0 && (kind == Kind::count || kind == Kind::amount))
      return {ValueError{fmt::format("`{}` is below 0", entry.value), "write a number that is not"}};
    return {number.error, number.value == 0};
  }

  Reading axes(const Entry& entry) const {
    const ReadVector vector = read_vector(entry.value, dialect_, read_integer);
    if (vector.error || vector.values.size() == 3) return {vector.error};
    return {ValueError{fmt::format("has {} components", vector.values.size()),
                       "write three, (0, 0, 1) for the direction z"}};
  }

  Reading reading(const Entry& entry, Kind kind) const {
    switch (kind) {
      case Kind::number:
      case Kind::amount:
      case Kind::integer:
      case Kind::count:
        return number(entry, kind);
      case Kind::flag: {
        const ReadFlag flag = read_flag(entry.value, dialect_);
        return {flag.error, !flag.value};
      }
      case Kind::vector: {
        const ReadVector vector = read_vector(entry.value, dialect_);
        return {vector.error, std::all_of(vector.values.begin(), vector.values.end(), [](double v) { return v == 0; })};
      }
      case Kind::axes:
        return axes(entry);
      default:
        return {{}, entry.value.empty()};
    }
  }

  void value(const Entry& entry, const KeyRule& rule) {
    auto [error, off] = reading(entry, rule.kind);
    if ((rule.kind == Kind::text || rule.kind == Kind::path) && rule.use == Use::used && off)
      error = ValueError{"has no value", "write it, or remove the key"};
    if (error)
      problems_.push_back({entry.where(), error->what, error->remedy});
    else if (rule.use == Use::refused && off)
      dropped.push_back({&entry, "switched off, and not in tunica"});
    else if (rule.use == Use::refused)
      missing(entry, rule.why);
  }

  void missing(const Entry& entry, const char* physics) {
    problems_.push_back({entry.where(), fmt::format("asks for what tunica does not have: {}", physics),
                         "remove the key to compute without it"});
  }

  Dialect dialect_;
  std::vector<Problem>& problems_;
};

class Unread {
 public:
  explicit Unread(const std::vector<Dropped>& dropped) {
    for (const Dropped& key : dropped) reported_.insert(key.entry);
  }

  void look(const Entry& section) {
    for (const Entry& below : section.entries) {
      // svSolver's own files have been read where their keys became those of solver.xml.
      if (below.key == svpre_commands || below.key == svsolver_settings) continue;
      if (below.read)
        look(below);
      else if (!is_reported(below))
        found.push_back({&below, "without effect here"});
    }
  }

  std::vector<Dropped> found;

 private:
  /// The key, or all that is in the section.
  bool is_reported(const Entry& entry) const {
    if (entry.entries.empty()) return reported_.contains(&entry);
    return std::all_of(entry.entries.begin(), entry.entries.end(), [&](const Entry& e) { return is_reported(e); });
  }

  std::set<const Entry*> reported_;
};

}  // namespace

std::vector<Dropped> unread_entries(const PeerFile& file, const std::vector<Dropped>& dropped) {
  Unread unread(dropped);
  unread.look(file.root);
  return std::move(unread.found);
}

std::vector<Dropped> check_vocabulary(PeerFile& file, std::vector<Problem>& problems) {
  Check check(file.dialect, problems);
  check.section(file.root, whole_file);
  return std::move(check.dropped);
}

}  // namespace tunica::peer_cases
