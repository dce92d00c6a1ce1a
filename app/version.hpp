// What this program was built from.
#pragma once

#include <string>

namespace tunica::app {

const char* version();
/// Commit of the source tree when it was compiled, with "-dirty" when files had been changed; "unknown" outside git.
const char* commit();

/// Version, commit, libraries, compiler and instruction set, a line for each.
std::string version_text();

}  // namespace tunica::app
