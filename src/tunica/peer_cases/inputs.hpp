// The files that an input file of the peers consists of.
#pragma once

#include <filesystem>

#include "tunica/peer_cases/entry.hpp"

namespace tunica::peer_cases {

/// Is that file, which need not be there, the input file itself, a part of it, or one that a key names?
bool is_input(const PeerFile& file, const std::filesystem::path& path);

}  // namespace tunica::peer_cases
