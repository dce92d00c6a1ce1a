#include "tunica/coupling/region_blending.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tunica/assembly/multigrid.hpp"
#include "tunica/base/error.hpp"
#include "tunica/fe/tetrahedron.hpp"

namespace tunica::coupling {

using parallel::check;

namespace {

constexpr double negligible = 1e-3;

fe::Gradients<double> shape(const mesh::DistributedMesh& mesh, const std::array<std::int32_t, 4>& element) {
  const Vec3<double> x[4] = {mesh.points[element[0]], mesh.points[element[1]], mesh.points[element[2]],
                             mesh.points[element[3]]};
  return fe::gradients(x);
}

/// w - l^2 div grad w on the nodes of the wall; other nodes have a row of their own.
class Filter {
 public:
  Filter(const mesh::DistributedMesh& mesh, double l) : mesh_(mesh) {
    std::vector<PetscInt> rows, columns;
    std::vector<PetscScalar> values;
    const auto add = [&](PetscInt row, PetscInt column, double value) {
      rows.push_back(row);
      columns.push_back(column);
      values.push_back(value);
    };
    std::vector<char> in_wall(static_cast<std::size_t>(mesh.owned_nodes), 0);
    for (const auto& region : mesh.regions) {
      if (region.kind != mesh::RegionKind::wall) continue;
      for (const auto& element : region.elements) {
        const auto g = shape(mesh, element);
        for (int a = 0; a < 4; ++a) {
          if (element[a] >= mesh.owned_nodes) continue;
          in_wall[element[a]] = 1;
          const auto row = static_cast<PetscInt>(mesh.global_ids[element[a]]);
          for (int b = 0; b < 4; ++b)
            add(row, static_cast<PetscInt>(mesh.global_ids[element[b]]),
                g.volume * (l * l * dot(g.dN[a], g.dN[b]) + (a == b ? 0.1 : 0.05)));
        }
      }
    }
    for (std::int32_t i = 0; i < mesh.owned_nodes; ++i) {
      const auto row = static_cast<PetscInt>(mesh.global_ids[i]);
      if (!in_wall[i]) add(row, row, 1.0);
    }
    const PetscInt n = mesh.owned_nodes;
    check(MatCreate(mesh.comm, matrix_.out()));
    check(MatSetSizes(matrix_, n, n, PETSC_DETERMINE, PETSC_DETERMINE));
    check(MatSetType(matrix_, MATAIJ));
    check(MatSetPreallocationCOO(matrix_, static_cast<PetscCount>(rows.size()), rows.data(), columns.data()));
    check(MatSetValuesCOO(matrix_, values.data(), INSERT_VALUES));
    check(MatCreateVecs(matrix_, solution_.out(), rhs_.out()));
    multigrid_ = assembly::make_multigrid(mesh.comm);
    check(KSPCreate(mesh.comm, krylov_.out()));
    check(KSPSetType(krylov_, KSPCG));
    check(KSPSetPC(krylov_, multigrid_));
    check(KSPSetOperators(krylov_, matrix_, matrix_));  // after KSPSetPC: they belong to the preconditioner
    check(KSPSetTolerances(krylov_, 1e-10, PETSC_DEFAULT, PETSC_DEFAULT, 200));
  }

  /// Filtered indicator of the regions of one material, [local node].
  std::vector<double> apply(const std::vector<int>& material_of_region, int material) {
    double* b = nullptr;
    check(VecSet(rhs_, 0.0));
    check(VecGetArray(rhs_, &b));
    for (std::size_t r = 0; r < mesh_.regions.size(); ++r) {
      if (material_of_region[r] != material) continue;
      for (const auto& element : mesh_.regions[r].elements) {
        const double share = 0.25 * shape(mesh_, element).volume;
        for (const auto node : element)
          if (node < mesh_.owned_nodes) b[node] += share;
      }
    }
    check(VecRestoreArray(rhs_, &b));
    check(KSPSolve(krylov_, rhs_, solution_));
    KSPConvergedReason reason{};
    check(KSPGetConvergedReason(krylov_, &reason));
    if (reason < 0)
      throw SolverError(
          fmt::format("Blending of wall materials: conjugate gradients failed (PETSc reason {}). Is the "
                      "smoothing length far larger than the wall?",
                      static_cast<int>(reason)));
    std::vector<double> weight(static_cast<std::size_t>(mesh_.nodes()), 0.0);
    const double* x = nullptr;
    check(VecGetArrayRead(solution_, &x));
    std::copy(x, x + mesh_.owned_nodes, weight.begin());
    check(VecRestoreArrayRead(solution_, &x));
    mesh_.halo.update(weight, 1);
    return weight;
  }

 private:
  const mesh::DistributedMesh& mesh_;
  parallel::MatHandle matrix_;
  parallel::VecHandle solution_, rhs_;
  parallel::PcHandle multigrid_;
  parallel::KspHandle krylov_;
};

/// Negligible weights dropped, the others summing to one.
void tidy(double* weights, int materials) {
  double sum = 0.0;
  for (int m = 0; m < materials; ++m) {
    if (weights[m] < negligible) weights[m] = 0.0;
    sum += weights[m];
  }
  for (int m = 0; m < materials; ++m) weights[m] /= sum;
}

}  // namespace

std::vector<std::vector<double>> blend_regions(const mesh::DistributedMesh& mesh,
                                               const std::vector<int>& material_of_region, int materials,
                                               double length) {
  const auto count = static_cast<std::size_t>(materials);
  std::vector<std::vector<double>> weights(mesh.regions.size());
  for (std::size_t r = 0; r < mesh.regions.size(); ++r)
    if (material_of_region[r] >= 0) weights[r].assign(mesh.regions[r].elements.size() * count, 0.0);
  const auto for_each = [&](const auto& visit) {
    for (std::size_t r = 0; r < mesh.regions.size(); ++r)
      if (material_of_region[r] >= 0)
        for (std::size_t e = 0; e < mesh.regions[r].elements.size(); ++e)
          visit(mesh.regions[r].elements[e], weights[r].data() + e * count, material_of_region[r]);
  };
  if (!(length > 0.0) || materials == 1) {
    for_each([](const auto&, double* w, int material) { w[material] = 1.0; });
    return weights;
  }
  Filter filter(mesh, length / (2.0 * std::sqrt(3.0)));
  for (int m = 0; m < materials; ++m) {
    const auto nodal = filter.apply(material_of_region, m);
    for_each([&](const auto& element, double* w, int) {
      for (const auto node : element) w[m] += 0.25 * nodal[node];
    });
  }
  for_each([&](const auto&, double* w, int) { tidy(w, materials); });
  return weights;
}

}  // namespace tunica::coupling
