#include "tunica/field_io/array_name.hpp"

#include <algorithm>

namespace tunica::field_io {

namespace {

/// "m s^-1" for "m/s". A slash divides by the next symbol only.
std::string without_slash(std::string_view unit) {
  std::string text;
  for (std::size_t at = 0; at < unit.size();) {
    if (unit[at] != '/') {
      text += unit[at++];
      continue;
    }
    const auto begin = unit.find_first_not_of(" \t/", at);
    if (begin == std::string_view::npos) break;
    at = std::min(unit.find_first_of(" \t*./^", begin), unit.size());
    std::string_view power = "1";
    const auto symbol = unit.substr(begin, at - begin);
    if (at < unit.size() && unit[at] == '^') {
      const auto end = std::min(unit.find_first_of(" \t*./", at), unit.size());
      power = unit.substr(at + 1, end - at - 1);
      at = end;
    }
    text.append(" ").append(symbol).append("^");
    if (power.starts_with('-'))
      power.remove_prefix(1);
    else
      text += '-';
    text.append(power);
  }
  return text;
}

}  // namespace

std::string array_name(std::string_view quantity, std::string_view unit) {
  return std::string(quantity) + " [" + without_slash(unit) + "]";
}

std::pair<std::string, std::string> name_and_unit(const std::string& array) {
  const auto at = array.find(" [");
  if (at == std::string::npos || array.back() != ']') return {array, ""};
  return {array.substr(0, at), array.substr(at + 2, array.size() - at - 3)};
}

}  // namespace tunica::field_io
