#include "tunica/coupling/mesh_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "small_cases.hpp"
#include "tunica/base/error.hpp"

namespace tunica::coupling {
namespace {

using assembly::NodeConstraint;
using test::at;

constexpr double amplitude = 2e-4;  // m

Vec3<double> linear_motion(const Vec3<double>& x) {
  return {{0.02 * x[0] - 0.03 * x[1] + 0.01 * x[2], 0.01 * x[0] + 0.02 * x[1], 0.03 * x[1] - 0.02 * x[2] + 1e-4}};
}

// Nodes of all named faces, ghosts included.
std::vector<char> boundary_nodes(const distributed::DistributedMesh& mesh) {
  std::vector<double> marked(mesh.nodes(), 0.0);
  for (const auto& face : mesh.faces)
    for (const auto& triangle : face.triangles)
      for (const auto node : triangle) marked[node] = 1.0;
  mesh.halo.update(marked, 1);
  return {marked.begin(), marked.end()};
}

// Largest error of the extension of `linear_motion` from the boundary, relative to the largest motion.
double patch_error(const mesh::MeshData& data, const ale::Parameters& parameters) {
  const auto mesh = distributed::distribute(data, MPI_COMM_WORLD);
  const auto on_boundary = boundary_nodes(mesh);
  std::vector<NodeConstraint> constraints;
  std::vector<double> u(at(mesh.nodes()), 0.0);
  double size = 0, error = 0;
  for (std::int32_t i = 0; i < mesh.nodes(); ++i) {
    const auto exact = linear_motion(mesh.points[i]);
    size = std::max(size, norm(exact));
    if (!on_boundary[i]) continue;
    constraints.push_back({i, Mat3<double>{}, false});
    for (int c = 0; c < 3; ++c) u[at(i) + c] = exact[c];
  }
  MeshMotion motion(mesh, assembly::choose_isa(), parameters, constraints);
  EXPECT_GT(motion.solve(u, 1e-10), 0);
  for (std::int32_t i = 0; i < mesh.nodes(); ++i) {
    const Vec3<double> moved{{u[at(i)], u[at(i) + 1], u[at(i) + 2]}};
    error = std::max(error, norm(moved - linear_motion(mesh.points[i])));
  }
  return parallel::global_max(mesh.comm, error) / parallel::global_max(mesh.comm, size);
}

TEST(MeshMotion, ExtendsALinearMotionExactly) {
  // Where all elements have the same volume, or none is stiffened, a linear motion has the same stress everywhere.
  EXPECT_LE(patch_error(mesh::box(4, 5, 3, {{0.02, 0.02, 0.02}}, mesh::RegionKind::lumen), {}), 1e-6);
  EXPECT_LE(patch_error(test::fluid_tube(), {.stiffening_exponent = 0.0}), 1e-6);
}

// The lumen of a tube, its interface led and its openings in their planes.
struct Lumen {
  distributed::DistributedMesh mesh;
  assembly::BlockPattern pattern = assembly::make_pattern(mesh);
  Boundaries boundaries{mesh, pattern, test::fsi_input(test::pressure(0.0), test::pressure(0.0)).boundary};
  MeshMotion motion{mesh, assembly::choose_isa(), {}, boundaries.mesh_constraints()};

  explicit Lumen(MPI_Comm comm) : mesh(distributed::distribute(test::fsi_tube(), comm)) {}

