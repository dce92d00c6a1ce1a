// Maps flat triangulated sections onto a disk, so that any two of them can be laid on each other without folds.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tunica/base/tensor.hpp"

namespace tunica::flow_imaging {

using DiskPoint = std::array<double, 2>;

/// Places of the points in the unit disk. The rim goes to the circle by its length, counter-clockwise seen against
/// `normal`, the point of the rim that lies farthest along `start` from the middle of the rim at angle 0; each inner
/// point is a convex combination of its neighbours by mean value coordinates (Floater 2003, Comput. Aided Geom. Des.
/// 20, 19-27), for which no triangle folds (Tutte 1963). `name`: for messages. Throws InputError where the triangles
/// are no single patch with one rim.
std::vector<DiskPoint> disk_map(std::span<const Vec3<double>> points,
                                std::span<const std::array<std::int32_t, 3>> triangles, const Vec3<double>& normal,
                                const Vec3<double>& start, const std::string& name);

/// A place in a flat triangulation: the triangle that holds it, or is nearest, and the shares of its corners.
struct DiskPlace {
  std::size_t triangle;
  std::array<double, 3> shares;  ///< none below 0, sum 1
};
DiskPlace find_in_disk(const DiskPoint& place, std::span<const DiskPoint> points,
                       std::span<const std::array<std::int32_t, 3>> triangles);

}  // namespace tunica::flow_imaging
