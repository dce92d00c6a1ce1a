#include "tunica/parallel/message.hpp"

#include <algorithm>

namespace tunica::parallel {

namespace {
constexpr int message_tag = 71;
constexpr std::size_t largest_message = std::size_t{1} << 30;
}  // namespace

int rank(MPI_Comm comm) {
  int value = 0;
  MPI_Comm_rank(comm, &value);
  return value;
}

int size(MPI_Comm comm) {
  int value = 0;
  MPI_Comm_size(comm, &value);
  return value;
}

void send_bytes(MPI_Comm comm, int to, const void* data, std::size_t bytes) {
  const char* next = static_cast<const char*>(data);
  while (bytes > 0) {
    const std::size_t part = std::min(bytes, largest_message);
    MPI_Send(next, static_cast<int>(part), MPI_BYTE, to, message_tag, comm);
    next += part;
    bytes -= part;
  }
}

void receive_bytes(MPI_Comm comm, int from, void* data, std::size_t bytes) {
  char* next = static_cast<char*>(data);
  while (bytes > 0) {
    const std::size_t part = std::min(bytes, largest_message);
    MPI_Recv(next, static_cast<int>(part), MPI_BYTE, from, message_tag, comm, MPI_STATUS_IGNORE);
    next += part;
    bytes -= part;
  }
}

}  // namespace tunica::parallel
