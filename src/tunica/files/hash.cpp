#include "tunica/files/hash.hpp"

#include <fmt/format.h>

namespace tunica::files {

std::string hex(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

}  // namespace tunica::files
