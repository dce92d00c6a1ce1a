#include "tunica/stages/motion/moving_vessel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "tunica/base/error.hpp"
#include "tunica/files/csv_file.hpp"
#include "tunica/parallel/agree.hpp"

namespace tunica::stages {

namespace {

using motion_imaging::Side;

constexpr double farthest_point = 5e-3;  ///< of a place from the mesh [m]

/// The wall and the ends that are seen, with numbers of their own.
void take_wall(const MotionCase& c, MovingVessel& v) {
  const auto& data = v.vessel.mesh;
  std::vector<std::int64_t> number(data.points.size(), -1);
  const auto add = [&](const std::array<std::int64_t, 3>& nodes) {
    geometry::Triangle triangle{};
    double side = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto node = static_cast<std::size_t>(nodes[i]);
      if (number[node] < 0) {
        number[node] = std::ssize(v.nodes);
        v.nodes.push_back(nodes[i]);
        v.wall.surface.points.push_back(data.points[node]);
      }
      triangle[i] = number[node];
      if (!v.anatomy.side.empty()) side += v.anatomy.side[node];
    }
    v.wall.surface.triangles.push_back(triangle);
    v.wall.sides.push_back(!c.phases.lumens.false_lumen ? Side::true_lumen
                           : v.anatomy.side.empty()     ? Side::either
                           : side > 0                   ? Side::true_lumen
                                                        : Side::false_lumen);
  };
  for (const auto& t : v.anatomy.inside) add(t);
  for (const auto& end : c.ends)
    for (const auto& t : v.vessel.face(end).triangles) add(t);
}

void check_faces(const MotionCase& c, const MovingVessel& v, std::vector<Problem>& problems) {
  for (const auto& end : c.ends)
    if (std::find(v.vessel.openings.begin(), v.vessel.openings.end(), end) == v.vessel.openings.end())
      problems.push_back({"ends", fmt::format("the lumen has no opening '{}'", end),
                          "name some of: " + files::listed(v.vessel.openings)});
  const auto& data = v.vessel.mesh;
  std::vector<std::string> of_wall;
  for (const auto& face : data.faces)
    if (data.regions[static_cast<std::size_t>(face.region)].kind == mesh::RegionKind::wall)
      of_wall.push_back(face.name);
  for (const auto& ring : c.rings)
    if (std::find(of_wall.begin(), of_wall.end(), ring) == of_wall.end())
      problems.push_back(
          {"rings", fmt::format("the wall has no face '{}'", ring),
           of_wall.empty() ? "remove it: the case has no wall" : "name some of: " + files::listed(of_wall)});
}

void find_places(const MotionCase& c, MovingVessel& v) {
  std::vector<Problem> problems;
  check_faces(c, v, problems);
  const auto& data = v.vessel.mesh;
  for (const auto& [name, plane] : c.planes) {
    try {
      v.planes.push_back(flow_imaging::plane_section(data, plane.centre, plane.normal, name, "planes." + name));
    } catch (const InputError& error) {
      problems.insert(problems.end(), error.problems().begin(), error.problems().end());
    }
  }
  for (const auto& [name, point] : c.points) {
    TrackedPoint found{.name = name};
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t n = 0; n < data.points.size(); ++n)
      if (const double d = norm(data.points[n] - point.place); d < nearest)
        nearest = d, found.node = static_cast<std::int64_t>(n);
    if (nearest > farthest_point)
      problems.push_back({"points." + name, fmt::format("is {:.3g} mm away from the mesh", 1e3 * nearest),
                          fmt::format("give a place within {:.0f} mm of it", 1e3 * farthest_point)});
    found.distance = nearest;
    v.points.push_back(std::move(found));
  }
  if (!problems.empty()) throw InputError(std::move(problems));
}

}  // namespace

MovingVessel find_moving_vessel(const MotionCase& c, MPI_Comm comm) {
  MovingVessel v;
  parallel::agree(comm, [&] { v.vessel = vessel_with_corners(c.case_file); });
  parallel::on_root(comm, [&] { find_places(c, v); });
  const auto run = case_file::describe(v.vessel.settings);
  const auto settings = post_settings(v.vessel.settings);
  analysis::tell_lumens_apart(run, settings, v.vessel.mesh, comm);
  v.anatomy = analysis::make_vessel(run, settings, v.vessel.mesh, comm);
  parallel::on_root(comm, [&] { take_wall(c, v); });
  return v;
}

}  // namespace tunica::stages
