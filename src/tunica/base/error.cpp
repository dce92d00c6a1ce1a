#include "tunica/base/error.hpp"

#include <fmt/format.h>

namespace tunica {

std::string format(const Problem& problem) {
  return fmt::format("{}: {}\n    remedy: {}", problem.where, problem.what, problem.remedy);
}

namespace {
std::string join(const std::vector<Problem>& problems) {
  std::string text = fmt::format("{} problem{} in the input:", problems.size(), problems.size() == 1 ? "" : "s");
  for (const auto& problem : problems) text += "\n  " + format(problem);
  return text;
}
}  // namespace

InputError::InputError(std::vector<Problem> problems)
    : std::runtime_error(join(problems)), problems_(std::move(problems)) {}

}  // namespace tunica
