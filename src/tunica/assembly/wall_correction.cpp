#include "tunica/assembly/wall_correction.hpp"

#include <algorithm>
#include <set>

#include "tunica/assembly/multigrid.hpp"
#include "tunica/parallel/message.hpp"

namespace tunica::assembly {

using parallel::check;

WallCorrection::WallCorrection(const distributed::DistributedMesh& mesh, const BlockPattern& pattern)
    : mesh_(mesh), pattern_(pattern) {
  number_corners();
  make_pattern();
  make_matrix();
}

// Owned corners come first, as owned nodes do.
void WallCorrection::number_corners() {
  const auto& mesh = mesh_;
  std::vector<char> corner(mesh.nodes(), 0);
  for (const auto& region : mesh.regions)
    if (region.kind == mesh::RegionKind::wall)
      for (const auto& element : region.elements)
        for (const auto node : element) corner[mesh.host[node]] = 1;
  parents_.resize(mesh.nodes());
  std::int64_t owned = 0, first = 0;
  for (std::int32_t i = 0; i < mesh.owned_nodes; ++i) owned += corner[i];
  MPI_Exscan(&owned, &first, 1, MPI_INT64_T, MPI_SUM, mesh.comm);
  if (parallel::rank(mesh.comm) == 0) first = 0;
  owned_corners_ = static_cast<std::int32_t>(owned);
  // Ghosts that this rank sees in the wall are corners for their owner too, which sees all elements around its nodes.
  std::vector<double> ids(mesh.nodes(), -1.0);
  for (std::int32_t i = 0; i < mesh.owned_nodes; ++i)
    if (corner[i]) ids[i] = static_cast<double>(first++);
  mesh.halo.update(ids, 1);
  for (std::int32_t i = 0; i < mesh.nodes(); ++i) {
    if (!corner[i]) continue;
    parents_[i] = {{static_cast<std::int32_t>(corner_node_.size()), -1}, 1};
    corner_node_.push_back(i);
    corner_id_.push_back(static_cast<std::int64_t>(ids[i]));
  }
  for (const auto& edge : distributed::edge_nodes(mesh)) {
    if (edge.kind != mesh::RegionKind::wall) continue;
    Parents& p = parents_[mesh.host[edge.node]];
    p.count = 2;
    for (int k = 0; k < 2; ++k) p.corner[k] = parents_[mesh.host[edge.ends[k]]].corner[0];
  }
}

void WallCorrection::make_pattern() {
  const auto corners = static_cast<std::int32_t>(corner_node_.size());
  std::vector<std::set<std::int32_t>> near(corners);
  for (std::int32_t i = 0; i < pattern_.rows; ++i) {
    std::vector<std::int32_t> reached;
    if (parents_[i].count == 0) continue;
    for (auto b = pattern_.row_begin[i]; b < pattern_.row_begin[i + 1]; ++b) {
      const Parents& p = parents_[pattern_.columns[b]];
      reached.insert(reached.end(), p.corner, p.corner + p.count);
    }
    std::sort(reached.begin(), reached.end());
    reached.erase(std::unique(reached.begin(), reached.end()), reached.end());
    for (int k = 0; k < parents_[i].count; ++k) near[parents_[i].corner[k]].insert(reached.begin(), reached.end());
  }
  row_begin_.assign(1, 0);
  for (std::int32_t c = 0; c < corners; ++c) {
    near[c].insert(c);
    columns_.insert(columns_.end(), near[c].begin(), near[c].end());
    row_begin_.push_back(static_cast<std::int32_t>(columns_.size()));
  }
  values_.resize(9 * columns_.size());
  coarse_row_.assign(9 * static_cast<std::size_t>(corners), 0.0);
  halo_.assign(4 * static_cast<std::size_t>(mesh_.nodes()), 0.0);
}

void WallCorrection::make_matrix() {
  const auto corners = static_cast<std::int32_t>(corner_node_.size());
  std::vector<PetscInt> rows, columns;
  for (std::int32_t c = 0; c < corners; ++c)
    for (auto b = row_begin_[c]; b < row_begin_[c + 1]; ++b)
      for (int r = 0; r < 3; ++r)
        for (int k = 0; k < 3; ++k) {
          rows.push_back(static_cast<PetscInt>(3 * corner_id_[c] + r));
          columns.push_back(static_cast<PetscInt>(3 * corner_id_[columns_[b]] + k));
        }
  check(MatCreate(mesh_.comm, matrix_.out()));
  check(MatSetSizes(matrix_, 3 * owned_corners_, 3 * owned_corners_, PETSC_DETERMINE, PETSC_DETERMINE));
  check(MatSetType(matrix_, MATAIJ));
  check(MatSetBlockSize(matrix_, 3));
  check(MatSetPreallocationCOO(matrix_, static_cast<PetscCount>(rows.size()), rows.data(), columns.data()));
  check(MatCreateVecs(matrix_, solution_.out(), rhs_.out()));

  parallel::VecHandle coordinates;
  check(VecDuplicate(rhs_, coordinates.out()));
  check(VecSetBlockSize(coordinates, 3));
  double* x = nullptr;
  check(VecGetArray(coordinates, &x));
  for (std::int32_t c = 0; c < owned_corners_; ++c)
    for (int d = 0; d < 3; ++d) x[3 * c + d] = mesh_.points[corner_node_[c]][d];
  check(VecRestoreArray(coordinates, &x));
  MatNullSpace rigid = nullptr;
  check(MatNullSpaceCreateRigidBody(coordinates, &rigid));
  check(MatSetNearNullSpace(matrix_, rigid));
  check(MatNullSpaceDestroy(&rigid));
  multigrid_ = make_elastic_multigrid(mesh_.comm);
}

void WallCorrection::accumulate(const BlockMatrix& matrix) {
  std::fill(values_.begin(), values_.end(), 0.0);
  std::vector<std::int32_t> reached;
  for (std::int32_t i = 0; i < pattern_.rows; ++i) {
    const Parents& of_row = parents_[i];
    if (of_row.count == 0) continue;
    const double* free_row = free_.data() + 4 * static_cast<std::size_t>(i);
    reached.clear();
    for (auto b = pattern_.row_begin[i]; b < pattern_.row_begin[i + 1]; ++b) {
      const auto j = pattern_.columns[b];
      const Parents& p = parents_[j];
      const float* a = matrix.blocks[b].a;
      const double* free_column = free_.data() + 4 * static_cast<std::size_t>(j);
      for (int k = 0; k < p.count; ++k) {
        double* sum = coarse_row_.data() + 9 * static_cast<std::size_t>(p.corner[k]);
        for (int r = 0; r < 3; ++r)
          for (int c = 0; c < 3; ++c) sum[3 * r + c] += free_row[r] * free_column[c] * a[4 * c + r] / p.count;
        reached.push_back(p.corner[k]);
      }
    }
    for (const auto column : reached) {
      double* sum = coarse_row_.data() + 9 * static_cast<std::size_t>(column);
      for (int k = 0; k < of_row.count; ++k) {
        const auto row = of_row.corner[k];
        const auto begin = columns_.begin() + row_begin_[row], end = columns_.begin() + row_begin_[row + 1];
        double* to = values_.data() + 9 * (std::lower_bound(begin, end, column) - columns_.begin());
        for (int q = 0; q < 9; ++q) to[q] += sum[q] / of_row.count;
      }
      std::fill(sum, sum + 9, 0.0);
    }
  }
}

// Motions given at a prescribed component of a corner are left out.
void WallCorrection::leave_out_prescribed() {
  for (std::int32_t c = 0; c < std::ssize(corner_node_); ++c) {
    const double* free_row = free_.data() + 4 * static_cast<std::size_t>(corner_node_[c]);
    for (auto b = row_begin_[c]; b < row_begin_[c + 1]; ++b) {
      const double* free_column = free_.data() + 4 * static_cast<std::size_t>(corner_node_[columns_[b]]);
      double* a = values_.data() + 9 * static_cast<std::size_t>(b);
      for (int r = 0; r < 3; ++r)
        for (int k = 0; k < 3; ++k) {
          a[3 * r + k] *= free_row[r] * free_column[k];
          const bool diagonal = columns_[b] == c && r == k && c < owned_corners_;
          if (diagonal && free_row[r] == 0.0) a[3 * r + k] = 1.0;
        }
    }
  }
}

void WallCorrection::update(const BlockMatrix& matrix, std::span<const double> free) {
  free_.assign(free.begin(), free.end());
  accumulate(matrix);
  leave_out_prescribed();
  check(MatSetValuesCOO(matrix_, values_.data(), INSERT_VALUES));
  set_up_elastic_multigrid(multigrid_, matrix_);
}

void WallCorrection::apply(std::span<const double> r, std::span<double> x) {
  // P^T r for owned corners, all of whose nodes this rank sees: sums in the same order in every run.
  std::copy_n(r.begin(), 4 * static_cast<std::size_t>(pattern_.rows), halo_.begin());
  mesh_.halo.update(halo_, 4);
  double* sum = nullptr;
  check(VecZeroEntries(rhs_));
  check(VecGetArray(rhs_, &sum));
  for (std::size_t i = 0; i < parents_.size(); ++i) {
    const Parents& p = parents_[i];
    for (int k = 0; k < p.count; ++k)
      for (std::size_t c = 0; c < 3 && p.corner[k] < owned_corners_; ++c)
        sum[3 * static_cast<std::size_t>(p.corner[k]) + c] += free_[4 * i + c] * halo_[4 * i + c] / p.count;
  }
  for (std::int32_t c = 0; c < owned_corners_; ++c)
    for (std::size_t d = 0; d < 3; ++d)
      sum[3 * static_cast<std::size_t>(c) + d] *= free_[4 * static_cast<std::size_t>(corner_node_[c]) + d];
  check(VecRestoreArray(rhs_, &sum));
  check(PCApply(multigrid_, rhs_, solution_));

  std::fill(halo_.begin(), halo_.end(), 0.0);
  const double* motion = nullptr;
  check(VecGetArrayRead(solution_, &motion));
  for (std::int32_t c = 0; c < owned_corners_; ++c)
    for (int d = 0; d < 3; ++d) {
      const std::size_t to = 4 * static_cast<std::size_t>(corner_node_[c]) + d;
      halo_[to] = free_[to] * motion[3 * c + d];
    }
  check(VecRestoreArrayRead(solution_, &motion));
  mesh_.halo.update(halo_, 4);
  for (std::size_t i = 0; i < static_cast<std::size_t>(pattern_.rows); ++i) {
    const Parents& p = parents_[i];
    for (std::size_t c = 0; c < 4; ++c) {
      double value = 0;
      for (int k = 0; k < p.count; ++k) value += halo_[4 * static_cast<std::size_t>(corner_node_[p.corner[k]]) + c];
      x[4 * i + c] = p.count == 0 || c == 3 ? 0.0 : free_[4 * i + c] * value / p.count;
    }
  }
}

}  // namespace tunica::assembly
