// A folder that all ranks of a test use, removed at its end.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "text.hpp"
#include "tunica/parallel/agree.hpp"

namespace tunica::test {

class SharedFolder {
 public:
  explicit SharedFolder(MPI_Comm comm = MPI_COMM_WORLD) : comm_(comm) {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    std::string name = parallel::on_root(comm, [&] {
      const auto path = std::filesystem::temp_directory_path() /
                        ("tunica_" + std::to_string(getpid()) + "_" + test->test_suite_name() + "_" + test->name());
      std::filesystem::create_directories(path);
      return path.string();
    });
    parallel::broadcast(comm, name);
    path_ = name;
  }
  ~SharedFolder() {
    MPI_Barrier(comm_);
    std::error_code ignored;
    if (parallel::rank(comm_) == 0) std::filesystem::remove_all(path_, ignored);
  }
  SharedFolder(const SharedFolder&) = delete;
  SharedFolder& operator=(const SharedFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Writes a file on rank 0 and returns its name on all. Collective.
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    if (parallel::rank(comm_) == 0) std::ofstream(path_ / name) << text;
    MPI_Barrier(comm_);
    return path_ / name;
  }

 private:
  MPI_Comm comm_;
  std::filesystem::path path_;
};

}  // namespace tunica::test
