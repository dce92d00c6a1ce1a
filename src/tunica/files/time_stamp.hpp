// The present instant, for files that say when something was done.
#pragma once

#include <string>

namespace tunica::files {

/// Coordinated universal time, such as 2026-01-31T12:00:00Z.
std::string time_stamp();

}  // namespace tunica::files
