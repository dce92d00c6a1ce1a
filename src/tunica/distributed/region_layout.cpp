#include "tunica/distributed/region_layout.hpp"

#include <algorithm>
#include <numeric>

#include "tunica/distributed/element_nodes.hpp"
#include "tunica/parallel/agree.hpp"

namespace tunica::distributed {

namespace {

template <class T>
MPI_Datatype mpi_type() {
  if constexpr (std::is_same_v<T, float>) return MPI_FLOAT;
  if constexpr (std::is_same_v<T, std::int64_t>) return MPI_INT64_T;
}

/// Every element at an owned node is here, so that a rank knows the regions of its nodes.
std::vector<std::int32_t> owned_nodes_of(const DistributedMesh& mesh, const Region& region) {
  std::vector<bool> is_in(static_cast<std::size_t>(mesh.nodes()), false);
  for_each_node(region, [&](std::int32_t n) { is_in[static_cast<std::size_t>(n)] = true; });
  std::vector<std::int32_t> nodes;
  for (std::int32_t n = 0; n < mesh.owned_nodes; ++n)
    if (is_in[static_cast<std::size_t>(n)]) nodes.push_back(n);
  return nodes;
}

std::vector<std::int64_t> owned_element_ids(const Region& region) {
  return {region.element_ids.begin(), region.element_ids.begin() + region.owned_elements};
}

}  // namespace

RegionLayout::RegionLayout(const DistributedMesh& mesh, const Region& region, int root)
    : comm_(mesh.comm), root_(root), nodes_(owned_nodes_of(mesh, region)) {
  std::vector<std::int64_t> ids;
  for (const auto n : nodes_) ids.push_back(mesh.original_ids[static_cast<std::size_t>(n)]);
  node_order_ = order_of(ids);
  element_order_ = order_of(owned_element_ids(region));
  global_nodes_ = parallel::global_sum(comm_, static_cast<std::int64_t>(std::ssize(nodes_)));
  global_elements_ = parallel::global_sum(comm_, std::int64_t{region.owned_elements});
}

RegionLayout::Order RegionLayout::order_of(const std::vector<std::int64_t>& mine) const {
  Order order;
  const int count = static_cast<int>(mine.size());
  order.counts.resize(static_cast<std::size_t>(parallel::size(comm_)));
  MPI_Gather(&count, 1, MPI_INT, order.counts.data(), 1, MPI_INT, root_, comm_);
  if (is_here()) {
    order.starts.resize(order.counts.size());
    std::exclusive_scan(order.counts.begin(), order.counts.end(), order.starts.begin(), 0);
    order.place.resize(static_cast<std::size_t>(order.starts.back() + order.counts.back()));
    std::iota(order.place.begin(), order.place.end(), std::size_t{0});  // as it arrives
  }
  auto ids = gather(order, mine, 1);
  std::vector<std::size_t> by_id(ids.size());
  std::iota(by_id.begin(), by_id.end(), std::size_t{0});
  std::sort(by_id.begin(), by_id.end(), [&](std::size_t a, std::size_t b) { return ids[a] < ids[b]; });
  for (std::size_t row = 0; row < by_id.size(); ++row) order.place[by_id[row]] = row;
  std::sort(ids.begin(), ids.end());
  order.ids = std::move(ids);
  return order;
}

template <class T>
std::vector<T> RegionLayout::gather(const Order& order, const std::vector<T>& mine, int components) const {
  MPI_Datatype tuple;
  MPI_Type_contiguous(components, mpi_type<T>(), &tuple);
  MPI_Type_commit(&tuple);
  const auto width = static_cast<std::size_t>(components);
  std::vector<T> arrived(order.place.size() * width);
  MPI_Gatherv(mine.data(), static_cast<int>(mine.size() / width), tuple, arrived.data(), order.counts.data(),
              order.starts.data(), tuple, root_, comm_);
  MPI_Type_free(&tuple);
  std::vector<T> rows(arrived.size());
  for (std::size_t k = 0; k < order.place.size(); ++k)
    std::copy_n(arrived.begin() + static_cast<std::ptrdiff_t>(k * width), components,
                rows.begin() + static_cast<std::ptrdiff_t>(order.place[k] * width));
  return rows;
}

field_io::RegionMesh RegionLayout::mesh(const DistributedMesh& mesh, const Region& region, double length_factor) const {
  field_io::RegionMesh result;
  std::vector<float> points;
  for (const auto n : nodes_) {
    const auto x = length_factor * mesh.points[static_cast<std::size_t>(n)];
    for (int c = 0; c < 3; ++c) points.push_back(static_cast<float>(x[c]));
  }
  result.points = gather(node_order_, points, 3);
  result.nodes_of_cell = mesh.quadratic ? 10 : 4;
  std::vector<std::int64_t> corners;
  for (std::int32_t e = 0; e < region.owned_elements; ++e)
    for_each_node(region, static_cast<std::size_t>(e),
                  [&](std::int32_t n) { corners.push_back(mesh.original_ids[static_cast<std::size_t>(n)]); });
  for (const auto id : gather(element_order_, corners, result.nodes_of_cell))
    result.cells.push_back(static_cast<std::int32_t>(
        std::lower_bound(node_order_.ids.begin(), node_order_.ids.end(), id) - node_order_.ids.begin()));
  result.node_ids = node_order_.ids;
  result.element_ids = element_order_.ids;
  return result;
}

std::vector<float> RegionLayout::nodal(std::span<const double> values, int stride, int components,
                                       double factor) const {
  std::vector<float> mine;
  mine.reserve(nodes_.size() * static_cast<std::size_t>(components));
  for (const auto n : nodes_)
    for (int c = 0; c < components; ++c)
      mine.push_back(static_cast<float>(
          factor *
          values[static_cast<std::size_t>(n) * static_cast<std::size_t>(stride) + static_cast<std::size_t>(c)]));
  return gather(node_order_, mine, components);
}

std::vector<float> RegionLayout::cellwise(std::span<const double> values, int components, double factor) const {
  std::vector<float> mine;
  mine.reserve(values.size());
  for (const double value : values) mine.push_back(static_cast<float>(factor * value));
  return gather(element_order_, mine, components);
}

}  // namespace tunica::distributed
