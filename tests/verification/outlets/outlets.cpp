// Outlets coupled to the flow: a short tube with prescribed inflow and a three-element Windkessel, or a resistance,
// against their closed-form response; balance of mass; the same results however many ranks share the work.
#include "verification/fluid/tube.hpp"

namespace tunica::verification {
namespace {

constexpr double radius = 0.01, length = 0.02, period = 1.0;
constexpr double to_si = 1e5;               // dyn s/cm^5 -> Pa s/m^3
constexpr double to_si_capacitance = 1e-5;  // cm^5/dyn -> m^3/Pa
constexpr double proximal = 121 * to_si, distal = 1212 * to_si, capacitance = 1e-4 * to_si_capacitance;
constexpr double flow_mean = 1e-4;  // m^3/s
constexpr double omega = 2 * pi / period;

double inflow(double t) { return flow_mean * (1 - std::cos(omega * t)); }

/// Table of Q(t) for a periodic spline; removed with the object.
class FlowTable {
 public:
  FlowTable() : path_(std::filesystem::temp_directory_path() / "tunica_verification_flow.csv") {
    if (parallel::rank(MPI_COMM_WORLD) == 0) {
      std::ofstream file(path_);
      file.precision(17);
      file << "t,Q\n";
      for (int k = 0; k <= 200; ++k) file << period * k / 200 << ',' << inflow(period * k / 200) << '\n';
    }
    MPI_Barrier(MPI_COMM_WORLD);
  }
  ~FlowTable() {
    MPI_Barrier(MPI_COMM_WORLD);
    if (parallel::rank(MPI_COMM_WORLD) == 0) std::filesystem::remove(path_);
  }
  FlowTable(const FlowTable&) = delete;
  FlowTable& operator=(const FlowTable&) = delete;

  bc::WaveformInput waveform() const {
    return {.source = bc::TableSource{{.path = path_}, {.interpolation = bc::Interpolation::spline}}};
  }

