#include "tunica/stages/validate/revolved.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "tunica/base/units.hpp"
#include "tunica/mesh/generate.hpp"

namespace tunica::stages::validate {

namespace {

using Profile = std::vector<std::array<double, 2>>;

using unit::mm;

Profile subdivided(const Profile& profile, double spacing) {
  Profile fine{profile.front()};
  for (std::size_t k = 1; k < profile.size(); ++k) {
    const auto& [z0, r0] = profile[k - 1];
    const auto& [z1, r1] = profile[k];
    const long pieces = std::max(1L, std::lround(std::hypot(z1 - z0, r1 - r0) / spacing));
    for (long i = 1; i <= pieces; ++i) {
      const double t = static_cast<double>(i) / static_cast<double>(pieces);
      fine.push_back({z0 + t * (z1 - z0), r0 + t * (r1 - r0)});
    }
  }
  return fine;
}

/// Open at both ends, normals outward, in mm.
std::string obj(const Profile& profile, int around) {
  const double step = 2 * std::numbers::pi / around, same_area = mesh::polygon_radius(around);
  std::string text;
  auto out = std::back_inserter(text);
  for (const auto& [z, r] : profile)
    for (int k = 0; k < around; ++k)
      fmt::format_to(out, "v {:.9g} {:.9g} {:.9g}\n", same_area * r / mm * std::cos(k * step),
                     same_area * r / mm * std::sin(k * step), z / mm);
  for (int i = 0; i + 1 < static_cast<int>(profile.size()); ++i)
    for (int k = 0; k < around; ++k) {
      const int a = i * around + k + 1, b = i * around + (k + 1) % around + 1, c = a + around, d = b + around;
      fmt::format_to(out, "f {} {} {}\nf {} {} {}\n", a, b, d, a, d, c);
    }
  return text;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> mesh_files(const RevolvedVessel& v) {
  const double begin = v.profile.front()[0], end = v.profile.back()[0];
  double widest = 0;
  for (const auto& [z, r] : v.profile) widest = std::max(widest, r);
  const double outside = 1.2 * widest;
  return {{"lumen.obj", obj(subdivided(v.profile, v.spacing), v.around)},
          {"outside.obj", obj(subdivided({{begin, outside}, {end, outside}}, 2 * v.spacing), v.around)},
          {"openings.csv",
           fmt::format("name,centre_x,centre_y,centre_z\ninlet,0,0,{:.9g}\noutlet,0,0,{:.9g}\n", begin / mm, end / mm)},
          {"mesh.yaml", fmt::format("geometry:\n"
                                    "  surfaces:\n"
                                    "    lumen: lumen.obj\n"
                                    "    outer_wall: outside.obj\n"
                                    "    length_unit: mm\n"
                                    "    openings: openings.csv\n"
                                    "size: {{elements_across: {{count: {:g}, shortest_edge: {:g} mm}}}}\n"
                                    "output: mesh\n",
                                    v.elements_across, v.shortest_edge / mm)}};
}

}  // namespace tunica::stages::validate
