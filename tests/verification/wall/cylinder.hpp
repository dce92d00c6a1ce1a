// Quarter of a thick cylinder in plane strain: set-up, displacement and stress at its inner face.
#pragma once

#include "verification/wall/solid.hpp"

namespace tunica::verification {

inline constexpr double A = 0.010, B = 0.012;  // m

inline mesh::CylinderSizes sizes(int radial) {
  return {.inner = A,
          .outer = B,
          .length = (B - A) / radial,
          .cells_radial = radial,
          .cells_around = 8 * radial,
          .cells_along = 1};
}

inline std::vector<std::pair<std::string, bc::Condition>> plane_strain(const bc::Condition& inner,
                                                                       const bc::Condition& outer) {
  return {{"wall_inner", inner},
          {"wall_outer", outer},
          {"wall_inlet", held(false, false, true)},
          {"wall_outlet", held(false, false, true)},
          {"symmetry_x", held(true, false, false)},
          {"symmetry_y", held(false, true, false)}};
}

/// Mean radial displacement of the nodes of a face [m].
inline double radial_displacement(const distributed::DistributedMesh& mesh, const State& state,
                                  const std::string& face) {
  std::vector<char> seen(mesh.nodes(), 0);
  double sums[2] = {};
  for (const auto& triangle : mesh.face(face).triangles)
    for (const auto i : triangle) {
      if (i >= mesh.owned_nodes || seen[i]) continue;
      seen[i] = 1;
      const auto& X = mesh.points[i];
      const double x = X[0] + state.displacement[at(i)], y = X[1] + state.displacement[at(i) + 1];
      sums[0] += std::hypot(x, y) - std::hypot(X[0], X[1]);
      sums[1] += 1;
    }
  parallel::global_sum(mesh.comm, sums);
  return sums[0] / sums[1];
}

struct WallStress {
  double hoop_inner = 0, radial_inner = 0;  ///< at the inner face [Pa]
  double hoop_scatter = 0;                  ///< largest deviation of an element from the fit [Pa]
};

/// Stresses at the inner face from a least-squares parabola in the deformed radius through the element stresses.
inline WallStress wall_stress(const distributed::DistributedMesh& mesh, const coupling::WallModel& model,
                              const State& state, double inner_radius) {
  struct Sample {
    double r, hoop, radial;
  };
  std::vector<Sample> samples;
  double M[11] = {};  // moments of s = r/a - 1: s^0..s^4, then hoop and radial against s^0..s^2
  for_each_element(mesh, model, state, [&](const ElementData& e) {
    double x[2] = {};
    for (int a = 0; a < 4; ++a)
      for (int c = 0; c < 2; ++c) x[c] += 0.25 * (e.X[a][c] + e.state.displacement[a][c]);
    const double r = std::hypot(x[0], x[1]), co = x[0] / r, si = x[1] / r;
    const auto s = cauchy_stress(e, model);
    const double cross = 2 * co * si * s(0, 1);
    samples.push_back({r / inner_radius - 1, si * si * s(0, 0) + co * co * s(1, 1) - cross,
                       co * co * s(0, 0) + si * si * s(1, 1) + cross});
    const Sample& q = samples.back();
    double power = 1;
    for (int k = 0; k < 5; ++k, power *= q.r) {
      M[k] += power;
      if (k < 3) M[5 + k] += power * q.hoop, M[8 + k] += power * q.radial;
    }
  });
  parallel::global_sum(mesh.comm, M);
  const Mat3<double> normal{{{M[0], M[1], M[2]}, {M[1], M[2], M[3]}, {M[2], M[3], M[4]}}};
  const Mat3<double> inverted = inverse(normal);
  const Vec3<double> hoop = inverted * Vec3<double>{{M[5], M[6], M[7]}},
                     radial = inverted * Vec3<double>{{M[8], M[9], M[10]}};
  WallStress result{hoop[0], radial[0], 0};
  for (const auto& q : samples)
    result.hoop_scatter = std::max(result.hoop_scatter, std::abs(q.hoop - (hoop[0] + q.r * (hoop[1] + q.r * hoop[2]))));
  result.hoop_scatter = parallel::global_max(mesh.comm, result.hoop_scatter);
  return result;
}

}  // namespace tunica::verification
