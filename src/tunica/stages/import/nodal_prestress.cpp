#include "tunica/stages/import/nodal_prestress.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tunica/artifacts/load_mesh.hpp"
#include "tunica/artifacts/prestress_file.hpp"
#include "tunica/base/error.hpp"
#include "tunica/mesh_io/vtk_files.hpp"
#include "tunica/wall/prestress.hpp"

namespace tunica::stages {

namespace {

constexpr const char* stress = "Stress";
constexpr const char* remedy = "give the prestress of this mesh, or remove Prestress_file_path and find one";

/// Throws where the points are not those of the wall.
void check_points(const std::filesystem::path& file, const mesh_io::VtkCells& nodal, const mesh::MeshData& wall,
                  double metres) {
  if (nodal.points.size() != wall.points.size())
    throw InputError(file.string(), fmt::format("has {} points, the wall {}", nodal.points.size(), wall.points.size()),
                     remedy);
  double size = 0;
  for (const auto& x : wall.points) size = std::max(size, norm(x));
  for (std::size_t i = 0; i < wall.points.size(); ++i)
    if (!(norm(metres * nodal.points[i] - wall.points[i]) <= 1e-5 * size))
      throw InputError(file.string(), fmt::format("has point {} in another place than the wall", i + 1), remedy);
}

}  // namespace

void write_element_prestress(const std::filesystem::path& nodal, double pascals, case_file::MeshSettings meshes,
                             const std::filesystem::path& target) {
  meshes.lumen.reset();
  meshes.interface.reset();
  const auto wall = artifacts::load_meshes(meshes, {}).data;
  const auto file = mesh_io::read_vtk_volume(nodal, {}, {stress});
  check_points(nodal, file, wall, meshes.metres());
  const auto& field = file.point_fields.at(0);
  if (field.components != wall::voigt_size)
    throw InputError(nodal.string(), fmt::format("`{}` has {} components", stress, field.components),
                     "give a symmetric tensor of six");
  std::vector<double> values(wall::voigt_size * wall.tetrahedra.size(), 0.0);
  for (std::size_t e = 0; e < wall.tetrahedra.size(); ++e)
    for (const auto node : wall.tetrahedra[e])
      for (std::size_t i = 0; i < wall::voigt_size; ++i)
        values[wall::voigt_size * e + i] +=
            0.25 * pascals * field.values[wall::voigt_size * static_cast<std::size_t>(node) + i];
  artifacts::write_prestress(target, wall, wall::PrestressKind::stress, values);
}

}  // namespace tunica::stages
