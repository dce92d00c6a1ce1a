#include "tunica/coupling/mesh_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tunica/ale/mesh_motion.hpp"
#include "tunica/assembly/block_kernels.hpp"
#include "tunica/assembly/multigrid.hpp"
#include "tunica/base/error.hpp"
#include "tunica/coupling/nodal.hpp"
#include "tunica/parallel/agree.hpp"

namespace tunica::coupling {

using assembly::NodeConstraint;
using parallel::check;

namespace {

template <class Visit>
void for_each_lumen_element(const distributed::DistributedMesh& mesh, Visit visit) {
  for (const auto& region : mesh.regions)
    if (region.kind == mesh::RegionKind::lumen)
      for (std::size_t e = 0; e < region.elements.size(); ++e) visit(region, e);
}

void element_points(const distributed::DistributedMesh& mesh, const std::array<std::int32_t, 4>& element,
                    Vec3<double> (&x)[4]) {
  for (int a = 0; a < 4; ++a) x[a] = mesh.points[element[a]];
}

Vec3<double> project(const NodeConstraint& constraint, const double* v) {
  return constraint.P * Vec3<double>{{v[0], v[1], v[2]}};
}

}  // namespace

MeshMotion::MeshMotion(const distributed::DistributedMesh& mesh, assembly::Isa isa, const ale::Parameters& parameters,
                       std::vector<NodeConstraint> constraints)
    : mesh_(mesh),
      isa_(isa),
      pattern_(assembly::make_pattern(mesh, mesh::RegionKind::lumen)),
      blocks_(12 * static_cast<std::size_t>(pattern_.blocks())),
      constraints_(std::move(constraints)),
      constraint_of_(mesh.nodes(), -1),
      halo_(at(mesh.nodes())),
      increment_(at(mesh.nodes())),
      residual_(at(mesh.owned_nodes)) {
  // Nodes outside the lumen take no part.
  std::vector<char> in_lumen(mesh.nodes(), 0);
  for_each_lumen_element(mesh, [&](const distributed::Region& region, std::size_t e) {
    for (const auto node : region.elements[e]) in_lumen[node] = 1;
  });
  std::erase_if(constraints_, [&](const NodeConstraint& c) { return in_lumen[c.node] == 0; });
  for (std::int32_t i = 0; i < mesh.nodes(); ++i)
    if (in_lumen[i] == 0) constraints_.push_back({i, Mat3<double>{}, false});
  for (std::size_t k = 0; k < constraints_.size(); ++k)
    constraint_of_[constraints_[k].node] = static_cast<std::int32_t>(k);

  assemble(parameters);
  eliminate();
  krylov_ = std::make_unique<assembly::Krylov>(
      mesh.comm, 4 * mesh.owned_nodes,
      assembly::KrylovSettings{
          .method = assembly::KrylovSettings::Method::conjugate_gradients, .tolerance = 1e-12, .max_iterations = 500},
      [this](const double* x, double* y) { apply(x, y); }, [this](const double* r, double* z) { precondition(r, z); });
}

// Elastic blocks, and the scalar matrix of the preconditioner: the mean of the three diagonal entries of each block.
void MeshMotion::assemble(const ale::Parameters& parameters) {
  double volume = 0;
  for (const auto& region : mesh_.regions)
    if (region.kind == mesh::RegionKind::lumen)
      for (std::int32_t e = 0; e < region.owned_elements; ++e) {
        Vec3<double> x[4];
        element_points(mesh_, region.elements[e], x);
        volume += fe::gradients(x).volume;
      }
  std::int64_t elements = 0;
  for (const auto& region : mesh_.regions)
    if (region.kind == mesh::RegionKind::lumen) elements += region.owned_elements;
  const double mean_volume =
      parallel::global_sum(mesh_.comm, volume) / static_cast<double>(parallel::global_sum(mesh_.comm, elements));

  std::vector<double> scalar(pattern_.blocks(), 0.0);
  for_each_lumen_element(mesh_, [&](const distributed::Region& region, std::size_t e) {
    const auto& element = region.elements[e];
    Vec3<double> x[4];
    element_points(mesh_, element, x);
    ale::StiffnessMatrix<double> k;
    ale::stiffness(x, mean_volume, parameters, k);
    for (int a = 0; a < 4; ++a) {
      if (element[a] >= mesh_.owned_nodes) continue;
      for (int b = 0; b < 4; ++b) {
        const auto slot = static_cast<std::size_t>(pattern_.slot(element[a], element[b]));
        for (int j = 0; j < 3; ++j)
          for (int i = 0; i < 3; ++i) blocks_[12 * slot + 4 * j + i] += static_cast<float>(k.k[a][b](i, j));
        scalar[slot] += trace(k.k[a][b]) / 3.0;
      }
    }
  });
  make_preconditioner(scalar);
}

void MeshMotion::make_preconditioner(const std::vector<double>& scalar) {
  std::vector<PetscInt> rows, columns;
  std::vector<PetscScalar> values;
  const auto fixed = [&](std::int32_t node) {
    return constraint_of_[node] >= 0 && trace(constraints_[constraint_of_[node]].P) < 0.5;
  };
  for (std::int32_t i = 0; i < pattern_.rows; ++i)
    for (auto b = pattern_.row_begin[i]; b < pattern_.row_begin[i + 1]; ++b) {
      const auto j = pattern_.columns[b];
      if (i != j && (fixed(i) || fixed(j))) continue;
      rows.push_back(static_cast<PetscInt>(mesh_.first_global + i));
      columns.push_back(static_cast<PetscInt>(mesh_.global_ids[j]));
      values.push_back(fixed(i) ? 1.0 : scalar[b]);
    }
  const PetscInt n = pattern_.rows;
  check(MatCreate(mesh_.comm, scalar_.out()));
  check(MatSetSizes(scalar_, n, n, PETSC_DETERMINE, PETSC_DETERMINE));
  check(MatSetType(scalar_, MATAIJ));
  check(MatSetPreallocationCOO(scalar_, static_cast<PetscCount>(rows.size()), rows.data(), columns.data()));
  check(MatSetValuesCOO(scalar_, values.data(), INSERT_VALUES));
  check(VecCreateMPI(mesh_.comm, n, PETSC_DETERMINE, rhs_.out()));
  check(VecDuplicate(rhs_, solution_.out()));
  multigrid_ = assembly::make_multigrid(mesh_.comm);
  check(PCSetOperators(multigrid_, scalar_, scalar_));
  check(PCSetUp(multigrid_));
}

// A <- T A T + (I - T), keeping what couples free rows to prescribed values.
void MeshMotion::eliminate() {
  for (std::int32_t row = 0; row < pattern_.rows; ++row)
    for (auto b = pattern_.row_begin[row]; b < pattern_.row_begin[row + 1]; ++b) {
      const auto column = pattern_.columns[b];
      const auto row_constraint = constraint_of_[row], column_constraint = constraint_of_[column];
      if (row_constraint < 0 && column_constraint < 0) continue;
      float* block = blocks_.data() + 12 * static_cast<std::size_t>(b);
      Mat3<double> a;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) a(i, j) = block[4 * j + i];
      if (row_constraint >= 0) a = constraints_[row_constraint].P * a;
      if (column_constraint >= 0) {
        const Mat3<double> kept = a * constraints_[column_constraint].P;
        const Mat3<double> lost = a + (-1.0) * kept;
        if (double_dot(lost, lost) > 0) lost_.push_back({row, column, lost});
        a = kept;
      }
      if (row == column) a = a + identity<double>() + (-1.0) * constraints_[row_constraint].P;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) block[4 * j + i] = static_cast<float>(a(i, j));
    }
}