  // The interface bulges and slides along the axis, differently at each place.
  void move_interface(std::vector<double>& u, double size) const {
    for (std::int32_t i = 0; i < mesh.nodes(); ++i) {
      const auto host = mesh.host[i];
      if (host == i) continue;
      const auto& x = mesh.points[i];
      const double shape = size * (1.0 + std::sin(150.0 * x[2]) + 30.0 * x[0]);
      const Vec3<double> value{{shape * x[0] / 0.01, shape * x[1] / 0.01, 0.5 * shape}};
      for (int c = 0; c < 3; ++c) u[at(i) + c] = u[at(host) + c] = value[c];
    }
    mesh.halo.update(u, 4);
  }
  std::vector<double> at_rest() const { return std::vector<double>(at(mesh.nodes()), 0.0); }
};

TEST(MeshMotion, OpeningsSlideInTheirPlanes) {
  Lumen lumen(MPI_COMM_WORLD);
  auto u = lumen.at_rest();
  lumen.move_interface(u, amplitude);
  lumen.motion.solve(u, 1e-8);
  std::vector<char> on_interface(lumen.mesh.nodes(), 0);
  for (std::int32_t i = 0; i < lumen.mesh.nodes(); ++i)
    if (lumen.mesh.host[i] != i) on_interface[i] = on_interface[lumen.mesh.host[i]] = 1;
  double sideways = 0;
  for (const char* name : {"lumen_inlet", "lumen_outlet"})
    for (const auto& triangle : lumen.mesh.face(name).triangles)
      for (const auto node : triangle) {
        if (on_interface[node]) continue;
        EXPECT_NEAR(u[at(node) + 2], 0.0, 1e-9 * amplitude);
        sideways = std::max(sideways, std::hypot(u[at(node)], u[at(node) + 1]));
      }
  EXPECT_GT(parallel::global_max(MPI_COMM_WORLD, sideways), 0.05 * amplitude);
}

TEST(MeshMotion, LeavesTheInterfaceAndTheWallWhereTheyAre) {
  Lumen lumen(MPI_COMM_WORLD);
  auto u = lumen.at_rest();
  lumen.move_interface(u, amplitude);
  const auto before = u;
  lumen.motion.solve(u, 1e-8);
  std::vector<char> in_lumen(lumen.mesh.nodes(), 0);
  for (const auto& region : lumen.mesh.regions)
    if (region.kind == mesh::RegionKind::lumen)
      for (const auto& element : region.elements)
        for (const auto node : element) in_lumen[node] = 1;
  for (std::int32_t i = 0; i < lumen.mesh.nodes(); ++i)
    for (int c = 0; c < 3; ++c) {
      const auto host = lumen.mesh.host[i];
      if (host != i || !in_lumen[i]) {
        EXPECT_EQ(u[at(i) + c], before[at(i) + c]);
      }
      if (host != i) {
        EXPECT_EQ(u[at(host) + c], before[at(i) + c]);
      }
    }
}

TEST(MeshMotion, AWallThatReturnsBringsTheMeshBack) {
  Lumen lumen(MPI_COMM_WORLD);
  auto u = lumen.at_rest();
  lumen.move_interface(u, amplitude);
  lumen.motion.solve(u, 1e-10);
  const auto first = u;
  for (const double size : {2.0, -1.0, 0.3}) {
    lumen.move_interface(u, size * amplitude);
    lumen.motion.solve(u, 1e-10);
  }
  lumen.move_interface(u, amplitude);
  lumen.motion.solve(u, 1e-10);
  double error = 0;
  for (std::size_t k = 0; k < u.size(); ++k) error = std::max(error, std::abs(u[k] - first[k]));
  EXPECT_LE(error, 1e-7 * amplitude);
}

TEST(MeshMotion, IsTheSameOnAnyNumberOfRanks) {
  Lumen parts(MPI_COMM_WORLD), whole(MPI_COMM_SELF);
  auto u = parts.at_rest(), reference = whole.at_rest();
  parts.move_interface(u, amplitude);
  whole.move_interface(reference, amplitude);
  parts.motion.solve(u, 1e-10);
  whole.motion.solve(reference, 1e-10);
  EXPECT_LE(test::difference(parts.mesh, u, whole.mesh, reference, 0, 3), 1e-6);
}

TEST(MeshMotion, NothingToDoTakesNoIteration) {
  Lumen lumen(MPI_COMM_WORLD);
  auto u = lumen.at_rest();
  EXPECT_EQ(lumen.motion.solve(u, 1e-8), 0);
  EXPECT_EQ(u, lumen.at_rest());
}

TEST(MeshQuality, NamesTheWorstElementOnEveryRank) {
  const auto data = test::fluid_tube();
  const auto mesh = distributed::distribute(data, MPI_COMM_WORLD);
  std::vector<double> position(at(mesh.nodes()), 0.0);
  for (std::int32_t i = 0; i < mesh.nodes(); ++i)
    for (int c = 0; c < 3; ++c) position[at(i) + c] = 2.0 * mesh.points[i][c];
  const auto sound = mesh_quality(mesh, position);
  EXPECT_NEAR(sound.smallest, 1.0, 1e-12) << "a uniform stretch spoils nothing";

  // One corner of one element goes through its opposite face: elements around that node may invert as well, but this
  // one is turned over most.
  const std::int64_t spoilt = 7;
  const auto& element = data.tetrahedra[spoilt];
  for (std::int32_t i = 0; i < mesh.nodes(); ++i)
    for (int c = 0; c < 3; ++c) position[at(i) + c] = mesh.points[i][c];
  Vec3<double> base{};
  for (int a = 1; a < 4; ++a) base = base + (1.0 / 3.0) * data.points[static_cast<std::size_t>(element[a])];
  const auto corner = data.points[static_cast<std::size_t>(element[0])];
  const auto there = corner + 1.5 * (base - corner);
  std::vector<Vec3<double>> moved = data.points;
  moved[static_cast<std::size_t>(element[0])] = there;
  for (std::int32_t i = 0; i < mesh.nodes(); ++i)
    if (mesh.original_ids[i] == element[0])
      for (int c = 0; c < 3; ++c) position[at(i) + c] = there[c];
  MeshQuality expected{.smallest = 2.0};
  for (std::size_t e = 0; e < data.tetrahedra.size(); ++e) {
    Vec3<double> initial[4], current[4], centroid{};
    for (int a = 0; a < 4; ++a) {
      initial[a] = data.points[static_cast<std::size_t>(data.tetrahedra[e][a])];
      current[a] = moved[static_cast<std::size_t>(data.tetrahedra[e][a])];
      centroid = centroid + 0.25 * initial[a];
    }
    const auto signed_quality = [](const Vec3<double>(&x)[4]) {
      double largest = 0;
      for (int a = 0; a < 4; ++a) {
        double product = 1;
        for (int b = 0; b < 4; ++b)
          if (b != a) product *= norm(x[b] - x[a]);
        largest = std::max(largest, product);
      }
      return dot(cross(x[1] - x[0], x[2] - x[0]), x[3] - x[0]) / largest;
    };
    const double quality = signed_quality(current) / signed_quality(initial);
    if (quality < expected.smallest) expected = {quality, static_cast<std::int64_t>(e), centroid};
  }
  const auto worst = mesh_quality(mesh, position);
  EXPECT_LT(worst.smallest, 0.0);
  EXPECT_NEAR(worst.smallest, expected.smallest, 1e-12);
  EXPECT_EQ(worst.element, expected.element);
  EXPECT_LE(norm(worst.place - expected.place), 1e-12);
}

}  // namespace
}  // namespace tunica::coupling
