#include "tunica/imaging/label_image.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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

Format format_of_file(const std::filesystem::path& path) {
  const auto format = format_of(path);
  if (!std::filesystem::is_regular_file(path))
    throw InputError(path.string(), "there is no such file", "check the path");
  return format;
}

/// More voxels than any scanner's image has, and few enough that counting bytes cannot overflow.
constexpr std::int64_t most_voxels = std::int64_t{1} << 31;

void check_size(const Size3& size, const std::filesystem::path& path) {
  const auto text = fmt::format("is an image of {} x {} x {} voxels", size[0], size[1], size[2]);
  if (std::min({size[0], size[1], size[2]}) < 2)
    throw InputError(path.string(), text + ", at least 2 along each axis are needed", "give a three-dimensional image");
  // Divided, since the product may overflow.
  if (size[0] > most_voxels / size[1] || size[0] * size[1] > most_voxels / size[2])
    throw InputError(path.string(), fmt::format("{}, at most {} can be read", text, most_voxels),
                     "correct the size in its header, or cut the image down to the vessel");
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

ImageFrame frame_about(std::span<const Point> places, double voxel, double margin, double tilt) {
  const double c = std::cos(tilt), d = std::sin(tilt) / std::sqrt(3.0), t = (1 - c) / 3;
  const Vec3<double> axes[3] = {{{c + t, t + d, t - d}}, {{t - d, c + t, t + d}}, {{t + d, t - d, c + t}}};
  ImageFrame frame;
  for (std::size_t a = 0; a < 3; ++a) {
    double low = 0, high = 0;
    for (std::size_t n = 0; n < places.size(); ++n) {
      const double x = dot(axes[a], places[n]);
      low = n == 0 ? x : std::min(low, x);
      high = n == 0 ? x : std::max(high, x);
    }
    low -= margin;
    frame.size[a] = 2 + static_cast<std::int64_t>((high + margin - low) / voxel);
    frame.steps[a] = voxel * axes[a];
    frame.origin = frame.origin + low * axes[a];
  }
  return frame;
}

ImageFrame checked_frame(const Size3& size, const std::array<Vec3<double>, 3>& columns, const Point& origin,
                         const std::filesystem::path& path) {
  check_size(size, path);
  const ImageFrame frame{size, origin, columns};
  const auto refuse = [&](const std::string& what) {
    throw InputError(path.string(), what, "write the image again with spacing, origin and directions");
  };
  double product = 1;
  for (int a = 0; a < 3; ++a) {
    const double spacing = norm(columns[a]);
    if (!(spacing > 0) || !std::isfinite(spacing))
      refuse(fmt::format("its voxel spacing along axis {} is {} mm", a + 1, 1e3 * spacing));
    product *= spacing;
  }
  if (!std::isfinite(norm(origin)))
    refuse(fmt::format("its first voxel lies at ({}, {}, {}) mm", 1e3 * origin[0], 1e3 * origin[1], 1e3 * origin[2]));
  // Negated, so that values that are no numbers fail as well.
  if (!(product > 0 && std::abs(determinant(frame.matrix())) > 0.01 * product))
    refuse("its three axes lie (nearly) in one plane");
  return frame;
}

void check_counts(const ValueImage& image) {
  constexpr std::int64_t most_values = 9, most_times = 100'000;
  const auto check = [&](const char* what, std::int64_t count, std::int64_t most) {
    if (count < 1 || count > most)
      throw InputError(image.path.string(),
                       fmt::format("its header announces {} {}, 1 to {} are possible", count, what, most),
                       "correct its header, or write the image again");
  };
  check("values for each voxel", image.per_voxel, most_values);
  check("components", image.components, most_values);
  check("times", image.times, most_times);
}

LabelImage read_label_image(const std::filesystem::path& path) {
  switch (format_of_file(path)) {
    case Format::nrrd:
      return read_nrrd(path);
    case Format::metaimage:
      return read_metaimage(path);
    default:
      return read_nifti(path);
  }
}

ValueImage open_value_image(const std::filesystem::path& path) {
  switch (format_of_file(path)) {
    case Format::nrrd:
      return open_nrrd(path);
    case Format::metaimage:
      return open_metaimage(path);
    default:
      return open_nifti(path);
  }
}

std::vector<float> ValueImage::next_volume() { return read_values(*data, format, per_voxel * frame.count(), path); }

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
