// The program in a folder of its own, removed at the end of the test.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "text.hpp"

namespace tunica::test {

namespace fs = std::filesystem;

class Program : public testing::Test {
 protected:
  Program() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ =
        fs::temp_directory_path() / fmt::format("tunica_{}_{}_{}", getpid(), test->test_suite_name(), test->name());
    fs::create_directories(folder_);
  }
  ~Program() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }

  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
  std::string read(const std::string& name) const { return slurp(folder_ / name); }
  /// What the last command printed, errors included.
  std::string printed() const { return read("out.txt"); }

  /// Starts `tunica <arguments>` in the folder.
  pid_t start(const std::string& arguments) const {
    const std::string command =
        fmt::format("cd {} && exec {} {} > out.txt 2>&1", folder_.string(), TUNICA_PROGRAM, arguments);
    const pid_t child = fork();
    if (child == 0) {
      execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
      _exit(127);
    }
    return child;
  }
  /// Waits for its end; minus the number of the signal that killed it.
  static int exit_code(pid_t child) {
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }
  int tunica(const std::string& arguments) const { return exit_code(start(arguments)); }

  fs::path folder_;
};

}  // namespace tunica::test
