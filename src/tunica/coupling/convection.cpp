#include "tunica/coupling/convection.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "tunica/base/error.hpp"
#include "tunica/coupling/nodal.hpp"
#include "tunica/distributed/element_nodes.hpp"
#include "tunica/fe/quadratic_mass.hpp"
#include "tunica/fe/quadratic_tetrahedron.hpp"
#include "tunica/parallel/agree.hpp"

namespace tunica::coupling {

namespace {

constexpr int element_nodes = fe::quadratic_nodes;
constexpr double tolerance = 1e-8;  // of the residual: far below what the projection takes from the flow
constexpr int most_iterations = 200;

/// The mass matrix of the lumen at one instant, applied element by element: its inverse is asked for once in a step.
class Projection {
 public:
  Projection(const distributed::DistributedMesh& mesh, const State& state);

  std::vector<double> convection(const State& state, std::span<const double> stream) const;
  /// Conjugate gradients with the diagonal: the mass matrix is conditioned alike on all meshes (Wathen 1987).
  std::vector<double> solve(std::vector<double> residual) const;

 private:
  struct Element {
    std::array<std::int32_t, element_nodes> nodes;
    double volume;
    Vec3<double> gradients[4];  ///< of the barycentric coordinates
  };
  std::vector<double> times(const std::vector<double>& x) const;
  double product(const std::vector<double>& x, const std::vector<double>& y) const;
  std::vector<double> preconditioned(const std::vector<double>& x) const;

  const distributed::DistributedMesh& mesh_;
  std::vector<Element> elements_;         ///< ghost ones too: rows of owned nodes are complete
  std::vector<double> inverse_diagonal_;  ///< [owned node]; zero outside the lumen
};

Projection::Projection(const distributed::DistributedMesh& mesh, const State& state)
    : mesh_(mesh), inverse_diagonal_(static_cast<std::size_t>(mesh.owned_nodes), 0.0) {
  for (const auto& region : mesh.regions) {
    if (region.kind != mesh::RegionKind::lumen) continue;
    for (std::size_t e = 0; e < region.elements.size(); ++e) {
      Vec3<double> x[4];
      for (int a = 0; a < 4; ++a)
        x[a] = mesh.points[region.elements[e][a]] + vector_at(state.displacement.data(), region.elements[e][a]);
      const auto shape = fe::gradients(x);
      Element& element = elements_.emplace_back();
      element.nodes = distributed::quadratic_nodes(region, e);
      element.volume = shape.volume;
      for (int a = 0; a < 4; ++a) element.gradients[a] = shape.dN[a];
      for (int a = 0; a < element_nodes; ++a)
        if (element.nodes[a] < mesh.owned_nodes)
          inverse_diagonal_[element.nodes[a]] += shape.volume * fe::quadratic_mass[a][a];
    }
  }
  for (double& d : inverse_diagonal_)
    if (d > 0) d = 1.0 / d;
}

std::vector<double> Projection::convection(const State& state, std::span<const double> stream) const {
  std::vector<double> integral(at(mesh_.nodes()), 0.0);
  for (const Element& e : elements_) {
    Vec3<double> v[element_nodes], b[element_nodes];
    for (int a = 0; a < element_nodes; ++a) {
      v[a] = vector_at(state.velocity_pressure.data(), e.nodes[a]);
      b[a] = vector_at(stream.data(), e.nodes[a]);
    }
    for (const auto& point : fe::quadratic_fourteen_points) {
      Vec3<double> along{}, sum{};
      for (int a = 0; a < element_nodes; ++a) along = along + point.N[a] * b[a];
      for (int a = 0; a < element_nodes; ++a)
        sum = sum + dot(fe::quadratic_gradient(e.gradients, point, a), along) * v[a];
      for (int a = 0; a < element_nodes; ++a)
        for (int c = 0; c < 3; ++c) integral[at(e.nodes[a]) + c] += point.weight * e.volume * point.N[a] * sum[c];
    }
  }
  return integral;
}

// Four components at a time, the last of which is zero: they fill vectors. What an element adds is summed apart, since
// `y` could be `x` to the compiler.
std::vector<double> Projection::times(const std::vector<double>& x) const {
  std::vector<double> y(x.size(), 0.0);
  for (const Element& e : elements_) {
    double of_element[element_nodes][4], sum[element_nodes][4] = {};
    for (int b = 0; b < element_nodes; ++b)
      for (int c = 0; c < 4; ++c) of_element[b][c] = e.volume * x[at(e.nodes[b]) + c];
    for (int a = 0; a < element_nodes; ++a)
      for (int b = 0; b < element_nodes; ++b)
        for (int c = 0; c < 4; ++c) sum[a][c] += fe::quadratic_mass[a][b] * of_element[b][c];
    for (int a = 0; a < element_nodes; ++a)
      for (int c = 0; c < 4; ++c) y[at(e.nodes[a]) + c] += sum[a][c];
  }
  return y;
}

double Projection::product(const std::vector<double>& x, const std::vector<double>& y) const {
  double sum = 0;
  for (std::size_t k = 0; k < at(mesh_.owned_nodes); ++k) sum += x[k] * y[k];
  return parallel::global_sum(mesh_.comm, sum);
}

std::vector<double> Projection::preconditioned(const std::vector<double>& x) const {
  std::vector<double> z(x.size(), 0.0);
  for (std::size_t k = 0; k < at(mesh_.owned_nodes); ++k) z[k] = inverse_diagonal_[k / 4] * x[k];
  return z;
}

std::vector<double> Projection::solve(std::vector<double> residual) const {
  std::vector<double> x(residual.size(), 0.0), direction = preconditioned(residual);
  double energy = product(residual, direction);
  const double enough = tolerance * tolerance * energy;
  for (int k = 0; energy > enough; ++k) {
    if (k == most_iterations || !std::isfinite(energy))
      throw SolverError(
          fmt::format("projection of the convection: {} iterations, residual {:.1e} of the first, asked "
                      "{:.0e}",
                      k, tolerance * std::sqrt(energy / enough), tolerance));
    mesh_.halo.update(direction, 4);
    const std::vector<double> image = times(direction);
    const double length = energy / product(direction, image);
    for (std::size_t i = 0; i < at(mesh_.owned_nodes); ++i) {
      x[i] += length * direction[i];
      residual[i] -= length * image[i];
    }
    const std::vector<double> z = preconditioned(residual);
    const double next = product(residual, z);
    for (std::size_t i = 0; i < at(mesh_.owned_nodes); ++i) direction[i] = z[i] + next / energy * direction[i];
    energy = next;
  }
  mesh_.halo.update(x, 4);
  return x;
}

}  // namespace

std::vector<double> resolved_convection(const distributed::DistributedMesh& mesh, const State& state,
                                        std::span<const double> stream) {
  const Projection projection(mesh, state);
  return projection.solve(projection.convection(state, stream));
}

}  // namespace tunica::coupling
