// Velocity series from image files.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <vector>

#include "tunica/config/schema.hpp"
#include "tunica/flow_imaging/velocity_series.hpp"

namespace tunica::flow_imaging {

/// Files of a series. A name with * stands for the frames one by one, in the order of the numbers in their names; a
/// file may also hold all frames (4D).
struct SeriesFiles {
  enum class Axes {
    patient,  ///< x to the left, y to the back, z to the head
    image     ///< those of the voxels: columns, rows, slices
  };
  std::optional<std::filesystem::path> x, y, z;  ///< one component each
  std::optional<std::filesystem::path> field;    ///< or all three, of each voxel
  std::optional<std::filesystem::path> magnitude;
  double unit = 1.0;               ///< m/s of 1 in the files
  std::optional<double> encoding;  ///< m/s; none: nothing has wrapped
  double period = 0;               ///< s
  std::vector<double> times;       ///< s; empty: those that headers state, else equal parts of the period
  Axes axes = Axes::patient;
  std::array<double, 3> signs{1, 1, 1};  ///< of the components

  static config::Schema<SeriesFiles> schema();
};

/// Files that a name stands for: itself, or with one * all that are named so, in the order of their numbers. Throws
/// InputError when there is none, and as in_order_of_numbers(). `item`: what each of them is called in messages.
std::vector<std::string> files_of_frames(const std::filesystem::path& path, const std::string& where,
                                         const std::string& item = "frame");

/// Reads NIfTI, NRRD and MetaImage files. `where`: of the section, for messages. Throws InputError for files that do
/// not read or have other voxels than the first one, components with different numbers of frames, frames out of order,
/// and velocities that are none of blood in that unit.
VelocitySeries read_series(const SeriesFiles& files, const std::string& where);

/// Writes velocity_x.nii.gz, velocity_y, velocity_z, along the encoded axes [m/s], and magnitude.nii.gz into a folder.
void write_series(const VelocitySeries& series, const std::filesystem::path& folder);

}  // namespace tunica::flow_imaging