void MeshMotion::apply(const double* x, double* y) {
  std::copy(x, x + residual_.size(), halo_.begin());
  mesh_.halo.update(halo_, 4);
  assembly::block_kernels(isa_).multiply3(pattern_.rows, pattern_.row_begin.data(), pattern_.columns.data(),
                                          blocks_.data(), halo_.data(), y);
}

void MeshMotion::precondition(const double* r, double* z) {
  const std::int32_t n = pattern_.rows;
  std::copy(r, r + at(n), z);
  const auto project_all = [&] {
    for (const auto& c : constraints_) {
      if (c.node >= n) continue;
      const Vec3<double> v = project(c, z + at(c.node));
      for (int i = 0; i < 3; ++i) z[at(c.node) + i] = v[i];
    }
  };
  project_all();
  for (int component = 0; component < 3; ++component) {
    double* values = nullptr;
    check(VecGetArrayWrite(rhs_, &values));
    for (std::int32_t i = 0; i < n; ++i) values[i] = z[at(i) + component];
    check(VecRestoreArrayWrite(rhs_, &values));
    check(PCApply(multigrid_, rhs_, solution_));
    const double* result = nullptr;
    check(VecGetArrayRead(solution_, &result));
    for (std::int32_t i = 0; i < n; ++i) z[at(i) + component] = result[i];
    check(VecRestoreArrayRead(solution_, &result));
  }
  project_all();
}

