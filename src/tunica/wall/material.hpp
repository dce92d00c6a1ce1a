// The list of wall laws. A new law is a file in materials/ and an entry here.
#pragma once

#include <variant>

#include "tunica/wall/materials/neo_hooke.hpp"

namespace tunica::wall {

using Law = std::variant<NeoHooke>;

}  // namespace tunica::wall
