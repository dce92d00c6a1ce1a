// Point-to-point transfer of whole arrays of any length (one MPI call is limited to 2^31 - 1 items).
#pragma once

#include <mpi.h>

#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

namespace tunica::parallel {

int rank(MPI_Comm comm);
int size(MPI_Comm comm);

void send_bytes(MPI_Comm comm, int to, const void* data, std::size_t bytes);
void receive_bytes(MPI_Comm comm, int from, void* data, std::size_t bytes);

/// Sends `values` to rank `to`, which calls `receive`. Blocks until the buffer may be reused.
template <class T>
requires std::is_trivially_copyable_v<T>
void send(MPI_Comm comm, int to, const std::vector<T>& values) {
  const std::uint64_t count = values.size();
  send_bytes(comm, to, &count, sizeof count);
  send_bytes(comm, to, values.data(), count * sizeof(T));
}

/// The array that rank `from` sent.
template <class T>
requires std::is_trivially_copyable_v<T> std::vector<T> receive(MPI_Comm comm, int from) {
  std::uint64_t count = 0;
  receive_bytes(comm, from, &count, sizeof count);
  std::vector<T> values(count);
  receive_bytes(comm, from, values.data(), count * sizeof(T));
  return values;
}

}  // namespace tunica::parallel
