#include "tunica/artifacts/problem_input.hpp"

#include "tunica/artifacts/load_mesh.hpp"

namespace tunica::artifacts {

coupling::ProblemInput problem_input(const case_file::Case& c) {
  coupling::ProblemInput input;
  input.fluid = c.fluid;
  input.wall = c.wall;
  if (c.mesh_motion) input.mesh_motion = *c.mesh_motion;
  input.boundary.conditions = c.boundary;
  input.boundary.interfaces = interface_pairs(c.meshes);
  input.boundary.wall_has_pressure = c.wall_has_pressure();
  input.boundary.fluid = c.fluid;
  input.boundary.pressure_point = c.pressure_point;
  if (c.time) input.rho_infinity = c.time->rho_infinity, input.loads = c.time->loads;
  input.newton = c.newton;
  input.linear = c.linear;
  return input;
}

std::vector<coupling::ProbePlace> probe_places(const case_file::Case& c) {
  const auto kind = c.solves_fluid() ? mesh::RegionKind::lumen : mesh::RegionKind::wall;
  std::vector<coupling::ProbePlace> places;
  for (const auto& [name, probe] : c.output.points) places.push_back({name, probe.place, probe.region.value_or(kind)});
  return places;
}

}  // namespace tunica::artifacts
