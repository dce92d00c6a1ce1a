#include "tunica/meshing/vessel_roles.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tunica/base/error.hpp"

namespace tunica::meshing {

namespace {

template <class Named>
void check(const VesselRoles& roles, const std::vector<Named>& openings) {
  std::vector<Problem> problems;
  const auto look_up = [&](const std::string& key, const std::string& name) {
    const auto is_it = [&](const Named& o) { return o.name == name; };
    if (std::any_of(openings.begin(), openings.end(), is_it)) return;
    std::string names;
    for (const auto& o : openings) names += (names.empty() ? "" : ", ") + o.name;
    problems.push_back({key, fmt::format("there is no opening '{}'", name), "take one of " + names});
  };
  if (!roles.inlet.empty()) look_up("inlet", roles.inlet);
  for (const auto& name : roles.aorta_ends) look_up("aorta_ends", name);
  if (!problems.empty()) throw InputError(std::move(problems));
}

}  // namespace

void check_names(const VesselRoles& roles, const std::vector<geometry::NamedPlace>& names) { check(roles, names); }

std::vector<geometry::Opening> with_inlet_first(std::vector<geometry::Opening> openings, const VesselRoles& roles) {
  check(roles, openings);
  if (roles.inlet.empty()) return openings;
  const auto found =
      std::find_if(openings.begin(), openings.end(), [&](const geometry::Opening& o) { return o.name == roles.inlet; });
  std::rotate(openings.begin(), found, found + 1);
  return openings;
}

WallRegions wall_regions(const geometry::Tetrahedra& mesh, const SurfaceFaces& faces,
                         const std::vector<geometry::Opening>& openings, const VesselRoles& roles) {
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

}  // namespace tunica::meshing
