#include "tunica/imaging/label_image.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "tunica/base/error.hpp"
#include "tunica/imaging/header_file.hpp"
#include "tunica/imaging/image_formats.hpp"

namespace tunica::imaging {

namespace {

enum class Format { nrrd, metaimage, nifti };

Format format_of(const std::filesystem::path& path) {
  const auto name = lower(path.filename().string());
  const auto ends = [&](const char* ending) { return name.ends_with(ending); };
  if (ends(".nrrd") || ends(".nhdr")) return Format::nrrd;
  if (ends(".mha") || ends(".mhd")) return Format::metaimage;
  if (ends(".nii") || ends(".nii.gz")) return Format::nifti;
  throw InputError(path.string(), fmt::format("'{}' is no known kind of image file", path.extension().string()),
                   "give a .nrrd, .nhdr, .mha, .mhd, .nii or .nii.gz file");
}

/// Reads values of type T, of either byte order.
template <class T>
std::vector<std::int16_t> convert(const std::string& bytes, bool big_endian, std::int64_t count,
                                  const std::filesystem::path& path) {
  if (bytes.size() < static_cast<std::size_t>(count) * sizeof(T))
    throw InputError(path.string(),
                     fmt::format("holds {} bytes of data, its size asks for {}", bytes.size(), count * sizeof(T)),
                     "copy the file again, it seems to be cut off");
  std::vector<std::int16_t> labels(count);
  const bool turn = big_endian != (std::endian::native == std::endian::big);
  for (std::int64_t i = 0; i < count; ++i) {
    std::array<char, sizeof(T)> raw;
    std::memcpy(raw.data(), bytes.data() + i * sizeof(T), sizeof(T));
    if (turn) std::reverse(raw.begin(), raw.end());
    labels[i] = label_from_value(static_cast<double>(std::bit_cast<T>(raw)), i, path);
  }
  return labels;
}

}  // namespace

Point ImageFrame::place(const Point& voxels) const { return origin + matrix() * voxels; }

Mat3<double> ImageFrame::matrix() const {
  Mat3<double> m;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) m(r, c) = steps[c][r];
  return m;
}

double ImageFrame::voxel_volume() const { return std::abs(determinant(matrix())); }

double ImageFrame::largest_spacing() const { return std::max({norm(steps[0]), norm(steps[1]), norm(steps[2])}); }

std::int16_t label_from_value(double value, std::int64_t index, const std::filesystem::path& path) {
  using Limits = std::numeric_limits<std::int16_t>;
  if (value >= Limits::min() && value <= Limits::max() && value == std::floor(value))
    return static_cast<std::int16_t>(value);
  throw InputError(path.string(),
                   fmt::format("the value of voxel {} is {}, labels are whole numbers from {} to {}", index, value,
                               Limits::min(), Limits::max()),
                   "give the labels of the segmentation, not the scan itself");
}

std::vector<std::int16_t> labels_from_bytes(const std::string& bytes, ValueType type, bool big_endian,
                                            std::int64_t count, const std::filesystem::path& path) {
  switch (type) {
    case ValueType::int8:
      return convert<std::int8_t>(bytes, big_endian, count, path);
    case ValueType::uint8:
      return convert<std::uint8_t>(bytes, big_endian, count, path);
    case ValueType::int16:
      return convert<std::int16_t>(bytes, big_endian, count, path);
    case ValueType::uint16:
      return convert<std::uint16_t>(bytes, big_endian, count, path);
    case ValueType::int32:
      return convert<std::int32_t>(bytes, big_endian, count, path);
    case ValueType::uint32:
      return convert<std::uint32_t>(bytes, big_endian, count, path);
    case ValueType::int64:
      return convert<std::int64_t>(bytes, big_endian, count, path);
    case ValueType::uint64:
      return convert<std::uint64_t>(bytes, big_endian, count, path);
    case ValueType::float32:
      return convert<float>(bytes, big_endian, count, path);
    default:
      return convert<double>(bytes, big_endian, count, path);
  }
}

std::string bytes_from_labels(const std::vector<std::int16_t>& labels) {
  std::string bytes(2 * labels.size(), '\0');
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const auto value = static_cast<std::uint16_t>(labels[i]);
    bytes[2 * i] = static_cast<char>(value & 0xff);
    bytes[2 * i + 1] = static_cast<char>(value >> 8);
  }
  return bytes;
}

ImageFrame checked_frame(const Size3& size, const std::array<Vec3<double>, 3>& columns, const Point& origin,
                         const std::filesystem::path& path) {
  const ImageFrame frame{size, origin, columns};
  if (std::min({size[0], size[1], size[2]}) < 2)
    throw InputError(path.string(), fmt::format("is an image of {} x {} x {} voxels", size[0], size[1], size[2]),
                     "give a three-dimensional image");
  double product = 1;
  for (const auto& step : columns) product *= norm(step);
  // Negated, so that values that are no numbers fail as well.
  if (!(product > 0 && std::abs(determinant(frame.matrix())) > 0.01 * product) || !std::isfinite(norm(origin)))
    throw InputError(path.string(), "its voxel spacing or its axes are zero, no numbers, or lie in one plane",
                     "write the image again with spacing, origin and directions");
  return frame;
}

LabelImage read_label_image(const std::filesystem::path& path) {
  const auto format = format_of(path);
  if (!std::filesystem::is_regular_file(path))
    throw InputError(path.string(), "there is no such file", "check the path");
  switch (format) {
    case Format::nrrd:
      return read_nrrd(path);
    case Format::metaimage:
      return read_metaimage(path);
    default:
      return read_nifti(path);
  }
}

void write_label_image(const LabelImage& image, const std::filesystem::path& path) {
  switch (format_of(path)) {
    case Format::nrrd:
      return write_nrrd(image, path);
    case Format::metaimage:
      return write_metaimage(image, path);
    default:
      return write_nifti(image, path);
  }
}

}  // namespace tunica::imaging
