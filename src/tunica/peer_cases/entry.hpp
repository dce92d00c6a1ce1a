// An input file of svMultiPhysics (solver.xml) or svFSI (.inp) as a tree of keys, in the names of solver.xml whichever
// of the two it is. Both readers make the same value of the same problem.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace tunica::peer_cases {

/// A key with its value, or a section with what is in it.
struct Entry {
  std::string key;                  ///< Number_of_time_steps
  std::string label;                ///< of a section: the name of a mesh, face or law, the type of an equation
  std::string value;                ///< without blanks around; empty for a section
  std::string file = {};            ///< name of the file that it stands in
  int line = 0;                     ///< there, from 1
  bool section = false;             ///< are there keys below it, or may there be?
  std::vector<Entry> entries = {};  ///< of a section, in the order of the file
  mutable bool read = false;        ///< has a lookup found it? What none has is of no effect, and reported

  /// "solver.xml:31 Density".
  std::string where() const;
  /// The first entry of that key; none: nullptr. This and all() mark what they find as read: to be asked only where the
  /// answer has an effect.
  const Entry* find(std::string_view wanted) const;
  /// As find(), without a mark.
  const Entry* peek(std::string_view wanted) const;
  std::vector<const Entry*> all(std::string_view wanted) const;
};

/// Bounds of a file: one with more is not meant as a case.
inline constexpr std::size_t deepest_section = 32, most_entries = 1e5;

/// What numbers and truth values look like: those of the program that reads the file.
enum class Dialect { xml, inp, svsolver };

struct PeerFile {
  std::filesystem::path path;
  Dialect dialect = Dialect::xml;
  Entry root;  ///< GeneralSimulationParameters, Add_mesh, Add_projection, Add_equation, ...
};

/// A solver.xml, an .inp file, the .svpre of an svSolver simulation, or a folder that holds one of them; of a
/// SimVascular project (.svproj) also one that lies in a folder of it. Files that it includes are read, too. Throws
/// InputError with file and line where the text is no file of the kind.
PeerFile read_peer_file(const std::filesystem::path& path);

/// Does the name of the file, or what lies in the folder, look like one of these?
bool is_peer_file(const std::filesystem::path& path);

/// The two readers, of a text; `path` is for messages and for files that it includes.
PeerFile read_xml(const std::string& text, const std::filesystem::path& path);
PeerFile read_inp(const std::string& text, const std::filesystem::path& path);

}  // namespace tunica::peer_cases
