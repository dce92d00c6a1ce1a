#include "tunica/stages/meshing/vessel_roles.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tunica/base/error.hpp"

namespace tunica::stages::meshing {

std::vector<Opening> with_inlet_first(std::vector<Opening> openings, const VesselRoles& roles) {
  const auto find = [&](const std::string& name) {
    return std::find_if(openings.begin(), openings.end(), [&](const Opening& o) { return o.name == name; });
  };
  std::vector<Problem> problems;
  const auto check = [&](const std::string& key, const std::string& name) {
    if (find(name) != openings.end()) return;
    std::string names;
    for (const auto& o : openings) names += (names.empty() ? "" : ", ") + o.name;
    problems.push_back({key, fmt::format("there is no opening '{}'", name), "take one of " + names});
  };
  if (!roles.inlet.empty()) check("inlet", roles.inlet);
  for (const auto& name : roles.aorta_ends) check("aorta_ends", name);
  if (!problems.empty()) throw InputError(std::move(problems));
  if (!roles.inlet.empty()) {
    const auto found = find(roles.inlet);
    std::rotate(openings.begin(), found, found + 1);
  }
  return openings;
}

WallRegions wall_regions(const Tetrahedra& mesh, const SurfaceFaces& faces, const std::vector<Opening>& openings,
                         const VesselRoles& roles) {
  std::vector<Cap> caps;
  for (std::size_t o = 0; o < openings.size(); ++o) {
    const auto& ends = roles.aorta_ends;
    const bool aorta = o == 0 || std::find(ends.begin(), ends.end(), openings[o].name) != ends.end();
    caps.push_back({faces.caps[o], !aorta});
  }
  WallRegionOptions options;
  options.true_lumen = roles.true_lumen;
  options.false_lumen = roles.false_lumen;
  return find_wall_regions(mesh, caps, options);
}

}  // namespace tunica::stages::meshing
