#include "tunica/parallel/agree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tunica/base/error.hpp"
#include "tunica/parallel/shared_error.hpp"

namespace tunica::parallel {

namespace {

enum class Kind : int { input, solver, other };

/// An error in a form that can travel.
struct Report {
  Kind kind = Kind::other;
  std::vector<std::string> texts;  ///< message, or where, what, remedy of each problem
};

Report describe(const std::exception_ptr& error) {
  try {
    std::rethrow_exception(error);
  } catch (const InputError& input) {
    Report report{Kind::input, {}};
    for (const auto& problem : input.problems())
      report.texts.insert(report.texts.end(), {problem.where, problem.what, problem.remedy});
    return report;
  } catch (const SolverError& solver) {
    return {Kind::solver, {solver.what()}};
  } catch (const std::exception& other) {
    return {Kind::other, {other.what()}};
  } catch (...) {
    return {Kind::other, {"unknown error"}};
  }
}

[[noreturn]] void raise(const Report& report) {
  if (report.kind == Kind::solver) throw SolverError(report.texts.at(0));
  if (report.kind == Kind::other) throw SharedError(report.texts.at(0));
  std::vector<Problem> problems;
  for (std::size_t i = 0; i + 2 < report.texts.size(); i += 3)
    problems.push_back({report.texts[i], report.texts[i + 1], report.texts[i + 2]});
  throw InputError(std::move(problems));
}

void broadcast_from(MPI_Comm comm, int root, void* data, std::size_t bytes) {
  constexpr std::size_t largest = std::size_t{1} << 30;
  char* next = static_cast<char*>(data);
  while (bytes > 0) {
    const std::size_t part = std::min(bytes, largest);
    MPI_Bcast(next, static_cast<int>(part), MPI_BYTE, root, comm);
    next += part;
    bytes -= part;
  }
}

void broadcast_texts(MPI_Comm comm, int root, std::vector<std::string>& texts) {
  std::uint64_t count = texts.size();
  broadcast_from(comm, root, &count, sizeof count);
  texts.resize(count);
  for (auto& text : texts) {
    std::uint64_t length = text.size();
    broadcast_from(comm, root, &length, sizeof length);
    text.resize(length);
    broadcast_from(comm, root, text.data(), length);
  }
}

std::vector<double> all_values(MPI_Comm comm, double value) {
  std::vector<double> values(static_cast<std::size_t>(size(comm)));
  MPI_Allgather(&value, 1, MPI_DOUBLE, values.data(), 1, MPI_DOUBLE, comm);
  return values;
}

std::int64_t reduce(MPI_Comm comm, std::int64_t value, MPI_Op operation) {
  std::int64_t result = 0;
  MPI_Allreduce(&value, &result, 1, MPI_INT64_T, operation, comm);
  return result;
}

template <class Pick>
double extreme(MPI_Comm comm, double value, Pick pick) {
  double result = value;
  for (const double other : all_values(comm, value)) {
    if (std::isnan(other)) return std::numeric_limits<double>::quiet_NaN();
    result = pick(result, other);
  }
  return result;
}

}  // namespace

void throw_if_any(MPI_Comm comm, std::exception_ptr error) {
  const int ranks = size(comm);
  const int failing = static_cast<int>(reduce(comm, error ? rank(comm) : ranks, MPI_MIN));
  if (failing == ranks) return;
  Report report;
  if (rank(comm) == failing) report = describe(error);
  broadcast_from(comm, failing, &report.kind, sizeof report.kind);
  broadcast_texts(comm, failing, report.texts);
  raise(report);
}

void broadcast_bytes(MPI_Comm comm, void* data, std::size_t bytes) { broadcast_from(comm, 0, data, bytes); }

void broadcast(MPI_Comm comm, std::string& text) {
  std::uint64_t length = text.size();
  broadcast(comm, length);
  text.resize(length);
  broadcast_bytes(comm, text.data(), length);
}

void broadcast(MPI_Comm comm, std::vector<std::string>& texts) { broadcast_texts(comm, 0, texts); }

double global_sum(MPI_Comm comm, double value) {
  global_sum(comm, std::span<double>(&value, 1));
  return value;
}

std::int64_t global_sum(MPI_Comm comm, std::int64_t value) { return reduce(comm, value, MPI_SUM); }

void global_sum(MPI_Comm comm, std::span<double> values) {
  const int count = static_cast<int>(values.size());
  const int ranks = size(comm);
  std::vector<double> all(values.size() * static_cast<std::size_t>(ranks));
  MPI_Allgather(values.data(), count, MPI_DOUBLE, all.data(), count, MPI_DOUBLE, comm);
  std::fill(values.begin(), values.end(), 0.0);
  for (std::size_t i = 0; i < all.size(); ++i) values[i % values.size()] += all[i];
}

double global_min(MPI_Comm comm, double value) {
  return extreme(comm, value, [](double a, double b) { return std::min(a, b); });
}
double global_max(MPI_Comm comm, double value) {
  return extreme(comm, value, [](double a, double b) { return std::max(a, b); });
}
std::int64_t global_min(MPI_Comm comm, std::int64_t value) { return reduce(comm, value, MPI_MIN); }
std::int64_t global_max(MPI_Comm comm, std::int64_t value) { return reduce(comm, value, MPI_MAX); }

bool any(MPI_Comm comm, bool condition) { return reduce(comm, condition ? 1 : 0, MPI_MAX) == 1; }

}  // namespace tunica::parallel
