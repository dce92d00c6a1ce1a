// tunica import: a case file from an input file of svMultiPhysics or svFSI.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tunica::stages {

struct ImportRequest {
  std::filesystem::path file;       ///< solver.xml, .inp, or a folder with one of them
  std::filesystem::path case_file;  ///< to be written
  std::string units;                ///< cgs, mmgs or si
  bool overwrite = false;
};

struct ImportOutcome {
  std::vector<std::string> dropped, changed, defaults, warnings;
  bool unchanged = false;  ///< was the case file there already, as it would be written?
};

/// Writes the case file. Throws InputError with all that is wrong with the file or beyond tunica, and where another
/// file stands under that name and `overwrite` is not set. Meshes that are there are read, for boundary that no face
/// holds. Not collective.
ImportOutcome import_case(const ImportRequest& request);

}  // namespace tunica::stages
