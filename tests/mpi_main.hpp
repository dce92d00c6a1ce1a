// Entry of the test binaries that run under mpirun: a test that fails on any rank fails the binary, and ranks other
// than 0 print their failures only.
#pragma once

#include <gtest/gtest.h>
#include <mpi.h>

#include <cstdio>
#include <string>

#include "tunica/parallel/agree.hpp"
#include "tunica/parallel/petsc.hpp"

namespace tunica::test {

class FailurePrinter : public testing::EmptyTestEventListener {
 public:
  explicit FailurePrinter(int rank) : rank_(rank) {}
  void OnTestStart(const testing::TestInfo& test) override {
    test_ = std::string(test.test_suite_name()) + "." + test.name();
  }
  // GoogleTest holds its lock here, so nothing may be asked of it.
  void OnTestPartResult(const testing::TestPartResult& result) override {
    if (!result.failed()) return;
    std::fprintf(stderr, "rank %d: %s failed at %s:%d\n%s\n", rank_, test_.c_str(),
                 result.file_name() != nullptr ? result.file_name() : "?", result.line_number(), result.message());
  }

 private:
  int rank_;
  std::string test_;
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
