#include "tunica/stages/hash.hpp"

#include <fmt/format.h>

namespace tunica::stages {

std::string hex(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

}  // namespace tunica::stages
