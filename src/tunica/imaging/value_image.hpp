// Images of numbers, such as velocities: one or several values a voxel, one or several times in a file.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "tunica/imaging/label_image.hpp"
#include "tunica/imaging/voxel_data.hpp"

namespace tunica::imaging {

/// The header of an image file and its values, which are read one volume after the other.
struct ValueImage {
  ImageFrame frame;
  std::int64_t per_voxel = 1;   ///< values that stand side by side for each voxel
  std::int64_t times = 1;       ///< volumes
  std::int64_t components = 1;  ///< sets of so many volumes, one after the other
  double time_step = 0;         ///< between two of them, as the header states it [s]; 0: it does not
  ValueFormat format;
  std::filesystem::path path;
  std::unique_ptr<DataStream> data;  ///< at the first value

  /// `per_voxel` times as many values as the frame has voxels, x fastest. InputError when there are fewer, and for
  /// values that are no numbers.
  std::vector<float> next_volume();
};

/// Opens a NRRD, MetaImage or NIfTI file of three dimensions, or of four or five for times and vectors. InputError as
/// read_label_image(), and for data that stand in the file as text.
ValueImage open_value_image(const std::filesystem::path& path);

/// Writes volumes of one value a voxel as a 4D NIfTI file of floats (.nii or .nii.gz), `time_step` [s] apart.
/// InputError for another ending, SolverError when it cannot be written.
void write_value_series(const ImageFrame& frame, const std::vector<std::vector<float>>& volumes, double time_step,
                        const std::filesystem::path& path);

}  // namespace tunica::imaging
