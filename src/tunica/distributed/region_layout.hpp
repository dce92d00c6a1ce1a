// A region in the order of the case's mesh, put together on rank 0.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tunica/distributed/distributed_mesh.hpp"
#include "tunica/field_io/field_file.hpp"

namespace tunica::distributed {

/// Where the values of the ranks stand in the files of a region: nodes and elements ascend by their numbers in
/// MeshData. Each node is given by the rank that owns it, each element as well.
class RegionLayout {
 public:
  /// Collective, as are all member functions.
  RegionLayout(const DistributedMesh& mesh, const Region& region);

  /// On rank 0; empty elsewhere. `length_factor`: from m to the unit of the files.
  field_io::RegionMesh mesh(const DistributedMesh& mesh, const Region& region, double length_factor) const;

  /// Component c of local node n is values[n * stride + c] * factor. On rank 0 [node of the file][component].
  std::vector<float> nodal(std::span<const double> values, int stride, int components, double factor) const;
  /// values[e * components + c] * factor of owned element e. On rank 0 [element of the file][component].
  std::vector<float> cellwise(std::span<const double> values, int components, double factor) const;

 private:
  /// What ranks send, and where it goes.
  struct Order {
    std::vector<int> counts, starts;  ///< rank 0: of each rank
    std::vector<std::int64_t> ids;    ///< rank 0: ascending
    std::vector<std::size_t> place;   ///< rank 0: row of the file of what arrives as number k
  };
  template <class T>
  std::vector<T> gather(const Order& order, const std::vector<T>& mine, int components) const;
  Order order_of(const std::vector<std::int64_t>& mine) const;

  MPI_Comm comm_;
  std::vector<std::int32_t> nodes_;  ///< owned nodes of the region, local
  Order node_order_, element_order_;
};

}  // namespace tunica::distributed
