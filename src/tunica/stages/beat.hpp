// What a page shows in 3D of a run: its fields on the surfaces of the mesh and on sections of the vessel.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "tunica/files/phases.hpp"
#include "tunica/viewer/beat.hpp"

namespace tunica::stages {

/// Where a run and its figures lie.
struct BeatSource {
  std::filesystem::path case_file;  ///< of the run
  std::filesystem::path results;    ///< folder of its fields
  nlohmann::json post;              ///< post.json, or null: then there are no sections, and all fields are shown
};

/// Fields that a page shows at most; of longer series every so many.
inline constexpr std::size_t most_frames = 64;

/// Reads mesh and fields of the window of the figures. Displacement [mm]; of the wall stresses [kPa], averages of the
/// elements around a node by volume, and thickness [mm]; of the blood pressure [mmHg], velocity [m/s], wall shear
/// stress, TAWSS [Pa], OSI, RRT [1/Pa]. Throws InputError where mesh or fields do not read. Not collective: for one
/// rank.
viewer::Beat collect_beat(const BeatSource& source, const files::Say& say);

/// Curves over the beat and along the aorta, from the tables of a run and of its figures: those whose tables are there.
/// `post`: folder, may be empty. Openings have the same style in all of them. Throws InputError for tables that do not
/// read. Not collective.
std::vector<viewer::Plot> collect_plots(const BeatSource& source, const std::filesystem::path& post);

}  // namespace tunica::stages
