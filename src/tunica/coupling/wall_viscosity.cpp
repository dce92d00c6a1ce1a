#include "tunica/coupling/wall_viscosity.hpp"

#include "tunica/coupling/nodal.hpp"
#include "tunica/fe/quadratic_tetrahedron.hpp"

namespace tunica::coupling {

namespace {

struct Target {
  const distributed::DistributedMesh& mesh;
  const assembly::BlockPattern& pattern;
  std::span<double> residual;
  assembly::BlockMatrix* matrix;

  /// Motion of wall nodes is that of their hosts.
  template <int N>
  void add(const std::array<std::int32_t, N>& nodes, const Vec3<double> (&r)[N], const Mat3<double> (*k)[N]) const {
    for (std::size_t a = 0; a < N; ++a) {
      const auto row = mesh.host[nodes[a]];
      for (int i = 0; i < 3; ++i) residual[at(row) + static_cast<std::size_t>(i)] += r[a][i];
      for (std::size_t b = 0; b < N && matrix != nullptr; ++b) {
        float* block = matrix->blocks[pattern.slot(row, mesh.host[nodes[b]])].a;
        for (int j = 0; j < 3; ++j)
          for (int i = 0; i < 3; ++i) block[4 * j + i] += static_cast<float>(k[a][b](i, j));
      }
    }
  }
};

template <int N>
void gather_motion(const FieldsView& fields, const std::array<std::int32_t, N>& nodes,
                   wall::ViscousPoint<double, N>& point) {
  gather(fields.displacement, nodes, point.displacement);
  gather(fields.velocity_pressure, nodes, point.velocity);
}

fe::Gradients<double> shape_of(const FieldsView& fields, const std::array<std::int32_t, 4>& corners) {
  Vec3<double> X[4];
  gather(fields.reference_position, corners, X);
  return fe::gradients(X);
}

}  // namespace

void add_wall_viscosity(const distributed::DistributedMesh& mesh, const assembly::BlockPattern& pattern,
                        const wall::Viscosity& viscosity, const FieldsView& fields,
                        const wall::ViscousCoefficients& coefficients, std::span<double> residual,
                        assembly::BlockMatrix* matrix) {
  const Target target{mesh, pattern, residual, matrix};
  for (const auto& region : mesh.regions) {
    if (region.kind != mesh::RegionKind::wall) continue;
    for (std::size_t e = 0; e < region.elements.size(); ++e) {
      const auto& corners = region.elements[e];
      const auto shape = shape_of(fields, corners);
      if (!mesh.quadratic) {
        wall::ViscousPoint<double, 4> point;
        std::copy(std::begin(shape.dN), std::end(shape.dN), point.dN);
        point.volume = shape.volume;
        gather_motion<4>(fields, corners, point);
        Vec3<double> r[4] = {};
        Mat3<double> k[4][4] = {};
        add_viscous_forces(point, viscosity, coefficients, r, matrix != nullptr ? k : nullptr);
        target.add<4>(corners, r, k);
        continue;
      }
      std::array<std::int32_t, 10> nodes;
      std::copy(region.edges[e].begin(), region.edges[e].end(),
                std::copy(corners.begin(), corners.end(), nodes.begin()));
      wall::ViscousPoint<double, 10> point;
      gather_motion<10>(fields, nodes, point);
      Vec3<double> r[10] = {};
      Mat3<double> k[10][10] = {};
      for (const auto& q : fe::quadratic_four_points) {
        point.volume = q.weight * shape.volume;
        for (int a = 0; a < 10; ++a)
          point.dN[a] =
              q.slope[a][0] * shape.dN[fe::gradient_of[a][0]] + q.slope[a][1] * shape.dN[fe::gradient_of[a][1]];
        add_viscous_forces(point, viscosity, coefficients, r, matrix != nullptr ? k : nullptr);
      }
      target.add<10>(nodes, r, k);
    }
  }
}

}  // namespace tunica::coupling