 private:
  std::filesystem::path path_;
};

mesh::MeshData tube_data() {
  return mesh::tube({.radius = radius, .length = length, .cells_around = 16, .cells_radial = 3, .cells_along = 6});
}

coupling::ProblemInput with_outlet(const bc::Condition& inlet, const bc::Condition& outlet) {
  auto input = newtonian(1060, 0.004);
  input.boundary.conditions = {{"lumen_inlet", inlet}, {"lumen_outlet", outlet}, {"lumen_wall", bc::NoSlip{}}};
  return input;
}

/// What remains of inflow minus outflow at t_{n+alpha_f}, relative to the largest inflow of the period.
double mass_defect(const coupling::Problem& problem) {
  const double* v = problem.fields().velocity_pressure;
  return std::abs(face_flow(problem.mesh(), "lumen_inlet", v) + face_flow(problem.mesh(), "lumen_outlet", v)) /
         (2 * flow_mean);
}

TEST(Outlets, WindkesselFollowsItsClosedForm) {
  const auto file = reference("rcr_periodic.csv");
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no reference data";
  const auto table = read_columns(file);
  const double start_pressure = 0.1 * table["Pc"][0];
  double largest = 0;
  for (const double p : table["P_dyn_cm2"]) largest = std::max(largest, 0.1 * p);

  const FlowTable flow;
  const auto mesh = distributed::distribute(tube_data(), MPI_COMM_WORLD);
  auto input = with_outlet(
      bc::Flow{.course = flow.waveform()},
      bc::Rcr{.proximal = proximal, .capacitance = capacitance, .distal = distal, .initial_pressure = start_pressure});
  input.newton.relative_tolerance = 1e-6;
  coupling::Problem problem(mesh, input);
  auto state = problem.initial_state();
  const double dt = period / 80;
  const double alpha_f = 1 / (1 + input.rho_infinity);
  double worst = 0, worst_flow = 0, worst_defect = 0, worst_face = 0, old_pressure = state.outlets[0].pressure();
  ASSERT_NO_FATAL_FAILURE(march(problem, state, dt, 80, [&] {
    worst_defect = std::max(worst_defect, mass_defect(problem));
    worst_flow = std::max(worst_flow, std::abs(state.outlets[0].flow() - inflow(state.time)) / (2 * flow_mean));
    const double pressure = state.outlets[0].pressure();
    const double between = old_pressure + alpha_f * (pressure - old_pressure);
    worst_face =
        std::max(worst_face,
                 std::abs(face_pressure(mesh, "lumen_outlet", problem.fields().velocity_pressure) - between) / largest);
    old_pressure = pressure;
    if (state.step % 2 != 0) return;
    const std::size_t row = static_cast<std::size_t>(state.step / 2) % (table["t"].size() - 1);
    ASSERT_NEAR(table["t"][row], std::fmod(state.time + 1e-9, period), 1e-6);
    worst = std::max(worst, std::abs(pressure - 0.1 * table["P_dyn_cm2"][row]) / largest);
  }));
  say("  one period in 80 steps, of the largest pressure %.0f Pa: outlet pressure off by %.4f %%, mean pressure of the "
      "face by %.3f %%\n  outflow off by %.1e, inflow - outflow at most %.1e of the largest flow\n",
      largest, 100 * worst, 100 * worst_face, worst_flow, worst_defect);
  EXPECT_LT(worst, 1e-3);
  EXPECT_LT(worst_face, 0.01);
  EXPECT_LT(worst_defect, 1e-6);
}

TEST(Outlets, ResistanceHoldsItsPressure) {
  constexpr double resistance = 1.2e8, level = 1000;
  const FlowTable flow;
  const auto mesh = distributed::distribute(tube_data(), MPI_COMM_WORLD);
  const auto input = with_outlet(bc::Flow{.course = flow.waveform()},
                                 bc::Resistance{.resistance = resistance, .distal_pressure = level});
  coupling::Problem problem(mesh, input);
  auto state = problem.initial_state();
  const double dt = period / 40;
  double worst = 0, worst_defect = 0;
  ASSERT_NO_FATAL_FAILURE(march(problem, state, dt, 40, [&] {
    worst_defect = std::max(worst_defect, mass_defect(problem));
    const double exact = level + resistance * inflow(state.time);
    worst = std::max(worst, std::abs(state.outlets[0].pressure() - exact) / (2 * resistance * flow_mean));
  }));
  say("  pressure off by %.1e, inflow - outflow at most %.1e of the largest\n", worst, worst_defect);
  EXPECT_LT(worst, 1e-6);
  EXPECT_LT(worst_defect, 1e-6);
}

struct Result {
  std::vector<std::array<double, 4>> nodes;  ///< [original node]: v, p
  double outlet_pressure = 0;
};

Result run_on(MPI_Comm comm, const bc::WaveformInput& flow) {
  const auto data = tube_data();
  const auto mesh = distributed::distribute(data, comm);
  auto input = with_outlet(
      bc::Flow{.course = flow},
      bc::Rcr{.proximal = proximal, .capacitance = capacitance, .distal = distal, .initial_pressure = 4000});
  input.newton.relative_tolerance = 1e-9;
  coupling::Problem problem(mesh, input);
  auto state = problem.initial_state();
  march(problem, state, 0.02, 8);
  Result result{std::vector<std::array<double, 4>>(data.points.size()), state.outlets[0].pressure()};
  for (std::int32_t i = 0; i < mesh.owned_nodes; ++i)
    for (int c = 0; c < 4; ++c) result.nodes[mesh.original_ids[i]][c] = state.velocity_pressure[at(i) + c];
  parallel::global_sum(comm, std::span(&result.nodes[0][0], 4 * result.nodes.size()));
  return result;
}

// The linear solver splits the mesh as the ranks do, so the iterates differ; the solutions agree to the tolerance.
TEST(Outlets, SameOnOneAndOnAllRanks) {
  const FlowTable flow;
  const Result one = run_on(MPI_COMM_SELF, flow.waveform()), all = run_on(MPI_COMM_WORLD, flow.waveform());
  double velocity = 0, pressure = 0, largest_velocity = 0, largest_pressure = 0;
  for (std::size_t i = 0; i < one.nodes.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      velocity = std::max(velocity, std::abs(one.nodes[i][c] - all.nodes[i][c]));
      largest_velocity = std::max(largest_velocity, std::abs(one.nodes[i][c]));
    }
    pressure = std::max(pressure, std::abs(one.nodes[i][3] - all.nodes[i][3]));
    largest_pressure = std::max(largest_pressure, std::abs(one.nodes[i][3]));
  }
  int ranks = 0;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  const double outlet = std::abs(one.outlet_pressure - all.outlet_pressure) / one.outlet_pressure;
  say("  1 rank against %d, largest relative differences after 8 steps: velocity %.1e, pressure %.1e, outlet pressure "
      "%.1e\n",
      ranks, velocity / largest_velocity, pressure / largest_pressure, outlet);
  EXPECT_LT(velocity / largest_velocity, 1e-7);
  EXPECT_LT(pressure / largest_pressure, 1e-7);
  EXPECT_LT(outlet, 1e-9);
}

}  // namespace
}  // namespace tunica::verification
