#include "tunica/coupling/unloading.hpp"

#include "tunica/coupling/nodal.hpp"

namespace tunica::coupling {

Mat3<double> motion_gradient(const distributed::DistributedMesh& mesh, std::span<const double> displacement, int stride,
                             const distributed::Region& region, std::size_t element, int point) {
  const auto displacement_of = [&](std::int32_t node) {
    const double* u = displacement.data() + static_cast<std::ptrdiff_t>(stride) * node;
    return Vec3<double>{{u[0], u[1], u[2]}};
  };
  const auto& nodes = region.elements[element];
  wall::quadratic::ElementState<double> e{};
  Vec3<double> X[4];
  wall::ElementState<double> shape;
  for (int a = 0; a < 4; ++a) {
    X[a] = mesh.points[nodes[a]];
    shape.displacement[a] = e.displacement[a] = displacement_of(nodes[a]);
  }
  wall::set_reference(shape, X);
  if (!mesh.quadratic) return wall::deformation_gradient(shape);
  for (std::size_t k = 0; k < 6; ++k) e.displacement[4 + k] = displacement_of(region.edges[element][k]);
  e.reference = shape.reference;
  return wall::deformation_gradient(wall::quadratic::at_point(e, point, {}));
}

// Newton's iteration X <- (X + X^-T) / 2 converges quadratically from any F with det F > 0; a stretch of 10 takes
// eight.
Mat3<double> rotation_of(const Mat3<double>& F) {
  Mat3<double> R = F;
  for (int k = 0; k < 50; ++k) {
    const Mat3<double> next = 0.5 * (R + transpose(inverse(R))), change = next + (-1.0) * R;
    R = next;
    if (double_dot(change, change) < 1e-24) break;
  }
  return R;
}

std::optional<WallPrestress> prestretch_of(const distributed::DistributedMesh& mesh,
                                           std::span<const double> unloading) {
  WallPrestress prestress{.kind = wall::PrestressKind::stretch};
  for (const auto& region : mesh.regions) {
    auto& values = prestress.values.emplace_back();
    if (region.kind != mesh::RegionKind::wall) continue;
    for (std::size_t e = 0; e < region.elements.size(); ++e)
      for (int q = 0; q < prestress_points(mesh.quadratic); ++q) {
        const Mat3<double> grad_U = motion_gradient(mesh, unloading, 3, region, e, q) + (-1.0) * identity<double>();
        const Mat3<double> back = identity<double>() + (-1.0) * grad_U;
        if (!(determinant(back) > 0.0)) return std::nullopt;
        const Mat3<double> F0 = inverse(back), V0 = F0 * transpose(rotation_of(F0));
        for (int k = 0; k < 9; ++k) values.push_back(V0(k / 3, k % 3));
      }
  }
  return prestress;
}

}  // namespace tunica::coupling
