#include "tunica/stages/import/wall_regions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "tunica/artifacts/load_mesh.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/tensor.hpp"
#include "tunica/base/text.hpp"
#include "tunica/files/csv_file.hpp"
#include "tunica/mesh_io/volume_arrays.hpp"
#include "tunica/mesh_io/vtk_files.hpp"

namespace tunica::stages {

namespace {

/// Single precision, in which most of these files are, and a little more.
constexpr double same_angle = 1e-3;  // rad
/// Each class is a material of its own, with a weight in every element.
constexpr int most_classes = 100;

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

/// Domain of each element: of the cell array DOMAIN_ID, or one whole number after another in a text.
std::vector<int> domains_of(const peer_cases::WallRegions& wanted, std::size_t elements) {
  std::vector<double> numbers;
  const std::string file = wanted.domains.string();
  if (text::lower(wanted.domains.extension().string()) == ".vtu") {
    numbers = mesh_io::read_vtk_volume(wanted.domains, {"DOMAIN_ID"}).fields.at(0).values;
  } else {
    for (const auto& line : files::read_lines(file, "give a list of numbers")) {
      std::istringstream words{std::string(line.text)};
      for (std::string word; words >> word;)
        numbers.push_back(files::parse_number(word, fmt::format("{}:{}", file, line.number), "a domain"));
    }
  }
  if (numbers.size() != elements)
    throw InputError(file, fmt::format("has {} domains, the wall {} elements", numbers.size(), elements),
                     "give one for each element");
  std::vector<int> domains;
  for (const double number : numbers) {
    if (std::find(wanted.known.begin(), wanted.known.end(), number) == wanted.known.end())
      throw InputError(file, fmt::format("has the domain {:.9g}, of which the equation says nothing", number),
                       "give the equation that Domain");
    domains.push_back(static_cast<int>(number));
  }
  return domains;
}

}  // namespace

FibreAngles fibre_angles(const peer_cases::FibreFiles& files) {
  const auto first = directions(files.first), second = directions(files.second);
  if (first.size() != second.size() || first.empty())
    throw InputError(files.where,
                     fmt::format("has {} cells, the file of the first family {}", second.size(), first.size()),
                     "give both for the same mesh");
  std::vector<double> angle;
  for (std::size_t c = 0; c < first.size(); ++c)
    angle.push_back(std::atan2(norm(cross(first[c], second[c])), dot(first[c], second[c])));
  const auto [least, most] = std::minmax_element(angle.begin(), angle.end());
  const double width = std::max(same_angle, (*most - *least) / most_classes);
  std::map<std::int32_t, std::pair<double, int>> sums;
  const auto raw = [&](double a) { return static_cast<std::int32_t>(std::floor((a - *least) / width)); };
  for (const double a : angle) {
    auto& [sum, count] = sums[raw(a)];
    sum += a, ++count;
  }
  FibreAngles result;
  std::map<std::int32_t, std::int32_t> number;
  for (const auto& [bin, sum] : sums) {
    number[bin] = static_cast<std::int32_t>(result.angles.size());
    result.angles.push_back(sum.first / sum.second);
  }
  for (const double a : angle) {
    result.class_of.push_back(number.at(raw(a)));
    result.largest_deviation = std::max(result.largest_deviation,
                                        std::abs(a - result.angles[static_cast<std::size_t>(result.class_of.back())]));
  }
  return result;
}

void write_wall_regions(const peer_cases::WallRegions& wanted, const FibreAngles& angles,
                        case_file::MeshSettings meshes, const std::filesystem::path& folder) {
  meshes.lumen.reset();
  meshes.interface.reset();
  meshes.wall->region_array.reset();
  meshes.wall->files.rest = "boundary without a name";
  const auto wall = artifacts::load_meshes(meshes, {}).data;
  const std::size_t elements = wall.tetrahedra.size();
  std::vector<int> domains(elements, 0);
  if (!wanted.domains.empty()) domains = domains_of(wanted, elements);
  if (!angles.class_of.empty() && angles.class_of.size() != elements)
    throw InputError(wanted.where, fmt::format("has {} cells, the wall {} elements", angles.class_of.size(), elements),
                     "give directions for this mesh");
  mesh_io::VolumeArray array{.name = "REGION", .whole_numbers = true};
  for (std::size_t e = 0; e < elements; ++e)
    array.values.push_back(peer_cases::region_number(
        domains[e], angles.class_of.empty() ? 0 : static_cast<std::size_t>(angles.class_of[e])));
  mesh_io::write_volume_array(folder / wanted.file, wall, mesh::RegionKind::wall, meshes.metres(), array);
}

}  // namespace tunica::stages
