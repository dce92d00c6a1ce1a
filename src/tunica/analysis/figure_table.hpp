// Figures of many instants: named columns, one row for each frame of the window.
#pragma once

#include <mpi.h>

#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace tunica::analysis {

class FigureTable {
 public:
  /// Of one frame, always with the same names in the same order.
  using Row = std::vector<std::pair<std::string, double>>;

  explicit FigureTable(std::size_t frames) : rows_(frames) {}
  void set(std::size_t frame, const Row& row);

  /// Brings the rows of all ranks together on rank 0; each frame belongs to one rank, and rank 0 has one. Collective.
  void gather(MPI_Comm comm);

  bool has(const std::string& name) const { return number_.contains(name); }
  /// The course of one figure over the frames. On rank 0 after `gather`.
  std::vector<double> column(const std::string& name) const;

 private:
  std::map<std::string, std::size_t> number_;
  std::vector<std::vector<double>> rows_;
};

}  // namespace tunica::analysis
