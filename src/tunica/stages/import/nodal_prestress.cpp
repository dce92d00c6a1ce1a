#include "tunica/stages/import/nodal_prestress.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tunica/artifacts/load_mesh.hpp"
#include "tunica/artifacts/prestress_file.hpp"
#include "tunica/base/error.hpp"
#include "tunica/mesh_io/vtk_files.hpp"
#include "tunica/stages/import/initial_state.hpp"
#include "tunica/wall/prestress.hpp"

namespace tunica::stages {

namespace {

constexpr const char* stress = "Stress";
constexpr const char* prestress_remedy = "give the prestress of this mesh, or remove Prestress_file_path and find one";

/// Components of `stress` in each element, [element][6], in units of the file: those of the cells where it is an array
/// of cells, else the means of the nodes.
std::vector<double> of_elements(const std::filesystem::path& file, const mesh_io::VtkCells& nodal,
                                const mesh::MeshData& wall) {
  const bool cells = nodal.point_fields.empty();
  const mesh::ElementField& field = cells ? nodal.fields.at(0) : nodal.point_fields.at(0);
  if (field.components != wall::voigt_size)
    throw InputError(file.string(), fmt::format("`{}` has {} components", stress, field.components),
                     "give a symmetric tensor of six");
  if (cells) {
    if (field.values.size() != wall::voigt_size * wall.tetrahedra.size())
      throw InputError(file.string(),
                       fmt::format("has {} cells, the wall {} elements", field.values.size() / wall::voigt_size,
                                   wall.tetrahedra.size()),
                       prestress_remedy);
    return field.values;
  }
  std::vector<double> values(wall::voigt_size * wall.tetrahedra.size(), 0.0);
  for (std::size_t e = 0; e < wall.tetrahedra.size(); ++e)
    for (const auto node : wall.tetrahedra[e])
      for (std::size_t i = 0; i < wall::voigt_size; ++i)
        values[wall::voigt_size * e + i] += 0.25 * field.values[wall::voigt_size * static_cast<std::size_t>(node) + i];
  return values;
}

}  // namespace

void write_element_prestress(const std::filesystem::path& nodal, double pascals, case_file::MeshSettings meshes,
                             const std::filesystem::path& target) {
  meshes.lumen.reset();
  meshes.interface.reset();
  const auto wall = artifacts::load_meshes(meshes, {}).data;
  const auto file = mesh_io::read_vtk_volume_with(nodal, stress);
  check_points(nodal, file.points, wall.points, meshes.metres(), prestress_remedy);
  auto values = of_elements(nodal, file, wall);
  for (double& value : values) value *= pascals;
  artifacts::write_prestress(target, wall, wall::PrestressKind::stress, values);
}

}  // namespace tunica::stages
