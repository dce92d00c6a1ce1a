#include "tunica/imaging/header_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <fstream>
#include <sstream>

#include "tunica/base/error.hpp"

namespace tunica::imaging {

namespace {

constexpr std::size_t longest_header = std::size_t{1} << 20;

/// Numbers of a text; false when a word is none of type T.
template <class T>
bool parse_numbers(std::string text, std::vector<T>& result) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '(' || c == ')' || c == ','; }, ' ');
  for (const auto& word : words(text)) {
    const char* begin = word.data() + (word[0] == '+' ? 1 : 0);
    const char* end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(begin, end, result.emplace_back());
    if (error != std::errc() || stop != end) return false;
  }
  return true;
}

template <class T>
std::vector<T> numbers_of(const TextHeader& header, const std::string& name, std::size_t count, const char* kind) {
  std::vector<T> result;
  if (!parse_numbers(header.need(name), result) || result.size() != count)
    header.refuse(name, fmt::format("must be {} {}{}", count, kind, count == 1 ? "" : "s"),
                  "write the image again as a single three-dimensional one");
  return result;
}

}  // namespace

HeaderLines::HeaderLines(const std::filesystem::path& path) : path_(path), start_(longest_header, '\0') {
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path)) throw InputError(path.string(), "cannot be read", "check the path");
  file.read(start_.data(), static_cast<std::streamsize>(start_.size()));
  start_.resize(static_cast<std::size_t>(file.gcount()));
  whole_ = file.peek() == std::ifstream::traits_type::eof();
}

bool HeaderLines::next() {
  const auto end = start_.find('\n', at_);
  if (end == std::string::npos && !whole_)
    throw InputError(path_.string(), fmt::format("its header does not end within {} bytes", longest_header),
                     "check how it was made");
  if (at_ == start_.size()) return false;
  text_ = trimmed(start_.substr(at_, end == std::string::npos ? end : end - at_));
  at_ = end == std::string::npos ? start_.size() : end + 1;
  ++number_;
  return true;
}

void TextHeader::add(const std::string& name, const std::string& value, std::int64_t line) {
  const auto key = lower(trimmed(name));
  const auto where = fmt::format("{}:{}", path.string(), line);
  if (value.empty())
    throw InputError(where, fmt::format("field '{}' has no value", printable(trimmed(name))),
                     "give it one, or write the image again");
  const auto [field, is_new] = fields.emplace(key, Field{value, line});
  if (!is_new)
    throw InputError(where, fmt::format("field '{}' stands in line {} already", printable(key), field->second.line),
                     "remove one of them");
}

const std::string* TextHeader::find(const std::string& name) const {
  const auto found = fields.find(name);
  return found == fields.end() ? nullptr : &found->second.value;
}

std::string TextHeader::first_of(std::initializer_list<const char*> names) const {
  for (const char* name : names)
    if (find(name)) return name;
  return {};
}

const std::string& TextHeader::need(const std::string& name) const {
  if (const auto* value = find(name)) return *value;
  throw InputError(path.string(), "the header has no field '" + name + "'",
                   "write the image again, with all its header");
}

std::vector<double> TextHeader::numbers(const std::string& name, std::size_t count) const {
  return numbers_of<double>(*this, name, count, "number");
}

std::vector<std::int64_t> TextHeader::whole_numbers(const std::string& name, std::size_t count) const {
  return numbers_of<std::int64_t>(*this, name, count, "whole number");
}

std::vector<double> TextHeader::spacings(const std::string& name) const {
  auto result = numbers(name, 3);
  for (const double spacing : result)
    if (!(spacing > 0)) refuse(name, "spacings are numbers above zero", "write the image again with its voxel spacing");
  return result;
}

void TextHeader::refuse(const std::string& name, const std::string& what, const std::string& remedy) const {
  const auto& field = fields.at(name);
  throw InputError(fmt::format("{}:{}", path.string(), field.line),
                   fmt::format("field '{}' is '{}': {}", name, printable(field.value), what), remedy);
}

std::vector<std::string> words(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> result;
  for (std::string word; stream >> word;) result.push_back(word);
  return result;
}

std::string trimmed(const std::string& text) {
  const char* blank = " \t\r\n\v\f";
  const auto first = text.find_first_not_of(blank);
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(blank) - first + 1);
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

std::string printable(const std::string& text) {
  constexpr std::size_t longest = 60;
  auto shown = text.substr(0, longest);
  std::replace_if(
      shown.begin(), shown.end(), [](unsigned char c) { return c < ' ' || c > '~'; }, '?');
  return text.size() > longest ? shown + "..." : shown;
}

}  // namespace tunica::imaging
