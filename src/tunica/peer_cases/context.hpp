// What the parts of the translation share.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tunica/base/error.hpp"
#include "tunica/peer_cases/case_text.hpp"
#include "tunica/peer_cases/entry.hpp"
#include "tunica/peer_cases/translate.hpp"
#include "tunica/peer_cases/unit_system.hpp"

namespace tunica::peer_cases {

struct Context {
  const PeerFile& file;
  const UnitSystem& units;
  std::filesystem::path case_folder;
  Findings findings;
  std::vector<Problem> problems = {};
  Remarks remarks = {};
  std::vector<std::string> warnings = {};
  std::optional<NodalPrestress> prestress = {};
  std::optional<InitialState> initial = {};
  std::optional<FibreFiles> fibres = {};
  std::vector<NodalValues> nodal = {};
  std::optional<WallRegions> regions = {};

  /// "svMultiPhysics", "svFSI" or "svSolver".
  const char* peer() const {
    return file.dialect == Dialect::xml ? "svMultiPhysics" : file.dialect == Dialect::inp ? "svFSI" : "svSolver";
  }

  // Values of keys of a section; nothing where the key is not there, or does not read, which has been reported.
  std::optional<double> number(const Entry& section, std::string_view key) const;
  std::vector<double> vector(const Entry& section, std::string_view key) const;
  bool flag(const Entry& section, std::string_view key, bool otherwise = false) const;
  std::string text(const Entry& section, std::string_view key, const std::string& otherwise = "") const;
  /// The entry of a key, as "solver.xml:31 Density"; `otherwise` where it is not there.
  std::string source(const Entry& section, std::string_view key, const std::string& otherwise = "") const;

  /// "1.06 g/cm^3", the digits as they stand in the file.
  std::string quantity(const Entry& entry, const char* unit) const;
  /// A path of the file, from the folder of the case; warns when nothing is there.
  std::string path(const Entry& entry);
  /// Where it lies.
  std::filesystem::path located(const Entry& entry) const;

  /// Adds the number of a key of the peer to the case; an error where it is not there.
  void add_required(const Entry& section, const char* key, const char* unit, CaseKey& to, const char* name);

  void refuse(const Entry& entry, std::string what, std::string remedy) {
    problems.push_back({entry.where(), std::move(what), std::move(remedy)});
  }
  void missing(const Entry& entry, const std::string& physics, std::string remedy) {
    refuse(entry, "asks for what tunica does not have: " + physics, std::move(remedy));
  }
  void changed(const Entry& entry, const std::string& what) { remarks.changed.push_back(entry.where() + ": " + what); }
  void defaulted(const Entry& section, std::string_view key, const std::string& what);
};

/// Name of the face of what no other face holds.
inline const char* rest_face(bool lumen) { return lumen ? "lumen_rest" : "wall_rest"; }

/// The number as a quantity.
std::string with_unit(double value, const char* unit);

}  // namespace tunica::peer_cases
