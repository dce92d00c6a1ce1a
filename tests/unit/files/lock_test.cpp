#include "tunica/files/lock.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <vector>

#include "temporary_folder.hpp"
#include "text.hpp"
#include "tunica/base/error.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/files/process.hpp"

namespace tunica::files {
namespace {

using tunica::test::contains;

namespace fs = std::filesystem;

std::string refusal(const fs::path& folder) {
  try {
    const FolderLock lock(folder);
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

std::string own_number() { return "pid: " + std::to_string(getpid()) + "\n"; }

/// A process that does something and waits to be killed.
class Child {
 public:
  template <class Action>
  explicit Child(const Action& action) {
    int ready[2];
    if (pipe(ready) != 0) throw std::runtime_error("no pipe");
    pid = fork();
    if (pid == 0) {
      action();
      [[maybe_unused]] const auto told = write(ready[1], "r", 1);
      for (;;) pause();
    }
    close(ready[1]);
    char byte = 0;
    began = read(ready[0], &byte, 1) == 1;
    close(ready[0]);
  }
  ~Child() { end(); }
  void kill_only() const { kill(pid, SIGKILL); }
  void end() {
    if (pid <= 0) return;
    kill(pid, SIGKILL);
    waitpid(pid, nullptr, 0);
    pid = 0;
  }
  pid_t pid = 0;
  bool began = false;
};

class Lock : public testing::Test {
 protected:
  /// Holds the folder in another process, as one that is killed leaves it.
  Child holder() const {
    return Child([this] { new FolderLock(results); });
  }
  void change(const std::string& key, const std::string& value) const {
    std::string text = test::slurp(file);
    const auto at = text.find(key + ": "), end = text.find('\n', at);
    ASSERT_NE(at, std::string::npos);
    write_atomically(file, text.replace(at, end - at, key + ": " + value));
  }

  test::TemporaryFolder folder;
  fs::path results = folder.path() / "results", file = results / lock_name;
};

TEST_F(Lock, GoesWithItsHolderAndTheFolderMadeForIt) {
  {
    const FolderLock lock(results);
    EXPECT_TRUE(contains(test::slurp(file), own_number()));
    EXPECT_TRUE(lock.taken_over().empty());
  }
  EXPECT_FALSE(fs::exists(results));
  fs::create_directory(results);
  { const FolderLock lock(results); }
  EXPECT_TRUE(fs::exists(results)) << "it was there before";
  EXPECT_TRUE(fs::is_empty(results));
}

TEST_F(Lock, IsItsOwnersAgain) {
  FolderLock outer(results);
  { const FolderLock inner(results); }
  EXPECT_TRUE(fs::exists(file)) << "the inner one does not give away what the outer one holds";
  FolderLock moved = std::move(outer);
  outer = {};
  EXPECT_TRUE(fs::exists(file));
  moved = {};
  EXPECT_FALSE(fs::exists(file));
}

TEST_F(Lock, IsRefusedToAnotherProcess) {
  const Child other = holder();
  ASSERT_TRUE(other.began);
  const auto message = refusal(results);
  EXPECT_TRUE(contains(message, "is being written by `")) << message;
  EXPECT_TRUE(contains(message, "process " + std::to_string(other.pid))) << message;
  EXPECT_THROW(refuse_if_owned_by_another(results), InputError);
  EXPECT_TRUE(fs::exists(file));
  EXPECT_NO_THROW(refuse_if_owned_by_another(folder.path()));
}

// Not waited for, the killed process is a zombie, which still has its number.
TEST_F(Lock, OfAKilledProcessIsTakenOver) {
  Child other = holder();
  other.kill_only();
  siginfo_t ended;
  ASSERT_EQ(waitid(P_PID, static_cast<id_t>(other.pid), &ended, WEXITED | WNOWAIT), 0);
  EXPECT_NO_THROW(refuse_if_owned_by_another(results));
  {
    const FolderLock lock(results);
    EXPECT_TRUE(contains(lock.taken_over(), "was left locked by `")) << lock.taken_over();
    EXPECT_TRUE(contains(lock.taken_over(), std::to_string(other.pid))) << lock.taken_over();
    EXPECT_TRUE(contains(test::slurp(file), own_number()));
  }
  EXPECT_FALSE(fs::exists(file));
}

TEST_F(Lock, OfAnotherHostIsRefusedWithTheWayOut) {
  Child other = holder();
  other.end();
  change("host", "node17");
  const auto message = refusal(results);
  EXPECT_TRUE(contains(message, "on node17")) << message;
  EXPECT_TRUE(contains(message, "remove " + file.string())) << message;
}

TEST_F(Lock, OfAnotherContainerIsRefused) {
  Child other = holder();
  other.end();
  change("process_space", "pid:[1]");
  EXPECT_TRUE(contains(refusal(results), "cannot be told whether"));
}

TEST_F(Lock, OfANumberThatIsUsedAgainIsTakenOver) {
  const Child other = holder();
  change("start", "1");
  EXPECT_EQ(refusal(results), "none");
}

TEST_F(Lock, FromBeforeTheMachineWasStartedAnewIsTakenOver) {
  const Child other = holder();
  change("boot", "00000000-0000-0000-0000-000000000000");
  EXPECT_EQ(refusal(results), "none");
}

TEST_F(Lock, IsLeftAloneByACopyOfItsProcess) {
  const FolderLock lock(results);
  const pid_t copy = fork();
  if (copy == 0) {
    const_cast<FolderLock&>(lock) = {};
    _exit(0);
  }
  waitpid(copy, nullptr, 0);
  EXPECT_TRUE(fs::exists(file));
}

TEST_F(Lock, ThatSaysNothingIsRefused) {
  fs::create_directory(results);
  write_atomically(file, "no lock\n");
  EXPECT_TRUE(contains(refusal(results), "does not say who owns the folder"));
}

TEST_F(Lock, OfAFileIsRefused) {
  write_atomically(results, "a file");
  EXPECT_TRUE(contains(refusal(results), "the folder cannot be made"));
}

// Exactly one of those that meet the lock of an ended process at the same time gets it, again and again.
TEST_F(Lock, HasOneWinnerWhenManyTakeItOver) {
  holder().end();
  constexpr int rounds = 10, takers = 8;
  for (int round = 0; round < rounds; ++round) {
    int start[2], answers[2];
    ASSERT_EQ(pipe(start), 0);
    ASSERT_EQ(pipe(answers), 0);
    std::vector<pid_t> children;
    for (int k = 0; k < takers; ++k) {
      children.push_back(fork());
      if (children.back() != 0) continue;
      close(start[1]);
      char byte = 0;
      [[maybe_unused]] const auto go = read(start[0], &byte, 1);  // at once for all: its other end is closed
      char answer = 'n';
      try {
        new FolderLock(results);
        answer = 'y';
      } catch (const InputError&) {
      }
      [[maybe_unused]] const auto told = write(answers[1], &answer, 1);
      for (;;) pause();
    }
    close(start[1]);
    close(start[0]);
    int winners = 0;
    for (int k = 0; k < takers; ++k) {
      char answer = 0;
      ASSERT_EQ(read(answers[0], &answer, 1), 1);
      winners += answer == 'y';
    }
    for (const pid_t child : children) {
      kill(child, SIGKILL);
      waitpid(child, nullptr, 0);
    }
    close(answers[0]);
    close(answers[1]);
    EXPECT_EQ(winners, 1) << "round " << round;
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(results), fs::directory_iterator()), 1) << "only the lock is left";
}

}  // namespace
}  // namespace tunica::files
