// The existing name that a misspelt one most likely meant.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace tunica::config {

/// Name with the smallest edit distance (insert, delete, replace, swap of neighbours; case counts half), when it is at
/// most a third of the letters (at least 1); else empty. The first of equally near ones.
std::string nearest(std::string_view wanted, std::span<const std::string> existing);

}  // namespace tunica::config