int MeshMotion::solve(std::span<double> displacement, double tolerance) {
  // residual = -T (A u + lost u); the forces of the prescribed values set the scale.
  apply(displacement.data(), residual_.data());
  std::vector<double> force(residual_.size(), 0.0);
  for (const auto& lost : lost_) {
    const double* u = displacement.data() + at(lost.column);
    const Vec3<double> f = lost.a * Vec3<double>{{u[0], u[1], u[2]}};
    for (int i = 0; i < 3; ++i) force[at(lost.row) + i] += f[i];
  }
  double scale = 0;
  for (std::size_t i = 0; i < residual_.size(); ++i) {
    residual_[i] = -(residual_[i] + force[i]);
    scale += force[i] * force[i];
  }
  scale = std::sqrt(parallel::global_sum(mesh_.comm, scale));
  for (const auto& c : constraints_) {
    if (c.node >= pattern_.rows) continue;
    const Vec3<double> v = project(c, residual_.data() + at(c.node));
    for (int i = 0; i < 3; ++i) residual_[at(c.node) + i] = v[i];
  }
  const auto result = krylov_->solve(residual_, std::span(increment_).first(residual_.size()), tolerance * scale);
  if (!result.converged)
    throw SolverError(
        fmt::format("Mesh motion: conjugate gradients stopped after {} iterations at a relative residual "
                    "of {:.2e}.",
                    result.iterations, result.residual));
  for (std::size_t i = 0; i < residual_.size(); ++i) displacement[i] += increment_[i];
  mesh_.halo.update(displacement, 4);
  return result.iterations;
}

MeshQuality mesh_quality(const distributed::DistributedMesh& mesh, std::span<const double> position) {
  MeshQuality worst{.smallest = INFINITY};
  for_each_lumen_element(mesh, [&](const distributed::Region& region, std::size_t e) {
    Vec3<double> initial[4], current[4];
    element_points(mesh, region.elements[e], initial);
    for (int a = 0; a < 4; ++a)
      for (int i = 0; i < 3; ++i) current[a][i] = position[at(region.elements[e][a]) + i];
    const double quality = ale::relative_quality(initial, current);
    if (quality < worst.smallest || std::isnan(quality)) {
      worst.smallest = quality;
      worst.element = region.element_ids[e];
      worst.place = 0.25 * ((initial[0] + initial[1]) + (initial[2] + initial[3]));
    }
  });
  struct {
    double value;
    int rank;
  } mine{std::isnan(worst.smallest) ? -INFINITY : worst.smallest, 0}, lowest{};
  MPI_Comm_rank(mesh.comm, &mine.rank);
  MPI_Allreduce(&mine, &lowest, 1, MPI_DOUBLE_INT, MPI_MINLOC, mesh.comm);
  MPI_Bcast(&worst, sizeof worst, MPI_BYTE, lowest.rank, mesh.comm);
  return worst;
}

}  // namespace tunica::coupling
