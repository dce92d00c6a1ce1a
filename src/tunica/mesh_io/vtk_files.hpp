// Reading VTK XML files into plain arrays, so that no other file needs VTK's headers.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tunica/base/tensor.hpp"
#include "tunica/mesh/mesh_data.hpp"

namespace tunica::mesh_io {

/// Points and cells as the file has them, in its unit.
struct VtkCells {
  std::vector<Vec3<double>> points;
  std::vector<int> types;                  ///< VTK cell types
  std::vector<std::int64_t> offsets;       ///< where each cell starts in `connectivity`, one past the end for the last
  std::vector<std::int64_t> connectivity;  ///< 0-based points
  std::vector<std::int64_t> global_node_ids, global_element_ids;  ///< as in the file; empty when it has none
  std::vector<mesh::ElementField> fields;                         ///< the cell arrays that were asked for
  std::vector<mesh::NodeField>
      node_fields;  ///< the point arrays of a surface, likewise; of a volume those that may be there
  std::vector<mesh::ElementField> point_fields;  ///< those of a volume: [point][component]
};

/// Reads a .vtu or .vtp file of any encoding. Throws InputError when it is missing, not of that kind, damaged, or its
/// cells name points that do not exist. `fields`: cell arrays, or of a surface point arrays of one component, to be
/// read, too; one that is absent is an error, as it is with `point_fields`. `optional`: point arrays of one component
/// of a volume that may be absent.
VtkCells read_vtk_volume(const std::filesystem::path& path, const std::vector<std::string>& fields = {},
                         const std::vector<std::string>& point_fields = {},
                         const std::vector<std::string>& optional = {});
/// A volume with the point array of that name, or where there is none with the cell array.
VtkCells read_vtk_volume_with(const std::filesystem::path& path, const std::string& array);
VtkCells read_vtk_surface(const std::filesystem::path& path, const std::vector<std::string>& fields = {});
/// The same with all point arrays whose names begin with `prefix`, of any number of components, as `point_fields`.
VtkCells read_vtk_surface_series(const std::filesystem::path& path, const std::string& prefix);

/// What a .pvtu or .pvtp file says of its pieces.
struct VtkPieces {
  std::vector<std::filesystem::path> files;  ///< beside it
  std::vector<std::string> point_arrays, cell_arrays;
};

/// Reads a file that names others but not these, of `kind` UnstructuredGrid or PolyData. Throws InputError, with the
/// line, when it is missing, no such file or damaged.
VtkPieces read_vtk_pieces(const std::filesystem::path& path, const std::string& kind = "UnstructuredGrid");

}  // namespace tunica::mesh_io
