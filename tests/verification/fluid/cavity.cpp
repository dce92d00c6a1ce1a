// Lid-driven cavity against Ghia, Ghia & Shin 1982. The square is a slab one cell thick between two planes of symmetry,
// where the normal velocity vanishes: the flow is plane. The lid rules its own corners.
#include "flow_case.hpp"

namespace tunica::verification {
namespace {

constexpr double side = 1.0, lid = 1.0;

// Cells half as wide at the walls as in the middle.
double graded(double s) { return s - 0.35 / (2 * pi) * std::sin(2 * pi * s); }

/// Velocity along the lid over the height of the vertical centreline.
std::map<double, double> centreline(const coupling::Problem& problem, const coupling::State& state) {
  const auto& mesh = problem.mesh();
  std::vector<std::array<double, 2>> own;
  for (std::int32_t i = 0; i < mesh.owned_nodes; ++i)
    if (std::abs(mesh.points[i][0] - 0.5) < 1e-9) own.push_back({mesh.points[i][1], state.velocity_pressure[at(i)]});
  std::map<double, double> result;
  const int ranks = [] {
    int n = 0;
    MPI_Comm_size(MPI_COMM_WORLD, &n);
    return n;
  }();
  const int count = static_cast<int>(2 * own.size());
  std::vector<int> counts(ranks), offsets(ranks, 0);
  MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, mesh.comm);
  for (int r = 1; r < ranks; ++r) offsets[r] = offsets[r - 1] + counts[r - 1];
  std::vector<std::array<double, 2>> all((offsets.back() + counts.back()) / 2);
  MPI_Allgatherv(own.data(), count, MPI_DOUBLE, all.data(), counts.data(), offsets.data(), MPI_DOUBLE, mesh.comm);
  std::map<double, int> nodes;  // the mean of the two planes
  for (const auto& [y, u] : all) {
    const double key = std::round(y * 1e9) / 1e9;
    result[key] += (u - result[key]) / ++nodes[key];
  }
  return result;
}

double interpolate(const std::map<double, double>& curve, double y) {
  const auto above = curve.lower_bound(y - 1e-9);
  if (above == curve.begin()) return above->second;
  const auto below = std::prev(above);
  const double s = std::min(1.0, (y - below->first) / (above->first - below->first));
  return (1 - s) * below->second + s * above->second;
}

void check_cavity(double reynolds, const std::string& column, int n, double allowed) {
  const auto file = reference("ghia_u_vertical_centreline.csv");
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no reference data";
  auto data = mesh::box(n, n, 1, {{side, side, 1.0 / n}}, mesh::RegionKind::lumen);
  for (auto& x : data.points) x = Vec3<double>{{graded(x[0]), graded(x[1]), x[2]}};
  const auto mesh = distributed::distribute(data, MPI_COMM_WORLD);
  auto input = newtonian(1.0, lid * side / reynolds);
  bc::Fixed plane;
  plane.directions = {false, false, false, true, false};
  input.boundary.conditions = {
      {"z_min", plane}, {"z_max", plane}, {"x_min", bc::NoSlip{}}, {"x_max", bc::NoSlip{}}, {"y_min", bc::NoSlip{}}};
  input.boundary.velocity_fields.emplace_back("y_max", [](const Vec3<double>& X, double) {
    return X[0] > 1e-9 && X[0] < side - 1e-9 ? Vec3<double>{{lid, 0, 0}} : Vec3<double>{};
  });
  input.boundary.pressure_point = coupling::PressurePoint{};
  input.rho_infinity = 0.0;
  input.newton.max_iterations = 20;
  input.newton.relative_tolerance = 1e-3;
  input.linear.tolerance = 1e-3;
  input.linear.max_iterations = 2000;
  coupling::Problem problem(mesh, input);
  auto state = problem.initial_state();
  double change = 1, dt = 0.25;
  for (; state.step < 60 && change > 1e-5; dt = std::min(1.3 * dt, 20.0)) {
    const auto before = state.velocity_pressure;
    ASSERT_NO_FATAL_FAILURE(march(problem, state, dt, 1));
    change = 0;
    for (std::int32_t i = 0; i < mesh.owned_nodes; ++i)
      for (int c = 0; c < 3; ++c)
        change = std::max(change, std::abs(state.velocity_pressure[at(i) + c] - before[at(i) + c]) / dt);
    change = parallel::global_max(mesh.comm, change);
  }
  const auto curve = centreline(problem, state);
  const auto ghia = read_columns(file);
  double worst = 0, place = 0;
  for (std::size_t k = 0; k < ghia["y"].size(); ++k) {
    const double deviation = std::abs(interpolate(curve, ghia["y"][k]) - ghia[column][k]);
    if (deviation > worst) worst = deviation, place = ghia["y"][k];
  }
  say("  Re %.0f, %d x %d cells: largest deviation %.2f %% of the lid speed at y = %.4f; %ld steps, last change %.1e\n",
      reynolds, n, n, 100 * worst, place, static_cast<long>(state.step), change);
  EXPECT_LT(change, 1e-4);
  EXPECT_LT(worst, allowed);
}

TEST(Cavity, Reynolds100) { check_cavity(100, "u_Re100", 32, 0.02); }
TEST(Cavity, Reynolds400) { check_cavity(400, "u_Re400", 40, 0.03); }

}  // namespace
}  // namespace tunica::verification
