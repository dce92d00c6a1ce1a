// The formats of image files, one reader and one writer each; `label_image.hpp` chooses among them.
#pragma once

#include <filesystem>
#include <string>

#include "tunica/imaging/label_image.hpp"

namespace tunica::imaging {

LabelImage read_nrrd(const std::filesystem::path& path);
LabelImage read_metaimage(const std::filesystem::path& path);
LabelImage read_nifti(const std::filesystem::path& path);

void write_nrrd(const LabelImage& image, const std::filesystem::path& path);
void write_metaimage(const LabelImage& image, const std::filesystem::path& path);
void write_nifti(const LabelImage& image, const std::filesystem::path& path);

/// Values of an image as the bytes of a file hold them.
enum class ValueType { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

/// Turns `bytes` into labels. InputError when there are too few, or values that are no labels.
std::vector<std::int16_t> labels_from_bytes(const std::string& bytes, ValueType type, bool big_endian,
                                            std::int64_t count, const std::filesystem::path& path);
/// One value as a label; InputError when it is none.
std::int16_t label_from_value(double value, std::int64_t index, const std::filesystem::path& path);
std::string bytes_from_labels(const std::vector<std::int16_t>& labels);  ///< little-endian

/// Size and steps as a format gives them, checked: three axes of at least two voxels, finite, spacing above zero.
/// `columns` [m] are the steps.
ImageFrame checked_frame(const Size3& size, const std::array<Vec3<double>, 3>& columns, const Point& origin,
                         const std::filesystem::path& path);

}  // namespace tunica::imaging
