#include "version.hpp"

#include <fmt/format.h>

#include "commit.hpp"  // written by cmake/write_commit.cmake with every build
#include "tunica/artifacts/libraries.hpp"

namespace tunica::app {

const char* version() { return TUNICA_VERSION; }
const char* commit() { return TUNICA_COMMIT; }

std::string version_text() {
  std::string text = fmt::format("tunica {}\ncommit {}\n", version(), commit());
  for (const auto& [name, number] : artifacts::libraries()) text += fmt::format("{} {}\n", name, number);
  return text + "instruction set " + artifacts::instruction_set();
}

}  // namespace tunica::app
