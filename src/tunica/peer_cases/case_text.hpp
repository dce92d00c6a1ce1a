// The case file that is written: keys, values, and behind each line where it comes from.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace tunica::peer_cases {

/// A key of the case file with a value, or with keys below it.
struct CaseKey {
  std::string key;                  ///< empty: an item of a list
  std::string value;                ///< as YAML; empty for a section
  std::string source;               ///< the comment behind it
  std::vector<CaseKey> below = {};  ///< of a section

  CaseKey& add(std::string name, std::string text, std::string from) {
    below.push_back({std::move(name), std::move(text), std::move(from)});
    return below.back();
  }
  CaseKey& section(std::string name, std::string from) { return add(std::move(name), "", std::move(from)); }
};

/// A text as a YAML scalar, quoted where it has to be.
std::string yaml_text(const std::string& text);

/// The keys below `top` as YAML, with comments in one column.
std::string yaml(const CaseKey& top);

}  // namespace tunica::peer_cases
