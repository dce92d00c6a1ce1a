#include "tunica/assembly/schur_preconditioner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tunica/assembly/multigrid.hpp"
#include "tunica/base/error.hpp"
#include "tunica/fe/tetrahedron.hpp"
#include "tunica/parallel/agree.hpp"

namespace tunica::assembly {

using parallel::check;

SchurPreconditioner::SchurPreconditioner(const distributed::DistributedMesh& mesh, const BlockPattern& pattern, Isa isa)
    : mesh_(mesh), pattern_(pattern), isa_(isa) {
  const std::int32_t n = pattern.rows;
  for (std::int32_t i = 0; i < n; ++i) {
    for (auto b = pattern.row_begin[i]; b < pattern.row_begin[i + 1]; ++b) {
      const auto column = pattern.columns[b];
      if (column == i || column >= n) continue;
      Triangle& triangle = column < i ? lower_ : upper_;
      triangle.columns.push_back(column);
      triangle.source.push_back(b);
    }
    for (auto* triangle : {&lower_, &upper_})
      triangle->row_begin.push_back(static_cast<std::int32_t>(triangle->columns.size()));
  }
  for (auto* triangle : {&lower_, &upper_}) triangle->blocks.resize(12 * triangle->columns.size());
  inverse_blocks_.resize(12 * static_cast<std::size_t>(n));
  scratch_.assign(n, -1);
  factors_ = {n, lower_.view(), upper_.view(), inverse_blocks_.data()};

  if (!mesh.quadratic) divergence_.resize(4 * static_cast<std::size_t>(pattern.blocks()));
  find_columns_with_pressure();
  inverse_diagonal_.assign(n, 0);
  scale_.assign(4 * static_cast<std::size_t>(n), 1);
  z_.resize(4 * static_cast<std::size_t>(n));
  second_.resize(z_.size());
  sweep_.resize(z_.size());
  pressure_rhs_.resize(n);
  yield_.assign(n, 1.0);
  halo_v_.assign(4 * static_cast<std::size_t>(pattern.columns_count), 0);
  halo_p_.assign(pattern.columns_count, 0);
  free_.assign(halo_v_.size(), 0);
  const auto has = [&](mesh::RegionKind kind) {
    return std::any_of(mesh.regions.begin(), mesh.regions.end(), [&](const auto& r) { return r.kind == kind; });
  };
  // Beside a lumen, linear elements spend more on the coarse motions than these save (docs/performance.md).
  if (has(mesh::RegionKind::wall) && (mesh.quadratic || !has(mesh::RegionKind::lumen))) wall_.emplace(mesh, pattern);

  make_laplacians();
  std::vector<PetscInt> rows, columns;
  for (std::int32_t i = 0; i < n; ++i)
    for (auto b = pressure_pattern_.row_begin[i]; b < pressure_pattern_.row_begin[i + 1]; ++b) {
      rows.push_back(static_cast<PetscInt>(mesh.first_global + i));
      columns.push_back(static_cast<PetscInt>(mesh.global_ids[pressure_pattern_.columns[b]]));
      pressure_source_.push_back(pattern.slot(i, pressure_pattern_.columns[b]));
    }
  check(MatCreate(mesh.comm, schur_.out()));
  check(MatSetSizes(schur_, n, n, PETSC_DETERMINE, PETSC_DETERMINE));
  check(MatSetType(schur_, MATAIJ));
  check(MatSetPreallocationCOO(schur_, static_cast<PetscCount>(rows.size()), rows.data(), columns.data()));
  check(VecCreateMPI(mesh.comm, n, PETSC_DETERMINE, rhs_.out()));
  check(VecDuplicate(rhs_, solution_.out()));
  multigrid_ = make_multigrid(mesh.comm);
}

/// Integral of the squared shape function of an edge over the volume of the element.
constexpr double edge_mass = 32.0 / 420.0;

// Of quadratic elements the corners have a pressure, an eighth of the nodes.
void SchurPreconditioner::find_columns_with_pressure() {
  std::vector<char> on_edge(static_cast<std::size_t>(pattern_.columns_count), 0);
  for (const auto& edge : distributed::edge_nodes(mesh_)) on_edge[static_cast<std::size_t>(edge.node)] = 1;
  for (std::int32_t i = 0; i < pattern_.rows; ++i) {
    for (auto b = pattern_.row_begin[i]; b < pattern_.row_begin[i + 1]; ++b) {
      if (on_edge[static_cast<std::size_t>(pattern_.columns[b])]) continue;
      gradient_.columns.push_back(pattern_.columns[b]);
      gradient_.source.push_back(b);
    }
    gradient_.row_begin.push_back(static_cast<std::int32_t>(gradient_.columns.size()));
  }
  gradient_.blocks.resize(4 * gradient_.columns.size());
}

// Reference geometry is enough for a preconditioner.
void SchurPreconditioner::make_laplacians() {
  pressure_pattern_ = make_pressure_pattern(mesh_);
  schur_values_.resize(static_cast<std::size_t>(pressure_pattern_.blocks()) + 1);
  nodal_volume_.assign(pattern_.columns_count, 0.0);
  follows_.assign(pattern_.columns_count, 0);
  for (const auto& region : mesh_.regions)
    for (std::size_t e = 0; e < region.elements.size(); ++e) {
      const auto& element = region.elements[e];
      Vec3<double> x[4];
      for (int a = 0; a < 4; ++a) x[a] = mesh_.points[element[a]];
      if (region.kind == mesh::RegionKind::wall)
        distributed::for_each_node(region, e, [&](std::int32_t node) { follows_[node] = 1; });
      const auto shape = fe::gradients(x);
      Laplacian& laplacian = laplacians_.emplace_back();
      laplacian.wall = region.kind == mesh::RegionKind::wall;
      laplacian.count = mesh_.quadratic ? 6 : 4;
      if (mesh_.quadratic)
        laplacian.nodes = region.edges[e];
      else
        std::copy(element.begin(), element.end(), laplacian.nodes.begin());
      for (int a = 0; a < laplacian.count; ++a)
        nodal_volume_[mesh_.host[laplacian.nodes[a]]] += (mesh_.quadratic ? edge_mass : 0.25) * shape.volume;
      for (int a = 0, k = 0; a < 4; ++a) {
        for (int b = a + 1; b < 4; ++b)
          laplacian.entries[k++] = static_cast<float>(shape.volume * dot(shape.dN[a], shape.dN[b]));
        for (int b = 0; b < 4; ++b) laplacian.slots[4 * a + b] = pressure_pattern_.slot(element[a], element[b]);
      }
    }
  edges_ = distributed::edge_nodes(mesh_);
  mesh_.halo.update(nodal_volume_, 1);
}

void SchurPreconditioner::extract(const BlockMatrix& matrix) {
  for (std::size_t k = 0; k < gradient_.source.size(); ++k)
    for (int c = 0; c < 3; ++c) gradient_.blocks[4 * k + c] = matrix.blocks[gradient_.source[k]].a[12 + c];
  for (std::int32_t b = 0; b < pattern_.blocks() && !mesh_.quadratic; ++b)
    for (int c = 0; c < 3; ++c) divergence_[4 * static_cast<std::size_t>(b) + c] = matrix.blocks[b].a[4 * c + 3];
  for (std::int32_t i = 0; i < pattern_.rows; ++i) {
    const float* a = matrix.blocks[pattern_.diagonal[i]].a;
    for (int c = 0; c < 3; ++c) {
      const double k = a[5 * c];
      scale_[4 * static_cast<std::size_t>(i) + c] = std::sqrt(std::abs(k));
    }
  }
}

// A prescribed component has nothing but the diagonal in its row.
void SchurPreconditioner::find_free(const BlockMatrix& matrix) {
  for (std::int32_t i = 0; i < pattern_.rows; ++i)
    for (int r = 0; r < 3; ++r) {
      bool coupled = false;
      for (auto b = pattern_.row_begin[i]; b < pattern_.row_begin[i + 1] && !coupled; ++b)
        for (int c = 0; c < 3; ++c)
          coupled |= matrix.blocks[b].a[4 * c + r] != 0.0F && !(pattern_.columns[b] == i && c == r);
      free_[4 * static_cast<std::size_t>(i) + r] = coupled ? 1.0 : 0.0;
    }
  mesh_.halo.update(free_, 4);
}

std::int32_t SchurPreconditioner::factorise_shifted(const BlockMatrix& matrix, float shift) {
  const auto copy = [&](std::int32_t block, float factor, float* to) {
    const float* a = matrix.blocks[block].a;
    for (int c = 0; c < 3; ++c) {
      for (int r = 0; r < 3; ++r) to[4 * c + r] = factor * a[4 * c + r];
      to[4 * c + 3] = 0;
    }
  };
  const float off_diagonal = 1.0F / (1.0F + shift);
  for (auto* triangle : {&lower_, &upper_})
    for (std::size_t k = 0; k < triangle->source.size(); ++k)
      copy(triangle->source[k], off_diagonal, triangle->blocks.data() + 12 * k);
  for (std::int32_t i = 0; i < pattern_.rows; ++i)
    copy(pattern_.diagonal[i], 1.0F, inverse_blocks_.data() + 12 * static_cast<std::size_t>(i));
  const auto& kernels = block_kernels(isa_);
  const std::int32_t singular = kernels.ilu_factorise(factors_, scratch_.data());
  kernels.ilu_round(factors_);
  return singular;
}

bool SchurPreconditioner::factors_are_stable() {
  for (std::size_t i = 0; i < sweep_.size(); ++i) sweep_[i] = static_cast<float>(scale_[i] * scale_[i]);
  block_kernels(isa_).ilu_solve(factors_, sweep_.data());
  for (std::size_t i = 0; i < sweep_.size(); ++i)
    if (i % 4 < 3 && !(std::abs(sweep_[i]) < 1e6F)) return false;
  return true;
}

// Incomplete factors of elasticity can be unstable: of a locking displacement element, of elements with obtuse angles,
// of walls that go with the blood. Damping the off-diagonal blocks cures that (Manteuffel 1980). A tenth costs nothing
// where it is not needed and saves half of the iterations where factors would amplify without overflowing, which no
// vector shows cheaply; more is taken where it gives no sane factors on this rank.
void SchurPreconditioner::factorise(const BlockMatrix& matrix) {
  std::int32_t singular = -1;
  bool stable = false;
  for (const float shift : {0.1F, 0.3F, 1.0F, 10.0F}) {
    singular = factorise_shifted(matrix, shift);
    stable = singular < 0 && factors_are_stable();
    if (stable) break;
  }
  parallel::agree(mesh_.comm, [&] {
    if (stable) return;
    const auto& x = mesh_.points[std::max(singular, 0)];
    throw SolverError(singular < 0
                          ? std::string("The incomplete factors of the velocity block overflow: the tangent is "
                                        "not finite or far from invertible.")
                          : fmt::format("The velocity block of the tangent is singular at ({:.6g}, {:.6g}, "
                                        "{:.6g}) m: the node has neither mass nor stiffness.",
                                        x[0], x[1], x[2]));
  });
}

// Mobility of a node: volume over the mean diagonal of K. Of linear elements the share of the consistent mass (its row
// sum is 2.5 times its diagonal) counts with its row sum, since pressure gradients are smooth. Quadratic elements are
// judged by the nodes on their edges, with the diagonal of the mass as the volume. Prescribed components yield nothing.
std::vector<double> SchurPreconditioner::mobility(const BlockMatrix& matrix) {
  std::vector<double> result(pattern_.columns_count, 0.0);
  for (std::int32_t i = 0; i < pattern_.rows; ++i) {
    double sum = 0, diagonal = 0;
    for (auto b = pattern_.row_begin[i]; b < pattern_.row_begin[i + 1]; ++b) {
      const float* a = matrix.blocks[b].a;
      sum += a[0] + a[5] + a[10];
    }
    const float* a = matrix.blocks[pattern_.diagonal[i]].a;
    diagonal = a[0] + a[5] + a[10];
    if (mesh_.quadratic)
      inverse_diagonal_[i] = 3.0 / diagonal;
    else
      inverse_diagonal_[i] = 3.0 / (diagonal + 0.6 * std::clamp(sum, 0.0, 2.5 * diagonal));
    const double* free = free_.data() + 4 * static_cast<std::size_t>(i);
    result[i] = (free[0] + free[1] + free[2]) / 3.0 * nodal_volume_[i] * inverse_diagonal_[i];
  }
  mesh_.halo.update(result, 1);
  for (std::int32_t i = 0; i < pattern_.columns_count; ++i)
    if (mesh_.host[i] != i) result[i] = result[mesh_.host[i]];
  return result;
}

void SchurPreconditioner::build_schur(const BlockMatrix& matrix, const std::vector<RankOne>& outlets) {
  const std::vector<double> mobile = mobility(matrix);
  find_yield(outlets);
  std::fill(schur_values_.begin(), schur_values_.end(), 0.0);
  for (std::int32_t b = 0; b < pressure_pattern_.blocks(); ++b)
    schur_values_[b] = matrix.blocks[pressure_source_[b]].a[15];
  for (const auto& e : laplacians_) {
    double weight = 0;
    for (int a = 0; a < e.count; ++a) weight += mobile[e.nodes[a]] / e.count;
    for (int a = 0, k = 0; a < 4; ++a)
      for (int b = a + 1; b < 4; ++b, ++k) {
        const double value = weight * e.entries[k];
        if (!e.wall || !mesh_.quadratic) {
          schur_values_[e.slots[4 * a + b]] += value;
          schur_values_[e.slots[4 * b + a]] += value;
        }
        schur_values_[e.slots[5 * a]] -= value;
        schur_values_[e.slots[5 * b]] -= value;
      }
  }
  if (mesh_.quadratic)
    add_free_quadratic_boundary(matrix);
  else
    add_free_boundary(matrix);
  check(MatSetValuesCOO(schur_, schur_values_.data(), INSERT_VALUES));
  for (std::int32_t i = 0; i < pattern_.rows; ++i)
    scale_[4 * static_cast<std::size_t>(i) + 3] = std::sqrt(std::abs(schur_values_[pressure_pattern_.diagonal[i]]));
}

// Where a boundary node moves freely, pressure pushes it: n^T K^-1 n with n = -(sum of its row of G), which vanishes
// inside. At the interface it ties the pressures of both sides.
void SchurPreconditioner::add_free_boundary(const BlockMatrix& matrix) {
  for (std::int32_t i = 0; i < pattern_.rows; ++i) {
    if (mesh_.host[i] != i) continue;
    double n[2][3] = {};
    std::int32_t twin = -1;
    for (auto b = pattern_.row_begin[i]; b < pattern_.row_begin[i + 1]; ++b) {
      const auto column = pattern_.columns[b];
      const bool other_side = follows_[column] != follows_[i];
      if (mesh_.host[column] == i && column != i) twin = column;
      for (int c = 0; c < 3; ++c) n[other_side ? 1 : 0][c] += matrix.blocks[b].a[12 + c];
    }
    const double h = yield_[i] * inverse_diagonal_[i];
    const auto product = [&](int p, int q) { return h * (n[p][0] * n[q][0] + n[p][1] * n[q][1] + n[p][2] * n[q][2]); };
    schur_values_[pressure_pattern_.diagonal[i]] += product(0, 0);
    if (twin >= 0) {
      schur_values_[pressure_pattern_.slot(twin, twin)] += product(1, 1);
      schur_values_[pressure_pattern_.slot(i, twin)] += product(0, 1);
      schur_values_[pressure_pattern_.slot(twin, i)] += product(0, 1);
    }
  }
}

// The same for nodes on edges, which share the push among the pressures of their ends.
void SchurPreconditioner::add_free_quadratic_boundary(const BlockMatrix& matrix) {
  std::vector<double> push(3 * static_cast<std::size_t>(pattern_.columns_count), 0.0);  // own, other, mixed
  for (std::int32_t i = 0; i < pattern_.rows; ++i) {
    if (mesh_.host[i] != i) continue;
    double n[2][3] = {};
    for (auto b = pattern_.row_begin[i]; b < pattern_.row_begin[i + 1]; ++b) {
      const bool other_side = follows_[pattern_.columns[b]] != follows_[i];
      for (int c = 0; c < 3; ++c) n[other_side ? 1 : 0][c] += matrix.blocks[b].a[12 + c];
    }
    const double h = 0.5 * yield_[i] * inverse_diagonal_[i];
    const auto product = [&](int p, int q) { return h * (n[p][0] * n[q][0] + n[p][1] * n[q][1] + n[p][2] * n[q][2]); };
    double* to = push.data() + 3 * static_cast<std::size_t>(i);
    to[0] = product(0, 0), to[1] = product(1, 1), to[2] = product(0, 1);
  }
  mesh_.halo.update(push, 3);
  for (const auto& edge : edges_) {
    const bool twin = mesh_.host[edge.node] != edge.node;
    const double* from = push.data() + 3 * static_cast<std::size_t>(mesh_.host[edge.node]);
    for (const auto end : edge.ends) {
      if (end >= pattern_.rows) continue;
      schur_values_[pressure_pattern_.diagonal[end]] += from[twin ? 1 : 0];
      if (!twin) continue;
      const auto host = mesh_.host[end];
      schur_values_[pressure_pattern_.slot(end, host)] += from[2];
      schur_values_[pressure_pattern_.slot(host, end)] += from[2];
    }
  }
}

// A resistance lets a pressure at its face push less, 1 / (1 + c s^T H s) of what the free nodes would yield.
void SchurPreconditioner::find_yield(const std::vector<RankOne>& outlets) {
  std::fill(yield_.begin(), yield_.end(), 1.0);
  std::fill(z_.begin(), z_.end(), 0.0);
  for (const auto& outlet : outlets)
    for (std::size_t k = 0; k < outlet.nodes.size(); ++k)
      for (std::size_t c = 0; c < 3; ++c)
        z_[4 * static_cast<std::size_t>(outlet.nodes[k]) + c] = inverse_diagonal_[outlet.nodes[k]] * outlet.s[k][c];
  const auto free = flows(mesh_.comm, outlets, z_);
  for (std::size_t k = 0; k < outlets.size(); ++k)
    for (const auto node : outlets[k].nodes) yield_[node] = 1.0 / (1.0 + outlets[k].coefficient * free[k]);
}

void SchurPreconditioner::update(const BlockMatrix& matrix, const std::vector<RankOne>& outlets) {
  extract(matrix);
  find_free(matrix);
  factorise(matrix);
  if (wall_) wall_->update(matrix, free_);
  build_schur(matrix, outlets);
  check(PCSetOperators(multigrid_.get(), schur_.get(), schur_.get()));
  check(PCSetUp(multigrid_.get()));
  velocity_outlets_ = RankOneInverse(mesh_.comm, outlets, z_.size(), [&](std::span<double> z) { times_inverse(z); });
  if (!mesh_.quadratic)
    diagonal_outlets_ = RankOneInverse(mesh_.comm, outlets, z_.size(), [&](std::span<double> z) { times_diagonal(z); });
}

void SchurPreconditioner::times_diagonal(std::span<double> z) const {
  for (std::int32_t i = 0; i < pattern_.rows; ++i)
    for (std::size_t k = 4 * static_cast<std::size_t>(i), c = 0; c < 3; ++c) z[k + c] *= inverse_diagonal_[i];
}

void SchurPreconditioner::times_inverse(std::span<double> z) {
  for (std::size_t i = 0; i < z.size(); ++i) sweep_[i] = static_cast<float>(z[i]);
  block_kernels(isa_).ilu_solve(factors_, sweep_.data());
  if (wall_)
    wall_->apply(z, z);
  else
    std::fill(z.begin(), z.end(), 0.0);
  for (std::size_t i = 0; i < z.size(); ++i) z[i] += sweep_[i];
}

void SchurPreconditioner::solve_pressure(std::span<const double> rhs, std::span<double> z) {
  double* b = nullptr;
  check(VecGetArray(rhs_.get(), &b));
  std::copy(rhs.begin(), rhs.end(), b);
  check(VecRestoreArray(rhs_.get(), &b));
  check(PCApply(multigrid_.get(), rhs_.get(), solution_.get()));
  const double* p = nullptr;
  check(VecGetArrayRead(solution_.get(), &p));
  for (std::int32_t i = 0; i < pattern_.rows; ++i) halo_p_[i] = z[4 * static_cast<std::size_t>(i) + 3] = p[i];
  check(VecRestoreArrayRead(solution_.get(), &p));
  mesh_.halo.update(halo_p_, 1);
}

void SchurPreconditioner::apply(std::span<const double> r, std::span<double> z) {
  const std::int32_t n = pattern_.rows;
  const auto& kernels = block_kernels(isa_);
  const auto push = [&] {
    kernels.multiply_columns(n, gradient_.row_begin.data(), gradient_.columns.data(), gradient_.blocks.data(),
                             halo_p_.data(), second_.data());
  };
  const auto put = [&](const auto& value) {
    for (std::int32_t i = 0; i < n; ++i)
      for (std::size_t k = 4 * static_cast<std::size_t>(i), c = 0; c < 3; ++c) z[k + c] = value(k + c);
  };
  if (mesh_.quadratic) {
    for (std::int32_t i = 0; i < n; ++i) pressure_rhs_[i] = r[4 * static_cast<std::size_t>(i) + 3];
    solve_pressure(pressure_rhs_, z);
    push();
    for (std::size_t k = 0; k < z_.size(); ++k) z_[k] = r[k] - second_[k];
    times_inverse(z_);
    velocity_outlets_.correct(z_);
    put([&](std::size_t k) { return z_[k]; });
    return;
  }
  std::copy_n(r.begin(), z_.size(), z_.begin());
  times_inverse(z_);
  velocity_outlets_.correct(z_);
  std::copy(z_.begin(), z_.end(), halo_v_.begin());
  mesh_.halo.update(halo_v_, 4);
  kernels.multiply_rows(n, pattern_.row_begin.data(), pattern_.columns.data(), divergence_.data(), halo_v_.data(),
                        pressure_rhs_.data());
  for (std::int32_t i = 0; i < n; ++i) pressure_rhs_[i] = r[4 * static_cast<std::size_t>(i) + 3] - pressure_rhs_[i];
  solve_pressure(pressure_rhs_, z);
  push();
  times_diagonal(second_);
  diagonal_outlets_.correct(second_);
  put([&](std::size_t k) { return z_[k] - second_[k]; });
}

}  // namespace tunica::assembly
