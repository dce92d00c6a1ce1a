#include "tunica/parallel/gather.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "tunica/base/error.hpp"
#include "tunica/parallel/message.hpp"

namespace tunica::parallel {
namespace {

constexpr std::int64_t global_nodes = 23;
constexpr int components_of_a_node = 3;

/// Nodes dealt out like cards, and in descending order.
std::vector<std::int64_t> my_ids() {
  std::vector<std::int64_t> ids;
  for (std::int64_t n = global_nodes - 1; n >= 0; --n)
    if (n % size(MPI_COMM_WORLD) == rank(MPI_COMM_WORLD)) ids.push_back(n);
  return ids;
}

TEST(Gather, PutsValuesInOriginalOrder) {
  const auto ids = my_ids();
  std::vector<double> values;
  for (const std::int64_t id : ids)
    for (int c = 0; c < components_of_a_node; ++c) values.push_back(static_cast<double>(id * components_of_a_node + c));
  values.resize(values.size() + 6, -1);  // ghosts
  const auto field = gather_by_original_id({MPI_COMM_WORLD, ids, global_nodes}, values, components_of_a_node);
  std::vector<double> expected(rank(MPI_COMM_WORLD) == 0 ? global_nodes * components_of_a_node : 0);
  std::iota(expected.begin(), expected.end(), 0);
  EXPECT_EQ(field, expected);
}

TEST(Gather, ScatterIsItsInverse) {
  const auto ids = my_ids();
  std::vector<double> field;
  if (rank(MPI_COMM_WORLD) == 0)
    for (std::int64_t i = 0; i < global_nodes * components_of_a_node; ++i)
      field.push_back(0.1 * static_cast<double>(i * i));
  std::vector<double> values(ids.size() * components_of_a_node + 6, -1);
  scatter_by_original_id({MPI_COMM_WORLD, ids, global_nodes}, field, values, components_of_a_node);
  for (std::size_t n = 0; n < ids.size(); ++n)
    for (int c = 0; c < components_of_a_node; ++c) {
      const auto i = ids[n] * components_of_a_node + c;
      ASSERT_EQ(values[n * components_of_a_node + c], 0.1 * static_cast<double>(i * i));
    }
  EXPECT_EQ(values.back(), -1) << "ghosts are left alone";
  EXPECT_EQ(gather_by_original_id({MPI_COMM_WORLD, ids, global_nodes}, values, components_of_a_node), field);
}

TEST(Gather, RefusesAFieldOfAnotherMeshOnAllRanks) {
  const auto ids = my_ids();
  std::vector<double> field(5), values(ids.size());
  EXPECT_THROW(scatter_by_original_id({MPI_COMM_WORLD, ids, global_nodes}, field, values, 1), InputError);
}

}  // namespace
}  // namespace tunica::parallel
