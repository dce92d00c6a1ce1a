// A region in the order of the case's mesh, put together on one rank.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tunica/distributed/distributed_mesh.hpp"
#include "tunica/field_io/field_file.hpp"
#include "tunica/parallel/message.hpp"

namespace tunica::distributed {

/// Where the values of the ranks stand in the files of a region: nodes and elements ascend by their numbers in
/// MeshData. Each node is given by the rank that owns it, each element as well.
class RegionLayout {
 public:
  /// `root`: the rank that puts it together. Collective, as are all member functions that return fields.
  RegionLayout(const DistributedMesh& mesh, const Region& region, int root);

  /// Whether this rank does it.
  bool is_here() const { return parallel::rank(comm_) == root_; }
  /// Of the whole region, on all ranks.
  std::int64_t nodes() const { return global_nodes_; }
  std::int64_t elements() const { return global_elements_; }

  /// On the root; empty elsewhere, as all that follow. `length_factor`: from m to the unit of the files.
  field_io::RegionMesh mesh(const DistributedMesh& mesh, const Region& region, double length_factor) const;

  /// Component c of local node n is values[n * stride + c] * factor. [node of the file][component].
  std::vector<float> nodal(std::span<const double> values, int stride, int components, double factor) const;
  /// values[e * components + c] * factor of owned element e. [element of the file][component].
  std::vector<float> cellwise(std::span<const double> values, int components, double factor) const;

 private:
  /// What ranks send, and where it goes.
  struct Order {
    std::vector<int> counts, starts;  ///< root: of each rank
    std::vector<std::int64_t> ids;    ///< root: ascending
    std::vector<std::size_t> place;   ///< root: row of the file of what arrives as number k
  };
  template <class T>
  std::vector<T> gather(const Order& order, const std::vector<T>& mine, int components) const;
  Order order_of(const std::vector<std::int64_t>& mine) const;

  MPI_Comm comm_;
  int root_;
  std::vector<std::int32_t> nodes_;  ///< owned nodes of the region, local
  Order node_order_, element_order_;
  std::int64_t global_nodes_ = 0, global_elements_ = 0;
};

}  // namespace tunica::distributed
