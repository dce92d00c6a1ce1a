#include "tunica/coupling/face_plane.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "tunica/fluid/boundary.hpp"
#include "tunica/parallel/agree.hpp"

namespace tunica::coupling {

Vec3<double> mean_normal(const distributed::DistributedMesh& mesh, const distributed::Face& face) {
  double sum[3] = {};
  for (std::int32_t t = 0; t < face.owned_triangles; ++t) {
    const auto& n = face.triangles[t];
    const Vec3<double> x[3] = {mesh.points[n[0]], mesh.points[n[1]], mesh.points[n[2]]};
    const Vec3<double> area = fluid::area_vector(x);
    for (int i = 0; i < 3; ++i) sum[i] += area[i];
  }
  parallel::global_sum(mesh.comm, sum);
  const Vec3<double> total{{sum[0], sum[1], sum[2]}};
  const double size = norm(total);
  return size > 0 ? (1.0 / size) * total : total;
}

double out_of_plane(const distributed::DistributedMesh& mesh, const distributed::Face& face,
                    const Vec3<double>& normal) {
  if (norm(normal) < 0.5) return std::numeric_limits<double>::infinity();  // a closed surface
  double sums[4] = {}, farthest = 0;                                       // area, area times centroid
  for (std::int32_t t = 0; t < face.owned_triangles; ++t) {
    const auto& n = face.triangles[t];
    const Vec3<double> x[3] = {mesh.points[n[0]], mesh.points[n[1]], mesh.points[n[2]]};
    const double area = fluid::area(x);
    sums[0] += area;
    for (int i = 0; i < 3; ++i) sums[1 + i] += area / 3.0 * (x[0][i] + x[1][i] + x[2][i]);
  }
  parallel::global_sum(mesh.comm, sums);
  const Vec3<double> centroid{{sums[1] / sums[0], sums[2] / sums[0], sums[3] / sums[0]}};
  for (const auto& t : face.triangles)
    for (const auto node : t) farthest = std::max(farthest, std::abs(dot(mesh.points[node] - centroid, normal)));
  return parallel::global_max(mesh.comm, farthest) / std::sqrt(sums[0] / std::numbers::pi);
}

}  // namespace tunica::coupling
