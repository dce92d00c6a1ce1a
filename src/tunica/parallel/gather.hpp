// Nodal fields between the ranks and one array in the order of the mesh files.
//
// Checkpoints use these, because a file must not depend on the number of ranks that wrote it. It is one nodal field at
// a time that comes together on rank 0, never the mesh, and rank 0 holds one other rank's part beside it.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <span>
#include <vector>

namespace tunica::parallel {

/// Where the owned nodes of this rank stand in the order of the files. Every position 0 .. global_nodes - 1 belongs to
/// exactly one rank.
struct NodeOrder {
  MPI_Comm comm;
  std::span<const std::int64_t> original_ids;  ///< of the owned nodes
  std::int64_t global_nodes;
};

/// On rank 0 the field in original order, [node][component]; empty elsewhere. `values`: [local node][component], of
/// which the owned nodes are read. Collective.
std::vector<double> gather_by_original_id(const NodeOrder& order, std::span<const double> values, int components);

/// The inverse: `field` (on rank 0, in original order) to the owned nodes of `values`; ghosts are left to a halo
/// update. Throws InputError on all ranks if the field does not have global_nodes * components values. Collective.
void scatter_by_original_id(const NodeOrder& order, const std::vector<double>& field, std::span<double> values,
                            int components);

}  // namespace tunica::parallel
