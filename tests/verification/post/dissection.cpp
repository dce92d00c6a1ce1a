// Lumens, tears and balance of mass on the idealised dissection: a few steps of blood and wall on its coarse mesh, and
// what `tunica post` finds in them.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "run_and_post.hpp"
#include "tunica/analysis/lumens.hpp"
#include "tunica/analysis/vessel.hpp"
#include "tunica/artifacts/load_mesh.hpp"
#include "tunica/case/case.hpp"
#include "tunica/files/csv_file.hpp"
#include "tunica/mesh/edge_nodes.hpp"
#include "tunica/meshing/geometry.hpp"
#include "tunica/stages/meshing/mesh_case.hpp"
#include "verification/fluid/flow_case.hpp"

namespace tunica::verification {
namespace {

namespace fs = std::filesystem;

constexpr const char* outlets[] = {"brachiocephalic", "left_common_carotid", "left_subclavian", "abdominal_aorta"};

/// One mesh serves all.
class PostDissection : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    parallel::on_root(MPI_COMM_WORLD, [] {
      mesh_ = fs::temp_directory_path() / fmt::format("tunica_{}_PostDissection_mesh", getpid());
      case_file::MeshCase c;
      c.geometry = meshing::Geometry(config::parse_text(geometry::ParametricDissection::schema(), "{}").value);
      c.size = 7e-3;
      c.output = mesh_;
      stages::mesh_to_files(c, false, [](const std::string&) {});
    });
  }
  static void TearDownTestSuite() {
    std::error_code ignored;
    if (parallel::rank(MPI_COMM_WORLD) == 0) fs::remove_all(mesh_, ignored);
  }
  PostDissection() {
    parallel::on_root(MPI_COMM_WORLD, [&] { fs::create_directory_symlink(mesh_, folder.path() / "mesh"); });
  }

  const test::SharedFolder folder;

 private:
  inline static fs::path mesh_;  // of rank 0
};

/// Largest residual of the false lumen's balance in the run's own history, relative to the largest flow through a tear.
double closure(const fs::path& results) {
  const auto lumens = files::read_csv(results / "lumens.csv", "");
  double residual = 0, flow = 0;
  for (const double r : lumens.column("false lumen residual [ml/s]")) residual = std::max(residual, std::abs(r));
  for (const char* tear : {"tear_1 flow [ml/s]", "tear_2 flow [ml/s]"})
    for (const double q : lumens.column(tear)) flow = std::max(flow, std::abs(q));
  say("  run: largest residual of the false lumen %.2e ml/s, %.2e of the largest flow through a tear (%.2f ml/s)\n",
      residual, residual / flow, flow);
  return residual / flow;
}

std::string case_text() {
  std::string text =
      "analysis: fsi\nelements: linear\n"
      "meshes:\n"
      "  length_unit: mm\n  lumen: {simvascular: mesh/lumen}\n"
      "  wall:\n    simvascular: mesh/wall\n    region_array: region\n"
      "    regions: {true_lumen_wall: 1, false_lumen_wall: 2, flap: 3, branches: 4}\n"
      "  interface: {lumen: lumen_wall, wall: wall_inner}\n"
      "fluid: {density: 1060 kg/m^3, viscosity: {newtonian: {viscosity: 4 mPa s}}}\n"
      "wall: {density: 1120 kg/m^3, material: {neo_hooke: {young_modulus: 1 MPa, poisson_ratio: 0.49}}}\n"
      "boundary:\n  lumen_inlet: {flow: {value: 200 ml/s, ramp_time: 60 ms}}\n  wall_inlet: fixed\n"
      "  wall_outer: {support: {stiffness: 1e7 N/m^3}}\n";
  for (const char* name : outlets)
    text += fmt::format("  lumen_{}: {{resistance: 4e8 Pa s/m^3}}\n  wall_{}: fixed\n", name, name);
  return text + "time: {step: 5 ms, steps: 20, rho_infinity: 0.2}\noutput: {every: 1}\npost: {spacing: 10 mm}\n";
}

