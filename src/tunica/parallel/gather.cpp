#include "tunica/parallel/gather.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "tunica/base/error.hpp"
#include "tunica/parallel/agree.hpp"
#include "tunica/parallel/message.hpp"

namespace tunica::parallel {

namespace {

std::vector<std::int64_t> ids_of(const NodeOrder& order) {
  return {order.original_ids.begin(), order.original_ids.end()};
}

/// Runs `exchange(rank, ids of rank)` on rank 0 for each rank, one after the other so that their parts never pile up.
template <class Exchange>
void for_each_rank(const NodeOrder& order, Exchange exchange) {
  exchange(0, ids_of(order));
  for (int other = 1; other < size(order.comm); ++other) exchange(other, receive<std::int64_t>(order.comm, other));
}

}  // namespace

std::vector<double> gather_by_original_id(const NodeOrder& order, std::span<const double> values, int components) {
  const auto c = static_cast<std::size_t>(components);
  const std::size_t owned = order.original_ids.size() * c;
  assert(values.size() >= owned);
  const std::vector<double> mine(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(owned));
  if (rank(order.comm) != 0) {
    send(order.comm, 0, ids_of(order));
    send(order.comm, 0, mine);
    return {};
  }
  std::vector<double> field(static_cast<std::size_t>(order.global_nodes) * c);
  for_each_rank(order, [&](int other, const std::vector<std::int64_t>& ids) {
    const std::vector<double> part = other == 0 ? mine : receive<double>(order.comm, other);
    for (std::size_t n = 0; n < ids.size(); ++n)
      std::copy_n(&part[n * c], c, &field[static_cast<std::size_t>(ids[n]) * c]);
  });
  return field;
}

void scatter_by_original_id(const NodeOrder& order, const std::vector<double>& field, std::span<double> values,
                            int components) {
  const auto c = static_cast<std::size_t>(components);
  assert(values.size() >= order.original_ids.size() * c);
  on_root(order.comm, [&] {
    const std::size_t expected = static_cast<std::size_t>(order.global_nodes) * c;
    if (field.size() != expected)
      throw InputError("nodal field", fmt::format("{} values, expected {}", field.size(), expected),
                       "use a file that was written with the same mesh");
  });
  if (rank(order.comm) != 0) {
    send(order.comm, 0, ids_of(order));
    const std::vector<double> part = receive<double>(order.comm, 0);
    std::copy(part.begin(), part.end(), values.begin());
    return;
  }
  for_each_rank(order, [&](int other, const std::vector<std::int64_t>& ids) {
    std::vector<double> part(ids.size() * c);
    for (std::size_t n = 0; n < ids.size(); ++n)
      std::copy_n(&field[static_cast<std::size_t>(ids[n]) * c], c, &part[n * c]);
    if (other == 0)
      std::copy(part.begin(), part.end(), values.begin());
    else
      send(order.comm, other, part);
  });
}

}  // namespace tunica::parallel
