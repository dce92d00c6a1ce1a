// Every rank sends something to some ranks: set-up of exchanges, such as who neighbours whom.
#pragma once

#include <mpi.h>

#include <numeric>
#include <type_traits>
#include <vector>

#include "tunica/parallel/message.hpp"

namespace tunica::parallel {

/// `outgoing[r]` goes to rank r; returns what came from each rank. At most 2^31 - 1 items in all. Collective.
template <class T>
requires std::is_trivially_copyable_v<T> std::vector<std::vector<T>> all_to_all(
    MPI_Comm comm, const std::vector<std::vector<T>>& outgoing) {
  const std::size_t ranks = outgoing.size();
  std::vector<int> sent(ranks), received(ranks), sent_at(ranks, 0), received_at(ranks, 0);
  std::vector<T> buffer;
  for (std::size_t r = 0; r < ranks; ++r) {
    sent[r] = static_cast<int>(outgoing[r].size());
    buffer.insert(buffer.end(), outgoing[r].begin(), outgoing[r].end());
  }
  MPI_Alltoall(sent.data(), 1, MPI_INT, received.data(), 1, MPI_INT, comm);
  std::exclusive_scan(sent.begin(), sent.end(), sent_at.begin(), 0);
  std::exclusive_scan(received.begin(), received.end(), received_at.begin(), 0);
  std::vector<T> incoming(static_cast<std::size_t>(received_at.back() + received.back()));
  MPI_Datatype item = MPI_DATATYPE_NULL;
  MPI_Type_contiguous(static_cast<int>(sizeof(T)), MPI_BYTE, &item);
  MPI_Type_commit(&item);
  MPI_Alltoallv(buffer.data(), sent.data(), sent_at.data(), item, incoming.data(), received.data(), received_at.data(),
                item, comm);
  MPI_Type_free(&item);
  std::vector<std::vector<T>> result(ranks);
  for (std::size_t r = 0; r < ranks; ++r)
    result[r].assign(incoming.begin() + received_at[r], incoming.begin() + received_at[r] + received[r]);
  return result;
}

}  // namespace tunica::parallel
