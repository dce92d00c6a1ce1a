// Initial fields of a peer's case as the state that a run starts from.
#include "tunica/stages/import/initial_state.hpp"

#include <gtest/gtest.h>

#include "temporary_folder.hpp"
#include "tunica/artifacts/checkpoint.hpp"
#include "tunica/artifacts/load_mesh.hpp"
#include "tunica/base/error.hpp"
#include "tunica/distributed/distributed_mesh.hpp"
#include "tunica/mesh/generate.hpp"
#include "tunica/mesh_io/simvascular.hpp"
#include "tunica/mesh_io/volume_arrays.hpp"

namespace tunica::stages {

namespace {

using mesh::RegionKind;
using mesh_io::VolumeArray;

class InitialStateOfBlood : public testing::Test {
 protected:
  /// v = (3 + 100 x, 0, 0) cm/s, p = 500 + 1e4 x dyn/cm^2, x in m.
  void write(double stretch = 1.0) const {
    auto other = box;
    for (auto& x : other.points) x[1] *= stretch;
    VolumeArray velocity{.name = "Velocity", .of = VolumeArray::Of::nodes, .components = 3},
        pressure{.name = "Pressure", .of = VolumeArray::Of::nodes, .components = 1};
    for (const auto& x : box.points) {
      velocity.values.insert(velocity.values.end(), {3 + 100 * x[0], 0.0, 0.0});
      pressure.values.push_back(500 + 1e4 * x[0]);
    }
    mesh_io::write_volume_array(folder.path() / "v.vtu", other, RegionKind::lumen, 0.01, velocity);
    mesh_io::write_volume_array(folder.path() / "p.vtu", other, RegionKind::lumen, 0.01, pressure);
  }
  case_file::Case read_case(const std::string& elements = "linear") const {
    const auto file = folder.path() / "case.yaml";
    std::ofstream(file) << "analysis: flow\nelements: " << elements
                        << "\nmeshes: {length_unit: cm, lumen: {simvascular: mesh}}\n"
                           "fluid: {density: 1060 kg/m^3, viscosity: {newtonian: {viscosity: 4 mPa s}}}\n"
                           "boundary:\n  x_min: {pressure: 0 Pa}\n"
                           "  x_max: {rcr: {proximal: 1e6 Pa s/m^3, capacitance: 1e-9 m^3/Pa, distal: 1e8 Pa s/m^3}}\n"
                           "  \"y_*\": no_slip\n  \"z_*\": no_slip\n"
                           "time: {step: 1 ms, steps: 1}\nstart: start.checkpoint\n";
    return case_file::read_case(file).value;
  }
  void convert(const case_file::Case& c) const {
    peer_cases::InitialState initial;
    initial.lumen.velocity = folder.path() / "v.vtu";
    initial.lumen.pressure = folder.path() / "p.vtu";
    initial.file = "start.checkpoint";
    write_initial_state(initial, c, peer_cases::unit_system("cgs"), folder.path() / "start.checkpoint");
  }

  test::TemporaryFolder folder;
  mesh::MeshData box = mesh::box(2, 2, 2, {{0.02, 0.03, 0.01}}, RegionKind::lumen);
  void SetUp() override { mesh_io::write_simvascular(folder.path() / "mesh", box, RegionKind::lumen, 0.01); }
};

TEST_F(InitialStateOfBlood, HoldsItsFieldsAndTheFlowOfItsOutlets) {
  write();
  const auto c = read_case();
  convert(c);
  const auto data = artifacts::load_mesh(c).data;
  const auto mesh = distributed::distribute(data, MPI_COMM_SELF);
  coupling::State state;
  const auto n = 4 * static_cast<std::size_t>(mesh.nodes());
  for (auto* field : {&state.velocity_pressure, &state.acceleration, &state.displacement, &state.displacement_rate})
    field->assign(n, 0.0);
  state.end_pressure.assign(static_cast<std::size_t>(mesh.nodes()), 0.0);
  const auto outlets = artifacts::read_start(folder.path() / "start.checkpoint", mesh, state,
                                             artifacts::mesh_hash(data), "import again");
  for (std::int32_t i = 0; i < mesh.nodes(); ++i) {
    const double* v = &state.velocity_pressure[4 * static_cast<std::size_t>(i)];
    const double x = mesh.points[static_cast<std::size_t>(i)][0];
    EXPECT_NEAR(v[0], 0.03 + x, 1e-9);
    EXPECT_EQ(v[1], 0.0);
    EXPECT_NEAR(v[3], 50 + 1e3 * x, 1e-6);
  }
  // The outlet at x = 2 cm has 3 cm^2 and a velocity of 5 cm/s.
  ASSERT_EQ(outlets.size(), 1u);
  EXPECT_EQ(outlets[0].face, "x_max");
  EXPECT_NEAR(outlets[0].flow, 0.05 * 3e-4, 1e-12);
  EXPECT_NEAR(outlets[0].pressure, 70, 1e-6);
}

TEST_F(InitialStateOfBlood, OfAnotherMeshOrWithEdgeNodesIsAnError) {
  write(1.01);
  const auto message = test::message_of<InputError>([&] { convert(read_case()); });
  EXPECT_NE(message.find("in another place than the mesh"), std::string::npos) << message;
  write();
  const auto quadratic = test::message_of<InputError>([&] { convert(read_case("quadratic")); });
  EXPECT_NE(quadratic.find("initial fields of ten-node tetrahedra"), std::string::npos) << quadratic;
}

}  // namespace

}  // namespace tunica::stages
