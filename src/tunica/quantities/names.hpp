// Names of the quantities, for those that choose among them without computing any.
#pragma once

#include <string>
#include <vector>

namespace tunica::quantities {

/// Keys of all, in the order in which results have them.
std::vector<std::string> keys();

/// For each of `keys()`: is it written where a case names no fields?
std::vector<bool> standard();

}  // namespace tunica::quantities
