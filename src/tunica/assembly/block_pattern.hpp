// Which node couples with which: the sparsity of the block matrix, and the slots that element matrices are added to.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tunica/distributed/distributed_mesh.hpp"

namespace tunica::assembly {

/// Block CSR pattern: rows are the nodes that this rank owns, columns all local nodes, ascending in each row. A wall
/// element next to the lumen couples its own nodes (pressure) and their hosts (motion).
struct BlockPattern {
  std::int32_t rows = 0;                ///< owned nodes
  std::int32_t columns_count = 0;       ///< local nodes
  std::vector<std::int32_t> row_begin;  ///< rows + 1
  std::vector<std::int32_t> columns;
  std::vector<std::int32_t> diagonal;  ///< position of block (i, i)

  std::int32_t blocks() const { return static_cast<std::int32_t>(columns.size()); }
  /// Position of block (row, column); `blocks()` when the row is a ghost's, a block that is never read.
  std::int32_t slot(std::int32_t row, std::int32_t column) const;
};

/// Pattern of all regions.
BlockPattern make_pattern(const distributed::DistributedMesh& mesh);

/// Which pressures couple: nodes of the same element, and a twin with its host (through the motion that they share).
BlockPattern make_pressure_pattern(const distributed::DistributedMesh& mesh);

/// Pattern of the regions of one kind; nodes of other regions have their diagonal block only.
BlockPattern make_pattern(const distributed::DistributedMesh& mesh, mesh::RegionKind kind);

}  // namespace tunica::assembly
