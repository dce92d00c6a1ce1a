// A uniform flow stays uniform however the mesh moves (geometric conservation).
#include "flow_case.hpp"

namespace tunica::verification {
namespace {

// Reproducible noise in [-1, 1] from a place and a time, the same on every rank.
double noise(const Vec3<double>& X, double t, int component) {
  const double s = std::sin(1271.7 * X[0] + 311.3 * X[1] + 747.1 * X[2] + 5171.9 * t + 97.3 * component) * 43758.5453;
  return 2 * (s - std::floor(s)) - 1;
}

TEST(FreeStream, SurvivesRandomMotionOfTheMesh) {
  constexpr int n = 6;
  constexpr double length = 0.03, amplitude = 0.15 * length / n;
  const Vec3<double> stream{{0.4, -0.25, 0.6}};
  const auto uniform = [&](const Vec3<double>&, double) { return stream; };
  const auto mesh =
      distributed::distribute(mesh::box(n, n, n, {{length, length, length}}, mesh::RegionKind::lumen), MPI_COMM_WORLD);
  auto input = newtonian(1060, 0.004);
  for (const char* face : {"x_min", "x_max", "y_min", "y_max", "z_min"})
    input.boundary.velocity_fields.emplace_back(face, uniform);
  input.boundary.conditions = {{"z_max", bc::Pressure{bc::WaveformInput{0.0}}}};  // the stream leaves there
  input.newton.relative_tolerance = 1e-10;
  input.mesh_displacement = [&](const Vec3<double>& X, double t) {
    Vec3<double> u{};
    for (int c = 0; c < 3; ++c) {
      if (X[c] <= 1e-12 || X[c] >= length - 1e-12) return Vec3<double>{};
      u[c] = t > 0 ? amplitude * noise(X, t, c) : 0.0;
    }
    return u;
  };
  coupling::Problem problem(mesh, input);
  const auto zero = [](const Vec3<double>&, double) { return Vec3<double>{}; };
  auto state = state_from(problem, 0, uniform, zero, [](const Vec3<double>&, double) { return 0.0; });
  const double size = norm(stream);
  // The start is in balance to round-off, so what is small has to be said: the force of the stream on a face.
  state.residual_reference = 1060 * size * size * length * length;
  double largest_velocity = 0, largest_pressure = 0, largest_mesh_velocity = 0;
  ASSERT_NO_FATAL_FAILURE(march(problem, state, 1e-3, 8, [&] {
    for (std::int32_t i = 0; i < mesh.owned_nodes; ++i) {
      const double* v = state.velocity_pressure.data() + at(i);
      const double* w = state.displacement_rate.data() + at(i);
      largest_velocity = std::max(largest_velocity, norm(Vec3<double>{{v[0], v[1], v[2]}} - stream) / size);
      largest_pressure = std::max(largest_pressure, std::abs(v[3]) / (1060 * size * size));
      largest_mesh_velocity = std::max(largest_mesh_velocity, norm(Vec3<double>{{w[0], w[1], w[2]}}) / size);
    }
  }));
  largest_velocity = parallel::global_max(mesh.comm, largest_velocity);
  largest_pressure = parallel::global_max(mesh.comm, largest_pressure);
  largest_mesh_velocity = parallel::global_max(mesh.comm, largest_mesh_velocity);
  say("  mesh velocity up to %.1f times the stream: velocity changes by %.1e, pressure by %.1e rho v^2\n",
      largest_mesh_velocity, largest_velocity, largest_pressure);
  EXPECT_GT(largest_mesh_velocity, 0.5);
  EXPECT_LT(largest_velocity, 1e-12);
  EXPECT_LT(largest_pressure, 1e-12);
}

}  // namespace
}  // namespace tunica::verification
