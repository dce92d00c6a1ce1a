// Images whose voxels say what they belong to.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "tunica/base/tensor.hpp"

namespace tunica::imaging {

using Point = Vec3<double>;
using Size3 = std::array<std::int64_t, 3>;

/// Where the voxels of an image lie. Patient axes: x to the left, y to the back, z to the head.
struct ImageFrame {
  Size3 size{};
  Point origin{};                       ///< centre of the first voxel [m]
  std::array<Vec3<double>, 3> steps{};  ///< from a voxel to the next one along each axis [m], linearly independent

  std::int64_t count() const { return size[0] * size[1] * size[2]; }
  std::int64_t index(std::int64_t i, std::int64_t j, std::int64_t k) const { return i + size[0] * (j + size[1] * k); }
  Size3 voxel(std::int64_t index) const {
    return {index % size[0], index / size[0] % size[1], index / (size[0] * size[1])};
  }
  /// Position of a place given in voxels; (0, 0, 0) is the centre of the first one [m].
  Point place(const Point& voxels) const;
  Point place(const Size3& v) const {
    return place(Point{{static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])}});
  }
  Mat3<double> matrix() const;     ///< from voxels to metres; its columns are the steps
  double voxel_volume() const;     ///< m^3
  double largest_spacing() const;  ///< m
  bool holds(std::int64_t i, std::int64_t j, std::int64_t k) const {
    return i >= 0 && j >= 0 && k >= 0 && i < size[0] && j < size[1] && k < size[2];
  }
};

/// Calls `visit(index)` for each voxel that shares a face with that of `index`.
template <class Visit>
void for_each_face_neighbour(const ImageFrame& frame, std::int64_t index, const Visit& visit) {
  const auto v = frame.voxel(index);
  const std::int64_t stride[3] = {1, frame.size[0], frame.size[0] * frame.size[1]};
  for (int d = 0; d < 3; ++d) {
    if (v[d] > 0) visit(index - stride[d]);
    if (v[d] + 1 < frame.size[d]) visit(index + stride[d]);
  }
}

/// Calls `visit(index, step)` for each voxel that touches that of `index`, `step` being the way to it in voxels.
template <class Visit>
void for_each_neighbour(const ImageFrame& frame, std::int64_t index, const Visit& visit) {
  const auto v = frame.voxel(index);
  for (int k = -1; k <= 1; ++k)
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i)
        if ((i != 0 || j != 0 || k != 0) && frame.holds(v[0] + i, v[1] + j, v[2] + k))
          visit(index + frame.index(i, j, k), Size3{i, j, k});
}

/// Calls `visit(index)` for the voxels of a box that holds the ball about a place.
template <class Visit>
void for_each_voxel_near(const ImageFrame& frame, const Point& centre, double radius, const Visit& visit) {
  const auto to_voxels = inverse(frame.matrix());
  const Point middle = to_voxels * (centre - frame.origin);
  Size3 low, high;
  for (int d = 0; d < 3; ++d) {
    const double reach = radius * norm(Vec3<double>{{to_voxels(d, 0), to_voxels(d, 1), to_voxels(d, 2)}});
    low[d] = std::max<std::int64_t>(0, static_cast<std::int64_t>(middle[d] - reach));
    high[d] = std::min<std::int64_t>(frame.size[d] - 1, static_cast<std::int64_t>(middle[d] + reach) + 1);
  }
  for (std::int64_t k = low[2]; k <= high[2]; ++k)
    for (std::int64_t j = low[1]; j <= high[1]; ++j)
      for (std::int64_t i = low[0]; i <= high[0]; ++i) visit(frame.index(i, j, k));
}

/// Cubic voxels that hold all places with a margin [m]; their axes are those of the patient, turned by `tilt` [rad]
/// about (1, 1, 1).
ImageFrame frame_about(std::span<const Point> places, double voxel, double margin, double tilt);

struct LabelImage {
  ImageFrame frame;
  std::vector<std::int16_t> labels;  ///< x fastest
};

/// Reads a NRRD (.nrrd, .nhdr), MetaImage (.mha, .mhd) or NIfTI (.nii, .nii.gz) file. Lengths and axes are those that
/// the format fixes or the file states; without either they are mm and patient axes.
/// InputError for a missing, damaged or unknown file, one that is not three-dimensional, states no voxel spacing or
/// (NIfTI) no orientation, and for values that are no labels: whole numbers of 16 bits.
LabelImage read_label_image(const std::filesystem::path& path);

/// Writes it in the format that the name of the file ends in, compressed but for .nii. InputError for another
/// ending, SolverError when it cannot be written.
void write_label_image(const LabelImage& image, const std::filesystem::path& path);

}  // namespace tunica::imaging
