#include "tunica/parallel/patience.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <ctime>
#include <thread>

#include "tunica/base/error.hpp"

namespace tunica::parallel {
namespace {

TEST(Patience, RanksThatWaitForTheFirstUseNoCore) {
  const std::clock_t start = std::clock();
  on_root_patiently(MPI_COMM_WORLD, [] { std::this_thread::sleep_for(std::chrono::milliseconds(300)); });
  EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, 0.15);
}

TEST(Patience, AnErrorOfTheFirstIsThrownOnAll) {
  EXPECT_THROW(on_root_patiently(MPI_COMM_WORLD, [] { throw InputError("file", "is missing", "make it"); }),
               InputError);
}

}  // namespace
}  // namespace tunica::parallel
