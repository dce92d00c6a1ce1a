#include "tunica/stages/import/fibre_angle.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tunica/base/error.hpp"
#include "tunica/base/tensor.hpp"
#include "tunica/mesh_io/vtk_files.hpp"

namespace tunica::stages {

namespace {

/// Single precision, in which most of these files are, and a little more.
constexpr double allowed_spread = 1e-3;  // rad

std::vector<Vec3<double>> directions(const std::filesystem::path& file) {
  const auto field = mesh_io::read_vtk_volume(file, {"FIB_DIR"}).fields.at(0);
  if (field.components != 3)
    throw InputError(file.string(), fmt::format("FIB_DIR has {} components", field.components), "give three");
  std::vector<Vec3<double>> directions;
  for (std::size_t k = 0; k < field.values.size(); k += 3) {
    const Vec3<double> d{{field.values[k], field.values[k + 1], field.values[k + 2]}};
    const double size = norm(d);
    if (!(size > 0)) throw InputError(file.string(), fmt::format("FIB_DIR of cell {} is zero", k / 3 + 1), "mend it");
    directions.push_back((1.0 / size) * d);
  }
  return directions;
}

}  // namespace

double fibre_angle(const peer_cases::FibreFiles& files) {
  const auto first = directions(files.first), second = directions(files.second);
  if (first.size() != second.size() || first.empty())
    throw InputError(files.where,
                     fmt::format("has {} cells, the file of the first family {}", second.size(), first.size()),
                     "give both for the same mesh");
  double least = std::numbers::pi, most = 0, sum = 0;
  for (std::size_t c = 0; c < first.size(); ++c) {
    const double angle = std::atan2(norm(cross(first[c], second[c])), dot(first[c], second[c]));
    least = std::min(least, angle), most = std::max(most, angle), sum += angle;
  }
  if (most - least > allowed_spread)
    throw InputError(files.where,
                     fmt::format("asks for what tunica does not have: two families of fibres whose angle differs from "
                                 "element to element, here from {:.2f} to {:.2f} degrees",
                                 least * 180 / std::numbers::pi, most * 180 / std::numbers::pi),
                     "give directions with the same angle everywhere; a direction that points the other way counts as "
                     "180 degrees less it");
  return sum / static_cast<double>(first.size());
}

}  // namespace tunica::stages
