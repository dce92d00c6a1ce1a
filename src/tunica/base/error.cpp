#include "tunica/base/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "tunica/base/text.hpp"

namespace tunica {

std::string format(const Problem& problem) {
  return fmt::format("{}: {}\n    remedy: {}", problem.where, problem.what, problem.remedy);
}

namespace {
/// A damaged file is quoted here and there: nothing of it may give orders to a terminal. Lines stay lines.
std::string harmless(const std::string& message) {
  std::string result;
  for (std::size_t begin = 0; begin <= message.size();) {
    const auto end = std::min(message.find_first_of("\n\t", begin), message.size());
    result += text::printable(std::string_view(message).substr(begin, end - begin), message.max_size());
    if (end < message.size()) result += message[end];
    begin = end + 1;
  }
  return result;
}

std::string join(const std::vector<Problem>& problems) {
  std::string text = fmt::format("{} problem{} in the input:", problems.size(), problems.size() == 1 ? "" : "s");
  for (const auto& problem : problems) text += "\n  " + format(problem);
  return harmless(text);
}
}  // namespace

InputError::InputError(std::vector<Problem> problems)
    : std::runtime_error(join(problems)), problems_(std::move(problems)) {}

}  // namespace tunica
