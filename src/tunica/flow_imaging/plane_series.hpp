// Velocities on a plane in time, one .vtp file a frame, and how they are laid onto an opening of another shape.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "tunica/config/schema.hpp"
#include "tunica/flow_imaging/inlet_profile.hpp"

namespace tunica::flow_imaging {

/// Files of a plane in time.
struct PlaneFiles {
  std::filesystem::path files;  ///< with * in place of the number
  std::string array = "Velocity";
  double unit = 1.0, length_unit = 1.0;  ///< m/s and m of 1 in the files
  double period = 0;                     ///< s
  std::vector<double> times;             ///< s; empty: equal parts of the period
  double turn = 0;                       ///< of the plane about its normal [rad]

  static config::Schema<PlaneFiles> schema();
};

struct PlaneSeries {
  std::vector<Vec3<double>> points;  ///< m
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<double> times;  ///< s
  double period = 0;
  std::vector<std::vector<Vec3<double>>> velocity;  ///< [frame][point], m/s
  Vec3<double> normal{};                            ///< unit, along the mean flow

  double flow(std::size_t frame) const;  ///< along the normal [m^3/s]
};

/// Throws InputError for files that do not read, frames that are missing, doubled or of other points, no array of that
/// name with three components, triangles that are no flat patch, and velocities that are none of blood.
PlaneSeries read_plane_series(const PlaneFiles& files, const std::string& where);

/// The profile at the nodes of an opening: the plane is turned so that its mean flow enters the vessel, both are mapped
/// onto a disk (disk_map.hpp), and speeds are divided by the ratio of the areas; the rim is at rest. The inflow at each
/// frame is made that of the plane as in profile_at_nodes().
NodalCourse plane_at_nodes(const PlaneSeries& plane, const OpeningMesh& opening, double turn);

}  // namespace tunica::flow_imaging
