// The formats of image files, one reader and one writer each; `label_image.hpp` chooses among them.
#pragma once

#include <filesystem>

#include "tunica/imaging/label_image.hpp"
#include "tunica/imaging/value_image.hpp"

namespace tunica::imaging {

LabelImage read_nrrd(const std::filesystem::path& path);
LabelImage read_metaimage(const std::filesystem::path& path);
LabelImage read_nifti(const std::filesystem::path& path);

ValueImage open_nrrd(const std::filesystem::path& path);
ValueImage open_metaimage(const std::filesystem::path& path);
ValueImage open_nifti(const std::filesystem::path& path);

void write_nrrd(const LabelImage& image, const std::filesystem::path& path);
void write_metaimage(const LabelImage& image, const std::filesystem::path& path);
void write_nifti(const LabelImage& image, const std::filesystem::path& path);

/// Size and steps as a format gives them, checked: three axes of at least two voxels, no more of them than an image
/// can have, and steps and origin that are finite and span the space. `columns` [m] are the steps.
ImageFrame checked_frame(const Size3& size, const std::array<Vec3<double>, 3>& columns, const Point& origin,
                         const std::filesystem::path& path);

/// Throws InputError for numbers of values, times and components that no series has: their product is a size of memory.
void check_counts(const ValueImage& image);

}  // namespace tunica::imaging
