// `tunica mesh --preview`: what will be meshed, before anything that takes time.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tunica/case/mesh_settings.hpp"
#include "tunica/files/phases.hpp"

namespace tunica::stages {

struct Preview {
  std::string text;                   ///< a table for the terminal
  std::string page;                   ///< HTML that needs no other file
  std::vector<std::uint8_t> picture;  ///< the lumen with its ends and tears, PNG
};

/// The lumen surface with its openings, the tears and sides that the labels of an image have, and the outer surface
/// where one is given; no wall is grown and nothing is remeshed. Errors as of `meshing::surfaces_of` and
/// `geometry::find_openings`.
Preview preview(const case_file::MeshCase& mesh_case, const files::Say& say);

/// Writes it as preview.html and preview.png into the folder of the mesh; returns its text. InputError when these
/// cannot be written.
std::string preview_to_files(const case_file::MeshCase& mesh_case, const files::Say& say);

}  // namespace tunica::stages
