// Krylov solvers of PETSc on operators that are functions rather than matrices.
#pragma once

#include <mpi.h>

#include <functional>
#include <memory>
#include <span>

namespace tunica::assembly {

struct KrylovSettings {
  enum class Method { gmres, conjugate_gradients };
  Method method = Method::gmres;
  double tolerance = 1e-4;  ///< of the residual norm, relative to the right-hand side
  int max_iterations = 500;
  int restart = 200;  ///< GMRES only
};

struct LinearResult {
  int iterations = 0;
  double residual = 0;  ///< norm relative to that of the right-hand side
  bool converged = false;
};

/// out = A in; both hold the rank's own entries. Collective.
using LinearMap = std::function<void(const double* in, double* out)>;

/// GMRES is preconditioned from the right, so that the residual it tests is the true one, as far as the preconditioner
/// is linear: one that works in single precision limits the true relative residual to about 3e-7. Conjugate gradients
/// test the true residual as well and need symmetric positive operator and preconditioner.
class Krylov {
 public:
  Krylov(MPI_Comm comm, std::int32_t owned, KrylovSettings settings, LinearMap apply, LinearMap precondition);
  ~Krylov();
  Krylov(const Krylov&) = delete;
  Krylov& operator=(const Krylov&) = delete;

  /// Starts from x = 0. `absolute`: residual norm that is small enough whatever the right-hand side. Collective.
  LinearResult solve(std::span<const double> b, std::span<double> x, double absolute = 0.0);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> petsc_;
};

}  // namespace tunica::assembly
