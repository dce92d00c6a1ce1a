#include "tunica/peer_cases/values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <string>

#include "tunica/base/text.hpp"

namespace tunica::peer_cases {

namespace {

std::optional<double> plain_number(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (failure != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace

ReadNumber read_number(std::string_view text, Dialect dialect) {
  if (const auto value = plain_number(text)) return {*value};
  if (const std::string other = text::decimal_exponent(text); other != text) {
    const auto value = plain_number(other);
    if (value && dialect != Dialect::xml) return {*value};
    if (value)
      return {0.0, ValueError{fmt::format("`{}` is read as {} by svMultiPhysics, which stops in front of the D", text,
                                          text.substr(0, text.find_first_of("dD"))),
                              fmt::format("write {} for what it seems to mean", other)}};
  }
  if (text.empty()) return {0.0, ValueError{"has no value", "write a number, or remove the key"}};
  return {0.0, ValueError{fmt::format("`{}` is no number", text::printable(text)),
                          "write one number with a decimal point and nothing behind it"}};
}

ReadNumber read_integer(std::string_view text, Dialect dialect) {
  const ReadNumber number = read_number(text, dialect);
  if (number.error) return number;
  std::string_view digits = text;
  if (digits.starts_with('+')) digits.remove_prefix(1);
  int value = 0;
  const auto [end, failure] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (failure == std::errc::result_out_of_range)
    return {0.0, ValueError{fmt::format("`{}` is beyond the integers of the peers", text),
                            fmt::format("write at most {}", std::numeric_limits<int>::max())}};
  if (failure == std::errc() && end == digits.data() + digits.size()) return {static_cast<double>(value)};
  const bool whole = number.value == std::floor(number.value) && std::abs(number.value) < 1e9;
  const std::string remedy =
      whole ? fmt::format("write {:.0f} for what it seems to mean", number.value) : "write digits only";
  if (failure != std::errc() || dialect != Dialect::xml)
    return {0.0, ValueError{fmt::format("`{}` is no whole number in digits", text), remedy}};
  return {0.0, ValueError{fmt::format(
                              "`{}` is no whole number in digits; svMultiPhysics reads {}, stopping in front of the {}",
                              text, value, *end),
                          remedy}};
}

bool holds_fortran_exponents(const std::filesystem::path& file) {
  std::ifstream stream(file);
  for (std::string word; stream >> word;)
    if (text::decimal_exponent(word) != word) return true;
  return false;
}

ReadVector read_vector(std::string_view text, Dialect dialect, ReadNumber (*component)(std::string_view, Dialect)) {
  ReadVector vector;
  std::string plain(text);
  std::replace_if(
      plain.begin(), plain.end(),
      [](char c) { return std::string_view("(){},;\t\r\n").find(c) != std::string_view::npos; }, ' ');
  for (std::size_t at = 0; (at = plain.find_first_not_of(' ', at)) != std::string::npos;) {
    const auto end = std::min(plain.find(' ', at), plain.size());
    const ReadNumber number = component(std::string_view(plain).substr(at, end - at), dialect);
    if (number.error) return {{}, number.error};
    vector.values.push_back(number.value);
    at = end;
  }
  if (vector.values.empty()) vector.error = ValueError{"has no value", "write numbers, or remove the key"};
  return vector;
}

ReadFlag read_flag(std::string_view text, Dialect dialect) {
  const bool letter = dialect != Dialect::xml;
  const std::string word = letter ? text::lower(text) : std::string(text);
  if (word == "true" || word == "1" || (letter && word == "t")) return {true};
  if (word == "false" || word == "0" || (letter && word == "f")) return {false};
  return {false, ValueError{fmt::format("`{}` is neither true nor false", text::printable(text)),
                            letter ? "write t or f" : "write true or false"}};
}

std::string number_text(double value) { return fmt::format("{}", value); }

}  // namespace tunica::peer_cases
