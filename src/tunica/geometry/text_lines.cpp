#include "tunica/geometry/text_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "tunica/base/error.hpp"

namespace tunica::geometry {

namespace {

template <class Number>
bool read_number(std::string_view word, Number& value) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size();
}

}  // namespace

std::optional<double> number_of(std::string_view word) {
  double value = 0;
  return read_number(word, value) ? std::optional(value) : std::nullopt;
}

std::string shown(std::string_view word) {
  constexpr std::size_t longest = 40;
  std::string text;
  for (const char c : word.substr(0, longest)) text += c < 0x20 || c == 0x7f ? '?' : c;
  return word.size() > longest ? text + "..." : text;
}

bool TextLines::next() {
  constexpr std::string_view blank = " \t\r\f\v";
  words_.clear();
  if (at_ >= text_.size()) return false;
  for (bool joined = true; joined && at_ < text_.size();) {
    ++number_;
    const auto end = std::min(text_.find('\n', at_), text_.size());
    auto line = text_.substr(at_, end - at_);
    at_ = std::min(end + 1, text_.size());
    const auto last = line.find_last_not_of(blank);
    line = line.substr(0, last == std::string_view::npos ? 0 : last + 1);
    joined = line.ends_with('\\');
    if (joined) line.remove_suffix(1);
    for (auto begin = line.find_first_not_of(blank); begin != std::string_view::npos;) {
      const auto stop = std::min(line.find_first_of(blank, begin), line.size());
      words_.push_back(line.substr(begin, stop - begin));
      begin = line.find_first_not_of(blank, stop);
    }
  }
  return true;
}

double TextLines::real(std::size_t i) const {
  double value = 0;
  if (i >= words_.size()) refuse("a number is missing");
  if (!read_number(words_[i], value)) refuse(fmt::format("'{}' is no number", shown(words_[i])));
  return value;
}

std::int64_t TextLines::integer(std::string_view word) const {
  std::int64_t value = 0;
  if (!read_number(word, value)) refuse(fmt::format("'{}' is no whole number", shown(word)));
  return value;
}

void TextLines::refuse(const std::string& what) const {
  throw InputError(fmt::format("{}:{}", where_, number_), what, "export or copy the surface again");
}

}  // namespace tunica::geometry
