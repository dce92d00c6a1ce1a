#include "tunica/files/named_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <utility>

namespace tunica::files {

namespace {

using Names = std::vector<std::string>;

constexpr long most_numbers = 100000;  ///< files of one numbered name
constexpr std::size_t longest_line = 1 << 16;

std::string trimmed(const std::string& text) {
  const char* blank = " \t\r\n";
  const auto first = text.find_first_not_of(blank);
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(blank) - first + 1);
}

/// Lower case, without blanks.
std::string key_of(const std::string& text) {
  std::string key;
  for (const unsigned char c : text)
    if (!std::isspace(c)) key += static_cast<char>(std::tolower(c));
  return key;
}

Names words_of(const std::string& text) {
  std::istringstream stream(text);
  Names words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

/// The rest of a header: one name in each line.
Names listed_files(std::istream& stream) {
  Names names;
  for (std::string line; std::getline(stream, line);)
    if (const std::string name = trimmed(line); !name.empty()) names.push_back(name);
  return names;
}

/// "slice%03d.raw" with the number k in the place of the conversion; the text itself where there is none.
std::string numbered(const std::string& pattern, long k) {
  const auto percent = pattern.find('%');
  const auto end = pattern.find_first_not_of("0123456789", percent + 1);
  if (percent == std::string::npos || end == std::string::npos || (pattern[end] != 'd' && pattern[end] != 'i'))
    return pattern;
  const std::string width = pattern.substr(percent + 1, end - percent - 1);
  const auto digits = static_cast<int>(std::min(std::strtol(width.c_str(), nullptr, 10), 100L));
  const std::string number =
      width.starts_with('0') ? fmt::format("{:0{}}", k, digits) : fmt::format("{:{}}", k, digits);
  return pattern.substr(0, percent) + number + pattern.substr(end + 1);
}

/// "slice%03d.raw 1 40 1": first and last number, and the step, which may be left out.
Names numbered(const Names& words) {
  Names names;
  const long first = std::strtol(words[1].c_str(), nullptr, 10), last = std::strtol(words[2].c_str(), nullptr, 10);
  const long given = words.size() > 3 ? std::strtol(words[3].c_str(), nullptr, 10) : 1;
  const long step = given != 0 ? given : 1;
  for (long k = first; (step > 0 ? k <= last : k >= last) && std::ssize(names) < most_numbers; k += step)
    names.push_back(numbered(words[0], k));
  return names;
}

/// What the field of a header says that names the data.
Names data_files(const std::string& value, std::istream& rest) {
  const Names words = words_of(value);
  if (words.empty()) return {};
  if (words[0] == "LIST") return listed_files(rest);
  if (words.size() > 2 && words[0].find('%') != std::string::npos) return numbered(words);
  return {value};  // a name may hold blanks
}

Names nrrd_names(std::istream& stream) {
  for (std::string line; std::getline(stream, line) && line.size() < longest_line;) {
    if (trimmed(line).empty()) break;  // the data follow
    const auto colon = line.find(':');
    if (colon == std::string::npos || line.starts_with('#')) continue;
    if (key_of(line.substr(0, colon)) == "datafile") return data_files(trimmed(line.substr(colon + 1)), stream);
  }
  return {};
}

Names metaimage_names(std::istream& stream) {
  for (std::string line; std::getline(stream, line) && line.size() < longest_line;) {
    const auto equals = line.find('=');
    if (equals == std::string::npos || key_of(line.substr(0, equals)) != "elementdatafile") continue;
    const std::string value = trimmed(line.substr(equals + 1));
    return value == "LOCAL" ? Names{} : data_files(value, stream);
  }
  return {};
}

std::string without_entities(std::string text) {
  constexpr std::array<std::pair<const char*, char>, 5> entities{
      {{"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}, {"&amp;", '&'}}};
  for (const auto& [entity, character] : entities)
    for (auto at = text.find(entity); at != std::string::npos; at = text.find(entity, at + 1))
      text.replace(at, std::string_view(entity).size(), 1, character);
  return text;
}

/// Values of the attributes `file` and `Source` of an XML file.
Names xml_names(std::istream& stream) {
  std::ostringstream all;
  all << stream.rdbuf();
  const std::string text = all.str();
  Names names;
  for (auto equals = text.find('='); equals != std::string::npos; equals = text.find('=', equals + 1)) {
    const bool is_file = equals >= 5 && key_of(text.substr(equals - 5, 5)) == "file",
               is_source = equals >= 7 && key_of(text.substr(equals - 7, 7)) == "source";
    const char quote = equals + 1 < text.size() ? text[equals + 1] : '\0';
    if ((!is_file && !is_source) || (quote != '"' && quote != '\'')) continue;
    const auto end = text.find(quote, equals + 2);
    if (end == std::string::npos) break;
    if (end > equals + 2) names.push_back(without_entities(text.substr(equals + 2, end - equals - 2)));
  }
  return names;
}

/// The values of the keys "name" of a list of instants (JSON).
Names series_names(std::istream& stream) {
  std::ostringstream all;
  all << stream.rdbuf();
  const std::string text = all.str(), key = "\"name\"";
  Names names;
  for (auto at = text.find(key); at != std::string::npos; at = text.find(key, at)) {
    const auto begin = text.find('"', at + key.size()), end = text.find('"', begin + 1);
    if (begin == std::string::npos || end == std::string::npos) break;
    names.push_back(text.substr(begin + 1, end - begin - 1));
    at = end;
  }
  return names;
}

}  // namespace

Names named_files(const std::filesystem::path& file) {
  const std::string kind = key_of(file.extension().string());
  const auto is = [&](std::initializer_list<const char*> kinds) {
    return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
  };
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return {};
  if (is({".nhdr", ".nrrd"})) return nrrd_names(stream);
  if (is({".mhd", ".mha"})) return metaimage_names(stream);
  if (is({".series"})) return series_names(stream);
  if (is({".pvd", ".pvtu", ".pvtp", ".vtm"})) return xml_names(stream);
  return {};
}

}  // namespace tunica::files
