#include "tunica/parallel/halo.hpp"

#include <algorithm>
#include <cassert>

#include "tunica/parallel/message.hpp"

namespace tunica::parallel {

namespace {

constexpr int set_up_tag = 72;
constexpr int exchange_tag = 73;

/// Number of ghosts of each owner. `global_ids` of the ghosts ascend and each rank owns a contiguous range.
std::vector<int> count_by_owner(MPI_Comm comm, std::span<const std::int64_t> ghosts, std::int64_t first_global) {
  std::vector<std::int64_t> first(static_cast<std::size_t>(size(comm)));
  MPI_Allgather(&first_global, 1, MPI_INT64_T, first.data(), 1, MPI_INT64_T, comm);
  std::vector<int> count(first.size(), 0);
  for (const std::int64_t id : ghosts) ++count[std::upper_bound(first.begin(), first.end(), id) - first.begin() - 1];
  return count;
}

}  // namespace

Halo::Halo(MPI_Comm comm, std::span<const std::int64_t> global_ids, std::int32_t owned, std::int64_t first_global)
    : comm_(comm), local_nodes_(static_cast<std::int32_t>(global_ids.size())) {
  const auto ghosts = global_ids.subspan(static_cast<std::size_t>(owned));
  assert(std::is_sorted(ghosts.begin(), ghosts.end()));
  const std::vector<int> needed = count_by_owner(comm, ghosts, first_global);
  const int ranks = static_cast<int>(needed.size());
  std::vector<int> asked(needed.size());
  MPI_Alltoall(needed.data(), 1, MPI_INT, asked.data(), 1, MPI_INT, comm);

  std::int32_t begin = owned;
  for (int other = 0; other < ranks; ++other) {
    if (needed[other] > 0 || asked[other] > 0) neighbours_.push_back({other, {}, begin, needed[other]});
    begin += needed[other];
  }

  std::vector<std::vector<std::int64_t>> wanted(neighbours_.size());
  requests_.resize(2 * neighbours_.size());
  for (std::size_t n = 0; n < neighbours_.size(); ++n) {
    const auto& neighbour = neighbours_[n];
    wanted[n].resize(static_cast<std::size_t>(asked[neighbour.rank]));
    MPI_Irecv(wanted[n].data(), asked[neighbour.rank], MPI_INT64_T, neighbour.rank, set_up_tag, comm,
              &requests_[2 * n]);
    MPI_Isend(global_ids.data() + neighbour.receive_begin, neighbour.receive_count, MPI_INT64_T, neighbour.rank,
              set_up_tag, comm, &requests_[2 * n + 1]);
  }
  MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
  for (std::size_t n = 0; n < neighbours_.size(); ++n)
    for (const std::int64_t id : wanted[n]) {
      assert(id >= first_global && id < first_global + owned);
      neighbours_[n].send.push_back(static_cast<std::int32_t>(id - first_global));
    }
  requests_.clear();
}

void Halo::update(std::span<double> values, int components) const {
  begin(values, components);
  end();
}

void Halo::begin(std::span<double> values, int components) const {
  assert(requests_.empty() && "an exchange is under way");
  assert(values.size() == static_cast<std::size_t>(local_nodes_) * static_cast<std::size_t>(components));
  std::size_t total = 0;
  for (const auto& neighbour : neighbours_) total += neighbour.send.size();
  send_buffer_.resize(total * static_cast<std::size_t>(components));
  requests_.resize(2 * neighbours_.size());

  const std::ptrdiff_t c = components;
  double* next = send_buffer_.data();
  for (std::size_t n = 0; n < neighbours_.size(); ++n) {
    const auto& neighbour = neighbours_[n];
    MPI_Irecv(values.data() + neighbour.receive_begin * c, neighbour.receive_count * components, MPI_DOUBLE,
              neighbour.rank, exchange_tag, comm_, &requests_[2 * n]);
    double* message = next;
    for (const std::int32_t node : neighbour.send) next = std::copy_n(values.data() + node * c, c, next);
    MPI_Isend(message, static_cast<int>(next - message), MPI_DOUBLE, neighbour.rank, exchange_tag, comm_,
              &requests_[2 * n + 1]);
  }
}

void Halo::end() const {
  MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
  requests_.clear();
}

}  // namespace tunica::parallel
