// Runs that a program of one's own takes step by step.
#include "tunica/stages/run/simulation.hpp"

#include <array>

#include "small_cases.hpp"
#include "tunica/base/error.hpp"

namespace tunica::test {
namespace {

stages::RunRequest into(const fs::path& file, const fs::path& directory) {
  stages::RunRequest request;
  request.case_file = file;
  request.directory = directory;
  request.program = {"test", "none"};
  return request;
}

class StepByStep : public testing::TestWithParam<std::string> {};

TEST_P(StepByStep, GivesTheFilesOfTheRunAndFieldsThatStayInPlace) {
  const SharedFolder folder;
  const auto file = folder.write("case.yaml", GetParam());
  const auto whole = folder.path() / "whole", steps = folder.path() / "steps";
  stages::RunRequest request;
  request.directory = whole;
  run(file, request);

  const stages::ReadCase c = stages::read_case(MPI_COMM_WORLD, file);
  stages::Simulation simulation(c, into(file, steps), MPI_COMM_WORLD, nullptr);
  const std::array fields{simulation.state().velocity_pressure.data(), simulation.state().displacement.data(),
                          simulation.state().end_pressure.data(), simulation.state().acceleration.data()};
  EXPECT_EQ(simulation.last().step, -1);
  while (simulation.step()) {
    EXPECT_EQ(simulation.last().step, simulation.steps());
    EXPECT_DOUBLE_EQ(simulation.last().time, simulation.time());
    EXPECT_EQ(fields, (std::array{simulation.state().velocity_pressure.data(), simulation.state().displacement.data(),
                                  simulation.state().end_pressure.data(), simulation.state().acceleration.data()}));
    if (simulation.steps() == 3) {
      EXPECT_TRUE(fs::exists(simulation.checkpoint()));
    }
  }
  EXPECT_FALSE(simulation.finished());
  EXPECT_EQ(simulation.finish().steps, 10);
  EXPECT_EQ(simulation.finish().steps, 10);
  EXPECT_TRUE(simulation.finished());
  EXPECT_THROW(simulation.step(), InputError);
  MPI_Barrier(MPI_COMM_WORLD);
  for (const char* name : {"faces.csv", "balance.csv", "outlets.csv", "checkpoints/step_00000010.checkpoint"})
    EXPECT_EQ(slurp(whole / name), slurp(steps / name)) << name;
}

INSTANTIATE_TEST_SUITE_P(Cases, StepByStep, testing::Values(coupled_case(10), windkessel_case(10)),
                         [](const auto& test) { return test.index == 0 ? "coupled" : "windkessel"; });

TEST(OwnInflow, IsThatOfTheCase) {
  const SharedFolder folder;
  const auto file = folder.write("case.yaml", windkessel_case(10));
  stages::RunRequest request;
  request.directory = folder.path() / "whole";
  run(file, request);
  stages::ReadCase c = stages::read_case(MPI_COMM_WORLD, file);
  const auto flow = bc::Waveform::constant(20e-6).ramped(10e-3);
  c.inflows = {{"lumen_inlet", [flow](double t) { return flow.value(t); }}};
  stages::Simulation simulation(c, into(file, folder.path() / "own"), MPI_COMM_WORLD, nullptr);
  while (simulation.step()) {
  }
  simulation.finish();
  EXPECT_EQ(slurp(folder.path() / "whole/faces.csv"), slurp(folder.path() / "own/faces.csv"));

  c.inflows = {{"lumen_outlet", [](double) { return 0.0; }}};
  EXPECT_THROW(stages::Simulation(c, into(file, folder.path() / "none"), MPI_COMM_WORLD, nullptr), InputError);
}

TEST(OwnInflow, ThatFailsLeavesTheStateOfTheStepBefore) {
  const SharedFolder folder;
  const auto file = folder.write("case.yaml", windkessel_case(10));
  stages::ReadCase c = stages::read_case(MPI_COMM_WORLD, file);
  c.inflows = {{"lumen_inlet", [](double t) {
                  if (t > 5e-3) throw SolverError("no more blood");
                  return 20e-6;
                }}};
  stages::Simulation simulation(c, into(file, folder.path() / "own"), MPI_COMM_WORLD, nullptr);
  EXPECT_TRUE(simulation.step());
  EXPECT_TRUE(simulation.step());
  const auto before = simulation.state().velocity_pressure;
  EXPECT_THROW(simulation.step(), SolverError);
  EXPECT_TRUE(simulation.finished());
  EXPECT_EQ(simulation.steps(), 2);
  EXPECT_EQ(simulation.state().velocity_pressure, before);
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_TRUE(fs::exists(folder.path() / "own/checkpoints/step_00000002.checkpoint"));
}

TEST(OutletsBetweenSteps, KeepFlowAndStoredPressure) {
  const SharedFolder folder;
  const auto file = folder.write("case.yaml", windkessel_case(10));
  const stages::ReadCase c = stages::read_case(MPI_COMM_WORLD, file);
  stages::Simulation simulation(c, into(file, folder.path() / "own"), MPI_COMM_WORLD, nullptr);
  for (int k = 0; k < 5; ++k) simulation.step();
  const bc::Outlet before = simulation.state().outlets.at(0);
  auto rcr = std::get<bc::Rcr>(simulation.outlet("lumen_outlet"));
  EXPECT_EQ(rcr.distal, 1e8);
  rcr.distal = 1e30;  // nothing leaves the vessels downstream any more
  simulation.set_outlet("lumen_outlet", rcr);
  EXPECT_EQ(simulation.state().outlets.at(0).flow(), before.flow());
  EXPECT_EQ(simulation.state().outlets.at(0).stored_pressure(), before.stored_pressure());
  const double q0 = before.flow();
  simulation.step();
  const bc::Outlet& after = simulation.state().outlets.at(0);
  EXPECT_NEAR(after.stored_pressure() - before.stored_pressure(), 0.5 * (q0 + after.flow()) * 2e-3 / rcr.capacitance,
              1e-9 * after.stored_pressure());
  EXPECT_THROW(simulation.set_outlet("lumen_outlet", bc::Resistance{1e8, 0.0}), InputError);
  EXPECT_THROW(simulation.outlet("lumen_inlet"), InputError);
}

}  // namespace
}  // namespace tunica::test
