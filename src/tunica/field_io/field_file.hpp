// The files of results: the mesh of a region, and its fields at one instant, in HDF5.
//
// Both are VTKHDF files of version 1.0 (https://docs.vtk.org, "VTKHDF file format"), an unstructured grid in one piece,
// which VTK reads since 9.1 and ParaView since 5.10. The mesh stands in a file of its own and is written once; the file
// of an instant refers to it by links of HDF5, which every reader follows. Numbers are packed (shuffle and deflate).
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace tunica::field_io {

constexpr const char* file_ending = ".hdf";

/// A region in its initial shape. Nodes and elements ascend by their numbers in the mesh of the case, so that files do
/// not depend on how many ranks wrote them.
struct RegionMesh {
  std::vector<float> points;                          ///< [node][3], in the unit of the files
  int nodes_of_cell = 4;                              ///< 4 or 10: linear or quadratic tetrahedra in the order of VTK
  std::vector<std::int32_t> cells;                    ///< [cell][nodes_of_cell], rows of `points`
  std::vector<std::int64_t> node_ids, element_ids{};  ///< in the mesh of the case, from 0

  std::size_t nodes() const { return points.size() / 3; }
  std::size_t elements() const { return cells.size() / static_cast<std::size_t>(nodes_of_cell); }
};

/// An array of the nodes or of the cells.
struct Array {
  std::string name;           ///< with its unit, "velocity [m s^-1]"; no '/', which HDF5 takes for a folder
  int components = 1;         ///< 1, 3 or 9
  std::vector<float> values;  ///< [tuple][component]
};

struct ArrayHead {
  std::string name;
  int components = 1;
  friend bool operator==(const ArrayHead&, const ArrayHead&) = default;
};

/// The fields of a region at one instant.
struct Instant {
  double time = 0;                     ///< s
  std::vector<Array> points, cells{};  ///< all of the sizes of the mesh
};

/// Bytes of the file of a mesh. Throws SolverError when there is no memory for them, or a region has more than 2^31
/// nodes or elements times nodes.
std::string mesh_bytes(const RegionMesh& mesh);

/// Bytes of the file of an instant. `mesh_file`: name of the file of the mesh in the same folder.
std::string instant_bytes(const Instant& instant, const std::string& mesh_file);

/// Reads the file of an instant, or of a mesh, which has no fields. All functions throw InputError with the file when
/// it is missing, damaged, or no such file. Not thread-safe, as HDF5 is not.
class FieldFile {
 public:
  explicit FieldFile(std::filesystem::path path);
  ~FieldFile();
  FieldFile(FieldFile&&) noexcept;
  FieldFile& operator=(FieldFile&&) noexcept;

  double time() const;  ///< s; 0 for a mesh
  const std::vector<ArrayHead>& point_arrays() const;
  const std::vector<ArrayHead>& cell_arrays() const;
  /// Through the links; checked: cells name nodes that there are. Ids are empty where the mesh has none.
  RegionMesh read_mesh() const;
  /// Name as in the heads. [tuple][component]
  std::vector<float> read_points(std::string_view name) const;
  std::vector<float> read_cells(std::string_view name) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// Is it the file of a mesh, or of an instant? By its first bytes.
bool is_hdf5(const std::filesystem::path& path);

}  // namespace tunica::field_io
