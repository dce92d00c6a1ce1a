// What this program was built with.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace tunica::artifacts {

/// Name and version of the large libraries, and of the compiler.
std::vector<std::pair<std::string, std::string>> libraries();

/// "avx512": that the hot loops of this process run on. Throws as assembly::choose_isa().
std::string instruction_set();

}  // namespace tunica::artifacts
