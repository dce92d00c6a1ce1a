// Agreement between ranks: on errors, on values known to rank 0 only, and on sums and extremes.
//
// A rank that throws alone leaves the others waiting in the next collective call for ever. So whatever can fail on one
// rank only (reading a file, checking the input, factoring a local block) runs inside `agree` or `on_root`.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <exception>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "tunica/parallel/message.hpp"

namespace tunica::parallel {

/// Throws on all ranks if `error` is set on any of them: InputError, SolverError or, for every other kind,
/// std::runtime_error, with the content of the lowest failing rank. Collective.
void throw_if_any(MPI_Comm comm, std::exception_ptr error);

/// Runs `action` on every rank and returns its result, or throws the same error on all ranks if any of them threw.
/// `action` makes no collective call after a point where a single rank can throw. Collective.
template <class Action>
auto agree(MPI_Comm comm, Action&& action) {
  using Result = std::invoke_result_t<Action>;
  std::exception_ptr error;
  if constexpr (std::is_void_v<Result>) {
    try {
      std::forward<Action>(action)();
    } catch (...) {
      error = std::current_exception();
    }
    throw_if_any(comm, error);
  } else {
    std::optional<Result> result;
    try {
      result.emplace(std::forward<Action>(action)());
    } catch (...) {
      error = std::current_exception();
    }
    throw_if_any(comm, error);
    return std::move(*result);
  }
}

/// Runs `action` on rank 0 only and returns its result there, a value-initialised one elsewhere; an error of rank 0 is
/// thrown on all ranks. Collective.
template <class Action>
auto on_root(MPI_Comm comm, Action&& action) {
  using Result = std::invoke_result_t<Action>;
  return agree(comm, [&]() -> Result {
    if (rank(comm) == 0) return std::forward<Action>(action)();
    return Result();
  });
}

/// Copies `bytes` bytes from rank 0 to all. Collective, as are the following.
void broadcast_bytes(MPI_Comm comm, void* data, std::size_t bytes);
void broadcast(MPI_Comm comm, std::string& text);
void broadcast(MPI_Comm comm, std::vector<std::string>& texts);

template <class T>
requires std::is_trivially_copyable_v<T>
void broadcast(MPI_Comm comm, T& value) { broadcast_bytes(comm, &value, sizeof(T)); }

template <class T>
requires std::is_trivially_copyable_v<T>
void broadcast(MPI_Comm comm, std::vector<T>& values) {
  std::uint64_t count = values.size();
  broadcast(comm, count);
  values.resize(count);
  broadcast_bytes(comm, values.data(), count * sizeof(T));
}

/// Sums over the ranks, added in rank order: the same bits on every rank and in every run on as many ranks.
double global_sum(MPI_Comm comm, double value);
std::int64_t global_sum(MPI_Comm comm, std::int64_t value);
/// Sums each entry of `values` over the ranks in place; every rank passes as many entries.
void global_sum(MPI_Comm comm, std::span<double> values);

/// Extremes over the ranks; a NaN on any rank gives NaN, so that a broken norm is never overlooked.
double global_min(MPI_Comm comm, double value);
double global_max(MPI_Comm comm, double value);
std::int64_t global_min(MPI_Comm comm, std::int64_t value);
std::int64_t global_max(MPI_Comm comm, std::int64_t value);

/// Whether `condition` holds on at least one rank.
bool any(MPI_Comm comm, bool condition);

}  // namespace tunica::parallel
