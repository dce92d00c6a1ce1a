// All keys of solver.xml and of svFSI's .inp files, and what becomes of each.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "tunica/base/error.hpp"
#include "tunica/peer_cases/entry.hpp"

namespace tunica::peer_cases {

enum class Kind {
  text,
  path,
  number,
  amount,  ///< a number that is not below 0
  integer,
  count,  ///< an integer that is not below 0
  flag,
  vector,
  axes,  ///< three integers, those of the axes that are meant not 0
  section
};

enum class Use {
  used,     ///< the translation looks at it
  dropped,  ///< has no effect on the result, or none that tunica has a key for; listed
  refused   ///< physics that tunica does not have, unless it is off: false, 0 or empty
};

struct KeyRule;

/// The keys of a section. `loose`: any other key is taken, too, for parts of the peer that are refused as a whole.
struct SectionRule {
  std::span<const KeyRule> keys;
  bool loose = false;
  const char* other_label = "";        ///< a section of that label ...
  const SectionRule* other = nullptr;  ///< ... has these keys
};

struct KeyRule {
  const char* key;
  Kind kind;
  Use use;
  const char* why = "";                ///< what takes its place, or the physics that is missing
  const SectionRule* below = nullptr;  ///< of a section
  bool repeats = false;                ///< may it stand there more than once?
};

extern const SectionRule whole_file;
/// Of svSolver, in files of their own.
extern const SectionRule svpre_section, svsolver_section;

/// A key that the case file does not take over as it is.
struct Dropped {
  const Entry* entry;
  const char* why;
};

/// Holds every key of the file against the vocabulary: unknown ones, one that stands twice with two values, values
/// that do not read, physics that is missing. Keys get the letters of the vocabulary where they differ by case alone,
/// as .inp files may. Returns the dropped keys; they point into `file`.
std::vector<Dropped> check_vocabulary(PeerFile& file, std::vector<Problem>& problems);

/// What the translation of the file, when it is through, has not looked at, of a section that it has not looked at the
/// section alone; without `dropped`.
std::vector<Dropped> unread_entries(const PeerFile& file, const std::vector<Dropped>& dropped);

}  // namespace tunica::peer_cases
