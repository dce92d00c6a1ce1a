// The file of `tunica synthesise`: an idealised dissection and how it is imaged.
#pragma once

#include <filesystem>
#include <string>

#include "tunica/base/boxed.hpp"
#include "tunica/config/schema.hpp"
#include "tunica/imaging/scan_settings.hpp"

namespace tunica::geometry {
struct ParametricDissection;  // geometry/parametric_dissection.hpp
}

namespace tunica::stages {

struct ScanCase {
  Boxed<geometry::ParametricDissection> parametric;
  imaging::ScanSettings scan;
  std::filesystem::path output;

  static config::Schema<ScanCase> schema();
};

/// Throws InputError with all problems.
config::Parsed<ScanCase> read_scan_case(const std::filesystem::path& file);

/// Writes the image and returns the section `geometry` of a file of `tunica mesh` for it, with the names of the vessel
/// ends. InputError when the image exists and `overwrite` is false; errors of `write_label_image`.
std::string scan_to_file(const ScanCase& scan_case, bool overwrite);

}  // namespace tunica::stages
