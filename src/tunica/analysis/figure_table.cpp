#include "tunica/analysis/figure_table.hpp"

#include <cassert>

#include "tunica/parallel/message.hpp"

namespace tunica::analysis {

void FigureTable::set(std::size_t frame, const Row& row) {
  if (number_.empty())
    for (const auto& [name, value] : row) number_.emplace(name, number_.size());
  assert(number_.size() == row.size());
  for (const auto& [name, value] : row) rows_[frame].push_back(value);
}

void FigureTable::gather(MPI_Comm comm) {
  const int ranks = parallel::size(comm);
  if (parallel::rank(comm) != 0) {
    std::vector<std::int64_t> frames;
    std::vector<double> values;
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      if (rows_[k].empty()) continue;
      frames.push_back(static_cast<std::int64_t>(k));
      values.insert(values.end(), rows_[k].begin(), rows_[k].end());
    }
    parallel::send(comm, 0, frames);
    parallel::send(comm, 0, values);
    return;
  }
  for (int other = 1; other < ranks; ++other) {
    const auto frames = parallel::receive<std::int64_t>(comm, other);
    const auto values = parallel::receive<double>(comm, other);
    const auto width = static_cast<std::ptrdiff_t>(number_.size());
    for (std::size_t k = 0; k < frames.size(); ++k) {
      const auto first = values.begin() + static_cast<std::ptrdiff_t>(k) * width;
      rows_[static_cast<std::size_t>(frames[k])].assign(first, first + width);
    }
  }
}

std::vector<double> FigureTable::column(const std::string& name) const {
  const auto number = number_.at(name);
  std::vector<double> values;
  for (const auto& row : rows_) values.push_back(row[number]);
  return values;
}

}  // namespace tunica::analysis
