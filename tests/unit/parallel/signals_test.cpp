#include "tunica/parallel/signals.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tunica/parallel/message.hpp"

namespace tunica::parallel {
namespace {

TEST(StopSignals, AgreeWhenOneRankIsAsked) {
  const StopSignals signals;
  EXPECT_FALSE(stop_requested(MPI_COMM_WORLD));
  if (rank(MPI_COMM_WORLD) == size(MPI_COMM_WORLD) - 1) std::raise(SIGTERM);
  EXPECT_TRUE(stop_requested(MPI_COMM_WORLD));
}

TEST(StopSignals, CountAQuickRepetitionAsTheSameRequest) {
  const StopSignals signals;
  std::raise(SIGINT);
  std::raise(SIGTERM);
  EXPECT_TRUE(stop_requested(MPI_COMM_WORLD));
}

TEST(StopSignals, ForgetTheRequestAndGiveBackEarlierHandlers) {
  struct sigaction before {
  }, after{};
  sigaction(SIGTERM, nullptr, &before);
  {
    const StopSignals signals;
    std::raise(SIGUSR1);
    EXPECT_TRUE(stop_requested(MPI_COMM_WORLD));
  }
  sigaction(SIGTERM, nullptr, &after);
  EXPECT_EQ(before.sa_handler, after.sa_handler);
  EXPECT_FALSE(stop_requested(MPI_COMM_WORLD));
}

TEST(StopSignals, OneWithinAnotherDoesNothing) {
  const StopSignals outer;
  {
    const StopSignals inner;
    std::raise(SIGUSR1);
    EXPECT_EQ(stop_requested(MPI_COMM_WORLD), SIGUSR1);
  }
  EXPECT_EQ(stop_requested(MPI_COMM_WORLD), SIGUSR1);
}

TEST(StopSignals, AHangUpAsksForTheEndHoweverOftenItComes) {
  const StopSignals signals;
  std::raise(SIGHUP);
  EXPECT_EQ(stop_requested(MPI_COMM_WORLD), SIGHUP);
  usleep(600000);
  std::raise(SIGHUP);
  EXPECT_EQ(stop_requested(MPI_COMM_WORLD), SIGHUP);
}

TEST(StopSignals, AHangUpThatIsIgnoredStaysSo) {
  std::signal(SIGHUP, SIG_IGN);
  {
    const StopSignals signals;
    std::raise(SIGHUP);
    EXPECT_EQ(stop_requested(MPI_COMM_WORLD), 0);
  }
  std::signal(SIGHUP, SIG_DFL);
}

TEST(StopSignals, EndTheProcessAtTheSecondRequest) {
  const pid_t child = fork();
  if (child == 0) {
    const StopSignals signals;
    std::raise(SIGTERM);
    usleep(600000);
    std::raise(SIGTERM);
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(WTERMSIG(status), SIGTERM);
}

}  // namespace
}  // namespace tunica::parallel
