#include "tunica/files/time_stamp.hpp"

#include <fmt/chrono.h>

#include <ctime>

namespace tunica::files {

std::string time_stamp() { return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr))); }

}  // namespace tunica::files
