// Exchange of values at nodes that a rank sees but does not own.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <span>
#include <vector>

namespace tunica::parallel {

/// Who sends which owned nodes to whom, and where received ghosts go. Local nodes are numbered owned first, and ghosts
/// are sorted by owner, so a received message lands in one contiguous stretch.
class Halo {
 public:
  struct Neighbour {
    int rank = 0;
    std::vector<std::int32_t> send;  ///< local owned nodes whose values the neighbour needs
    std::int32_t receive_begin = 0, receive_count = 0;
  };

  Halo() = default;
  /// `global_ids`: global number of each local node, ghosts (from `owned` on) ascending.
  /// `first_global`: first global number that this rank owns. Collective.
  Halo(MPI_Comm comm, std::span<const std::int64_t> global_ids, std::int32_t owned, std::int64_t first_global);

  /// Fills the ghost part of `values` ([local node][components]) from the owners. Collective.
  void update(std::span<double> values, int components) const;

  /// The two halves of `update`, so that work on owned values can go on in between; `values` stays in place until
  /// `end`. One exchange at a time. Collective.
  void begin(std::span<double> values, int components) const;
  void end() const;

  /// Ranks that share nodes with this one, ascending.
  const std::vector<Neighbour>& neighbours() const { return neighbours_; }

 private:
  MPI_Comm comm_ = MPI_COMM_NULL;
  std::int32_t local_nodes_ = 0;
  std::vector<Neighbour> neighbours_;
  // Scratch of the exchange under way; mutable since an exchange leaves the halo itself as it was.
  mutable std::vector<double> send_buffer_;
  mutable std::vector<MPI_Request> requests_;
};

}  // namespace tunica::parallel
