// From a peer's problem to a case file of tunica.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tunica/base/error.hpp"
#include "tunica/peer_cases/entry.hpp"
#include "tunica/peer_cases/unit_system.hpp"

namespace tunica::peer_cases {

/// What the case file says otherwise than the peer's file, key by key.
struct Remarks {
  std::vector<std::string> dropped;   ///< keys without a counterpart, by the reason
  std::vector<std::string> changed;   ///< taken over with another meaning or value
  std::vector<std::string> defaults;  ///< not written there: the peer's default, or that of tunica in its place
};

/// A prestress at the nodes of the wall, in a file of the peer; the case names a file of elements that is to be made of
/// it.
struct NodalPrestress {
  std::filesystem::path file;
  std::string elements_file;  ///< in the folder of the case
};

struct Translation {
  std::string yaml;  ///< with the remarks at its head and the place of every key behind it
  Remarks remarks;
  std::vector<std::string> warnings;  ///< files that are not there, values that look like slips
  std::optional<NodalPrestress> prestress = {};
};

/// Has the boundary of a mesh parts that none of its faces holds? They get natural conditions.
struct Leftover {
  bool lumen = false, wall = false;
};

/// The case file that poses the problem of `file`, for a file in `case_folder`: paths count from there. Files that it
/// names need not be there; where they are, what hangs on them is looked up.
/// Throws InputError with all that is wrong, unknown or beyond tunica, each with key and line.
Translation translate(PeerFile file, const UnitSystem& units, const std::filesystem::path& case_folder,
                      const Leftover& leftover = {});

}  // namespace tunica::peer_cases