TEST_F(PostDissection, LumensTearsAndMass) {
  const auto report = run_and_post(folder, case_text());
  const fs::path post = folder.path() / "results/post";

  EXPECT_TRUE(report["left_out"].empty()) << report["left_out"].dump();
  ASSERT_EQ(report["tears"].size(), 2u);
  EXPECT_EQ(report["false_lumen"]["entry_tear"], "tear_1");
  const auto& balance = report["false_lumen"]["mass_balance"];
  say("  mass of the false lumen: largest residual %.5f %% of the largest flow through a tear (%.1f ml/s)\n",
      100 * balance["largest_residual_of_largest_flow"].get<double>(),
      balance["largest_flow_through_a_tear_ml_s"].get<double>());
  EXPECT_LT(balance["largest_residual_of_largest_flow"].get<double>(), 1e-5);
  EXPECT_EQ(report["false_lumen"]["flows_from"], "run");
  EXPECT_LT(closure(folder.path() / "results"), 1e-5);

  // Both lumens together are the lumen, whose volume the run writes from its own elements.
  const auto tears = files::read_csv(post / "tears.csv", ""),
             history = files::read_csv(folder.path() / "results/balance.csv", "");
  const auto &in_false = tears.column("false lumen volume [ml]"), &in_true = tears.column("true lumen volume [ml]");
  const double total = in_false.back() + in_true.back(), lumen = 1e-3 * history.column("lumen volume [mm^3]").back();
  say("  false lumen %.2f ml, true lumen %.2f ml; both %.4f ml, the run had %.4f ml\n", in_false.back(), in_true.back(),
      total, lumen);
  EXPECT_NEAR(total / lumen, 1, 1e-3);  // the last record of the run is a fraction of a step earlier

  // dV/dt of the false lumen, which the run writes, makes the change of its volume, which the fields have.
  const auto &rate = tears.column("false lumen dV/dt [ml/s]"), &time = tears.column("time [s]");
  const std::size_t k = time.size() / 2;
  const double slope = (in_false[k + 1] - in_false[k - 1]) / (time[k + 1] - time[k - 1]);
  const double mean = 0.25 * (rate[k - 1] + 2 * rate[k] + rate[k + 1]);
  say("  dV/dt %.4f ml/s in the mean, slope of the volume %.4f ml/s\n", mean, slope);
  EXPECT_NEAR(mean, slope, 0.02 * std::abs(slope) + 1e-3);

  // Along the dissected part there are two lumens, before it one; what passes the first section came in at the inlet.
  int with_false = 0;
  for (const auto& s : report["stations"]) with_false += s.contains("false_lumen");
  EXPECT_GT(with_false, 10);
  EXPECT_FALSE(report["stations"][0].contains("false_lumen"));
}

// What is cut out of quadratic results are the tears of the run, which knows the lumens by the corners of its elements:
// at the rims of a coarse mesh the nodes on edges would make more of them.
TEST_F(PostDissection, QuadraticElementsHaveTheTearsOfTheRun) {
  const auto file = folder.write("case.yaml", case_text());
  const auto c = case_file::read_case(file).value;
  const auto run = case_file::describe(c);
  auto data = artifacts::load_meshes(c.meshes, {}).data;
  analysis::tell_lumens_apart(run, *c.post, data, MPI_COMM_WORLD);
  mesh::add_edge_nodes(data);
  const auto lumens = analysis::find_lumens(distributed::distribute(data, MPI_COMM_WORLD), run, *c.post);
  ASSERT_TRUE(lumens);
  ASSERT_EQ(lumens->tears.size(), 2u);
  const auto vessel = analysis::make_vessel(run, *c.post, mesh::subdivided(data), MPI_COMM_WORLD);
  ASSERT_EQ(vessel.tears.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    say("  tear %zu: %.2f mm^2 in the run, %.2f mm^2 in the fields\n", k + 1, 1e6 * lumens->tears[k].area,
        1e6 * vessel.tears[k].area);
    EXPECT_NEAR(vessel.tears[k].area, lumens->tears[k].area, 1e-2 * lumens->tears[k].area);
    EXPECT_NEAR(norm(vessel.tears[k].centre - lumens->tears[k].centre), 0, 1e-3);
  }
}

std::string rigid_case_text() {
  std::string text =
      "analysis: flow\nelements: linear\nmeshes: {length_unit: mm, lumen: {simvascular: mesh/lumen}}\n"
      "fluid: {density: 1060 kg/m^3, viscosity: {newtonian: {viscosity: 4 mPa s}}}\n"
      "boundary:\n  lumen_inlet: {flow: {value: 200 ml/s, ramp_time: 60 ms}}\n  lumen_wall: no_slip\n";
  for (const char* name : outlets) text += fmt::format("  lumen_{}: {{resistance: 4e8 Pa s/m^3}}\n", name);
  return text + "time: {step: 5 ms, steps: 6, rho_infinity: 0.2}\noutput: {every: 1}\npost: {spacing: 10 mm}\n";
}

// The mesh of the lumen alone knows its lumens. What enters the false lumen by one tear leaves it by the other.
TEST_F(PostDissection, RigidWall) {
  const auto report = run_and_post(folder, rigid_case_text());
  EXPECT_EQ(report["left_out"].size(), 2u) << report["left_out"].dump();  // flap and stress
  ASSERT_EQ(report["tears"].size(), 2u);
  EXPECT_EQ(report["false_lumen"]["flows_from"], "run");
  EXPECT_LT(closure(folder.path() / "results"), 1e-5);
  for (const char* tear : {"tear_1 flow [ml/s]", "tear_2 flow [ml/s]"})
    EXPECT_GT(std::abs(files::read_csv(folder.path() / "results/lumens.csv", "").column(tear).back()), 1);
}

}  // namespace
}  // namespace tunica::verification
