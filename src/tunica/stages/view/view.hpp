// `tunica view`: the beat in 3D, with its curves, as one page that needs nothing else.
#pragma once

#include <filesystem>

#include "tunica/files/phases.hpp"
#include "tunica/viewer/pack.hpp"

namespace tunica::stages {

struct ViewRequest {
  std::filesystem::path case_file;  ///< of the run
  std::filesystem::path results;    ///< folder of its fields
  std::filesystem::path post;       ///< folder of its figures; empty or without post.json: none
  std::filesystem::path output;     ///< .html
  bool overwrite = false;
  viewer::PackOptions packing{};
};

/// Writes the page. Throws InputError when it is there and `overwrite` is false, or mesh, fields or tables do not read;
/// SolverError when it cannot be written. Not collective: for one rank.
void write_view(const ViewRequest& request, const files::Say& say);

}  // namespace tunica::stages
