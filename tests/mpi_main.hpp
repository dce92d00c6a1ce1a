// Entry of the test binaries that run under mpirun: a test that fails on any rank fails the binary, and ranks other
// than 0 print their failures only.
#pragma once

#include <gtest/gtest.h>
#include <mpi.h>

#include <cstdio>
#include <memory>
#include <string>

#include "tunica/parallel/agree.hpp"
#include "tunica/parallel/petsc.hpp"

namespace tunica::test {

class FailurePrinter : public testing::EmptyTestEventListener {
 public:
  explicit FailurePrinter(int rank) : rank_(rank) {}
  void OnTestPartResult(const testing::TestPartResult& result) override {
    if (!result.failed()) return;
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    std::fprintf(stderr, "rank %d: %s.%s failed at %s:%d\n%s\n", rank_, test ? test->test_suite_name() : "",
                 test ? test->name() : "", result.file_name() ? result.file_name() : "?", result.line_number(),
                 result.message());
  }

 private:
  int rank_;
};

/// Returns 0 if every test passed on every rank. PETSc and MPI are running while the tests do.
inline int mpi_main(int argc, char** argv) {
  const parallel::Session session;
  testing::InitGoogleTest(&argc, argv);
  const int rank = parallel::rank(MPI_COMM_WORLD);
  if (rank != 0) {
    auto& listeners = testing::UnitTest::GetInstance()->listeners();
    delete listeners.Release(listeners.default_result_printer());
    delete listeners.Release(listeners.default_xml_generator());
    listeners.Append(new FailurePrinter(rank));
  }
  const bool failed = parallel::any(MPI_COMM_WORLD, RUN_ALL_TESTS() != 0);
  if (failed && rank == 0) std::fprintf(stderr, "FAILED on at least one rank\n");
  return failed ? 1 : 0;
}

}  // namespace tunica::test
