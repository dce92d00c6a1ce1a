// Velocities on the voxels of an image over a heart beat, as phase-contrast MRI gives them (4D flow).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "tunica/imaging/label_image.hpp"

namespace tunica::flow_imaging {

using imaging::ImageFrame;
using imaging::Point;

struct VelocitySeries {
  ImageFrame frame;
  std::vector<double> times;  ///< of the frames, ascending, within one period [s]
  double period = 0;          ///< s
  /// [frame][component along x, y, z of the patient][voxel], m/s
  std::vector<std::array<std::vector<float>, 3>> velocity;
  std::vector<float> magnitude;         ///< mean over the frames, any unit; empty: none was given
  std::optional<double> encoding;       ///< velocities beyond +-encoding have wrapped [m/s]; none: nothing has
  std::array<Vec3<double>, 3> encoded;  ///< unit vectors along which velocities were encoded, perpendicular

  std::size_t frames() const { return times.size(); }
  std::int64_t voxels() const { return frame.count(); }
};

/// Times of `count` frames over a beat: those that are given, or equal steps of period / count from 0 on. `names`: of
/// the frames, for messages. Throws InputError for frames out of order, two frames of one time, a number of times that
/// is not that of the frames, and times that reach beyond the period. `item`: what a frame is called in
/// messages.
std::vector<double> frame_times(const std::vector<double>& given, double period, const std::vector<std::string>& names,
                                const std::string& where, const std::string& item = "frame");

/// Files of frames in the order of the last number in their names. Throws InputError, with the names, for a file
/// without a number, two files with one number, and a number that is left out.
std::vector<std::string> in_order_of_numbers(std::vector<std::string> files, const std::string& where,
                                             const std::string& item = "frame");

/// Looks at the largest speeds. Throws InputError when they are no speeds of blood in m/s, or lie beyond the encoding
/// velocity, naming the unit that was likely meant. `where`: of the unit in the input.
void check_plausible(const VelocitySeries& series, const std::string& where);

/// Interpolated linearly between voxels at a place given in metres; the nearest voxel beyond the border.
Vec3<double> velocity_at(const VelocitySeries& series, std::size_t frame, const Point& place);

}  // namespace tunica::flow_imaging
