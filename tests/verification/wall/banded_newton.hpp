// Inflation of a displacement-element cylinder with a direct solver. The iterative solver of the program is not made
// for the locked displacement element (its tangent is K/mu times worse conditioned), and locking has to be seen, not
// the solver's limit: so the element kernels are assembled here into a banded matrix.
#pragma once

#include "tunica/wall/surface.hpp"
#include "verification/wall/solid.hpp"

namespace tunica::verification {

/// Newton's method on one rank; `held[3 node + direction]` stays zero, the face `loaded` carries a follower pressure.
class BandedNewton {
 public:
  BandedNewton(const distributed::DistributedMesh& mesh, const wall::Parameters& parameters, std::vector<char> held)
      : mesh_(mesh),
        model_(mesh, parameters),
        held_(std::move(held)),
        n_(3 * static_cast<std::size_t>(mesh.nodes())),
        matrix_(n_ * n_),
        residual_(n_) {
    for (const auto& element : mesh.regions[0].elements)
      for (const auto a : element)
        for (const auto b : element)
          band_ = std::max<std::size_t>(band_, 3 * static_cast<std::size_t>(std::abs(a - b)) + 2);
  }

  /// Largest component of the last increment [m].
  double iterate(State& state, const std::string& loaded, double pressure) {
    assemble(state, loaded, pressure);
    for (std::size_t k = 0; k < n_; ++k)
      if (held_[k] != 0) {
        for (std::size_t j = begin(k); j < end(k); ++j) matrix_[k * n_ + j] = matrix_[j * n_ + k] = 0;
        matrix_[k * n_ + k] = 1;
        residual_[k] = 0;
      }
    eliminate();
    double most = 0;
    for (std::size_t k = 0; k < n_; ++k) {
      state.displacement[4 * (k / 3) + k % 3] -= residual_[k];
      most = std::max(most, std::abs(residual_[k]));
    }
    return most;
  }

  const coupling::WallModel& model() const { return model_; }

 private:
  std::size_t begin(std::size_t k) const { return k > band_ ? k - band_ : 0; }
  std::size_t end(std::size_t k) const { return std::min(n_, k + band_ + 1); }

  void assemble(const State& state, const std::string& loaded, double pressure) {
    std::fill(matrix_.begin(), matrix_.end(), 0.0);
    std::fill(residual_.begin(), residual_.end(), 0.0);
    const auto add = [&](std::int32_t a, int i, std::int32_t b, int j, double value) {
      matrix_[(3 * static_cast<std::size_t>(a) + i) * n_ + 3 * static_cast<std::size_t>(b) + j] += value;
    };
    for (std::int32_t element = 0; element < std::ssize(mesh_.regions[0].elements); ++element) {
      const ElementData e = gather(mesh_, model_, state, 0, element);
      const auto& nodes = e.nodes;
      fe::ElementVector<double> r;
      fe::ElementMatrix<double> k;
      const auto [law, body] = model_.material(0, element);
      wall::displacement_tangent(e.state, law, body, wall::Coefficients{}, r, k);
      for (int a = 0; a < 4; ++a)
        for (int i = 0; i < 3; ++i) {
          residual_[3 * static_cast<std::size_t>(nodes[a]) + i] += r.r[a][i];
          for (int b = 0; b < 4; ++b)
            for (int j = 0; j < 3; ++j) add(nodes[a], i, nodes[b], j, k.k[a][b][i][j]);
        }
    }
    for (const auto& nodes : mesh_.face(loaded).triangles) {
      Vec3<double> x[3];
      for (int a = 0; a < 3; ++a)
        for (int i = 0; i < 3; ++i) x[a][i] = mesh_.points[nodes[a]][i] + state.displacement[at(nodes[a]) + i];
      wall::SurfaceVector<double> r{};
      wall::SurfaceMatrix<double> k{};
      wall::add_pressure(x, pressure, r);
      wall::add_pressure_tangent(x, pressure, 1.0, k);
      for (int a = 0; a < 3; ++a)
        for (int i = 0; i < 3; ++i) {
          residual_[3 * static_cast<std::size_t>(nodes[a]) + i] += r.r[a][i];
          for (int b = 0; b < 3; ++b)
            for (int j = 0; j < 3; ++j) add(nodes[a], i, nodes[b], j, k.k[a][b][i][j]);
        }
    }
  }

  void eliminate() {
    for (std::size_t p = 0; p < n_; ++p)
      for (std::size_t i = p + 1; i < end(p); ++i) {
        const double factor = matrix_[i * n_ + p] / matrix_[p * n_ + p];
        if (factor == 0) continue;
        for (std::size_t j = p + 1; j < end(p); ++j) matrix_[i * n_ + j] -= factor * matrix_[p * n_ + j];
        residual_[i] -= factor * residual_[p];
      }
    for (std::size_t p = n_; p-- > 0;) {
      for (std::size_t j = p + 1; j < end(p); ++j) residual_[p] -= matrix_[p * n_ + j] * residual_[j];
      residual_[p] /= matrix_[p * n_ + p];
    }
  }

  const distributed::DistributedMesh& mesh_;
  coupling::WallModel model_;
  std::vector<char> held_;
  std::size_t n_, band_ = 0;
  std::vector<double> matrix_, residual_;
};

}  // namespace tunica::verification
