// The fields that a run left, in the order of the mesh of its case.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "tunica/analysis/description.hpp"
#include "tunica/mesh/mesh_data.hpp"

namespace tunica::analysis {

/// Nodal fields [node of MeshData][component] in SI units; those that the case has nothing for are empty, and zero at
/// nodes of other regions.
struct FieldFrame {
  double time = 0;                                     ///< s
  std::vector<double> velocity, pressure, wall_shear;  ///< of the lumen
  std::vector<double> displacement;                    ///< of all nodes
  std::vector<std::vector<double>> stress;  ///< [quantity][element of MeshData] [Pa]; NaN where there is none
};

/// Reads the series of all regions. Nodes and elements are found by the coordinates, which are those of the mesh to the
/// last bit of a float: numbers of another mesh would not be noticed.
///
/// Not collective: any rank may read any frame.
class FieldSeries {
 public:
  /// `data` must outlive this; that of quadratic elements as it is (mesh::add_edge_nodes) or subdivided
  /// (mesh::subdivided). Throws InputError when there are no results, or they are of another mesh.
  FieldSeries(const RunDescription& run, const mesh::MeshData& data, std::filesystem::path folder);
  ~FieldSeries();
  FieldSeries(FieldSeries&&) noexcept;
  FieldSeries& operator=(FieldSeries&&) noexcept;

  const std::vector<double>& times() const;  ///< of the frames that all regions have, ascending [s]
  /// Names of the stresses of the elements, such as "von Mises stress": all that any region has.
  const std::vector<std::string>& stresses() const;

  /// Throws InputError when a file is missing, damaged, or without a field.
  FieldFrame read(std::size_t frame);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace tunica::analysis
