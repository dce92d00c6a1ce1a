// Nodes that move as one: those of a face that keeps its shape under its load.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <span>
#include <vector>

namespace tunica::assembly {

/// Sets of nodes without a node in common, each of which has one vector (v1, v2, v3) for all its nodes. The fourth
/// unknown of a node is its own.
class Ties {
 public:
  Ties() = default;
  /// `sets`: owned nodes of each, the same sets in the same order on all ranks.
  Ties(MPI_Comm comm, std::vector<std::vector<std::int32_t>> sets) : comm_(comm), sets_(std::move(sets)) {}

  bool empty() const { return sets_.empty(); }

  /// x <- w (w . x) / (w . w) in every set and component: the orthogonal projection on what is w times one vector.
  /// [owned node][4]. Collective.
  void project(std::span<const double> w, std::span<double> x) const;
  /// The mean of every set in the place of its vectors, [owned node][4] at least. Collective.
  void average(std::span<double> x) const;

 private:
  MPI_Comm comm_ = MPI_COMM_NULL;
  std::vector<std::vector<std::int32_t>> sets_;
};

}  // namespace tunica::assembly
