#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "tunica/base/text.hpp"
#include "tunica/config/nearest.hpp"
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
      return section(entry, *rule.below);
    }
    if (!entry.entries.empty()) {
      problems_.push_back({entry.where(), "has keys below it where a value is due", "write the value"});
      return;
    }
    if (rule.use != Use::dropped || !entry.value.empty()) value(entry, rule);
    if (rule.use == Use::dropped) dropped.push_back({&entry, rule.why});
  }

  void value(const Entry& entry, const KeyRule& rule) {
    std::optional<ValueError> error;
    bool off = entry.value.empty();
    if (rule.kind == Kind::number || rule.kind == Kind::integer) {
      const ReadNumber number = read_number(entry.value, dialect_);
      error = number.error;
      if (!error && rule.kind == Kind::integer && number.value != std::floor(number.value))
        error = ValueError{fmt::format("`{}` is no whole number", entry.value), "write a whole number"};
      off = number.value == 0;
    } else if (rule.kind == Kind::flag) {
      const ReadFlag flag = read_flag(entry.value, dialect_);
      error = flag.error;
      off = !flag.value;
    } else if (rule.kind == Kind::vector) {
      const ReadVector vector = read_vector(entry.value, dialect_);
      error = vector.error;
      off = std::all_of(vector.values.begin(), vector.values.end(), [](double v) { return v == 0; });
    } else if (rule.use == Use::used && off) {
      error = ValueError{"has no value", "write it, or remove the key"};
    }
    if (error)
      problems_.push_back({entry.where(), error->what, error->remedy});
    else if (rule.use == Use::refused && !off)
      missing(entry, rule.why);
  }

  void missing(const Entry& entry, const char* physics) {
    problems_.push_back({entry.where(), fmt::format("asks for what tunica does not have: {}", physics),
                         "remove the key to compute without it"});
  }

  Dialect dialect_;
  std::vector<Problem>& problems_;
};

}  // namespace

std::vector<Dropped> check_vocabulary(PeerFile& file, std::vector<Problem>& problems) {
  Check check(file.dialect, problems);
  check.section(file.root, whole_file);
  return std::move(check.dropped);
}

}  // namespace tunica::peer_cases
