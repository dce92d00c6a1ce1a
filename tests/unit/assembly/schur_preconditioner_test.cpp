#include "tunica/assembly/schur_preconditioner.hpp"

#include <gtest/gtest.h>

#include <string>

#include "numbers.hpp"
#include "tunica/base/error.hpp"
#include "tunica/mesh/generate.hpp"

namespace tunica::assembly {
namespace {

// What it does to a real system is tested with the coupling, where tangents of flow and wall are at hand.
TEST(SchurPreconditioner, NamesTheNodeOfASingularBlockOnEveryRank) {
  const auto data = mesh::box(3, 3, 3, {{1, 1, 1}}, mesh::RegionKind::lumen);
  const auto mesh = distributed::distribute(data, MPI_COMM_WORLD);
  const auto pattern = make_pattern(mesh);
  BlockMatrix matrix(pattern);
  std::int64_t bad = -1;  // the node at (1, 1, 1)
  for (std::size_t i = 0; i < data.points.size(); ++i)
    if (norm(data.points[i] - Vec3<double>{{1, 1, 1}}) < 1e-9) bad = static_cast<std::int64_t>(i);
  for (std::int32_t i = 0; i < pattern.rows; ++i) {
    if (mesh.original_ids[i] == bad) continue;
    for (int c = 0; c < 4; ++c) matrix.blocks[pattern.diagonal[i]].a[5 * c] = c < 3 ? 1.0F : -1.0F;
  }
  SchurPreconditioner preconditioner(mesh, pattern, choose_isa());
  try {
    preconditioner.update(matrix, {});
    ADD_FAILURE() << "no error";
  } catch (const SolverError& error) {
    EXPECT_NE(std::string(error.what()).find("(1, 1, 1) m"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace tunica::assembly
